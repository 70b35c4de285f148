//! A flat convex polygon between a point and a light: half-spaces.

use super::Footprint;
use super::coverage::{Edge, corner_coverage};
use crate::Plane;
use crate::real::{Real, Vector};
use glam::{DVec3, DVec4};

/// A convex polygon and the light it blocks: the points behind the polygon's own plane and on
/// the inner side of the planes through the light and each edge. Every plane is (unit normal n,
/// offset d) with n·p + d > 0 inside; unused edges are (0, 1), inside everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolygonBlocker<V: Vector> {
    /// The polygon's plane; inside is the side away from the light.
    pub base: (V, V::Real),
    /// The planes of light and edge.
    pub edges: [(V, V::Real); 4],
}

const ANYWHERE: (DVec3, f64) = (DVec3::ZERO, 1.0);

impl PolygonBlocker<DVec3> {
    /// Blocks the light from every point: what a light inside a solid does to the rest.
    pub const EVERYTHING: Self = Self { base: ANYWHERE, edges: [ANYWHERE; 4] };

    /// A planar convex polygon of three or four corners, in order; more are left out. `None` when it
    /// has no area or the light lies in its plane.
    pub fn new(corners: &[DVec3], light: DVec4) -> Option<Self> {
        let corners = &corners[..corners.len().min(4)];
        let plane = Self::plane_of(corners)?;
        let base = Self::half_space(&plane, light)?.base;
        // Light above the plane with the corners counter-clockwise seen from it: edges × light is inward.
        let turn = if base.0.dot(plane.normal) < 0.0 { 1.0 } else { -1.0 };
        let mut edges = [ANYWHERE; 4];
        for (i, edge) in edges.iter_mut().enumerate().take(corners.len()) {
            let (p, q) = (corners[i], corners[(i + 1) % corners.len()]);
            let to_light = light.truncate() - p * light.w;
            let n = (to_light.cross(q - p) * turn).try_normalize()?;
            *edge = (n, -n.dot(p));
        }
        Some(Self { base, edges })
    }

    /// The plane of a polygon, from the corner between its shorter sides: the vector product of two
    /// long sides of a narrow triangle would cancel.
    fn plane_of(corners: &[DVec3]) -> Option<Plane> {
        let count = corners.len();
        let side = |i: usize| corners[(i + 1) % count] - corners[i % count];
        let around = |i: usize| side(i).length_squared() * side(i + 1).length_squared();
        let first = (0..count).min_by(|&i, &j| around(i).total_cmp(&around(j))).filter(|_| count > 2)?;
        let normal = side(first).cross(side(first + 1));
        let longest = (0..count).map(|i| side(i).length()).fold(0.0, f64::max);
        // No area beyond what rounding makes.
        (normal.length() > longest * longest * 1e-14)
            .then(|| Plane::through(corners[(first + 1) % count], normal.normalize()))
    }

    /// Everything on the far side of a plane. `None` when the light lies in it.
    pub fn half_space(plane: &Plane, light: DVec4) -> Option<Self> {
        let height = plane.normal.dot(light.truncate()) - plane.offset * light.w;
        let scale = light.truncate().length() + plane.offset.abs() * light.w;
        // A light whose height is rounding error is in the plane.
        if !(height.abs() > scale * 1e-14) {
            return None;
        }
        let s = -height.signum();
        Some(Self { base: (plane.normal * s, -plane.offset * s), edges: [ANYWHERE; 4] })
    }

    pub(super) fn to_f32(self) -> PolygonBlocker<glam::Vec3> {
        let plane = |(n, d): (DVec3, f64)| (n.as_vec3(), d as f32);
        PolygonBlocker { base: plane(self.base), edges: self.edges.map(plane) }
    }
}

impl<V: Vector> PolygonBlocker<V> {
    /// The base and the edges.
    pub fn planes(&self) -> [(V, V::Real); 5] {
        let [a, b, c, d] = self.edges;
        [self.base, a, b, c, d]
    }
}

/// How much of the pixel a polygon takes from the light: what lies inside the two planes that cut
/// off most of it. More than two edges cross a pixel only where the shadow is about its size.
pub fn polygon_coverage<V: Vector>(b: &PolygonBlocker<V>, footprint: &Footprint<V>) -> V::Real {
    let (mut first, mut second) = (Edge::NONE, Edge::NONE);
    for (normal, offset) in b.planes() {
        let edge = Edge::new(normal.dot(footprint.point) + offset, normal, footprint);
        nearest_edges(&mut first, &mut second, edge);
    }
    corner_coverage(&first, &second)
}

/// The two edges that cut off most of the pixel, once another is looked at.
fn nearest_edges<R: Real>(first: &mut Edge<R>, second: &mut Edge<R>, edge: Edge<R>) {
    if edge.coverage < first.coverage {
        (*first, *second) = (edge, *first);
    } else if edge.coverage < second.coverage {
        *second = edge;
    }
}
