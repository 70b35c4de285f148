//! What the papers' equations are not for.

use core::fmt;

use glam::DVec3;

use crate::{PlaneFrame, Shape};

/// The largest sine of the angle between an axis and the plane's normal at which a disc counts as
/// parallel to the plane: ten times what a rotation in float32 leaves.
const PARALLEL: f64 = 1e-6;

/// Sinking into the plane by less than this fraction of the coordinates is rounding of something that
/// stands on it: ten times what a model matrix in float32 leaves.
const RESTING: f64 = 1e-6;

/// Why the papers' method cannot draw a shape's shadow on a plane, wherever the light is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Refusal {
    /// The papers have no equations for planes and rectangles. (One that lies in the plane is the
    /// receiver itself, and casts nothing on it.)
    Shape,
    /// A disc that is not parallel to the plane.
    TiltedDisc,
    /// A cone whose axis is not perpendicular to the plane.
    TiltedCone,
    /// Not wholly on one side of the plane.
    ThroughPlane,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Shape => "only discs, triangles, spheres and cones have equations",
            Self::TiltedDisc => "the disc is not parallel to the receiver",
            Self::TiltedCone => "the cone's axis is not perpendicular to the receiver",
            Self::ThroughPlane => "it passes through the receiver's plane",
        })
    }
}

impl core::error::Error for Refusal {}

/// The distance below which a shape of `size` around `center` rests on the plane, metres.
pub(super) fn slack(frame: &PlaneFrame, center: DVec3, size: f64) -> f64 {
    RESTING * (size + center.length() + frame.origin.length())
}

/// Why [`super::cast`] refuses a shape on a plane, for any light; `None` if it does not. Shapes with
/// an infinity or a NaN are not refused: they cast nothing.
pub fn refusal(shape: &Shape, frame: &PlaneFrame) -> Option<Refusal> {
    if !shape.is_finite() || !frame.is_finite() {
        return None;
    }
    let is_tilted = |axis: DVec3| axis.cross(frame.normal).length() > PARALLEL * axis.length();
    match shape {
        Shape::Plane(plane) => {
            let nearest = plane.normal * plane.offset;
            let lies = !is_tilted(plane.normal) && frame.height(nearest).abs() <= slack(frame, nearest, 0.0);
            (!lies).then_some(Refusal::Shape)
        }
        Shape::Rectangle(rectangle) => {
            let (center, radius) = shape.bounding_sphere();
            let slack = slack(frame, center, radius);
            let lies = rectangle.corners().iter().all(|&corner| frame.height(corner).abs() <= slack);
            (!lies).then_some(Refusal::Shape)
        }
        Shape::Disc(disc) if is_tilted(disc.normal) => Some(Refusal::TiltedDisc),
        Shape::Cone(cone) if is_tilted(cone.axis) => Some(Refusal::TiltedCone),
        _ => {
            let (low, high) = heights(shape, frame);
            let (center, radius) = shape.bounding_sphere();
            let slack = slack(frame, center, radius);
            (low < -slack && high > slack).then_some(Refusal::ThroughPlane)
        }
    }
}

/// The least and the largest height of a shape over the plane, on the side of the frame's normal,
/// metres. Discs and cones stand as [`refusal`] demands.
pub(super) fn heights(shape: &Shape, frame: &PlaneFrame) -> (f64, f64) {
    let of = |points: &[DVec3]| {
        let heights = points.iter().map(|&p| frame.height(p));
        heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)))
    };
    match shape {
        Shape::Disc(disc) => of(&[disc.center]),
        Shape::Triangle(triangle) => of(&triangle.vertices),
        Shape::Cone(cone) => of(&[cone.base_center, cone.apex()]),
        Shape::Sphere(sphere) => {
            let height = frame.height(sphere.center);
            (height - sphere.radius, height + sphere.radius)
        }
        Shape::Plane(_) | Shape::Rectangle(_) => (f64::NEG_INFINITY, f64::INFINITY),
    }
}
