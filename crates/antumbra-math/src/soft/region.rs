//! What occluders hide of a patch: insides of conics and of convex polygons.

use super::Interval;
use super::patch::{Line, Patch};
use crate::real::{Real, Vector};

/// The inside of a conic on a patch: the outline of a ball or a disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conic<R: Real> {
    /// Inside is `xx x² + 2 (x1 + xy y) x + one + 2 y1 y + yy y² < 0`: xx, x1, xy, one, y1, yy.
    form: [R; 6],
    /// Positive on the side of the occluder, negative on the side that a line through the point reaches backwards.
    ahead: Line<R>,
    /// Positive where the occluder is nearer than the light.
    before: Line<R>,
}

impl<R: Real> Conic<R> {
    /// A ball, its centre as the point sees it. A ball behind the light's, by the radical plane of the two,
    /// hides nothing.
    pub fn of_sphere<V: Vector<Real = R>>(center: V, radius: R, patch: &Patch<V>) -> Self {
        let k = [patch.right, patch.origin, patch.up].map(|w| center.cross(w));
        let w = [patch.right, patch.origin, patch.up];
        let square = radius * radius;
        let form = |i: usize, j: usize| k[i].dot(k[j]) - square * w[i].dot(w[j]);
        // On a common tangent plane the ball with the shorter tangent is in front.
        let nearer = patch.tangent_2 - (center.dot(center) - square);
        Self {
            form: [form(0, 0), form(0, 1), form(0, 2), form(1, 1), form(1, 2), form(2, 2)],
            ahead: patch.line(center),
            before: Line { one: nearer, x: R::ZERO, y: R::ZERO },
        }
    }

    /// A flat disc, its centre as the point sees it, with a unit normal to either side, which the light's centre is `over`
    /// the disc along; nothing if the point lies in its plane.
    pub fn of_disc<V: Vector<Real = R>>(center: V, normal: V, radius: R, over: R, patch: &Patch<V>) -> Self {
        let (normal, over) = if center.dot(normal) < R::ZERO { (-normal, -over) } else { (normal, over) };
        // Where a direction meets the disc's plane, seen from the centre, times its part along the normal.
        let e = [patch.right, patch.origin, patch.up].map(|w| normal.cross(w.cross(center)));
        let w = [patch.right, patch.origin, patch.up].map(|w| w.dot(normal));
        let square = radius * radius;
        let form = |i: usize, j: usize| e[i].dot(e[j]) - square * w[i] * w[j];
        Self {
            form: [form(0, 0), form(0, 1), form(0, 2), form(1, 1), form(1, 2), form(2, 2)],
            ahead: patch.line(normal),
            before: patch.before(normal, over),
        }
    }

    /// The disc in which a plane cuts the light, a ball, as seen against the light: what it covers is this side of the
    /// plane. `normal`, of unit length, points away from the point, and the light's centre is `over` the plane along it.
    /// `None` where the plane passes by the ball.
    pub fn of_cut<V: Vector<Real = R>>(normal: V, over: R, patch: &Patch<V>) -> Option<Self> {
        let square = patch.radius_2 - over * over;
        let center = patch.origin * patch.reach - normal * over;
        (square > R::ZERO).then(|| Self::of_disc(center, normal, square.sqrt(), R::INFINITY, patch))
    }

    /// The conic with another [`Self::before`].
    pub(super) fn with_before(self, before: Line<R>) -> Self {
        Self { before, ..self }
    }

    /// The y of strips that the conic is on, at least: all of an ellipse's, one branch's of a hyperbola.
    pub fn rows(&self) -> Interval<R> {
        let [xx, x1, xy, one, y1, yy] = self.form;
        // The discriminant on a strip is p y² + 2 q y + r.
        let (p, q, r) = (xy * xy - xx * yy, x1 * xy - xx * y1, x1 * x1 - xx * one);
        let discriminant = q * q - p * r;
        if !(discriminant > R::ZERO) {
            return if p < R::ZERO { Interval::empty() } else { Interval::all() };
        }
        let root = discriminant.sqrt();
        let sum = -(q + if q < R::ZERO { -root } else { root });
        let (s, t) = (sum / p, r / sum);
        let (low, high) = (s.min(t), s.max(t));
        if p < R::ZERO {
            Interval { low, high }
        } else if !(xx > R::ZERO) {
            Interval::all() // strips that leave the conic at one end alone
        } else if self.ahead.y * xx > self.ahead.x * xy {
            Interval { low: high, high: R::INFINITY } // the branch that goes ahead as y grows
        } else {
            Interval { low: -R::INFINITY, high: low }
        }
    }

