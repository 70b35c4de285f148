//! The framebuffer the host wants its shadows in.

use super::Drawing;
use crate::input::{Error, HostState};
#[cfg(not(target_arch = "wasm32"))]
use crate::input::{Image, Texture};
use glow::HasContext;

/// Refuses a target that has one of the textures attached that its own shading would read. Where the host vouches for its
/// state, nothing is asked.
///
/// # Safety
/// `framebuffer` is bound for drawing.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) unsafe fn refuse_feedback(
    drawing: &Drawing<'_>,
    framebuffer: Option<glow::Framebuffer>,
) -> Result<(), Error> {
    let (gl, surface) = (drawing.gl, &drawing.frame.surface);
    if framebuffer.is_none() || drawing.host == HostState::Reset {
        return Ok(()); // the window's own buffers are no textures
    }
    let read = [
        (Image::Depth, surface.depth_texture()),
        (Image::Normals, surface.normals.map(|n| n.texture.glow())),
        (Image::Ids, surface.ids.map(Texture::glow)),
    ];
    let colors = (0..drawing.caps.draw_buffers).map(|i| glow::COLOR_ATTACHMENT0 + i);
    for attachment in colors.chain([glow::DEPTH_ATTACHMENT, glow::STENCIL_ATTACHMENT]) {
        // SAFETY: the caller's; the attachment points exist, and a name is only asked for where
        // something is attached.
        let attached = unsafe {
            let query =
                |name| gl.get_framebuffer_attachment_parameter_i32(glow::DRAW_FRAMEBUFFER, attachment, name);
            match query(glow::FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) as u32 {
                glow::TEXTURE => query(glow::FRAMEBUFFER_ATTACHMENT_OBJECT_NAME) as u32,
                _ => continue,
            }
        };
        for (image, texture) in read {
            if texture.is_some_and(|texture| texture.0.get() == attached) {
                return Err(Error::SurfaceAttached { image });
            }
        }
    }
    Ok(())
}

/// In a browser textures have no names to compare, and a draw that reads what it writes is refused by WebGL itself.
///
/// # Safety
/// None is needed.
#[cfg(target_arch = "wasm32")]
pub(crate) unsafe fn refuse_feedback(_: &Drawing<'_>, _: Option<glow::Framebuffer>) -> Result<(), Error> {
    Ok(())
}

/// The host's draw buffers beside the first, switched off for one draw.
pub(crate) struct OtherBuffers {
    buffers: [u32; 16],
    count: usize,
}

impl OtherBuffers {
    /// Switches them off; `None` when there are none, and where the host vouches for its state.
    ///
    /// # Safety
    /// `framebuffer` is bound for drawing and a [`super::StateGuard`] is alive.
    pub(crate) unsafe fn leave_alone(
        drawing: &Drawing<'_>,
        framebuffer: Option<glow::Framebuffer>,
    ) -> Option<Self> {
        let (gl, caps) = (drawing.gl, drawing.caps);
        framebuffer.filter(|_| drawing.host != HostState::Reset)?;
        let mut buffers = [glow::NONE; 16];
        let all = caps.draw_buffers.min(16) as usize;
        for (i, buffer) in buffers.iter_mut().enumerate().take(all) {
            // SAFETY: one of the context's draw buffers.
            *buffer = unsafe { gl.get_parameter_i32(glow::DRAW_BUFFER0 + i as u32) } as u32;
        }
        let count = 1 + buffers.iter().rposition(|&b| b != glow::NONE).filter(|&last| last > 0)?;
        // SAFETY: the caller's; the first of the host's own buffers.
        unsafe { gl.draw_buffers(&buffers[..1]) };
        Some(Self { buffers, count })
    }

    /// Switches them on again.
    ///
    /// # Safety
    /// The same framebuffer is still bound.
    pub(crate) unsafe fn restore(&self, gl: &glow::Context) {
        // SAFETY: the caller's; the values were read from this framebuffer.
        unsafe { gl.draw_buffers(&self.buffers[..self.count]) };
    }
}
