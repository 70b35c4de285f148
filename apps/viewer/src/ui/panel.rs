//! The panel at the side.

use antumbra::Allowed;
use antumbra::{Pattern, Soft, Technique};
use egui::{CollapsingHeader, ComboBox, DragValue, ScrollArea, Slider, Ui};

use super::{Seen, lights, objects, teaching};
use crate::model::Model;
use crate::model::settings::{Antialiasing, ERROR_SCALES, Layout, ZOOMS};
use crate::model::way::Way;

/// Everything in it.
pub(crate) fn show(ui: &mut Ui, model: &mut Model, seen: &mut Seen) {
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        // What is too wide is wrapped: the panel is as wide as the user made it.
        ui.set_max_width(ui.available_width() - 4.0);
        CollapsingHeader::new("Shadows").default_open(true).show(ui, |ui| shadows(ui, model));
        CollapsingHeader::new("Lights").default_open(true).show(ui, |ui| lights::show(ui, model, seen));
        CollapsingHeader::new("Objects").default_open(true).show(ui, |ui| objects::show(ui, model, seen));
        CollapsingHeader::new("Teaching")
            .default_open(true)
            .show(ui, |ui| teaching::section(ui, model, seen));
        CollapsingHeader::new("Settings").show(ui, |ui| settings(ui, model));
    });
}

fn shadows(ui: &mut Ui, model: &mut Model) {
    let settings = &mut model.settings;
    ui.horizontal(|ui| {
        for layout in Layout::ALL {
            ui.selectable_value(&mut settings.layout, layout, layout.name());
        }
    });
    let count = settings.shown().len();
    for (i, way) in settings.ways.iter_mut().take(count).enumerate() {
        let label = match (settings.layout, i) {
            (Layout::Single, _) => "technique",
            (Layout::Split, 0) => "left",
            (Layout::Split, _) => "right",
            (Layout::Difference, 0) => "error of",
            (Layout::Difference, _) => "against",
        };
        ui.push_id(i, |ui| self::way(ui, label, way));
    }
    if settings.layout == Layout::Difference {
        ui.horizontal(|ui| {
            let label = ui.label("brightest");
            ui.add(Slider::new(&mut settings.error_scale, ERROR_SCALES).logarithmic(true))
                .labelled_by(label.id);
        });
    }
}

/// How things are drawn.
fn settings(ui: &mut Ui, model: &mut Model) {
    let settings = &mut model.settings;
    ui.checkbox(&mut settings.marks, "marks");
    ui.checkbox(&mut settings.dither, "dithering")
        .on_hover_text("A little noise against bands in dark gradients");
    ui.checkbox(&mut settings.vsync, "wait for the screen (vsync)");
    ui.horizontal(|ui| {
        let label = ui.label("antialiasing");
        let name = match settings.antialiasing {
            Antialiasing::Auto => "auto".to_owned(),
            Antialiasing::Samples(n) => n.to_string(),
        };
        let combo = ComboBox::from_id_salt("antialiasing").selected_text(name).show_ui(ui, |ui| {
            ui.selectable_value(&mut settings.antialiasing, Antialiasing::Auto, "auto");
            for n in [1, 2, 4, 8] {
                ui.selectable_value(&mut settings.antialiasing, Antialiasing::Samples(n), n.to_string());
            }
        });
        combo.response.labelled_by(label.id);
    });
    ui.horizontal(|ui| {
        let label = ui.label("size of the interface");
        let zoom = DragValue::new(&mut settings.zoom).range(ZOOMS).speed(0.01).update_while_editing(false);
        ui.add(zoom).labelled_by(label.id);
    });
    if ui.button("Reset settings").clicked() {
        model.reset_settings();
    }
}

/// A way with its options.
fn way(ui: &mut Ui, label: &str, way: &mut Way) {
    ui.horizontal(|ui| {
        let label = ui.label(label);
        let combo = ComboBox::from_id_salt("way").selected_text(way.name()).show_ui(ui, |ui| {
            for other in Way::all() {
                let chosen = other.name() == way.name();
                if ui.selectable_label(chosen, other.name()).on_hover_text(other.summary()).clicked()
                    && !chosen
                {
                    *way = match (other, *way) {
                        (Way::Technique(technique, _), Way::Technique(_, soft)) => {
                            Way::Technique(technique, soft)
                        }
                        (other, _) => other,
                    };
                }
            }
        });
        combo.response.labelled_by(label.id).on_hover_text(way.summary());
    });
    if let Way::Technique(technique, soft) = way {
        self::soft(ui, soft);
        options(ui, technique);
    }
}

/// How lights with an area are drawn.
fn soft(ui: &mut Ui, soft: &mut Soft) {
    ui.horizontal(|ui| {
        let label = ui.label("area lights");
        let name = match soft {
            Soft::Samples { pattern: Pattern::Row, .. } => "samples in a row",
            Soft::Samples { .. } => "samples",
            _ => "its own way",
        };
        let count = match *soft {
            Soft::Samples { count, .. } => count,
            _ => 16,
        };
        let combo = ComboBox::from_id_salt("soft").selected_text(name).show_ui(ui, |ui| {
            ui.selectable_value(soft, Soft::Native, "its own way");
            ui.selectable_value(soft, Soft::Samples { count, pattern: Pattern::Spread }, "samples");
            ui.selectable_value(soft, Soft::Samples { count, pattern: Pattern::Row }, "samples in a row");
        });
        combo.response.labelled_by(label.id);
        if let Soft::Samples { count, .. } = soft {
            let value = DragValue::new(count).range(1..=256);
            ui.add(value).labelled_by(label.id);
        }
    });
}

/// The options of a technique, whichever it is.
fn options(ui: &mut Ui, technique: &mut Technique) {
    for option in technique.options() {
        let mut set = |text: String| {
            // What the controls offer is what the option takes.
            if let Err(error) = technique.set(option.key, &text) {
                log::error!("{error}");
            }
        };
        ui.horizontal(|ui| {
            let label = ui.label(option.key).on_hover_text(option.help);
            match option.allowed {
                Allowed::Switch => {
                    let mut on = option.value == "on";
                    if ui.checkbox(&mut on, "").labelled_by(label.id).changed() {
                        set(if on { "on" } else { "off" }.into());
                    }
                }
                Allowed::Choice(choices) => {
                    let id = ui.scope_id().with(option.key);
                    let combo = ComboBox::from_id_salt(id).selected_text(&option.value).show_ui(ui, |ui| {
                        for choice in choices {
                            let chosen = option.value == choice.name;
                            if ui.selectable_label(chosen, choice.name).on_hover_text(choice.help).clicked() {
                                set(choice.name.into());
                            }
                        }
                    });
                    combo.response.labelled_by(label.id);
                }
                Allowed::Number { low, high, whole } => {
                    let mut value: f64 = option.value.parse().unwrap_or(low);
                    let slider = Slider::new(&mut value, low..=high).logarithmic(high > 100.0);
                    let slider = if whole { slider.integer() } else { slider };
                    if ui.add(slider).labelled_by(label.id).changed() {
                        set(if whole {
                            format!("{}", value.round() as i64)
                        } else {
                            format!("{}", value as f32)
                        });
                    }
                }
                _ => {}
            }
        });
    }
}
