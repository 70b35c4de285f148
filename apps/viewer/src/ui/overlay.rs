//! What is drawn over the picture: marks of lights, what is chosen, and the legend of errors.

use antumbra::glam::{DQuat, DVec2, DVec3};
use antumbra_scene::{Light, LightKind};
use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Stroke, pos2, vec2};

use super::style::ACCENT;
use crate::canvas::compose::error_color;
use crate::canvas::lines;
use crate::model::Model;
use crate::model::camera::Lens;
use crate::model::pick::{self, Item};

/// A point of the picture in the window.
fn place(rect: Rect, at: DVec2) -> Pos2 {
    pos2(rect.left() + at.x as f32, rect.top() + at.y as f32)
}

/// Marks of the lights, and of the components of the chosen one.
pub(crate) fn marks(painter: &Painter, rect: Rect, lens: &Lens, model: &Model) {
    let moment = model.scene().moment(model.clock.time);
    for (i, light) in moment.lights.iter().enumerate() {
        let Some(at) = pick::mark(model.scene(), &moment, i).and_then(|p| lens.project(p)) else { continue };
        let at = place(rect, at);
        let [r, g, b] = (light.color / light.color.max_element().max(1e-9))
            .to_array()
            .map(|c| (c.clamp(0.0, 1.0).powf(1.0 / 2.2) * 255.0) as u8);
        let color = if light.intensity > 0.0 { Color32::from_rgb(r, g, b) } else { Color32::from_gray(60) };
        let chosen = model.chosen == Some(Item::Light(i));
        let ring = if chosen { ACCENT } else { Color32::from_black_alpha(200) };
        painter.circle_filled(at, 6.5, Color32::from_black_alpha(140));
        painter.circle(at, 5.0, color, Stroke::new(if chosen { 2.0 } else { 1.0 }, ring));
        if i == model.light || chosen {
            painter.circle_stroke(at, 9.0, Stroke::new(1.0, ACCENT));
            let font = FontId::proportional(12.0);
            painter.text(
                at + vec2(13.0, 1.0),
                Align2::LEFT_CENTER,
                &light.name,
                font.clone(),
                Color32::BLACK,
            );
            painter.text(at + vec2(12.0, 0.0), Align2::LEFT_CENTER, &light.name, font, Color32::WHITE);
        }
        if matches!(light.kind, LightKind::Directional { .. }) {
            for k in 0..8 {
                let turn = std::f32::consts::TAU * k as f32 / 8.0;
                let ray = egui::Vec2::angled(turn);
                painter.line_segment([at + ray * 8.0, at + ray * 12.0], Stroke::new(1.5, color));
            }
        }
        if i == model.light {
            for component in model.component_positions(light) {
                if let Some(at) = lens.project(component) {
                    painter.circle(place(rect, at), 3.5, color, Stroke::new(1.0, ACCENT));
                }
            }
        }
    }
}

/// Lines in the world: the outlines of lights, and a box round what is chosen.
pub(crate) fn strokes(model: &Model) -> Vec<lines::Stroke> {
    let mut strokes = Vec::new();
    if !model.settings.marks {
        return strokes;
    }
    let moment = model.scene().moment(model.clock.time);
    for (i, light) in moment.lights.iter().enumerate() {
        let chosen = model.chosen == Some(Item::Light(i));
        let color = if chosen { accent(0.9) } else { [1.0, 1.0, 1.0, 0.45] };
        outline(light, &mut |points, closed| {
            strokes.push(lines::Stroke { points, closed, color, width: 1.2 });
        });
    }
    if let Some(Item::Object(chosen)) = model.chosen {
        let boxes = moment.primitives.iter().filter(|p| p.object == chosen).filter_map(|p| p.bounds());
        if let Some((low, high)) = boxes.reduce(|(a, b), (low, high)| (a.min(low), b.max(high))) {
            push_box(low, high, &mut strokes);
        }
    }
    strokes
}

