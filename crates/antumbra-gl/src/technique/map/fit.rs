//! Fits a light's map to what casts shadows and to what is seen.

use super::Options;
use super::bounds::{Bounds, Surroundings};
use super::face::Face;
use super::window::{Eye, Window};
use crate::masks::DepthScale;
use antumbra_math::{Light, Plane};
use glam::{DVec2, DVec3};

/// Half-angle of the widest spot that one perspective picture does for, radians: 60 degrees. Wider ones have the six
/// faces of a point light, because the texels of one picture would grow beyond bounds (at 90 degrees it has none).
const WIDEST_SPOT: f64 = std::f64::consts::FRAC_PI_3;

/// The near end of a perspective face, as a share of the farthest caster's distance. What is nearer to the light is
/// cut off. A float keeps its digits at any distance, so this need not be fitted.
const NEAR: f64 = 1e-4;

/// The depth of a parallel map for infinite planes, in sizes of what else is in it.
const DEEPEST: f64 = 64.0;

/// Sizes of windows are rounded up to 2^(n / 4): what moves a little changes no size, and edges keep still.
const STEPS: f64 = 4.0;

/// A light's faces.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    /// Where float32 is at its best: the light's position, or the middle of a directional light's map.
    pub(super) origin: DVec3,
    /// The faces with something in them; of a light without a cube the first alone.
    pub(super) faces: [Option<Face>; 6],
    /// Any of the faces: all have texels of one size.
    pub(super) some_face: Face,
    pub(super) cube: bool,
    /// Depth times w.
    pub(super) near: f64,
    /// The distance of the nearest caster, or less; not zero.
    pub(super) nearest: f64,
}

/// Texels that a filter reaches beyond its middle, and the slack of windows that keep to a grid of texels.
pub(super) fn margin(options: &Options) -> f64 {
    let radius = radius(options);
    (radius.ceil() + 2.0).min(f64::from(options.size) * 0.25)
}

/// The radius of the filter in texels: an eighth of the map at most.
pub(super) fn radius(options: &Options) -> f64 {
    match options.filter {
        super::Filter::None => 0.0,
        _ => f64::from(options.radius).min(f64::from(options.size) * 0.125),
    }
}

impl Fit {
    /// The faces for a light; `None` if nothing in sight is in its shadow. `soft`: its penumbrae are wider than the
    /// filter, so that what is seen says nothing about where blockers are.
    pub(super) fn new(
        light: &Light,
        around: &Surroundings,
        planes: &[Plane],
        options: &Options,
        soft: bool,
    ) -> Option<Self> {
        let (eyes, limit, cube) = eyes(light)?;
        let size = f64::from(options.size);
        let inner = size - 2.0 * margin(options);
        // A face shows as much beyond its border as a filter at the border reads.
        let limit = Window::square(limit * if cube { size / inner } else { 1.0 });
        let eyes = if cube { &eyes[..] } else { &eyes[..1] };
        let mut windows = [None; 6];
        for (window, eye) in windows.iter_mut().zip(eyes) {
            let of_casters = around.casters.iter().filter_map(|caster| caster.window(eye)?.and(limit));
            let mut casters = of_casters.reduce(Window::or);
            if !planes.is_empty() {
                // Beyond the border of a directional light's map planes go on in closed form.
                let seen = if eye.central { Some(limit) } else { everything_seen(around, eye) };
                casters = seen.or(casters).or(Some(Window::square(1.0)));
            }
            *window = if soft { casters } else { casters.and_then(|window| seen_part(window, around, eye)) };
        }
        let half = windows.iter().flatten().map(Window::half).reduce(f64::max)?;
        let scale = windows.iter().flatten().map(|w| w.middle().length()).fold(half, f64::max);
        // A map of a thing without extent still has texels that float32 can tell apart.
        let wanted = half.max(scale * 1e-5).max(1e-12) * size / inner;
        let steps = (wanted.log2() * STEPS).ceil() / STEPS;
        let whole = limit.half() * if cube { 1.0 } else { size / inner };
        let half = steps.exp2().min(whole);
        if !half.is_finite() {
            return None;
        }
        let texel = 2.0 * half / size;
        let (nearest, farthest) = distances(&around.casters, planes, light);
        let depth = match light {
            Light::Directional { .. } => {
                let middle = windows[0]?.middle();
                // The middle keeps to the grid of texels.
                let shown = Window { low: middle - (half + texel), high: middle + (half + texel) };
                depth_range(&around.casters, planes, &eyes[0], shown)?
            }
            _ => DepthScale::Central { near: (NEAR * farthest).max(1e-20) },
        };
        let face = |(window, eye): (&Option<Window>, &Eye)| {
            let middle = (*window)?.middle();
            let middle = if half == whole { DVec2::ZERO } else { (middle / texel).round() * texel };
            Some(Face::new(eye, middle, half, depth))
        };
        let mut faces = [None; 6];
        faces.iter_mut().zip(windows.iter().zip(eyes).map(face)).for_each(|(to, face)| *to = face);
        let some_face = faces.iter().flatten().next().copied()?;
        let (origin, near) = match (light, depth) {
            (Light::Directional { .. }, DepthScale::Parallel { near, far }) => {
                let middle = some_face.middle().extend(0.5 * near + 0.5 * far);
                (eyes[0].axes.transpose() * middle, 1.0)
            }
            (_, DepthScale::Central { near }) => (eyes[0].origin, near),
            _ => return None,
        };
        Some(Self { origin, faces, some_face, cube, near, nearest })
    }
}

