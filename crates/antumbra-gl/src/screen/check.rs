//! Whether a frame's numbers make sense.

use crate::input::{Error, Frame, FrameFault, NO_SHADOW};
use glam::{DMat3, DMat4, DVec4};

/// How far the last row of an affine matrix may be from (0, 0, 0, 1): what float32 leaves of one that was inverted.
const AFFINE: f64 = 1e-5;

/// Checks everything about a frame but its projection, which is checked where it is used.
///
/// # Errors
/// [`Error::BadFrame`], [`Error::BadLight`].
pub(super) fn check(frame: &Frame<'_>, max_texture_size: u32) -> Result<(), Error> {
    let (view, projection) = (frame.camera.view, frame.camera.projection);
    if !view.is_finite() || !projection.is_finite() {
        return Err(Error::BadFrame(FrameFault::Camera));
    }
    let rotation = DMat3::from_mat4(view);
    if !(rotation * rotation.transpose()).abs_diff_eq(DMat3::IDENTITY, 1e-4)
        || !view.row(3).abs_diff_eq(DVec4::W, AFFINE)
    {
        return Err(Error::BadFrame(FrameFault::View));
    }
    if projection.determinant() == 0.0 {
        return Err(Error::BadFrame(FrameFault::Projection));
    }
    check_viewport(frame.viewport, max_texture_size).map_err(Error::BadFrame)?;
    if frame.clip.is_some_and(|[_, _, width, height]| width < 0 || height < 0) {
        return Err(Error::BadFrame(FrameFault::Clip));
    }
    if frame.surface.samples == 0 {
        return Err(Error::BadFrame(FrameFault::Samples));
    }
    check_scenery(frame)
}

/// Whether textures can be as large as a viewport.
///
/// # Errors
/// [`FrameFault::Viewport`].
pub(crate) fn check_viewport(
    [x, y, width, height]: [i32; 4],
    max_texture_size: u32,
) -> Result<(), FrameFault> {
    let limit = max_texture_size as i32;
    let fits = width > 0 && height > 0 && width <= limit && height <= limit && x >= 0 && y >= 0;
    if fits { Ok(()) } else { Err(FrameFault::Viewport) }
}

/// Lights, what blocks them, and ambient light.
fn check_scenery(frame: &Frame<'_>) -> Result<(), Error> {
    for (index, light) in frame.lights.iter().enumerate() {
        if let Some(fault) = light.fault() {
            return Err(Error::BadLight { index, fault });
        }
    }
    let mut ids = frame.occluders.iter().map(|o| o.id).chain(frame.meshes.iter().map(|m| m.id));
    if ids.any(|id| id >= NO_SHADOW) {
        return Err(Error::BadFrame(FrameFault::Id));
    }
    let places =
        |m: &DMat4| m.is_finite() && m.row(3).abs_diff_eq(DVec4::W, AFFINE) && m.determinant() != 0.0;
    if !frame.meshes.iter().all(|mesh| places(&mesh.model)) {
        return Err(Error::BadFrame(FrameFault::MeshModel));
    }
    if !frame.ambient.is_finite() || frame.ambient.min_element() < 0.0 {
        return Err(Error::BadFrame(FrameFault::Ambient));
    }
    Ok(())
}
