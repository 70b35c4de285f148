//! What a host has drawn, as textures.

use super::Texture;

/// The textures that say what is seen through each pixel. All of one size and sample count,
/// covering at least the viewport; texel (x, y) belongs to window pixel (x, y).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Surface {
    /// The depth buffer.
    pub depth: Depth,
    /// Samples a pixel; 1 for plain textures. Of a depth that is copied the framebuffer says it.
    pub samples: u32,
    /// How depth is stored.
    pub depth_format: DepthFormat,
    /// Normals; without them they are found from the depth buffer, facet by facet.
    pub normals: Option<Normals>,
    /// `R32UI`: the [`crate::Occluder::id`] of what is seen, 0 for anything else, plus
    /// [`NO_SHADOW`] where no shadow may fall. With ids a surface never shadows itself, whatever
    /// its shape in the host's mesh. Without, geometry decides: what is seen inside a ball is taken
    /// for the host's mesh of that ball, and what lies in a flat shape's plane to the precision of
    /// the depth buffer for that shape. Right for hosts that draw what they describe; the shadows of
    /// shapes that are not drawn need ids where they reach into what is.
    pub ids: Option<Texture>,
}

/// Where the depth of what the host has drawn is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Depth {
    /// In a texture: `TEXTURE_2D`, or `TEXTURE_2D_MULTISAMPLE` with more than one sample. Depth comparison must be off (it
    /// is unless the host turned it on). It must not be attached to the framebuffer that the overlay is drawn to: bind a
    /// second one with the same colour and no depth.
    Texture(Texture),
    /// In the framebuffer that the overlay is drawn to, or that is bound for drawing when masks are asked for: a window's,
    /// or one with renderbuffers or textures, multisampled ones too. The renderer copies it in each frame to a texture of
    /// its own, which it keeps. Where the context has no multisampled textures (OpenGL ES) one of the samples is copied,
    /// and the shadows' edges are as fine as the pixels. OpenGL errors of the host's own that are pending when the copy is
    /// made, in the first frame of a size, are dropped.
    Copied,
}

impl Surface {
    /// A depth texture and nothing else: of 24 bits, unless it is said otherwise.
    pub fn from_depth(depth: Texture) -> Self {
        Self::new(Depth::Texture(depth))
    }

    /// The depth of the framebuffer that is drawn to, copied by the renderer; see [`Depth::Copied`]. Bits, floats and
    /// samples are found out: of the [`DepthFormat`] only what is said of the background and of clip space counts.
    pub fn copied() -> Self {
        Self::new(Depth::Copied)
    }

    /// The depth, unless it has still to be copied.
    pub(crate) fn depth_texture(&self) -> Option<glow::Texture> {
        match self.depth {
            Depth::Texture(texture) => Some(texture.glow()),
            Depth::Copied => None,
        }
    }

    fn new(depth: Depth) -> Self {
        Self { depth, samples: 1, depth_format: DepthFormat::default(), normals: None, ids: None }
    }

    /// The same with so many [`Self::samples`].
    pub fn with_samples(self, samples: u32) -> Self {
        Self { samples, ..self }
    }

    /// The same with depth stored in this way.
    pub fn with_format(self, depth_format: DepthFormat) -> Self {
        Self { depth_format, ..self }
    }

    /// The same with [`Self::normals`].
    pub fn with_normals(self, normals: Normals) -> Self {
        Self { normals: Some(normals), ..self }
    }

    /// The same with [`Self::ids`].
    pub fn with_ids(self, ids: Texture) -> Self {
        Self { ids: Some(ids), ..self }
    }
}

/// Flag in an id texture: no shadow falls here.
pub const NO_SHADOW: u32 = 1 << 31;

/// How a depth buffer stores depth.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct DepthFormat {
    /// Bits: 24 for `DEPTH_COMPONENT24` and (of the mantissa) `DEPTH_COMPONENT32F`, 16 for
    /// `DEPTH_COMPONENT16`.
    pub bits: u32,
    /// Whether depth is a float, `DEPTH_COMPONENT32F`: its steps shrink towards 0.
    pub float: bool,
    /// The depth where nothing was drawn: 1, or 0 with a reversed projection.
    pub background: f32,
    /// Whether clip space runs from 0 to 1 (`glClipControl`) and not from -1 to 1.
    pub zero_to_one: bool,
}

impl Default for DepthFormat {
    /// 24 bits, 1 where nothing was drawn, clip space from -1 to 1: what most hosts have.
    fn default() -> Self {
        Self::fixed(24)
    }
}

impl DepthFormat {
    /// Fixed point, so many bits: `DEPTH_COMPONENT16`, `DEPTH_COMPONENT24`, `DEPTH24_STENCIL8`.
    pub const fn fixed(bits: u32) -> Self {
        Self { bits, float: false, background: 1.0, zero_to_one: false }
    }

    /// Floats: `DEPTH_COMPONENT32F`, `DEPTH32F_STENCIL8`.
    pub const fn float() -> Self {
        Self { float: true, ..Self::fixed(24) }
    }

    /// The same with 0 where nothing was drawn, as with reversed projections.
    pub const fn reversed(self) -> Self {
        Self { background: 0.0, ..self }
    }

    /// The same for a clip space from 0 to 1 (`glClipControl(.., GL_ZERO_TO_ONE)`).
    pub const fn zero_to_one(self) -> Self {
        Self { zero_to_one: true, ..self }
    }
}

/// A texture of surface normals.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Normals {
    /// xyz, of about unit length, to either side of the surface.
    pub texture: Texture,
    /// What the texture's xyz are.
    pub space: NormalSpace,
    /// Whether the texture holds (n + 1)/2, as unsigned formats do, and not n.
    pub biased: bool,
}

impl Normals {
    /// Normals of this space, as signed or floating-point formats hold them.
    pub fn new(texture: Texture, space: NormalSpace) -> Self {
        Self { texture, space, biased: false }
    }

    /// The same held as (n + 1)/2, as in unsigned formats such as `RGBA8`.
    pub fn biased(self) -> Self {
        Self { biased: true, ..self }
    }
}

/// The space of the host's normals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NormalSpace {
    /// World space.
    World,
    /// View space.
    View,
}
