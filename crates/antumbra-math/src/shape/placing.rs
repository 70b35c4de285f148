//! Shapes moved, turned and made larger.

use super::{Cone, Disc, Plane, Rectangle, Shape, Sphere, Triangle};
use glam::{DMat3, DMat4, DVec4};

impl Shape {
    /// The shape under a matrix of rotation, uniform scale and translation; `None` for any other
    /// matrix, and for one that is not finite.
    pub fn placed(&self, matrix: &DMat4) -> Option<Self> {
        let axes = DMat3::from_mat4(*matrix);
        let scale = axes.x_axis.length();
        let rotation = axes * (1.0 / scale);
        let is_rotation = (rotation.transpose() * rotation).abs_diff_eq(DMat3::IDENTITY, 1e-5);
        if !matrix.is_finite() || !is_rotation || matrix.row(3) != DVec4::W {
            return None;
        }
        let rigid = DMat4::from_mat3_translation(rotation, matrix.w_axis.truncate());
        Some(self.scaled(scale).transformed(&rigid))
    }

    /// The shape made larger about the origin.
    fn scaled(&self, by: f64) -> Self {
        match *self {
            Self::Plane(s) => Self::Plane(Plane { offset: s.offset * by, ..s }),
            Self::Rectangle(s) => Self::Rectangle(Rectangle {
                center: s.center * by,
                half_right: s.half_right * by,
                half_forward: s.half_forward * by,
            }),
            Self::Disc(s) => Self::Disc(Disc { center: s.center * by, radius: s.radius * by, ..s }),
            Self::Triangle(s) => Self::Triangle(Triangle { vertices: s.vertices.map(|v| v * by) }),
            Self::Sphere(s) => Self::Sphere(Sphere { center: s.center * by, radius: s.radius * by }),
            Self::Cone(s) => Self::Cone(Cone {
                base_center: s.base_center * by,
                radius: s.radius * by,
                height: s.height * by,
                ..s
            }),
        }
    }

    /// The shape after the rigid motion `transform` (rotation and translation only; see
    /// [`Shape::placed`] for matrices that scale).
    pub fn transformed(&self, transform: &DMat4) -> Self {
        let point = |p| transform.transform_point3(p);
        let vector = |v| transform.transform_vector3(v);
        match *self {
            Self::Plane(s) => Self::Plane(s.transformed(transform)),
            Self::Rectangle(s) => Self::Rectangle(Rectangle {
                center: point(s.center),
                half_right: vector(s.half_right),
                half_forward: vector(s.half_forward),
            }),
            Self::Disc(s) => {
                Self::Disc(Disc { center: point(s.center), normal: vector(s.normal), radius: s.radius })
            }
            Self::Triangle(s) => Self::Triangle(Triangle { vertices: s.vertices.map(point) }),
            Self::Sphere(s) => Self::Sphere(Sphere { center: point(s.center), radius: s.radius }),
            Self::Cone(s) => Self::Cone(Cone {
                base_center: point(s.base_center),
                axis: vector(s.axis),
                radius: s.radius,
                height: s.height,
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Light;
    use glam::{DQuat, DVec3};

    fn shapes() -> [Shape; 6] {
        let (center, normal) = (DVec3::new(0.3, -0.2, 0.1), DVec3::new(0.6, 0.8, 0.0));
        [
            Plane::through(center, normal).into(),
            Rectangle { center, half_right: DVec3::X, half_forward: DVec3::Z * 0.5 }.into(),
            Disc { center, normal, radius: 0.8 }.into(),
            Triangle { vertices: [DVec3::X, DVec3::Y, center] }.into(),
            Sphere { center, radius: 0.7 }.into(),
            Cone { base_center: center, axis: normal, radius: 0.5, height: 1.2 }.into(),
        ]
    }

    /// Shape, light and point under one matrix: the shadow comes along.
    #[test]
    fn placed_shapes_cast_the_placed_shadow() {
        let turn = DQuat::from_axis_angle(DVec3::new(2.0, -1.0, 2.0) / 3.0, 1.1);
        let matrix =
            DMat4::from_scale_rotation_translation(DVec3::splat(2.5), turn, DVec3::new(4.0, -3.0, 7.0));
        let position = DVec3::new(1.0, 3.0, 0.5);
        let placed_light = Light::Point { position: matrix.transform_point3(position) };
        for shape in shapes() {
            let placed = shape.placed(&matrix).expect("rotation, uniform scale and translation");
            let (mut dark, mut all) = (0, 0);
            for i in 0..20 * 20 * 20 {
                let at = |k: i32| f64::from(k % 20) * 0.2 - 1.93;
                let point = DVec3::new(at(i), at(i / 20), at(i / 400));
                let is_dark = shape.blocks(&Light::Point { position }, point);
                let there = placed.blocks(&placed_light, matrix.transform_point3(point));
                assert_eq!(is_dark, there, "{shape:?} at {point}");
                dark += u32::from(is_dark);
                all += 1;
            }
            assert!(dark > 0 && dark < all, "{shape:?} has a shadow and an outside");
        }
    }

    #[test]
    fn other_matrices_place_nothing() {
        let bad = [
            DMat4::from_scale(DVec3::new(1.0, 2.0, 1.0)),
            DMat4::ZERO,
            DMat4::NAN,
            DMat4::from_translation(DVec3::X * f64::INFINITY),
            DMat4::from_cols(DVec4::X, DVec4::new(0.5, 1.0, 0.0, 0.0), DVec4::Z, DVec4::W),
            DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::new(0.0, 0.0, 1.0, 1.0), DVec4::W),
        ];
        for matrix in bad {
            for shape in shapes() {
                assert_eq!(shape.placed(&matrix), None, "{shape:?} under {matrix}");
            }
        }
    }

    #[test]
    fn planes_turn_towards_a_point_unless_it_lies_in_them() {
        let plane = Plane::through(DVec3::Y * 2.0, DVec3::Y);
        assert_eq!(plane.towards(DVec3::Y * 3.0), Some(plane), "above");
        let below = plane.towards(DVec3::ZERO).expect("the origin is below");
        assert!(below.height(DVec3::ZERO) > 0.0 && below.height(DVec3::Y * 2.0) == 0.0, "{below:?}");
        assert_eq!(plane.towards(DVec3::new(5.0, 2.0, 1.0)), None, "in the plane");
        assert_eq!(plane.towards(DVec3::NAN), None, "not a number");
    }
}
