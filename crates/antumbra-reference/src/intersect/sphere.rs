//! Ray against ball.

use glam::DVec3;

use crate::ray::{Chord, Convex, Face, Ray};

/// A ball about the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sphere {
    pub(crate) radius: f64,
}

impl Convex for Sphere {
    /// From the squared distance between centre and line, never from b² - ac, which cancels for distant rays
    /// (Haines et al., Ray Tracing Gems, 2019, chapter 7).
    fn chord(&self, ray: &Ray) -> Option<Chord> {
        let (near, shift) = ray.recentred();
        let distance = near.origin.length();
        let inside = (self.radius - distance) * (self.radius + distance);
        if inside > 0.0 {
            let half = (inside / ray.direction.length_squared()).sqrt();
            Some(Chord { enter: -half, exit: half, ..Chord::ALL }.shifted(shift))
        } else {
            None
        }
    }

    fn normal(&self, point: DVec3, _: Face) -> DVec3 {
        point.normalize_or(DVec3::Y)
    }
}
