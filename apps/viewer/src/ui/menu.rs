//! The menu bar, with time.

use egui::{Button, DragValue, MenuBar, Ui};

use super::fields;
use crate::model::command::{Command, shortcut};
use crate::model::document::Source;
use crate::model::{Model, Then};

/// The bar.
pub(crate) fn bar(ui: &mut Ui, model: &mut Model) {
    MenuBar::new().ui(ui, |ui| {
        ui.menu_button("File", |ui| {
            item(ui, model, "Open…", Command::Open);
            ui.menu_button("Gallery", |ui| gallery(ui, model));
            ui.separator();
            item(ui, model, "Save", Command::Save);
            item(ui, model, "Save as…", Command::SaveAs);
            item(ui, model, "Save picture", Command::Screenshot);
            ui.separator();
            item(ui, model, "Quit", Command::Quit);
        });
        ui.menu_button("Edit", |ui| {
            let (undo, redo) = (model.document.can_undo(), model.document.can_redo());
            ui.add_enabled_ui(undo, |ui| item(ui, model, "Undo", Command::Undo));
            ui.add_enabled_ui(redo, |ui| item(ui, model, "Redo", Command::Redo));
            ui.separator();
            let chosen = model.chosen.is_some();
            ui.add_enabled_ui(chosen, |ui| item(ui, model, "Duplicate", Command::Duplicate));
            ui.add_enabled_ui(chosen, |ui| item(ui, model, "Delete", Command::Delete));
        });
        ui.menu_button("View", |ui| {
            item(ui, model, "Everything in view", Command::FrameAll);
            item(ui, model, "Camera of the scene", Command::ResetCamera);
            ui.separator();
            item(ui, model, "Panel", Command::Panel);
            item(ui, model, "Frame times", Command::Timing);
            ui.checkbox(&mut model.settings.marks, "Marks");
            item(ui, model, "Whole screen", Command::Fullscreen);
            ui.separator();
            if ui.button("Reset settings").clicked() {
                model.reset_settings();
                ui.close();
            }
        });
        if ui.button("Help").on_hover_text("F1").clicked() {
            model.apply(Command::Help);
        }
        ui.separator();
        time(ui, model);
    });
}

fn item(ui: &mut Ui, model: &mut Model, text: &str, command: Command) {
    if ui.add(Button::new(text).shortcut_text(shortcut(command))).clicked() {
        model.apply(command);
        ui.close();
    }
}

fn gallery(ui: &mut Ui, model: &mut Model) {
    for i in 0..model.gallery.len() {
        let name = model.gallery[i].name;
        let here = *model.document.source() == Source::Gallery(name.to_owned());
        if ui.selectable_label(here, name).clicked() {
            model.before(Then::Show(Source::Gallery(name.to_owned())));
            ui.close();
        }
    }
}

fn time(ui: &mut Ui, model: &mut Model) {
    let play = if model.clock.playing { "Pause" } else { "Play" };
    if ui.button(play).on_hover_text("Space").clicked() {
        model.apply(Command::PlayPause);
    }
    if ui.button("Rewind").on_hover_text("R").clicked() {
        model.apply(Command::Rewind);
    }
    let label = ui.label("time");
    ui.add(
        DragValue::new(&mut model.clock.time)
            .custom_parser(fields::finite)
            .speed(0.02)
            .fixed_decimals(2)
            .suffix(" s"),
    )
    .labelled_by(label.id);
    let label = ui.label("speed");
    ui.add(
        DragValue::new(&mut model.clock.speed)
            .custom_parser(fields::finite)
            .speed(0.02)
            .range(-16.0..=16.0)
            .suffix(" ×"),
    )
    .labelled_by(label.id);
    model.clock = model.clock.sane();
}
