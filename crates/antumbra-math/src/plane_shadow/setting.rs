//! A light over a plane: the projection that casts shadows, in the plane's own coordinates.

use glam::{DVec3, DVec4};

use super::frame::PlaneFrame;
use crate::Light;

/// A light closer to the plane than this, as a fraction of the numbers its height is computed from,
/// lies in it: rounding leaves about 1e-16 of a light meant to.
const IN_THE_PLANE: f64 = 1e-14;

/// Heights within this fraction of an occluder's coordinates are rounding: an occluder that stands
/// on the plane is not cut by it.
const RESTING: f64 = 1e-13;

/// A plane and a light above it. Points are (x, y, h): the frame's coordinates and the height, which
/// is positive on the light's side, whichever side of the frame that is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Setting {
    frame: PlaneFrame,
    /// 1 if the light is on the side of the frame's normal, else -1.
    side: f64,
    /// The light as a homogeneous point, scaled so that its height is 1.
    pub(super) light: DVec4,
}

impl Setting {
    /// `None` if the light lies in the plane (or shines along it), and lights no side of it, or if a
    /// number is not finite.
    pub(super) fn new(frame: &PlaneFrame, light: &Light) -> Option<Self> {
        let l = light.homogeneous();
        let (to_light, reach) = if l.w == 0.0 {
            let direction = l.truncate().normalize_or_zero();
            (direction, direction.length())
        } else {
            (l.truncate() - frame.origin, l.truncate().length() + frame.origin.length())
        };
        let height = frame.normal.dot(to_light);
        let scale = 1.0 / height.abs();
        let light = DVec3::new(frame.u.dot(to_light) * scale, frame.v.dot(to_light) * scale, 1.0);
        let light = light.extend(l.w * scale);
        let usable = height.abs() > IN_THE_PLANE * reach && light.is_finite() && frame.is_finite();
        usable.then_some(Self { frame: *frame, side: height.signum(), light })
    }

    /// The point of space with coordinates 0.
    pub(super) fn origin(&self) -> DVec3 {
        self.frame.origin
    }

    /// A direction of space in the plane's coordinates.
    pub(super) fn direction(&self, d: DVec3) -> DVec3 {
        let f = &self.frame;
        DVec3::new(f.u.dot(d), f.v.dot(d), f.normal.dot(d) * self.side)
    }

    /// A point of space in the plane's coordinates.
    pub(super) fn point(&self, p: DVec3) -> DVec3 {
        self.direction(p - self.frame.origin)
    }

    /// The vector from `p` towards the light, times the light's homogeneous scale.
    pub(super) fn toward_light(&self, p: DVec3) -> DVec3 {
        self.light.truncate() - p * self.light.w
    }

    /// The vector from the light, which must have a position, to `p`, metres.
    pub(super) fn seen_from_light(&self, p: DVec3) -> DVec3 {
        p - self.light.truncate() / self.light.w
    }

    /// The shadow of a point, homogeneous. Its weight is 1 - h / H for a light at height H: zero at
    /// the light's height, negative above. It is the planar projection matrix (p·l) I - l pᵀ.
    pub(super) fn project(&self, p: DVec3) -> DVec3 {
        self.project_direction(p) + DVec3::Z
    }

    /// The change of the shadow with a point that moves along `d`.
    pub(super) fn project_direction(&self, d: DVec3) -> DVec3 {
        let l = self.light;
        DVec3::new(d.x - l.x * d.z, d.y - l.y * d.z, -l.w * d.z)
    }

    /// The height that rounding may leave of a point meant to lie in the plane, on something of this
    /// size at `at`, metres.
    pub(super) fn slack(&self, at: DVec3, size: f64) -> f64 {
        RESTING * (at.length() + size)
    }

    /// The same light over the plane `by` farther down, so that what is meant to stand on the plane
    /// is above it, not cut by it.
    pub(super) fn lowered(&self, by: f64) -> Self {
        let mut lowered = *self;
        lowered.frame.origin -= self.frame.normal * (self.side * by);
        let height = 1.0 + by * self.light.w;
        lowered.light = self.light.with_z(height) / height;
        lowered
    }
}
