//! A ball between a point and a light.

use super::coverage::Edge;
use super::{Blocker, Blockers, Footprint, Outline};
use crate::Sphere;
use crate::real::{Real, Vector};
use glam::{DVec3, DVec4};

/// A ball and the light it blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereBlocker<V: Vector> {
    /// Centre of the ball.
    pub center: V,
    /// Its radius.
    pub radius: V::Real,
    /// Position of the light, or the direction towards it.
    pub light: V,
    /// 1 for a position, 0 for a direction.
    pub light_w: V::Real,
}

impl SphereBlocker<DVec3> {
    pub(super) fn to_f32(self) -> SphereBlocker<glam::Vec3> {
        SphereBlocker {
            center: self.center.as_vec3(),
            radius: self.radius as f32,
            light: self.light.as_vec3(),
            light_w: self.light_w as f32,
        }
    }
}

pub(super) fn blockers(s: &Sphere, l: DVec4) -> Blockers {
    if !(s.radius > 0.0) {
        return Blockers::NONE;
    }
    let (center, radius) = (s.center, s.radius);
    let to_light = if l.w == 0.0 { f64::INFINITY } else { (l.truncate() - center).length() };
    if to_light < radius {
        return Blockers::everything();
    }
    let blocker = SphereBlocker { center, radius, light: l.truncate(), light_w: l.w };
    // The circle where rays from a light on the ball touch it is a point, and no outline.
    let outline = if to_light < radius * (1.0 + TOUCHING) {
        Outline::Everywhere
    } else {
        Outline::Ball { center, radius }
    };
    Blockers::one(Blocker::Sphere(blocker), outline)
}

/// A light so near to a ball, in radii, darkens about a half-space. Nearer than that the rays along the
/// shadow's edge would be rounding error in float32.
const TOUCHING: f64 = 1e-6;

/// How much of the pixel a ball takes from the light.
///
/// The edge is where the line from the point to the light passes the centre at the distance of
/// the radius. That distance is the length of a vector product: the discriminant of the
/// quadratic, which is the same number in exact arithmetic, cancels in float32 and is wrong in
/// almost half the cases within one percent of the edge of a small far ball.
pub fn sphere_coverage<V: Vector>(b: &SphereBlocker<V>, footprint: &Footprint<V>) -> V::Real {
    let to_center = b.center - footprint.point;
    if to_center.dot(to_center) < b.radius * b.radius {
        return V::Real::ONE; // inside the ball
    }
    let to_light = b.light - footprint.point * b.light_w;
    let square = to_light.dot(to_light);
    let inverse = V::Real::ONE / square.sqrt();
    let direction = to_light * inverse;
    let along = to_center.dot(direction);
    let share = b.light_w * along * inverse; // of the way to the light; 0 for a directional one
    // Behind the point, or beyond the light: outside the ball, the nearest point of the segment
    // is then an end of it, and both ends are outside.
    if !(along > V::Real::ZERO && share < V::Real::ONE) {
        return V::Real::ZERO;
    }
    let miss = direction.cross(to_center).length();
    let nearest = to_center - direction * along; // from the line to the centre
    let lever = V::Real::ONE - share; // the light end of the line stays put
    let gradient = nearest * (lever / miss.max(V::Real::from_f64(1e-30)));
    Edge::new(b.radius - miss, gradient, footprint).coverage
}
