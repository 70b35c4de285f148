//! What a host tells antumbra: its camera and what it has drawn.

use crate::scenery::{Light, MeshOccluder, Occluder, Receiver, Scenery};
use crate::technique::composite::Component;
use glam::{DMat4, Mat4, Vec3};

/// One frame of the host, as far as shadows are concerned.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// The host's camera.
    pub camera: Camera,
    /// The host's viewport: x, y, width, height, as in `glViewport`.
    pub viewport: [i32; 4],
    /// What the host has drawn. Its textures must exist and be of the kinds [`Surface`] says: what
    /// OpenGL does with others is undefined.
    pub surface: Surface,
    /// The lights, any number of them.
    pub lights: &'a [Light],
    /// What blocks them.
    pub occluders: &'a [Occluder],
    /// Meshes that block them too, for the techniques that cast from triangles.
    pub meshes: &'a [MeshOccluder],
    /// The flat surfaces that techniques confined to planes draw shadows on; others do not ask.
    pub receivers: &'a [Receiver],
    /// Half-spaces (the sides that the normals point to) that hold everything the host shows, such
    /// as the space above a floor that nothing is seen below; empty if there are none to tell. They
    /// save time where shadows would go on unseen. Opaque planes among the occluders, with an id,
    /// count by themselves.
    pub bounds: &'a [antumbra_math::Plane],
    /// Where the technique `composite` has the components of lights with an area, if not on their rims: for
    /// viewers that move them one by one. Of lights named here these are all but the central one. Other techniques do
    /// not ask.
    pub components: &'a [Component],
    /// Light from everywhere that no shadow takes away, linear RGB, in units of irradiance: a
    /// host that adds `albedo * ambient` to `albedo / π * Σ E` gives π times its `ambient`.
    pub ambient: Vec3,
}

impl<'a> Frame<'a> {
    /// What a host has drawn, with no lights, nothing that blocks them and no ambient light yet.
    pub fn new(camera: Camera, viewport: [i32; 4], surface: Surface) -> Self {
        Self {
            camera,
            viewport,
            surface,
            lights: &[],
            occluders: &[],
            meshes: &[],
            receivers: &[],
            bounds: &[],
            components: &[],
            ambient: Vec3::ZERO,
        }
    }

    /// The part of the frame that says what a technique is asked to do.
    pub fn scenery(&self) -> Scenery<'a> {
        Scenery {
            lights: self.lights,
            occluders: self.occluders,
            meshes: self.meshes,
            receivers: self.receivers,
        }
    }
}

/// The host's view and projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// World to view space: a rotation and a translation, nothing else. Right-handed, looking
    /// along -Z.
    pub view: DMat4,
    /// View to clip space: any perspective or orthographic projection, off-centre, infinite and
    /// reversed ones too.
    pub projection: DMat4,
}

impl Camera {
    /// The host's matrices, column-major as OpenGL takes them.
    pub fn new(view: Mat4, projection: Mat4) -> Self {
        Self { view: view.as_dmat4(), projection: projection.as_dmat4() }
    }
}

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
    /// `R32UI`: the [`Occluder::id`] of what is seen, 0 for anything else, plus
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
