//! The shadow of a cone: the convex hull of the shadows of its base and its apex.
//!
//! It is found from the faces that the light sees. A point of the base's rim, or of the two lines
//! from rim to apex in which the light grazes the side, is on the shadow's edge if the light sees one
//! of the faces that meet there and not the other. If the apex' shadow lies inside the base's, no
//! line grazes and the shadow is the base's conic. (The composite method, 2017, joins the apex to the
//! ends of a diameter of the base instead, and loses two slivers.)
//!
//! Where the cone passes through the plane its section is dark too, and its edge is on the shadow's
//! edge where the light sees the face that comes up there. The section of the side is the projection
//! of the rim from the apex. Between the parts the boundary is straight: the base's section, and the
//! infinitely far part of a shadow that reaches there.

use glam::DVec3;

use super::angles::Angles;
use super::conic::{Curve, IDEAL, Ring};
use super::disc::{disc, project};
use super::edge::Edge;
use super::outline::Outline;
use super::polygon::half_plane;
use super::setting::Setting;
use super::{PlaneShadow, ShadowKind};
use crate::Cone;

/// A light within this fraction of the cone's size of its surface touches it.
const TOUCHING: f64 = 1e-12;

/// A cone in the plane's coordinates, and what of its side the light sees.
struct Seen {
    apex: DVec3,
    /// From base to apex, a unit vector.
    axis: DVec3,
    rim: Ring,
    radius: f64,
    height: f64,
    /// The side's outward normal at the rim's angle t, times the vector to the light, as
    /// f0 + fa cos t + fb sin t.
    side: [f64; 3],
    /// The same for the base.
    base: f64,
}

impl Seen {
    fn new(setting: &Setting, cone: &Cone) -> Option<Self> {
        let axis = setting.direction(cone.axis).normalize_or_zero();
        let (radius, height) = (cone.radius, cone.height);
        let center = setting.point(cone.base_center);
        let rim = Ring::new(center, axis, radius);
        let apex = center + axis * height;
        let to_light = setting.toward_light(apex);
        let slope = height / radius;
        let side = [radius * axis.dot(to_light), slope * rim.a.dot(to_light), slope * rim.b.dot(to_light)];
        let base = -axis.dot(setting.toward_light(center));
        let usable = radius > 0.0 && height > 0.0 && axis != DVec3::ZERO && apex.is_finite();
        usable.then_some(Self { apex, axis, rim, radius, height, side, base })
    }

    /// The outward unit normal of the side at angle `t`.
    fn side_normal(&self, t: f64) -> DVec3 {
        let out = (self.rim.at(t) - self.rim.center) / self.radius;
        (out * self.height + self.axis * self.radius).normalize_or_zero()
    }

    /// The rim's point at angle `t`; in the plane, if it was meant to be.
    fn rim_at(&self, t: f64) -> DVec3 {
        let p = self.rim.at(t);
        let noise = 8.0 * f64::EPSILON * (self.rim.center.z.abs() + self.rim.a.z.abs());
        if p.z.abs() <= noise { p.with_z(0.0) } else { p }
    }

    /// Where the line through the apex and a point `p` (weight 1) meets the plane; linear in `p`, so
    /// that it maps directions (weight 0) too. The weight is positive if the point and the apex are on
    /// different sides of the plane.
    fn meet(&self, p: DVec3, weight: f64) -> DVec3 {
        let apex = self.apex;
        let scale = apex.z.signum() / (apex.z.abs() + self.rim.center.z.abs() + self.rim.a.z.abs());
        (p * apex.z - apex * p.z).with_z(apex.z * weight - p.z) * scale
    }

    /// The section of the side by the plane, by the rim's angle.
    fn section(&self) -> Curve {
        let Ring { center, a, b } = self.rim;
        Curve::new(self.meet(center, 1.0), self.meet(a, 0.0), self.meet(b, 0.0))
    }

    /// A point of the section. Where rim and apex are both next to the plane it is all rounding, and
    /// every user of it needs to have the same.
    fn crossing(&self, t: f64) -> DVec3 {
        self.meet(self.rim_at(t), 1.0)
    }

    /// The shadow of the line from the rim's point at angle `t` to the apex, as far as it is above the
    /// plane and below the light.
    fn generator(&self, setting: &Setting, rim_curve: &Curve, t: f64) -> Option<Edge> {
        let rim = self.rim_at(t);
        let snap = |p: DVec3| if p.z.abs() <= IDEAL { p.with_z(0.0) } else { p };
        let (from, to) = match (rim.z >= 0.0, self.apex.z >= 0.0) {
            (true, true) => (rim_curve.snapped(setting.project(rim)), setting.project(self.apex)),
            (true, false) => (rim_curve.snapped(setting.project(rim)), self.crossing(t)),
            (false, true) => (self.crossing(t), setting.project(self.apex)),
            (false, false) => return None,
        };
        let (from, to) = (snap(from), snap(to));
        let ideal = from.lerp(to, from.z / (from.z - to.z)).with_z(0.0);
        match (from.z >= 0.0, to.z >= 0.0) {
            (true, true) => Some(Edge::Line([from, to])),
            (true, false) => Some(Edge::Line([from, ideal])),
            (false, true) => Some(Edge::Line([ideal, to])),
            (false, false) => None,
        }
    }

