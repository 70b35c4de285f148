//! What can go wrong between antumbra and a driver.

/// Why a renderer could not be made or a frame could not be shadowed. The host's OpenGL state is
/// as it was whenever one of these is returned.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The context is older than OpenGL 3.3 or OpenGL ES 3.0.
    #[error("OpenGL 3.3 or OpenGL ES 3.0 is needed, the context is {found}; ask for a newer one")]
    TooOld {
        /// The version string of the context.
        found: String,
    },
    /// A shader did not compile or link: a bug of antumbra or of the driver.
    #[error("shader {name}: {log}")]
    Shader {
        /// The program.
        name: &'static str,
        /// What the driver says.
        log: String,
    },
    /// The driver refused an object or a framebuffer, most often for lack of memory.
    #[error("the driver could not make {what}")]
    Resource {
        /// What was asked for.
        what: String,
    },
    /// The frame asks for what this context cannot do.
    #[error("{what} needs {needs}")]
    Unsupported {
        /// What the frame asks for.
        what: &'static str,
        /// What would make it possible.
        needs: &'static str,
    },
    /// A texture of the surface is attached to the framebuffer that is to be drawn to: reading
    /// and writing one image in one draw is undefined in OpenGL.
    #[error(
        "the surface's {image} texture is attached to the bound draw framebuffer; bind a framebuffer with the colour alone"
    )]
    SurfaceAttached {
        /// Which texture: depth, normals or ids.
        image: &'static str,
    },
    /// The technique cannot do what the frame asks for.
    #[error("the technique {technique} {}", .refusal.reason)]
    Refused {
        /// Its name.
        technique: &'static str,
        /// What it cannot do.
        refusal: crate::technique::Refusal,
    },
    /// A light's numbers make no sense.
    #[error("bad light {index}: {reason}")]
    BadLight {
        /// Its index in [`crate::Frame::lights`].
        index: usize,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// The frame is not a frame: its numbers or sizes make no sense.
    #[error("bad frame: {0}")]
    BadFrame(&'static str),
}
