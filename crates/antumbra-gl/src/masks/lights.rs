//! What arrives from a light without occluders, and the lights in the shaders' numbers.

use super::BATCH_LIGHTS;
use crate::input::{Area, Light, Matrix};
use crate::screen::View;
use antumbra_math::Light as Place;
use antumbra_math::soft::{Nodes, Patch, Strips, cap_irradiance};
use glam::{Vec3, Vec4};

/// One light as `AntumbraLight` of [`crate::IRRADIANCE_GLSL`] has it: seven vectors, one after the other.
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
    /// The least divisor, the exponent of a further term or 0, 1 / range or 0, and 1 if the window at the range is squared.
    pub reach: Vec4,
    /// A rectangle's half sides; w of the first is 1 for a disc, 2 for a rectangle, 0 for any other light.
    pub right: Vec4,
    /// See `right`.
    pub up: Vec4,
}

/// Narrowest transition of a spot, in cosines: glTF's KHR_lights_punctual suggests this limit.
const NARROWEST: f64 = 0.001;

impl ShaderLight {
    /// The light in the space that `transform` (rigid) leads to.
    pub fn new(light: &Light, transform: impl Into<Matrix>) -> Self {
        let transform = transform.into().glam();
        let place = light.place.transformed(&transform);
        let (cone, offset) = match place {
            Place::Spot { direction, outer_angle, .. } => {
                let (inner, outer) = (f64::from(light.inner_angle).cos(), outer_angle.cos());
                let scale = 1.0 / (inner - outer).max(NARROWEST);
                (direction.as_vec3().extend(scale as f32), (-outer * scale) as f32)
            }
            _ => (Vec4::ZERO, 1.0),
        };
        let falloff = &light.falloff;
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
            attenuation: Vec4::new(falloff.constant, falloff.linear, falloff.quadratic, offset),
            reach: Vec4::new(
                falloff.least,
                falloff.exponent,
                light.range.recip() as f32,
                if falloff.squared_window { 1.0 } else { 0.0 },
            ),
            right,
            up,
        }
    }

    /// Irradiance at `position` on a surface with unit normal `normal`, without occluders, linear
    /// RGB; 0 where the surface faces away. The twin of `antumbra_irradiance` in `lights.glsl`.
    ///
    /// Of a light with an area exact, with the part of it below the surface's horizon cut off; a falloff other than
    /// the physical one acts on it as on a point at its centre.
    pub fn irradiance(&self, position: Vec3, normal: Vec3) -> Vec3 {
        let to_light = self.place.truncate() - position * self.place.w;
        let square = to_light.dot(to_light).max(1e-30);
        let distance = square.sqrt();
        let direction = to_light / distance;
        let angular =
            ((-direction).dot(self.cone.truncate()) * self.cone.w + self.attenuation.w).clamp(0.0, 1.0);
        let falloff =
            if self.place.w > 0.5 { falloff(self.attenuation, self.reach, distance, square) } else { 1.0 };
        let cosine = if self.right.w > 0.5 {
            self.flat_cosine(position, normal)
        } else {
            ball_cosine(self.color.w, square, normal.dot(direction))
        };
        self.color.truncate() * (cosine * angular * angular * falloff)
    }

    /// The cosine at the receiver, averaged over a disc or rectangle as its irradiance is. The twin of
    /// `antumbra_flat_cosine`.
    fn flat_cosine(&self, position: Vec3, normal: Vec3) -> f32 {
        let (center, direction) = (self.place.truncate(), self.cone.truncate());
        let half = [self.right.truncate(), self.up.truncate()];
        let patch = if self.right.w < 1.5 {
            Patch::of_disc(center, direction, self.color.w, position, normal)
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

/// The cosine at the receiver, averaged over a ball as its irradiance is; of a point for a radius of 0. From inside a ball its
/// glow fills the half of all directions around its centre. The twin of `antumbra_ball_cosine` in `lights.glsl`.
fn ball_cosine(radius: f32, square: f32, cosine: f32) -> f32 {
    let sine = radius / square.sqrt();
    if radius > 0.0 { cap_irradiance(sine.min(1.0), cosine) / (sine * sine) } else { cosine.max(0.0) }
}

/// How a light weakens with the distance. The twin of `antumbra_falloff` in `lights.glsl`.
fn falloff(attenuation: Vec4, reach: Vec4, distance: f32, square: f32) -> f32 {
    let power = if reach.y > 0.0 { distance.powf(reach.y) } else { 0.0 };
    let divisor = attenuation.x + attenuation.y * distance + attenuation.z * square + power;
    let share = square * (reach.z * reach.z);
    let window = (1.0 - share * share).clamp(0.0, 1.0);
    (if reach.w > 0.5 { window * window } else { window }) / divisor.max(reach.x.max(1e-30))
}

/// A batch's lights in view space, as the shaders' array of seven vectors a light; those that are not there are zero.
pub(super) fn packed(lights: &[Light], view: &View) -> [ShaderLight; BATCH_LIGHTS] {
    let mut packed = [ShaderLight::default(); BATCH_LIGHTS];
    packed.iter_mut().zip(lights).for_each(|(slot, light)| *slot = ShaderLight::new(light, view.view));
    packed
}
