//! What a light sees through a window: one face of its map.

use super::bounds::Bounds;
use super::window::{Eye, Window};
use crate::masks::DepthScale;
use antumbra_math::Plane;
use glam::{DMat4, DVec2, DVec3, DVec4, Vec3};

/// One face, in float64.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    /// World to x, y of the face (-1 to 1), depth times w, and w.
    pub(super) clip: DMat4,
    /// Of the middle of a square window.
    middle: DVec2,
    half: f64,
    depth: DepthScale,
    eye: Eye,
}

impl Face {
    pub(super) fn new(eye: &Eye, middle: DVec2, half: f64, depth: DepthScale) -> Self {
        let right = eye.axes.row(0);
        let up = eye.axes.row(1);
        let forward = eye.axes.row(2);
        let at = eye.origin;
        let along = |axis: DVec3| axis.extend(-axis.dot(at));
        let w = if eye.central { along(forward) } else { DVec4::W };
        let z = match depth {
            DepthScale::Central { near } => DVec4::W * near,
            DepthScale::Parallel { near, far } => (DVec4::W * far - along(forward)) / (far - near),
        };
        let rows = [(along(right) - w * middle.x) / half, (along(up) - w * middle.y) / half, z, w];
        let clip = DMat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose();
        Self { clip, middle, half, depth, eye: *eye }
    }

    pub(super) fn middle(&self) -> DVec2 {
        self.middle
    }

    pub(super) fn depth(&self) -> DepthScale {
        self.depth
    }

    /// The nearest and the farthest of a caster, metres along the face's axis.
    pub(super) fn depths(&self, caster: &Bounds) -> (f64, f64) {
        caster.depths(&self.eye)
    }

    /// Whether nothing of a caster is in the window.
    pub(super) fn misses(&self, caster: &Bounds) -> bool {
        let window = Window { low: self.middle - self.half, high: self.middle + self.half };
        caster.window(&self.eye).and_then(|seen| seen.and(window)).is_none()
    }

    /// World to texels of a map in which the face's first texel is `corner` and its side `size` texels.
    pub(super) fn to_texels(self, corner: DVec2, size: f64) -> DMat4 {
        let half = DVec2::splat(0.5 * size);
        let scale = DMat4::from_scale(half.extend(1.0));
        DMat4::from_translation((corner + half).extend(0.0)) * scale * self.clip
    }

    /// The depth of a plane: for a texel to the right, for one up, and at texel (0, 0), as [`Self::to_texels`] counts
    /// them. `None` if the light is in the plane.
    pub(super) fn depth_of_plane(&self, plane: &Plane, corner: DVec2, size: f64) -> Option<Vec3> {
        let to_planes = self.to_texels(corner, size).inverse().transpose();
        let kept = to_planes * plane.normal.extend(-plane.offset);
        let slope = (DVec3::new(kept.x, kept.y, kept.w) / -kept.z).as_vec3();
        slope.is_finite().then_some(slope)
    }

    /// Sides that a circle as large as a caster needs, so that its chords leave the arc by a quarter of a texel.
    pub(super) fn sides(&self, caster: &Bounds, size: f64) -> f64 {
        let distance =
            if self.eye.central { caster.center.distance(self.eye.origin) - caster.radius } else { 1.0 };
        let radius = caster.radius / (distance.max(0.0) * 2.0 * self.half / size);
        // r (1 - cos(π / n)) = 1/4, for large n.
        std::f64::consts::PI * (2.0 * radius).sqrt()
    }

