//! The question what to do with changes before they are lost.

use egui::Context;

use super::dialog;
use crate::model::{Model, Then};

/// Asks, and does what the user says.
pub(crate) fn show(context: &Context, model: &mut Model, then: &Then) {
    let name = model.document.source().name();
    let before = match then {
        Then::Quit => "the program ends",
        Then::Show(_) => "another scene is shown",
        Then::Open => "another file is opened",
    };
    dialog::modal(context, "Unsaved changes", 420.0, |ui| {
        ui.set_min_width(ui.available_width());
        dialog::title(ui, "Unsaved changes");
        ui.label(format!("The changes to {name} are lost unless they are saved before {before}."));
        dialog::buttons(ui, |ui| {
            let save = ui.button("Save");
            if ui.memory(|memory| memory.focused().is_none()) {
                save.request_focus();
            }
            if save.clicked() {
                model.save_then(then.clone());
            }
            if ui.button("Don't save").clicked() {
                model.go_on(then.clone());
            }
            if ui.button("Cancel").clicked() {
                model.close();
            }
        });
    });
}
