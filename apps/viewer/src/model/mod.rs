//! What the program knows, apart from windows and OpenGL.

pub(crate) mod camera;
mod changes;
pub(crate) mod clock;
mod collection;
pub(crate) mod command;
pub(crate) mod document;
pub(crate) mod edit;
pub(crate) mod files;
pub(crate) mod pick;
mod scenes;
pub(crate) mod settings;
pub(crate) mod timing;
pub(crate) mod way;

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

use antumbra_scene::{Camera, Motion, Scene};

use crate::GalleryScene;
use clock::Clock;
use command::{Command, STEP};
use document::{Document, Source};
use pick::Item;
use settings::{Layout, Settings};
use timing::Timing;
use way::Way;

/// What the window is asked to do.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Request {
    /// End.
    Quit,
    /// Change between a window and the whole screen.
    Fullscreen,
    /// Write the picture to this file.
    Screenshot(PathBuf),
}

/// A question or a list over the picture.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Dialog {
    /// The keys.
    Help,
    /// Which file to open.
    Open,
    /// Where to save.
    SaveAs,
    /// What to do with changes that were not saved, before something else is done.
    Unsaved(Then),
}

/// What was to be done when changes were found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Then {
    /// End.
    Quit,
    /// Look at another scene.
    Show(Source),
    /// Ask for a file to open.
    Open,
}

/// A line for the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Message {
    /// The text.
    pub(crate) text: String,
    /// Whether something went wrong.
    pub(crate) is_error: bool,
}

/// Motions of things that were told to stand still, by kind and name, for when they move again.
pub(crate) type Parked = HashMap<(&'static str, String), Motion>;

/// Which component of the chosen light the keys move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    /// The one farthest along -X.
    Left,
    /// The one farthest along +X.
    Right,
}

/// All of it.
pub(crate) struct Model {
    /// The scene.
    pub(crate) document: Document,
    /// What is looked at.
    pub(crate) settings: Settings,
    /// Its time.
    pub(crate) clock: Clock,
    /// The light that keys move.
    pub(crate) light: usize,
    /// Its component that keys move, if not the light.
    pub(crate) component: Option<Side>,
    /// What is chosen, for the pointer, the panel and `Delete`.
    pub(crate) chosen: Option<Item>,
    /// Motions that were taken away.
    pub(crate) parked: Parked,
    /// What is asked.
    pub(crate) dialog: Option<Dialog>,
    /// What is to be done after "Save as".
    pub(crate) after_save: Option<Then>,
    /// How long frames take.
    pub(crate) timing: Timing,
    /// What was said last.
    pub(crate) message: Option<Message>,
    /// For the window.
    pub(crate) requests: Vec<Request>,
    /// Scenes that are part of the program.
    pub(crate) gallery: Vec<GalleryScene>,
    /// The camera that the scene came with.
    first_camera: Camera,
    /// Width over height of the picture.
    pub(crate) aspect: f64,
}

impl Model {
    /// Looks at a scene.
    pub(crate) fn new(document: Document, settings: Settings, gallery: Vec<GalleryScene>) -> Self {
        let first_camera = document.scene().camera;
        Self {
            document,
            settings: settings.sane(),
            clock: Clock::default(),
            light: 0,
            component: None,
            chosen: None,
            parked: Parked::default(),
            dialog: None,
            after_save: None,
            timing: Timing::default(),
            message: None,
            requests: Vec::new(),
            gallery,
            first_camera,
            aspect: 1.0,
        }
    }

    /// The scene.
    pub(crate) fn scene(&self) -> &Arc<Scene> {
        self.document.scene()
    }

    /// Says something.
    pub(crate) fn say(&mut self, text: impl Into<String>) {
        self.message = Some(Message { text: text.into(), is_error: false });
    }

    /// Says what went wrong.
    pub(crate) fn complain(&mut self, text: impl ToString) {
        self.message = Some(Message { text: text.to_string(), is_error: true });
    }

