//! Frame times: a plot, what it says in words, and measuring all techniques.

use egui::{Align, Color32, Grid, Layout, RichText, ScrollArea, Ui, Vec2b};
use egui_plot::{Legend, Line, LineStyle, Plot, PlotPoints};

use super::Seen;
use crate::canvas::Side;
use crate::model::Model;
use crate::model::timing::{Frame, MOST_FRAMES, Measured, Track};

/// Width of the words beside the plot, points.
const WORDS: f32 = 330.0;
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
    let (area, _) = ui.allocate_exact_size(ui.available_size(), egui::Sense::hover());
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
        ui.scope_builder(egui::UiBuilder::new().max_rect(rect), |ui| self::plot(ui, model.timing.tracks()));
    }
    ui.scope_builder(egui::UiBuilder::new().max_rect(words), |ui| table(ui, model));
}

fn head(ui: &mut Ui, model: &mut Model, seen: &Seen) {
    ui.horizontal(|ui| {
        ui.label(RichText::new("Frame times").strong());
        ui.add_space(6.0);
        match model.timing.measuring() {
            Some((way, number, of)) => {
                if ui.button("Stop").on_hover_text("Escape").clicked() {
                    model.stop_measuring();
                }
                ui.spinner();
                ui.label(format!("measuring {way}, {number} of {of}"));
            }
            None => {
                let button = ui.button("Measure all");
                if button
                    .on_hover_text("every technique that can show the scene, one after the other")
                    .clicked()
                {
                    model.measure_all();
                }
                if ui.add_enabled(!model.timing.tracks().is_empty(), egui::Button::new("Clear")).clicked() {
                    model.timing.clear();
                }
            }
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if ui.button("Close").on_hover_text("P").clicked() {
                model.stop_measuring();
                model.settings.timing = false;
            }
            ui.add(egui::Label::new(RichText::new(format!("clock: {}", seen.clock)).weak()).truncate());
        });
    });
}

/// The colour of a track.
fn color(index: usize) -> Color32 {
    COLORS[index % COLORS.len()]
}

fn plot(ui: &mut Ui, tracks: &[Track]) {
    let name = |track: &Track| track.way.to_string();
    let plot = Plot::new("frame times")
        .legend(
            Legend::default()
                .position(egui_plot::Corner::LeftTop)
                .background_alpha(0.8)
                .text_style(egui::TextStyle::Small),
        )
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_axis_zoom_drag(false)
        .allow_double_click_reset(false)
        .auto_bounds(Vec2b::new(false, true))
        .default_x_bounds(-(MOST_FRAMES as f64), 0.0)
        .include_y(0.0)
        .set_margin_fraction(egui::vec2(0.0, 0.08))
        .show_x(false)
        .x_axis_formatter(|mark, _| if mark.value == 0.0 { "now".into() } else { format!("{}", mark.value) })
        .y_axis_formatter(|mark, _| format!("{} ms", mark.value))
        .y_axis_min_width(44.0);
    let response = plot.show(ui, |ui| {
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
    let text = "milliseconds of the last frames of each way; dotted: the frame without shadows";
    response
        .response
        .widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "plot of frame times"));
    response.response.on_hover_text(text);
}

/// The medians in words.
fn table(ui: &mut Ui, model: &Model) {
    let tracks: Vec<(usize, &Track, [f64; 2])> =
        model.timing.tracks().iter().enumerate().filter_map(|(i, t)| Some((i, t, t.medians()?))).collect();
    if tracks.is_empty() {
        ui.add_space(8.0);
        ui.weak("Nothing was measured yet.");
        return;
    }
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        let right = |ui: &mut Ui, text: RichText| {
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.label(text));
        };
        Grid::new("medians").num_columns(5).striped(true).spacing([10.0, 3.0]).min_col_width(44.0).show(
            ui,
            |ui| {
                ui.label(RichText::new("median, ms").weak());
                for (title, help) in [
                    ("plain", "the frame without shadows"),
                    ("shadows", "the frame with shadows"),
                    ("ratio", "with shadows to without"),
                    ("frames", "how many were measured"),
                ] {
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                        ui.label(RichText::new(title).weak()).on_hover_text(help);
                    });
                }
                ui.end_row();
                for (i, track, [plain, shadows]) in tracks {
                    let way = track.way.to_string();
                    ui.scope(|ui| {
                        ui.set_max_width(110.0);
                        ui.add(egui::Label::new(RichText::new(&way).color(color(i))).truncate())
                            .on_hover_text(way);
                    });
                    right(ui, RichText::new(format!("{plain:.2}")));
                    right(ui, RichText::new(format!("{shadows:.2}")).strong());
                    right(ui, RichText::new(ratio(plain, shadows)));
                    right(ui, RichText::new(track.frames.len().to_string()).weak());
                    ui.end_row();
                }
            },
        );
    });
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
}
