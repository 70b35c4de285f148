//! The scene made ready for rays: what a ray meets first, and whether light gets through.

use std::f64::consts::FRAC_1_PI;

use antumbra_scene::{Camera, Light, Moment, Scene};
use glam::{DVec2, DVec3};

use crate::{
    bvh::Bvh,
    intersect::{Body, Meshes},
    light::{self, Incoming},
    ray::{Hit, Ray},
    sampling::Pattern,
};

/// The float64 ray tracer of one moment of a scene.
#[derive(Clone, Debug)]
pub struct Tracer {
    pub(crate) camera: Camera,
    pub(crate) background: DVec3,
    ambient: DVec3,
    lights: Vec<Light>,
    bodies: Vec<Body>,
    looks: Vec<Look>,
    /// Over the bodies of `bounded`, by their position there.
    bvh: Bvh,
    bounded: Vec<u32>,
    /// Bodies without a box: every ray tests them.
    unbounded: Vec<u32>,
}

/// What a primitive is, beyond its shape.
#[derive(Clone, Copy, Debug)]
struct Look {
    albedo: DVec3,
    casts_shadow: bool,
    receives_shadow: bool,
}

/// A visible point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// World space, metres.
    pub point: DVec3,
    /// Unit geometric normal, turned towards the viewer: surfaces are two-sided.
    pub normal: DVec3,
    /// Index in [`Moment::primitives`].
    pub primitive: u32,
    /// Metres within which `point` is known, and by which shadow rays start off the surface and stop short of the
    /// light.
    pub slack: f64,
}

/// Slack of a surface point, as a share of the larger of its distance from the eye's and from the coordinates'
/// origin. Points are computed to about 1e-15 of those; a hundred thousand times that keeps torus and mesh
/// from shadowing the very point that is lit, and coincident surfaces from blotching each other, and is a
/// tenth of a nanometre a metre: no picture shows it.
const SLACK: f64 = 1e-10;

impl Tracer {
    /// Makes a scene ready at a time in seconds.
    pub fn new(scene: &Scene, time: f64) -> Self {
        Self::from_moment(scene, &scene.moment(time))
    }

    /// Makes ready a moment in place of the scene's own; camera, ambient and background are the scene's.
    pub fn from_moment(scene: &Scene, moment: &Moment) -> Self {
        let mut meshes = Meshes::default();
        let bodies = moment.primitives.iter().map(|p| Body::shared(p, &mut meshes)).collect();
        let looks = moment
            .primitives
            .iter()
            .map(|p| Look {
                albedo: p.color,
                casts_shadow: p.casts_shadow,
                receives_shadow: p.receives_shadow,
            })
            .collect();
        let (mut bounded, mut unbounded, mut boxes) = (Vec::new(), Vec::new(), Vec::new());
        for (index, primitive) in (0..).zip(&moment.primitives) {
            match primitive.bounds() {
                Some((min, max)) if min.is_finite() && max.is_finite() => {
                    bounded.push(index);
                    boxes.push((min, max));
                }
                // Not finite: no ray meets it.
                Some(_) => {}
                None => unbounded.push(index),
            }
        }
        Self {
            camera: scene.camera,
            background: scene.image.background,
            ambient: scene.ambient,
            lights: moment.lights.clone(),
            bodies,
            looks,
            bvh: Bvh::new(&boxes),
            bounded,
            unbounded,
        }
    }

    /// The lights, where they are at this moment.
    pub fn lights(&self) -> &[Light] {
        &self.lights
    }

    /// Looks at the same moment from elsewhere: what is ready for rays stays ready.
    pub fn set_camera(&mut self, camera: Camera) {
        self.camera = camera;
    }

    /// The first surface that a ray meets, if any. Where several coincide, which of them is not defined, but it is
    /// the same at every call.
    pub fn surface(&self, ray: &Ray) -> Option<Surface> {
        let mut found: Option<(u32, Hit)> = None;
        let mut test = |index: u32, ray: &mut Ray| {
            if let Some(hit) = self.bodies[index as usize].nearest(ray) {
                ray.max = hit.t;
                found = Some((index, hit));
            }
        };
        let mut ray = *ray;
        for &index in &self.unbounded {
            test(index, &mut ray);
        }
        self.bvh.traverse(&ray, |item, ray| {
            test(self.bounded[item as usize], ray);
            true
        });
        let (primitive, hit) = found?;
        let point = ray.at(hit.t);
        let normal = if hit.normal.dot(ray.direction) > 0.0 { -hit.normal } else { hit.normal };
        let scale = point.abs().max_element().max(ray.origin.abs().max_element());
        Some(Surface { point, normal, primitive, slack: scale * SLACK })
    }

