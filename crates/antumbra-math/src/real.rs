//! One implementation for float64 (ground for decisions) and float32 (what the GPU runs): the
//! scalars and vectors that the point tests are written in.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// A floating-point scalar: `f32` or `f64`.
pub trait Real:
    Copy
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + core::fmt::Debug
{
    /// 0.
    const ZERO: Self;
    /// 1/2.
    const HALF: Self;
    /// 1.
    const ONE: Self;
    /// +∞.
    const INFINITY: Self;
    /// The nearest value to `x`.
    fn from_f64(x: f64) -> Self;
    /// This value in float64.
    fn to_f64(self) -> f64;
    /// √x; NaN below zero.
    fn sqrt(self) -> Self;
    /// The angle of the point (`x`, this), radians in [-π, π].
    fn atan2(self, x: Self) -> Self;
    /// |x|.
    fn abs(self) -> Self;
    /// The smaller one; the other one if one is NaN.
    fn min(self, other: Self) -> Self;
    /// The larger one; the other one if one is NaN.
    fn max(self, other: Self) -> Self;
    /// Limited to [lo, hi].
    fn clamp(self, lo: Self, hi: Self) -> Self {
        self.max(lo).min(hi)
    }
}

/// A vector of three reals: [`glam::Vec3`] or [`glam::DVec3`].
pub trait Vector:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Self::Real, Output = Self> + Neg<Output = Self>
{
    /// The scalar.
    type Real: Real;
    /// Two components.
    fn new(x: Self::Real, y: Self::Real, z: Self::Real) -> Self;
    /// The nearest vector to `v`.
    fn from_dvec3(v: glam::DVec3) -> Self;
    /// Σ a_i b_i.
    fn dot(self, other: Self) -> Self::Real;
    /// The vector product.
    fn cross(self, other: Self) -> Self;
    /// √(v·v).
    fn length(self) -> Self::Real {
        self.dot(self).sqrt()
    }
}

macro_rules! real {
    ($real:ty, $vector:ty) => {
        impl Real for $real {
            const ZERO: Self = 0.0;
            const HALF: Self = 0.5;
            const ONE: Self = 1.0;
            const INFINITY: Self = <$real>::INFINITY;
            fn from_f64(x: f64) -> Self {
                x as Self
            }
            fn to_f64(self) -> f64 {
                self as f64
            }
            fn sqrt(self) -> Self {
                <$real>::sqrt(self)
            }
            fn atan2(self, x: Self) -> Self {
                <$real>::atan2(self, x)
            }
            fn abs(self) -> Self {
                <$real>::abs(self)
            }
            fn min(self, other: Self) -> Self {
                <$real>::min(self, other)
            }
            fn max(self, other: Self) -> Self {
                <$real>::max(self, other)
            }
        }
        impl Vector for $vector {
            type Real = $real;
            fn new(x: $real, y: $real, z: $real) -> Self {
                <$vector>::new(x, y, z)
            }
            fn from_dvec3(v: glam::DVec3) -> Self {
                <$vector>::new(v.x as $real, v.y as $real, v.z as $real)
            }
            fn dot(self, other: Self) -> $real {
                <$vector>::dot(self, other)
            }
            fn cross(self, other: Self) -> Self {
                <$vector>::cross(self, other)
            }
        }
    };
}
real!(f32, glam::Vec3);
real!(f64, glam::DVec3);
