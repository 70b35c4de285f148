//! What the keys do, in one table: pressing them, menus and the help read it.

use antumbra::glam::DVec3;
use egui::{Key, Modifiers};

/// Something to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Command {
    /// Gives the chosen object another shape.
    Shape(PaperShape),
    /// Moves the eye, in steps.
    MoveCamera(DVec3),
    /// Moves the chosen light, or its chosen component, in steps.
    MoveLight(DVec3),
    /// Chooses the first light; of a collection of components, the left one.
    First,
    /// Chooses the second light, or the right component.
    Second,
    /// Chooses a light by its number from 0.
    ChooseLight(usize),
    /// Lets time run, or stops it.
    PlayPause,
    /// Puts time back to 0.
    Rewind,
    /// Changes how fast time runs, by a factor.
    Speed(f64),
    /// The next technique, or the one before.
    NextWay(bool),
    /// The next layout: single, split, error map.
    NextLayout,
    /// Puts the first way in the place of the second and the reverse.
    Swap,
    /// Brings everything into view.
    FrameAll,
    /// The camera of the scene as it was loaded.
    ResetCamera,
    /// Deletes what is chosen.
    Delete,
    /// Adds another like what is chosen.
    Duplicate,
    /// Takes back a step.
    Undo,
    /// Takes it again.
    Redo,
    /// Asks for a file and opens it.
    Open,
    /// The next scene of the gallery, or the one before.
    NextScene(bool),
    /// Saves to the file the scene came from.
    Save,
    /// Asks for a file and saves to it.
    SaveAs,
    /// Saves the picture.
    Screenshot,
    /// Shows or hides the help.
    Help,
    /// Shows or hides the panel.
    Panel,
    /// Shows or hides the plot of frame times.
    Timing,
    /// The whole screen, or not.
    Fullscreen,
    /// Closes what is open, then chooses nothing.
    Escape,
    /// Ends the program.
    Quit,
}

/// The shapes of the papers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PaperShape {
    /// A disc.
    Circle,
    /// A ball.
    Sphere,
    /// An equilateral triangle.
    Triangle,
    /// A cone.
    Cone,
}

/// How far keys move camera and lights, metres.
pub(crate) const STEP: f64 = 0.1;

/// A key and what it does.
pub(crate) struct Binding {
    /// The key.
    pub(crate) key: Key,
    /// With which other keys held.
    pub(crate) modifiers: Modifiers,
    /// What it does.
    pub(crate) command: Command,
    /// What the help says.
    pub(crate) help: &'static str,
}

/// A part of the help.
pub(crate) struct Group {
    /// Its title.
    pub(crate) title: &'static str,
    /// Its keys.
    pub(crate) bindings: &'static [Binding],
}

const fn plain(key: Key, command: Command, help: &'static str) -> Binding {
    Binding { key, modifiers: Modifiers::NONE, command, help }
}

const fn ctrl(key: Key, command: Command, help: &'static str) -> Binding {
    Binding { key, modifiers: Modifiers::COMMAND, command, help }
}

const fn ctrl_shift(key: Key, command: Command, help: &'static str) -> Binding {
    let modifiers = Modifiers { shift: true, ..Modifiers::COMMAND };
    Binding { key, modifiers, command, help }
}

use Command as C;

