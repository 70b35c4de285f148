//! Objects of the host's OpenGL, by their names.

#[cfg(not(target_arch = "wasm32"))]
use std::num::NonZeroU32;

/// A texture of the host's.
///
/// What a texture is read as depends on where in a [`crate::Surface`] it is put.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Texture(glow::Texture);

impl Texture {
    /// The texture of this name; `None` for 0, which is none.
    ///
    /// # Safety
    /// It is the name of a texture of the context that the renderer is in, and stays so as long as a frame is drawn with
    /// it. A texture of another kind than the [`crate::Surface`] says makes OpenGL report errors or read nothing.
    #[cfg(not(target_arch = "wasm32"))]
    pub unsafe fn from_name(name: u32) -> Option<Self> {
        NonZeroU32::new(name).map(|name| Self(glow::NativeTexture(name)))
    }

    /// The texture that glow 0.17 knows under this handle.
    ///
    /// # Safety
    /// As for [`Self::from_name`].
    pub unsafe fn from_glow(texture: glow::Texture) -> Self {
        Self(texture)
    }

    /// A texture of the renderer's own.
    pub(crate) fn own(texture: glow::Texture) -> Self {
        Self(texture)
    }

    /// Its OpenGL name.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn name(self) -> u32 {
        self.0.0.get()
    }

    /// Its handle in glow 0.17.
    pub fn glow(self) -> glow::Texture {
        self.0
    }
}

/// A framebuffer of the host's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Framebuffer(Option<glow::Framebuffer>);

impl Framebuffer {
    /// The window's own, OpenGL's name 0.
    pub const WINDOW: Self = Self(None);

    /// The framebuffer of this name; the window's for 0.
    ///
    /// # Safety
    /// It is 0 or the name of a framebuffer of the context that the renderer is in, and stays so as long as a frame is drawn
    /// to it, with what is attached to it.
    #[cfg(not(target_arch = "wasm32"))]
    pub unsafe fn from_name(name: u32) -> Self {
        Self(NonZeroU32::new(name).map(glow::NativeFramebuffer))
    }

    /// The framebuffer that glow 0.17 knows under this handle; the window's for `None`.
    ///
    /// # Safety
    /// As for [`Self::from_name`].
    pub unsafe fn from_glow(framebuffer: Option<glow::Framebuffer>) -> Self {
        Self(framebuffer)
    }

    /// Its OpenGL name, 0 for the window's.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn name(self) -> u32 {
        self.0.map_or(0, |framebuffer| framebuffer.0.get())
    }

    /// Its handle in glow 0.17.
    pub fn glow(self) -> Option<glow::Framebuffer> {
        self.0
    }
}
