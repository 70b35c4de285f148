//! The surfaces of lights that have one.

use super::Vector;
use glam::DVec3;

/// The surface of a light that has one, centred on its position. All sizes in metres, positive.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Area {
    /// Light from one point, or one direction.
    #[default]
    None,
    /// A glowing ball.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// A disc that shines to one side.
    Disc {
        /// Unit normal of the side that shines.
        direction: DVec3,
        /// Radius.
        radius: f64,
    },
    /// A rectangle that shines to one side.
    Rectangle {
        /// Unit normal of the side that shines.
        direction: DVec3,
        /// From the centre to the middle of one side.
        half_right: DVec3,
        /// From the centre to the middle of a neighbouring side, at right angles.
        half_up: DVec3,
    },
}

impl Area {
    /// A glowing ball.
    pub fn sphere(radius: impl Into<f64>) -> Self {
        Self::Sphere { radius: radius.into() }
    }

    /// A disc that shines along `direction` (any length but zero).
    pub fn disc(direction: impl Into<Vector>, radius: impl Into<f64>) -> Self {
        let direction = direction.into().glam().normalize_or_zero();
        Self::Disc { direction, radius: radius.into() }
    }

    /// A rectangle that shines to the side of `half_right` × `half_up`, which reach from its centre to the middles of two
    /// neighbouring sides, at right angles.
    pub fn rectangle(half_right: impl Into<Vector>, half_up: impl Into<Vector>) -> Self {
        let (half_right, half_up) = (half_right.into().glam(), half_up.into().glam());
        let direction = half_right.cross(half_up).normalize_or_zero();
        Self::Rectangle { direction, half_right, half_up }
    }

    /// From the centre to two points of the rim, at right angles: of a ball's on its horizontal great circle. `None` for a
    /// light without area.
    pub(crate) fn half_axes(&self) -> Option<[DVec3; 2]> {
        Some(match *self {
            Self::None => return None,
            Self::Sphere { radius } => [DVec3::X * radius, DVec3::Z * radius],
            Self::Disc { direction, radius } => {
                let right = direction.any_orthonormal_vector();
                [right * radius, direction.cross(right) * radius]
            }
            Self::Rectangle { half_right, half_up, .. } => [half_right, half_up],
        })
    }

    /// Whether sizes are positive and finite and directions of unit length.
    pub(super) fn is_sane(&self) -> bool {
        let size = |x: f64| x.is_finite() && x > 0.0;
        let unit = |v: &DVec3| v.is_finite() && (v.length() - 1.0).abs() < 1e-4;
        match self {
            Self::None => true,
            Self::Sphere { radius } => size(*radius),
            Self::Disc { direction, radius } => unit(direction) && size(*radius),
            Self::Rectangle { direction, half_right, half_up } => {
                unit(direction) && size(half_right.length()) && size(half_up.length())
            }
        }
    }
}
