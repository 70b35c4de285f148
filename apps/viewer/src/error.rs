//! What ends the program early.

use antumbra_host::HostError;
use antumbra_scene::SceneError;
use thiserror::Error;

/// Why the viewer could not start, or stopped.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ViewerError {
    /// There is no window system, or it gives no window.
    #[error("no window: {0}; `antumbra render SCENE -o OUT.png` needs none")]
    NoDisplay(String),
    /// OpenGL, or what is drawn with it.
    #[error(transparent)]
    OpenGl(#[from] HostError),
    /// The scene file.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An option that makes no sense.
    #[error("{0}")]
    Option(String),
    /// Standard output does not take the state.
    #[error("standard output: {0}")]
    Stdout(std::io::Error),
}
