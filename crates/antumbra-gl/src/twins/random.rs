//! Numbers, shapes and lights to call functions with.

use antumbra_math::blocking::Footprint;
use antumbra_math::{Cone, Disc, Rectangle, Shape, Sphere, Triangle};
use glam::{DVec3, Vec3, Vec4};

/// The same ones each time.
pub(super) struct Random(pub(super) fastrand::Rng);

impl Random {
    pub(super) fn new() -> Self {
        Self(fastrand::Rng::with_seed(7))
    }

    pub(super) fn within(&mut self, low: f64, high: f64) -> f64 {
        low + self.0.f64() * (high - low)
    }

    pub(super) fn vector(&mut self, size: f64) -> DVec3 {
        DVec3::from_array([(); 3].map(|()| self.within(-size, size)))
    }

    pub(super) fn unit(&mut self) -> DVec3 {
        self.vector(1.0).try_normalize().unwrap_or(DVec3::Y)
    }

    /// Small, zero now and then.
    pub(super) fn small(&mut self) -> f64 {
        if self.0.u32(..16) == 0 { 0.0 } else { self.within(-1.0, 1.0) * 10f64.powi(self.0.i32(-3..1)) }
    }

    pub(super) fn light(&mut self) -> antumbra_math::Light {
        match self.0.u32(..3) {
            0 => antumbra_math::Light::Directional { direction: self.unit() },
            _ => antumbra_math::Light::Point { position: self.vector(8.0) },
        }
    }

    pub(super) fn shape(&mut self) -> Shape {
        let (center, axis, size) = (self.vector(3.0), self.unit(), self.within(0.1, 2.0));
        match self.0.u32(..5) {
            0 => Sphere { center, radius: size }.into(),
            1 => Disc { center, normal: axis, radius: size }.into(),
            2 => Triangle { vertices: [center, center + self.vector(2.0), center + self.vector(2.0)] }.into(),
            3 => Cone { base_center: center, axis, radius: size, height: self.within(0.1, 2.0) }.into(),
            _ => {
                let right = axis.any_orthonormal_vector();
                Rectangle { center, half_right: right * size, half_forward: axis.cross(right) * 0.5 }.into()
            }
        }
    }

    /// A patch at `point`; a point without extent now and then.
    pub(super) fn footprint(&mut self, point: DVec3) -> Footprint<Vec3> {
        let size = [0.0, 0.02, 0.1, 0.5][self.0.usize(..4)];
        let (dx, dy) = (self.vector(size).as_vec3(), self.vector(size).as_vec3());
        Footprint { point: point.as_vec3(), dx, dy }
    }
}

/// A footprint as shaders read it.
pub(super) fn footprint_texels(f: &Footprint<Vec3>) -> [Vec4; 3] {
    [f.point, f.dx, f.dy].map(|v| v.extend(0.0))
}
