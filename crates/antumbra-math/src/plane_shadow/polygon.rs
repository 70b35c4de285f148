//! The shadow of triangles, rectangles and planes.
//!
//! What is above the plane and below the light is a polygon again (Sutherland and Hodgman, Reentrant
//! Polygon Clipping, 1974), and its shadow is the polygon of its corners' shadows. In the triangle of
//! the composite method (2017), of base a and height h over the base's height d, with the light at
//! (x, y): base a y / (y - d), apex at x (h + d) / (h + d - y).

use glam::{DVec2, DVec3};

use super::PlaneShadow;
use super::conic::IDEAL;
use super::outline::Outline;
use super::setting::Setting;
use crate::Plane;

/// A flat shape whose plane is seen under a smaller angle (radians) than this is edge-on.
pub(super) const EDGE_ON: f64 = 1e-12;

/// A polygon with less than this fraction of the area that its sides could enclose is a line.
const THIN: f64 = 1e-14;

/// The shadow of a flat convex polygon; its corners in order.
pub(super) fn polygon(setting: &Setting, corners: &[DVec3]) -> PlaneShadow {
    let corners: Vec<DVec3> = corners.iter().map(|&p| setting.point(p)).collect();
    let first = corners[0];
    // Newell: twice the area, along the normal.
    let normal: DVec3 = corners.windows(2).map(|pair| (pair[0] - first).cross(pair[1] - first)).sum();
    let size = corners.iter().map(|p| p.distance(first)).fold(0.0, f64::max);
    let has_area = normal.length() > THIN * size * size;
    let slack = setting.slack(first, size);
    if !has_area || corners.iter().all(|p| p.z <= slack) {
        return PlaneShadow::nothing();
    }
    let above = clip(&corners, |p| if p.z.abs() <= slack { 0.0 } else { p.z });
    // A corner as high as the light has its shadow at infinity.
    let weight = |p: DVec3| {
        let weight = setting.project(p).z;
        if weight.abs() <= IDEAL { 0.0 } else { weight }
    };
    let between = clip(&above, weight);
    if between.iter().all(|&p| weight(p) <= 0.0) {
        return PlaneShadow::nothing();
    }
    let shadows: Vec<DVec3> =
        between.iter().map(|&p| setting.project(p).with_z(weight(p).max(0.0))).collect();
    let to_light = setting.toward_light(first);
    let least = EDGE_ON * to_light.length() + slack * setting.light.w;
    if normal.dot(to_light).abs() <= least * normal.length() {
        let along = DVec2::new(normal.y, -normal.x).normalize_or_zero();
        return PlaneShadow::segment(&shadows, along);
    }
    PlaneShadow::polygon(Outline::polygon(&shadows))
}

/// The part of a convex polygon where `f`, which is linear, is not negative.
fn clip(corners: &[DVec3], f: impl Fn(DVec3) -> f64) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(corners.len() + 1);
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        let (fa, fb) = (f(a), f(b));
        if fa >= 0.0 {
            kept.push(a);
        }
        if (fa < 0.0 && fb > 0.0) || (fa > 0.0 && fb < 0.0) {
            kept.push(a + (b - a) * (fa / (fa - fb)));
        }
    }
    kept
}

/// The shadow of an infinite plane: everything on its other side. A plane through the light is seen
/// edge-on and casts none, nor does one that coincides with the receiver.
pub(super) fn plane(setting: &Setting, plane: &Plane) -> PlaneShadow {
    let length = plane.normal.length();
    let normal = setting.direction(plane.normal) / length;
    // The occluder's plane is the points with normal · p + height = 0.
    let height = (plane.normal.dot(setting.origin()) - plane.offset) / length;
    let l = setting.light;
    let light_height = normal.dot(l.truncate()) + height * l.w;
    let noise = EDGE_ON * (l.truncate().length() + (height * l.w).abs());
    if light_height.is_nan() || light_height.abs() <= noise {
        return PlaneShadow::nothing();
    }
    half_plane(normal.with_z(height) * -light_height.signum())
}

/// The half-plane f · (x, y, 1) >= 0; all or nothing if f is the same everywhere. `f` belongs to a
/// plane of unit normal, of which f.xy is a part.
pub(super) fn half_plane(f: DVec3) -> PlaneShadow {
    if f.truncate().length() > EDGE_ON {
        PlaneShadow::polygon(Outline::half_plane(f))
    } else if f.z > 0.0 {
        PlaneShadow::everything()
    } else {
        PlaneShadow::nothing()
    }
}
