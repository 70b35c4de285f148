//! What a host tells antumbra: its camera, its surfaces, its lights and what blocks them.

use glam::{DMat4, DVec3, Mat4, Vec3};

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
    /// Half-spaces (the sides that the normals point to) that hold everything the host shows, such
    /// as the space above a floor that nothing is seen below; empty if there are none to tell. They
    /// save time where shadows would go on unseen. Opaque planes among the occluders, with an id,
    /// count by themselves.
    pub bounds: &'a [antumbra_math::Plane],
    /// Light from everywhere that no shadow takes away, linear RGB, in units of irradiance: a
    /// host that adds `albedo * ambient` to `albedo / π * Σ E` gives π times its `ambient`.
    pub ambient: Vec3,
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

/// A light: where it is, and what it sends.
///
/// A light whose place is not finite, or whose direction is zero, is off. Other numbers that make no
/// sense are [`crate::Error::BadLight`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Where light comes from, world space.
    pub place: antumbra_math::Light,
    /// Linear RGB times intensity: candela, lux for a directional light. Finite, not negative.
    pub intensity: Vec3,
    /// Spot lights: the half-angle, radians, up to which the light is full; from 0 to the outer angle.
    pub inner_angle: f32,
    /// Constant, linear and quadratic attenuation with the distance: [0, 0, 1] is physical. Finite,
    /// not negative, not all zero.
    pub attenuation: [f32; 3],
}

impl Light {
    /// A point light of `intensity` candela.
    pub fn point(position: impl Into<DVec3>, intensity: Vec3) -> Self {
        Self::new(antumbra_math::Light::Point { position: position.into() }, intensity)
    }

    /// A directional light of `illuminance` lux that travels along `direction` (any length but zero).
    pub fn directional(direction: impl Into<DVec3>, illuminance: Vec3) -> Self {
        let direction = direction.into().normalize_or_zero();
        Self::new(antumbra_math::Light::Directional { direction }, illuminance)
    }

    /// A spot light of `intensity` candela that shines along `direction` (any length but zero),
    /// full within `inner_angle`, nothing outside `outer_angle` (half-angles, radians), with the
    /// falloff of glTF's KHR_lights_punctual between.
    pub fn spot(
        position: impl Into<DVec3>,
        direction: impl Into<DVec3>,
        inner_angle: f32,
        outer_angle: f32,
        intensity: Vec3,
    ) -> Self {
        let place = antumbra_math::Light::Spot {
            position: position.into(),
            direction: direction.into().normalize_or_zero(),
            outer_angle: outer_angle.into(),
        };
        Self { inner_angle, ..Self::new(place, intensity) }
    }

    /// What is wrong with the light's numbers, if anything.
    pub(crate) fn fault(&self) -> Option<&'static str> {
        let sane = |x: f32| x.is_finite() && x >= 0.0;
        if !self.intensity.to_array().into_iter().all(sane) {
            return Some("its intensity is negative or not finite");
        }
        if !self.attenuation.into_iter().all(sane) || self.attenuation == [0.0; 3] {
            return Some("its attenuation is negative, not finite, or all zero");
        }
        if let antumbra_math::Light::Spot { outer_angle, .. } = self.place {
            let angles_fit = sane(self.inner_angle) && f64::from(self.inner_angle) <= outer_angle + 1e-6;
            if !angles_fit || outer_angle > std::f64::consts::PI {
                return Some("a spot's half-angles must be 0 <= inner <= outer <= π");
            }
        }
        None
    }

    fn new(place: antumbra_math::Light, intensity: Vec3) -> Self {
        Self { place, intensity, inner_angle: 0.0, attenuation: [0.0, 0.0, 1.0] }
    }
}

/// A shape that blocks light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Occluder {
    /// The shape, world space.
    pub shape: antumbra_math::Shape,
    /// The number that the host's id texture shows where this occluder is seen: not 0, below
    /// [`NO_SHADOW`]. Several occluders may share one: they are one solid and do not shadow each
    /// other. 0 for an occluder that the host does not draw, or a host without ids.
    pub id: u32,
}

impl Occluder {
    /// An occluder without an id.
    pub fn new(shape: antumbra_math::Shape) -> Self {
        Self { shape, id: 0 }
    }

    /// The same with an id.
    pub fn with_id(self, id: u32) -> Self {
        Self { id, ..self }
    }

    /// A ball.
    pub fn sphere(center: impl Into<DVec3>, radius: f64) -> Self {
        Self::new(antumbra_math::Sphere { center: center.into(), radius }.into())
    }

    /// A disc, seen and blocking from both sides.
    pub fn disc(center: impl Into<DVec3>, normal: impl Into<DVec3>, radius: f64) -> Self {
        let normal = normal.into().normalize_or_zero();
        Self::new(antumbra_math::Disc { center: center.into(), normal, radius }.into())
    }

    /// A triangle, seen and blocking from both sides.
    pub fn triangle(vertices: [impl Into<DVec3>; 3]) -> Self {
        Self::new(antumbra_math::Triangle { vertices: vertices.map(Into::into) }.into())
    }

    /// A flat rectangle around `center`, seen and blocking from both sides; `half_right` and
    /// `half_forward` reach from there to the middles of two neighbouring sides, at right angles.
    pub fn rectangle(
        center: impl Into<DVec3>,
        half_right: impl Into<DVec3>,
        half_forward: impl Into<DVec3>,
    ) -> Self {
        let (center, half_right, half_forward) = (center.into(), half_right.into(), half_forward.into());
        Self::new(antumbra_math::Rectangle { center, half_right, half_forward }.into())
    }

    /// An infinite plane, which takes the light from everything on its other side.
    pub fn plane(point: impl Into<DVec3>, normal: impl Into<DVec3>) -> Self {
        Self::new(antumbra_math::Plane::through(point.into(), normal.into().normalize_or_zero()).into())
    }

    /// A shape in its own space, placed in the world by the host's model matrix: rotation, uniform
    /// scale and translation. `None` for any other matrix, under which a ball would not be a ball.
    pub fn placed(shape: impl Into<antumbra_math::Shape>, model: Mat4) -> Option<Self> {
        shape.into().placed(&model.as_dmat4()).map(Self::new)
    }

    /// A solid cone.
    pub fn cone(base_center: impl Into<DVec3>, apex: impl Into<DVec3>, radius: f64) -> Self {
        let (base_center, apex) = (base_center.into(), apex.into());
        let along = apex - base_center;
        let (axis, height) =
            if along.is_finite() { along.normalize_and_length() } else { (DVec3::NAN, f64::NAN) };
        Self::new(antumbra_math::Cone { base_center, axis, radius, height }.into())
    }
}
