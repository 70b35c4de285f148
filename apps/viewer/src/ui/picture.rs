//! The picture: what the pointer does in it, and what is written over it.

use antumbra::glam::DVec2;
use egui::{Align2, Color32, CursorIcon, FontId, Pos2, Rect, Response, Sense, Stroke, Ui, pos2, vec2};

use super::style::ACCENT;
use super::{Seen, overlay, teaching};
use crate::model::Model;
use crate::model::camera::{self, Lens};
use crate::model::pick::{self, Grip};
use crate::model::settings::{DIVIDERS, Layout};

/// How near the divider is still meant, points.
const DIVIDER_REACH: f32 = 6.0;

/// Shows the picture in what is left of the window; where it is.
pub(crate) fn show(ui: &mut Ui, model: &mut Model, seen: &mut Seen) -> Rect {
    let rect = ui.available_rect_before_wrap();
    let response = ui.allocate_rect(rect, Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "picture"));
    if rect.width() < 1.0 || rect.height() < 1.0 {
        return rect;
    }
    let size = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
    drag(ui, model, seen, &response, size);
    zoom(ui, model, &response);
    let lens = Lens::new(&model.scene().camera, size);
    let painter = ui.painter_at(rect);
    if model.settings.marks {
        overlay::marks(&painter, rect, &lens, model);
    }
    names(&painter, rect, model, seen);
    teaching::legend(&painter, rect, &seen.lesson);
    teaching::map(ui, rect, model, seen);
    rect
}

/// Where a point of the window is in the picture.
fn inside(rect: Rect, at: Pos2) -> DVec2 {
    DVec2::new(f64::from(at.x - rect.left()), f64::from(at.y - rect.top()))
}

fn divider_x(rect: Rect, model: &Model) -> f32 {
    rect.left() + rect.width() * model.settings.divider
}

fn drag(ui: &Ui, model: &mut Model, seen: &mut Seen, response: &Response, size: DVec2) {
    let rect = response.rect;
    let (modifiers, primary, other) = ui.input(|input| {
        let pointer = &input.pointer;
        (input.modifiers, pointer.primary_down(), pointer.secondary_down() || pointer.middle_down())
    });
    let lens = Lens::new(&model.scene().camera, size);
    let over_divider = |at: Pos2| {
        model.settings.layout == Layout::Split && (at.x - divider_x(rect, model)).abs() <= DIVIDER_REACH
    };
    if let Some(at) = response.hover_pos()
        && (seen.dividing || over_divider(at))
    {
        ui.set_cursor_icon(CursorIcon::ResizeHorizontal);
    }
    let time = model.clock.time;
    if response.drag_started() && primary {
        let start = ui.input(|input| input.pointer.press_origin());
        if let Some(start) = start {
            seen.dividing = over_divider(start);
            let at = inside(rect, start);
            let item =
                pick::at(model.scene(), time, &lens, at).filter(|_| !seen.dividing && !modifiers.shift);
            let item = item.filter(|&item| pick::is_loose(model.scene(), item) || model.chosen == Some(item));
            seen.grip = item.and_then(|item| Grip::new(model.scene(), time, &lens, at, item));
            if let Some(grip) = &seen.grip {
                model.choose(Some(grip.item));
            }
        }
    }
    // What was held may have been deleted meanwhile, or another scene been opened.
    if seen.grip.as_ref().is_some_and(|grip| model.chosen != Some(grip.item)) {
        seen.grip = None;
        seen.lost_grip = true;
    }
    if response.dragged()
        && !seen.lost_grip
        && let Some(at) = response.interact_pointer_pos()
    {
        let delta = response.drag_delta();
        if seen.dividing {
            model.settings.divider =
                ((at.x - rect.left()) / rect.width()).clamp(*DIVIDERS.start(), *DIVIDERS.end());
        } else if let Some(grip) = &mut seen.grip {
            let by = grip.drag(&lens, inside(rect, at), modifiers.command);
            let item = grip.item;
            model.move_item(item, by);
        } else if delta != egui::Vec2::ZERO {
            let part = DVec2::new(f64::from(delta.x), f64::from(delta.y)) / size.y;
            let old = model.scene().camera;
            let new = if other || modifiers.shift {
                camera::pan(&old, DVec2::new(-part.x, part.y))
            } else {
                // Half a turn for the height of the picture.
                camera::orbit(&old, part.x * std::f64::consts::PI, part.y * std::f64::consts::PI)
            };
            model.document.look(new);
        }
    }
    if response.drag_stopped() {
        seen.grip = None;
        seen.lost_grip = false;
        seen.dividing = false;
    }
    if response.clicked()
        && let Some(at) = response.interact_pointer_pos()
    {
        seen.choose(pick::at(model.scene(), time, &lens, inside(rect, at)));
    }
}

