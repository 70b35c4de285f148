//! Ray against rectangle.

use super::plane;
use crate::ray::{Hit, Ray};

/// A rectangle in y = 0 about the origin; its border belongs to it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rectangle {
    pub(super) half_x: f64,
    pub(super) half_z: f64,
}

impl Rectangle {
    pub(super) fn nearest(&self, ray: &Ray) -> Option<Hit> {
        let (hit, p) = plane::crossing(ray)?;
        (p.x.abs() <= self.half_x && p.z.abs() <= self.half_z).then_some(hit)
    }
}
