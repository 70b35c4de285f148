//! Lights as the host has them.

use super::{Area, Color, Falloff, LightFault, Vector};
use antumbra_math::Light as Place;
use glam::{DVec3, Vec3};

/// A light: where it is, and what it sends.
///
/// A light whose place is not finite, or whose direction is zero, is off. Other numbers that make no
/// sense are [`crate::Error::BadLight`].
///
/// Intensities are in the host's own units: where a host's light is a number without any, that number is it, and
/// [`Falloff`] says what the host divides it by.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Light {
    /// Where light comes from, world space.
    pub place: Place,
    /// Linear RGB times intensity: candela, lux for a directional light. Finite, not negative.
    pub intensity: Vec3,
    /// What the light's surface is around its place: nothing for lights without extent.
    pub area: Area,
    /// Spot lights: the half-angle, radians, up to which the light is full; from 0 to the outer angle.
    pub inner_angle: f32,
    /// How it weakens with the distance.
    pub falloff: Falloff,
    /// How far it reaches, metres from its place, above 0; infinite for a light that never ends, as directional lights
    /// never do. What it does not reach has no shadows of it to draw.
    pub range: f64,
}

impl Light {
    /// A point light of `intensity` candela: linear RGB.
    pub fn point(position: impl Into<Vector>, intensity: impl Into<Color>) -> Self {
        Self::new(Place::Point { position: position.into().glam() }, intensity.into())
    }

    /// A directional light of `illuminance` lux that travels along `direction` (any length but zero).
    pub fn directional(direction: impl Into<Vector>, illuminance: impl Into<Color>) -> Self {
        let direction = direction.into().glam().normalize_or_zero();
        Self::new(Place::Directional { direction }, illuminance.into())
    }

    /// A spot light of `intensity` candela that shines along `direction` (any length but zero),
    /// full within `inner_angle`, nothing outside `outer_angle` (half-angles, radians), with the
    /// falloff of glTF's KHR_lights_punctual between.
    pub fn spot(
        position: impl Into<Vector>,
        direction: impl Into<Vector>,
        inner_angle: impl Into<f64>,
        outer_angle: impl Into<f64>,
        intensity: impl Into<Color>,
    ) -> Self {
        let place = Place::Spot {
            position: position.into().glam(),
            direction: direction.into().glam().normalize_or_zero(),
            outer_angle: outer_angle.into(),
        };
        Self { inner_angle: inner_angle.into() as f32, ..Self::new(place, intensity.into()) }
    }

    /// The same light in another place.
    pub fn with_place(self, place: Place) -> Self {
        Self { place, ..self }
    }

    /// The same light of another colour and strength.
    pub fn with_intensity(self, intensity: impl Into<Color>) -> Self {
        Self { intensity: intensity.into().glam(), ..self }
    }

    /// The same light with a surface: `intensity` is then that of the point light it becomes as it shrinks.
    pub fn with_area(self, area: Area) -> Self {
        Self { area, ..self }
    }

    /// The same light that weakens in this way.
    pub fn with_falloff(self, falloff: Falloff) -> Self {
        Self { falloff, ..self }
    }

    /// The same light that ends at this distance, as glTF's `range` says: smoothly, by the window that [`Falloff`] tells.
    pub fn with_range(self, range: impl Into<f64>) -> Self {
        Self { range: range.into(), ..self }
    }

    /// Whether light may arrive at a ball; false only outside a spot's cone and beyond the range. `place` is the light's
    /// place in the ball's space.
    pub(crate) fn may_reach(&self, place: &Place, center: DVec3, radius: f64) -> bool {
        let in_range = match *place {
            Place::Point { position } | Place::Spot { position, .. } => {
                !(position.distance(center) - radius >= self.range)
            }
            Place::Directional { .. } => true,
        };
        in_range && place.may_reach(center, radius)
    }

    /// Whether it weakens in a way that the plain shaders do not know.
    pub(crate) fn has_special_falloff(&self) -> bool {
        !self.falloff.is_classic() || self.range.is_finite()
    }

    /// What is wrong with the light's numbers, if anything.
    pub(crate) fn fault(&self) -> Option<LightFault> {
        let sane = |x: f32| x.is_finite() && x >= 0.0;
        if !self.intensity.to_array().into_iter().all(sane) {
            return Some(LightFault::Intensity);
        }
        if !self.falloff.is_sane() {
            return Some(LightFault::Falloff);
        }
        if !(self.range > 0.0) {
            return Some(LightFault::Range);
        }
        if !self.area.is_sane() {
            return Some(LightFault::Area);
        }
        if self.area != Area::None && !matches!(self.place, Place::Point { .. }) {
            return Some(LightFault::AreaAround);
        }
        if let Place::Spot { outer_angle, .. } = self.place {
            let angles_fit = sane(self.inner_angle) && f64::from(self.inner_angle) <= outer_angle + 1e-6;
            if !angles_fit || outer_angle > std::f64::consts::PI {
                return Some(LightFault::SpotAngles);
            }
        }
        None
    }

    fn new(place: Place, intensity: Color) -> Self {
        Self {
            place,
            intensity: intensity.glam(),
            area: Area::None,
            inner_angle: 0.0,
            falloff: Falloff::PHYSICAL,
            range: f64::INFINITY,
        }
    }
}
