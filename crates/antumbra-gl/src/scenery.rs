//! Lights, what blocks them, and what shadows fall on.

use antumbra_math::{Plane, Rectangle, TriangleMesh};
use glam::{DMat4, DVec3, Mat4, Vec3};
use std::sync::Arc;

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
    /// What the light's surface is around its place: nothing for lights without extent.
    pub area: Area,
    /// Spot lights: the half-angle, radians, up to which the light is full; from 0 to the outer angle.
    pub inner_angle: f32,
    /// Constant, linear and quadratic attenuation with the distance: [0, 0, 1] is physical. Finite,
    /// not negative, not all zero.
    pub attenuation: [f32; 3],
}

/// The surface of a light that has one, centred on its position. All sizes in metres, positive.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Area {
    /// Light from one point, or one direction.
    #[default]
    None,
    /// A glowing ball.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// A disc that shines to one side.
    Disc {
        /// Unit normal of the side that shines.
        direction: DVec3,
        /// Radius.
        radius: f64,
    },
    /// A rectangle that shines to one side.
    Rectangle {
        /// Unit normal of the side that shines.
        direction: DVec3,
        /// From the centre to the middle of one side.
        half_right: DVec3,
        /// From the centre to the middle of a neighbouring side, at right angles.
        half_up: DVec3,
    },
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

    /// The same light with a surface: `intensity` is then that of the point light it becomes as it shrinks.
    pub fn with_area(self, area: Area) -> Self {
        Self { area, ..self }
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
        if !self.area.is_sane() {
            return Some(
                "its area has a size that is not positive, or a direction that is not of unit length",
            );
        }
        if self.area != Area::None && !matches!(self.place, antumbra_math::Light::Point { .. }) {
            return Some("only a light at a point has an area around it");
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
        Self { place, intensity, area: Area::None, inner_angle: 0.0, attenuation: [0.0, 0.0, 1.0] }
    }
}

impl Area {
    /// Whether sizes are positive and finite and directions of unit length.
    fn is_sane(&self) -> bool {
        let size = |x: f64| x.is_finite() && x > 0.0;
        let unit = |v: &DVec3| v.is_finite() && (v.length() - 1.0).abs() < 1e-4;
        match self {
            Self::None => true,
            Self::Sphere { radius } => size(*radius),
            Self::Disc { direction, radius } => unit(direction) && size(*radius),
            Self::Rectangle { direction, half_right, half_up } => {
                unit(direction) && size(half_right.length()) && size(half_up.length())
            }
        }
    }
}

/// A shape that blocks light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Occluder {
    /// The shape, world space.
    pub shape: antumbra_math::Shape,
    /// The number that the host's id texture shows where this occluder is seen: not 0, below
    /// [`crate::NO_SHADOW`]. Several occluders may share one: they are one solid and do not shadow each
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

/// A mesh that blocks light, for the techniques that cast from triangles.
#[derive(Clone, Debug)]
pub struct MeshOccluder {
    /// The mesh, in its own space. What a technique keeps of it is found by [`TriangleMesh::id`]: make a mesh
    /// once and use it every frame.
    pub mesh: Arc<TriangleMesh>,
    /// From the mesh's space to the world: affine, of either handedness, not flat.
    pub model: DMat4,
    /// As [`Occluder::id`]; a mesh may shadow itself all the same.
    pub id: u32,
}

/// A flat surface that the host has drawn and that shadows fall on, for the techniques that are confined to
/// planes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Receiver {
    /// Where it is.
    pub shape: ReceiverShape,
    /// What the host's id texture shows there; 0 for a host without ids.
    pub id: u32,
}

/// The shapes of receivers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ReceiverShape {
    /// An infinite plane.
    Plane(Plane),
    /// A flat rectangle.
    Rectangle(Rectangle),
}

impl Receiver {
    /// The plane the receiver lies in, its normal to either side; not finite for a rectangle without area.
    pub fn plane(&self) -> Plane {
        match self.shape {
            ReceiverShape::Plane(plane) => plane,
            ReceiverShape::Rectangle(r) => {
                Plane::through(r.center, r.half_right.cross(r.half_forward).normalize())
            }
        }
    }
}

/// What a technique is asked to do: everything of a frame but the camera and the host's surfaces.
#[derive(Clone, Copy, Debug, Default)]
pub struct Scenery<'a> {
    /// The lights.
    pub lights: &'a [Light],
    /// Shapes that block them.
    pub occluders: &'a [Occluder],
    /// Meshes that block them.
    pub meshes: &'a [MeshOccluder],
    /// Flat surfaces that shadows fall on.
    pub receivers: &'a [Receiver],
}
