//! One-sided flat lights, sampled by area, and near their surface by direction.

use std::f64::consts::TAU;

use antumbra_scene::Light;
use glam::{DVec2, DVec3};

use super::Incoming;
use crate::sampling;

/// A flat figure centred on the light's position.
pub(super) trait Figure {
    /// Square metres.
    fn area(&self) -> f64;
    /// The largest distance from the centre such that everything nearer in the plane is in the figure.
    fn inner_radius(&self) -> f64;
    /// A point of the figure relative to its centre, uniform in area as `u` is uniform in the unit square.
    fn point(&self, u: DVec2) -> DVec3;
    /// Whether a point of the plane, relative to the centre, lies in the figure.
    fn contains(&self, p: DVec3) -> bool;
}

/// Nearer to the glowing surface than this share of the figure's inner radius, area sampling, whose samples vary as
/// 1/d², is worse than sampling the hemisphere that the figure nearly fills.
const NEAR: f64 = 0.25;

/// See [`super::incoming`].
pub(super) fn incoming(
    light: &Light,
    shines: DVec3,
    figure: &impl Figure,
    p: DVec3,
    n: DVec3,
    u: DVec2,
) -> Option<Incoming> {
    let from_center = p - light.position;
    let height = from_center.dot(shines);
    // Negated, so that NaN sends nothing either.
    if !(height > 0.0) {
        return None;
    }
    let foot = from_center - shines * height;
    let (direction, reach, weight) = if height < NEAR * figure.inner_radius() && figure.contains(foot) {
        let (r, phi) = sampling::disc(u);
        let up = 1.0 - r * r;
        let across = r * (2.0 - r * r).sqrt();
        let (a, b) = shines.any_orthonormal_pair();
        let direction = (a * phi.cos() + b * phi.sin()) * across - shines * up;
        let reach = height / up;
        if !figure.contains(foot + (direction + shines * up) * reach) {
            return None;
        }
        (direction, reach, TAU * direction.dot(n))
    } else {
        let to = figure.point(u) - from_center;
        let squared = to.length_squared();
        // cos at the surface · cos at the light · area / d².
        (to, 1.0, figure.area() * to.dot(n) * height / (squared * squared))
    };
    Some(Incoming { direction, reach, weight, irradiance: light.intensity / figure.area() * weight })
}
