//! Shadows on a plane as geometry: which conic, hull or polygon, where its centre and axes are, how
//! large it is, what it contains, and points to draw it by.
//!
//! ```
//! use antumbra_math::plane_shadow::{PlaneFrame, PlaneShadow, ShadowKind};
//! use antumbra_math::{Light, Plane, Sphere};
//! use glam::{DVec2, DVec3};
//!
//! let floor = PlaneFrame::of_plane(&Plane::through(DVec3::ZERO, DVec3::Y)).unwrap();
//! let light = Light::Point { position: DVec3::new(0.0, 4.0, 0.0) };
//! let ball = Sphere { center: DVec3::new(0.0, 1.5, 0.0), radius: 1.5 };
//! let shadow = PlaneShadow::cast(&ball.into(), &light, &floor);
//! assert_eq!(shadow.kind(), ShadowKind::Ellipse);
//! assert!((shadow.axes().unwrap().first.length() - 3.0).abs() < 1e-12);
//! assert!(shadow.contains(DVec2::new(2.9, 0.0)));
//! ```
//!
//! # What counts
//! A point P of the plane is in shadow if the open segment from P to the light (the ray towards a
//! directional light) meets the occluder's inside, or for a flat occluder the occluder itself; so P
//! inside a solid occluder is. From this follows:
//! - Only what lies between plane and light casts: occluders are cut at the plane and at the light's
//!   height. A shadow reaches infinity where the occluder reaches the light's height.
//! - Both sides of the plane receive; the side that counts is the light's.
//! - A light in the plane, or shining along it, lights no point of it: nothing.
//! - A light inside a solid occluder: everything. A light on its surface: what is behind the tangent
//!   plane, a half-plane; on a cone's rim, what is behind both; in its apex, what is in the cone.
//! - A flat occluder seen edge-on blocks no light: its shadow is a segment, which contains no point.
//! - Occluders of no extent (radius, height or area zero), those that only touch the plane from
//!   beyond or the light's height from above, flat ones that lie in the plane, and anything with an
//!   infinity or a NaN: nothing. A cone of height zero is a disc. A shadow narrower than the rounding
//!   of its coordinates is none.
//! - A spot's cone plays no part: outside it no light arrives, blocked or not.
//!
//! Points on the very edge may count either way. Lengths from 1e-60 to 1e60 metres are safe from
//! overflow.
//!
//! # How
//! The boundary is kept in homogeneous coordinates (x w, y w, w) with w = 1 - h/H, so that a shadow
//! that reaches infinity, and one that nearly does, is like any other: see [`Conic`] and the modules'
//! sources for the closed forms. Nothing is tessellated except by [`PlaneShadow::outline`].

mod angles;
mod cone;
mod conic;
mod disc;
mod double_cone;
mod edge;
mod frame;
mod outline;
mod polygon;
mod setting;
mod sphere;

use glam::{DVec2, DVec3};

use crate::{Light, Shape};
pub use conic::{Axes, Conic};
pub use frame::{Bounds, PlaneFrame};

use conic::Curve;
use edge::Edge;
use outline::Outline;
use setting::Setting;

/// What a shadow on a plane looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ShadowKind {
    /// No shadow.
    Nothing,
    /// That of a flat occluder seen edge-on: a line without area, perhaps infinitely long.
    Segment,
    /// The inside of an ellipse or a circle.
    Ellipse,
    /// The inside of a parabola: the occluder just reaches the light's height, to 1e-12 of it.
    Parabola,
    /// The inside of one branch of a hyperbola: the occluder reaches above the light.
    Hyperbola,
    /// A convex polygon, perhaps with corners at infinity, as for a half-plane.
    Polygon,
    /// A convex region bounded by lines and arcs of conics.
    Hull,
    /// The whole plane.
    Everything,
}

/// The shadow of one occluder from one light on a plane: a convex region. Coordinates are those of
/// the [`PlaneFrame`] it was cast on, metres.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaneShadow {
    kind: ShadowKind,
    /// `None` for nothing and for everything.
    outline: Option<Outline>,
    /// For the kinds that are the inside of a conic.
    curve: Option<Curve>,
}

impl PlaneShadow {
    /// The shadow of `occluder` from `light` on the plane of `frame`. Never panics; the
    /// [module](self) says what degenerate cases give.
    pub fn cast(occluder: &Shape, light: &Light, frame: &PlaneFrame) -> Self {
        let Some(setting) = Setting::new(frame, light) else { return Self::nothing() };
        match occluder {
            Shape::Plane(plane) => polygon::plane(&setting, plane),
            Shape::Rectangle(rectangle) => polygon::polygon(&setting, &rectangle.corners()),
            Shape::Triangle(triangle) => polygon::polygon(&setting, &triangle.vertices),
            Shape::Disc(d) => disc::disc(&setting, d.center, d.normal, d.radius),
            Shape::Sphere(sphere) => sphere::sphere(&setting, sphere),
            Shape::Cone(cone) => cone::cone(&setting, cone),
        }
    }

