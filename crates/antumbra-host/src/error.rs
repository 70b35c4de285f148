//! What can go wrong while drawing a scene with OpenGL.

use crate::Ways;

/// Why a scene was not drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HostError {
    /// There is no usable OpenGL on this machine.
    #[error("no OpenGL: {0}")]
    NoOpenGl(String),
    /// The technique cannot do something in the scene.
    #[error("{object}: {what}; use {}", ways.as_options())]
    Unsupported {
        /// The object or light, by name.
        object: String,
        /// What cannot be done.
        what: String,
        /// What can do it.
        ways: Ways,
    },
    /// The picture is not one this driver can draw.
    #[error("{0}")]
    BadRequest(String),
    /// The driver refused something.
    #[error("OpenGL: {0}")]
    Driver(String),
    /// antumbra refused the frame.
    #[error(transparent)]
    Shadows(#[from] antumbra::Error),
}

impl HostError {
    /// The error for people who have no command line before them: without the names of its options.
    pub fn in_words(&self) -> String {
        match self {
            Self::Unsupported { object, what, ways } => format!("{object}: {what}; use {}", ways.in_words()),
            error => error.to_string(),
        }
    }
}
