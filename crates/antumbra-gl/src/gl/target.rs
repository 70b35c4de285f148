//! Colour targets that antumbra draws to.

use super::storage::texture_storage;
use crate::input::{Error, Resource};
use glow::HasContext;

/// A colour target with its framebuffer.
pub(crate) struct Target {
    pub(crate) texture: glow::Texture,
    pub(crate) framebuffer: glow::Framebuffer,
    width: i32,
    height: i32,
    samples: u32,
    format: TargetFormat,
}

/// What a target stores.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TargetFormat {
    /// 8 bits a channel, for hard visibilities.
    Rgba8,
    /// float16, for visibilities of area lights: 8 bits of a penumbra show as bands.
    Rgba16F,
    /// float32, for sums.
    Rgba32F,
}

impl Target {
    /// Width, height and samples.
    pub(crate) fn key(&self) -> (i32, i32, u32) {
        (self.width, self.height, self.samples)
    }

    /// Makes `slot` hold a target of this size, unless it does already.
    ///
    /// # Safety
    /// A [`super::StateGuard`] is alive: bindings are changed.
    pub(crate) unsafe fn ensure(
        slot: &mut Option<Self>,
        gl: &glow::Context,
        format: TargetFormat,
        (width, height): (i32, i32),
        samples: u32,
    ) -> Result<(), Error> {
        if slot
            .as_ref()
            .is_some_and(|t| (t.width, t.height, t.samples, t.format) == (width, height, samples, format))
        {
            return Ok(());
        }
        // SAFETY: the caller's; every object is deleted if the next one cannot be made.
        unsafe {
            if let Some(old) = slot.take() {
                old.delete(gl);
            }
            let (internal, bits) = match format {
                TargetFormat::Rgba8 => (glow::RGBA8, 8),
                TargetFormat::Rgba16F => (glow::RGBA16F, 16),
                TargetFormat::Rgba32F => (glow::RGBA32F, 32),
            };
            let refused = || Error::Resource(Resource::Target { width, height, bits, samples });
            let texture = gl.create_texture().map_err(|_| refused())?;
            let Ok(framebuffer) = gl.create_framebuffer() else {
                gl.delete_texture(texture);
                return Err(refused());
            };
            let kind = if samples > 1 { glow::TEXTURE_2D_MULTISAMPLE } else { glow::TEXTURE_2D };
            gl.bind_texture(kind, Some(texture));
            if samples > 1 {
                gl.tex_image_2d_multisample(kind, samples as i32, internal as i32, width, height, true);
            } else {
                texture_storage(gl, internal, width, height);
            }
            gl.bind_framebuffer(glow::DRAW_FRAMEBUFFER, Some(framebuffer));
            gl.framebuffer_texture_2d(
                glow::DRAW_FRAMEBUFFER,
                glow::COLOR_ATTACHMENT0,
                kind,
                Some(texture),
                0,
            );
            let target = Self { texture, framebuffer, width, height, samples, format };
            if gl.check_framebuffer_status(glow::DRAW_FRAMEBUFFER) != glow::FRAMEBUFFER_COMPLETE {
                target.delete(gl);
                return Err(refused());
            }
            *slot = Some(target);
        }
        Ok(())
    }

    /// # Safety
    /// The target is of this context and not used afterwards.
    pub(crate) unsafe fn delete(self, gl: &glow::Context) {
        // SAFETY: the caller's.
        unsafe {
            gl.delete_framebuffer(self.framebuffer);
            gl.delete_texture(self.texture);
        }
    }
}
