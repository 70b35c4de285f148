//! The shapes that the host draws as triangles: their triangles, with the normals of the surfaces that
//! these stand for.

use antumbra::glam::{DVec3, DVec4, Vec3};
use antumbra_scene::Shape;

use crate::tessellate::tessellated;

/// A corner of a triangle as the shader reads it.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Corner {
    position: [f32; 3],
    normal: [f32; 3],
    facet: [f32; 3],
    around: [f32; 4],
}

/// Triangles ready for the GPU.
pub(crate) struct Triangles {
    /// Three to a triangle.
    pub(crate) corners: Vec<Corner>,
    /// The corners' origin in the shape's space: near them, so that float32 is enough.
    pub(crate) origin: DVec3,
}

impl Triangles {
    /// Of any shape but the infinite plane, which has none. Triangles without area are seen
    /// by nobody and left out, like those with a corner that is not finite or not there.
    pub(crate) fn new(shape: &Shape) -> Self {
        if let Shape::Mesh(mesh) = shape {
            let corner = |i: u32| mesh.positions.get(i as usize).copied().filter(|p| p.is_finite());
            let all = mesh.triangles.iter();
            let triangles: Vec<[DVec3; 3]> =
                all.filter_map(|&[a, b, c]| Some([corner(a)?, corner(b)?, corner(c)?])).collect();
            Self::of(&triangles, shape)
        } else {
            let mesh = tessellated(shape).ok();
            let triangles: Vec<[DVec3; 3]> =
                mesh.iter().flat_map(|m| (0..).map_while(|i| m.corners(i))).collect();
            Self::of(&triangles, shape)
        }
    }

    fn of(triangles: &[[DVec3; 3]], shape: &Shape) -> Self {
        let points = || triangles.as_flattened().iter();
        let low = points().copied().reduce(DVec3::min).unwrap_or_default();
        let high = points().copied().reduce(DVec3::max).unwrap_or_default();
        let origin = 0.5 * low + 0.5 * high;
        let mut corners = Vec::with_capacity(3 * triangles.len());
        for triangle in triangles {
            let [a, b, c] = *triangle;
            let Some(facet) = (b - a).cross(c - a).try_normalize() else { continue };
            let center = (a + b + c) / 3.0;
            let radius = triangle.iter().map(|p| p.distance(center)).fold(0.0, f64::max);
            let around: DVec4 = (center - origin).extend(radius);
            corners.extend(triangle.map(|p| Corner {
                position: single(p - origin),
                normal: single(normal(shape, p, triangle, facet)),
                facet: single(facet),
                around: around.as_vec4().to_array(),
            }));
        }
        Self { corners, origin }
    }
}

fn single(v: DVec3) -> [f32; 3] {
    let v: Vec3 = v.as_vec3();
    v.to_array()
}

/// The outward unit normal of a shape's surface at a corner of one of its triangles. Flat parts, and
/// meshes, whose surface the triangles are, have the triangle's.
fn normal(shape: &Shape, p: DVec3, triangle: &[DVec3; 3], facet: DVec3) -> DVec3 {
    let outward = match *shape {
        Shape::Sphere { .. } => p,
        Shape::Ellipsoid { radii } => p / (radii * radii),
        Shape::Cylinder { radius, height, radius_top } => {
            let cap = triangle.iter().all(|q| q.y == p.y);
            let out = p.with_y(0.0).normalize_or_zero();
            if cap { facet } else { out * height + DVec3::Y * (radius - radius_top) }
        }
        Shape::Capsule { height, .. } => p.with_y(p.y - p.y.clamp(-0.5 * height, 0.5 * height)),
        Shape::Torus { major_radius, .. } => p - p.with_y(0.0).normalize_or_zero() * major_radius,
        _ => facet,
    };
    outward.try_normalize().unwrap_or(facet)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tessellate::SEGMENTS;

    #[test]
    fn normals_are_of_the_true_surface() {
        // The facets of a fine tessellation are almost the surface: at most an angle of two segments.
        let most = 2.0 * core::f64::consts::TAU / f64::from(SEGMENTS);
        for shape in [
            Shape::Ellipsoid { radii: DVec3::new(0.9, 1.0, 1.1) },
            Shape::Cylinder { radius: 0.5, height: 1.2, radius_top: 0.2 },
            // Its side is as flat as its caps.
            Shape::Cylinder { radius: 0.5, height: 1e-3, radius_top: 0.2 },
            Shape::Capsule { radius: 0.4, height: 0.7 },
            Shape::Box { size: DVec3::new(1.0, 2.0, 3.0) },
            Shape::Torus { major_radius: 1.0, minor_radius: 0.4 },
            Shape::Torus { major_radius: 0.7, minor_radius: 0.7 },
        ] {
            let triangles = Triangles::new(&shape);
            assert!(!triangles.corners.is_empty(), "{shape:?} has triangles");
            for corner in &triangles.corners {
                let (normal, facet) = (Vec3::from(corner.normal), Vec3::from(corner.facet));
                assert!((normal.length() - 1.0).abs() < 1e-6, "{shape:?}: {corner:?} is unit");
                let angle = f64::from(normal.cross(facet).length()).atan2(f64::from(normal.dot(facet)));
                assert!(angle < most, "{shape:?}: {angle} between {normal} and {facet}");
            }
        }
    }

    #[test]
    fn what_is_no_surface_has_no_triangles() {
        let mesh = |positions: Vec<DVec3>, triangles| {
            Shape::Mesh(antumbra_scene::Mesh { path: "m".into(), positions, triangles }.into())
        };
        for shape in [
            Shape::Plane,
            Shape::Capsule { radius: f64::NAN, height: 1.0 },
            Shape::Torus { major_radius: 1.0, minor_radius: 2.0 },
            mesh(vec![], vec![]),
            mesh(vec![DVec3::ZERO; 3], vec![[0, 1, 2]]),
            mesh(vec![DVec3::X, DVec3::Y, DVec3::NAN], vec![[0, 1, 2]]),
            mesh(vec![DVec3::X, DVec3::Y, DVec3::Z], vec![[0, 1, 3]]),
        ] {
            assert!(Triangles::new(&shape).corners.is_empty(), "{shape:?}");
        }
        let far = DVec3::splat(1e6);
        let shape = mesh(vec![far + DVec3::X, far + DVec3::Y, far + DVec3::Z], vec![[0, 1, 2]]);
        let triangles = Triangles::new(&shape);
        assert_eq!(triangles.corners.len(), 3, "one triangle");
        assert_eq!(triangles.corners[0].position, [0.5, -0.5, -0.5], "from where the mesh is: no digit lost");
    }
}
