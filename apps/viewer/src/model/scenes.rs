//! Opening, saving and leaving scenes, with questions where something would be lost.

use std::path::Path;

use super::document::{Document, Source};
use super::{Dialog, Model, Request, Then};

impl Model {
    /// Does something that loses changes, after asking.
    pub(crate) fn before(&mut self, then: Then) {
        self.after_save = None;
        if self.document.is_modified() {
            self.dialog = Some(Dialog::Unsaved(then));
        } else {
            self.go_on(then);
        }
    }

    /// Does it without asking.
    pub(crate) fn go_on(&mut self, then: Then) {
        self.dialog = None;
        match then {
            Then::Quit => self.requests.push(Request::Quit),
            Then::Show(source) => self.show(source),
            Then::Open => self.dialog = Some(Dialog::Open),
        }
    }

    /// Saves, and then goes on. Where there is no file yet, or it cannot be written, asks for one first.
    pub(crate) fn save_then(&mut self, then: Then) {
        match self.document.source().clone() {
            Source::File(path) if self.save(&path) => self.go_on(then),
            _ => self.save_as(Some(then)),
        }
    }

    /// Asks where to save.
    pub(super) fn save_as(&mut self, then: Option<Then>) {
        self.dialog = Some(Dialog::SaveAs);
        self.after_save = then;
    }

    /// Saves where the user said, and does what was to be done then; whether that worked.
    pub(crate) fn save_here(&mut self, path: &Path) -> bool {
        let saved = self.save(path);
        if saved {
            let then = self.after_save.take();
            self.dialog = None;
            if let Some(then) = then {
                self.go_on(then);
            }
        }
        saved
    }

    /// Closes the dialog; what was to be done after it is not done.
    pub(crate) fn close(&mut self) {
        self.dialog = None;
        self.after_save = None;
    }

    /// Looks at another scene; the old one stays where that cannot be read.
    pub(crate) fn show(&mut self, source: Source) {
        let document = match &source {
            Source::File(path) => Document::load(path).map_err(|error| error.to_string()),
            Source::Gallery(name) => match self.gallery.iter().find(|scene| scene.name == name) {
                Some(entry) => entry.document().map_err(|error| error.to_string()),
                None => Err(format!("the gallery has no scene {name}")),
            },
        };
        match document {
            Ok(document) => {
                self.first_camera = document.scene().camera;
                self.document = document;
                self.clock.time = 0.0;
                self.light = 0;
                self.component = None;
                self.chosen = None;
                self.parked.clear();
                self.message = None;
                self.stop_measuring();
                self.timing.clear();
            }
            Err(error) => self.complain(error),
        }
    }

    /// Writes the scene to a file; whether that worked.
    pub(crate) fn save(&mut self, path: &Path) -> bool {
        match self.document.save(path) {
            Ok(()) => {
                self.say(format!("saved {}", path.display()));
                true
            }
            Err(error) => {
                self.complain(error);
                false
            }
        }
    }

    pub(super) fn next_scene(&mut self, forward: bool) {
        let count = self.gallery.len();
        if count == 0 {
            return self.complain("the gallery is empty");
        }
        let here = match self.document.source() {
            Source::Gallery(name) => self.gallery.iter().position(|scene| scene.name == name),
            Source::File(_) => None,
        };
        let next = match here {
            Some(here) => (here + if forward { 1 } else { count - 1 }) % count,
            None if forward => 0,
            None => count - 1,
        };
        self.before(Then::Show(Source::Gallery(self.gallery[next].name.to_owned())));
    }
}
