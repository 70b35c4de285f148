//! The host's depth, copied where it is to be.

use super::Renderer;
use crate::gl::DepthAttachment;
use crate::input::{Depth, Error, Frame, Surface, Texture};
use crate::screen::check_viewport;
use glow::HasContext;

impl Renderer {
    /// The frame with its depth in a texture: copied, if it is to be, from `framebuffer`.
    ///
    /// # Safety
    /// A [`crate::gl::StateGuard`] is alive, and the framebuffer is one of this context.
    pub(super) unsafe fn with_depth<'a>(
        &mut self,
        frame: &Frame<'a>,
        framebuffer: Option<glow::Framebuffer>,
    ) -> Result<Frame<'a>, Error> {
        if frame.surface.depth != Depth::Copied {
            return Ok(*frame);
        }
        let caps = &self.manner.caps;
        check_viewport(frame.viewport, caps.max_texture_size).map_err(Error::BadFrame)?;
        // SAFETY: the caller's.
        let (attachment, (texture, samples)) = unsafe {
            self.gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, framebuffer);
            let attachment = DepthAttachment::query(&self.gl, framebuffer)?;
            let copy = &mut self.depth_copy;
            (attachment, copy.copy(&self.gl, caps, framebuffer, &attachment, frame.viewport)?)
        };
        let format = attachment.format(frame.surface.depth_format);
        let depth = Depth::Texture(Texture::own(texture));
        let surface = Surface { depth, ..frame.surface.with_samples(samples).with_format(format) };
        Ok(frame.surface(surface))
    }
}
