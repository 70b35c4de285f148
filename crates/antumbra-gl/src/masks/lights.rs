//! What arrives from a light without occluders, and the lights in the shaders' numbers.

use super::BATCH_LIGHTS;
use crate::input::{Area, Light};
use crate::screen::View;
use antumbra_math::Light as Place;
use antumbra_math::soft::{Nodes, Patch, Strips, cap_irradiance};
use glam::{Vec3, Vec4};

/// One light as `lights.glsl` reads it, view space.
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct ShaderLight {
    /// Position and 1, or the direction towards the light and 0.
    pub place: Vec4,
    /// Colour times intensity; the radius of a glowing ball or disc, 0 for other lights.
    pub color: Vec4,
    /// Axis of a spot's cone, and the scale of its angular attenuation; of a flat light where it shines, and 0.
    pub cone: Vec4,
    /// Constant, linear and quadratic attenuation, and the offset of the angular attenuation.
    pub attenuation: Vec4,
    /// A rectangle's half sides; w of the first is 1 for a disc, 2 for a rectangle, 0 for any other light.
    pub right: Vec4,
    /// See `right`.
    pub up: Vec4,
}

/// Narrowest transition of a spot, in cosines: glTF's KHR_lights_punctual suggests this limit.
const NARROWEST: f64 = 0.001;

impl ShaderLight {
    /// The light in the space that `transform` (rigid) leads to.
    pub fn new(light: &Light, transform: &glam::DMat4) -> Self {
        let place = light.place.transformed(transform);
        let (cone, offset) = match place {
            Place::Spot { direction, outer_angle, .. } => {
                let (inner, outer) = (f64::from(light.inner_angle).cos(), outer_angle.cos());
                let scale = 1.0 / (inner - outer).max(NARROWEST);
                (direction.as_vec3().extend(scale as f32), (-outer * scale) as f32)
            }
            _ => (Vec4::ZERO, 1.0),
        };
        let [constant, linear, quadratic] = light.attenuation;
        let turned = |v| transform.transform_vector3(v).as_vec3();
        let (cone, radius, right, up) = match light.area {
            Area::None => (cone, 0.0, Vec4::ZERO, Vec4::ZERO),
            Area::Sphere { radius } => (cone, radius, Vec4::ZERO, Vec4::ZERO),
            Area::Disc { direction, radius } => (turned(direction).extend(0.0), radius, Vec4::W, Vec4::ZERO),
            Area::Rectangle { direction, half_right, half_up } => {
                let right = turned(half_right).extend(2.0);
                (turned(direction).extend(0.0), 0.0, right, turned(half_up).extend(0.0))
            }
        };
        Self {
            place: place.homogeneous().as_vec4(),
            color: light.intensity.extend(radius as f32),
            cone,
            attenuation: Vec4::new(constant, linear, quadratic, offset),
            right,
            up,
        }
    }

    /// Irradiance at `position` on a surface with unit normal `normal`, without occluders, linear
    /// RGB; 0 where the surface faces away. The twin of `irradiance` in `lights.glsl`.
    ///
    /// Of a light with an area exact, with the part of it below the surface's horizon cut off; attenuation other than
    /// the physical one acts on it as on a point at its centre.
    pub fn irradiance(&self, position: Vec3, normal: Vec3) -> Vec3 {
        let to_light = self.place.truncate() - position * self.place.w;
        let square = to_light.dot(to_light).max(1e-30);
        let distance = square.sqrt();
        let direction = to_light / distance;
        let angular =
            ((-direction).dot(self.cone.truncate()) * self.cone.w + self.attenuation.w).clamp(0.0, 1.0);
        let falloff = if self.place.w > 0.5 {
            1.0 / (self.attenuation.x + self.attenuation.y * distance + self.attenuation.z * square)
        } else {
            1.0
        };
        let cosine = self.cosine(position, normal, to_light, square);
        self.color.truncate() * (cosine * angular * angular * falloff)
    }

    /// The cosine at the receiver, averaged over the light as its irradiance is.
    fn cosine(&self, position: Vec3, normal: Vec3, to_light: Vec3, square: f32) -> f32 {
        let cosine = normal.dot(to_light) / square.sqrt();
        let radius = self.color.w;
        if self.right.w < 0.5 {
            let sine = radius / square.sqrt();
            return if radius > 0.0 && sine < 1.0 {
                cap_irradiance(sine, cosine) / (sine * sine)
            } else {
                cosine.max(0.0)
            };
        }
        let (center, direction) = (position + to_light, self.cone.truncate());
        let half = [self.right.truncate(), self.up.truncate()];
        let patch = if self.right.w < 1.5 {
            Patch::of_disc(center, direction, radius, position, normal)
        } else {
            Patch::of_rectangle(center, direction, half, position)
        };
        let Some(patch) = patch else { return 0.0 };
        let strips = Strips::new(&patch, normal);
        let whole = strips.whole(&Nodes::new(8)) * -direction.dot(patch.origin);
        let area = if self.right.w < 1.5 { std::f32::consts::PI } else { 4.0 };
        whole / area
    }
}

/// A batch's lights in view space, as the shaders' array of six vectors a light; those that are not there are zero.
pub(super) fn packed(lights: &[Light], view: &View) -> [ShaderLight; BATCH_LIGHTS] {
    let mut packed = [ShaderLight::default(); BATCH_LIGHTS];
    packed.iter_mut().zip(lights).for_each(|(slot, light)| *slot = ShaderLight::new(light, &view.view));
    packed
}
