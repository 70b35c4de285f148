//! The framebuffer the host wants its shadows in.

use super::{Caps, Drawing};
use crate::input::{Error, HostState, Unsupported};
#[cfg(not(target_arch = "wasm32"))]
use crate::input::{Image, Texture};
use glow::HasContext;

/// Refuses a clip space that is upside down. Where the host vouches for its state, nothing is asked.
///
/// # Safety
/// The context is current.
pub(crate) unsafe fn refuse_upper_left(
    gl: &glow::Context,
    caps: &Caps,
    host: HostState,
) -> Result<(), Error> {
    if !caps.clip_control || host == HostState::Reset {
        return Ok(());
    }
    // SAFETY: a query of state that the context has.
    let origin = unsafe { gl.get_parameter_i32(glow::CLIP_ORIGIN) } as u32;
    if origin == glow::UPPER_LEFT { Err(Error::Unsupported(Unsupported::UpperLeft)) } else { Ok(()) }
}

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

/// The host's framebuffer made ready for one draw: its draw buffers beside the first are switched off, and what the frame
/// clips is cut off.
pub(crate) struct HostDraw {
    /// Those that were on, if there are others, and how many.
    buffers: Option<([u32; 16], usize)>,
    /// The host's scissor box, where it is to be put back.
    scissor: Option<[i32; 4]>,
    clipped: bool,
}

impl HostDraw {
    /// # Safety
    /// `framebuffer` is bound for drawing and a [`super::StateGuard`] is alive.
    pub(crate) unsafe fn begin(drawing: &Drawing<'_>, framebuffer: Option<glow::Framebuffer>) -> Self {
        let (gl, vouched) = (drawing.gl, drawing.host == HostState::Reset);
        let (mut scissor, clip) = (None, drawing.frame.clip);
        // SAFETY: the caller's; the scissor test is off, and the box was checked.
        unsafe {
            if let Some([x, y, width, height]) = clip {
                if !vouched {
                    let mut before = [0; 4];
                    gl.get_parameter_i32_slice(glow::SCISSOR_BOX, &mut before);
                    scissor = Some(before);
                }
                gl.scissor(x, y, width, height);
                gl.enable(glow::SCISSOR_TEST);
            }
            let framebuffer = framebuffer.filter(|_| !vouched);
            Self { buffers: leave_others(drawing, framebuffer), scissor, clipped: clip.is_some() }
        }
    }

    /// Puts the rest back.
    ///
    /// # Safety
    /// The same framebuffer is bound.
    pub(crate) unsafe fn end(&self, gl: &glow::Context) {
        // SAFETY: the caller's; the values were read from this framebuffer and context.
        unsafe {
            if let Some((buffers, count)) = &self.buffers {
                gl.draw_buffers(&buffers[..*count]);
            }
            if self.clipped {
                gl.disable(glow::SCISSOR_TEST);
            }
            if let Some([x, y, width, height]) = self.scissor {
                gl.scissor(x, y, width, height);
            }
        }
    }
}

/// Switches the draw buffers beside the first off; `None` where there are none.
///
/// # Safety
/// As for [`HostDraw::begin`].
unsafe fn leave_others(
    drawing: &Drawing<'_>,
    framebuffer: Option<glow::Framebuffer>,
) -> Option<([u32; 16], usize)> {
    let (gl, caps) = (drawing.gl, drawing.caps);
    framebuffer?;
    let mut buffers = [glow::NONE; 16];
    let all = caps.draw_buffers.min(16) as usize;
    for (i, buffer) in buffers.iter_mut().enumerate().take(all) {
        // SAFETY: one of the context's draw buffers.
        *buffer = unsafe { gl.get_parameter_i32(glow::DRAW_BUFFER0 + i as u32) } as u32;
    }
    let count = 1 + buffers.iter().rposition(|&b| b != glow::NONE).filter(|&last| last > 0)?;
    // SAFETY: the caller's; the first of the host's own buffers.
    unsafe { gl.draw_buffers(&buffers[..1]) };
    Some((buffers, count))
}
