//! What a host has drawn, as textures.

/// The textures that say what is seen through each pixel. All of one size and sample count,
/// covering at least the viewport; texel (x, y) belongs to window pixel (x, y).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// The depth buffer as a texture: `TEXTURE_2D`, or `TEXTURE_2D_MULTISAMPLE` with more than one sample.
    /// Depth comparison must be off (it is unless the host turned it on).
    ///
    /// A host that draws to textures has one: attach it to the framebuffer that the scene is drawn to,
    /// and bind a second framebuffer, with the same colour and no depth, for the overlay. A host that
    /// draws to the window or to renderbuffers copies its depth once a frame: `glBlitFramebuffer` with
    /// `DEPTH_BUFFER_BIT` into a framebuffer with a depth texture of the same format and size.
    pub depth: glow::Texture,
    /// Samples a pixel; 1 for plain textures.
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
    pub ids: Option<glow::Texture>,
}

impl Surface {
    /// A plain 24-bit depth texture and nothing else.
    pub fn from_depth(depth: glow::Texture) -> Self {
        Self { depth, samples: 1, depth_format: DepthFormat::default(), normals: None, ids: None }
    }
}

/// Flag in an id texture: no shadow falls here.
pub const NO_SHADOW: u32 = 1 << 31;

/// How a depth buffer stores depth.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    fn default() -> Self {
        Self { bits: 24, float: false, background: 1.0, zero_to_one: false }
    }
}

/// A texture of surface normals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Normals {
    /// xyz, of about unit length, to either side of the surface.
    pub texture: glow::Texture,
    /// What the texture's xyz are.
    pub space: NormalSpace,
    /// Whether the texture holds (n + 1)/2, as unsigned formats do, and not n.
    pub biased: bool,
}

/// The space of the host's normals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NormalSpace {
    /// World space.
    World,
    /// View space.
    View,
}
