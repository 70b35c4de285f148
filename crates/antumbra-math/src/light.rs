//! Lights as shadows see them: where light comes from, not how much.

use glam::{DMat4, DVec3, DVec4};

/// A light without extent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// Shines to all sides from one point.
    Point {
        /// Metres.
        position: DVec3,
    },
    /// Parallel light.
    Directional {
        /// Unit vector along which light travels.
        direction: DVec3,
    },
    /// A point light limited to a cone. What blocks it is what blocks a point light; outside the
    /// cone no light arrives, blocked or not.
    Spot {
        /// Metres.
        position: DVec3,
        /// Unit axis of the cone, away from the light.
        direction: DVec3,
        /// Half-angle of the cone, radians, in (0, π/2].
        outer_angle: f64,
    },
}

impl Light {
    /// The light as a homogeneous point: (position, 1), or (direction *towards* the light, 0).
    pub fn homogeneous(&self) -> DVec4 {
        match *self {
            Self::Point { position } | Self::Spot { position, .. } => position.extend(1.0),
            Self::Directional { direction } => (-direction).extend(0.0),
        }
    }

    /// The vector from `point` to the light: its whole length for a light with a position, a unit
    /// vector for a directional one.
    pub fn vector_from(&self, point: DVec3) -> DVec3 {
        let l = self.homogeneous();
        l.truncate() - point * l.w
    }

    /// The light after the rigid motion `transform` (rotation and translation only).
    pub fn transformed(&self, transform: &DMat4) -> Self {
        match *self {
            Self::Point { position } => Self::Point { position: transform.transform_point3(position) },
            Self::Directional { direction } => {
                Self::Directional { direction: transform.transform_vector3(direction) }
            }
            Self::Spot { position, direction, outer_angle } => Self::Spot {
                position: transform.transform_point3(position),
                direction: transform.transform_vector3(direction),
                outer_angle,
            },
        }
    }
}
