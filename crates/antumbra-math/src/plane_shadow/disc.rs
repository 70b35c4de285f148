//! The shadow of a disc: the projected circle, an ellipse, or a part of a parabola's or hyperbola's
//! inside where the disc reaches up to the light.
//!
//! For a disc parallel to the plane, light (x, y), disc at height d: the circle of centre
//! -d x / (y - d) (from the point below the disc) and radius r y / (y - d), as in the composite
//! method (2013, 2017).

use glam::{DVec2, DVec3};

use super::PlaneShadow;
use super::conic::{Curve, Ring};
use super::outline::Outline;
use super::polygon::EDGE_ON;
use super::setting::Setting;

/// The projection of a circle.
pub(super) fn project(setting: &Setting, ring: &Ring) -> Curve {
    Curve::new(
        setting.project(ring.center),
        setting.project_direction(ring.a),
        setting.project_direction(ring.b),
    )
}

/// The shadow of a disc. The normal need not be of unit length.
pub(super) fn disc(setting: &Setting, center: DVec3, normal: DVec3, radius: f64) -> PlaneShadow {
    let slack = setting.slack(setting.point(center), radius);
    let setting = &setting.lowered(slack);
    let (center, normal) = (setting.point(center), setting.direction(normal).normalize_or_zero());
    if radius.is_nan() || radius <= 0.0 || normal == DVec3::ZERO {
        return PlaneShadow::nothing();
    }
    let to_light = setting.toward_light(center);
    let is_edge_on = normal.dot(to_light).abs() <= EDGE_ON * to_light.length() + slack * setting.light.w;
    let ring = Ring::new(center, normal, radius);
    if ring.top() <= 2.0 * slack {
        return PlaneShadow::nothing();
    }
    let curve = project(setting, &ring);
    let above = ring.above();
    let chains = curve.chains(&above.and(&curve.in_front()));
    if is_edge_on {
        let along = DVec2::new(normal.y, -normal.x).normalize_or_zero();
        return match Outline::from_chains(&chains) {
            Some(outline) => {
                PlaneShadow::segment(&[outline.support(-along).1, outline.support(along).1], along)
            }
            None => PlaneShadow::nothing(),
        };
    }
    if above.is_all() { PlaneShadow::conic_region(curve, &chains) } else { PlaneShadow::region(&chains) }
}
