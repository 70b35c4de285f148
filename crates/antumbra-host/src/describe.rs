//! A scene in antumbra's terms: what any host's author writes once.

use crate::HostError;
use antumbra::math::{Cone, Disc, Plane, Rectangle, Shape, Sphere, Triangle};
use antumbra::{Light, Occluder};
use antumbra_scene::{self as scene, LightKind, Moment, Scene};

/// The lights and occluders of one moment.
#[derive(Clone, Debug, Default)]
pub struct Described {
    /// In the scene's order.
    pub lights: Vec<Light>,
    /// Of the primitives that cast shadows; ids are the primitive's index plus one.
    pub occluders: Vec<Occluder>,
}

/// The hint for what only the reference draws.
const TRACE: &str = "draw it with the reference: antumbra trace, or --technique raytraced";

/// Describes lights and occluders to antumbra.
///
/// # Errors
/// [`HostError::Unsupported`] names the first light or object that hard analytic shadows cannot do.
pub fn describe(scene: &Scene, moment: &Moment) -> Result<Described, HostError> {
    let lights = moment.lights.iter().map(light).collect::<Result<_, _>>()?;
    let mut occluders = Vec::new();
    for (i, primitive) in moment.primitives.iter().enumerate() {
        let shape = shape(primitive).ok_or_else(|| HostError::Unsupported {
            object: format!("object \"{}\"", scene.objects[primitive.object].name),
            what: format!("the technique analytic cannot draw the shape {} yet", kind_of(&primitive.shape)),
            instead: TRACE.into(),
        })?;
        if primitive.casts_shadow {
            occluders.push(Occluder::new(shape).with_id(i as u32 + 1));
        }
    }
    Ok(Described { lights, occluders })
}

fn light(light: &scene::Light) -> Result<Light, HostError> {
    let intensity = (light.color * light.intensity).as_vec3();
    Ok(match light.kind {
        LightKind::Point => Light::point(light.position, intensity),
        LightKind::Directional { direction } => Light::directional(direction, intensity),
        LightKind::Spot { direction, inner_angle, outer_angle } => {
            Light::spot(light.position, direction, inner_angle as f32, outer_angle as f32, intensity)
        }
        LightKind::Sphere { .. } | LightKind::Disc { .. } | LightKind::Rectangle { .. } => {
            return Err(HostError::Unsupported {
                object: format!("light \"{}\"", light.name),
                what: "the technique analytic draws the hard shadows of point, spot and directional lights, and this one has an area".into(),
                instead: TRACE.into(),
            });
        }
    })
}

/// The primitive's exact shape in the world; `None` for shapes antumbra does not have.
pub(crate) fn shape(primitive: &scene::Primitive) -> Option<Shape> {
    let pose = &primitive.pose;
    let center = pose.translation;
    let axis = pose.direction(glam::DVec3::Y);
    Some(match primitive.shape {
        scene::Shape::Plane => Plane::through(center, axis).into(),
        scene::Shape::Rectangle { width, depth } => Rectangle {
            center,
            half_right: pose.direction(glam::DVec3::X) * (width * 0.5),
            half_forward: pose.direction(glam::DVec3::Z) * (depth * 0.5),
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

fn kind_of(shape: &scene::Shape) -> &'static str {
    match shape {
        scene::Shape::Plane => "plane",
        scene::Shape::Rectangle { .. } => "rectangle",
        scene::Shape::Disc { .. } => "disc",
        scene::Shape::Triangle { .. } => "triangle",
        scene::Shape::Sphere { .. } => "sphere",
        scene::Shape::Ellipsoid { .. } => "ellipsoid",
        scene::Shape::Cone { .. } => "cone",
        scene::Shape::Cylinder { .. } => "cylinder",
        scene::Shape::Capsule { .. } => "capsule",
        scene::Shape::Box { .. } => "box",
        scene::Shape::Torus { .. } => "torus",
        scene::Shape::Mesh(_) => "mesh",
    }
}
