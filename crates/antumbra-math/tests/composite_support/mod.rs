//! How far the composite method's shadows are from the exact ones: areas by scan lines, which share
//! nothing with the closed forms of either.
#![allow(dead_code, reason = "each test program and the example use a part")]

use antumbra_math::composite::{CompositeShadow, PartShape};
use antumbra_math::plane_shadow::{Bounds, PlaneFrame, PlaneShadow};
use antumbra_math::{Light, Plane};
use glam::{DVec2, DVec3};

/// Lines across a shadow. Their spacing narrows towards the ends, where widths change like roots: the
/// error is about the square of one over their number.
const LINES: usize = 2000;

/// Points of the exact outline where it bends: an area off by a part of 6.6 over its square.
const POINTS: usize = 4000;

/// The floor y = 0.
pub(crate) fn floor() -> PlaneFrame {
    PlaneFrame::of_plane(&Plane::through(DVec3::ZERO, DVec3::Y)).expect("a plane")
}

/// A light at `distance` from `target`, `angle` degrees from +Y; directional for an infinite distance.
pub(crate) fn light_at(target: DVec3, distance: f64, angle: f64) -> Light {
    let (sin, cos) = angle.to_radians().sin_cos();
    let towards = DVec3::new(sin, cos, 0.0);
    if distance.is_infinite() {
        Light::Directional { direction: -towards }
    } else {
        Light::Point { position: target + towards * distance }
    }
}

/// The area in one of the shadows and not in the other, over the exact shadow's area. `None` where
/// either has none, or the exact one reaches infinity.
pub(crate) fn error(exact: &PlaneShadow, published: &CompositeShadow) -> Option<f64> {
    let (bounds, area) = (exact.bounds()?, exact.area());
    if !bounds.is_finite() || published.is_empty() || !(area > 0.0) {
        return None;
    }
    let outline = exact.outline(POINTS, &Bounds::EVERYTHING);
    let (mut low, mut high) = (bounds.min.y, bounds.max.y);
    for part in published.parts() {
        let (a, b) = extent(&part.shape);
        (low, high) = (low.min(a), high.max(b));
    }
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    let step = std::f64::consts::PI / LINES as f64;
    let line = |i: usize| {
        let t = (i as f64 + 0.5) * step;
        let v = middle - half * t.cos();
        let published: Vec<_> = published.parts().filter_map(|part| part_chord(&part.shape, v)).collect();
        difference(polygon_chord(&outline, v), &published) * t.sin()
    };
    Some((0..LINES).map(line).sum::<f64>() * step * half / area)
}

/// The least and the largest second coordinate.
fn extent(shape: &PartShape) -> (f64, f64) {
    match *shape {
        PartShape::Disc { center, radius } => (center.y - radius, center.y + radius),
        PartShape::Triangle { vertices } => vertices
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| (low.min(p.y), high.max(p.y))),
    }
}

/// Where the line of second coordinate `v` is inside.
fn part_chord(shape: &PartShape, v: f64) -> Option<(f64, f64)> {
    match *shape {
        PartShape::Disc { center, radius } => {
            let square = radius * radius - (v - center.y) * (v - center.y);
            (square > 0.0).then(|| (center.x - square.sqrt(), center.x + square.sqrt()))
        }
        PartShape::Triangle { vertices } => polygon_chord(&vertices, v),
    }
}

/// The same for a convex polygon.
fn polygon_chord(corners: &[DVec2], v: f64) -> Option<(f64, f64)> {
    let next = corners.iter().cycle().skip(1);
    let crossings = corners.iter().zip(next).filter(|(a, b)| (a.y < v) != (b.y < v));
    let at = crossings.map(|(a, b)| a.x + (b.x - a.x) * (v - a.y) / (b.y - a.y));
    let (low, high) = at.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    (low < high).then_some((low, high))
}

/// The length in one of `exact` and the union of `published` and not in the other.
fn difference(exact: Option<(f64, f64)>, published: &[(f64, f64)]) -> f64 {
    let mut ends: Vec<f64> = exact.iter().chain(published).flat_map(|&(a, b)| [a, b]).collect();
    ends.sort_by(f64::total_cmp);
    let within = |x: f64, (a, b): (f64, f64)| a < x && x < b;
    let spans = ends.windows(2).filter(|w| {
        let x = 0.5 * (w[0] + w[1]);
        exact.is_some_and(|e| within(x, e)) != published.iter().any(|&p| within(x, p))
    });
    spans.map(|w| w[1] - w[0]).sum()
}
