//! The glowing sphere, sampled in the cone of directions it fills.

use std::f64::consts::{PI, TAU};

use antumbra_scene::Light;
use glam::{DVec2, DVec3};

use super::Incoming;
use crate::sampling;

/// See [`super::incoming`]. Uniform in solid angle over the cap seen from `p`.
pub(super) fn incoming(light: &Light, radius: f64, p: DVec3, n: DVec3, u: DVec2) -> Option<Incoming> {
    let to = light.position - p;
    let distance = to.length();
    let axis = to.try_normalize().unwrap_or(n);
    let sine = (radius / distance).min(1.0);
    // 1 - cos of the cap's half-angle, without the cancellation.
    let cap = sine * sine / (1.0 + ((1.0 - sine) * (1.0 + sine)).sqrt());

    let (r, phi) = sampling::disc(u);
    let height = cap * r * r;
    let across = (height * (2.0 - height)).max(0.0).sqrt();
    let (a, b) = axis.any_orthonormal_pair();
    let direction = axis * (1.0 - height) + (a * phi.cos() + b * phi.sin()) * across.copysign(r);

    // The near side of the sphere along the direction; at once where the point is inside.
    let outside = (distance - radius) * (distance + radius);
    let reach = if outside > 0.0 {
        let half = (radius * radius - (distance * across).powi(2)).max(0.0).sqrt();
        outside / (distance * (1.0 - height) + half)
    } else {
        0.0
    };
    let weight = TAU * cap * direction.dot(n);
    Some(Incoming { direction, reach, weight, irradiance: light.intensity / (PI * radius * radius) * weight })
}
