//! Ray against capsule.

use glam::DVec3;

use super::{frustum::Frustum, sphere::Sphere};
use crate::ray::{Chord, Convex, Face, Ray};

/// All points within `radius` of the segment from -half_height to half_height on the Y axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Capsule {
    pub(crate) radius: f64,
    pub(crate) half_height: f64,
}

impl Convex for Capsule {
    /// The union of a cylinder and two balls is convex, so its chord is the hull of theirs.
    fn chord(&self, ray: &Ray) -> Option<Chord> {
        let ball = Sphere { radius: self.radius };
        let end = DVec3::Y * self.half_height;
        let side = Frustum { bottom: self.radius, top: self.radius, half_height: self.half_height };
        [
            ball.chord(&Ray { origin: ray.origin - end, ..*ray }),
            ball.chord(&Ray { origin: ray.origin + end, ..*ray }),
            side.chord(ray),
        ]
        .into_iter()
        .flatten()
        .reduce(|a, b| Chord { enter: a.enter.min(b.enter), exit: a.exit.max(b.exit), ..Chord::ALL })
    }

    /// Away from the nearest point of the axis.
    fn normal(&self, point: DVec3, _: Face) -> DVec3 {
        let axis = DVec3::Y * point.y.max(-self.half_height).min(self.half_height);
        (point - axis).normalize_or(DVec3::Y)
    }
}