fn zoom(ui: &Ui, model: &mut Model, response: &Response) {
    if !response.hovered() {
        return;
    }
    let (scroll, pinch, shift) =
        ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta(), input.modifiers.shift));
    let old = model.scene().camera;
    let mut new = old;
    if pinch != 1.0 {
        new = camera::zoom(&new, f64::from(pinch));
    } else if shift && scroll != egui::Vec2::ZERO {
        let height = f64::from(response.rect.height().max(1.0));
        new = camera::pan(&new, DVec2::new(-f64::from(scroll.x), f64::from(scroll.y)) / height);
    } else if scroll.y != 0.0 {
        new = camera::zoom(&new, f64::from(scroll.y / 300.0).exp());
    }
    model.document.look(new);
}

/// Which way is where, and why one cannot.
fn names(painter: &egui::Painter, rect: Rect, model: &Model, seen: &Seen) {
    let settings = &model.settings;
    let text = |at: Pos2, align: Align2, text: &str, size: f32, width: f32| {
        let font = FontId::proportional(size);
        let galley = painter.layout(text.to_owned(), font, Color32::WHITE, width);
        let area = align.anchor_size(at, galley.size());
        painter.rect_filled(area.expand2(vec2(6.0, 3.0)), 3.0, Color32::from_black_alpha(150));
        painter.galley(area.min, galley, Color32::WHITE);
    };
    let corner = |right: bool| {
        let x = if right { rect.right() - 12.0 } else { rect.left() + 12.0 };
        (pos2(x, rect.top() + 10.0), if right { Align2::RIGHT_TOP } else { Align2::LEFT_TOP })
    };
    // From where to where each side goes, as parts of the width.
    let spans = match settings.layout {
        Layout::Split => [(0.0, settings.divider), (settings.divider, 1.0)],
        _ => [(0.0, 1.0), (0.0, 1.0)],
    };
    match settings.layout {
        Layout::Single => {}
        Layout::Split => {
            for (way, right) in settings.ways.iter().zip([false, true]) {
                let (at, align) = corner(right);
                text(at, align, &way.to_string(), 13.0, rect.width() * 0.45);
            }
            let x = divider_x(rect, model);
            painter.line_segment(
                [pos2(x, rect.top()), pos2(x, rect.bottom())],
                Stroke::new(3.0, Color32::from_black_alpha(120)),
            );
            painter.line_segment(
                [pos2(x, rect.top()), pos2(x, rect.bottom())],
                Stroke::new(1.0, Color32::WHITE),
            );
            painter.circle(pos2(x, rect.center().y), 7.0, Color32::from_gray(40), Stroke::new(1.5, ACCENT));
        }
        Layout::Difference => {
            let (at, align) = corner(false);
            let title = format!("{} against {}", settings.ways[0], settings.ways[1]);
            text(at, align, &title, 13.0, rect.width() - 36.0);
            if seen.none_objects() {
                overlay::error_legend(painter, rect, settings.error_scale);
            }
        }
    }
    let mut bottom = rect.bottom() - 14.0;
    for (side, (left, right)) in seen.sides.iter().take(settings.shown().len()).zip(spans) {
        if let Some(objection) = &side.objection {
            let at = pos2(rect.left() + rect.width() * 0.5 * (left + right), bottom);
            let width = (rect.width() * (right - left) - 28.0).clamp(60.0, 480.0);
            text(at, Align2::CENTER_BOTTOM, objection, 13.0, width);
            if settings.layout == Layout::Difference {
                bottom -= 64.0;
            }
        }
    }
}