/// The ways a light looks, how far from the axis, and whether that is a cube. `None` for a light that is nowhere.
fn eyes(light: &Light) -> Option<([Eye; 6], f64, bool)> {
    match *light {
        Light::Point { position } if position.is_finite() => Some((Eye::cube(position), 1.0, true)),
        Light::Spot { position, direction, outer_angle } if position.is_finite() && is_unit(direction) => {
            if outer_angle > WIDEST_SPOT {
                return Some((Eye::cube(position), 1.0, true));
            }
            Some(([Eye::along(position, direction, true); 6], outer_angle.tan().max(1e-6), false))
        }
        Light::Directional { direction } if is_unit(direction) => {
            Some(([Eye::along(DVec3::ZERO, direction, false); 6], f64::INFINITY, false))
        }
        _ => None,
    }
}

fn is_unit(direction: DVec3) -> bool {
    (direction.length() - 1.0).abs() < 1e-3
}

/// The part of a window in which something is seen.
fn seen_part(window: Window, around: &Surroundings, eye: &Eye) -> Option<Window> {
    around.seen.iter().try_fold(window, |window, points| window.and(eye.window_of_points(points)?))
}

/// A window that holds everything seen; `None` if that has no end.
fn everything_seen(around: &Surroundings, eye: &Eye) -> Option<Window> {
    around
        .seen
        .iter()
        .try_fold(Window::ALL, |window, points| window.and(eye.window_of_points(points)?))
        .filter(|window| window.low.is_finite() && window.high.is_finite())
}

/// The distances of the nearest and of the farthest caster from a light, both above zero.
fn distances(casters: &[Bounds], planes: &[Plane], light: &Light) -> (f64, f64) {
    let at = light.homogeneous().truncate();
    let ends = casters.iter().map(|c| (c.distance(at), c.center.distance(at) + c.radius));
    let planes = planes.iter().map(|plane| (plane.height(at).abs(), plane.height(at).abs()));
    let (nearest, farthest) =
        ends.chain(planes).fold((f64::INFINITY, 0.0), |(n, f), (near, far)| (near.min(n), far.max(f)));
    (nearest.max(1e-3 * farthest), farthest)
}

/// The depth of a directional light's map: all casters, and of planes what is in the window, as far as the map is not
/// much deeper than wide for it.
fn depth_range(casters: &[Bounds], planes: &[Plane], eye: &Eye, window: Window) -> Option<DepthScale> {
    let mut range = casters
        .iter()
        .map(|caster| caster.depths(eye))
        .reduce(|(a, b), (near, far)| (near.min(a), far.max(b)));
    let reach = window.half() + range.map_or(0.0, |(near, far)| far - near);
    for plane in planes {
        let normal = eye.axes * plane.normal;
        let corners = [window.low, DVec2::new(window.low.x, window.high.y), window.high];
        let corners = corners.into_iter().chain([DVec2::new(window.high.x, window.low.y)]);
        let middle = (plane.offset - normal.truncate().dot(window.middle())) / normal.z;
        for corner in corners {
            let depth = (plane.offset - normal.truncate().dot(corner)) / normal.z;
            if depth.is_finite() {
                let base = range.map_or(middle, |(near, far)| 0.5 * near + 0.5 * far);
                let depth = depth.clamp(base - DEEPEST * reach, base + DEEPEST * reach);
                range = Some(range.map_or((depth, depth), |(near, far)| (near.min(depth), far.max(depth))));
            }
        }
    }
    let (near, far) = range?;
    // A flat caster that faces the light has no depth of its own.
    let slack =
        (1e-3 * (far - near)).max(1e-3 * window.half()).max(1e-6 * near.abs().max(far.abs())).max(1e-12);
    Some(DepthScale::Parallel { near: near - slack, far: far + slack })
}
