//! Scenes, and their shadows by ray tracing.

use crate::shot::Shot;
use crate::truth::Truth;
use antumbra_gl::{Camera, Light, MeshOccluder, Occluder, Receiver};
use antumbra_host::describe;
use antumbra_reference::{Ray, Surface, Tracer};
use antumbra_scene::{Moment, Scene};
use glam::{DMat4, DVec3, DVec4, Vec3, Vec4Swizzles};

/// One of everything that casts a shadow, over a floor and before a wall, under a point light, a
/// directional light and a spot light of different colours.
pub(crate) const ONE_OF_EACH: &str = r#"
ambient = [0.05, 0.05, 0.05]
[camera]
eye = [1.0, 3.5, 7.0]
target = [0.0, 0.6, 0.0]
[[light]]
name = "point"
type = "point"
position = [2.0, 5.0, 3.0]
color = [1.0, 0.3, 0.2]
intensity = 60.0
[[light]]
name = "sun"
type = "directional"
direction = [0.5, -1.0, -0.4]
color = [0.2, 1.0, 0.3]
intensity = 3.0
[[light]]
name = "spot"
type = "spot"
position = [-3.0, 6.0, 2.0]
direction = [0.5, -1.0, -0.3]
inner_angle = 15.0
outer_angle = 30.0
color = [0.2, 0.3, 1.0]
intensity = 120.0
[[object]]
name = "floor"
shape = { type = "plane" }
[[object]]
name = "wall"
shape = { type = "rectangle", width = 6.0, depth = 3.0 }
translation = [0.0, 1.0, -2.0]
rotation = [0.7071068, 0.0, 0.0, 0.7071068]
[[object]]
name = "ball"
shape = { type = "sphere", radius = 0.6 }
translation = [-1.0, 1.0, 0.3]
[[object]]
name = "cone"
shape = { type = "cone", radius = 0.6, height = 1.2 }
translation = [1.2, 0.7, 0.2]
rotation = [0.2, 0.1, 0.3, 0.9]
[[object]]
name = "disc"
shape = { type = "disc", radius = 0.5 }
translation = [0.2, 1.6, 0.0]
rotation = [0.3, 0.0, 0.2, 0.93]
[[object]]
name = "triangle"
shape = { type = "triangle", vertices = [[-0.5, 0.0, 0.0], [0.5, 0.1, 0.2], [0.0, 0.8, 0.1]] }
translation = [-0.2, 0.3, 1.4]
"#;

/// A scene in antumbra's terms, with its oracle.
pub(crate) struct World {
    pub(crate) lights: Vec<Light>,
    pub(crate) occluders: Vec<Occluder>,
    pub(crate) meshes: Vec<MeshOccluder>,
    pub(crate) receivers: Vec<Receiver>,
    pub(crate) ambient: Vec3,
    pub(crate) view: DMat4,
    /// Whether shadows fall on a primitive.
    pub(crate) receives: Vec<bool>,
    pub(crate) tracer: Tracer,
}

impl World {
    pub(crate) fn one_of_each() -> Self {
        Self::parse(ONE_OF_EACH)
    }

    pub(crate) fn parse(text: &str) -> Self {
        let scene = Scene::parse(text, "world.toml".as_ref()).expect("the test's scene is right");
        Self::of_moment(&scene, &scene.moment(0.0))
    }

    pub(crate) fn of_moment(scene: &Scene, moment: &Moment) -> Self {
        let described = describe(scene, moment).expect("shapes and lights antumbra has");
        Self {
            lights: described.lights,
            occluders: described.occluders,
            meshes: described.meshes,
            receivers: described.receivers,
            ambient: scene.ambient.as_vec3() * std::f32::consts::PI,
            view: scene.camera.view(),
            receives: moment.primitives.iter().map(|p| p.receives_shadow).collect(),
            tracer: Tracer::from_moment(scene, moment),
        }
    }

    /// The scene's eye, 45 degrees high, nothing too far.
    pub(crate) fn camera(&self, [_, _, width, height]: [i32; 4]) -> Camera {
        let y = 22.5f64.to_radians().tan().recip();
        let projection = DMat4::from_cols(
            DVec4::X * (y * f64::from(height) / f64::from(width)),
            DVec4::Y * y,
            DVec4::new(0.0, 0.0, -1.0, -1.0),
            DVec4::Z * -0.5,
        );
        Camera::new(self.view, projection)
    }

    /// What is seen through each pixel's centre, rows from bottom to top.
    pub(crate) fn see(&self, camera: &Camera, [_, _, width, height]: [i32; 4]) -> Vec<Option<Surface>> {
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        pixels
            .map(|(x, y)| {
                let [x, y] = [f64::from(x) + 0.5, f64::from(y) + 0.5];
                self.tracer.surface(&ray(camera, [x / f64::from(width), y / f64::from(height)]))
            })
            .collect()
    }

    /// Whether a light reaches a point, 1 or 0; also 0 where the surface faces away from it.
    pub(crate) fn visibility(&self, light: usize, surface: &Surface) -> f32 {
        self.tracer.visibility_at(light, surface, 1, 0) as f32
    }

    /// Whether anything but the object that is seen hides a light from a point.
    pub(crate) fn others_hide(&self, light: usize, surface: &Surface) -> bool {
        let place = &self.lights[light].place;
        let way = place.vector_from(surface.point);
        let mut at = surface.point;
        // From hit to hit, through the object itself.
        for _ in 0..8 {
            let rest = place.vector_from(at);
            let ends = if place.homogeneous().w > 0.0 { rest.dot(way) / way.length() } else { f64::INFINITY };
            match self.hit(at + way.normalize() * 1e-6, way) {
                Some(hit) if (hit.point - at).length() < ends - 1e-6 => {
                    if hit.primitive != surface.primitive {
                        return true;
                    }
                    at = hit.point;
                }
                _ => return false,
            }
        }
        false
    }

    /// What a ray meets first.
    pub(crate) fn hit(&self, origin: DVec3, direction: DVec3) -> Option<Surface> {
        self.tracer.surface(&Ray::new(origin, direction.normalize()))
    }

    /// The truth for all lights.
    pub(crate) fn truth(&self, shot: &Shot<'_>) -> Truth<'_> {
        Truth::new(self, shot)
    }
}

/// The eye's ray through a point of the picture (0 to 1 each way), for any projection.
pub(crate) fn ray(camera: &Camera, at: [f64; 2]) -> Ray {
    let [x, y] = at.map(|c| c * 2.0 - 1.0);
    let to_world = camera.view.inverse();
    let inverse = camera.projection.inverse();
    let middle = inverse * DVec4::new(x, y, 0.5, 1.0);
    let middle = middle.xyz() / middle.w;
    let perspective = camera.projection.row(3) != DVec4::W;
    let (origin, direction) = if perspective {
        (DVec3::ZERO, middle * -middle.z.signum())
    } else {
        (middle * DVec3::new(1.0, 1.0, 0.0), DVec3::NEG_Z)
    };
    let direction = to_world.transform_vector3(direction).normalize();
    Ray::new(to_world.transform_point3(origin), direction)
}
