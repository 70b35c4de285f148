//! What blocks light.

use super::{Matrix, Vector};
use antumbra_math::{
    Cone, Disc, MeshError, PlacingError, Plane, Rectangle, Shape, Sphere, Triangle, TriangleMesh,
};
use glam::{DMat4, DVec3};
use std::sync::Arc;

/// A shape that blocks light.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Occluder {
    /// The shape, world space. One that is not finite or has no extent blocks nothing.
    pub shape: Shape,
    /// The number that the host's id texture shows where this occluder is seen: not 0, below
    /// [`crate::NO_SHADOW`]. Several occluders may share one: they are one solid and do not shadow each
    /// other. 0 for an occluder that the host does not draw, or a host without ids.
    pub id: u32,
}

impl Occluder {
    /// An occluder without an id.
    pub fn new(shape: impl Into<Shape>) -> Self {
        Self { shape: shape.into(), id: 0 }
    }

    /// The same with an id.
    pub fn with_id(self, id: u32) -> Self {
        Self { id, ..self }
    }

    /// A ball.
    pub fn sphere(center: impl Into<Vector>, radius: impl Into<f64>) -> Self {
        Self::new(Sphere { center: center.into().glam(), radius: radius.into() })
    }

    /// A disc, seen and blocking from both sides.
    pub fn disc(center: impl Into<Vector>, normal: impl Into<Vector>, radius: impl Into<f64>) -> Self {
        let normal = normal.into().glam().normalize_or_zero();
        Self::new(Disc { center: center.into().glam(), normal, radius: radius.into() })
    }

    /// A triangle, seen and blocking from both sides.
    pub fn triangle(vertices: [impl Into<Vector>; 3]) -> Self {
        Self::new(Triangle { vertices: vertices.map(|v| v.into().glam()) })
    }

    /// A flat rectangle around `center`, seen and blocking from both sides; `half_right` and
    /// `half_forward` reach from there to the middles of two neighbouring sides, at right angles.
    pub fn rectangle(
        center: impl Into<Vector>,
        half_right: impl Into<Vector>,
        half_forward: impl Into<Vector>,
    ) -> Self {
        Self::new(Rectangle {
            center: center.into().glam(),
            half_right: half_right.into().glam(),
            half_forward: half_forward.into().glam(),
        })
    }

    /// An infinite plane, which takes the light from everything on its other side.
    pub fn plane(point: impl Into<Vector>, normal: impl Into<Vector>) -> Self {
        let normal = normal.into().glam().normalize_or_zero();
        Self::new(Plane::through(point.into().glam(), normal))
    }

    /// A shape in its own space, placed in the world by the host's model matrix: any affine matrix under which it stays a
    /// shape of its kind. Triangles and planes always do; rectangles while their sides stay at right angles; discs while
    /// they stay round; cones while their base stays round and their axis stands on it, such as a cone scaled along its axis
    /// or mirrored; balls under rotation, reflection, uniform scale and translation.
    ///
    /// # Errors
    /// What the matrix makes of the shape.
    pub fn placed(shape: impl Into<Shape>, model: impl Into<Matrix>) -> Result<Self, PlacingError> {
        shape.into().placed(&model.into().glam()).map(Self::new)
    }

    /// A solid cone; none where its apex is in the middle of its base.
    pub fn cone(base_center: impl Into<Vector>, apex: impl Into<Vector>, radius: impl Into<f64>) -> Self {
        let (base_center, apex) = (base_center.into().glam(), apex.into().glam());
        let along = apex - base_center;
        let (axis, height) =
            if along.is_finite() { along.normalize_and_length() } else { (DVec3::NAN, f64::NAN) };
        // Without a height it has no axis.
        let radius = if height == 0.0 { 0.0 } else { radius.into() };
        Self::new(Cone { base_center, axis, radius, height })
    }
}

/// A mesh that blocks light, for the techniques that cast from triangles.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct MeshOccluder {
    /// The mesh, in its own space. What a technique keeps of it is found by [`TriangleMesh::id`]: make a mesh
    /// once and use it every frame.
    pub mesh: Arc<TriangleMesh>,
    /// From the mesh's space to the world: affine, of either handedness, not flat.
    pub model: DMat4,
    /// As [`Occluder::id`]; a mesh may shadow itself all the same.
    pub id: u32,
}

impl MeshOccluder {
    /// A mesh, and the host's model matrix: affine, of either handedness, not flat.
    pub fn new(mesh: Arc<TriangleMesh>, model: impl Into<Matrix>) -> Self {
        Self { mesh, model: model.into().glam(), id: 0 }
    }

    /// The same with an id.
    pub fn with_id(self, id: u32) -> Self {
        Self { id, ..self }
    }

    /// A mesh of these vertices and triangles, three vertices each by their place in the list, to be made once and used in
    /// every frame.
    ///
    /// # Errors
    /// [`MeshError`] for a mesh without triangles, with an index or a number that is none, or too large.
    pub fn mesh<V: Into<Vector>>(
        positions: impl IntoIterator<Item = V>,
        triangles: impl IntoIterator<Item = [u32; 3]>,
    ) -> Result<Arc<TriangleMesh>, MeshError> {
        let positions: Vec<DVec3> = positions.into_iter().map(|v| v.into().glam()).collect();
        TriangleMesh::new(positions, triangles.into_iter().collect()).map(Arc::new)
    }
}
