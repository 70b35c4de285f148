//! Numbers as hosts have them: arrays of either precision, or glam's types.

use glam::{DMat4, DVec3, Mat4, Vec3};

/// Three coordinates: `[f32; 3]`, `[f64; 3]`, tuples of these, and glam's `Vec3` and `DVec3` become one by themselves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector(DVec3);

/// A matrix of four columns: sixteen numbers of either precision, column after column as OpenGL takes them, or in arrays of
/// four, and glam's `Mat4` and `DMat4` become one by themselves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matrix(DMat4);

/// Linear red, green and blue, times an intensity: three numbers as for a [`Vector`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Color(Vec3);

impl Vector {
    /// The vector in glam's type.
    pub fn glam(self) -> DVec3 {
        self.0
    }
}

impl Matrix {
    /// The matrix in glam's type.
    pub fn glam(self) -> DMat4 {
        self.0
    }
}

impl Color {
    /// The colour in glam's type.
    pub fn glam(self) -> Vec3 {
        self.0
    }
}

/// From other types, each by a function.
macro_rules! from {
    ($to:ident: $($type:ty => $convert:expr;)*) => {$(
        impl From<$type> for $to {
            fn from(value: $type) -> Self {
                let convert: fn($type) -> _ = $convert;
                Self(convert(value))
            }
        }
    )*};
}

from! { Vector:
    DVec3 => |v| v;
    Vec3 => |v| v.as_dvec3();
    [f64; 3] => DVec3::from_array;
    [f32; 3] => |v| Vec3::from_array(v).as_dvec3();
    (f64, f64, f64) => |v| v.into();
    (f32, f32, f32) => |v| Vec3::from(v).as_dvec3();
}

from! { Color:
    Vec3 => |v| v;
    DVec3 => |v| v.as_vec3();
    [f32; 3] => Vec3::from_array;
    [f64; 3] => |v| DVec3::from_array(v).as_vec3();
    (f32, f32, f32) => |v| v.into();
    (f64, f64, f64) => |v| DVec3::from(v).as_vec3();
}

from! { Matrix:
    DMat4 => |m| m;
    Mat4 => |m| m.as_dmat4();
    [f64; 16] => |m| DMat4::from_cols_array(&m);
    [f32; 16] => |m| Mat4::from_cols_array(&m).as_dmat4();
    [[f64; 4]; 4] => |m| DMat4::from_cols_array_2d(&m);
    [[f32; 4]; 4] => |m| Mat4::from_cols_array_2d(&m).as_dmat4();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_every_kind_are_the_same_numbers() {
        let expected = DVec3::new(1.0, 2.5, -3.0);
        let vectors: [Vector; 6] = [
            expected.into(),
            expected.as_vec3().into(),
            [1.0f64, 2.5, -3.0].into(),
            [1.0f32, 2.5, -3.0].into(),
            (1.0f64, 2.5, -3.0).into(),
            (1.0f32, 2.5, -3.0).into(),
        ];
        assert!(vectors.iter().all(|v| v.glam() == expected), "{vectors:?}");
        let colors: [Color; 6] = [
            expected.into(),
            expected.as_vec3().into(),
            [1.0f64, 2.5, -3.0].into(),
            [1.0f32, 2.5, -3.0].into(),
            (1.0f64, 2.5, -3.0).into(),
            (1.0f32, 2.5, -3.0).into(),
        ];
        assert!(colors.iter().all(|c| c.glam() == expected.as_vec3()), "{colors:?}");
        let matrix = DMat4::from_cols_array(&std::array::from_fn(|i| i as f64 * 0.5));
        let single = matrix.as_mat4();
        let matrices: [Matrix; 6] = [
            matrix.into(),
            single.into(),
            matrix.to_cols_array().into(),
            single.to_cols_array().into(),
            matrix.to_cols_array_2d().into(),
            single.to_cols_array_2d().into(),
        ];
        assert!(matrices.iter().all(|m| m.glam() == matrix), "{matrices:?}");
        // Literals without a type.
        let plain: Vector = [0.1, 0.2, 0.3].into();
        assert_eq!(plain.glam(), DVec3::new(0.1, 0.2, 0.3), "in the precision of the literals");
    }
}
