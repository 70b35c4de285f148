//! Small shader programs of the viewer's own.

use antumbra_host::{HostError, link_program};
use glow::HasContext;

/// A linked program.
pub(crate) struct Program {
    pub(crate) raw: glow::Program,
}

impl Program {
    /// Compiles and links a program; the version line and precisions are put before both shaders.
    ///
    /// # Errors
    /// [`HostError::Driver`] with the compiler's words.
    pub(crate) fn new(gl: &glow::Context, vertex: &str, fragment: &str) -> Result<Self, HostError> {
        Ok(Self { raw: link_program(gl, vertex, fragment)? })
    }

    /// Where a uniform is.
    ///
    /// # Safety
    /// The context is current.
    pub(crate) unsafe fn uniform(&self, gl: &glow::Context, name: &str) -> Option<glow::UniformLocation> {
        // SAFETY: the caller's.
        unsafe { gl.get_uniform_location(self.raw, name) }
    }
}