/// Every key. The first three groups are the papers' own.
pub(crate) const GROUPS: &[Group] = &[
    Group {
        title: "Object",
        bindings: &[
            plain(Key::K, C::Shape(PaperShape::Circle), "circle"),
            plain(Key::L, C::Shape(PaperShape::Sphere), "sphere"),
            plain(Key::T, C::Shape(PaperShape::Triangle), "triangle"),
            plain(Key::U, C::Shape(PaperShape::Cone), "cone"),
        ],
    },
    Group {
        title: "Camera",
        bindings: &[
            plain(Key::Y, C::MoveCamera(DVec3::Y), "up (y)"),
            plain(Key::A, C::MoveCamera(DVec3::NEG_Y), "down"),
            plain(Key::X, C::MoveCamera(DVec3::X), "right (x)"),
            plain(Key::S, C::MoveCamera(DVec3::NEG_X), "left"),
            plain(Key::C, C::MoveCamera(DVec3::Z), "nearer to you (z)"),
            plain(Key::D, C::MoveCamera(DVec3::NEG_Z), "away"),
            plain(Key::F, C::FrameAll, "everything in view"),
            plain(Key::Home, C::ResetCamera, "as the scene has it"),
        ],
    },
    Group {
        title: "Light",
        bindings: &[
            plain(Key::V, C::MoveLight(DVec3::Y), "up (y)"),
            plain(Key::B, C::MoveLight(DVec3::NEG_Y), "down"),
            plain(Key::N, C::MoveLight(DVec3::X), "right (x)"),
            plain(Key::M, C::MoveLight(DVec3::NEG_X), "left"),
            plain(Key::Comma, C::MoveLight(DVec3::Z), "nearer to you (z)"),
            plain(Key::Period, C::MoveLight(DVec3::NEG_Z), "away"),
            plain(Key::G, C::First, "choose the first; the left component"),
            plain(Key::H, C::Second, "choose the second; the right component"),
            plain(Key::Num1, C::ChooseLight(0), "choose light 1"),
            plain(Key::Num2, C::ChooseLight(1), "... 2"),
            plain(Key::Num3, C::ChooseLight(2), "... 3"),
            plain(Key::Num4, C::ChooseLight(3), "... 4"),
            plain(Key::Num5, C::ChooseLight(4), "... 5"),
            plain(Key::Num6, C::ChooseLight(5), "... 6"),
            plain(Key::Num7, C::ChooseLight(6), "... 7"),
            plain(Key::Num8, C::ChooseLight(7), "... 8"),
            plain(Key::Num9, C::ChooseLight(8), "... 9"),
            plain(Key::Num0, C::ChooseLight(9), "... 10"),
        ],
    },
    Group {
        title: "Time",
        bindings: &[
            plain(Key::Space, C::PlayPause, "play, pause"),
            plain(Key::R, C::Rewind, "back to the start"),
            plain(Key::Plus, C::Speed(2.0), "twice as fast"),
            plain(Key::Minus, C::Speed(0.5), "half as fast"),
        ],
    },
    Group {
        title: "Comparison",
        bindings: &[
            plain(Key::CloseBracket, C::NextWay(true), "next technique"),
            plain(Key::OpenBracket, C::NextWay(false), "technique before"),
            plain(Key::E, C::NextLayout, "single, split, error map"),
            plain(Key::W, C::Swap, "change sides"),
            plain(Key::P, C::Timing, "frame times"),
        ],
    },
    Group {
        title: "Scene",
        bindings: &[
            ctrl(Key::O, C::Open, "open"),
            ctrl(Key::S, C::Save, "save"),
            ctrl_shift(Key::S, C::SaveAs, "save as"),
            plain(Key::PageDown, C::NextScene(true), "next of the gallery"),
            plain(Key::PageUp, C::NextScene(false), "the one before"),
            ctrl(Key::Z, C::Undo, "undo"),
            ctrl_shift(Key::Z, C::Redo, "redo"),
            ctrl(Key::Y, C::Redo, "redo"),
            ctrl(Key::D, C::Duplicate, "duplicate what is chosen"),
            plain(Key::Delete, C::Delete, "delete what is chosen"),
        ],
    },
    Group {
        title: "Window",
        bindings: &[
            plain(Key::F1, C::Help, "this help"),
            plain(Key::Questionmark, C::Help, "this help"),
            plain(Key::F9, C::Panel, "panel"),
            plain(Key::F11, C::Fullscreen, "whole screen"),
            plain(Key::F12, C::Screenshot, "save the picture"),
            plain(Key::Escape, C::Escape, "close; choose nothing"),
            ctrl(Key::Q, C::Quit, "quit"),
        ],
    },
];

