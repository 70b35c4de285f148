//! Unit vectors and quaternions that stay as they are when they are made unit again.
//!
//! Normalising a vector that was normalised before may move it by a rounding error. A scene that is
//! written and read again must not drift, so what has the length 1 already is kept.

use glam::{DQuat, DVec3, DVec4};

/// How far from 1 the square of a normalised vector's length may be, and how far from 0 the product
/// of two perpendicular ones. The roundings of the length, its reciprocal, the product and this test
/// add up to some six units in the last place at worst.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The vector with the length 1; itself where it has that length to rounding, and where it has no
/// direction.
pub(crate) fn unit(v: DVec3) -> DVec3 {
    if is_one(v.length_squared()) { v } else { v.try_normalize().unwrap_or(v) }
}

/// As [`unit`], of a quaternion.
pub(crate) fn unit_rotation(q: DQuat) -> DQuat {
    let v = DVec4::from(q);
    if is_one(v.length_squared()) { q } else { v.try_normalize().map_or(q, DQuat::from_vec4) }
}

/// The unit vector along the part of `v` that is perpendicular to the unit vector `axis`; itself where
/// it is that to rounding.
pub(crate) fn perpendicular(v: DVec3, axis: DVec3) -> DVec3 {
    let mut v = unit(v);
    // What is left of a vector nearly along the axis is mostly rounding error: a second round takes
    // out what the first one left, and a third finds nothing to do.
    for _ in 0..3 {
        if v.dot(axis).abs() <= ROUNDING {
            break;
        }
        v = unit(v.reject_from_normalized(axis));
    }
    v
}

fn is_one(length_squared: f64) -> bool {
    (length_squared - 1.0).abs() <= ROUNDING
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Vectors of all lengths and directions, some nearly along an axis.
    fn vectors(random: &mut fastrand::Rng) -> DVec3 {
        let mut component = || (random.f64() - 0.5) * 10f64.powi(random.i32(-6..6));
        DVec3::new(component(), component(), component())
    }

    #[test]
    fn a_unit_vector_is_kept_to_the_bit() {
        let mut random = fastrand::Rng::with_seed(1);
        for _ in 0..200_000 {
            let v = vectors(&mut random);
            if v.length() < 1e-6 {
                continue;
            }
            let once = unit(v);
            assert_eq!(unit(once), once, "{v:?} made unit twice");
            assert!((once.length() - 1.0).abs() < 1e-15, "{v:?} has the length {}", once.length());
            assert!(once.dot(v) > 0.999_999_999 * v.length(), "{v:?} became {once:?}");
            let q = DQuat::from_xyzw(v.x, v.y, v.z, random.f64());
            let once = unit_rotation(q);
            assert_eq!(unit_rotation(once), once, "{q:?} made unit twice");
            assert!(once.is_normalized(), "{q:?} became {once:?}");
        }
    }

    #[test]
    fn a_perpendicular_is_kept_to_the_bit() {
        let mut random = fastrand::Rng::with_seed(2);
        for i in 0..200_000 {
            let axis = unit(vectors(&mut random) + DVec3::splat(1e-5));
            // Every other one nearly along the axis.
            let v = if i % 2 == 0 {
                vectors(&mut random)
            } else {
                axis + unit(vectors(&mut random)) * 10f64.powi(random.i32(-6..0))
            };
            let v = unit(v);
            if axis.cross(v).length() < 1e-6 {
                continue;
            }
            let once = perpendicular(v, axis);
            assert_eq!(perpendicular(once, axis), once, "{v:?} across {axis:?} made so twice");
            assert!(once.dot(axis).abs() < 1e-14, "{once:?} is not across {axis:?}");
            assert!((once.length() - 1.0).abs() < 1e-14, "{once:?} is no unit vector");
            assert!(once.dot(v) > 0.0, "{once:?} is not along {v:?}");
        }
    }

    #[test]
    fn what_has_no_direction_is_left_alone() {
        for v in [DVec3::ZERO, DVec3::splat(1e300), DVec3::INFINITY] {
            assert_eq!(unit(v), v, "{v}");
        }
        assert!(unit(DVec3::NAN).is_nan(), "not a number stays so");
        assert!(perpendicular(DVec3::NAN, DVec3::Y).is_nan(), "not a number stays so");
    }
}
