//! How much of a pixel of the receiver lies in a part of a shadow: what the GPU runs.

use glam::DVec3;

use super::PartShape;
use crate::PlaneFrame;
use crate::blocking::Footprint;
use crate::blocking::coverage::{Edge, corner_coverage};
use crate::real::{Real, Vector};

/// A part of a shadow where it lies in space, in numbers that lose nothing near the origin, which is
/// to be the eye: shadows of lights that hardly clear their object are a billion times its size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlacedPart<V: Vector> {
    /// A disc.
    Disc {
        /// Centre.
        center: V,
        /// Radius.
        radius: V::Real,
        /// Radius squared less the centre's distance from the origin squared.
        power: V::Real,
    },
    /// A triangle.
    Triangle {
        /// The planes through its edges, perpendicular to its own: unit normal n and offset d, with
        /// n·p + d the distance inwards.
        edges: [(V, V::Real); 3],
    },
}

impl PlacedPart<DVec3> {
    /// Places a part; `None` for a triangle without area, and for numbers that are not finite.
    pub fn new(shape: &PartShape, frame: &PlaneFrame) -> Option<Self> {
        let placed = match *shape {
            PartShape::Disc { center, radius } => {
                let center = frame.point(center);
                // (r - |c|)(r + |c|) keeps the digits that the squares would lose.
                let distance = center.length();
                Self::Disc { center, radius, power: (radius - distance) * (radius + distance) }
            }
            PartShape::Triangle { vertices } => {
                let [a, b, c] = vertices;
                let turn = (b - a).perp_dot(c - a).signum();
                let edge = |from: glam::DVec2, to: glam::DVec2| {
                    let inwards = ((to - from).perp() * turn).try_normalize()?;
                    let normal = frame.u * inwards.x + frame.v * inwards.y;
                    Some((normal, -normal.dot(frame.point(from))))
                };
                Self::Triangle { edges: [edge(a, b)?, edge(b, c)?, edge(c, a)?] }
            }
        };
        placed.is_finite().then_some(placed)
    }

    /// The same in the numbers the GPU uses.
    pub fn to_f32(&self) -> PlacedPart<glam::Vec3> {
        match *self {
            Self::Disc { center, radius, power } => {
                PlacedPart::Disc { center: center.as_vec3(), radius: radius as f32, power: power as f32 }
            }
            Self::Triangle { edges } => {
                PlacedPart::Triangle { edges: edges.map(|(n, d)| (n.as_vec3(), d as f32)) }
            }
        }
    }

    fn is_finite(&self) -> bool {
        match *self {
            Self::Disc { center, radius, power } => {
                center.is_finite() && radius.is_finite() && power.is_finite()
            }
            Self::Triangle { edges } => edges.iter().all(|(n, d)| n.is_finite() && d.is_finite()),
        }
    }
}

/// The fraction of a pixel of the receiver, of this footprint in the part's plane, that lies in the
/// part, in [0, 1]. Without extent it is 1 inside and else 0; 0 for a point that is NaN.
pub fn part_coverage<V: Vector>(part: &PlacedPart<V>, footprint: &Footprint<V>) -> V::Real {
    match *part {
        PlacedPart::Disc { center, radius, power } => disc_part_coverage(center, radius, power, footprint),
        PlacedPart::Triangle { edges } => triangle_part_coverage(&edges, footprint),
    }
}

/// [`part_coverage`] of a disc. The distance inwards is r - |p - c|; as
/// (r² - |p - c|²) / (r + |p - c|) = (power + p · (2c - p)) / (r + |p - c|) its error is one of the
/// point's distance and the edge's from the origin, not of the radius.
fn disc_part_coverage<V: Vector>(
    center: V,
    radius: V::Real,
    power: V::Real,
    footprint: &Footprint<V>,
) -> V::Real {
    let (p, one) = (footprint.point, V::Real::ONE);
    let outward = p - center;
    let distance = outward.length();
    let inside = (power + p.dot(center * (one + one) - p)) / (radius + distance);
    let gradient = outward * (-one / distance.max(V::Real::from_f64(1e-30)));
    Edge::new(inside, gradient, footprint).coverage
}

/// An edge of a triangle across the pixel.
fn part_edge<V: Vector>(plane: (V, V::Real), footprint: &Footprint<V>) -> Edge<V::Real> {
    Edge::new(plane_distance(plane, footprint.point), plane.0, footprint)
}

/// How far inside of a plane, given as normal and offset, a point is.
fn plane_distance<V: Vector>((normal, offset): (V, V::Real), point: V) -> V::Real {
    normal.dot(point) + offset
}

/// [`part_coverage`] of a triangle: what lies inside the two edges that cut off most of the pixel.
fn triangle_part_coverage<V: Vector>(edges: &[(V, V::Real); 3], footprint: &Footprint<V>) -> V::Real {
    let [a, b, c] = edges.map(|plane| part_edge(plane, footprint));
    let (low, high) = if a.coverage < b.coverage { (a, b) } else { (b, a) };
    corner_coverage(&low, if c.coverage < high.coverage { &c } else { &high })
}