    /// The part of the shadow in a box, such as a rectangle that receives it (see
    /// [`PlaneFrame::of_rectangle`]). A shadow that lies in the box stays what it is; one that is cut
    /// becomes a polygon or a hull, or nothing.
    pub fn clipped(&self, bounds: &Bounds) -> Self {
        match self.kind {
            ShadowKind::Nothing => Self::nothing(),
            ShadowKind::Everything if *bounds == Bounds::EVERYTHING => self.clone(),
            ShadowKind::Everything if bounds.is_finite() => {
                let corners = bounds.corners().map(|p| p.extend(1.0));
                Self::polygon(if bounds.area() > 0.0 { Outline::polygon(&corners) } else { None })
            }
            ShadowKind::Everything => {
                let half_planes: Vec<DVec3> = bounds.half_planes().collect();
                let first = half_planes.first().and_then(|&f| Outline::half_plane(f));
                let rest = half_planes.iter().skip(1);
                Self::polygon(rest.fold(first, |outline, &f| outline?.clipped(f)))
            }
            _ if self.bounds().is_some_and(|own| bounds.encloses(&own)) => self.clone(),
            kind => match self.outline.as_ref().and_then(|outline| outline.within(bounds)) {
                None => Self::nothing(),
                outline if kind == ShadowKind::Segment => Self { kind, outline, curve: None },
                outline => Self::polygon(outline),
            },
        }
    }

    /// What it looks like.
    pub fn kind(&self) -> ShadowKind {
        self.kind
    }

    /// The equation of the conic that bounds an ellipse, a parabola or a hyperbola; for the other
    /// kinds `None`.
    pub fn conic(&self) -> Option<Conic> {
        self.curve.and_then(|curve| curve.conic())
    }

    /// Centre and axes of an ellipse or a hyperbola; for the other kinds `None`.
    pub fn axes(&self) -> Option<Axes> {
        self.curve.and_then(|curve| curve.axes())
    }

    /// Square metres: closed forms, π a b for an ellipse. Infinite for a shadow that reaches
    /// infinity, 0 for nothing and for a segment.
    pub fn area(&self) -> f64 {
        match (self.kind, &self.outline) {
            (ShadowKind::Everything, _) => f64::INFINITY,
            (ShadowKind::Nothing | ShadowKind::Segment, _) | (_, None) => 0.0,
            (_, Some(outline)) => outline.area(),
        }
    }

    /// The smallest box around the shadow, its sides at infinity where the shadow reaches there;
    /// `None` if there is no shadow.
    pub fn bounds(&self) -> Option<Bounds> {
        match self.kind {
            ShadowKind::Nothing => None,
            ShadowKind::Everything => Some(Bounds::EVERYTHING),
            _ => self.outline.as_ref().map(Outline::bounds),
        }
    }

    /// Whether a point of the plane is in shadow: decided by the signs of the boundary's equations, to
    /// about 1e-9 of the shadow's size next to a corner, to rounding elsewhere. False for a point with a NaN or an infinity.
    pub fn contains(&self, point: DVec2) -> bool {
        match (self.kind, &self.outline) {
            (ShadowKind::Everything, _) => point.is_finite(),
            (ShadowKind::Nothing | ShadowKind::Segment, _) | (_, None) => false,
            (_, Some(outline)) => outline.contains(point),
        }
    }

    /// The boundary of the part of the shadow in the box `window`, as a closed polygon to draw: its
    /// corners exactly, and at least `points` points where a part of it bends, counterclockwise, the
    /// first not repeated. Two points for a segment; none if there is nothing to draw, or if the
    /// shadow and the window reach infinity together.
    pub fn outline(&self, points: usize, window: &Bounds) -> Vec<DVec2> {
        let part = self.clipped(window);
        match (&part.outline, part.bounds()) {
            (Some(outline), Some(bounds)) if bounds.is_finite() => outline.points(points),
            _ => Vec::new(),
        }
    }

    fn nothing() -> Self {
        Self { kind: ShadowKind::Nothing, outline: None, curve: None }
    }

    fn everything() -> Self {
        Self { kind: ShadowKind::Everything, outline: None, curve: None }
    }

    /// A region bounded by lines, or by lines and arcs.
    fn polygon(outline: Option<Outline>) -> Self {
        match &outline {
            None => Self::nothing(),
            Some(region) if region.is_collapsed() => Self::nothing(),
            Some(region) if region.is_curved() => Self { kind: ShadowKind::Hull, outline, curve: None },
            Some(_) => Self { kind: ShadowKind::Polygon, outline, curve: None },
        }
    }

    /// The convex region bounded by `chains` in any order.
    fn region(chains: &[Vec<Edge>]) -> Self {
        Self::polygon(Outline::from_chains(chains))
    }

    /// The inside of a conic, of which `arcs` are the parts in front of the light.
    fn conic_region(curve: Curve, arcs: &[Vec<Edge>]) -> Self {
        let outline = Outline::from_chains(arcs);
        if outline.as_ref().is_none_or(Outline::is_collapsed) {
            return Self::nothing();
        }
        Self { kind: curve.kind(), outline, curve: Some(curve) }
    }

    /// The line from the first to the last of some homogeneous points, all of which lie on one
    /// line along `direction`.
    fn segment(points: &[DVec3], direction: DVec2) -> Self {
        let along = |p: &DVec3| {
            let d = direction.dot(p.truncate());
            if p.z > 0.0 { d / p.z } else { d * f64::INFINITY }
        };
        let first = points.iter().min_by(|a, b| along(a).total_cmp(&along(b)));
        let last = points.iter().max_by(|a, b| along(a).total_cmp(&along(b)));
        match first.zip(last).and_then(|(&a, &b)| Outline::segment(a, b)) {
            None => Self::nothing(),
            outline => Self { kind: ShadowKind::Segment, outline, curve: None },
        }
    }
}
