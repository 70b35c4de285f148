//! Ray against torus.

use std::ops::ControlFlow;

use glam::DVec3;
use polycool::Quartic;

use super::sphere::Sphere;
use crate::ray::{Chord, Convex, Hit, Ray};

/// A solid torus around the Y axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Torus {
    pub(super) major: f64,
    pub(super) minor: f64,
}

/// How far the bracket of the roots reaches beyond the torus, as a share of its size: far enough that the
/// implicit function is clearly positive at its ends, so that no root sits on the border.
const MARGIN: f64 = 1e-2;

/// To what share of the torus' size polycool resolves a root; one Newton step then brings it to rounding.
const ROOT_ERROR: f64 = 1e-13;

impl Torus {
    /// Squared distance to the circle in the middle of the tube, minus the squared radius of the tube: negative
    /// inside.
    fn implicit(&self, p: DVec3) -> f64 {
        let across = p.x.hypot(p.z) - self.major;
        across * across + (p.y - self.minor) * (p.y + self.minor)
    }

    /// Outward unit normal; on the axis, where a torus without a hole meets itself, ±Y.
    fn normal(&self, p: DVec3) -> DVec3 {
        let ring = DVec3::new(p.x, 0.0, p.z).normalize_or_zero() * self.major;
        (p - ring).normalize_or(DVec3::Y)
    }

    /// Calls `visit` with each crossing of the whole line, in order, until told to stop. Touching without
    /// crossing is no crossing.
    fn crossings(&self, ray: &Ray, mut visit: impl FnMut(f64) -> ControlFlow<()>) {
        let size = self.major + self.minor;
        let (near, shift) = ray.recentred();
        let speed = ray.direction.length();
        // Unit speed and unit size: coefficients of order 1.
        let unit = Ray::new(near.origin / size, near.direction / speed);
        let (major, minor) = (self.major / size, self.minor / size);
        let Some(mut bounds) = Sphere { radius: 1.0 + MARGIN }.chord(&unit) else { return };
        if !bounds.clip_slab(&unit, 1, minor + MARGIN) {
            return;
        }
        let Chord { enter, exit, .. } = bounds;

        // (t² + 2 b t + k)² - 4 R² ((ox + t dx)² + (oz + t dz)²) with k = |o|² + R² - r².
        let (o, d) = (unit.origin, unit.direction);
        let b = o.dot(d);
        let k = o.length_squared() + (major - minor) * (major + minor);
        let axis_distance = o.x.hypot(o.z);
        let r2 = 4.0 * major * major;
        // The constant term is the implicit function times a positive factor: as a product it keeps its digits
        // when the origin is near the surface.
        let across = axis_distance - major;
        let inner = across * across + (o.y - minor) * (o.y + minor);
        let quartic = Quartic::new([
            inner * (k + 2.0 * major * axis_distance),
            4.0 * b * k - 2.0 * r2 * (o.x * d.x + o.z * d.z),
            4.0 * b * b + 2.0 * k - r2 * (d.x * d.x + d.z * d.z),
            4.0 * b,
            1.0,
        ]);
        let scaled = Self { major, minor };
        for root in quartic.roots_between(enter, exit, ROOT_ERROR) {
            let root = scaled.polished(&unit, root);
            if visit(root * size / speed + shift).is_break() {
                return;
            }
        }
    }

    /// One Newton step on the implicit function, whose rounding error is smaller than the quartic's when the
    /// tube is thin. Refused where it would jump: at a grazing root its derivative vanishes.
    fn polished(&self, ray: &Ray, t: f64) -> f64 {
        let p = ray.at(t);
        let across = p.x.hypot(p.z);
        let slope = 2.0
            * ((across - self.major) * (p.x * ray.direction.x + p.z * ray.direction.z) / across
                + p.y * ray.direction.y);
        let step = self.implicit(p) / slope;
        if step.abs() < 1e-6 * self.minor { t - step } else { t }
    }

    pub(super) fn nearest(&self, ray: &Ray) -> Option<Hit> {
        let mut found = None;
        self.crossings(ray, |t| {
            if ray.contains(t) {
                found = Some(Hit { t, normal: self.normal(ray.at(t)) });
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(())
        });
        found
    }

    /// Whether any of the ray's interval lies inside the solid.
    pub(super) fn blocks(&self, ray: &Ray) -> bool {
        self.implicit(ray.at(ray.min)) < 0.0 || self.nearest(ray).is_some()
    }
}
