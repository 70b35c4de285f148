//! Where the eye is: outside a shadow volume, or in how many of its layers.

use super::boundary::Boundary;
use super::polygon::Eye;
use glam::{DMat4, DVec3, DVec4};

/// Share of a caster's radius that the way from the eye to the light keeps from it where nothing is in doubt.
const MARGIN: f64 = 0.01;

/// Sights and light rays nearer to parallel than this (radians) may meet anywhere.
const PARALLEL: f64 = 1e-3;

/// Whether the eye is outside the shadow volume of a caster, by some margin. The sphere holds the caster.
pub(super) fn is_clear(eye: &Eye, light: DVec4, center: DVec3, radius: f64) -> bool {
    let reach = radius * (1.0 + MARGIN);
    let (from, to) = (eye.place, light);
    let distance = match (from.w != 0.0, to.w != 0.0) {
        (true, true) => {
            let (a, b) = (from.truncate() / from.w, to.truncate() / to.w);
            let share = (center - a).dot(b - a) / (b - a).length_squared();
            // A light at the eye has no way.
            let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
            center.distance(a + (b - a) * share)
        }
        (true, false) => from_ray(from.truncate(), to.truncate(), center),
        (false, true) => from_ray(to.truncate() / to.w, from.truncate(), center),
        // The volume goes off to infinity beside the sight, unless it goes straight to the eye.
        (false, false) => {
            let sum = (from.truncate() + to.truncate().normalize_or_zero()).length();
            return sum > PARALLEL;
        }
    };
    distance > reach
}

fn from_ray(origin: DVec3, direction: DVec3, point: DVec3) -> f64 {
    let direction = direction.normalize_or_zero();
    let along = (point - origin).dot(direction).max(0.0);
    point.distance(origin + direction * along)
}

/// How many layers of a shadow volume the eye is in: the triangles of the near cap between eye and light. The two
/// triangles at an edge agree about which of them holds a point on it.
pub(super) fn layers(eye: &Eye, light: DVec4, boundary: &Boundary) -> u32 {
    let mut count = 0;
    let light_point = light;
    boundary.caps(|[a, b, c]| {
        let volume = |p: DVec4, a: DVec3, b: DVec3| {
            // In one order from both sides, so that the two get the same number with opposite signs.
            let swap = a.to_array().partial_cmp(&b.to_array()) == Some(std::cmp::Ordering::Greater);
            let (x, y) = if swap { (b, a) } else { (a, b) };
            let det = DMat4::from_cols(eye.place, p, x.extend(1.0), y.extend(1.0)).determinant();
            if swap { det < 0.0 } else { det >= 0.0 }
        };
        let sides = [volume(light_point, a, b), volume(light_point, b, c), volume(light_point, c, a)];
        let normal = (b - a).cross(c - a);
        let height = normal.dot(eye.place.truncate()) - normal.dot(a) * eye.place.w;
        if height < 0.0 && (sides == [true; 3] || sides == [false; 3]) {
            count += 1;
        }
    });
    count
}
