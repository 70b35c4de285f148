//! Shapes of scenes as triangles.

use antumbra::math::{MeshError, TriangleMesh};
use antumbra_scene as scene;

/// Sides of a tessellated circle, as antumbra's techniques have them for the shapes they tessellate.
pub(crate) const SEGMENTS: u32 = 128;

/// The triangles of a shape that antumbra has no shape for, in its own space.
pub(crate) fn tessellated(shape: &scene::Shape) -> Result<TriangleMesh, MeshError> {
    match *shape {
        scene::Shape::Plane => Err(MeshError::NoTriangles),
        scene::Shape::Rectangle { width, depth } => TriangleMesh::rectangle(width, depth),
        scene::Shape::Disc { radius } => TriangleMesh::disc(radius, SEGMENTS),
        scene::Shape::Triangle { vertices } => TriangleMesh::triangle(vertices),
        scene::Shape::Sphere { radius } => TriangleMesh::sphere(radius, SEGMENTS),
        scene::Shape::Ellipsoid { radii } => TriangleMesh::ellipsoid(radii, SEGMENTS),
        scene::Shape::Cone { radius, height } => TriangleMesh::cone(radius, height, SEGMENTS),
        scene::Shape::Cylinder { radius, height, radius_top } => {
            TriangleMesh::cylinder(radius, height, radius_top, SEGMENTS)
        }
        scene::Shape::Capsule { radius, height } => TriangleMesh::capsule(radius, height, SEGMENTS),
        scene::Shape::Box { size } => TriangleMesh::cuboid(size),
        scene::Shape::Torus { major_radius, minor_radius } => {
            TriangleMesh::torus(major_radius, minor_radius, SEGMENTS)
        }
        scene::Shape::Mesh(ref mesh) => TriangleMesh::new(mesh.positions.clone(), mesh.triangles.clone()),
    }
}
