//! What one point of any receiver sees of a light: the test that the GPU runs.
//!
//! Every pair of a shape and a light becomes at most two [`Blocker`]s, three kinds in all:
//!
//! | shape | blockers |
//! |---|---|
//! | sphere | [`SphereBlocker`] |
//! | disc | [`DiscBlocker`] |
//! | triangle, rectangle | [`PolygonBlocker`] with three or four edges |
//! | plane | [`PolygonBlocker`] without edges |
//! | cone | its base as a [`DiscBlocker`], and the triangle of its apex and the two points where the light's tangent planes touch the base |
//! | anything with the light inside | [`PolygonBlocker::EVERYTHING`] |
//! | cone with the light on its surface | [`PolygonBlocker`] of the one or two tangent planes there |
//!
//! A point is in shadow when any blocker says so (the union). The functions are generic over
//! [`Vector`]: float64 decides on the CPU, float32 is what the
//! shaders of the same names in `antumbra-gl` compute, and tests hold the two together.
//!
//! Held against ray casts, an answer in float64 is right unless a change of the shape by 1e-9 of its
//! size makes it another, for lights as far as 1e6 sizes. In float32 that is a change by 2.4e-7 (four
//! roundings) of the distances of point and shape from the origin: keep the eye there. Near the rim
//! of a cone both grow by the cone's radius over the light's distance from the rim.

mod cone;
pub(crate) mod coverage;
mod disc;
mod outline;
mod polygon;
mod sphere;

pub use coverage::{Footprint, half_plane_coverage, screen_footprint};
pub use disc::{DiscBlocker, disc_coverage};
pub use outline::Outline;
pub use polygon::{PolygonBlocker, polygon_coverage};
pub use sphere::{SphereBlocker, sphere_coverage};

use crate::real::{Real, Vector};
use crate::{Cone, Disc, Light, Shape};
use glam::{DVec3, DVec4};

/// One closed-form blocker of one light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Blocker<V: Vector> {
    /// A ball.
    Sphere(SphereBlocker<V>),
    /// A flat disc.
    Disc(DiscBlocker<V>),
    /// A convex polygon of up to four edges, a half-space, or everything.
    Polygon(PolygonBlocker<V>),
}

impl<V: Vector> Blocker<V> {
    /// The fraction of the footprint's pixel that the blocker takes from the light, in [0, 1].
    pub fn coverage(&self, footprint: &Footprint<V>) -> V::Real {
        match self {
            Self::Sphere(b) => sphere_coverage(b, footprint),
            Self::Disc(b) => disc_coverage(b, footprint),
            Self::Polygon(b) => polygon_coverage(b, footprint),
        }
    }

    /// Whether the way from `point` to the light is blocked: the coverage of an infinitely small pixel.
    pub fn blocks(&self, point: V) -> bool {
        self.coverage(&Footprint::point(point)) > V::Real::HALF
    }
}

impl Blocker<DVec3> {
    /// The same blocker in the numbers the GPU uses.
    pub fn to_f32(&self) -> Blocker<glam::Vec3> {
        match self {
            Self::Sphere(b) => Blocker::Sphere(b.to_f32()),
            Self::Disc(b) => Blocker::Disc(b.to_f32()),
            Self::Polygon(b) => Blocker::Polygon(b.to_f32()),
        }
    }

    fn is_finite(&self) -> bool {
        match self {
            Self::Sphere(b) => b.center.is_finite() && b.radius.is_finite(),
            Self::Disc(b) => {
                b.center.is_finite()
                    && b.radius.is_finite()
                    && b.normal.is_finite()
                    && b.toward.is_finite()
                    && b.nearness.is_finite()
            }
            Self::Polygon(b) => b.planes().iter().all(|(n, d)| n.is_finite() && d.is_finite()),
        }
    }
}

/// The blockers of one pair of shape and light: none, one or two, each with its outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blockers {
    list: [Option<(Blocker<DVec3>, Outline)>; 2],
    /// The cone whose inside is dark beyond what the list says.
    solid: Option<Cone>,
}

