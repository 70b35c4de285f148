//! Ray against cone, cylinder and frustum: all three are the frustum of a cone about the Y axis.

use glam::DVec3;

use crate::ray::{Chord, Convex, Face, Ray};

/// A solid frustum from y = -half_height to y = half_height. A cone has `top` 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frustum {
    pub(crate) bottom: f64,
    pub(crate) top: f64,
    pub(crate) half_height: f64,
}

/// An apex farther than this many half heights from the middle is no better a place to compute from than the middle.
const NEAR_APEX: f64 = 2.0;

impl Frustum {
    /// How much the radius grows for each metre upwards.
    fn slope(&self) -> f64 {
        0.5 * (self.top - self.bottom) / self.half_height
    }

    /// The height of the point to compute from, and the radius there: the apex of the whole cone where it is near,
    /// for about it the cone's equation has no terms that could cancel; else the middle.
    fn center(&self) -> (f64, f64) {
        let apex = self.half_height * (self.bottom + self.top) / (self.bottom - self.top);
        if apex.abs() <= NEAR_APEX * self.half_height {
            (apex, 0.0)
        } else {
            (0.0, 0.5 * (self.bottom + self.top))
        }
    }

    /// The two parameters at which the line meets the infinite double cone x² + z² = (radius + slope·y)², and
    /// whether the line is inside between them (true) or outside (false). `None`: the line is outside all along.
    fn lateral(&self, ray: &Ray, radius: f64) -> Option<(f64, f64, bool)> {
        let slope = self.slope();
        let (o, d) = (ray.origin, ray.direction);
        let (radius, growth) = (radius + slope * o.y, slope * d.y);
        let (flat_o, flat_d) = (o.x.hypot(o.z), d.x.hypot(d.z));
        // a t² + 2 b t + c < 0 inside; a and c as products, whose factors do not cancel twice.
        let a = (flat_d - growth.abs()) * (flat_d + growth.abs());
        let b = o.x * d.x + o.z * d.z - radius * growth;
        let c = (flat_o - radius) * (flat_o + radius);
        if a == 0.0 {
            // Parallel to a generator: one crossing. Along the axis of a cylinder: none.
            return match (b > 0.0, b < 0.0) {
                (true, _) => Some((f64::NEG_INFINITY, -c / (2.0 * b), true)),
                (_, true) => Some((-c / (2.0 * b), f64::INFINITY, true)),
                _ if c < 0.0 => Some((f64::NEG_INFINITY, f64::INFINITY, true)),
                _ => None,
            };
        }
        let discriminant = b * b - a * c;
        if a > 0.0 && discriminant.partial_cmp(&0.0) != Some(std::cmp::Ordering::Greater) {
            return None;
        }
        // A line steeper than the cone always meets it, so below zero is rounding.
        let q = -(b + discriminant.max(0.0).sqrt().copysign(b));
        // q is 0 only where b and the discriminant are: the line passes through the apex of the double cone.
        let (t0, t1) = if q == 0.0 { (0.0, 0.0) } else { (q / a, c / q) };
        Some((t0.min(t1), t0.max(t1), a > 0.0))
    }
}

impl Convex for Frustum {
    fn chord(&self, ray: &Ray) -> Option<Chord> {
        let (height, radius) = self.center();
        let (near, shift) = Ray { origin: ray.origin - DVec3::Y * height, ..*ray }.recentred();
        let mut slab = Chord::ALL;
        if !slab.clip_slab(ray, 1, self.half_height) {
            return None;
        }
        let mut slab = slab.shifted(-shift);
        let (t0, t1, between) = self.lateral(&near, radius)?;
        let chord = if between {
            slab.clip(t0, t1, Face::Curved);
            slab
        } else {
            // The line is inside both nappes, but only one nappe reaches into the slab: the other is at most
            // its apex, so of the two stretches the longer one is meant.
            let (mut before, mut after) = (slab, slab);
            before.clip(f64::NEG_INFINITY, t0, Face::Curved);
            after.clip(t1, f64::INFINITY, Face::Curved);
            if before.exit - before.enter > after.exit - after.enter { before } else { after }
        };
        (chord.enter < chord.exit).then(|| chord.shifted(shift))
    }

    fn normal(&self, point: DVec3, face: Face) -> DVec3 {
        match face {
            Face::Flat(_) => {
                if point.y < 0.0 {
                    DVec3::NEG_Y
                } else {
                    DVec3::Y
                }
            }
            Face::Curved => {
                let flat = DVec3::new(point.x, 0.0, point.z).normalize_or_zero();
                // At the apex every direction around the axis is as good as another: take the axis.
                (flat - DVec3::Y * self.slope()).normalize_or(DVec3::Y)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_point_outwards() {
        let cone = Frustum { bottom: 1.0, top: 0.0, half_height: 1.0 };
        let side = cone.normal(DVec3::new(0.5, 0.0, 0.0), Face::Curved);
        assert!((side - DVec3::new(2.0, 1.0, 0.0).normalize()).length() < 1e-15, "side: {side}");
        assert_eq!(cone.normal(DVec3::new(0.2, -1.0, 0.3), Face::Flat(1)), DVec3::NEG_Y, "base");
        assert_eq!(cone.normal(DVec3::Y, Face::Curved), DVec3::Y, "apex");
    }

    #[test]
    fn lines_through_the_apex_and_along_a_generator() {
        let cone = Frustum { bottom: 1.0, top: 0.0, half_height: 1.0 };
        // Down the axis, through the apex.
        let axis = cone.chord(&Ray::new(DVec3::new(0.0, 3.0, 0.0), DVec3::NEG_Y)).map(|c| (c.enter, c.exit));
        assert_eq!(axis, Some((2.0, 4.0)), "the axis");
        // Horizontally past the apex: touches, and touching is no hit.
        assert_eq!(cone.chord(&Ray::new(DVec3::new(-3.0, 1.0, 0.0), DVec3::X)), None, "past the apex");
        // Parallel to a generator, inside the cone: in through the other side, out through the base.
        let down = DVec3::new(1.0, -2.0, 0.0);
        let chord = cone.chord(&Ray::new(DVec3::new(-0.5, 1.0, 0.0), down)).expect("hits");
        let (a, b) =
            (DVec3::new(-0.5, 1.0, 0.0) + down * chord.enter, DVec3::new(-0.5, 1.0, 0.0) + down * chord.exit);
        assert!((a - DVec3::new(-0.25, 0.5, 0.0)).length() < 1e-12, "enters at {a}");
        assert!((b - DVec3::new(0.5, -1.0, 0.0)).length() < 1e-12, "leaves at {b}");
    }
}
