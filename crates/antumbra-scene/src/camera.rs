//! The pinhole camera: its axes, matrices and rays.

use glam::{DMat4, DVec3};

use crate::Camera;

/// The sine of the angle between `up` and the line of sight below which `up` gives no direction:
/// the rounding error of the two unit vectors, with six digits left for the axes.
pub(crate) const MIN_UP_SINE: f64 = 1e-6;

impl Camera {
    /// The world-space unit axes of the picture: right, up, and forward (the line of sight).
    ///
    /// Total: where `eye` and `target` coincide (or are not finite) the camera looks along -Z, and
    /// where `up` is parallel to the line of sight the picture's up is any vector across it. Scene
    /// files cannot ask for either.
    pub fn axes(&self) -> (DVec3, DVec3, DVec3) {
        let forward = (self.target - self.eye).try_normalize().unwrap_or(DVec3::NEG_Z);
        let across = self.up.try_normalize().map_or(DVec3::ZERO, |up| forward.cross(up));
        let right = if across.length() < MIN_UP_SINE || !across.is_finite() {
            forward.any_orthonormal_vector()
        } else {
            across.normalize()
        };
        (right, right.cross(forward), forward)
    }

    /// From world space to view space: X right, Y up, the camera looks along -Z.
    pub fn view(&self) -> DMat4 {
        let (_, up, forward) = self.axes();
        glam::dcamera::rh::view::look_to_mat4(self.eye, forward, up)
    }

    /// From view space to OpenGL clip space (NDC z from -1 at `near` to 1 at `far`, y up).
    ///
    /// `aspect` is width over height; `near` and `far` are distances along the line of sight in
    /// metres, 0 < near < far.
    pub fn projection(&self, aspect: f64, near: f64, far: f64) -> DMat4 {
        glam::dcamera::rh::proj::opengl::perspective(self.fov_y, aspect, near, far)
    }

    /// The ray through a point of the picture: its origin (the eye) and unit direction, in world
    /// space.
    ///
    /// `x` and `y` are in pixels from the top left corner of a picture of `width` by `height`; the
    /// centre of pixel (i, j) is (i + 0.5, j + 0.5). Points outside the picture are fine. A picture
    /// without pixels counts as one pixel.
    pub fn ray(&self, x: f64, y: f64, width: u32, height: u32) -> (DVec3, DVec3) {
        let (right, up, forward) = self.axes();
        let (width, height) = (f64::from(width.max(1)), f64::from(height.max(1)));
        let scale = 2.0 * (0.5 * self.fov_y).tan() / height;
        let direction = forward + right * ((x - 0.5 * width) * scale) + up * ((0.5 * height - y) * scale);
        (self.eye, direction.try_normalize().unwrap_or(forward))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        Camera {
            eye: DVec3::new(3.0, 4.0, 5.0),
            target: DVec3::new(-1.0, 0.5, 0.25),
            up: DVec3::new(0.1, 2.0, -0.3),
            fov_y: 0.7,
        }
    }

    #[test]
    fn the_middle_of_the_picture_is_the_target() {
        let c = camera();
        let (origin, direction) = c.ray(320.0, 180.0, 640, 360);
        assert_eq!(origin, c.eye, "a pinhole's rays start at the eye");
        let expected = (c.target - c.eye).normalize();
        assert!((direction - expected).length() < 1e-15, "{direction} is not {expected}");
    }

    #[test]
    fn rays_and_matrices_agree() {
        let c = camera();
        let (width, height) = (640u32, 360u32);
        let clip = c.projection(f64::from(width) / f64::from(height), 0.1, 100.0) * c.view();
        for (x, y) in [(0.5, 0.5), (639.5, 0.5), (17.25, 300.75), (-50.0, 400.0)] {
            let (origin, direction) = c.ray(x, y, width, height);
            let p = clip * (origin + direction * 7.0).extend(1.0);
            let ndc = p.truncate() / p.w;
            let seen_x = (ndc.x + 1.0) * 0.5 * f64::from(width);
            let seen_y = (1.0 - ndc.y) * 0.5 * f64::from(height);
            assert!(
                (seen_x - x).abs() < 1e-9 && (seen_y - y).abs() < 1e-9,
                "({x}, {y}) came back as ({seen_x}, {seen_y})"
            );
            assert!(ndc.z > -1.0 && ndc.z < 1.0, "7 m away lies between 0.1 and 100 m, not at {}", ndc.z);
        }
    }

    #[test]
    fn near_and_far_are_the_ends_of_clip_space() {
        let c = camera();
        let clip = c.projection(1.5, 0.25, 80.0);
        for (distance, z) in [(0.25, -1.0), (80.0, 1.0)] {
            let p = clip * glam::DVec4::new(0.0, 0.0, -distance, 1.0);
            assert!((p.z / p.w - z).abs() < 1e-12, "{distance} m is at {}", p.z / p.w);
        }
    }

    #[test]
    fn axes_are_orthonormal_for_any_camera() {
        let odd = [
            DVec3::ZERO,
            DVec3::Y,
            DVec3::NEG_Y,
            DVec3::splat(f64::NAN),
            DVec3::splat(f64::INFINITY),
            DVec3::X * 1e-300,
        ];
        for eye in odd {
            for target in odd {
                for up in odd {
                    let c = Camera { eye, target, up, fov_y: 0.8 };
                    let (r, u, f) = c.axes();
                    for (a, b, dot) in
                        [(r, r, 1.0), (u, u, 1.0), (f, f, 1.0), (r, u, 0.0), (u, f, 0.0), (f, r, 0.0)]
                    {
                        assert!((a.dot(b) - dot).abs() < 1e-12, "{c:?} has the axes {r} {u} {f}");
                    }
                    let (_, direction) = c.ray(1.0, 2.0, 0, 0);
                    assert!((direction.length() - 1.0).abs() < 1e-12, "{c:?} sees along {direction}");
                }
            }
        }
    }
}
