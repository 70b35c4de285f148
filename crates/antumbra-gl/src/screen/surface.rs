//! The host's surface in the numbers that `surface.glsl` reads.

use crate::input::{DepthFormat, Frame, NormalSpace, Surface};
use glam::{DMat3, DMat4, DVec3, Mat3, Mat4};

/// How texels become points and normals of view space.
pub(crate) struct SurfaceNumbers {
    /// Window (x, y, depth - background depth, 1) to view space.
    pub(crate) unproject: Mat4,
    /// Size of a pixel at distance one or in metres, 1 for perspective, size of a footprint in pixels.
    pub(crate) pixel_step: [f32; 4],
    /// The depth of the background, and the step of the depth buffer: a part that is the same at every
    /// depth, and one in proportion to it.
    pub(crate) background_depth: [f32; 3],
    /// The host's normals to view space.
    pub(crate) normal_to_view: Mat3,
    /// Scale and offset.
    pub(crate) normal_decode: [f32; 2],
}

impl SurfaceNumbers {
    /// Of a frame whose projection can be inverted.
    pub(super) fn new(frame: &Frame<'_>, perspective: bool) -> Self {
        let (surface, projection) = (&frame.surface, frame.camera.projection);
        let [_, _, width, height] = frame.viewport.map(f64::from);
        // Each of a pixel's samples stands for a part of it: the footprints are as much smaller.
        let footprint = (f64::from(surface.samples)).sqrt().recip();
        let (normal_to_view, normal_decode) = normals(surface, DMat3::from_mat4(frame.camera.view));
        Self {
            unproject: (projection.inverse() * window_to_clip(frame)).as_mat4(),
            pixel_step: [
                (2.0 / (width * projection.x_axis.x.abs())) as f32,
                (2.0 / (height * projection.y_axis.y.abs())) as f32,
                if perspective { 1.0 } else { 0.0 },
                footprint as f32,
            ],
            background_depth: background_depth(&surface.depth_format),
            normal_to_view,
            normal_decode,
        }
    }
}

/// Depth in the buffer to clip space: scale and offset.
pub(super) fn clip_depth(format: &DepthFormat) -> (f64, f64) {
    if format.zero_to_one { (1.0, 0.0) } else { (2.0, -1.0) }
}

/// Window to clip space. Depth is counted from the background's, which float32 holds exactly, so that the far end of
/// the buffer keeps all its digits.
fn window_to_clip(frame: &Frame<'_>) -> DMat4 {
    let format = &frame.surface.depth_format;
    let [x, y, width, height] = frame.viewport.map(f64::from);
    let (z_scale, z_offset) = clip_depth(format);
    let corner = DVec3::new(
        -1.0 - 2.0 * x / width,
        -1.0 - 2.0 * y / height,
        z_offset + z_scale * f64::from(format.background),
    );
    DMat4::from_translation(corner) * DMat4::from_scale(DVec3::new(2.0 / width, 2.0 / height, z_scale))
}

fn background_depth(format: &DepthFormat) -> [f32; 3] {
    let step = 0.5f32.powi(format.bits.min(32) as i32);
    if format.float { [format.background, 0.0, step] } else { [format.background, step, 0.0] }
}

/// To view space, scale and offset; nothing in particular for a surface without normals.
fn normals(surface: &Surface, rotation: DMat3) -> (Mat3, [f32; 2]) {
    let Some(normals) = surface.normals else { return (Mat3::IDENTITY, [0.0; 2]) };
    let to_view = match normals.space {
        NormalSpace::World => rotation.as_mat3(),
        NormalSpace::View => Mat3::IDENTITY,
    };
    (to_view, if normals.biased { [2.0, -1.0] } else { [1.0, 0.0] })
}
