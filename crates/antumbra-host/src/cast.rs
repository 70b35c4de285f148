//! The shapes that the host draws by casting the eye's ray at them.

use antumbra::glam::{Vec3, Vec3Swizzles, Vec4};
use antumbra_scene::Shape;

/// A shape in the shader's numbers.
pub(crate) struct Cast {
    pub(crate) shape: i32,
    pub(crate) size: Vec4,
    pub(crate) triangle: [Vec3; 3],
    pub(crate) center: Vec3,
    pub(crate) half_size: Vec3,
}

impl Cast {
    /// `None` for shapes that are drawn as triangles.
    pub(crate) fn new(shape: &Shape) -> Option<Self> {
        let cast = |shape, size: Vec4, half_size: Vec3| Self {
            shape,
            size,
            triangle: [Vec3::ZERO; 3],
            center: Vec3::ZERO,
            half_size,
        };
        // Boxes of flat shapes are a little thick, so that their far side exists.
        Some(match *shape {
            Shape::Plane => cast(0, Vec4::ZERO, Vec3::ZERO),
            Shape::Rectangle { width, depth } => {
                let half = Vec3::new(width as f32, 0.0, depth as f32) * 0.5;
                cast(1, half.xz().extend(0.0).extend(0.0), half + half.max_element() * 1e-2)
            }
            Shape::Disc { radius } => {
                let r = radius as f32;
                cast(2, Vec4::splat(r), Vec3::new(r, r * 1e-2, r) * 1.01)
            }
            Shape::Triangle { vertices } => {
                let triangle = vertices.map(|v| v.as_vec3());
                let low = triangle.into_iter().reduce(Vec3::min)?;
                let high = triangle.into_iter().reduce(Vec3::max)?;
                let half_size = (high - low) * 0.5;
                let half_size = half_size + half_size.max_element() * 1e-2;
                Self { triangle, center: (low + high) * 0.5, ..cast(3, Vec4::ZERO, half_size) }
            }
            Shape::Sphere { radius } => {
                cast(4, Vec4::splat(radius as f32), Vec3::splat(radius as f32 * 1.01))
            }
            Shape::Cone { radius, height } => {
                let (r, h) = (radius as f32, height as f32);
                cast(5, Vec4::new(r, h, 0.0, 0.0), Vec3::new(r, h * 0.5, r) * 1.01)
            }
            Shape::Ellipsoid { .. }
            | Shape::Cylinder { .. }
            | Shape::Capsule { .. }
            | Shape::Box { .. }
            | Shape::Torus { .. }
            | Shape::Mesh(_) => return None,
        })
    }
}
