//! A flat disc between a point and a light.

use super::Footprint;
use super::coverage::{Edge, corner_coverage};
use crate::Disc;
use crate::real::{Real, Vector};
use glam::{DVec3, DVec4};

/// A disc and the light it blocks.
///
/// The light is kept as (`toward`, `nearness`): for a light at height H above the disc's plane,
/// `toward` is the vector from the centre to the light divided by H, and `nearness` is 1/H; a
/// directional light has nearness zero. So near, far and infinitely far lights are one formula
/// without cancellation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiscBlocker<V: Vector> {
    /// Centre of the disc.
    pub center: V,
    /// Its radius.
    pub radius: V::Real,
    /// Unit normal on the light's side.
    pub normal: V,
    /// Direction towards the light, scaled to `toward · normal = 1`.
    pub toward: V,
    /// One over the light's height above the disc's plane.
    pub nearness: V::Real,
}

impl DiscBlocker<DVec3> {
    /// `None` for a disc of radius zero, and for a light in its plane.
    pub fn new(disc: &Disc, light: DVec4) -> Option<Self> {
        if !(disc.radius > 0.0) {
            return None;
        }
        let from_center = light.truncate() - disc.center * light.w;
        let height = disc.normal.dot(from_center);
        // A light whose height is rounding error is in the plane.
        if !(height.abs() > from_center.length() * 1e-14) {
            return None;
        }
        Some(Self {
            center: disc.center,
            radius: disc.radius,
            normal: disc.normal * height.signum(),
            toward: from_center / height.abs(),
            nearness: light.w / height.abs(),
        })
    }

    pub(super) fn to_f32(self) -> DiscBlocker<glam::Vec3> {
        DiscBlocker {
            center: self.center.as_vec3(),
            radius: self.radius as f32,
            normal: self.normal.as_vec3(),
            toward: self.toward.as_vec3(),
            nearness: self.nearness as f32,
        }
    }
}

/// How much of the pixel a disc takes from the light: the point is projected from the light on
/// the disc's plane and its distance from the centre compared with the radius.
pub fn disc_coverage<V: Vector>(b: &DiscBlocker<V>, footprint: &Footprint<V>) -> V::Real {
    let from_center = footprint.point - b.center;
    let height = b.normal.dot(from_center);
    let behind = Edge::new(-height, -b.normal, footprint);
    if !(behind.coverage > V::Real::ZERO) {
        return V::Real::ZERO;
    }
    // Where the footprint straddles the plane, the part behind it is what counts.
    let height = height.min(V::Real::ZERO);
    let scale = V::Real::ONE / (V::Real::ONE - b.nearness * height);
    let hit = (from_center - b.toward * height) * scale;
    let miss = hit.length();
    let outward = hit * (V::Real::ONE / miss.max(V::Real::from_f64(1e-30)));
    let slant = outward.dot(b.toward - hit * b.nearness);
    let gradient = (b.normal * slant - outward) * scale;
    corner_coverage(&behind, &Edge::new(b.radius - miss, gradient, footprint))
}
