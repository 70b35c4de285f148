//! A scene at one moment, ready to be drawn.

use crate::HostError;
use crate::describe::{Described, describe_with};
use crate::meshes::Meshes;
use crate::objection::objection_to;
use antumbra::Component;
use antumbra::glam::{DMat4, DVec3, DVec4, Vec3};
use antumbra::math::Plane;
use antumbra::{Camera, Soft, Technique};
use antumbra_scene::{Moment, Scene};
use std::f32::consts::PI;

/// A scene at one moment, ready to be drawn any number of times; [`Stage::setting`](crate::Stage::setting) makes it.
pub struct Setting {
    /// The lights and occluders in antumbra's terms.
    pub described: Described,
    /// Where the technique `composite` has the components of lights with an area, if not on their rims; none to begin
    /// with. See [`Frame::components`](antumbra::Frame::components).
    pub components: Vec<Component>,
    pub(crate) moment: Moment,
    /// Of the objects, in the scene's order.
    names: Vec<String>,
    pub(crate) camera: Camera,
    pub(crate) background: Vec3,
    pub(crate) ambient: Vec3,
    pub(crate) near: f64,
    pub(crate) bounds: Vec<Plane>,
}

impl Setting {
    /// As [`Stage::setting`](crate::Stage::setting), with the meshes that `meshes` has.
    pub(crate) fn new(scene: &Scene, time: f64, aspect: f64, meshes: &mut Meshes) -> Result<Self, HostError> {
        if !(aspect > 0.0 && aspect.is_finite()) {
            return Err(HostError::BadRequest(format!("a picture {aspect} times as wide as it is high")));
        }
        let moment = scene.moment(time);
        let described = describe_with(scene, &moment, meshes)?;
        let near = near_distance(scene, &moment);
        let y = (scene.camera.fov_y * 0.5).tan().recip();
        // Infinite and reversed: depth is near / distance, of which float32 keeps the same relative
        // precision from the nearest thing to the farthest.
        let projection = DMat4::from_cols(
            DVec4::X * (y / aspect),
            DVec4::Y * y,
            DVec4::new(0.0, 0.0, 0.0, -1.0),
            DVec4::Z * near,
        );
        Ok(Self {
            described,
            components: Vec::new(),
            names: scene.objects.iter().map(|object| object.name.clone()).collect(),
            camera: Camera::new(scene.camera.view(), projection),
            background: scene.image.background.as_vec3(),
            ambient: scene.ambient.as_vec3() * PI,
            near,
            bounds: bounds(&moment, scene.camera.eye),
            moment,
        })
    }

    /// The camera that the scene is seen with. Its projection is infinite and reversed: depth, from 0 to 1, is
    /// [`Self::near`] divided by the distance along the line of sight's axis.
    pub fn camera(&self) -> Camera {
        self.camera
    }

    /// How far before the eye the picture begins, metres: nearer than anything in the scene, unless the eye is on it.
    pub fn near(&self) -> f64 {
        self.near
    }

    /// Everything where it is at this time.
    pub fn moment(&self) -> &Moment {
        &self.moment
    }

    /// What a technique cannot do of the scene: names the object, and what can. `None` if it can do it.
    pub fn objection(&self, technique: &Technique, soft: Soft) -> Option<HostError> {
        let name = |object: usize| self.names.get(object).map(String::as_str);
        objection_to(&self.described, &self.moment, &name, technique, soft)
    }
}

/// Half-spaces that hold everything seen: the eye's side of every infinite plane, or the sides of a
/// box round everything.
fn bounds(moment: &Moment, eye: DVec3) -> Vec<Plane> {
    let mut planes = Vec::new();
    let mut whole: Option<(DVec3, DVec3)> = None;
    for primitive in &moment.primitives {
        match primitive.bounds() {
            Some((low, high)) => whole = Some(whole.map_or((low, high), |(a, b)| (a.min(low), b.max(high)))),
            None => {
                let plane = Plane::through(primitive.pose.translation, primitive.pose.direction(DVec3::Y));
                // With the eye in the plane both sides are seen.
                planes.extend(plane.towards(eye));
            }
        }
    }
    if let (Some((low, high)), true) = (whole, planes.is_empty()) {
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            planes.extend([Plane::through(low, axis), Plane::through(high, -axis)]);
        }
    }
    planes
}

/// Half the distance to the nearest thing, so that it is not cut off; where the eye is on it or may
/// be, the smallest distance that float32 tells from zero at the eye.
fn near_distance(scene: &Scene, moment: &Moment) -> f64 {
    let eye = scene.camera.eye;
    let nearest = moment
        .primitives
        .iter()
        .map(|p| match p.bounds() {
            Some((low, high)) => eye.distance(eye.clamp(low, high)),
            None => p.pose.direction(DVec3::Y).dot(eye - p.pose.translation).abs(),
        })
        .fold(1.0, f64::min);
    (0.5 * nearest).max(1e-7 * eye.length().max(1e-3))
}
