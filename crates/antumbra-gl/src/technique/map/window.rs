//! How a light looks: from where, whereto, and through which window.

use glam::{DMat3, DVec2, DVec3};

/// A rectangle of what a light sees: tangents of angles for a light at a point, metres for a directional one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Window {
    pub(super) low: DVec2,
    pub(super) high: DVec2,
}

impl Window {
    pub(super) const ALL: Self = Self { low: DVec2::NEG_INFINITY, high: DVec2::INFINITY };

    /// From -`half` to `half`, both ways.
    pub(super) fn square(half: f64) -> Self {
        Self { low: DVec2::splat(-half), high: DVec2::splat(half) }
    }

    /// What both have; `None` if that is nothing.
    pub(super) fn and(self, other: Self) -> Option<Self> {
        let both = Self { low: self.low.max(other.low), high: self.high.min(other.high) };
        both.low.cmple(both.high).all().then_some(both)
    }

    /// The smallest that holds both.
    pub(super) fn or(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    fn around(points: impl Iterator<Item = DVec2>) -> Option<Self> {
        points.map(|p| Self { low: p, high: p }).reduce(Self::or)
    }

    pub(super) fn middle(&self) -> DVec2 {
        self.low * 0.5 + self.high * 0.5
    }

    /// Half of the longer side.
    pub(super) fn half(&self) -> f64 {
        ((self.high - self.low) * 0.5).max_element()
    }
}

/// How a light looks: from where and whereto.
#[derive(Clone, Copy, Debug)]
pub(super) struct Eye {
    /// A light's position; the world's origin for a directional light.
    pub(super) origin: DVec3,
    /// To right, up and forward: a rotation or a reflection.
    pub(super) axes: DMat3,
    /// Whether it looks from one point and not along parallels.
    pub(super) central: bool,
}

impl Eye {
    /// Looks from `origin` along a unit vector.
    pub(super) fn along(origin: DVec3, forward: DVec3, central: bool) -> Self {
        let right = forward.any_orthonormal_vector();
        let rows = DMat3::from_cols(right, forward.cross(right), forward);
        Self { origin, axes: rows.transpose(), central }
    }

    /// The six faces of a cube round `origin`, in the order of `map_face` in `receiver.glsl`.
    pub(super) fn cube(origin: DVec3) -> [Self; 6] {
        let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
        [(x, y, z), (-x, y, z), (y, z, x), (-y, z, x), (z, x, y), (-z, x, y)].map(|(forward, right, up)| {
            Self { origin, axes: DMat3::from_cols(right, up, forward).transpose(), central: true }
        })
    }

    /// Right, up and forward of a point.
    pub(super) fn see(&self, point: DVec3) -> DVec3 {
        self.axes * (point - self.origin)
    }

    /// The window that holds the hull of some points, as far as it is in front; `None` if all are behind.
    pub(super) fn window_of_points(&self, points: &[DVec3]) -> Option<Window> {
        let seen = || points.iter().map(|&p| self.see(p));
        if !self.central {
            return Window::around(seen().map(|p| p.truncate()));
        }
        let front = seen().filter(|p| p.z > 0.0).count();
        if front == points.len() {
            Window::around(seen().map(|p| p.truncate() / p.z))
        } else {
            (front > 0).then_some(Window::ALL)
        }
    }

    /// The window that holds a ball; `None` if it is behind.
    pub(super) fn window_of_ball(&self, center: DVec3, radius: f64) -> Option<Window> {
        let c = self.see(center);
        if !self.central {
            let r = DVec2::splat(radius);
            return Some(Window { low: c.truncate() - r, high: c.truncate() + r });
        }
        let (x, y) = (tangents(c.x, c.z, radius)?, tangents(c.y, c.z, radius)?);
        Some(Window { low: DVec2::new(x.0, y.0), high: DVec2::new(x.1, y.1) })
    }
}

/// The tangents between which a circle at (`across`, `forward`) is seen from the origin; `None` if it is behind.
fn tangents(across: f64, forward: f64, radius: f64) -> Option<(f64, f64)> {
    let distance = across.hypot(forward);
    if distance <= radius {
        return Some((f64::NEG_INFINITY, f64::INFINITY));
    }
    let (angle, half) = (across.atan2(forward), (radius / distance).asin());
    let right = std::f64::consts::FRAC_PI_2;
    let (low, high) = (angle - half, angle + half);
    if low >= right || high <= -right {
        return None;
    }
    let low = if low <= -right { f64::NEG_INFINITY } else { low.tan() };
    let high = if high >= right { f64::INFINITY } else { high.tan() };
    Some((low, high))
}
