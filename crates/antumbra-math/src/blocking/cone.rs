//! A solid cone is its base and a triangle, as long as the light is outside.

use super::{Blocker, Blockers, Outline, PolygonBlocker, disc, polygon};
use crate::{Cone, Disc, Plane};
use glam::{DVec3, DVec4};

/// The ways from the light that meet a cone are those that cross its base or the triangle of its
/// apex and the two points where planes through light and apex touch the base: that triangle
/// divides the lit part of the lateral surface from the dark part. The papers of 2013 and 2017
/// take the ends of a diameter instead of the tangent points and lose two slivers.
pub(super) fn blockers(cone: &Cone, l: DVec4) -> Blockers {
    if !(cone.radius > 0.0 && cone.height >= 0.0) {
        return Blockers::NONE;
    }
    if is_inside(cone, l) {
        return Blockers::everything();
    }
    if let Some(plane) = touched_plane(cone, l) {
        let from_inside = (plane.normal * -1.0).extend(plane.offset); // dark below the tangent plane
        let blocker =
            PolygonBlocker { base: (from_inside.truncate(), from_inside.w), ..PolygonBlocker::EVERYTHING };
        return Blockers::one(Blocker::Polygon(blocker), Outline::Everywhere);
    }
    let base = Disc { center: cone.base_center, normal: cone.axis, radius: cone.radius };
    let triangle = tangent_points(cone, l).and_then(|[a, b]| polygon(&[cone.apex(), a, b], l));
    Blockers { list: [disc(&base, l), triangle] }
}

/// The tangent plane, normal outwards, of a cone whose lateral surface the light touches: the
/// light's whole far side of it is dark. Touching means to rounding, 1e-12 of the cone's size.
fn touched_plane(cone: &Cone, l: DVec4) -> Option<Plane> {
    if l.w == 0.0 || cone.height == 0.0 {
        return None;
    }
    let from_base = l.truncate() - cone.base_center;
    let height = cone.axis.dot(from_base);
    let radial = (from_base - cone.axis * height).try_normalize()?;
    let normal = (radial * cone.height + cone.axis * cone.radius).try_normalize()?;
    let plane = Plane::through(cone.apex(), normal);
    let touches = plane.height(l.truncate()).abs() <= 1e-12 * (cone.height + cone.radius);
    (touches && height > 0.0 && height < cone.height).then_some(plane)
}

fn is_inside(cone: &Cone, l: DVec4) -> bool {
    if l.w == 0.0 {
        return false;
    }
    let from_base = l.truncate() - cone.base_center;
    let height = cone.axis.dot(from_base);
    let off_axis = (from_base - cone.axis * height).length();
    height > 0.0 && off_axis * cone.height < cone.radius * (cone.height - height)
}

/// Where the planes through the light and the apex touch the base circle; `None` when the light
/// looks straight into the cone or the cone hides behind its base.
///
/// The line from light to apex meets the base's plane in a point, kept homogeneous (`u`, `w`)
/// because the two may be level: tangents from it touch the circle on its polar line.
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