    /// The shadow where the light, which has a position, is inside the cone or within `near` of it.
    fn touched(&self, setting: &Setting, near: f64) -> Option<PlaneShadow> {
        let [f0, fa, fb] = self.side;
        let from_apex = setting.seen_from_light(self.apex);
        if from_apex.length() <= near {
            // The solid angle of the cone itself: all that the base hides, the plane or not.
            let curve = project(setting, &self.rim);
            return Some(PlaneShadow::conic_region(curve, &curve.chains(&curve.in_front())));
        }
        // Distances outwards from the base and from the side, metres.
        let base = self.base / setting.light.w;
        let side = (f0 + fa.hypot(fb)) / self.height.hypot(self.radius) / setting.light.w;
        if base > near || side > near {
            return None;
        }
        let mut shadow = PlaneShadow::everything();
        let mut behind = |normal: DVec3| {
            let f = (-normal).with_z(-normal.dot(setting.seen_from_light(DVec3::ZERO)));
            shadow = shadow.and(&half_plane(f), f);
        };
        if side >= -near {
            behind(self.side_normal(fb.atan2(fa)));
        }
        if base >= -near {
            behind(-self.axis);
        }
        Some(shadow)
    }
}

/// The shadow of a cone. One of height zero is a disc.
pub(super) fn cone(setting: &Setting, cone: &Cone) -> PlaneShadow {
    if cone.height == 0.0 {
        return disc(setting, cone.base_center, cone.axis, cone.radius);
    }
    let slack = setting.slack(setting.point(cone.base_center), cone.radius + cone.height);
    let setting = &setting.lowered(slack);
    let Some(seen) = Seen::new(setting, cone) else { return PlaneShadow::nothing() };
    if setting.light.w > 0.0
        && let Some(shadow) = seen.touched(setting, TOUCHING * (cone.radius + cone.height) + slack)
    {
        return shadow;
    }
    let (rim, apex) = (&seen.rim, seen.apex);
    if apex.z.max(rim.top()) <= 2.0 * slack {
        return PlaneShadow::nothing();
    }
    let lit_side = Angles::where_nonnegative(seen.side[0], seen.side[1], seen.side[2]);
    let lit_base = seen.base > 0.0;

    // The rim, where one of its faces is seen and the other is not.
    let silhouette = if lit_base { lit_side.complement() } else { lit_side.clone() };
    let rim_above = rim.above();
    let rim_curve = project(setting, rim);
    let rim_angles = silhouette.and(&rim_above);
    let rim_arcs =
        rim_curve.chains_between(&rim_angles.and(&rim_curve.in_front()), |t| setting.project(seen.rim_at(t)));

    // The lines in which the light grazes the side.
    let lines = lit_side.ends().into_iter().flatten();
    let apex_in_plane = apex.z.abs() <= 2.0 * slack;
    let line = |t: f64| {
        let below = apex_in_plane && seen.rim_at(t).z < 0.0;
        if below { None } else { seen.generator(setting, &rim_curve, t).map(|line| vec![line]) }
    };
    let lines: Vec<Vec<Edge>> = lines.filter_map(line).collect();

    // The section of the side.
    let mut section_arcs = Vec::new();
    let mut section_curve = None;
    let below = if apex.z > 0.0 { rim_above.complement() } else { rim_above.clone() };
    let section_angles = lit_side.and(&below);
    if apex_in_plane {
        // The section is a triangle: every line from rim to apex meets the plane in the apex, but for
        // the two that lie in it.
        let corner = apex.with_z(1.0);
        let end = |t: f64| {
            let p = seen.rim_at(t);
            if p.z == 0.0 { p.with_z(1.0) } else { corner }
        };
        let side =
            |(from, to): (f64, f64)| vec![Edge::Line([end(from), corner]), Edge::Line([corner, end(to)])];
        if !rim_above.is_none() && !rim_above.is_all() {
            section_arcs.extend(section_angles.spans().map(side));
        }
    } else {
        let curve = seen.section();
        section_arcs = curve.chains_between(&section_angles, |t| seen.crossing(t));
        section_curve = Some(curve);
    }

    match (rim_arcs.is_empty(), lines.is_empty(), section_curve) {
        (false, true, _) if section_arcs.is_empty() && rim_angles.is_all() => {
            PlaneShadow::conic_region(rim_curve, &rim_arcs)
        }
        (true, true, Some(curve)) if section_angles.is_all() => {
            PlaneShadow::conic_region(curve, &section_arcs)
        }
        _ => PlaneShadow::region(&[rim_arcs, lines, section_arcs].concat()),
    }
}

/// The common part of two half-planes' shadows, of which `f` describes the second.
impl PlaneShadow {
    fn and(&self, other: &Self, f: DVec3) -> Self {
        match (self.kind(), other.kind()) {
            (ShadowKind::Nothing, _) | (_, ShadowKind::Everything) => self.clone(),
            (ShadowKind::Everything, _) | (_, ShadowKind::Nothing) => other.clone(),
            _ => Self::polygon(self.outline.as_ref().and_then(|outline: &Outline| outline.clipped(f))),
        }
    }
}
