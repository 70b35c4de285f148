//! What can go wrong while drawing a scene with OpenGL.

/// Why a scene was not drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HostError {
    /// There is no usable OpenGL on this machine.
    #[error("no OpenGL: {0}")]
    NoOpenGl(String),
    /// The technique cannot do something in the scene.
    #[error("{object}: {what}; use --technique {}{}", able.join(" or "), or_sampled(sampled, "--soft "))]
    Unsupported {
        /// The object or light, by name.
        object: String,
        /// What cannot be done.
        what: String,
        /// The names of the techniques that can do it.
        able: Vec<&'static str>,
        /// Samples of lights with an area with which the technique itself can do it.
        sampled: Option<antumbra::Soft>,
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
            Self::Unsupported { object, what, able, sampled } => {
                format!("{object}: {what}; use {}{}", able.join(" or "), or_sampled(sampled, ""))
            }
            error => error.to_string(),
        }
    }
}

fn or_sampled(sampled: &Option<antumbra::Soft>, option: &str) -> String {
    sampled.map(|soft| format!(", or {option}{soft}")).unwrap_or_default()
}
