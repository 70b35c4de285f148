//! Ray against ellipsoid.

use glam::DVec3;

use super::sphere::Sphere;
use crate::ray::{Chord, Convex, Face, Ray};

/// An ellipsoid about the origin with axes along the coordinate axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ellipsoid {
    pub(crate) radii: DVec3,
}

impl Convex for Ellipsoid {
    /// The affine map that makes the ellipsoid the unit ball keeps the line's parameter.
    fn chord(&self, ray: &Ray) -> Option<Chord> {
        let mapped = Ray { origin: ray.origin / self.radii, direction: ray.direction / self.radii, ..*ray };
        Sphere { radius: 1.0 }.chord(&mapped)
    }

    /// The gradient of x²/a² + y²/b² + z²/c².
    fn normal(&self, point: DVec3, _: Face) -> DVec3 {
        // Divided by the smallest radius first, so that no square of a tiny radius underflows.
        let radii = self.radii / self.radii.min_element();
        (point / self.radii / radii).normalize_or(DVec3::Y)
    }
}
