//! What blocks light.

use antumbra_math::TriangleMesh;
use glam::{DMat4, DVec3, Mat4};
use std::sync::Arc;

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
