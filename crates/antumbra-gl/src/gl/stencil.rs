//! A stencil buffer beside the masks, for techniques that count or mark pixels.

use super::{Drawing, Target};
use crate::input::{Error, HostState, Resource};
use glow::HasContext;

/// A depth and stencil buffer of one size. The depth is there because every driver has the two together, and few
/// have a stencil alone; nothing writes it.
#[derive(Default)]
pub(crate) struct StencilBuffer {
    renderbuffer: Option<glow::Renderbuffer>,
    key: (i32, i32, u32),
}

impl StencilBuffer {
    /// Attaches the buffer to a mask's framebuffer, which is left bound for drawing; makes it anew where size or
    /// samples have changed. Its contents are undefined until they are cleared.
    ///
    /// # Safety
    /// A [`super::StateGuard`] is alive, and `mask` is a target of this context.
    pub(crate) unsafe fn attach(&mut self, drawing: &Drawing<'_>, mask: &Target) -> Result<(), Error> {
        let gl = drawing.gl;
        let key @ (width, height, samples) = mask.key();
        let refused = || Error::Resource(Resource::Stencil { width, height, samples });
        // SAFETY: the caller's; the renderbuffer binding is put back.
        unsafe {
            if self.renderbuffer.is_none() || self.key != key {
                self.delete(gl);
                let bound = match drawing.host {
                    HostState::Reset => None,
                    #[cfg(not(target_arch = "wasm32"))]
                    HostState::Restore => gl.get_parameter_renderbuffer(glow::RENDERBUFFER_BINDING),
                };
                let renderbuffer = gl.create_renderbuffer().map_err(|_| refused())?;
                gl.bind_renderbuffer(glow::RENDERBUFFER, Some(renderbuffer));
                let format = glow::DEPTH24_STENCIL8;
                if samples > 1 {
                    let samples = samples as i32;
                    gl.renderbuffer_storage_multisample(glow::RENDERBUFFER, samples, format, width, height);
                } else {
                    gl.renderbuffer_storage(glow::RENDERBUFFER, format, width, height);
                }
                gl.bind_renderbuffer(glow::RENDERBUFFER, bound);
                (self.renderbuffer, self.key) = (Some(renderbuffer), key);
            }
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(mask.framebuffer));
            gl.framebuffer_renderbuffer(
                glow::DRAW_FRAMEBUFFER,
                glow::DEPTH_STENCIL_ATTACHMENT,
                glow::RENDERBUFFER,
                self.renderbuffer,
            );
            match gl.check_framebuffer_status(glow::DRAW_FRAMEBUFFER) {
                glow::FRAMEBUFFER_COMPLETE => Ok(()),
                _ => Err(refused()),
            }
        }
    }

    /// Takes the buffer off a mask's framebuffer again: other techniques draw to it without.
    ///
    /// # Safety
    /// As for [`Self::attach`].
    pub(crate) unsafe fn detach(gl: &glow::Context, mask: &Target) {
        // SAFETY: the caller's.
        unsafe {
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(mask.framebuffer));
            gl.framebuffer_renderbuffer(
                glow::DRAW_FRAMEBUFFER,
                glow::DEPTH_STENCIL_ATTACHMENT,
                glow::RENDERBUFFER,
                None,
            );
        }
    }

    /// # Safety
    /// The context is current.
    pub(crate) unsafe fn delete(&mut self, gl: &glow::Context) {
        if let Some(renderbuffer) = self.renderbuffer.take() {
            // SAFETY: the caller's; it is forgotten here.
            unsafe { gl.delete_renderbuffer(renderbuffer) };
        }
    }
}
