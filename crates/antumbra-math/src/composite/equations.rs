//! The papers' numbered equations, in the papers' frame and letters.
//!
//! Numbers are those of "Real-Time Shadows in OpenGL Caused by the Presence of Multiple Light
//! Sources" (2017); those of "Sphere and Cone Composite Realtime Shadows in OpenGL" (2013) follow in
//! brackets. None of these functions checks that the light is above the object: [`super::cast`] does.

use glam::DVec3;

/// A light in the papers' frame: it has no z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperLight {
    /// x_i, metres; of a directional light the horizontal part of the unit vector towards it.
    pub x: f64,
    /// y_i, metres above the plane, positive; of a directional light the vertical part of that vector.
    pub y: f64,
    /// 1 for a light with a position. 0 for a directional light: with it each equation is its own
    /// limit for a light that moves away along a line.
    pub w: f64,
}

/// Eq. (2) and (5) [2013: (1), (6)]: x of the shadow of a point at distance `d` over the origin,
/// metres,
///
/// x_s = -d x_i / (y_i - d).
///
/// For a directional light -d x_i / y_i.
pub fn shadow_x(light: PaperLight, d: f64) -> f64 {
    -d * light.x / (light.y - light.w * d)
}

/// Eq. (3) [2013: (2)]: the radius of the shadow of a circle of radius `r`, parallel to the plane at
/// distance `d`, metres,
///
/// r_s = r y_i / (y_i - d).
///
/// For a directional light r.
pub fn shadow_radius(light: PaperLight, r: f64, d: f64) -> f64 {
    r * light.y / (light.y - light.w * d)
}

/// Eq. (4) [2013: (5)]: the length of the shadow of a triangle's base of length `a`, parallel to the
/// plane at distance `d`, metres,
///
/// a_1 = a y_i / (y_i - d).
pub fn shadow_base(light: PaperLight, a: f64, d: f64) -> f64 {
    shadow_radius(light, a, d)
}

/// Eq. (8) [2013: (9)]: x of the shadow of an apex `h` above a base's centre at distance `d`, metres,
///
/// x_s3 = x_i (h + d) / (d + h - y_i).
///
/// It is Eq. (2) of a point at d + h. `h` is negative for an apex below its base, as of a cone upside
/// down, which the papers do not draw.
pub fn shadow_apex_x(light: PaperLight, h: f64, d: f64) -> f64 {
    light.x * (h + d) / (light.w * (d + h) - light.y)
}

/// Eq. (1): the shade of a shadow, 0 black and 1 white,
///
/// k = 1 - distObj / distLight,
///
/// with distObj from the object's centre to the shadow's, distLight from `light` to the shadow's
/// centre. Limited to [0, 1]; 1 where it is not defined. A directional light is infinitely far away:
/// its k is 1.
///
/// The papers say in one sentence that the shade is *darker* for values nearer to one; their equation,
/// their code and what they want it for (darker for a nearer light) say the opposite, as here.
pub fn shade(object: DVec3, light: DVec3, shadow: DVec3) -> f64 {
    let k = 1.0 - object.distance(shadow) / light.distance(shadow);
    if k.is_nan() { 1.0 } else { k.clamp(0.0, 1.0) }
}
