//! What can go wrong while drawing a scene with OpenGL.

/// Why a scene was not drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HostError {
    /// There is no usable OpenGL on this machine.
    #[error("no OpenGL: {0}")]
    NoOpenGl(String),
    /// The technique cannot do something in the scene.
    #[error("{object}: {what}; {instead}")]
    Unsupported {
        /// The object or light, by name.
        object: String,
        /// What cannot be done.
        what: String,
        /// What can.
        instead: String,
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
