//! What the program knows, apart from windows and OpenGL.

pub(crate) mod camera;
pub(crate) mod clock;
pub(crate) mod command;
pub(crate) mod document;
pub(crate) mod edit;
pub(crate) mod files;
pub(crate) mod pick;
pub(crate) mod settings;
pub(crate) mod timing;
pub(crate) mod way;

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use antumbra::glam::DVec3;
use antumbra::technique::composite::{Component, components};
use antumbra_scene::{Camera, Light, Motion, Scene};

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
    /// Components that were moved: for each such light all but the central one, from its position.
    pub(crate) components: Vec<Component>,
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
            components: Vec::new(),
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
                self.clock.speed = (self.clock.speed * factor).clamp(-16.0, 16.0);
                self.say(format!("{} times as fast", self.clock.speed));
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
    fn save_as(&mut self, then: Option<Then>) {
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
                self.components.clear();
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

    /// `G` and `H`: a component where the chosen light is a collection of them, else a light.
    fn choose_side(&mut self, side: Side, light: usize) {
        if self.side_components().is_empty() {
            self.choose_light(light);
        } else {
            self.component = Some(side);
            self.chosen = Some(Item::Light(self.light));
        }
    }

    /// Where the components of the chosen light are, but for the central one; empty unless it is a collection.
    fn side_components(&self) -> Vec<DVec3> {
        let own: Vec<DVec3> =
            self.components.iter().filter(|c| c.light == self.light).map(|c| c.offset).collect();
        let (Some(count), Some(light)) = (self.settings.components(), self.scene().lights.get(self.light))
        else {
            return Vec::new();
        };
        if !own.is_empty() && antumbra_host::light(light).area != antumbra::Area::None {
            return own;
        }
        let mut offsets = Vec::new();
        components(&antumbra_host::light(light).area, count, |offset| offsets.push(offset));
        offsets.drain(..offsets.len().min(1));
        offsets
    }

    /// The component that is chosen, by its place among the side components, and where they are.
    fn chosen_component(&self) -> Option<(usize, Vec<DVec3>)> {
        let offsets = self.side_components();
        let by_x = |a: &usize, b: &usize| offsets[*a].x.total_cmp(&offsets[*b].x);
        let index = match self.component? {
            Side::Left => (0..offsets.len()).min_by(by_x)?,
            Side::Right => (0..offsets.len()).max_by(by_x)?,
        };
        Some((index, offsets))
    }

    /// Where the components of lights are that are drawn as collections: for marks in the picture.
    pub(crate) fn component_positions(&self, light: &Light) -> Vec<DVec3> {
        self.side_components().into_iter().map(|offset| light.position + offset).collect()
    }

    /// Moves the chosen light, or its chosen component.
    pub(crate) fn move_light(&mut self, by: DVec3) {
        let light = self.light;
        if let Some((index, mut offsets)) = self.chosen_component() {
            offsets[index] = edit::within(offsets[index] + by);
            self.components.retain(|c| c.light != light);
            self.components.extend(offsets.into_iter().map(|offset| Component { light, offset }));
        } else if light < self.scene().lights.len() {
            self.document.edit(("move light", light), |s| edit::move_light(&mut s.lights[light], by));
        } else {
            self.complain("the scene has no light; add one in the panel");
        }
    }

    /// Moves what is held by the pointer.
    pub(crate) fn move_item(&mut self, item: Item, by: DVec3) {
        match item {
            Item::Light(i) => {
                self.document.edit(("move light", i), |s| edit::move_light(&mut s.lights[i], by))
            }
            Item::Object(i) => {
                self.document.edit(("move object", i), |s| edit::move_object(&mut s.objects[i], by))
            }
        }
    }

    fn delete(&mut self) {
        match self.chosen.take() {
            Some(Item::Light(i)) if i < self.scene().lights.len() => {
                self.document.edit(("delete", i), |s| drop(s.lights.remove(i)));
                self.components.clear();
                self.component = None;
            }
            Some(Item::Object(i)) if i < self.scene().objects.len() => {
                self.document.edit(("delete", i), |s| drop(s.objects.remove(i)));
            }
            _ => self.complain("nothing is chosen"),
        }
        self.document.end_stroke();
        self.stay_inside();
    }

    fn duplicate(&mut self) {
        let scene = self.scene();
        let step = DVec3::new(0.3, 0.0, 0.3);
        match self.chosen {
            Some(Item::Light(i))
                if i < scene.lights.len() && scene.lights.len() < antumbra_scene::limits::MAX_LIGHTS =>
            {
                let mut light = scene.lights[i].clone();
                light.name = scene.unique_light_name(&light.name);
                edit::move_light(&mut light, step);
                self.choose_after(Item::Light(scene.lights.len()), |s| s.lights.push(light));
            }
            Some(Item::Object(i))
                if i < scene.objects.len() && scene.objects.len() < antumbra_scene::limits::MAX_OBJECTS =>
            {
                let mut object = scene.objects[i].clone();
                object.name = scene.unique_object_name(&object.name);
                edit::move_object(&mut object, step);
                self.choose_after(Item::Object(scene.objects.len()), |s| s.objects.push(object));
            }
            _ => self.complain("nothing is chosen"),
        }
    }

    /// Adds something and chooses it.
    pub(crate) fn choose_after(&mut self, item: Item, add: impl FnOnce(&mut Scene)) {
        self.document.end_stroke();
        self.document.edit(("add", 0), add);
        self.document.end_stroke();
        self.choose(Some(item));
    }

    fn undo(&mut self) {
        if !self.document.can_undo() {
            return self.say("nothing to undo");
        }
        self.document.undo();
        self.stay_inside();
    }

    fn redo(&mut self) {
        if !self.document.can_redo() {
            return self.say("nothing to redo");
        }
        self.document.redo();
        self.stay_inside();
    }

    /// After lights or objects have come or gone.
    fn stay_inside(&mut self) {
        let (lights, objects) = (self.scene().lights.len(), self.scene().objects.len());
        self.light = self.light.min(lights.saturating_sub(1));
        self.components.retain(|c| c.light < lights);
        self.chosen = self.chosen.filter(|item| match *item {
            Item::Light(i) => i < lights,
            Item::Object(i) => i < objects,
        });
    }

    fn next_scene(&mut self, forward: bool) {
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
            None => 0,
        };
        self.before(Then::Show(Source::Gallery(self.gallery[next].name.to_owned())));
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
