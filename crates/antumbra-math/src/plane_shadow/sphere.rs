//! The shadow of a ball: the section of its tangent cone.
//!
//! The cone touches the ball in a circle, and the shadow of that circle is the shadow's edge. With
//! the light at height H, the ball's centre at height c, a = H - c, δ the horizontal distance from
//! light to centre, q = a² - r² and s² = |C - L|² - r²: an ellipse whose centre lies δ a H / q from
//! the light's foot towards the ball, with semi-axes H r s / q along that direction and H r / √q
//! across; a parabola for q = 0; one branch of a hyperbola for q < 0. A ball that rests on the plane
//! touches it in a focus (Dandelin, 1822). With the light straight above, the circle of radius
//! r H / √(a² - r²) of the tangent cone in the composite method (2017).
//!
//! Where the ball dips into the plane its section, a circle, is dark too. It touches the conic in
//! the two points where the circle of contact passes through the plane. If that circle is all above
//! the plane, the shadow is the conic; if it is all below, the light sees all of the section's edge,
//! and the shadow is the section; otherwise it is the conic on the far side and the section on the
//! side of the light.

use glam::{DVec2, DVec3};

use super::PlaneShadow;
use super::angles::Angles;
use super::conic::{Curve, Ring};
use super::disc::project;
use super::polygon::half_plane;
use super::setting::Setting;
use crate::Sphere;

/// A light within this fraction of the radius of the surface touches it.
const TOUCHING: f64 = 1e-12;

/// The shadow of a ball.
pub(super) fn sphere(setting: &Setting, sphere: &Sphere) -> PlaneShadow {
    let (center, r) = (setting.point(sphere.center), sphere.radius);
    let to_light = setting.toward_light(center);
    let distance = to_light.length();
    // r / distance, and 0 for a light infinitely far away.
    let sine = r * setting.light.w / distance;
    if !(r > 0.0 && center.is_finite() && !sine.is_nan()) {
        return PlaneShadow::nothing();
    }
    if sine > 1.0 + TOUCHING {
        return PlaneShadow::everything();
    }
    if sine > 1.0 - TOUCHING {
        // The ball takes the light from all that is behind its tangent plane at the light.
        let inwards = -to_light / distance;
        return half_plane(inwards.with_z(inwards.dot(setting.seen_from_light(DVec3::ZERO))));
    }
    if center.z + r <= setting.slack(center, r) {
        return PlaneShadow::nothing();
    }
    let contact = contact(center, to_light, r, sine);
    let curve = project(setting, &contact);
    let above = contact.above();
    let mut chains = curve.chains(&above.and(&curve.in_front()));
    if above.is_all() {
        return PlaneShadow::conic_region(curve, &chains);
    }
    match above.ends() {
        Some([from, _]) => {
            // The section's part on the side of the light, between the two points where the circle
            // of contact passes through the plane.
            let section = Section::new(center, to_light, r);
            chains.extend(section.curve.chains(&Angles::around(0.0, section.angle(contact.at(from)))));
            PlaneShadow::region(&chains)
        }
        None => Section::new(center, to_light, r).whole(),
    }
}

/// The circle in which the tangent cone of a ball touches it. `sine` is that of the cone's half-angle.
pub(super) fn contact(center: DVec3, to_light: DVec3, r: f64, sine: f64) -> Ring {
    let distance = to_light.length();
    Ring::new(
        center + to_light * (r * sine / distance),
        to_light / distance,
        r * ((1.0 - sine) * (1.0 + sine)).sqrt(),
    )
}

/// A ball's section by the plane, a circle; angle 0 is on the side of the light. A point for a ball off
/// the plane.
pub(super) struct Section {
    center: DVec2,
    towards: DVec2,
    pub(super) curve: Curve,
}

impl Section {
    pub(super) fn new(center: DVec3, to_light: DVec3, r: f64) -> Self {
        let radius = ((r - center.z) * (r + center.z)).max(0.0).sqrt();
        let towards = to_light.truncate().normalize_or(DVec2::X);
        let a = (towards * radius).extend(0.0);
        let curve = Curve::new(center.with_z(1.0), a, (towards.perp() * radius).extend(0.0));
        Self { center: center.truncate(), towards, curve }
    }

    /// The angle of a point of the circle, from 0 to π.
    pub(super) fn angle(&self, point: DVec3) -> f64 {
        let offset = point.truncate() - self.center;
        offset.dot(self.towards.perp()).abs().atan2(offset.dot(self.towards))
    }

    pub(super) fn whole(&self) -> PlaneShadow {
        PlaneShadow::conic_region(self.curve, &self.curve.chains(&Angles::all()))
    }
}