fn accent(opacity: f32) -> [f32; 4] {
    let [r, g, b, _] = ACCENT.to_array().map(|c| f32::from(c) / 255.0);
    [r, g, b, opacity]
}

/// The edges of a box, a little away from what is in it.
fn push_box(low: DVec3, high: DVec3, strokes: &mut Vec<lines::Stroke>) {
    let margin = 0.02 * (high - low).max_element();
    let (low, high) = (low - margin, high + margin);
    let corner = |i: usize| {
        DVec3::new(
            if i & 1 == 0 { low.x } else { high.x },
            if i & 2 == 0 { low.y } else { high.y },
            if i & 4 == 0 { low.z } else { high.z },
        )
    };
    for i in 0..8 {
        for bit in [1, 2, 4] {
            if i & bit == 0 {
                let points = vec![corner(i), corner(i | bit)];
                strokes.push(lines::Stroke { points, closed: false, color: accent(0.9), width: 1.2 });
            }
        }
    }
}

/// The outline of a light with a shape or a direction.
fn outline(light: &Light, push: &mut dyn FnMut(Vec<DVec3>, bool)) {
    let at = light.position;
    let circle = |axis: DVec3, center: DVec3, radius: f64| -> Vec<DVec3> {
        let side = axis.any_orthonormal_vector() * radius;
        let turn = |k: u32| DQuat::from_axis_angle(axis, f64::from(k) * std::f64::consts::TAU / 48.0);
        (0..48).map(|k| center + turn(k) * side).collect()
    };
    match light.kind {
        LightKind::Point | LightKind::Directional { .. } => {}
        LightKind::Sphere { radius } => {
            for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                push(circle(axis, at, radius), true);
            }
        }
        LightKind::Disc { direction, radius } => {
            push(circle(direction, at, radius), true);
            push(vec![at, at + direction * radius], false);
        }
        LightKind::Rectangle { direction, right, width, height } => {
            let (right, up) = (right * (0.5 * width), direction.cross(right) * (0.5 * height));
            push(vec![at - right - up, at + right - up, at + right + up, at - right + up], true);
            push(vec![at, at + direction * (0.5 * width.min(height))], false);
        }
        LightKind::Spot { direction, outer_angle, .. } => {
            let (reach, angle) = (0.6, outer_angle.min(1.5));
            let rim = circle(direction, at + direction * (reach * angle.cos()), reach * angle.sin());
            for k in [0, 12, 24, 36] {
                push(vec![at, rim[k]], false);
            }
            push(rim, true);
        }
    }
}

/// Which colour is which error.
pub(crate) fn error_legend(painter: &Painter, rect: Rect, scale: f32) {
    let bar = Rect::from_min_size(pos2(rect.left() + 14.0, rect.bottom() - 34.0), vec2(200.0, 12.0));
    painter.rect_filled(
        bar.expand2(vec2(8.0, 6.0)).translate(vec2(0.0, 7.0)).expand2(vec2(6.0, 9.0)),
        3.0,
        Color32::from_black_alpha(170),
    );
    let steps = 100;
    for i in 0..steps {
        let [r, g, b] = error_color(i as f32 / (steps - 1) as f32);
        let x = |i: i32| bar.left() + bar.width() * i as f32 / steps as f32;
        let part = Rect::from_min_max(pos2(x(i), bar.top()), pos2(x(i + 1), bar.bottom()));
        painter.rect_filled(part, 0.0, Color32::from_rgb(r, g, b));
    }
    for (part, align) in [(0.0, Align2::LEFT_TOP), (0.5, Align2::CENTER_TOP), (1.0, Align2::RIGHT_TOP)] {
        let at = pos2(bar.left() + bar.width() * part, bar.bottom() + 3.0);
        painter.text(at, align, format!("{}", scale * part), FontId::proportional(11.0), Color32::WHITE);
    }
}
