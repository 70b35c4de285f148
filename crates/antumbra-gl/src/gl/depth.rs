//! The depth of the host's framebuffer: what it is, and a copy of it to read.

use super::{Caps, texture_storage};
use crate::input::{DepthFormat, Error, Resource, Unsupported};
use glow::HasContext;

/// What a framebuffer has for depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct DepthAttachment {
    /// The texture, if it is one that can be read where it is.
    #[cfg(not(target_arch = "wasm32"))]
    pub(crate) texture: Option<glow::Texture>,
    /// Whether it is some texture, such as a layer of an array.
    pub(crate) is_texture: bool,
    bits: u32,
    float: bool,
    stencil: bool,
    /// Samples a pixel, 1 for plain framebuffers.
    pub(crate) samples: u32,
}

impl DepthAttachment {
    /// Asks for the depth of the framebuffer that is bound for drawing.
    ///
    /// # Errors
    /// [`Unsupported::NoDepth`].
    ///
    /// # Safety
    /// `framebuffer` is bound for drawing.
    pub(crate) unsafe fn query(
        gl: &glow::Context,
        framebuffer: Option<glow::Framebuffer>,
    ) -> Result<Self, Error> {
        let [depth, stencil] = match framebuffer {
            Some(_) => [glow::DEPTH_ATTACHMENT, glow::STENCIL_ATTACHMENT],
            None => [glow::DEPTH, glow::STENCIL],
        };
        let query = |attachment, name| {
            // SAFETY: the caller's; attachment points that every framebuffer has, and of nothing but what is attached is
            // more asked than its kind.
            unsafe { gl.get_framebuffer_attachment_parameter_i32(glow::DRAW_FRAMEBUFFER, attachment, name) }
        };
        let kind = |attachment| query(attachment, glow::FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) as u32;
        let object = kind(depth);
        let bits = match object {
            glow::NONE => 0,
            _ => query(depth, glow::FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE) as u32,
        };
        if bits == 0 {
            return Err(Error::Unsupported(Unsupported::NoDepth));
        }
        let has_stencil =
            kind(stencil) != glow::NONE && query(stencil, glow::FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE) > 0;
        #[cfg(not(target_arch = "wasm32"))]
        let together = |name| query(depth, name) == query(stencil, name);
        // A window's two are one buffer as far as formats go; of others it shows by their names.
        #[cfg(not(target_arch = "wasm32"))]
        let together = framebuffer.is_none() || together(glow::FRAMEBUFFER_ATTACHMENT_OBJECT_NAME);
        #[cfg(target_arch = "wasm32")]
        let together = true;
        // SAFETY: the caller's.
        let samples = unsafe { gl.get_parameter_i32(glow::SAMPLES) };
        Ok(Self {
            #[cfg(not(target_arch = "wasm32"))]
            texture: plain_texture(object, |name| query(depth, name)),
            is_texture: object == glow::TEXTURE,
            bits,
            float: query(depth, glow::FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) as u32 == glow::FLOAT,
            stencil: has_stencil && together,
            samples: samples.max(1) as u32,
        })
    }

    /// How it stores depth, with what only the host knows as it is in `host`.
    pub(crate) fn format(&self, host: DepthFormat) -> DepthFormat {
        // Of a float's 32 bits the mantissa has 24.
        DepthFormat { bits: if self.float { 24 } else { self.bits }, float: self.float, ..host }
    }

    /// The format of textures that it can be copied to.
    fn internal(&self) -> u32 {
        match (self.float, self.bits, self.stencil) {
            (true, _, true) => glow::DEPTH32F_STENCIL8,
            (true, _, false) => glow::DEPTH_COMPONENT32F,
            (false, ..=16, _) => glow::DEPTH_COMPONENT16,
            (false, _, true) => glow::DEPTH24_STENCIL8,
            (false, ..=24, false) => glow::DEPTH_COMPONENT24,
            (false, _, false) => glow::DEPTH_COMPONENT32,
        }
    }
}

/// The texture that is attached, if it is level 0 of a plain one.
#[cfg(not(target_arch = "wasm32"))]
fn plain_texture(object: u32, query: impl Fn(u32) -> i32) -> Option<glow::Texture> {
    use std::num::NonZeroU32;
    let is_plain = object == glow::TEXTURE
        && query(glow::FRAMEBUFFER_ATTACHMENT_TEXTURE_LEVEL) == 0
        && query(glow::FRAMEBUFFER_ATTACHMENT_TEXTURE_LAYER) == 0
        && query(glow::FRAMEBUFFER_ATTACHMENT_TEXTURE_CUBE_MAP_FACE) == 0;
    let name = || NonZeroU32::new(query(glow::FRAMEBUFFER_ATTACHMENT_OBJECT_NAME) as u32);
    is_plain.then(name).flatten().map(glow::NativeTexture)
}

