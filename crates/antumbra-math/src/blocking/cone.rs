//! A solid cone is its base and a triangle, as long as the light is outside.

use super::{Blocker, Blockers, Outline, PolygonBlocker, disc, polygon};
use crate::{Cone, Disc, Plane};
use glam::{DVec3, DVec4};

/// The ways from the light that meet a cone are those that cross its base or the triangle of its
/// apex and the two points where planes through light and apex touch the base: that triangle
/// divides the lit part of the lateral surface from the dark part. The papers (Pljasković
/// et al., Sphere and Cone Composite Realtime Shadows in OpenGL, 2013; Avdić et al., Real-Time
/// Shadows in OpenGL Caused by the Presence of Multiple Light Sources, 2017) take the ends of a
/// diameter instead of the tangent points and lose two slivers.
///
/// Near the rim, and that only, it is less exact than elsewhere: the light grazes base and triangle
/// alike, and errors grow by the radius over the distance to the rim.
///
/// The two leave out the part of the solid that lies before them, which no viewer outside can see:
/// see [`holds`].
pub(super) fn blockers(cone: &Cone, l: DVec4) -> Blockers {
    if !(cone.radius > 0.0 && cone.height >= 0.0) {
        return Blockers::NONE;
    }
    if holds(cone, l) {
        return Blockers::everything();
    }
    if let Some(wedge) = touched(cone, l) {
        return Blockers::one(Blocker::Polygon(wedge), Outline::Everywhere);
    }
    let base = Disc { center: cone.base_center, normal: cone.axis, radius: cone.radius };
    let triangle = tangent_points(cone, l).and_then(|[a, b]| polygon(&[cone.apex(), a, b], l));
    Blockers { list: [disc(&base, l), triangle], solid: Some(*cone) }
}

/// What a light on the surface of a cone leaves dark: the far side of the surface's tangent plane
/// there, on the rim what is on the far side of both. Touching means to rounding, 1e-12 of the
/// cone's size. The apex is no such point: from there the base alone is in the way.
fn touched(cone: &Cone, l: DVec4) -> Option<PolygonBlocker<DVec3>> {
    if l.w == 0.0 || cone.height == 0.0 {
        return None;
    }
    let light = l.truncate();
    let from_base = light - cone.base_center;
    let height = cone.axis.dot(from_base);
    let base = Plane::through(cone.base_center, -cone.axis);
    // On the axis there is no tangent plane, and only the base can be touched.
    let lateral = (from_base - cone.axis * height)
        .try_normalize()
        .and_then(|radial| (radial * cone.height + cone.axis * cone.radius).try_normalize())
        .map(|normal| Plane::through(cone.apex(), normal));
    let tolerance = 1e-12 * (cone.height + cone.radius);
    let (below, beside) = (-height, lateral.map_or(f64::NEG_INFINITY, |plane| plane.height(light)));
    if !(below.max(beside).abs() <= tolerance && height < cone.height) {
        return None;
    }
    let dark = |plane: Plane| (-plane.normal, plane.offset);
    let touches = |distance: f64| distance.abs() <= tolerance;
    let mut planes = lateral.filter(|_| touches(beside)).into_iter().chain(touches(below).then_some(base));
    let mut wedge = PolygonBlocker { base: dark(planes.next()?), ..PolygonBlocker::EVERYTHING };
    if let Some(other) = planes.next() {
        wedge.edges[0] = dark(other);
    }
    Some(wedge)
}

/// Whether the homogeneous point lies inside the cone, its surface left out.
pub(super) fn holds(cone: &Cone, p: DVec4) -> bool {
    if p.w == 0.0 {
        return false;
    }
    let from_base = p.truncate() - cone.base_center;
    let height = cone.axis.dot(from_base);
    let off_axis = (from_base - cone.axis * height).length();
    height > 0.0 && off_axis * cone.height < cone.radius * (cone.height - height)
}

/// Where the planes through the light and the apex touch the base circle; `None` when the light
/// looks straight into the cone or the cone hides behind its base.
///
/// The line from light to apex meets the base's plane in a point, kept homogeneous (`u`, `w`)
/// because the two may be level: tangents from it touch the circle on its polar line (Hartley and
/// Zisserman, Multiple View Geometry in Computer Vision, section 2.2.3).
pub(crate) fn tangent_points(cone: &Cone, l: DVec4) -> Option<[DVec3; 2]> {
    let from_base = l.truncate() - cone.base_center * l.w;
    let height = cone.axis.dot(from_base);
    let u = (from_base - cone.axis * height) * -cone.height;
    let w = height - l.w * cone.height;
    let reach = u.length();
    let cos = cone.radius * w / reach;
    if !(cos.abs() < 1.0) {
        return None;
    }
    let radial = u / reach;
    let across = cone.axis.cross(radial) * (1.0 - cos * cos).sqrt();
    Some([radial * cos + across, radial * cos - across].map(|p| cone.base_center + p * cone.radius))
}
