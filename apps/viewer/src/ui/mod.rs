//! The interface: what is round the picture and over it, and what pointer and keys do.

mod dialog;
mod dialogs;
mod fields;
mod files;
mod help;
mod keys;
mod lights;
mod menu;
mod objects;
pub(crate) mod overlay;
mod panel;
mod picture;
mod status;
pub(crate) mod style;
pub(crate) mod teaching;
pub(crate) mod timing;
mod unsaved;

use std::time::{Duration, Instant};

use antumbra_host::ContextInfo;
use antumbra_scene::Motion;
use egui::{CentralPanel, Frame, Panel, Rect, Ui};

use crate::canvas::Side;
use crate::controls::Control;
use crate::model::files::Files;
use crate::model::pick::{Grip, Item};
use crate::model::settings::Layout;
use crate::model::{Model, Parked};

/// What the interface knows besides the model: what was seen in the frames before, and what the pointer holds.
pub(crate) struct Seen {
    /// What became of the sides.
    pub(crate) sides: [Side; 2],
    /// Whether nothing moves, and the picture is as good as it gets.
    pub(crate) still: bool,
    /// Rays a pixel of the reference, how many there will be, and whether it is of something older.
    pub(crate) traced: Option<(u32, u32, bool)>,
    /// Root mean square and largest difference of the two sides.
    pub(crate) error: Option<[f32; 2]>,
    /// Whether a side was drawn since the error was found.
    error_is_old: bool,
    /// The named controls of the last frame, where somebody asks for them.
    pub(crate) controls: Vec<Control>,
    /// Lines and numbers that teach.
    pub(crate) lesson: teaching::Lesson,
    /// The map of the chosen light.
    pub(crate) map: Option<MapImage>,
    /// The driver's name.
    pub(crate) renderer: String,
    /// Which clock frame times are of.
    pub(crate) clock: &'static str,
    /// The dialog for a file, while there is one.
    files: Option<Files>,
    /// What the pointer drags.
    grip: Option<Grip>,
    /// Whether what it dragged is gone.
    lost_grip: bool,
    /// Whether it drags the divider.
    dividing: bool,
    /// What was chosen with the pointer, and whether a frame has passed since: what was being written when it was is
    /// taken in that frame.
    choice: Option<(Option<Item>, bool)>,
    /// When the error was found.
    error_found: Option<Instant>,
}

/// How long an error is shown before it is found again: reading two pictures back takes time, and while the reference is
/// refined there are ten new ones a second.
const ERROR_LASTS: Duration = Duration::from_secs(1);

impl Seen {
    /// Nothing was seen yet.
    pub(crate) fn new(info: &ContextInfo, clock: &'static str) -> Self {
        Self {
            sides: Default::default(),
            still: false,
            traced: None,
            error: None,
            error_is_old: false,
            controls: Vec::new(),
            lesson: Default::default(),
            map: None,
            renderer: info.renderer.clone(),
            clock,
            files: None,
            grip: None,
            lost_grip: false,
            dividing: false,
            choice: None,
            error_found: None,
        }
    }

    /// Chooses something in the next frame.
    fn choose(&mut self, item: Option<Item>) {
        self.choice = Some((item, false));
    }

    /// Whether both sides show what they are asked to.
    fn none_objects(&self) -> bool {
        self.sides.iter().all(|side| side.objection.is_none())
    }

    /// Takes note of a frame; whether what became of its sides is another than in the one before.
    pub(crate) fn frame(&mut self, sides: [Side; 2], still: bool) -> bool {
        let changed = sides != self.sides;
        self.still = still;
        self.sides = sides;
        if self.sides.iter().any(|side| side.fresh) {
            self.error_found = self.error_found.filter(|_| self.error.is_some());
            self.error_is_old = true;
        }
        if !still || !self.none_objects() {
            self.error = None;
        }
        changed
    }

    /// Takes note of the error.
    pub(crate) fn found(&mut self, error: Option<[f32; 2]>) {
        self.error = error;
        self.error_is_old = false;
        self.error_found = Some(Instant::now());
    }

    /// Whether a frame is to be drawn to measure it, although nothing in it changed.
    pub(crate) fn wants_frame(&self, model: &Model) -> bool {
        let refused = [0, 1].map(|i| self.sides[i].objection.is_some());
        model.timing.measuring().is_some() || model.timing.wants_frame(&model.settings, refused)
    }

    /// Whether both sides show the scene as it is now.
    fn can_compare(&self) -> bool {
        self.traced.is_none_or(|(_, _, stale)| !stale) && self.none_objects()
    }

