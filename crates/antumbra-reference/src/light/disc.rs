//! The disc of a disc light.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use super::flat::Figure;
use crate::sampling;

/// A disc about the origin across a unit normal.
pub(super) struct Disc {
    radius: f64,
    a: DVec3,
    b: DVec3,
}

impl Disc {
    pub(super) fn new(normal: DVec3, radius: f64) -> Self {
        let (a, b) = normal.any_orthonormal_pair();
        Self { radius, a, b }
    }
}

impl Figure for Disc {
    fn area(&self) -> f64 {
        PI * self.radius * self.radius
    }

    fn inner_radius(&self) -> f64 {
        self.radius
    }

    fn point(&self, u: DVec2) -> DVec3 {
        let (r, phi) = sampling::disc(u);
        (self.a * phi.cos() + self.b * phi.sin()) * (r * self.radius)
    }

    fn contains(&self, p: DVec3) -> bool {
        p.length() <= self.radius
    }
}
