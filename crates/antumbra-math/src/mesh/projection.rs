//! The matrix that flattens things into their shadows on a plane.

use glam::{DMat4, DVec4};

use crate::Plane;

/// The matrix that takes a homogeneous point to its shadow on a plane, for a light at a homogeneous
/// point (weight 0: the direction to it): (p·l) I - l pᵀ, with p the plane (n, -offset) (Blinn, "Me and
/// My (Fake) Shadow", 1988). Its sign is such that points between the plane and the light get
/// a positive weight, whichever side of the plane the light is on.
///
/// A point casts a shadow only if it is on the light's side of the plane and nearer to it than the
/// light. Beyond the light the weight is negative (zero at its height), and OpenGL's clipping leaves
/// such points out. Points behind the plane get a positive weight and a place on the plane, an
/// anti-shadow: clip them away before, or measure [`Plane::height`].
///
/// With the light in the plane the matrix sends everything to the light itself, or to nothing, and
/// draws no area. Numbers that are not finite give a matrix that is not finite.
pub fn planar_projection(plane: &Plane, light: DVec4) -> DMat4 {
    let p = plane.normal.extend(-plane.offset);
    // A position with a negative weight is the same position; a direction has no such twin.
    let l = if light.w < 0.0 { -light } else { light };
    let height = p.dot(l);
    let sign = if height < 0.0 { -1.0 } else { 1.0 };
    let outer = DMat4::from_cols(l * p.x, l * p.y, l * p.z, l * p.w);
    (DMat4::from_diagonal(DVec4::splat(height)) - outer) * sign
}
