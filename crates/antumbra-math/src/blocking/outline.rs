//! Convex bounds of the space a shadow fills: what a rasteriser has to touch.

use glam::{DVec3, DVec4};

/// The near end of a shadow: its convex hull, extended away from the light without end, holds
/// every point that the blocker can darken. See [`Outline::near_end`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outline {
    /// The shadow may be anywhere.
    Everywhere,
    /// A flat polygon; the first `count` corners.
    Corners {
        /// The corners.
        corners: [DVec3; 4],
        /// How many of them are in use, 3 or 4.
        count: usize,
    },
    /// A circle.
    Ring {
        /// Its centre.
        center: DVec3,
        /// Unit axis.
        axis: DVec3,
        /// Its radius.
        radius: f64,
    },
    /// A ball with the light outside, and not touching.
    Ball {
        /// Its centre.
        center: DVec3,
        /// Its radius.
        radius: f64,
    },
}

/// Corners of the polygon drawn round a circle. More corners touch fewer pixels and cost more
/// vertices; with 8 the polygon is 5 % larger than the circle.
const SIDES: usize = 8;
const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Cosine and sine of each corner's angle.
const CORNERS: [(f64, f64); SIDES] = [
    (1.0, 0.0),
    (HALF, HALF),
    (0.0, 1.0),
    (-HALF, HALF),
    (-1.0, 0.0),
    (-HALF, -HALF),
    (0.0, -1.0),
    (HALF, -HALF),
];

impl Outline {
    /// A polygon of three or four corners, not of none.
    pub(super) fn corners(corners: &[DVec3]) -> Self {
        let count = corners.len().min(4);
        let mut all = [corners[0]; 4];
        all[..count].copy_from_slice(&corners[..count]);
        Self::Corners { corners: all, count }
    }

    /// Calls `near` with points whose convex hull is the near end under `light` (homogeneous), and
    /// whether the shadow goes on from the point, straight away from the light: the hull of the
    /// points and of those rays holds the shadow; points inside a ball only if it is `hollow`, that
    /// is, if they can be seen. Calls nothing for [`Outline::Everywhere`].
    pub fn near_end(&self, light: DVec4, hollow: bool, mut near: impl FnMut(DVec3, bool)) {
        let mut extend = |p| near(p, true);
        match *self {
            Self::Everywhere => {}
            Self::Corners { corners, count } => corners[..count].iter().for_each(|&p| extend(p)),
            Self::Ring { center, axis, radius } => ring(center, axis, radius, &mut extend),
            Self::Ball { center, radius } => {
                // Rays touch the ball on a circle nearer to the light than the centre; the rest of
                // the ball that is nearer still lies in the cylinder over that circle.
                let to_light = light.truncate() - center * light.w;
                let distance = to_light.length();
                let axis = to_light / distance;
                let lift = if light.w == 0.0 { 0.0 } else { (radius * radius / distance).min(radius) };
                let touching = (radius * radius - lift * lift).max(0.0).sqrt();
                ring(center + axis * lift, axis, touching, &mut extend);
                if hollow {
                    ring(center + axis * radius, axis, touching, &mut |p| near(p, false));
                }
            }
        }
    }
}

/// A regular polygon round a circle.
fn ring(center: DVec3, axis: DVec3, radius: f64, each: &mut impl FnMut(DVec3)) {
    let u = axis.any_orthonormal_vector();
    let v = axis.cross(u);
    let around = radius / (std::f64::consts::PI / SIDES as f64).cos();
    for (cos, sin) in CORNERS {
        each(center + (u * cos + v * sin) * around);
    }
}
