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
use super::conic::{Curve, Ring};
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
        let center = setting.point(cone.base_center);
        let (radius, height) = (cone.radius, cone.height);
        let rim = Ring::new(center, axis, radius);
        let apex = center + axis * height;
        let to_light = setting.to_light(apex);
        let slope = height / radius;
        let side = [
            radius * axis.dot(to_light),
            slope * rim.a.dot(to_light),
            slope * rim.b.dot(to_light),
        ];
        let base = -axis.dot(setting.to_light(center));
        let usable = radius > 0.0 && height > 0.0 && axis != DVec3::ZERO && apex.is_finite();
        usable.then_some(Self { apex, axis, rim, radius, height, side, base })
    }

    /// The outward unit normal of the side at angle `t`.
    fn side_normal(&self, t: f64) -> DVec3 {
        let out = (self.rim.at(t) - self.rim.center) / self.radius;
        (out * self.height + self.axis * self.radius).normalize_or_zero()
    }

    /// The shadow where the light, which has a position, is inside the cone or touches it.
    fn touched(&self, setting: &Setting) -> Option<PlaneShadow> {
        let [f0, fa, fb] = self.side;
        let size = self.radius + self.height;
        let near = TOUCHING * size;
        let from_apex = setting.from_light(self.apex);
        if from_apex.length() <= near {
            // The solid angle of the cone itself: all that the base hides, the plane or not.
            let curve = project(setting, &self.rim);
            return Some(PlaneShadow::conic_region(curve, curve.edges(&curve.in_front())));
        }
        // Distances outwards from the base and from the side, metres.
        let base = self.base / setting.light.w;
        let side = (f0 + fa.hypot(fb)) / self.height.hypot(self.radius) / setting.light.w;
        if base > near || side > near {
            return None;
        }
        let mut shadow = PlaneShadow::everything();
        let mut behind = |normal: DVec3| {
            let f = (-normal).with_z(-normal.dot(setting.from_light(DVec3::ZERO)));
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
    let Some(seen) = Seen::new(setting, cone) else { return PlaneShadow::nothing() };
    if setting.light.w > 0.0
        && let Some(shadow) = seen.touched(setting)
    {
        return shadow;
    }
    let (rim, apex) = (&seen.rim, seen.apex);
    let slack = setting.slack(apex.length() + rim.center.length() + seen.radius);
    if apex.z.max(rim.top()) <= slack {
        return PlaneShadow::nothing();
    }
    let lit_side = Angles::where_nonnegative(seen.side[0], seen.side[1], seen.side[2]);
    let lit_base = seen.base > 0.0;

    // The rim, where one of its faces is seen and the other is not.
    let silhouette = if lit_base { lit_side.complement() } else { lit_side.clone() };
    let rim_above = rim.above(slack);
    let rim_curve = project(setting, rim);
    let rim_angles = silhouette.and(&rim_above);
    let rim_edges = rim_curve.edges(&rim_angles.and(&rim_curve.in_front()));

    // The lines in which the light grazes the side.
    let lines = lit_side.ends().into_iter().flatten();
    let lines: Vec<Edge> = lines.filter_map(|t| generator(setting, rim.at(t), apex, slack)).collect();

    // The section of the side.
    let mut section_edges = Vec::new();
    let mut section_curve = None;
    let apex_height = apex.z + slack;
    let below = if apex_height > 0.0 { rim_above.complement() } else { rim_above.clone() };
    let section_angles = lit_side.and(&below);
    if apex.z.abs() <= slack {
        // The sections of all generators are the apex.
        let corner = apex.with_z(1.0);
        if !section_angles.is_none() && !rim_above.is_none() && !rim_above.is_all() {
            section_edges.push(Edge::Line([corner, corner]));
        }
    } else {
        let curve = section(rim, apex);
        section_edges = curve.edges(&section_angles);
        section_curve = Some(curve);
    }

    match (rim_edges.is_empty(), lines.is_empty(), section_curve) {
        (false, true, _) if section_edges.is_empty() && rim_angles.is_all() => {
            PlaneShadow::conic_region(rim_curve, rim_edges)
        }
        (true, true, Some(curve)) if section_angles.is_all() => {
            PlaneShadow::conic_region(curve, section_edges)
        }
        _ => {
            let pieces = [rim_edges, lines, section_edges].concat();
            PlaneShadow::region(pieces)
        }
    }
}

/// The shadow of the line from a point of the rim to the apex, as far as it is above the plane and
/// below the light.
fn generator(setting: &Setting, rim: DVec3, apex: DVec3, slack: f64) -> Option<Edge> {
    // The part of the way from rim to apex where a linear function is not negative.
    let range = |rim: f64, apex: f64| {
        let cut = rim / (rim - apex);
        match (rim >= 0.0, apex >= 0.0) {
            (true, true) => Some((0.0, 1.0)),
            (true, false) => Some((0.0, cut)),
            (false, true) => Some((cut, 1.0)),
            (false, false) => None,
        }
    };
    let (from, to) = (setting.project(rim), setting.project(apex));
    let snap = |weight: f64| if weight.abs() <= setting.slack(1.0) { 0.0 } else { weight };
    let (above, below) = (range(rim.z + slack, apex.z + slack)?, range(snap(from.z), snap(to.z))?);
    let (start, end) = (above.0.max(below.0), above.1.min(below.1));
    let at = |t: f64| {
        let p = from.lerp(to, t);
        p.with_z(snap(p.z).max(0.0))
    };
    (start < end).then(|| Edge::Line([at(start), at(end)]))
}

/// The section of the side by the plane, by the rim's angle: where the line through the apex and the
/// rim's point meets the plane. Its weights are those of points of the rim's side of the apex.
fn section(rim: &Ring, apex: DVec3) -> Curve {
    // h_apex rim(t) - h_rim(t) apex, with the weight h_apex - h_rim(t), over the height of the apex
    // above the rim's centre or below.
    let scale = apex.z.signum() / (apex.z.abs() + rim.center.z.abs() + rim.a.z.abs());
    let meet = |p: DVec3, w: f64| (p * apex.z - apex * p.z).with_z(apex.z * w - p.z) * scale;
    Curve::new(meet(rim.center, 1.0), meet(rim.a, 0.0), meet(rim.b, 0.0))
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