    /// The size of a texel: depth (and more for each unit of depth), metres (and more for each metre of w).
    pub(super) fn texel(&self, size: f64) -> DVec4 {
        let texel = 2.0 * self.half / size;
        match self.depth {
            DepthScale::Central { .. } => DVec4::new(0.0, texel, 0.0, texel),
            DepthScale::Parallel { near, far } => DVec4::new(texel / (far - near), 0.0, texel, 0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn project(face: &Face, p: DVec3) -> DVec3 {
        let q = face.clip * p.extend(1.0);
        q.truncate() / q.w
    }

    #[test]
    fn a_face_shows_its_window() {
        let eye = Eye::along(DVec3::new(1.0, 2.0, 3.0), DVec3::NEG_Y, true);
        let middle = DVec2::new(0.3, -0.2);
        let face = Face::new(&eye, middle, 0.5, DepthScale::Central { near: 0.1 });
        let at = |x: f64, y: f64, z: f64| eye.origin + eye.axes.transpose() * DVec3::new(x * z, y * z, z);
        for distance in [0.1, 1.0, 50.0] {
            let middle = project(&face, at(0.3, -0.2, distance));
            assert!(middle.abs_diff_eq(DVec3::new(0.0, 0.0, 0.1 / distance), 1e-12), "{middle}");
            let corner = project(&face, at(0.8, 0.3, distance));
            assert!(corner.abs_diff_eq(DVec3::new(1.0, 1.0, 0.1 / distance), 1e-12), "{corner}");
        }
        let sun = Eye::along(DVec3::ZERO, DVec3::NEG_Y, false);
        let face = Face::new(&sun, DVec2::ZERO, 2.0, DepthScale::Parallel { near: -5.0, far: 3.0 });
        assert!((project(&face, DVec3::Y * 5.0).z - 1.0).abs() < 1e-12, "the near end");
        assert!(project(&face, DVec3::Y * -3.0).z.abs() < 1e-12, "the far end");
    }

    /// Points of random balls and boxes are in their windows, and the ball's window is tight.
    #[test]
    fn windows_hold_what_they_are_of() {
        let mut random = fastrand::Rng::with_seed(2);
        let mut vector = |size: f64| DVec3::from_array([(); 3].map(|()| (random.f64() * 2.0 - 1.0) * size));
        for i in 0..2000 {
            let forward = vector(1.0).normalize_or(DVec3::X);
            let eye = Eye::along(vector(1.0), forward, i % 3 != 0);
            let (center, radius) = (vector(4.0), vector(1.5).x.abs());
            let window = eye.window_of_ball(center, radius);
            for _ in 0..30 {
                let p = eye.see(center + vector(1.0).normalize_or(DVec3::Y) * radius);
                if eye.central && p.z <= 1e-9 {
                    continue;
                }
                let at = if eye.central { p.truncate() / p.z } else { p.truncate() };
                let window = window.expect("a point is in front");
                let slack = 1e-9 * (1.0 + at.length());
                assert!((at + slack).cmpge(window.low).all(), "{at} is in {window:?}");
                assert!((at - slack).cmple(window.high).all(), "{at} is in {window:?}");
            }
        }
        let eye = Eye::along(DVec3::ZERO, DVec3::Z, true);
        let window = eye.window_of_ball(DVec3::Z * 2.0, 1.0).expect("in front");
        assert!((window.half() - 30f64.to_radians().tan()).abs() < 1e-12, "the cone that touches it");
        assert_eq!(eye.window_of_ball(DVec3::Z * -2.0, 1.0), None, "behind");
        assert_eq!(eye.window_of_points(&[DVec3::NEG_Z]), None, "behind");
        assert_eq!(eye.window_of_points(&[DVec3::NEG_Z, DVec3::Z]), Some(Window::ALL), "through the eye");
    }

    /// Every direction is inside the window of the face that the shader takes.
    #[test]
    fn the_cube_has_the_faces_that_the_shader_takes() {
        let eyes = Eye::cube(DVec3::ZERO);
        let mut random = fastrand::Rng::with_seed(3);
        for _ in 0..2000 {
            let p = DVec3::from_array([(); 3].map(|()| random.f64() * 2.0 - 1.0));
            let seen = eyes[crate::twins::map::map_face(p.as_vec3())].see(p);
            assert!(
                seen.z > 0.0 && seen.truncate().abs().max_element() <= seen.z * (1.0 + 1e-6),
                "{p}: {seen}"
            );
        }
    }
}