    /// When the error has to be found again, if it is shown and a side was drawn since.
    pub(crate) fn error_due(&self, model: &Model) -> Option<Instant> {
        let shown = model.settings.layout == Layout::Difference
            && self.can_compare()
            && self.error.is_some()
            && self.error_is_old;
        self.error_found.filter(|_| shown).map(|then| then + ERROR_LASTS)
    }

    /// Whether the error of one side against the other is asked for and not known.
    pub(crate) fn wants_error(&self, model: &Model) -> bool {
        let due = self.error_found.is_none_or(|then| then.elapsed() >= ERROR_LASTS);
        model.settings.layout == Layout::Difference
            && self.can_compare()
            && (self.error.is_none() || self.error_is_old && due)
    }
}

/// A picture of a map that the interface can show.
#[derive(PartialEq)]
pub(crate) struct MapImage {
    /// As the interface knows it.
    pub(crate) id: egui::TextureId,
    /// The part of the texture that it takes, pixels.
    pub(crate) size: [i32; 2],
    /// What it is.
    pub(crate) caption: String,
}

/// Shows everything and does what the user asks; where the picture is, points.
pub(crate) fn show(root: &mut Ui, model: &mut Model, seen: &mut Seen) -> Rect {
    let context = root.ctx().clone();
    let asked = model.dialog.is_some();
    if !context.input(|input| input.pointer.any_down() || !input.keys_down.is_empty()) {
        model.document.end_stroke();
    }
    files::escape(&context, seen);
    keys::press(&context, model);
    keys::drop_files(&context, model);
    Panel::top("menu").show(root, |ui| menu::bar(ui, model));
    Panel::bottom("status").show(root, |ui| status::line(ui, model, seen));
    if model.settings.panel {
        Panel::right("panel")
            .default_size(300.0)
            .size_range(260.0..=480.0)
            .show(root, |ui| panel::show(ui, model, seen));
    }
    if model.settings.timing {
        let most = (0.6 * root.available_height()).max(90.0);
        let panel = Panel::bottom("timing").resizable(true).default_size(190.0).size_range(90.0..=most);
        panel.show(root, |ui| timing::show(ui, model, seen));
    }
    let picture =
        CentralPanel::default().frame(Frame::NONE).show(root, |ui| picture::show(ui, model, seen)).inner;
    dialogs::show(&context, model, seen);
    if asked && model.dialog.is_none() {
        // What had the keyboard is gone: keys are the program's again, at once.
        context.memory_mut(|memory| memory.focused().into_iter().for_each(|id| memory.surrender_focus(id)));
    }
    match seen.choice.take() {
        Some((item, true)) => model.choose(item),
        Some((item, false)) => {
            seen.choice = Some((item, true));
            context.request_repaint();
        }
        None => {}
    }
    picture
}

/// Whether something moves: a box to tick. A motion that is taken away comes back when it is ticked again.
fn moves(
    ui: &mut Ui,
    parked: &mut Parked,
    (kind, name): (&'static str, &str),
    motion: &mut Option<Motion>,
    otherwise: impl FnOnce() -> Motion,
) -> bool {
    let mut on = motion.is_some();
    if !ui.checkbox(&mut on, "moves").changed() {
        return false;
    }
    let key = (kind, name.to_owned());
    if on {
        *motion = Some(parked.remove(&key).unwrap_or_else(otherwise));
    } else if let Some(motion) = motion.take() {
        parked.insert(key, motion);
    }
    true
}

/// A list of any length, of which the rows in sight are made.
fn list(ui: &mut Ui, name: &str, count: usize, mut row: impl FnMut(&mut Ui, usize)) {
    let height = ui.spacing().interact_size.y;
    let area = egui::ScrollArea::vertical()
        .id_salt(name)
        .max_height(10.0 * (height + 4.0))
        .auto_shrink([false, true]);
    area.show_rows(ui, height, count, |ui, rows| {
        for i in rows {
            ui.horizontal(|ui| row(ui, i));
        }
    });
}

/// What a list is asked for.
enum Asked {
    /// One more, of a kind.
    Add(&'static str),
    /// What is chosen is to go.
    Remove,
}

/// The row under a list: a menu of kinds to add, and a button that removes what is chosen.
fn add_or_remove(ui: &mut Ui, what: &str, kinds: &[&'static str], chosen: bool) -> Option<Asked> {
    let mut asked = None;
    ui.horizontal(|ui| {
        ui.menu_button(format!("Add {what}"), |ui| {
            for kind in kinds {
                if ui.button(*kind).clicked() {
                    asked = Some(Asked::Add(kind));
                    ui.close();
                }
            }
        });
        ui.add_enabled_ui(chosen, |ui| {
            if ui.button(format!("Remove {what}")).clicked() {
                asked = Some(Asked::Remove);
            }
        });
    });
    asked
}
