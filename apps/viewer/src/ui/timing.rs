//! Frame times: a plot, what it says in words, and measuring all techniques.

use egui::text::{LayoutJob, TextWrapping};
use egui::{
    Align, Align2, Button, Color32, FontId, Label, Layout, Rangef, Response, RichText, Role, ScrollArea,
    Sense, TextStyle, Ui, UiBuilder, Vec2b, WidgetInfo, vec2,
};
use egui_plot::{Corner, GridMark, Legend, Line, LineStyle, Plot, PlotPoints};

use super::Seen;
use crate::canvas::Side;
use crate::model::Model;
use crate::model::timing::{ENOUGH, Frame, Measured, Track};

/// Width of the words beside the plot, points.
const WORDS: f32 = 324.0;
/// The least width at which a plot says anything, points.
const LEAST_PLOT: f32 = 180.0;

/// Colours that also those can tell apart who see few (Okabe and Ito), with lighter ones for a dark ground.
const COLORS: [Color32; 7] = [
    Color32::from_rgb(230, 159, 0),
    Color32::from_rgb(86, 180, 233),
    Color32::from_rgb(0, 184, 135),
    Color32::from_rgb(240, 228, 66),
    Color32::from_rgb(236, 112, 50),
    Color32::from_rgb(204, 121, 167),
    Color32::from_rgb(190, 190, 190),
];

/// Takes note of what a frame took.
pub(crate) fn note(model: &mut Model, sides: &[Side; 2], size: [i32; 2]) {
    let measured: Vec<Measured> = model
        .settings
        .shown()
        .iter()
        .zip(sides)
        .map(|(way, side)| Measured {
            way: *way,
            objects: side.objection.is_some(),
            milliseconds: side.milliseconds.filter(|_| side.fresh),
        })
        .collect();
    let (lights, objects) = (model.scene().lights.len(), model.scene().objects.len());
    let frame = Frame { size, lights, objects, sides: &measured };
    model.timing.note(frame, &mut model.settings, &mut model.clock);
}

/// The panel.
pub(crate) fn show(ui: &mut Ui, model: &mut Model, seen: &Seen) {
    ui.add_space(3.0);
    head(ui, model, seen);
    ui.add_space(2.0);
    let (area, _) = ui.allocate_exact_size(ui.available_size(), Sense::hover());
    if area.width() < 1.0 || area.height() < 1.0 {
        return;
    }
    let gap = ui.spacing().item_spacing.x * 2.0;
    let has_plot = area.width() >= WORDS + gap + LEAST_PLOT;
    let (words, plot) = if has_plot {
        let (plot, words) = area.split_left_right_at_x(area.right() - WORDS);
        (words, Some(plot.with_max_x(plot.right() - gap)))
    } else {
        (area, None)
    };
    if let Some(rect) = plot {
        ui.scope_builder(UiBuilder::new().max_rect(rect), |ui| self::plot(ui, model.timing.tracks()));
    }
    ui.scope_builder(UiBuilder::new().max_rect(words), |ui| table(ui, model));
}

fn head(ui: &mut Ui, model: &mut Model, seen: &Seen) {
    ui.horizontal(|ui| {
        // Buttons come first where there is no room for more.
        let is_narrow = ui.available_width() < 320.0;
        if !is_narrow {
            ui.label(RichText::new("Frame times").strong());
            ui.add_space(6.0);
        }
        match model.timing.measuring() {
            Some((way, number, of)) => {
                if ui.button("Stop").on_hover_text("Escape").clicked() {
                    model.stop_measuring();
                }
                ui.spinner();
                let text = format!("measuring {way}, {number} of {of}");
                let room = (ui.available_width() - 60.0).max(0.0);
                ui.scope(|ui| {
                    ui.set_max_width(room);
                    ui.add(Label::new(text).truncate());
                });
            }
            None => {
                let button = ui.button("Measure all");
                if button
                    .on_hover_text("every technique that can show the scene, one after the other")
                    .clicked()
                {
                    model.measure_all();
                }
                let has_any = !model.timing.tracks().is_empty();
                if !is_narrow && ui.add_enabled(has_any, Button::new("Clear")).clicked() {
                    model.timing.clear();
                }
            }
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if ui.button("Close").on_hover_text("P").clicked() {
                model.stop_measuring();
                model.settings.timing = false;
            }
            if !is_narrow {
                ui.add(Label::new(RichText::new(format!("clock: {}", seen.clock)).weak()).truncate());
            }
        });
    });
}

/// The colour of a track.
fn color(index: usize) -> Color32 {
    COLORS[index % COLORS.len()]
}

