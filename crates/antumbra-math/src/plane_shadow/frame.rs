//! A plane with two axes, so that its points are pairs of metres, and boxes in it.

use glam::{DVec2, DVec3};

use crate::{Plane, Rectangle};

/// An orthonormal frame of a plane: where the two coordinates of a point of the plane come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneFrame {
    /// The point of the plane with coordinates (0, 0), metres.
    pub origin: DVec3,
    /// Unit vector along which the first coordinate grows.
    pub u: DVec3,
    /// Unit vector along which the second coordinate grows.
    pub v: DVec3,
    /// Unit normal, `u × v`.
    pub normal: DVec3,
}

impl PlaneFrame {
    /// A frame of `plane`. Its origin is the plane's point nearest to the world's, `normal` is the
    /// plane's, and `u` and `v` follow from it by a rule without branches near the poles (Duff et
    /// al., Building an Orthonormal Basis, Revisited, 2017).
    ///
    /// A normal that is not of unit length is brought to it, the plane staying where it is. `None`
    /// for a plane without a normal or with an infinity or a NaN.
    pub fn of_plane(plane: &Plane) -> Option<Self> {
        let length = plane.normal.length();
        let (n, offset) = (plane.normal / length, plane.offset / length);
        if !(n.is_finite() && offset.is_finite() && (n.length() - 1.0).abs() < 1e-6) {
            return None;
        }
        let sign = 1.0_f64.copysign(n.z);
        let a = -1.0 / (sign + n.z);
        let b = n.x * n.y * a;
        let u = DVec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
        let v = DVec3::new(b, sign + n.y * n.y * a, -n.y);
        Some(Self { origin: n * offset, u, v, normal: n })
    }

    /// The frame of a rectangle, and the rectangle in it: the origin is its centre, `u` runs along
    /// `half_right`, `v` along `half_forward`. `None` for a rectangle without area or with an
    /// infinity or a NaN.
    pub fn of_rectangle(rectangle: &Rectangle) -> Option<(Self, Bounds)> {
        let (right, forward) = (rectangle.half_right, rectangle.half_forward);
        let half = DVec2::new(right.length(), forward.length());
        let u = right / half.x;
        let normal = u.cross(forward).normalize_or_zero();
        let frame = Self { origin: rectangle.center, u, v: normal.cross(u), normal };
        let usable = half.is_finite() && half.min_element() > 0.0 && normal != DVec3::ZERO;
        (usable && frame.is_finite()).then_some((frame, Bounds { min: -half, max: half }))
    }

    /// The point of space at coordinates `point`, metres.
    pub fn point(&self, point: DVec2) -> DVec3 {
        self.origin + self.u * point.x + self.v * point.y
    }

    /// The coordinates of the plane's point nearest to `point`, metres.
    pub fn coordinates(&self, point: DVec3) -> DVec2 {
        let p = point - self.origin;
        DVec2::new(self.u.dot(p), self.v.dot(p))
    }

    /// Signed distance of `point` from the plane, positive on the side of the normal, metres.
    pub fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point - self.origin)
    }

    /// Whether every number is finite.
    pub(crate) fn is_finite(&self) -> bool {
        self.origin.is_finite() && self.u.is_finite() && self.v.is_finite() && self.normal.is_finite()
    }
}

/// A box in a plane, its sides along the frame's axes, metres. Its sides may lie at infinity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The smallest coordinates.
    pub min: DVec2,
    /// The largest coordinates.
    pub max: DVec2,
}

impl Bounds {
    /// The whole plane.
    pub const EVERYTHING: Self = Self { min: DVec2::NEG_INFINITY, max: DVec2::INFINITY };

    /// A square of side `2 half` around `center`.
    pub fn around(center: DVec2, half: f64) -> Self {
        Self { min: center - half, max: center + half }
    }

    /// Whether no side lies at infinity.
    pub fn is_finite(&self) -> bool {
        self.min.is_finite() && self.max.is_finite()
    }

    /// Square metres; 0 if a maximum is below its minimum.
    pub fn area(&self) -> f64 {
        let size = (self.max - self.min).max(DVec2::ZERO);
        size.x * size.y
    }

    /// Whether `point` lies in the box or on its sides.
    pub fn contains(&self, point: DVec2) -> bool {
        self.min.cmple(point).all() && point.cmple(self.max).all()
    }

    /// Whether `other` lies inside this box.
    pub fn encloses(&self, other: &Self) -> bool {
        self.min.cmple(other.min).all() && other.max.cmple(self.max).all()
    }

    /// The corners, counterclockwise.
    pub fn corners(&self) -> [DVec2; 4] {
        let (a, b) = (self.min, self.max);
        [a, DVec2::new(b.x, a.y), b, DVec2::new(a.x, b.y)]
    }

    /// The four half-planes whose common part the box is, each as (nx, ny, c): nx x + ny y + c >= 0.
    /// Sides at infinity are left out.
    pub(super) fn half_planes(&self) -> impl Iterator<Item = DVec3> {
        [
            DVec3::new(1.0, 0.0, -self.min.x),
            DVec3::new(0.0, 1.0, -self.min.y),
            DVec3::new(-1.0, 0.0, self.max.x),
            DVec3::new(0.0, -1.0, self.max.y),
        ]
        .into_iter()
        .filter(|f| f.z != f64::INFINITY)
    }
}
