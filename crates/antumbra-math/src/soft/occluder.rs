//! Shapes as a point sees them against a light's patch.

use super::patch::{Patch, Strips};
use super::region::{Cap, Conic, Polygon, corners_normal};
use super::{AreaLight, Interval, Line, Nodes, Standing};
use crate::Shape;
use crate::real::{Real, Vector};

/// What a shape hides of a patch: on every strip one interval, but for a part of it that is not hidden.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hidden<R: Real> {
    outline: Outline<R>,
    /// What of the inside is before the occluder: the disc in which a ball of light is cut.
    kept: Option<Conic<R>>,
}

/// A convex region of a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Outline<R: Real> {
    /// Nothing.
    Nothing,
    /// Everything: the point lies in the solid, or the light does.
    All,
    /// Behind a disc, or a cone whose apex is within its base's outline.
    Conic(Conic<R>),
    /// Behind a ball.
    Cap(Cap<R>),
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
    /// What `shape` hides of the patch of `light` that `point` sees.
    pub fn new<V: Vector<Real = R>>(light: &AreaLight, shape: &Shape, point: V, patch: &Patch<V>) -> Self {
        let from = |p: glam::DVec3| V::from_dvec3(p) - point;
        let real = R::from_f64;
        let all = |outline| Self { outline, kept: None };
        let over = match Standing::new(light, shape) {
            Standing::Behind => return all(Outline::Nothing),
            Standing::Around => return all(Outline::All),
            Standing::Over(over) => real(over),
            Standing::Circle { along, radius } => {
                let Shape::Sphere(s) = shape else { return all(Outline::Nothing) };
                let toward = V::from_dvec3(Standing::toward(light, s.center));
                return Self::crossing(
                    from(s.center),
                    [real(s.radius), real(along), real(radius)],
                    toward,
                    patch,
                );
            }
            Standing::Apart => R::ZERO,
        };
        match shape {
            Shape::Sphere(s) => {
                let (center, radius) = (from(s.center), real(s.radius));
                if center.dot(center) < radius * radius {
                    return all(Outline::All);
                }
                all(Outline::Cap(Cap::new(Conic::of_sphere(center, radius, patch))))
            }
            Shape::Disc(s) => {
                let (center, normal) = (from(s.center), V::from_dvec3(s.normal));
                let conic = Conic::of_disc(center, normal, real(s.radius), over, patch);
                Self::flat(Outline::Conic(conic), normal, center, over, patch)
            }
            Shape::Triangle(s) => {
                let corners = s.vertices.map(from);
                let polygon = Polygon::new(&corners, over, patch);
                Self::flat(Outline::Triangle(polygon), corners_normal(&corners), corners[0], over, patch)
            }
            Shape::Rectangle(s) => {
                let corners = s.corners().map(from);
                let polygon = Polygon::new(&corners, over, patch);
                Self::flat(Outline::Rectangle(polygon), corners_normal(&corners), corners[0], over, patch)
            }
            Shape::Cone(s) => {
                let (base, axis) = (from(s.base_center), V::from_dvec3(s.axis));
                let (radius, height) = (real(s.radius), real(s.height));
                let along = -base.dot(axis);
                let across = base + axis * along;
                let width = radius * (R::ONE - along / height);
                if along > R::ZERO && width > R::ZERO && across.dot(across) < width * width {
                    return all(Outline::All);
                }
                let conic = Conic::of_disc(base, axis, radius, over, patch);
                all(match cone_triangle(base, axis, radius, height) {
                    Some(corners) => {
                        let over = corners_normal(&corners).dot(patch.origin * patch.reach - corners[0]);
                        Outline::Cone(conic, Polygon::new(&corners, over, patch))
                    }
                    None => Outline::Conic(conic),
                })
            }
            Shape::Plane(s) => {
                let normal = V::from_dvec3(s.normal);
                let on_plane = normal * (real(s.offset) - normal.dot(point));
                if !(normal.dot(on_plane).abs() > R::ZERO) {
                    return all(Outline::Nothing); // the point lies in it
                }
                let away = normal.dot(on_plane) < R::ZERO;
                let beyond =
                    patch.before(if away { -normal } else { normal }, if away { -over } else { over });
                Self::flat(Outline::Plane(beyond), normal, on_plane, over, patch)
            }
        }
    }

    /// What a flat shape hides: of a ball that its plane cuts not what is this side of it.
    fn flat<V: Vector<Real = R>>(
        outline: Outline<R>,
        normal: V,
        on_plane: V,
        over: R,
        patch: &Patch<V>,
    ) -> Self {
        let (normal, over) = if normal.dot(on_plane) < R::ZERO { (-normal, -over) } else { (normal, over) };
        Self { outline, kept: Conic::of_cut(normal, over, patch) }
    }

    /// What a ball hides of a light that it crosses: `sizes` are its radius, and the circle's distance and radius as in
    /// [`Standing::Circle`], along the unit vector `toward`.
    ///
    /// From the circle's side on which the ball is, its part on that side hides, and all within the circle. From the
    /// light's side a ball of light is cut by the circle's plane: what is beyond is inside the other ball.
    fn crossing<V: Vector<Real = R>>(center: V, sizes: [R; 3], toward: V, patch: &Patch<V>) -> Self {
        let [radius, along, circle] = sizes;
        if center.dot(center) < radius * radius {
            return Self { outline: Outline::All, kept: None };
        }
        let middle = center - toward * along;
        let height = toward.dot(middle);
        if patch.radius_2 > R::ZERO && height > R::ZERO {
            let over = toward.dot(patch.origin * patch.reach - middle);
            let outline = Outline::Plane(patch.before(toward, over));
            return Self { outline, kept: Conic::of_cut(toward, over, patch) };
        }
        let (toward, height) = if height < R::ZERO { (-toward, -height) } else { (toward, height) };
        let tangent_2 = center.dot(center) - radius * radius;
        let near = patch.line(center * height - toward * tangent_2);
        let ball = Conic::of_sphere(center, radius, patch).with_before(near);
        let ring = Conic::of_disc(middle, toward, circle, R::INFINITY, patch);
        Self { outline: Outline::Cap(Cap::new(ball).with_ring(ring)), kept: None }
    }

    /// Whether no light arrives at all.
    pub fn is_all(&self) -> bool {
        matches!(self.outline, Outline::All)
    }

    /// The y of strips that it can hide anything of: at least those.
    pub fn rows(&self) -> Interval<R> {
        match &self.outline {
            Outline::Nothing => Interval::empty(),
            Outline::All | Outline::Plane(_) => Interval::all(),
            Outline::Conic(conic) => conic.rows(),
            Outline::Cap(cap) => cap.rows(),
            Outline::Triangle(polygon) => polygon.rows(),
            Outline::Rectangle(polygon) => polygon.rows(),
            Outline::Cone(base, triangle) => base.rows().hull(triangle.rows()),
        }
    }

    /// The x that it hides of the strip at `y`: one interval, or what is left of it on both sides of what is kept.
    pub fn intervals(&self, y: R) -> [Interval<R>; 2] {
        let all = self.interval(y);
        let kept = self.kept(y).and(all);
        if kept.is_empty() {
            return [all, Interval::empty()];
        }
        [Interval { high: kept.low, ..all }, Interval { low: kept.high, ..all }]
    }

    /// The same without what is kept.
    fn interval(&self, y: R) -> Interval<R> {
        match &self.outline {
            Outline::Nothing => Interval::empty(),
            Outline::All => Interval::all(),
            Outline::Conic(conic) => conic.interval(y),
            Outline::Cap(cap) => cap.interval(y),
            Outline::Triangle(polygon) => polygon.interval(y),
            Outline::Rectangle(polygon) => polygon.interval(y),
            Outline::Cone(base, triangle) => base.interval(y).hull(triangle.interval(y)),
            Outline::Plane(beyond) => beyond.positive(y),
        }
    }

    fn kept(&self, y: R) -> Interval<R> {
        self.kept.map_or(Interval::empty(), |kept| kept.interval(y))
    }

    /// The irradiance that it takes, in the units of [`Strips::irradiance`].
    pub(super) fn taken(&self, strips: &Strips<R>, nodes: &Nodes<R>) -> R {
        let all = self.rows().and(strips.rows());
        let rows = nodes.support(strips.round, all, |y| self.width(strips, y));
        nodes.integrate(strips.round, rows, |y| {
            let seen = self.interval(y).and(strips.seen(y));
            strips.irradiance(y, seen) - strips.irradiance(y, seen.and(self.kept(y)))
        })
    }

    /// The width of what is inside on the strip at `y`: concave, negative where it passes by the light.
    fn width(&self, strips: &Strips<R>, y: R) -> R {
        let hidden = self.interval(y).and(strips.seen(y));
        hidden.high - hidden.low
    }
}