/// A copy of the host's depth, kept from frame to frame.
#[derive(Default)]
pub(crate) struct DepthCopy {
    made: Option<(glow::Texture, glow::Framebuffer)>,
    /// Width, height, samples and format.
    key: (i32, i32, u32, u32),
}

impl DepthCopy {
    /// Copies the depth of a framebuffer within a viewport, to the same place in the copy. Says the texture and its samples.
    ///
    /// # Safety
    /// A [`super::StateGuard`] is alive: bindings are changed. `depth` is the framebuffer's.
    pub(crate) unsafe fn copy(
        &mut self,
        gl: &glow::Context,
        caps: &Caps,
        framebuffer: Option<glow::Framebuffer>,
        depth: &DepthAttachment,
        [x, y, width, height]: [i32; 4],
    ) -> Result<(glow::Texture, u32), Error> {
        let samples = if caps.sample_shading() { depth.samples } else { 1 };
        let (right, upper) = (x + width, y + height);
        // SAFETY: the caller's.
        unsafe {
            let (texture, copy, is_new) = self.ensure(gl, (right, upper, samples, depth.internal()))?;
            if is_new {
                // Errors of the host's own are not of the copy. Contexts keep a few; a lost one keeps on.
                for _ in 0..16 {
                    if gl.get_error() == glow::NO_ERROR {
                        break;
                    }
                }
            }
            gl.bind_framebuffer(glow::READ_FRAMEBUFFER, framebuffer);
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(copy));
            // Formats of both are copied whole: taken apart, some drivers round the depth once more.
            let stencil = if depth.stencil { glow::STENCIL_BUFFER_BIT } else { 0 };
            let (mask, filter) = (glow::DEPTH_BUFFER_BIT | stencil, glow::NEAREST);
            gl.blit_framebuffer(x, y, right, upper, x, y, right, upper, mask, filter);
            // A driver that finds the formats different refuses now or never.
            if is_new && gl.get_error() != glow::NO_ERROR {
                self.delete(gl);
                return Err(Error::Unsupported(Unsupported::DepthCopy));
            }
            Ok((texture, samples))
        }
    }

    /// The texture and framebuffer of such a copy, and whether they were made now.
    ///
    /// # Safety
    /// As for [`Self::copy`].
    unsafe fn ensure(
        &mut self,
        gl: &glow::Context,
        key: (i32, i32, u32, u32),
    ) -> Result<(glow::Texture, glow::Framebuffer, bool), Error> {
        if let (Some((texture, framebuffer)), true) = (self.made, self.key == key) {
            return Ok((texture, framebuffer, false));
        }
        let (width, height, samples, internal) = key;
        let refused = || Error::Resource(Resource::DepthCopy { width, height, samples });
        // SAFETY: the caller's; what is made is deleted if the next cannot be.
        unsafe {
            self.delete(gl);
            let texture = gl.create_texture().map_err(|_| refused())?;
            let Ok(framebuffer) = gl.create_framebuffer() else {
                gl.delete_texture(texture);
                return Err(refused());
            };
            self.made = Some((texture, framebuffer));
            let kind = if samples > 1 { glow::TEXTURE_2D_MULTISAMPLE } else { glow::TEXTURE_2D };
            gl.active_texture(glow::TEXTURE0);
            gl.bind_texture(kind, Some(texture));
            if samples > 1 {
                gl.tex_image_2d_multisample(kind, samples as i32, internal as i32, width, height, true);
            } else {
                texture_storage(gl, internal, width, height);
            }
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(framebuffer));
            let attachment = match internal {
                glow::DEPTH24_STENCIL8 | glow::DEPTH32F_STENCIL8 => glow::DEPTH_STENCIL_ATTACHMENT,
                _ => glow::DEPTH_ATTACHMENT,
            };
            gl.framebuffer_texture_2d(glow::DRAW_FRAMEBUFFER, attachment, kind, Some(texture), 0);
            gl.draw_buffers(&[glow::NONE]);
            if gl.check_framebuffer_status(glow::DRAW_FRAMEBUFFER) != glow::FRAMEBUFFER_COMPLETE {
                self.delete(gl);
                return Err(refused());
            }
            self.key = key;
            Ok((texture, framebuffer, true))
        }
    }

    /// # Safety
    /// The context is current.
    pub(crate) unsafe fn delete(&mut self, gl: &glow::Context) {
        if let Some((texture, framebuffer)) = self.made.take() {
            // SAFETY: the caller's; they are forgotten here.
            unsafe {
                gl.delete_framebuffer(framebuffer);
                gl.delete_texture(texture);
            }
        }
    }
}
