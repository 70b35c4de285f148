//! Opaque infinite planes: what lies behind them is not seen.

use super::View;
use crate::input::Occluder;
use antumbra_math::{Light, Plane, Shape};
use glam::DVec4;

/// Appends the half-spaces that hold everything seen, view space.
pub(crate) fn seen_half_spaces(
    occluders: &[Occluder],
    bounds: &[Plane],
    view: &View,
    half_spaces: &mut Vec<Plane>,
) {
    let eye_ws = view.eye_ws();
    half_spaces.extend(bounds.iter().map(|b| b.transformed(&view.view)));
    for o in occluders {
        // Nothing is seen behind an opaque plane that the host draws, unless the eye is in it.
        if let (Shape::Plane(plane), true) = (&o.shape, o.id != 0) {
            half_spaces.extend(plane.facing(eye_ws).map(|side| side.transformed(&view.view)));
        }
    }
}

/// Whether nothing that is seen can lie in the shape's shadow: an opaque infinite plane, drawn by the host, with the eye
/// on the light's side hides all that it takes the light from. Shape, light and eye in one space.
pub(crate) fn hides_its_own_shadow(shape: &Shape, id: u32, light: &Light, eye: DVec4) -> bool {
    let Shape::Plane(plane) = shape else { return false };
    id != 0 && plane.height_of(light.homogeneous()) * plane.height_of(eye) > 0.0
}
