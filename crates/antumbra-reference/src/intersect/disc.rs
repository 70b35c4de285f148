//! Ray against disc.

use super::plane;
use crate::ray::{Hit, Ray};

/// A disc in y = 0 about the origin; its rim belongs to it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disc {
    pub(super) radius: f64,
}

impl Disc {
    pub(super) fn nearest(&self, ray: &Ray) -> Option<Hit> {
        let (hit, p) = plane::crossing(ray)?;
        (p.x.hypot(p.z) <= self.radius).then_some(hit)
    }
}
