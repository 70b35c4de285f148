//! One polygon of a shadow volume: for which points it lies between them and the eye.

use crate::screen::View;
use glam::{DVec3, DVec4};

/// A polygon whose projection is thinner than this, in pixels, is seen edge-on: where it lies in depth is taken
/// from a chord and not from its plane. It is sixteen steps of the grid that rasterisers snap corners to (1/256 of
/// a pixel), so that snapping moves what is left to planes by a sixteenth of their own extent at most. A chord is
/// wrong by the polygon's thickness at most: a sixteenth of a pixel.
const EDGE_ON: f64 = 1.0 / 16.0;

/// Where the picture is seen from, view space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Eye {
    /// The origin and 1, or, where sight is parallel, the direction +Z and 0.
    pub(super) place: DVec4,
    /// The z of the near plane.
    pub(super) near: f64,
    /// Size of a pixel at distance one, or in metres.
    pixel: f64,
    /// How far sight reaches: where it is parallel, what the depth buffer spans.
    depth: f64,
}

impl Eye {
    pub(super) fn new(view: &View, zero_to_one: bool) -> Self {
        let numbers = &view.surface;
        let background = f64::from(numbers.background_depth[0]);
        let ndc = |depth: f64| if zero_to_one { depth } else { 2.0 * depth - 1.0 };
        let inverse = view.projection.inverse();
        let z = |depth: f64| {
            let p = inverse * DVec4::new(0.0, 0.0, ndc(depth), 1.0);
            p.z / p.w
        };
        let near = z(if background > 0.5 { 0.0 } else { 1.0 });
        Self {
            place: view.eye_vs(),
            near,
            pixel: f64::from(numbers.pixel_step[0].min(numbers.pixel_step[1])),
            depth: if view.is_perspective() { f64::INFINITY } else { (near - z(background)).abs() },
        }
    }

    /// Sight from the origin, with pixels of this size at distance one.
    #[cfg(test)]
    pub(super) fn perspective(near: f64, pixel: f64) -> Self {
        Self { place: DVec4::W, near: -near, pixel, depth: f64::INFINITY }
    }

    /// Parallel sight, with pixels of this size in metres.
    #[cfg(test)]
    pub(super) fn parallel(near: f64, depth: f64, pixel: f64) -> Self {
        Self { place: DVec4::Z, near, pixel, depth }
    }

    pub(super) fn is_perspective(&self) -> bool {
        self.place.w != 0.0
    }

    /// The value of a plane at the eye; at an eye infinitely far away, that of its direction.
    fn height(&self, normal: DVec3, offset: f64) -> f64 {
        normal.dot(self.place.truncate()) - offset * self.place.w
    }

    /// Whether b lies beside a counter-clockwise (above zero) or clockwise as the eye turns in the plane of `normal`.
    fn turn(&self, normal: DVec3, a: DVec4, b: DVec4) -> f64 {
        if self.is_perspective() {
            normal.dot(a.truncate().cross(b.truncate()))
        } else {
            normal.dot(self.place.truncate().cross(b.truncate() * a.w - a.truncate() * b.w))
        }
    }
}

/// Which points a polygon is in front of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Front {
    /// Those with plane·(p, 1) > 0.
    Of(DVec4),
    /// None: it is infinitely far away.
    Nothing,
    /// The eye is on the polygon, whose plane this is.
    Touching(DVec4),
}

/// A polygon's plane, or what serves instead: the corners are those of a convex polygon with the unit `normal`,
/// through `point`; those with w = 0 are infinitely far away.
pub(super) fn front(eye: &Eye, corners: &[DVec4], normal: DVec3, point: DVec3) -> Front {
    let offset = normal.dot(point);
    let height = eye.height(normal, offset);
    let side = if height > 0.0 { -1.0 } else { 1.0 };
    let own = (normal * side).extend(-offset * side);
    if !is_edge_on(eye, corners, normal, height) {
        return Front::Of(own);
    }
    // In the polygon's plane it is seen between two of its corners. What is in front of their chord, inside the
    // polygon, is in front of the polygon or so near to it that the pixel sees both.
    let is_end = |i: usize, sign: f64| {
        let a = corners[i];
        corners.iter().all(|&b| sign * eye.turn(normal, a, b) >= -1e-12 * a.length() * b.length())
    };
    let end = |sign| (0..corners.len()).find(|&i| is_end(i, sign));
    let (Some(first), Some(last)) = (end(1.0), end(-1.0)) else { return Front::Touching(own) };
    let (a, b) = (corners[first], corners[last]);
    let (a, b) = if a.w != 0.0 { (a, b) } else { (b, a) };
    if a.w == 0.0 {
        return Front::Nothing;
    }
    let chord = b.truncate() * a.w - a.truncate() * b.w;
    let Some(across) = normal.cross(chord).try_normalize() else { return Front::Touching(own) };
    let offset = across.dot(a.truncate() / a.w);
    let height = eye.height(across, offset);
    if height == 0.0 {
        return Front::Touching(own);
    }
    Front::Of((across * -height.signum()).extend(offset * height.signum()))
}

/// Whether the polygon's projection is a line, as far as rasterisers can tell.
fn is_edge_on(eye: &Eye, corners: &[DVec4], normal: DVec3, height: f64) -> bool {
    let pixels = EDGE_ON * eye.pixel;
    if !eye.is_perspective() {
        return height.abs() * eye.depth < pixels;
    }
    let finite = || corners.iter().filter(|c| c.w != 0.0).map(|c| c.truncate() / c.w);
    let nearest = finite().map(|p| p.length()).fold(f64::INFINITY, f64::min);
    // Of a polygon at infinity nothing is known, and nothing is asked.
    if !nearest.is_finite() || height.abs() >= pixels * nearest {
        return false;
    }
    height.abs() < pixels * distance(eye, corners, normal, height).max(1e-6 * nearest)
}

/// The eye's distance from a convex polygon.
fn distance(eye: &Eye, corners: &[DVec4], normal: DVec3, height: f64) -> f64 {
    let next = |i: usize| corners[(i + 1) % corners.len()];
    let turns = || corners.iter().enumerate().map(|(i, &c)| eye.turn(normal, c, next(i)));
    if turns().all(|t| t >= 0.0) || turns().all(|t| t <= 0.0) {
        return height.abs();
    }
    let side = |(i, &a): (usize, &DVec4)| {
        let (a, b) = if a.w != 0.0 { (a, next(i)) } else { (next(i), a) };
        if a.w == 0.0 {
            return f64::INFINITY;
        }
        let from = a.truncate() / a.w;
        let along = if b.w != 0.0 { b.truncate() / b.w - from } else { b.truncate() };
        let most = if b.w != 0.0 { 1.0 } else { f64::INFINITY };
        let share = (-from.dot(along) / along.length_squared().max(1e-300)).clamp(0.0, most);
        (from + along * share).length()
    };
    corners.iter().enumerate().map(side).fold(f64::INFINITY, f64::min)
}
