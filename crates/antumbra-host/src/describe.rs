//! A scene in antumbra's terms: what any host's author writes once.

use crate::HostError;
use crate::meshes::Meshes;
use antumbra::glam::{DMat4, DVec3};
use antumbra::math::{Cone, Disc, Plane, Rectangle, Shape, Sphere, Triangle};
use antumbra::{Area, Light, MeshOccluder, Occluder, Receiver, ReceiverShape, Scenery};
use antumbra_scene::{self as scene, LightKind, Moment, Scene};

/// The lights, occluders and receivers of one moment. Ids are the primitive's index plus one.
#[derive(Clone, Debug, Default)]
pub struct Described {
    /// In the scene's order.
    pub lights: Vec<Light>,
    /// Of the primitives that cast shadows and have a shape that antumbra knows.
    pub occluders: Vec<Occluder>,
    /// Of the other primitives that cast shadows: meshes, and shapes tessellated.
    pub meshes: Vec<MeshOccluder>,
    /// The planes and rectangles that receive shadows.
    pub receivers: Vec<Receiver>,
}

impl Described {
    /// What techniques are asked to do.
    pub fn scenery(&self) -> Scenery<'_> {
        Scenery::default()
            .lights(&self.lights)
            .occluders(&self.occluders)
            .meshes(&self.meshes)
            .receivers(&self.receivers)
    }
}

/// Describes a scene to antumbra, with meshes of its own; [`Stage::setting`](crate::Stage::setting) makes each once
/// for many moments.
///
/// # Errors
/// [`HostError::BadRequest`] for a mesh that is none; those of scene files are.
pub fn describe(scene: &Scene, moment: &Moment) -> Result<Described, HostError> {
    describe_with(scene, moment, &mut Meshes::default())
}

/// As [`describe`], with the meshes that `meshes` has.
pub(crate) fn describe_with(
    scene: &Scene,
    moment: &Moment,
    meshes: &mut Meshes,
) -> Result<Described, HostError> {
    let mut described =
        Described { lights: moment.lights.iter().map(light).collect(), ..Described::default() };
    for (i, primitive) in moment.primitives.iter().enumerate() {
        let id = i as u32 + 1;
        let shape = shape(primitive);
        if primitive.receives_shadow {
            let flat = match shape {
                Some(Shape::Plane(plane)) => Some(ReceiverShape::Plane(plane)),
                Some(Shape::Rectangle(rectangle)) => Some(ReceiverShape::Rectangle(rectangle)),
                _ => None,
            };
            described.receivers.extend(flat.map(|shape| Receiver::new(shape).with_id(id)));
        }
        if !primitive.casts_shadow {
            continue;
        }
        if let Some(shape) = shape {
            described.occluders.push(Occluder::new(shape).with_id(id));
            continue;
        }
        let mesh = meshes.get(&primitive.shape).map_err(|error| {
            let name = scene.objects.get(primitive.object).map_or("", |object| &object.name);
            HostError::BadRequest(format!("object \"{name}\": {error}"))
        })?;
        let pose = &primitive.pose;
        let model = DMat4::from_rotation_translation(pose.rotation, pose.translation);
        described.meshes.push(MeshOccluder::new(mesh, model).with_id(id));
    }
    Ok(described)
}

/// A light of a scene in antumbra's terms.
pub fn light(light: &scene::Light) -> Light {
    let intensity = (light.color * light.intensity).as_vec3();
    let at = |area| Light::point(light.position, intensity).with_area(area);
    match light.kind {
        LightKind::Point => Light::point(light.position, intensity),
        LightKind::Directional { direction } => Light::directional(direction, intensity),
        LightKind::Spot { direction, inner_angle, outer_angle } => {
            Light::spot(light.position, direction, inner_angle as f32, outer_angle as f32, intensity)
        }
        LightKind::Sphere { radius } => at(Area::Sphere { radius }),
        LightKind::Disc { direction, radius } => at(Area::Disc { direction, radius }),
        LightKind::Rectangle { direction, right, width, height } => {
            let up = direction.cross(right);
            let (half_right, half_up) = (right * (width * 0.5), up * (height * 0.5));
            at(Area::Rectangle { direction, half_right, half_up })
        }
    }
}

/// The primitive's exact shape in the world; `None` for shapes antumbra does not have.
pub(crate) fn shape(primitive: &scene::Primitive) -> Option<Shape> {
    let pose = &primitive.pose;
    let center = pose.translation;
    let axis = pose.direction(DVec3::Y);
    Some(match primitive.shape {
        scene::Shape::Plane => Plane::through(center, axis).into(),
        scene::Shape::Rectangle { width, depth } => Rectangle {
            center,
            half_right: pose.direction(DVec3::X) * (width * 0.5),
            half_forward: pose.direction(DVec3::Z) * (depth * 0.5),
        }
        .into(),
        scene::Shape::Disc { radius } => Disc { center, normal: axis, radius }.into(),
        scene::Shape::Triangle { vertices } => Triangle { vertices: vertices.map(|v| pose.point(v)) }.into(),
        scene::Shape::Sphere { radius } => Sphere { center, radius }.into(),
        scene::Shape::Cone { radius, height } => {
            Cone { base_center: center - axis * (height * 0.5), axis, radius, height }.into()
        }
        _ => return None,
    })
}
