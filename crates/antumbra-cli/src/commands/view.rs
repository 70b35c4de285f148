//! `antumbra view`: the viewer.

use std::io;

use antumbra_viewer::{GalleryScene, Options, ViewerError};

use crate::args::ViewArgs;
use crate::console;
use crate::error::CliError;
use crate::gallery::GALLERY;

/// What the first start shows: several lights, all of which move.
const FIRST: &str = "coloured-lights";

/// Opens the viewer and returns when its window is closed.
///
/// # Errors
/// A scene that cannot be read, no window system, no OpenGL.
pub(crate) fn run(arguments: &ViewArgs) -> Result<(), CliError> {
    open(arguments).map_err(failure)
}

/// Opens the viewer as the program does that was told nothing. `false` where there is no display to open it on.
///
/// # Errors
/// As [`run`].
pub(crate) fn run_if_possible() -> Result<bool, CliError> {
    if !antumbra_viewer::display_available() {
        return Ok(false);
    }
    match open(&ViewArgs::default()) {
        Ok(()) => Ok(true),
        Err(ViewerError::NoDisplay(why)) => {
            console::note(format_args!("no window ({why}); rendering the gallery"));
            Ok(false)
        }
        Err(error) => Err(failure(error)),
    }
}

fn open(arguments: &ViewArgs) -> Result<(), ViewerError> {
    let options = Options {
        scene: arguments.scene.clone(),
        gallery: GALLERY.iter().map(|entry| GalleryScene { name: entry.name, text: entry.text }).collect(),
        first: Some(FIRST.to_owned()),
        technique: arguments.technique.map(|technique| technique.to_string()),
        size: arguments.size.map(|size| [size.width, size.height]),
        fresh: arguments.fresh,
        json: arguments.json,
    };
    antumbra_viewer::run(options)
}

fn failure(error: ViewerError) -> CliError {
    match error {
        ViewerError::Scene(error) => CliError::Scene(error),
        ViewerError::OpenGl(error) => CliError::without_opengl(error),
        ViewerError::Stdout(error) if error.kind() == io::ErrorKind::BrokenPipe => CliError::BrokenPipe,
        ViewerError::Stdout(error) => CliError::Stdout(error),
        error => CliError::Usage(error.to_string()),
    }
}
