//! What becomes of the host's OpenGL state.

/// What a renderer does about the OpenGL state of its host.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum HostState {
    /// Everything that is changed is asked for before and put back after: the host notices nothing. Some fifty queries a
    /// batch of lights, which wait for nothing where the driver's front end answers them itself, but cost milliseconds
    /// where they travel to another process or thread.
    ///
    /// Not in a browser, where what is bound can be objects that the library does not know.
    #[cfg(not(target_arch = "wasm32"))]
    Restore,
    /// Nothing is asked for. Whatever was changed, vertex array and program among it, is afterwards as OpenGL has it in a new
    /// context, but for the viewport and
    /// the scissor box, which are undefined, and the framebuffers: the one that shadows were drawn to is bound for drawing
    /// and reading, or after masks the window's. The host sets what it needs itself, as most do before each pass; three.js
    /// has `WebGLRenderer.resetState` for it.
    ///
    /// The host vouches for the rest: `glClipControl`, where there is one, has the origin in the lower left; a framebuffer that is drawn to has one colour buffer to draw to, its attachments are
    /// none of the surface's textures, and [`crate::Renderer::overlay`] draws to the window (or, outside a browser, to
    /// what is bound for drawing, which alone is asked for).
    Reset,
}

impl Default for HostState {
    fn default() -> Self {
        #[cfg(not(target_arch = "wasm32"))]
        return Self::Restore;
        #[cfg(target_arch = "wasm32")]
        return Self::Reset;
    }
}
