//! What lights send to a point: one sample at a time, so that every light looks the same to the tracer.

mod disc;
mod flat;
mod rectangle;
mod sphere;

use antumbra_scene::{Light, LightKind};
use glam::{DVec2, DVec3};

/// What arrives at a point of a surface from one point of a light, if nothing is in the way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Incoming {
    /// Towards the light. Anything on the ray from the point along it, up to `reach`, is in the way.
    pub(crate) direction: DVec3,
    /// Where on that ray the light is, in units of `direction`; infinite for directional lights.
    pub(crate) reach: f64,
    /// The sample's share in the light's visibility: proportional to its irradiance, but for a spot's cone
    /// and the light's intensity, which visibility knows nothing of. Positive.
    pub(crate) weight: f64,
    /// Irradiance of a white light, lux: the mean over all samples is the light's whole irradiance.
    pub(crate) irradiance: f64,
}

/// Whether one sample says all there is to know of a light.
pub(crate) fn is_hard(light: &Light) -> bool {
    matches!(light.kind, LightKind::Point | LightKind::Directional { .. } | LightKind::Spot { .. })
}

/// Sample `u` (in the unit square) of what a light sends to a point with unit normal `n`; `None` where that is
/// nothing: the surface faces away, or the light does.
///
/// The mean over uniform `u` is unbiased. Hard lights ignore `u`. A point at exactly a hard light's position gets
/// nothing. At a point inside a sphere light the light is taken to fill the half of all directions about the one to
/// its centre (about the normal, at the centre itself), with nothing in between: that continues what happens on its
/// surface. A disc or rectangle sends nothing to points in or behind its plane.
pub(crate) fn incoming(light: &Light, p: DVec3, n: DVec3, u: DVec2) -> Option<Incoming> {
    let found = match light.kind {
        LightKind::Point => point(light, p, n),
        LightKind::Spot { direction, inner_angle, outer_angle } => {
            let sample = point(light, p, n)?;
            let cosine = -sample.direction.normalize().dot(direction);
            Some(Incoming {
                irradiance: sample.irradiance * falloff(cosine, inner_angle, outer_angle),
                ..sample
            })
        }
        LightKind::Directional { direction } => {
            let cosine = -direction.dot(n);
            (cosine > GRAZING).then_some(Incoming {
                direction: -direction,
                reach: f64::INFINITY,
                weight: cosine,
                irradiance: light.intensity * cosine,
            })
        }
        LightKind::Sphere { radius } => sphere::incoming(light, radius, p, n, u),
        LightKind::Disc { direction, radius } => {
            flat::incoming(light, direction, &disc::Disc::new(direction, radius), p, n, u)
        }
        LightKind::Rectangle { direction, right, width, height } => flat::incoming(
            light,
            direction,
            &rectangle::Rectangle::new(direction, right, width, height),
            p,
            n,
            u,
        ),
    }?;
    (found.weight > 0.0).then_some(found)
}

/// A cosine that rounding makes of zero: a hard light in the plane of a surface sends it nothing.
const GRAZING: f64 = 1e-12;

/// I cos / d².
fn point(light: &Light, p: DVec3, n: DVec3) -> Option<Incoming> {
    let to = light.position - p;
    let squared = to.length_squared();
    let weight = to.dot(n) / squared.sqrt();
    if weight <= GRAZING {
        return None;
    }
    (squared > 0.0).then_some(Incoming {
        direction: to,
        reach: 1.0,
        weight,
        irradiance: light.intensity * weight / squared,
    })
}

/// The spot's attenuation: 1 inside the inner cone, 0 outside the outer one, as glTF's KHR_lights_punctual
/// recommends. Where the two cones coincide it is a step.
fn falloff(cosine: f64, inner_angle: f64, outer_angle: f64) -> f64 {
    let (inner, outer) = (inner_angle.cos(), outer_angle.cos());
    if inner > outer {
        let x = ((cosine - outer) / (inner - outer)).clamp(0.0, 1.0);
        x * x
    } else if cosine >= outer {
        1.0
    } else {
        0.0
    }
}
