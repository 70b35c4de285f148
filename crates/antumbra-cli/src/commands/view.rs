//! `antumbra view`: the viewer.

use antumbra_viewer::{GalleryScene, Options, ViewerError};

use crate::args::ViewArgs;
use crate::error::CliError;
use crate::gallery::GALLERY;

/// What the first start shows: several lights, all of which move.
const FIRST: &str = "coloured-lights";

/// Opens the viewer and returns when its window is closed.
///
/// # Errors
/// A scene that cannot be read, no window system, no OpenGL.
pub(crate) fn run(arguments: &ViewArgs) -> Result<(), CliError> {
    let options = Options {
        scene: arguments.scene.clone(),
        gallery: GALLERY.iter().map(|entry| GalleryScene { name: entry.name, text: entry.text }).collect(),
        first: Some(FIRST.to_owned()),
        technique: arguments.technique.map(|technique| technique.to_string()),
        size: arguments.size.map(|size| [size.width, size.height]),
        fresh: arguments.fresh,
        json: arguments.json,
    };
    antumbra_viewer::run(options).map_err(|error| match error {
        ViewerError::Scene(error) => CliError::Scene(error),
        ViewerError::OpenGl(error) => CliError::without_opengl(error),
        error => CliError::Usage(error.to_string()),
    })
}

/// Whether there is a window system to open a window on.
pub(crate) fn is_possible() -> bool {
    antumbra_viewer::display_available()
}
