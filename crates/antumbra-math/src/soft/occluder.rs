//! Shapes as a point sees them against a light's patch.

use super::patch::{Line, Patch, Strips};
use super::region::{Conic, Polygon, beyond_plane};
use super::{Interval, Nodes};
use crate::Shape;
use crate::real::{Real, Vector};

/// What a shape hides of a patch: on every strip one interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hidden<R: Real> {
    /// Everything: the point lies in the solid.
    All,
    /// Behind a ball, a disc, or a cone whose apex is within its base's outline.
    Conic(Conic<R>),
    /// Behind a triangle.
    Triangle(Polygon<R, 3>),
    /// Behind a rectangle.
    Rectangle(Polygon<R, 4>),
    /// Behind a cone: its base, and the triangle of its apex and its tangent points.
    Cone(Conic<R>, Polygon<R, 3>),
    /// Behind a plane.
    Plane(Line<R>),
}

/// Where the planes through the eye (the origin) and a cone's apex touch the base's circle: with the apex, the
/// triangle that makes the base the cone's outline. `None` where the base alone is the outline. The derivation is
/// that of the hard shadow, with the eye for the light.
pub fn cone_triangle<V: Vector>(base: V, axis: V, radius: V::Real, height: V::Real) -> Option<[V; 3]> {
    let along = -axis.dot(base);
    let across = -base - axis * along;
    let toward = across * -height;
    let weight = along - height;
    let length = toward.length();
    let cosine = radius * weight / length;
    if !(cosine.abs() < V::Real::ONE) {
        return None;
    }
    let unit = toward * (V::Real::ONE / length);
    let sine = (V::Real::ONE - cosine * cosine).sqrt();
    let middle = base + unit * (radius * cosine);
    let side = axis.cross(unit) * (radius * sine);
    Some([base + axis * height, middle + side, middle - side])
}

impl<R: Real> Hidden<R> {
    /// What `shape` hides of the patch that `point` sees.
    pub fn new<V: Vector<Real = R>>(shape: &Shape, point: V, patch: &Patch<V>) -> Self {
        let from = |p: glam::DVec3| V::from_dvec3(p) - point;
        let real = R::from_f64;
        match shape {
            Shape::Sphere(s) => {
                let (center, radius) = (from(s.center), real(s.radius));
                if center.dot(center) < radius * radius {
                    return Self::All;
                }
                Self::Conic(Conic::of_sphere(center, radius, patch))
            }
            Shape::Disc(s) => {
                Self::Conic(Conic::of_disc(from(s.center), V::from_dvec3(s.normal), real(s.radius), patch))
            }
            Shape::Triangle(s) => Self::Triangle(Polygon::new(&s.vertices.map(from), patch)),
            Shape::Rectangle(s) => Self::Rectangle(Polygon::new(&s.corners().map(from), patch)),
            Shape::Cone(s) => {
                let (base, axis) = (from(s.base_center), V::from_dvec3(s.axis));
                let (radius, height) = (real(s.radius), real(s.height));
                let along = -base.dot(axis);
                let across = base + axis * along;
                let width = radius * (R::ONE - along / height);
                if along > R::ZERO && width > R::ZERO && across.dot(across) < width * width {
                    return Self::All;
                }
                let conic = Conic::of_disc(base, axis, radius, patch);
                match cone_triangle(base, axis, radius, height) {
                    Some(corners) => Self::Cone(conic, Polygon::new(&corners, patch)),
                    None => Self::Conic(conic),
                }
            }
            Shape::Plane(s) => {
                let normal = V::from_dvec3(s.normal);
                Self::Plane(beyond_plane(normal, normal.dot(point) - real(s.offset), patch))
            }
        }
    }

    /// The y of strips that it can hide anything of: at least those.
    pub fn rows(&self) -> Interval<R> {
        match self {
            Self::All | Self::Plane(_) => Interval::all(),
            Self::Conic(conic) => conic.rows(),
            Self::Triangle(polygon) => polygon.rows(),
            Self::Rectangle(polygon) => polygon.rows(),
            Self::Cone(base, triangle) => base.rows().hull(triangle.rows()),
        }
    }

    /// The x that it hides of the strip at `y`.
    pub fn interval(&self, y: R) -> Interval<R> {
        match self {
            Self::All => Interval::all(),
            Self::Conic(conic) => conic.interval(y),
            Self::Triangle(polygon) => polygon.interval(y),
            Self::Rectangle(polygon) => polygon.interval(y),
            Self::Cone(base, triangle) => base.interval(y).hull(triangle.interval(y)),
            Self::Plane(beyond) => beyond.positive(y),
        }
    }

    /// The irradiance that it takes, in the units of [`Strips::irradiance`].
    pub(super) fn taken(&self, strips: &Strips<R>, nodes: &Nodes<R>) -> R {
        let all = self.rows().and(strips.rows());
        let rows = nodes.support(strips.round, all, |y| self.width(strips, y));
        nodes.integrate(strips.round, rows, |y| strips.irradiance(y, self.interval(y).and(strips.seen(y))))
    }

    /// The width of what it hides of the light on the strip at `y`: concave, negative where the two pass by each other.
    fn width(&self, strips: &Strips<R>, y: R) -> R {
        let hidden = self.interval(y).and(strips.seen(y));
        hidden.high - hidden.low
    }
}
