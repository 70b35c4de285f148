//! Shapes moved, turned and made larger.

use super::{Cone, Disc, Plane, Rectangle, Shape, Sphere, Triangle};
use core::fmt;
use glam::{DMat3, DMat4, DVec3, DVec4};

/// Why a shape cannot be placed by a matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PlacingError {
    /// The matrix has an infinity or a NaN.
    NotFinite,
    /// The matrix is projective: its last row is not (0, 0, 0, 1).
    NotAffine,
    /// The matrix takes away a dimension that the shape needs.
    Flat,
    /// A ball would become an ellipsoid.
    Ellipsoid,
    /// A circle, alone or as the base of a cone, would become an ellipse.
    Ellipse,
    /// A rectangle would become a parallelogram.
    Parallelogram,
    /// A cone's axis would not stand on its base.
    Oblique,
}

impl fmt::Display for PlacingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "the matrix has a number that is not finite",
            Self::NotAffine => "the matrix is projective: its last row is not (0, 0, 0, 1)",
            Self::Flat => "the matrix makes the shape flat",
            Self::Ellipsoid => "the matrix makes an ellipsoid of a ball; scale it by the same to all sides",
            Self::Ellipse => {
                "the matrix makes an ellipse of a circle; scale its plane by the same to all sides"
            }
            Self::Parallelogram => {
                "the matrix makes a parallelogram of a rectangle; scale it along its sides"
            }
            Self::Oblique => "the matrix makes an oblique cone; scale it along its axis or to all sides",
        })
    }
}

impl core::error::Error for PlacingError {}

/// Angles and lengths that differ by less than this part count as the same: ten times what a model matrix in float32 leaves.
const SAME: f64 = 1e-5;