impl Blockers {
    const NONE: Self = Self { list: [None, None], solid: None };

    fn one(blocker: Blocker<DVec3>, outline: Outline) -> Self {
        Self::flat(Some((blocker, outline)))
    }

    fn flat(blocker: Option<(Blocker<DVec3>, Outline)>) -> Self {
        Self { list: [blocker, None], solid: None }
    }

    fn everything() -> Self {
        Self::one(Blocker::Polygon(PolygonBlocker::EVERYTHING), Outline::Everywhere)
    }

    /// What `shape` takes of `light`. Nothing (no blocker) for shapes of zero size, flat shapes
    /// with the light in their plane, light from the direction zero, and values that are not finite.
    /// Everything for a light strictly inside a solid; for one that touches a solid what lies behind
    /// its tangent plane.
    pub fn new(shape: &Shape, light: &Light) -> Self {
        let l = light.homogeneous();
        if !(l.is_finite() && l != DVec4::ZERO && shape.is_finite()) {
            return Self::NONE;
        }
        let blockers = match shape {
            Shape::Plane(s) => PolygonBlocker::half_space(s, l)
                .map_or(Self::NONE, |b| Self::one(Blocker::Polygon(b), Outline::Everywhere)),
            Shape::Rectangle(s) => Self::flat(polygon(&s.corners(), l)),
            Shape::Triangle(s) => Self::flat(polygon(&s.vertices, l)),
            Shape::Disc(s) => Self::flat(disc(s, l)),
            Shape::Sphere(s) => sphere::blockers(s, l),
            Shape::Cone(s) => cone::blockers(s, l),
        };
        if blockers.iter().all(|(b, _)| b.is_finite()) { blockers } else { Self::NONE }
    }

    /// The blockers, and for each the near end of the space in which it can cast a shadow.
    pub fn iter(&self) -> impl Iterator<Item = &(Blocker<DVec3>, Outline)> {
        self.list.iter().flatten()
    }

    /// Whether any of them blocks the way from `point` to the light, or the point lies inside the
    /// solid. Never for a point that is not finite.
    pub fn block(&self, point: DVec3) -> bool {
        point.is_finite() && (self.hold(point) || self.iter().any(|(b, _)| b.blocks(point)))
    }

    /// Whether the point lies inside a cone, part of which no blocker darkens.
    fn hold(&self, point: DVec3) -> bool {
        self.solid.is_some_and(|cone| cone::holds(&cone, point.extend(1.0)))
    }

    /// The fraction of the footprint's pixel that is in shadow: the larger of the blockers'
    /// coverages, which is the union where at most one edge crosses the pixel. None of a pixel
    /// whose point is not finite, all of one whose point lies inside a solid.
    pub fn coverage(&self, footprint: &Footprint<DVec3>) -> f64 {
        if !footprint.point.is_finite() {
            return 0.0;
        }
        if self.hold(footprint.point) {
            return 1.0;
        }
        self.iter().map(|(b, _)| b.coverage(footprint)).fold(0.0, f64::max)
    }
}

fn polygon(corners: &[DVec3], light: DVec4) -> Option<(Blocker<DVec3>, Outline)> {
    let blocker = PolygonBlocker::new(corners, light)?;
    Some((Blocker::Polygon(blocker), Outline::corners(corners)))
}

fn disc(disc: &Disc, light: DVec4) -> Option<(Blocker<DVec3>, Outline)> {
    let outline = Outline::Ring { center: disc.center, axis: disc.normal, radius: disc.radius };
    Some((Blocker::Disc(DiscBlocker::new(disc, light)?), outline))
}

impl Shape {
    /// Whether the shape blocks the way from `point` to the light. Points inside a solid are
    /// dark. Points on the shape itself are decided by rounding: leave out a receiver's own
    /// shape, which is convex and never shadows itself.
    pub fn blocks(&self, light: &Light, point: DVec3) -> bool {
        Blockers::new(self, light).block(point)
    }
}