fn plot(ui: &mut Ui, tracks: &[Track]) {
    let name = |track: &Track| track.way.to_string();
    // Few frames fill the plot as many do.
    let most = tracks.iter().map(|track| track.frames.len()).max().unwrap_or(0).max(ENOUGH);
    let caption = 16.0;
    let legend = Legend::default()
        .position(Corner::LeftTop)
        .background_alpha(0.8)
        .text_style(TextStyle::Small)
        .follow_insertion_order(true);
    let plot = Plot::new("frame times")
        .legend(legend)
        .height(ui.available_height() - caption - ui.spacing().item_spacing.y)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_axis_zoom_drag(false)
        .allow_double_click_reset(false)
        .show_axes(Vec2b::new(false, true))
        .show_grid(Vec2b::new(false, true))
        .grid_color(Color32::from_gray(52))
        .show_x(false)
        .auto_bounds(Vec2b::new(false, true))
        .include_y(0.0)
        .set_margin_fraction(vec2(0.0, 0.08))
        .grid_spacing(Rangef::new(8.0, 20.0))
        .y_grid_spacer(|input| ticks(input.bounds.1))
        .y_axis_formatter(|mark, _| format!("{} ms", mark.value as f32))
        .y_axis_min_width(48.0);
    let response = plot.show(ui, |ui| {
        ui.set_plot_bounds_x(1.0 - most as f64..=0.0);
        for (i, track) in tracks.iter().enumerate() {
            let points = |side: usize| -> PlotPoints<'_> {
                let first = 1.0 - track.frames.len() as f64;
                track.frames.iter().enumerate().map(|(k, frame)| [first + k as f64, frame[side]]).collect()
            };
            let plain = Line::new(name(track), points(0)).id(("plain", i)).color(color(i)).width(1.0);
            ui.line(plain.style(LineStyle::dotted_dense()).allow_hover(false));
            ui.line(Line::new(name(track), points(1)).id(("shadows", i)).color(color(i)).width(1.8));
        }
    });
    response.response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "plot of frame times"));
    ui.with_layout(Layout::right_to_left(Align::Min), |ui| {
        let text = format!("last {most} frames; dotted: without shadows");
        ui.add(Label::new(RichText::new(text).size(11.0).weak()).truncate());
    });
}

/// Round numbers from 0 up to the highest, not too many.
fn ticks(highest: f64) -> Vec<GridMark> {
    if !(highest > 0.0 && highest.is_finite()) {
        return Vec::new();
    }
    let power = 10f64.powf((highest / 4.0).log10().floor());
    let step =
        [1.0, 2.0, 5.0, 10.0].map(|n| n * power).into_iter().find(|s| highest / s <= 4.5).unwrap_or(highest);
    (0..5)
        .map(|k| GridMark { value: f64::from(k) * step, step_size: step })
        .filter(|m| m.value <= highest)
        .collect()
}

/// Right edges of the columns with numbers, points.
const EDGES: [f32; 4] = [150.0, 206.0, 259.0, WORDS - 14.0];
/// How high a line of the table is, points.
const ROW: f32 = 19.0;

/// The medians in words.
fn table(ui: &mut Ui, model: &Model) {
    let tracks: Vec<(usize, &Track, [f64; 2])> =
        model.timing.tracks().iter().enumerate().filter_map(|(i, t)| Some((i, t, t.medians()?))).collect();
    if tracks.is_empty() {
        ui.add_space(8.0);
        ui.weak("Nothing was measured yet.");
        return;
    }
    ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 0.0;
        let (weak, text) = (ui.visuals().weak_text_color(), ui.visuals().text_color());
        let head = ["plain", "shadows", "ratio", "frames"].map(|title| (title.to_owned(), weak));
        let response = line(ui, ("median, ms", weak), head, false);
        response.on_hover_text(
            "of the frame without shadows and with them, their ratio, and how many were measured",
        );
        for (k, (i, track, [plain, shadows])) in tracks.into_iter().enumerate() {
            let (way, frames, ratio) = (track.way.to_string(), track.frames.len(), ratio(plain, shadows));
            let cells = [
                (format!("{plain:.2}"), text),
                (format!("{shadows:.2}"), ui.visuals().strong_text_color()),
                (ratio.clone(), text),
                (frames.to_string(), weak),
            ];
            let response = line(ui, (&way, color(i)), cells, k % 2 == 0);
            let said = format!(
                "{way}: {plain:.2} ms without shadows, {shadows:.2} ms with them, {ratio}, {frames} frames"
            );
            response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &said));
            response.on_hover_text(said);
        }
    });
}

/// A line of the table: a name at the left and numbers at the right of their columns.
fn line(ui: &mut Ui, name: (&str, Color32), cells: [(String, Color32); 4], shaded: bool) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(WORDS - 8.0, ROW), Sense::hover());
    let painter = ui.painter_at(rect);
    if shaded {
        painter.rect_filled(rect, 2.0, ui.visuals().faint_bg_color);
    }
    let font = FontId::proportional(12.5);
    let mut job = LayoutJob::simple_singleline(name.0.to_owned(), font.clone(), name.1);
    job.wrap = TextWrapping::truncate_at_width(EDGES[0] - 50.0);
    let galley = painter.layout_job(job);
    let at = Align2::LEFT_CENTER.anchor_size(rect.left_center() + vec2(4.0, 0.0), galley.size());
    painter.galley(at.min, galley, name.1);
    for (edge, (text, color)) in EDGES.into_iter().zip(cells) {
        painter.text(rect.left_center() + vec2(edge, 0.0), Align2::RIGHT_CENTER, text, font.clone(), color);
    }
    response
}

/// How many times as long a frame takes with shadows.
fn ratio(plain: f64, shadows: f64) -> String {
    if plain > 0.0 { format!("{:.2} ×", shadows / plain) } else { "–".into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios() {
        assert_eq!(ratio(2.0, 3.0), "1.50 ×", "with to without");
        assert_eq!(ratio(0.0, 3.0), "–", "of a clock that did not move");
    }

    #[test]
    fn ticks_are_round_and_few() {
        let values = |highest| ticks(highest).iter().map(|mark| mark.value).collect::<Vec<_>>();
        assert_eq!(values(150.0), [0.0, 50.0, 100.0, 150.0], "of many milliseconds");
        assert_eq!(values(0.9), [0.0, 0.2, 0.4, 0.6000000000000001, 0.8], "of few");
        assert!(
            values(f64::NAN).is_empty() && values(0.0).is_empty() && values(f64::MAX).len() <= 5,
            "of none"
        );
    }
}
