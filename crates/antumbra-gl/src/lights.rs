//! What arrives from a light without occluders, and the lights in the shaders' numbers.

use crate::pairs::BATCH_LIGHTS;
use crate::scenery::Light;
use crate::view::View;
use antumbra_math::Light as Place;
use glam::{Vec3, Vec4};

/// One light as `lights.glsl` reads it, view space.
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct ShaderLight {
    /// Position and 1, or the direction towards the light and 0.
    pub place: Vec4,
    /// Colour times intensity; w unused.
    pub color: Vec4,
    /// Axis of a spot's cone, and the scale of its angular attenuation.
    pub cone: Vec4,
    /// Constant, linear and quadratic attenuation, and the offset of the angular attenuation.
    pub attenuation: Vec4,
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
        Self {
            place: place.homogeneous().as_vec4(),
            color: light.intensity.extend(0.0),
            cone,
            attenuation: Vec4::new(constant, linear, quadratic, offset),
        }
    }

    /// Irradiance at `position` on a surface with unit normal `normal`, without occluders, linear
    /// RGB; 0 where the surface faces away. The twin of `irradiance` in `lights.glsl`.
    pub fn irradiance(&self, position: Vec3, normal: Vec3) -> Vec3 {
        let to_light = self.place.truncate() - position * self.place.w;
        let square = to_light.dot(to_light).max(1e-30);
        let distance = square.sqrt();
        let direction = to_light / distance;
        let cosine = normal.dot(direction).max(0.0);
        let angular =
            ((-direction).dot(self.cone.truncate()) * self.cone.w + self.attenuation.w).clamp(0.0, 1.0);
        let falloff = if self.place.w > 0.5 {
            1.0 / (self.attenuation.x + self.attenuation.y * distance + self.attenuation.z * square)
        } else {
            1.0
        };
        self.color.truncate() * (cosine * angular * angular * falloff)
    }
}

/// A batch's lights, kept from one to the next.
#[derive(Default)]
pub(crate) struct LightData {
    lights: [ShaderLight; BATCH_LIGHTS],
}

impl LightData {
    /// The lights in view space, as the shaders' array of four vectors a light.
    pub(crate) fn pack(&mut self, lights: &[Light], view: &View) -> &[Vec4] {
        for (slot, light) in self.lights.iter_mut().zip(lights) {
            *slot = ShaderLight::new(light, &view.view);
        }
        bytemuck::cast_slice(&self.lights)
    }
}
