//! The host's surface, asked of its framebuffer.

use super::Renderer;
use crate::gl::{DepthAttachment, StateGuard};
use crate::input::{Error, Framebuffer, Surface, Texture, Unsupported};
use glow::HasContext;

impl Surface {
    /// The depth texture that is attached to a framebuffer, with its bits, floats and samples, asked of OpenGL: for hosts
    /// whose engine hides the texture's name. Whether depth is reversed follows from the value that it is cleared to now
    /// (`glClearDepth`), and what clip space is like from `glClipControl`, where the context has that; a host for which
    /// either is something else when it draws says so in [`Surface::depth_format`].
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a framebuffer without depth, or whose depth is not a texture that can be read where it
    /// is: let the renderer copy it then ([`Surface::copied`]).
    pub fn from_framebuffer(renderer: &Renderer, framebuffer: Framebuffer) -> Result<Self, Error> {
        let gl = &renderer.gl;
        // SAFETY: a query of state that the context has.
        let clip =
            unsafe { renderer.manner.caps.clip_control.then(|| gl.get_parameter_i32(glow::CLIP_DEPTH_MODE)) };
        let _guard = StateGuard::new(gl, renderer.manner.caps, renderer.host_state);
        // SAFETY: the guard is alive, and whoever made the framebuffer's handle vouches for it.
        let (attachment, cleared) = unsafe {
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, framebuffer.glow());
            let attachment = DepthAttachment::query(gl, framebuffer.glow())?;
            (attachment, gl.get_parameter_f32(glow::DEPTH_CLEAR_VALUE))
        };
        let Some(texture) = attachment.texture else {
            let is_texture = attachment.is_texture;
            let unsupported = if is_texture { Unsupported::DepthLayer } else { Unsupported::DepthNoTexture };
            return Err(Error::Unsupported(unsupported));
        };
        let surface = Self::from_depth(Texture::own(texture)).with_samples(attachment.samples);
        let mut format = attachment.format(surface.depth_format);
        format.background = if cleared == 0.0 { 0.0 } else { 1.0 };
        format.zero_to_one = clip == Some(glow::ZERO_TO_ONE as i32);
        Ok(surface.with_format(format))
    }
}
