//! Lights with an area as collections of points: which points.
//!
//! Theory and measured error: docs/theory/samples.md.

use crate::input::{Area, Light, Pattern};
use antumbra_math::Light as Place;
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The golden ratio's fractional part: the steps of the most even lattice in one dimension.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// The plastic number's reciprocal, for a third dimension that keeps apart from the golden one.
const PLASTIC: f64 = 0.754_877_666_246_692_7;

/// Calls `each` with the offsets, from the light's centre, of `count` points that stand for it; no points for a
/// light without area.
///
/// Flat lights have theirs on their surface. A ball has them inside, dense as 1 / sqrt(R² - r²): every line
/// through the ball then passes the same amount, π, so that points which shine to all sides alike, seen from
/// anywhere outside, look like a ball of even radiance, without bias. Points on its surface would do too, but half
/// of them face away. In directions they are a Fibonacci spiral. A single point is the centre.
fn light_points(area: &Area, count: u32, pattern: Pattern, mut each: impl FnMut(DVec3)) {
    if count == 1 && *area != Area::None {
        return each(DVec3::ZERO);
    }
    let Some([right, up]) = area.half_axes() else { return };
    let n = f64::from(count);
    for k in (0..count).map(f64::from) {
        let even = (k + 0.5) / n;
        let flat = |p: DVec2| right * p.x + up * p.y;
        each(match (pattern, area) {
            (Pattern::Row, _) => right * (2.0 * k / (n - 1.0) - 1.0),
            (Pattern::Spread, Area::Rectangle { .. }) => flat(on_square(count, k)),
            (Pattern::Spread, Area::Disc { .. }) => flat(DVec2::from_angle(TAU * GOLDEN * k) * even.sqrt()),
            (Pattern::Spread, Area::Sphere { radius }) => {
                let (height, turn) = (1.0 - 2.0 * even, DVec2::from_angle(TAU * GOLDEN * k));
                let across = (1.0 - height * height).max(0.0).sqrt();
                let direction = DVec3::new(turn.x * across, height, turn.y * across);
                direction * (radius * ball_radius((0.5 + PLASTIC * k).fract()))
            }
            (Pattern::Spread, Area::None) => DVec3::ZERO,
        });
    }
}

/// The `k`th of so many points of the square from -1 to 1.
fn on_square(count: u32, k: f64) -> DVec2 {
    let side = count.isqrt();
    let at = |x: f64| 2.0 * x - 1.0;
    if side * side == count {
        let n = f64::from(side);
        return DVec2::new(at((k % n + 0.5) / n), at(((k / n).floor() + 0.5) / n));
    }
    DVec2::new(at((k + 0.5) / f64::from(count)), at((0.5 + GOLDEN * k).fract()))
}

/// The radius within which a `share` of the points of a unit ball lie that is dense as 1 / sqrt(1 - r²): sin t with
/// (2 t - sin 2t) / π = share.
fn ball_radius(share: f64) -> f64 {
    let (mut low, mut high) = (0.0, FRAC_PI_2);
    for _ in 0..40 {
        let t = 0.5 * (low + high);
        if 2.0 * t - (2.0 * t).sin() < share * PI { low = t } else { high = t }
    }
    (0.5 * (low + high)).sin()
}

/// Appends the hard lights that stand for `light`: itself if it has no area.
pub(crate) fn push_points(lights: &mut Vec<Light>, light: &Light, count: u32, pattern: Pattern) {
    let Place::Point { position } = light.place else { return lights.push(*light) };
    if light.area == Area::None {
        return lights.push(*light);
    }
    light_points(&light.area, count, pattern, |offset| {
        let place = Place::Point { position: position + offset };
        lights.push(Light { place, area: Area::None, ..*light });
    });
}

#[cfg(test)]
mod tests;
