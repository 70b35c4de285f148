//! What a context can do, as a few ordered tiers.

use crate::input::Error;
use glow::HasContext;

/// How much of antumbra a context can run; each tier does what the ones before it do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Tier {
    /// OpenGL ES 3.0: masks, and the overlay for up to [`crate::BATCH_LIGHTS`] lights. Penumbrae have 8 bits.
    Es3,
    /// The same with render targets of 16-bit floats (`EXT_color_buffer_half_float` or `EXT_color_buffer_float`): penumbrae
    /// without bands.
    Es3Half,
    /// The same with render targets of 32-bit floats that blend (`EXT_color_buffer_float` and `EXT_float_blend`): the
    /// overlay for any number of lights, and lights with an area as points.
    Es3Float,
    /// OpenGL 3.3 core.
    Core33,
    /// OpenGL 3.3 core with `GL_ARB_sample_shading` (in OpenGL 4.0 itself): multisampled surfaces.
    Core33Samples,
}

/// What a context can do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Caps {
    /// The tier, which decides everything but sizes.
    pub tier: Tier,
    /// Whether switches and colour masks are set per draw buffer (OpenGL 3.0, OpenGL ES 3.2).
    pub(crate) indexed_switches: bool,
    /// Whether blend functions are set per draw buffer (OpenGL 4.0, OpenGL ES 3.2).
    pub(crate) indexed_blend: bool,
    /// Whether clip space may run from 0 to 1 (OpenGL 4.5, `GL_ARB_clip_control`).
    pub(crate) clip_control: bool,
    /// Colour attachments a framebuffer can draw to.
    pub(crate) draw_buffers: u32,
    /// Samples of a multisampled texture, at most; 1 where there are none.
    pub max_samples: u32,
    /// Pixels of a texture's side, at most.
    pub max_texture_size: u32,
}

impl Caps {
    /// Asks the context.
    ///
    /// # Errors
    /// [`Error::TooOld`] for a context that no tier describes.
    pub fn query(gl: &glow::Context) -> Result<Self, Error> {
        let version = gl.version();
        let has = |name: &str| gl.supported_extensions().contains(name);
        let at_least = |major, minor| (version.major, version.minor) >= (major, minor);
        let tier = match (version.is_embedded, at_least(3, 3)) {
            (true, _) if at_least(3, 0) => {
                let either = |name: &str| has(&format!("GL_{name}")) || has(name); // as WebGL names them
                let float = at_least(3, 2) || either("EXT_color_buffer_float");
                match (float, either("EXT_float_blend")) {
                    (true, true) => Tier::Es3Float,
                    _ if float || either("EXT_color_buffer_half_float") => Tier::Es3Half,
                    _ => Tier::Es3,
                }
            }
            (false, true) if at_least(4, 0) || has("GL_ARB_sample_shading") => Tier::Core33Samples,
            (false, true) => Tier::Core33,
            _ => {
                // SAFETY: reading a string the specification requires.
                let found = unsafe { gl.get_parameter_string(glow::VERSION) };
                return Err(Error::TooOld { found });
            }
        };
        let desktop = !version.is_embedded;
        // SAFETY: queries of implementation limits that exist in every tier that asks for them.
        let limit = |name| unsafe { gl.get_parameter_i32(name) }.max(1) as u32;
        Ok(Self {
            tier,
            indexed_switches: desktop || at_least(3, 2),
            indexed_blend: at_least(if desktop { 4 } else { 3 }, if desktop { 0 } else { 2 }),
            clip_control: desktop && (at_least(4, 5) || has("GL_ARB_clip_control")),
            draw_buffers: limit(glow::MAX_DRAW_BUFFERS).min(16),
            max_samples: if tier >= Tier::Core33Samples {
                limit(glow::MAX_COLOR_TEXTURE_SAMPLES).min(limit(glow::MAX_DEPTH_TEXTURE_SAMPLES))
            } else {
                1
            },
            max_texture_size: limit(glow::MAX_TEXTURE_SIZE),
        })
    }

    pub(crate) fn is_desktop(&self) -> bool {
        self.tier >= Tier::Core33
    }

    /// Render targets of 16-bit floats.
    pub(crate) fn half_targets(&self) -> bool {
        self.tier >= Tier::Es3Half
    }

    /// Render targets of 32-bit floats that blend.
    pub(crate) fn float_targets(&self) -> bool {
        self.tier >= Tier::Es3Float
    }

    pub(crate) fn sample_shading(&self) -> bool {
        self.tier >= Tier::Core33Samples
    }
}
