//! The rectangle of a rectangle light.

use glam::{DVec2, DVec3};

use super::flat::Figure;

/// A rectangle about the origin.
pub(super) struct Rectangle {
    size: DVec2,
    right: DVec3,
    up: DVec3,
}

impl Rectangle {
    /// `normal` and `right` are unit vectors at a right angle.
    pub(super) fn new(normal: DVec3, right: DVec3, width: f64, height: f64) -> Self {
        Self { size: DVec2::new(width, height), right, up: normal.cross(right) }
    }
}

impl Figure for Rectangle {
    fn area(&self) -> f64 {
        self.size.x * self.size.y
    }

    fn inner_radius(&self) -> f64 {
        0.5 * self.size.min_element()
    }

    fn point(&self, u: DVec2) -> DVec3 {
        let p = (u - 0.5) * self.size;
        self.right * p.x + self.up * p.y
    }

    fn contains(&self, p: DVec3) -> bool {
        p.dot(self.right).abs() <= 0.5 * self.size.x && p.dot(self.up).abs() <= 0.5 * self.size.y
    }
}
