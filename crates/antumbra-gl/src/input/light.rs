//! Lights as the host has them.

use super::LightFault;
use glam::{DVec3, Vec3};

/// A light: where it is, and what it sends.
///
/// A light whose place is not finite, or whose direction is zero, is off. Other numbers that make no
/// sense are [`crate::Error::BadLight`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Where light comes from, world space.
    pub place: antumbra_math::Light,
    /// Linear RGB times intensity: candela, lux for a directional light. Finite, not negative.
    pub intensity: Vec3,
    /// What the light's surface is around its place: nothing for lights without extent.
    pub area: Area,
    /// Spot lights: the half-angle, radians, up to which the light is full; from 0 to the outer angle.
    pub inner_angle: f32,
    /// Constant, linear and quadratic attenuation with the distance: [0, 0, 1] is physical. Finite,
    /// not negative, not all zero.
    pub attenuation: [f32; 3],
}

/// The surface of a light that has one, centred on its position. All sizes in metres, positive.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Area {
    /// Light from one point, or one direction.
    #[default]
    None,
    /// A glowing ball.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// A disc that shines to one side.
    Disc {
        /// Unit normal of the side that shines.
        direction: DVec3,
        /// Radius.
        radius: f64,
    },
    /// A rectangle that shines to one side.
    Rectangle {
        /// Unit normal of the side that shines.
        direction: DVec3,
        /// From the centre to the middle of one side.
        half_right: DVec3,
        /// From the centre to the middle of a neighbouring side, at right angles.
        half_up: DVec3,
    },
}

impl Light {
    /// A point light of `intensity` candela.
    pub fn point(position: impl Into<DVec3>, intensity: Vec3) -> Self {
        Self::new(antumbra_math::Light::Point { position: position.into() }, intensity)
    }

    /// A directional light of `illuminance` lux that travels along `direction` (any length but zero).
    pub fn directional(direction: impl Into<DVec3>, illuminance: Vec3) -> Self {
        let direction = direction.into().normalize_or_zero();
        Self::new(antumbra_math::Light::Directional { direction }, illuminance)
    }

    /// A spot light of `intensity` candela that shines along `direction` (any length but zero),
    /// full within `inner_angle`, nothing outside `outer_angle` (half-angles, radians), with the
    /// falloff of glTF's KHR_lights_punctual between.
    pub fn spot(
        position: impl Into<DVec3>,
        direction: impl Into<DVec3>,
        inner_angle: f32,
        outer_angle: f32,
        intensity: Vec3,
    ) -> Self {
        let place = antumbra_math::Light::Spot {
            position: position.into(),
            direction: direction.into().normalize_or_zero(),
            outer_angle: outer_angle.into(),
        };
        Self { inner_angle, ..Self::new(place, intensity) }
    }

    /// The same light with a surface: `intensity` is then that of the point light it becomes as it shrinks.
    pub fn with_area(self, area: Area) -> Self {
        Self { area, ..self }
    }

    /// What is wrong with the light's numbers, if anything.
    pub(crate) fn fault(&self) -> Option<LightFault> {
        let sane = |x: f32| x.is_finite() && x >= 0.0;
        if !self.intensity.to_array().into_iter().all(sane) {
            return Some(LightFault::Intensity);
        }
        if !self.attenuation.into_iter().all(sane) || self.attenuation == [0.0; 3] {
            return Some(LightFault::Falloff);
        }
        if !self.area.is_sane() {
            return Some(LightFault::Area);
        }
        if self.area != Area::None && !matches!(self.place, antumbra_math::Light::Point { .. }) {
            return Some(LightFault::AreaAround);
        }
        if let antumbra_math::Light::Spot { outer_angle, .. } = self.place {
            let angles_fit = sane(self.inner_angle) && f64::from(self.inner_angle) <= outer_angle + 1e-6;
            if !angles_fit || outer_angle > std::f64::consts::PI {
                return Some(LightFault::SpotAngles);
            }
        }
        None
    }

    fn new(place: antumbra_math::Light, intensity: Vec3) -> Self {
        Self { place, intensity, area: Area::None, inner_angle: 0.0, attenuation: [0.0, 0.0, 1.0] }
    }
}

impl Area {
    /// Whether sizes are positive and finite and directions of unit length.
    fn is_sane(&self) -> bool {
        let size = |x: f64| x.is_finite() && x > 0.0;
        let unit = |v: &DVec3| v.is_finite() && (v.length() - 1.0).abs() < 1e-4;
        match self {
            Self::None => true,
            Self::Sphere { radius } => size(*radius),
            Self::Disc { direction, radius } => unit(direction) && size(*radius),
            Self::Rectangle { direction, half_right, half_up } => {
                unit(direction) && size(half_right.length()) && size(half_up.length())
            }
        }
    }
}
