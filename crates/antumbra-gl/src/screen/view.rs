//! The host's camera in the numbers that everything on the screen is computed with.

use super::check::check;
use super::surface::{SurfaceNumbers, clip_depth};
use crate::input::{Error, Frame, FrameFault};
use glam::{DMat4, DVec2, DVec4};

/// Everything about a frame but its lights and occluders.
pub(crate) struct View {
    /// World to view space.
    pub(crate) view: DMat4,
    /// View to clip space.
    pub(crate) projection: DMat4,
    /// Clip-space w in front of which nothing is drawn.
    pub(crate) near_w: f64,
    /// x, y, width, height.
    pub(crate) viewport: [i32; 4],
    /// For the shaders.
    pub(crate) surface: SurfaceNumbers,
    perspective: bool,
}

impl View {
    /// Checks the frame and prepares its numbers. `max_texture_size` is the driver's.
    ///
    /// # Errors
    /// [`Error::BadFrame`], [`Error::BadLight`].
    pub(crate) fn new(frame: &Frame<'_>, max_texture_size: u32) -> Result<Self, Error> {
        check(frame, max_texture_size)?;
        let projection = frame.camera.projection;
        let perspective = projection.row(3) != DVec4::W;
        Ok(Self {
            view: affine(frame.camera.view),
            projection,
            near_w: near_w(frame, perspective)?,
            viewport: frame.viewport,
            surface: SurfaceNumbers::new(frame, perspective),
            perspective,
        })
    }

    /// Whether sight starts at one point and is not parallel.
    pub(crate) fn is_perspective(&self) -> bool {
        self.perspective
    }

    /// The viewport's size, pixels.
    pub(crate) fn size(&self) -> DVec2 {
        DVec2::new(f64::from(self.viewport[2]), f64::from(self.viewport[3]))
    }

    /// The eye as a homogeneous point of view space: of a parallel view the direction to it.
    pub(crate) fn eye_vs(&self) -> DVec4 {
        if self.perspective { DVec4::W } else { DVec4::Z }
    }

    /// The same in world space.
    pub(crate) fn eye_ws(&self) -> DVec4 {
        self.view.inverse() * self.eye_vs()
    }

    /// From pixels of the viewport to clip space.
    pub(crate) fn clip_position(&self, p: DVec2) -> [f32; 2] {
        (p / self.size() * 2.0 - 1.0).as_vec2().to_array()
    }
}

/// A matrix that is affine but for rounding, without that.
fn affine(mut matrix: DMat4) -> DMat4 {
    for (column, last) in [0.0, 0.0, 0.0, 1.0].into_iter().enumerate() {
        matrix.col_mut(column).w = last;
    }
    matrix
}

/// See [`View::near_w`].
fn near_w(frame: &Frame<'_>, perspective: bool) -> Result<f64, Error> {
    let (projection, format) = (frame.camera.projection, &frame.surface.depth_format);
    let (z_scale, z_offset) = clip_depth(format);
    let near_depth = z_offset + z_scale * f64::from(if format.background > 0.5 { 0.0f32 } else { 1.0 });
    let near = projection.inverse() * DVec4::new(0.0, 0.0, near_depth, 1.0);
    let near_w = if perspective { (projection * (near / near.w)).w * 0.999 } else { 1e-6 };
    let behind = perspective && near.z / near.w >= 0.0;
    // Depth grows away from the eye where this is negative: how [z_z z_1; w_z w_1] turns.
    let turn = projection.z_axis.z * projection.w_axis.w - projection.w_axis.z * projection.z_axis.w;
    let looks_ahead = !perspective || projection.z_axis.w < 0.0;
    if looks_ahead && (turn < 0.0) != (format.background > 0.5) {
        return Err(Error::BadFrame(FrameFault::DepthDirection));
    }
    if !near_w.is_finite() || near_w <= 0.0 || behind {
        return Err(Error::BadFrame(FrameFault::NearPlane));
    }
    Ok(near_w)
}