impl Shape {
    /// The shape under an affine matrix, if it stays one of its kind: triangles and planes under any, rectangles while their
    /// sides stay at right angles, discs while they stay round, cones while their base stays round and their axis stands on
    /// it, balls while they stay round. Reflections count.
    ///
    /// # Errors
    /// What the matrix would make of it.
    pub fn placed(&self, matrix: &DMat4) -> Result<Self, PlacingError> {
        if !matrix.is_finite() {
            return Err(PlacingError::NotFinite);
        }
        if !matrix.row(3).abs_diff_eq(DVec4::W, SAME) {
            return Err(PlacingError::NotAffine);
        }
        let point = |p| matrix.transform_point3(p);
        let vector = |v| matrix.transform_vector3(v);
        Ok(match *self {
            Self::Plane(s) => Self::Plane(placed_plane(&s, matrix)?),
            Self::Rectangle(s) => {
                let (half_right, half_forward) = (vector(s.half_right), vector(s.half_forward));
                let sizes = half_right.length() * half_forward.length();
                if !(sizes > 0.0) && s.half_right.length() * s.half_forward.length() > 0.0 {
                    return Err(PlacingError::Flat);
                }
                if half_right.dot(half_forward).abs() > SAME * sizes {
                    return Err(PlacingError::Parallelogram);
                }
                Self::Rectangle(Rectangle { center: point(s.center), half_right, half_forward })
            }
            Self::Disc(s) => {
                let (normal, scale) = placed_circle(s.normal, matrix)?;
                Self::Disc(Disc { center: point(s.center), normal, radius: s.radius * scale })
            }
            Self::Triangle(s) => Self::Triangle(Triangle { vertices: s.vertices.map(point) }),
            Self::Sphere(s) => {
                let scale = similarity(&DMat3::from_mat4(*matrix))?;
                Self::Sphere(Sphere { center: point(s.center), radius: s.radius * scale })
            }
            Self::Cone(s) => {
                let (normal, scale) = placed_circle(s.axis, matrix)?;
                let (axis, stretch) = vector(s.axis).normalize_and_length();
                if !(stretch > 0.0) {
                    return Err(PlacingError::Flat);
                }
                if axis.cross(normal).length() > SAME {
                    return Err(PlacingError::Oblique);
                }
                Self::Cone(Cone {
                    base_center: point(s.base_center),
                    axis,
                    radius: s.radius * scale,
                    height: s.height * stretch,
                })
            }
        })
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

/// A plane under an affine matrix that can be inverted; its normal stays on the same side of it.
fn placed_plane(plane: &Plane, matrix: &DMat4) -> Result<Plane, PlacingError> {
    let normals = DMat3::from_mat4(*matrix).inverse().transpose();
    let normal = (normals * plane.normal).try_normalize().filter(|_| normals.is_finite());
    let point = matrix.transform_point3(plane.normal * plane.offset);
    normal.map(|normal| Plane::through(point, normal)).ok_or(PlacingError::Flat)
}

/// Where the unit normal of a circle goes, and how much larger the circle becomes.
fn placed_circle(normal: DVec3, matrix: &DMat4) -> Result<(DVec3, f64), PlacingError> {
    if !(normal.length_squared() > 0.0) {
        // A circle that is none stays none.
        return Ok((normal, 1.0));
    }
    let (u, v) = normal.any_orthonormal_pair();
    let (u, v) = (matrix.transform_vector3(u), matrix.transform_vector3(v));
    let (long, wide) = (u.length(), v.length());
    if !(long > 0.0 && wide > 0.0) {
        return Err(PlacingError::Flat);
    }
    if (long - wide).abs() > SAME * long.max(wide) || u.dot(v).abs() > SAME * long * wide {
        return Err(PlacingError::Ellipse);
    }
    let normal = u.cross(v).try_normalize().ok_or(PlacingError::Flat)?;
    Ok((normal, (long * wide).sqrt()))
}

/// The factor by which a matrix scales to all sides alike.
fn similarity(axes: &DMat3) -> Result<f64, PlacingError> {
    let scale = axes.determinant().abs().cbrt();
    if !(scale > 0.0) {
        return Err(PlacingError::Flat);
    }
    let turn = *axes * (1.0 / scale);
    let is_turn = (turn.transpose() * turn).abs_diff_eq(DMat3::IDENTITY, SAME);
    if is_turn { Ok(scale) } else { Err(PlacingError::Ellipsoid) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Light;
    use glam::DQuat;

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

    /// Points of the placed shape's shadow are those of the shape under the matrix, for matrices that are no similarities.
    #[test]
    fn stretched_and_mirrored_shapes_cast_the_stretched_shadow() {
        let stretch = DMat4::from_scale(DVec3::new(1.5, 0.4, 1.5));
        let turn = DMat4::from_quat(DQuat::from_axis_angle(DVec3::new(2.0, -1.0, 2.0) / 3.0, 1.1));
        let mirror = DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0));
        let upright =
            Cone { base_center: DVec3::new(0.1, -0.3, 0.2), axis: DVec3::Y, radius: 0.7, height: 1.3 };
        let level = Disc { center: DVec3::new(0.1, 0.4, 0.2), normal: DVec3::Y, radius: 0.8 };
        let card = Rectangle { center: DVec3::ZERO, half_right: DVec3::X, half_forward: DVec3::Y * 0.6 };
        let triangle = Triangle { vertices: [DVec3::X, DVec3::Y, DVec3::new(0.2, 0.1, 0.9)] };
        let plane = Plane::through(DVec3::new(0.0, 0.3, 0.1), DVec3::new(0.6, 0.8, 0.0));
        let sheared = DMat4::from_cols(DVec4::X, DVec4::new(0.5, 1.0, 0.2, 0.0), DVec4::Z, DVec4::W);
        let cases: [(Shape, DMat4); 7] = [
            (upright.into(), turn * stretch),
            (upright.into(), turn * stretch * mirror),
            (level.into(), turn * stretch),
            (card.into(), turn * stretch),
            (triangle.into(), turn * sheared),
            (plane.into(), turn * sheared),
            (
                Sphere { center: DVec3::X, radius: 0.7 }.into(),
                turn * mirror * DMat4::from_scale(DVec3::splat(2.0)),
            ),
        ];
        let position = DVec3::new(1.0, 3.0, 0.5);
        for (shape, matrix) in cases {
            let placed = shape.placed(&matrix).unwrap_or_else(|error| panic!("{shape:?}: {error}"));
            let placed_light = Light::Point { position: matrix.transform_point3(position) };
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

    /// What a matrix would make of a shape is named.
    #[test]
    fn other_matrices_place_nothing() {
        use PlacingError::{Ellipse, Ellipsoid, Flat, NotAffine, NotFinite, Oblique, Parallelogram};
        let [plane, rectangle, disc, triangle, sphere, cone] = shapes();
        let projective = DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::new(0.0, 0.0, 1.0, 1.0), DVec4::W);
        for shape in shapes() {
            assert_eq!(shape.placed(&DMat4::NAN), Err(NotFinite), "{shape:?}");
            let far = DMat4::from_translation(DVec3::X * f64::INFINITY);
            assert_eq!(shape.placed(&far), Err(NotFinite), "{shape:?}");
            assert_eq!(shape.placed(&projective), Err(NotAffine), "{shape:?}");
        }
        let nothing = DMat4::from_cols(DVec4::ZERO, DVec4::ZERO, DVec4::ZERO, DVec4::W);
        for shape in [plane, rectangle, disc, sphere, cone] {
            assert_eq!(shape.placed(&nothing), Err(Flat), "{shape:?}");
        }
        let stretched = DMat4::from_scale(DVec3::new(1.0, 2.0, 1.0));
        assert_eq!(sphere.placed(&stretched), Err(Ellipsoid));
        assert_eq!(disc.placed(&stretched), Err(Ellipse));
        assert_eq!(cone.placed(&stretched), Err(Ellipse), "its base");
        let sheared = DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::new(0.5, 0.0, 1.0, 0.0), DVec4::W);
        assert_eq!(rectangle.placed(&sheared), Err(Parallelogram));
        let upright = Cone { base_center: DVec3::ZERO, axis: DVec3::Y, radius: 1.0, height: 1.0 };
        let leaning = DMat4::from_cols(DVec4::X, DVec4::new(0.5, 1.0, 0.0, 0.0), DVec4::Z, DVec4::W);
        assert_eq!(Shape::from(upright).placed(&leaning), Err(Oblique));
        assert!(triangle.placed(&sheared).is_ok() && plane.placed(&sheared).is_ok(), "any affine matrix");
        for error in [Ellipse, Ellipsoid, Flat, NotAffine, NotFinite, Oblique, Parallelogram] {
            assert!(error.to_string().starts_with("the matrix "), "{error:?} is a sentence");
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
