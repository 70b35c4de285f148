//! The interactive program of antumbra: look at a scene and change it, with every technique beside the ray traced
//! truth, and see what its shadows are made of.
//!
//! [`run`] opens the window and returns when it is closed. It is built on the public interfaces of `antumbra`,
//! `antumbra-host` and `antumbra-scene` alone.

mod app;
mod canvas;
mod clipboard;
mod controls;
mod error;
mod gl_window;
mod model;
mod reference;
mod remembered;
mod report;
mod running;
mod screenshot;
mod teach;
mod ui;
mod wake;

pub use error::ViewerError;

use std::path::PathBuf;

use antumbra_scene::{Scene, SceneError};

use model::document::{Document, Source};

/// What to start with.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The scene file; without one, what was looked at last, or else one of the gallery.
    pub scene: Option<PathBuf>,
    /// Scenes that need no file.
    pub gallery: Vec<GalleryScene>,
    /// The name of the one that the first start shows; else it is the gallery's first.
    pub first: Option<String>,
    /// How shadows are found, as on the command line: `map:size=512`, `analytic+samples:16`, `raytraced`, `none`.
    pub technique: Option<String>,
    /// Size of the window, in points of the interface.
    pub size: Option<[u32; 2]>,
    /// Whether to forget what was remembered.
    pub fresh: bool,
    /// Whether to print lines of JSON on standard output: the keys, then the state whenever it changes.
    pub json: bool,
}

/// A scene that is part of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GalleryScene {
    /// Its name.
    pub name: &'static str,
    /// The scene file.
    pub text: &'static str,
}

impl GalleryScene {
    fn document(&self) -> Result<Document, SceneError> {
        Ok(Document::new(Scene::parse(self.text, self.name.as_ref())?, Source::Gallery(self.name.to_owned())))
    }
}

/// Opens the window and returns when it is closed. Must be called on the main thread, at most once in a program.
///
/// # Errors
/// [`ViewerError::NoDisplay`] where there is no window system, [`ViewerError::Scene`] for a scene file that cannot be
/// read, [`ViewerError::OpenGl`] for what the driver cannot do.
pub fn run(options: Options) -> Result<(), ViewerError> {
    app::run(options)
}

/// Whether there seems to be a window system to open a window on.
pub fn display_available() -> bool {
    if cfg!(any(windows, target_os = "macos")) {
        return true;
    }
    ["WAYLAND_DISPLAY", "WAYLAND_SOCKET", "DISPLAY"]
        .iter()
        .any(|name| std::env::var_os(name).is_some_and(|v| !v.is_empty()))
}