    /// Whether something opaque is between a surface point and a sample of a light.
    fn blocked(&self, surface: &Surface, incoming: &Incoming) -> bool {
        // Off the surface, towards the viewer: light that arrives comes from that side.
        let origin = surface.point + surface.normal * surface.slack;
        let ray = if incoming.reach.is_finite() {
            let length = incoming.direction.length();
            let target = surface.point + incoming.direction * incoming.reach;
            // A light on an occluder's own surface is not behind that surface.
            let short = (incoming.reach - surface.slack / length).max(0.0) / incoming.reach;
            if incoming.reach > 0.0 {
                Ray { max: short, ..Ray::segment(origin, target) }
            } else {
                Ray { max: 0.0, ..Ray::new(origin, incoming.direction) }
            }
        } else {
            Ray::new(origin, incoming.direction)
        };
        let blocks = |index: u32| {
            let body = &self.bodies[index as usize];
            let own = index == surface.primitive && body.is_convex();
            self.looks[index as usize].casts_shadow && !own && body.blocks(&ray)
        };
        if self.unbounded.iter().any(|&index| blocks(index)) {
            return true;
        }
        let mut blocked = false;
        self.bvh.traverse(&ray, |item, _| {
            blocked = blocks(self.bounded[item as usize]);
            !blocked
        });
        blocked
    }

    /// Whether a surface point gets a sample of a light.
    fn lit(&self, surface: &Surface, incoming: &Incoming) -> bool {
        !self.looks[surface.primitive as usize].receives_shadow || !self.blocked(surface, incoming)
    }

    /// The fraction of a light's irradiance that arrives at a surface point: 0 or 1 for hard lights; for area
    /// lights the irradiance-weighted mean over `samples` points of the light (0 counts as 1), chosen by `seed`.
    ///
    /// 0 where nothing would arrive anyway: the surface faces away from the light, or the light from it.
    ///
    /// # Panics
    /// If there is no such light.
    pub fn visibility_at(&self, light: usize, surface: &Surface, samples: u32, seed: u32) -> f64 {
        let light = &self.lights[light];
        let samples = if light::is_hard(light) { 1 } else { samples.max(1) };
        let pattern = Pattern::new(seed);
        let (mut arrives, mut total) = (0.0, 0.0);
        for index in 0..samples {
            if let Some(incoming) =
                light::incoming(light, surface.point, surface.normal, pattern.point(index))
            {
                total += incoming.weight;
                if self.lit(surface, &incoming) {
                    arrives += incoming.weight;
                }
            }
        }
        if total > 0.0 { arrives / total } else { 0.0 }
    }

    /// The irradiance a light of the scene would give a surface point if nothing were in the way, before its
    /// colour: lux. An unbiased estimate from `samples` points of an area light; exact for hard lights.
    ///
    /// # Panics
    /// If there is no such light.
    pub fn unoccluded_irradiance(&self, light: usize, surface: &Surface, samples: u32, seed: u32) -> f64 {
        let light = &self.lights[light];
        let samples = if light::is_hard(light) { 1 } else { samples.max(1) };
        let pattern = Pattern::new(seed);
        let sum: f64 = (0..samples)
            .filter_map(|i| light::incoming(light, surface.point, surface.normal, pattern.point(i)))
            .map(|incoming| incoming.irradiance)
            .sum();
        sum / f64::from(samples)
    }

    /// Radiance that leaves a surface point for the viewer, one sample of each light; `u` gives light `i`'s.
    pub(crate) fn radiance(&self, surface: &Surface, u: impl Fn(u32) -> DVec2) -> DVec3 {
        let mut irradiance = DVec3::ZERO;
        for (index, light) in (0..).zip(&self.lights) {
            if let Some(incoming) = light::incoming(light, surface.point, surface.normal, u(index))
                && incoming.irradiance > 0.0
                && self.lit(surface, &incoming)
            {
                irradiance += light.color * incoming.irradiance;
            }
        }
        self.looks[surface.primitive as usize].albedo * (irradiance * FRAC_1_PI + self.ambient)
    }
}
