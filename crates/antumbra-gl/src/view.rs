//! The host's camera and surface in the numbers that the shaders use.

use crate::frame::{Frame, NormalSpace};
use crate::{Caps, Error};
use glam::{DMat3, DMat4, DVec2, DVec3, DVec4, Mat3, Mat4};

/// Everything about a frame but its lights and occluders.
pub(crate) struct View {
    /// World to view space.
    pub(crate) view: DMat4,
    /// View to clip space.
    pub(crate) projection: DMat4,
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
    /// Clip-space w in front of which nothing is drawn.
    pub(crate) near_w: f64,
    /// x, y, width, height.
    pub(crate) viewport: [i32; 4],
}

impl View {
    /// The viewport's size, pixels.
    pub(crate) fn size(&self) -> DVec2 {
        DVec2::new(f64::from(self.viewport[2]), f64::from(self.viewport[3]))
    }

    /// Checks the frame and prepares its numbers.
    pub(crate) fn new(frame: &Frame<'_>, caps: &Caps) -> Result<Self, Error> {
        let (view, projection) = (frame.camera.view, frame.camera.projection);
        if !view.is_finite() || !projection.is_finite() {
            return Err(Error::BadFrame("the camera's matrices are not finite"));
        }
        let rotation = DMat3::from_mat4(view);
        if !(rotation * rotation.transpose()).abs_diff_eq(DMat3::IDENTITY, 1e-4) || view.row(3) != DVec4::W {
            return Err(Error::BadFrame("the view matrix is more than a rotation and a translation"));
        }
        let determinant = projection.determinant();
        if determinant == 0.0 {
            return Err(Error::BadFrame("the projection matrix cannot be inverted"));
        }
        let [x, y, width, height] = frame.viewport;
        let limit = caps.max_texture_size as i32;
        if width <= 0 || height <= 0 || width > limit || height > limit || x < 0 || y < 0 {
            return Err(Error::BadFrame(
                "the viewport is empty, negative or larger than the driver's textures",
            ));
        }
        let surface = &frame.surface;
        if surface.samples == 0 {
            return Err(Error::BadFrame("the surface has no samples; plain textures have 1"));
        }
        for (index, light) in frame.lights.iter().enumerate() {
            if let Some(reason) = light.fault() {
                return Err(Error::BadLight { index, reason });
            }
        }
        let mut ids = frame.occluders.iter().map(|o| o.id).chain(frame.meshes.iter().map(|m| m.id));
        if ids.any(|id| id >= crate::NO_SHADOW) {
            return Err(Error::BadFrame("an occluder's id is not below NO_SHADOW"));
        }
        let places = |m: &DMat4| m.is_finite() && m.row(3) == DVec4::W && m.determinant() != 0.0;
        if !frame.meshes.iter().all(|mesh| places(&mesh.model)) {
            return Err(Error::BadFrame("a mesh's model matrix is not affine, not finite, or flat"));
        }
        if !frame.ambient.is_finite() || frame.ambient.min_element() < 0.0 {
            return Err(Error::BadFrame("the ambient light is negative or not finite"));
        }

        // Window to clip space. Depth is counted from the background's, which float32 holds
        // exactly, so that the far end of the buffer keeps all its digits.
        let format = &surface.depth_format;
        let (width, height) = (f64::from(width), f64::from(height));
        let (z_scale, z_offset) = if format.zero_to_one { (1.0, 0.0) } else { (2.0, -1.0) };
        let window_to_clip = DMat4::from_translation(DVec3::new(
            -1.0 - 2.0 * f64::from(x) / width,
            -1.0 - 2.0 * f64::from(y) / height,
            z_offset + z_scale * f64::from(format.background),
        )) * DMat4::from_scale(DVec3::new(2.0 / width, 2.0 / height, z_scale));
        let inverse = projection.inverse();
        let perspective = projection.row(3) != DVec4::W;
        let near_depth = z_offset + z_scale * f64::from(if format.background > 0.5 { 0.0f32 } else { 1.0 });
        let near = inverse * DVec4::new(0.0, 0.0, near_depth, 1.0);
        let near_w = if perspective { (projection * (near / near.w)).w * 0.999 } else { 1e-6 };
        let behind = perspective && near.z / near.w >= 0.0;
        if !near_w.is_finite() || near_w <= 0.0 || behind {
            return Err(Error::BadFrame("the projection matrix has its near plane behind the eye"));
        }
        // Each of a pixel's samples stands for a part of it: the footprints are as much smaller.
        let footprint = (f64::from(surface.samples)).sqrt().recip();
        let (normal_to_view, normal_decode) = match surface.normals {
            None => (Mat3::IDENTITY, [0.0; 2]),
            Some(normals) => {
                let to_view = match normals.space {
                    NormalSpace::World => rotation.as_mat3(),
                    NormalSpace::View => Mat3::IDENTITY,
                };
                (to_view, if normals.biased { [2.0, -1.0] } else { [1.0, 0.0] })
            }
        };
        let step = 0.5f32.powi(format.bits.min(32) as i32);
        Ok(Self {
            view,
            projection,
            unproject: (inverse * window_to_clip).as_mat4(),
            pixel_step: [
                (2.0 / (width * projection.x_axis.x.abs())) as f32,
                (2.0 / (height * projection.y_axis.y.abs())) as f32,
                if perspective { 1.0 } else { 0.0 },
                footprint as f32,
            ],
            background_depth: if format.float {
                [format.background, 0.0, step]
            } else {
                [format.background, step, 0.0]
            },
            normal_to_view,
            normal_decode,
            near_w,
            viewport: frame.viewport,
        })
    }
}