    /// The x inside, on the strip at `y`.
    pub fn interval(&self, y: R) -> Interval<R> {
        let [xx, x1, xy, one, y1, yy] = self.form;
        let (half, rest) = (x1 + xy * y, one + y * (y1 + y1 + yy * y));
        let discriminant = half * half - xx * rest;
        if !(discriminant > R::ZERO) {
            return Interval::empty();
        }
        // The root that adds, and from it the other: neither cancels.
        let root = discriminant.sqrt();
        let sum = -(half + if half < R::ZERO { -root } else { root });
        let (p, q) = (sum / xx, rest / sum);
        let (low, high) = (p.min(q), p.max(q));
        let inside = if xx > R::ZERO {
            let ahead = self.ahead.at(y) + self.ahead.x * (low + high) * R::HALF > R::ZERO;
            if ahead { Interval { low, high } } else { Interval::empty() }
        } else if self.ahead.x > R::ZERO {
            // The strip's plane cuts both nappes of the cone, and the line leaves one on its way to infinity.
            Interval { low: high, high: R::INFINITY }
        } else {
            Interval { low: -R::INFINITY, high: low }
        };
        inside.and(self.before.positive(y))
    }
}

/// A ball, or the part of one that is before a light: the hull of it and of the circle in which it meets the light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cap<R: Real> {
    ball: Conic<R>,
    ring: Option<Conic<R>>,
}

impl<R: Real> Cap<R> {
    /// All of a ball.
    pub fn new(ball: Conic<R>) -> Self {
        Self { ball, ring: None }
    }

    /// The hull of it and of a circle.
    pub(super) fn with_ring(self, ring: Conic<R>) -> Self {
        Self { ring: Some(ring), ..self }
    }

    /// The y of strips that it is on, at least.
    pub fn rows(&self) -> Interval<R> {
        self.ring.iter().fold(self.ball.rows(), |rows, ring| rows.hull(ring.rows()))
    }

    /// The x inside, on the strip at `y`.
    pub fn interval(&self, y: R) -> Interval<R> {
        self.ring.iter().fold(self.ball.interval(y), |inside, ring| inside.hull(ring.interval(y)))
    }
}

/// The inside of a convex polygon on a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polygon<R: Real, const N: usize> {
    edges: [Line<R>; N],
    /// Positive where the polygon is nearer than the light.
    before: Line<R>,
    rows: Interval<R>,
}

impl<R: Real, const N: usize> Polygon<R, N> {
    /// A convex polygon, its corners as the point sees them, in order; nothing if the point lies in its plane, or it
    /// has no area. The light's centre is `over` its plane, along the normal that the corners run around counter-clockwise.
    pub fn new<V: Vector<Real = R>>(corners: &[V; N], over: R, patch: &Patch<V>) -> Self {
        let normal = corners_normal(corners);
        let side = if normal.dot(corners[0]) < R::ZERO { -R::ONE } else { R::ONE };
        let mut edges = [Line { one: -R::ONE, x: R::ZERO, y: R::ZERO }; N];
        for i in 0..N {
            edges[i] = patch.line(corners[i].cross(corners[(i + 1) % N]) * side);
        }
        Self { edges, before: patch.before(normal * side, over * side), rows: corner_rows(corners, patch) }
    }

    /// The y of the corners.
    pub fn rows(&self) -> Interval<R> {
        self.rows
    }

    /// The x inside, on the strip at `y`.
    pub fn interval(&self, y: R) -> Interval<R> {
        self.edges.iter().fold(self.before.positive(y), |inside, edge| inside.and(edge.positive(y)))
    }
}

/// The y of corners; everything where one is not in front of the point.
fn corner_rows<V: Vector, const N: usize>(corners: &[V; N], patch: &Patch<V>) -> Interval<V::Real> {
    let forward = patch.right.cross(patch.up);
    let upward = patch.origin.cross(patch.right);
    // The volume of the patch's pyramid: positive for one orientation of its sides, negative for the other.
    let volume = patch.origin.dot(forward);
    let (forward, upward) = (forward * (V::Real::ONE / volume), upward * (V::Real::ONE / volume));
    let mut rows: Interval<V::Real> = Interval::empty();
    for &corner in corners {
        let weight = corner.dot(forward);
        if !(weight > V::Real::ZERO) {
            return Interval::all();
        }
        let y = corner.dot(upward) / weight;
        rows = Interval { low: rows.low.min(y), high: rows.high.max(y) };
    }
    rows
}

/// The unit normal that corners run around counter-clockwise.
pub(super) fn corners_normal<V: Vector>(corners: &[V]) -> V {
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    normal * (V::Real::ONE / normal.length())
}
