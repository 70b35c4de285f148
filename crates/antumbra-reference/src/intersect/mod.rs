//! Ray against each shape of the scene format, in float64, one file a shape.
//!
//! Solids (sphere, ellipsoid, cone, cylinder, capsule, box, torus) have an inside: a ray that starts in one is
//! blocked at once. Flat shapes and meshes are surfaces without an inside. Touching is neither a hit nor a block.
//! None of this shares code with the closed forms that it judges.

mod capsule;
mod cuboid;
mod disc;
mod ellipsoid;
mod frustum;
mod mesh;
mod plane;
mod rectangle;
mod sphere;
mod torus;
mod triangle;

use std::{collections::HashMap, sync::Arc};

use antumbra_scene::{Mesh, Pose, Primitive, Shape};
use glam::DVec3;

pub(crate) use self::sphere::Sphere;
use crate::ray::{Convex, Hit, Ray};

/// A primitive of a scene, made ready for rays.
#[derive(Clone, Debug)]
pub struct Body {
    /// From the shape to the world.
    pose: Pose,
    form: Form,
}

#[derive(Clone, Debug)]
enum Form {
    Plane,
    Rectangle(rectangle::Rectangle),
    Disc(disc::Disc),
    Triangle([DVec3; 3]),
    Sphere(Sphere),
    Ellipsoid(ellipsoid::Ellipsoid),
    Frustum(frustum::Frustum),
    Capsule(capsule::Capsule),
    Cuboid(cuboid::Cuboid),
    Torus(torus::Torus),
    Mesh(Arc<mesh::Triangles>),
}

/// Meshes made ready so far, so that two primitives with one mesh share it.
#[derive(Debug, Default)]
pub(crate) struct Meshes(HashMap<*const Mesh, Arc<mesh::Triangles>>);

impl Body {
    /// Makes one primitive ready. The hierarchy of a mesh is built here.
    pub fn new(primitive: &Primitive) -> Self {
        Self::shared(primitive, &mut Meshes::default())
    }

    /// As `new`, sharing what `meshes` has already.
    pub(crate) fn shared(primitive: &Primitive, meshes: &mut Meshes) -> Self {
        let form = match &primitive.shape {
            Shape::Plane => Form::Plane,
            Shape::Rectangle { width, depth } => {
                Form::Rectangle(rectangle::Rectangle { half_x: 0.5 * width, half_z: 0.5 * depth })
            }
            Shape::Disc { radius } => Form::Disc(disc::Disc { radius: *radius }),
            Shape::Triangle { vertices } => Form::Triangle(*vertices),
            Shape::Sphere { radius } => Form::Sphere(Sphere { radius: *radius }),
            Shape::Ellipsoid { radii } => Form::Ellipsoid(ellipsoid::Ellipsoid { radii: *radii }),
            Shape::Cone { radius, height } => {
                Form::Frustum(frustum::Frustum { bottom: *radius, top: 0.0, half_height: 0.5 * height })
            }
            Shape::Cylinder { radius, height, radius_top } => Form::Frustum(frustum::Frustum {
                bottom: *radius,
                top: *radius_top,
                half_height: 0.5 * height,
            }),
            Shape::Capsule { radius, height } => {
                Form::Capsule(capsule::Capsule { radius: *radius, half_height: 0.5 * height })
            }
            Shape::Box { size } => Form::Cuboid(cuboid::Cuboid { half: 0.5 * *size }),
            Shape::Torus { major_radius, minor_radius } => {
                Form::Torus(torus::Torus { major: *major_radius, minor: *minor_radius })
            }
            Shape::Mesh(mesh) => Form::Mesh(
                meshes
                    .0
                    .entry(Arc::as_ptr(mesh))
                    .or_insert_with(|| Arc::new(mesh::Triangles::new(mesh)))
                    .clone(),
            ),
        };
        Self { pose: primitive.pose, form }
    }

    /// Whether the shape can never shadow itself: everything but torus and mesh. A flat shape does not either.
    pub fn is_convex(&self) -> bool {
        !matches!(self.form, Form::Torus(_) | Form::Mesh(_))
    }

    /// The first crossing of the surface in the ray's interval, from outside or inside; normal in the world.
    ///
    /// `None` for a ray that is not finite or has no direction.
    pub fn nearest(&self, ray: &Ray) -> Option<Hit> {
        let ray = self.local(ray)?;
        let hit = match &self.form {
            Form::Plane => plane::nearest(&ray),
            Form::Rectangle(shape) => shape.nearest(&ray),
            Form::Disc(shape) => shape.nearest(&ray),
            Form::Triangle(vertices) => triangle::Sheared::new(&ray).nearest(*vertices),
            Form::Sphere(shape) => shape.nearest(&ray),
            Form::Ellipsoid(shape) => shape.nearest(&ray),
            Form::Frustum(shape) => shape.nearest(&ray),
            Form::Capsule(shape) => shape.nearest(&ray),
            Form::Cuboid(shape) => shape.nearest(&ray),
            Form::Torus(shape) => shape.nearest(&ray),
            Form::Mesh(shape) => shape.nearest(&ray),
        }?;
        Some(Hit { normal: self.pose.direction(hit.normal), ..hit })
    }

    /// Whether anything of the ray's interval lies on the surface or inside the solid.
    ///
    /// False for a ray that is not finite or has no direction.
    pub fn blocks(&self, ray: &Ray) -> bool {
        let Some(ray) = self.local(ray) else { return false };
        match &self.form {
            Form::Plane => plane::nearest(&ray).is_some(),
            Form::Rectangle(shape) => shape.nearest(&ray).is_some(),
            Form::Disc(shape) => shape.nearest(&ray).is_some(),
            Form::Triangle(vertices) => triangle::Sheared::new(&ray).nearest(*vertices).is_some(),
            Form::Sphere(shape) => shape.blocks(&ray),
            Form::Ellipsoid(shape) => shape.blocks(&ray),
            Form::Frustum(shape) => shape.blocks(&ray),
            Form::Capsule(shape) => shape.blocks(&ray),
            Form::Cuboid(shape) => shape.blocks(&ray),
            Form::Torus(shape) => shape.blocks(&ray),
            Form::Mesh(shape) => shape.blocks(&ray),
        }
    }

    /// The ray in the shape's space; poses are rigid, so its parameter stays what it is.
    fn local(&self, ray: &Ray) -> Option<Ray> {
        let inverse = self.pose.rotation.inverse();
        let origin = inverse * (ray.origin - self.pose.translation);
        let direction = inverse * ray.direction;
        let length = direction.length_squared();
        (origin.is_finite() && length > 0.0 && length.is_finite()).then_some(Ray {
            origin,
            direction,
            ..*ray
        })
    }
}
