//! The papers' frame, laid into any plane, for any place of light and object.

use glam::{DVec2, DVec3};

use super::equations::PaperLight;
use crate::{Light, PlaneFrame};

/// A light nearer to the plane than this, as a fraction of the numbers its height is computed from,
/// lies in it: rounding leaves about 1e-16 of a light meant to.
const IN_THE_PLANE: f64 = 1e-14;

/// Where a light is from a point: the frame that the papers draw on paper. Its origin is the foot of
/// the point on the plane, y runs along the plane's normal on the light's side, and x from the foot
/// of the point towards the foot of the light, so that the light has no z and the point is at
/// (0, d, 0). For a light straight above, x is any direction of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperFrame {
    /// The origin, in coordinates of the plane.
    pub foot: DVec2,
    /// x, a unit vector in coordinates of the plane.
    pub x_axis: DVec2,
    /// z = x × y, likewise.
    pub z_axis: DVec2,
    /// d: the point's distance from the plane, metres; negative for one on the other side than the
    /// light.
    pub d: f64,
    /// 1 if y runs along the plane frame's normal, -1 if against it.
    pub side: f64,
    /// The light: x_i (not negative) and y_i (positive).
    pub light: PaperLight,
}

impl PaperFrame {
    /// The frame of `point` and `light` over the plane of `frame`. `None` if the light lies in the
    /// plane or shines along it, or if a number is not finite.
    pub fn new(frame: &PlaneFrame, light: &Light, point: DVec3) -> Option<Self> {
        let l = light.homogeneous();
        let (to_light, reach) = if l.w == 0.0 {
            (l.truncate().normalize_or_zero(), 1.0)
        } else {
            (l.truncate() - frame.origin, l.truncate().length() + frame.origin.length())
        };
        let height = frame.normal.dot(to_light);
        let side = height.signum();
        let foot = frame.coordinates(point);
        let along = DVec2::new(frame.u.dot(to_light), frame.v.dot(to_light)) - foot * l.w;
        let x_axis = along.normalize_or(DVec2::X);
        let light = PaperLight { x: along.length(), y: height.abs(), w: l.w };
        let d = frame.height(point) * side;
        let usable = light.y > IN_THE_PLANE * reach && light.x.is_finite() && light.y.is_finite();
        let is_finite = foot.is_finite() && d.is_finite() && frame.is_finite();
        let z_axis = -x_axis.perp() * side;
        (usable && is_finite).then_some(Self { foot, x_axis, z_axis, d, side, light })
    }

    /// Coordinates of the plane of a point (x, 0, z) of this frame.
    pub fn on_plane(&self, x: f64, z: f64) -> DVec2 {
        self.foot + self.x_axis * x + self.z_axis * z
    }
}
