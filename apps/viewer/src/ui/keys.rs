//! Keys and dropped files.

use egui::{Context, Event};

use crate::model::command::bindings;
use crate::model::document::Source;
use crate::model::{Dialog, Model, Then};

/// Does what the keys ask that were pressed since the last frame; a key that is held repeats.
pub(crate) fn press(context: &Context, model: &mut Model) {
    // While text is written, letters are letters.
    let writing = context.egui_wants_keyboard_input();
    let asked = matches!(model.dialog, Some(Dialog::Open | Dialog::SaveAs | Dialog::Unsaved(_)));
    let commands: Vec<_> = context.input(|input| {
        let pressed = input.events.iter().filter_map(|event| match event {
            Event::Key { key, pressed: true, modifiers, .. } => Some((*key, *modifiers)),
            _ => None,
        });
        pressed
            .filter_map(|(key, held)| bindings().find(|b| b.matches(key, held)))
            .map(|b| b.command)
            .collect()
    });
    for command in commands {
        let always = command == crate::model::command::Command::Escape;
        if always || !(writing || asked) {
            model.apply(command);
        }
    }
}

/// Opens a file that was dropped on the window.
pub(crate) fn drop_files(context: &Context, model: &mut Model) {
    let dropped = context.input(|input| input.raw.dropped_files.first().map(|file| file.path().to_owned()));
    if let Some(path) = dropped {
        model.before(Then::Show(Source::File(path)));
    }
}
