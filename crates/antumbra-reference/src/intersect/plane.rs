//! Ray against the plane y = 0, and the flat shapes cut out of it.

use glam::DVec3;

use crate::ray::{Hit, Ray};

/// Where the ray crosses y = 0, and the crossing. A ray in the plane or parallel to it has none.
pub(super) fn crossing(ray: &Ray) -> Option<(Hit, DVec3)> {
    let t = -ray.origin.y / ray.direction.y;
    ray.contains(t).then(|| (Hit { t, normal: DVec3::Y }, ray.at(t)))
}

/// The infinite plane.
pub(super) fn nearest(ray: &Ray) -> Option<Hit> {
    crossing(ray).map(|(hit, _)| hit)
}
