//! What the host draws into: colour, normals, ids and depth.

use crate::HostError;
use glow::HasContext;

/// How colour is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum ColorFormat {
    /// float16, linear: pictures.
    #[default]
    Rgba16F,
    /// 8 bits: what a window has; for measuring time.
    Rgba8,
}

/// Textures and framebuffers of one size.
pub(crate) struct Targets {
    pub(crate) color: glow::Texture,
    pub(crate) normals: glow::Texture,
    pub(crate) ids: glow::Texture,
    pub(crate) depth: glow::Texture,
    /// Colour, normals, ids and depth.
    pub(crate) all: glow::Framebuffer,
    /// Colour and depth: what a host without shadows draws into.
    pub(crate) plain: glow::Framebuffer,
    /// Colour alone: where shadows go.
    pub(crate) color_only: glow::Framebuffer,
    /// One sample a pixel, to resolve into; only for multisampled targets.
    pub(crate) resolved: Option<(glow::Texture, glow::Framebuffer)>,
    pub(crate) key: (i32, i32, u32, ColorFormat),
}

impl Targets {
    /// Makes all of them.
    pub(crate) fn new(
        gl: &glow::Context,
        width: i32,
        height: i32,
        samples: u32,
        format: ColorFormat,
    ) -> Result<Self, HostError> {
        let color_format = match format {
            ColorFormat::Rgba16F => (glow::RGBA16F, glow::RGBA, glow::HALF_FLOAT),
            ColorFormat::Rgba8 => (glow::RGBA8, glow::RGBA, glow::UNSIGNED_BYTE),
        };
        let texture = |samples: u32, (internal, layout, kind): (u32, u32, u32)| {
            // SAFETY: a fresh texture of a format every tier has; no memory of ours is read.
            unsafe {
                let texture = gl.create_texture().map_err(HostError::Driver)?;
                if samples > 1 {
                    let target = glow::TEXTURE_2D_MULTISAMPLE;
                    gl.bind_texture(target, Some(texture));
                    gl.tex_image_2d_multisample(target, samples as i32, internal as i32, width, height, true);
                } else {
                    gl.bind_texture(glow::TEXTURE_2D, Some(texture));
                    let none = glow::PixelUnpackData::Slice(None);
                    gl.tex_image_2d(
                        glow::TEXTURE_2D,
                        0,
                        internal as i32,
                        width,
                        height,
                        0,
                        layout,
                        kind,
                        none,
                    );
                    for name in [glow::TEXTURE_MIN_FILTER, glow::TEXTURE_MAG_FILTER] {
                        gl.tex_parameter_i32(glow::TEXTURE_2D, name, glow::NEAREST as i32);
                    }
                    gl.tex_parameter_i32(glow::TEXTURE_2D, glow::TEXTURE_MAX_LEVEL, 0);
                }
                Ok::<_, HostError>(texture)
            }
        };
        let target = if samples > 1 { glow::TEXTURE_2D_MULTISAMPLE } else { glow::TEXTURE_2D };
        let framebuffer = |target: u32, colors: &[glow::Texture], depth: Option<glow::Texture>| {
            // SAFETY: attaches textures made above; the buffers listed are the ones attached.
            unsafe {
                let framebuffer = gl.create_framebuffer().map_err(HostError::Driver)?;
                gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
                for (slot, &color) in (glow::COLOR_ATTACHMENT0..).zip(colors) {
                    gl.framebuffer_texture_2d(glow::FRAMEBUFFER, slot, target, Some(color), 0);
                }
                gl.framebuffer_texture_2d(glow::FRAMEBUFFER, glow::DEPTH_ATTACHMENT, target, depth, 0);
                let all = [glow::COLOR_ATTACHMENT0, glow::COLOR_ATTACHMENT1, glow::COLOR_ATTACHMENT2];
                gl.draw_buffers(&all[..colors.len()]);
                match gl.check_framebuffer_status(glow::FRAMEBUFFER) {
                    glow::FRAMEBUFFER_COMPLETE => Ok(framebuffer),
                    status => Err(HostError::Driver(format!(
                        "a {width}x{height} framebuffer with {samples} samples is incomplete (0x{status:x})"
                    ))),
                }
            }
        };
        let color = texture(samples, color_format)?;
        // The fourth component is the distance, which pictures read back.
        let normals = match format {
            ColorFormat::Rgba16F => texture(samples, (glow::RGBA32F, glow::RGBA, glow::FLOAT))?,
            ColorFormat::Rgba8 => texture(samples, (glow::RGBA16F, glow::RGBA, glow::HALF_FLOAT))?,
        };
        let ids = texture(samples, (glow::R32UI, glow::RED_INTEGER, glow::UNSIGNED_INT))?;
        let depth = texture(samples, (glow::DEPTH_COMPONENT32F, glow::DEPTH_COMPONENT, glow::FLOAT))?;
        let resolved = if samples > 1 {
            let texture = texture(1, color_format)?;
            Some((texture, framebuffer(glow::TEXTURE_2D, &[texture], None)?))
        } else {
            None
        };
        Ok(Self {
            all: framebuffer(target, &[color, normals, ids], Some(depth))?,
            plain: framebuffer(target, &[color], Some(depth))?,
            color_only: framebuffer(target, &[color], None)?,
            color,
            normals,
            ids,
            depth,
            resolved,
            key: (width, height, samples, format),
        })
    }

    /// # Safety
    /// The targets are of this context and not used afterwards.
    pub(crate) unsafe fn delete(&self, gl: &glow::Context) {
        // SAFETY: the caller's.
        unsafe {
            let (texture, framebuffer) = self.resolved.unzip();
            for texture in [Some(self.color), Some(self.normals), Some(self.ids), Some(self.depth), texture] {
                texture.into_iter().for_each(|t| gl.delete_texture(t));
            }
            for framebuffer in [Some(self.all), Some(self.plain), Some(self.color_only), framebuffer] {
                framebuffer.into_iter().for_each(|f| gl.delete_framebuffer(f));
            }
        }
    }
}