/// What the mouse does, for the help.
pub(crate) const MOUSE: &[(&str, &str)] = &[
    ("Drag", "turn round the scene"),
    ("Right drag, Shift+drag", "move across"),
    ("Wheel, pinch", "nearer, farther"),
    ("Drag a light or an object", "move it level"),
    ("... with Ctrl", "move it up and down"),
    ("Click", "choose"),
    ("Drag the divider", "compare"),
    ("Drop a .toml", "open it"),
];

/// All bindings.
pub(crate) fn bindings() -> impl Iterator<Item = &'static Binding> {
    GROUPS.iter().flat_map(|group| group.bindings)
}

impl Binding {
    /// The keys as people write them.
    pub(crate) fn text(&self) -> String {
        let key = match self.key {
            Key::Comma | Key::Period | Key::OpenBracket | Key::CloseBracket | Key::Plus | Key::Minus => {
                self.key.symbol_or_name()
            }
            key => key.name(),
        };
        let key = match key {
            "Questionmark" => "?",
            key => key,
        };
        let command = if cfg!(target_os = "macos") { "Cmd" } else { "Ctrl" };
        match (self.modifiers.command, self.modifiers.shift) {
            (true, true) => format!("{command}+Shift+{key}"),
            (true, false) => format!("{command}+{key}"),
            _ => key.to_owned(),
        }
    }

    /// Whether a press of a key with others held is this one. Shift may be held for the plain keys, because keyboards
    /// have `?` and `+` on it.
    pub(crate) fn matches(&self, key: Key, held: Modifiers) -> bool {
        self.key == key
            && held.command == self.modifiers.command
            && !held.alt
            && (held.shift == self.modifiers.shift || !self.modifiers.command)
    }
}

/// The keys of a command, for menus.
pub(crate) fn shortcut(command: Command) -> String {
    bindings().find(|binding| binding.command == command).map(Binding::text).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_does_two_things() {
        let all: Vec<&Binding> = bindings().collect();
        for (i, a) in all.iter().enumerate() {
            for b in &all[i + 1..] {
                assert!(
                    !b.matches(a.key, a.modifiers),
                    "{} is {:?} and {:?}",
                    a.text(),
                    a.command,
                    b.command
                );
            }
        }
    }

    #[test]
    fn the_papers_keys() {
        // Real-Time Shadows in OpenGL Caused by the Presence of Multiple Light Sources (2017), section 5.
        let papers = [
            (Key::K, C::Shape(PaperShape::Circle)),
            (Key::L, C::Shape(PaperShape::Sphere)),
            (Key::T, C::Shape(PaperShape::Triangle)),
            (Key::U, C::Shape(PaperShape::Cone)),
            (Key::Y, C::MoveCamera(DVec3::Y)),
            (Key::A, C::MoveCamera(-DVec3::Y)),
            (Key::X, C::MoveCamera(DVec3::X)),
            (Key::S, C::MoveCamera(-DVec3::X)),
            (Key::C, C::MoveCamera(DVec3::Z)),
            (Key::D, C::MoveCamera(-DVec3::Z)),
            (Key::V, C::MoveLight(DVec3::Y)),
            (Key::B, C::MoveLight(-DVec3::Y)),
            (Key::N, C::MoveLight(DVec3::X)),
            (Key::M, C::MoveLight(-DVec3::X)),
            (Key::G, C::First),
            (Key::H, C::Second),
        ];
        for (key, command) in papers {
            let bound = bindings().find(|b| b.matches(key, Modifiers::NONE)).map(|b| b.command);
            assert_eq!(bound, Some(command), "{key:?}");
        }
    }

    #[test]
    fn text_of_keys() {
        assert_eq!(shortcut(C::SaveAs), "Ctrl+Shift+S", "as people write it");
        assert!(bindings().all(|b| !b.text().is_empty() && !b.help.is_empty()), "all have a help");
    }
}
