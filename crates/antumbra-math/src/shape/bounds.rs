//! Balls around shapes, and what a light can reach.

use super::Shape;
use crate::Light;
use glam::DVec3;

impl Shape {
    /// Centre and radius of a ball that holds the shape; the radius of a plane is infinite.
    pub fn bounding_sphere(&self) -> (DVec3, f64) {
        match self {
            Self::Plane(s) => (s.normal * s.offset, f64::INFINITY),
            Self::Rectangle(s) => {
                (s.center, (s.half_right.length_squared() + s.half_forward.length_squared()).sqrt())
            }
            Self::Disc(s) => (s.center, s.radius),
            Self::Triangle(s) => {
                let center = s.vertices.iter().sum::<DVec3>() / 3.0;
                (center, s.vertices.iter().map(|v| v.distance(center)).fold(0.0, f64::max))
            }
            Self::Sphere(s) => (s.center, s.radius),
            Self::Cone(s) => {
                let center = s.base_center + s.axis * (s.height * 0.5);
                (center, s.radius.hypot(s.height * 0.5))
            }
        }
    }
}

impl Shape {
    /// Whether every number is finite.
    pub(crate) fn is_finite(&self) -> bool {
        match self {
            Self::Plane(s) => s.normal.is_finite() && s.offset.is_finite(),
            Self::Rectangle(s) => [s.center, s.half_right, s.half_forward].iter().all(|v| v.is_finite()),
            Self::Disc(s) => s.center.is_finite() && s.normal.is_finite() && s.radius.is_finite(),
            Self::Triangle(s) => s.vertices.iter().all(|v| v.is_finite()),
            Self::Sphere(s) => s.center.is_finite() && s.radius.is_finite(),
            Self::Cone(s) => {
                s.base_center.is_finite()
                    && s.axis.is_finite()
                    && s.radius.is_finite()
                    && s.height.is_finite()
            }
        }
    }
}

impl Light {
    /// Whether any light arrives in the ball: false only where a spot's cone passes it by.
    pub fn may_reach(&self, center: DVec3, radius: f64) -> bool {
        let Self::Spot { position, direction, outer_angle } = *self else { return true };
        let to_center = center - position;
        let distance = to_center.length();
        if distance <= radius {
            return true;
        }
        let off_axis = to_center.cross(direction).length().atan2(to_center.dot(direction));
        off_axis - (radius / distance).asin() <= outer_angle
    }
}
