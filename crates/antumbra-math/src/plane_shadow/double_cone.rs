//! The double cone around a ball: what a plane cuts from the tip between ball and apex, and from the
//! half behind the apex.
//!
//! The apex takes the light's place in the projection. Points of the circle of contact on the far side
//! of the plane fall on the plane between apex and ball, where a light's shadow has those on the near
//! side; and of the ball's section by the plane the part on the far side bounds the tip. So the tip is
//! made of what the shadow leaves out. The other half of the double cone is the projection of
//! directions: the apex itself is projected to (0, 0, 0).

use core::f64::consts::PI;

use glam::DVec3;

use super::angles::Angles;
use super::conic::{Curve, Ring};
use super::disc::project;
use super::setting::Setting;
use super::sphere::{Section, contact};
use super::{PlaneFrame, PlaneShadow};
use crate::{Light, Sphere};

impl PlaneShadow {
    /// The section of the convex hull of `ball` and `apex`, less what is beyond the ball: points in the
    /// ball, and points from which the ball covers all that is in the cone behind it. `apex` lies
    /// outside the ball; nothing if it lies in the plane.
    pub(crate) fn before_apex(ball: &Sphere, apex: DVec3, frame: &PlaneFrame) -> Self {
        let Some((setting, center, to_apex, sine)) = seen(ball, apex, frame) else {
            return Self::nothing();
        };
        let r = ball.radius;
        if center.z - r >= -setting.slack(center, r) {
            return Self::nothing();
        }
        let ring = contact(center, to_apex, r, sine);
        let (curve, above) = (project(&setting, &ring), ring.above());
        if above.is_all() {
            return Section::new(center, to_apex, r).whole();
        }
        let mut chains = curve.chains(&above.complement());
        let Some([from, _]) = above.ends() else {
            return Self::conic_region(curve, &chains);
        };
        let section = Section::new(center, to_apex, r);
        let rest = PI - section.angle(ring.at(from));
        chains.extend(section.curve.chains(&Angles::around(PI, rest)));
        Self::region(&chains)
    }

    /// The section of the half of the double cone that opens away from the ball, behind the apex. The
    /// same `apex`; nothing if it lies in the plane.
    pub(crate) fn past_apex(ball: &Sphere, apex: DVec3, frame: &PlaneFrame) -> Self {
        let Some((setting, _, to_apex, sine)) = seen(ball, apex, frame) else {
            return Self::nothing();
        };
        let axis = to_apex.normalize();
        let cone = Ring::new(axis * ((1.0 - sine) * (1.0 + sine)).sqrt(), axis, sine);
        // In units of the apex's height, as the weights are.
        let at = |d: DVec3| setting.project_direction(d / setting.light.w);
        let curve = Curve::new(at(cone.center), at(cone.a), at(cone.b));
        Self::conic_region(curve, &curve.chains(&curve.in_front()))
    }
}

/// The setting with the apex for a light, the ball's centre and the vector to the apex there, and the
/// sine of the cone's half-angle.
fn seen(ball: &Sphere, apex: DVec3, frame: &PlaneFrame) -> Option<(Setting, DVec3, DVec3, f64)> {
    let setting = Setting::new(frame, &Light::Point { position: apex })?;
    let center = setting.point(ball.center);
    let to_apex = setting.toward_light(center);
    let sine = ball.radius * setting.light.w / to_apex.length();
    (ball.radius > 0.0 && sine < 1.0).then_some((setting, center, to_apex, sine))
}