    /// Does what a key or a menu asks.
    pub(crate) fn apply(&mut self, command: Command) {
        // What was said was about something before.
        self.message = None;
        match command {
            Command::Shape(shape) => {
                let chosen = match self.chosen {
                    Some(Item::Object(i)) => Some(i),
                    _ => None,
                };
                match edit::shadowed_object(self.scene(), chosen) {
                    Some(i) => self.document.edit(("shape", i), |s| edit::reshape(&mut s.objects[i], shape)),
                    None => self.complain("no object casts a shadow; add one in the panel"),
                }
                self.document.end_stroke();
            }
            Command::MoveCamera(by) => {
                self.document.look(camera::step(&self.scene().camera, by * STEP));
            }
            Command::MoveLight(by) => self.move_light(by * STEP),
            Command::First => self.choose_side(Side::Left, 0),
            Command::Second => self.choose_side(Side::Right, 1),
            Command::ChooseLight(i) => self.choose_light(i),
            Command::PlayPause => self.clock.playing = !self.clock.playing,
            Command::Rewind => self.clock.time = 0.0,
            Command::Speed(factor) => {
                self.clock.scale_speed(factor);
                self.say(format!("{} times as fast", (self.clock.speed * 1e4).round() / 1e4));
            }
            Command::NextWay(forward) => self.settings.ways[0] = self.settings.ways[0].neighbour(forward),
            Command::NextLayout => {
                let here = Layout::ALL.iter().position(|l| *l == self.settings.layout).unwrap_or(0);
                self.settings.layout = Layout::ALL[(here + 1) % Layout::ALL.len()];
            }
            Command::Swap => self.settings.ways.swap(0, 1),
            Command::FrameAll => {
                let moment = self.scene().moment(self.clock.time);
                self.document.look(camera::frame(&self.scene().camera, &moment, self.aspect));
            }
            Command::ResetCamera => self.document.look(self.first_camera),
            Command::Delete => self.delete(),
            Command::Duplicate => self.duplicate(),
            Command::Undo => self.undo(),
            Command::Redo => self.redo(),
            Command::Open => self.before(Then::Open),
            Command::NextScene(forward) => self.next_scene(forward),
            Command::Save => match self.document.source().clone() {
                Source::File(path) => drop(self.save(&path)),
                Source::Gallery(_) => self.save_as(None),
            },
            Command::SaveAs => self.save_as(None),
            Command::Screenshot => self.requests.push(Request::Screenshot(screenshot_path())),
            Command::Help => {
                self.dialog = if self.dialog == Some(Dialog::Help) { None } else { Some(Dialog::Help) };
            }
            Command::Panel => self.settings.panel = !self.settings.panel,
            Command::Timing => {
                self.stop_measuring();
                self.settings.timing = !self.settings.timing;
            }
            Command::Fullscreen => self.requests.push(Request::Fullscreen),
            Command::Escape => {
                if self.dialog.is_some() {
                    self.close();
                } else if self.timing.measuring().is_some() {
                    self.stop_measuring();
                } else {
                    self.chosen = None;
                    self.component = None;
                }
            }
            Command::Quit => self.before(Then::Quit),
        }
    }

    /// Chooses a light.
    pub(crate) fn choose_light(&mut self, light: usize) {
        if light < self.scene().lights.len() {
            self.light = light;
            self.component = None;
            self.chosen = Some(Item::Light(light));
        } else {
            self.complain(format!("there is no light {}", light + 1));
        }
    }

    /// Chooses what the pointer or the panel says.
    pub(crate) fn choose(&mut self, item: Option<Item>) {
        match item {
            Some(Item::Light(i)) => self.choose_light(i),
            item => self.chosen = item,
        }
    }

    /// Whether a frame differs from the last one although nobody did anything.
    pub(crate) fn is_moving(&self) -> bool {
        let moves = || {
            let scene = self.scene();
            scene.lights.iter().any(|l| l.motion.is_some())
                || scene.objects.iter().any(|o| o.motion.is_some())
        };
        self.clock.playing && self.clock.speed != 0.0 && moves()
    }

    /// Measures every technique, one after the other; time stands still meanwhile.
    pub(crate) fn measure_all(&mut self) {
        self.stop_measuring();
        self.settings.timing = true;
        self.timing.start(&mut self.settings, &mut self.clock);
    }

    /// Ends that, and puts back what was looked at before.
    pub(crate) fn stop_measuring(&mut self) {
        self.timing.stop(&mut self.settings, &mut self.clock);
    }

    /// Everything as it is at first, but for the scene.
    pub(crate) fn reset_settings(&mut self) {
        self.stop_measuring();
        self.settings = Settings::default();
        self.clock.speed = 1.0;
        self.say("settings as at first");
    }

    /// The ways that need the reference.
    pub(crate) fn needs_reference(&self) -> bool {
        self.settings.shown().contains(&Way::Raytraced)
    }
}

/// A file for a picture that is not there yet.
fn screenshot_path() -> PathBuf {
    let name = |i: u32| PathBuf::from(format!("antumbra-{i:03}.png"));
    (1..1000).map(name).find(|path| !path.exists()).unwrap_or_else(|| name(1000))
}

#[cfg(test)]
mod tests;
