//! Dialogs over everything else: which one is open.

use egui::Context;

use super::{Seen, files, help, unsaved};
use crate::model::files::Purpose;
use crate::model::{Dialog, Model};

/// Shows the dialog that is open, if there is one.
pub(crate) fn show(context: &Context, model: &mut Model, seen: &mut Seen) {
    if !matches!(model.dialog, Some(Dialog::Open | Dialog::SaveAs)) {
        seen.files = None;
    }
    match model.dialog.clone() {
        None => {}
        Some(Dialog::Help) => help::show(context, model),
        Some(Dialog::Open) => files::show(context, model, seen, Purpose::Open),
        Some(Dialog::SaveAs) => files::show(context, model, seen, Purpose::Save),
        Some(Dialog::Unsaved(then)) => unsaved::show(context, model, &then),
    }
}
