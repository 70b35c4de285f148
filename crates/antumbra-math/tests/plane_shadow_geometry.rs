//! The geometry of shadows on planes against rays and against each other: outlines lie on the true
//! edge, areas are what counting gives, bounds are tight, equations and axes describe the outline.

mod plane_shadow_support;

use antumbra_math::plane_shadow::{Bounds, PlaneShadow, ShadowKind};
use glam::DVec2;
use plane_shadow_support::settings::{Setting, setting};
use plane_shadow_support::{Random, blocked, grown, moved};

/// A random shadow with an area, and the window to look at it through.
fn shadows(seed: u64, count: usize) -> impl Iterator<Item = (Setting, PlaneShadow, Bounds)> {
    let mut random = Random(seed);
    let drawn = move |i: usize| {
        let setting = setting(&mut random, i % 5);
        let shadow = PlaneShadow::cast(&setting.occluder, &setting.light, &setting.frame);
        let bounds = shadow.bounds()?;
        let near = bounds.min.max(bounds.max.min(DVec2::ZERO));
        let window = Bounds::around(near, random.decades(0.0, 1.5) * setting.size);
        let kept = !matches!(shadow.kind(), ShadowKind::Segment | ShadowKind::Everything);
        // Farther away than this the world's coordinates are too coarse to say where a ray goes.
        let coarse = near.length() > 1e3 * setting.size + 100.0;
        (kept && !coarse).then_some((setting, shadow, window))
    };
    (0..count).filter_map(drawn)
}

/// Twice the signed area of a polygon's corners, and its centroid's stand-in, their mean.
fn shoelace(points: &[DVec2]) -> (f64, DVec2) {
    let mean = points.iter().sum::<DVec2>() / points.len() as f64;
    let next = points.iter().cycle().skip(1);
    let area = points.iter().zip(next).map(|(&a, &b)| 0.5 * (a - mean).perp_dot(b - mean)).sum();
    (area, mean)
}

/// Where a change by this fraction of the occluder's size changes what the ray says, rounding decides.
const EDGE: f64 = 1e-8;

/// A step of this fraction of the way from an outline point to the middle of the shadow, and as far
/// the other way, crosses the edge.
const STEP: f64 = 1e-5;

#[test]
fn outlines_lie_on_the_true_edge() {
    let mut decided = 0;
    for (Setting { occluder, light, frame, size }, shadow, window) in shadows(11, 30_000) {
        let outline = shadow.outline(48, &window);
        if outline.len() < 3 {
            continue;
        }
        let (area, middle) = shoelace(&outline);
        let longest = outline.iter().map(|p| p.distance(middle)).fold(0.0, f64::max);
        assert!(area >= -1e-12 * longest * longest, "counterclockwise: {area} {occluder:?} {light:?}");
        if area < 1e-4 * longest * longest {
            // So thin that a step along it is rounding across it.
            continue;
        }
        let (larger, smaller) = (grown(&occluder, EDGE * size), grown(&occluder, -EDGE * size));
        let truth = |point: DVec2| {
            let at = frame.point(point);
            let truth = blocked(&occluder, &light, at);
            let lift = frame.normal * (EDGE * size);
            let step = plane_shadow_support::normal(&occluder) * (EDGE * size);
            let sure = [
                blocked(&occluder, &light, at + step),
                blocked(&occluder, &light, at - step),
                blocked(&occluder, &moved(&light, step), at),
                blocked(&occluder, &moved(&light, -step), at),
                blocked(&larger, &light, at),
                blocked(&smaller, &light, at),
                blocked(&occluder, &light, at + lift),
                blocked(&occluder, &light, at - lift),
            ];
            sure.iter().all(|&answer| answer == truth).then_some(truth)
        };
        for &point in &outline {
            let step = (point - middle) * STEP;
            if let Some(dark) = truth(point - step) {
                decided += 1;
                assert!(dark, "inside at {point} of {shadow:?}: {occluder:?} {light:?} {frame:?}");
            }
            // The window's own sides are no edges of the shadow.
            let margin = (point - window.min).min(window.max - point).min_element();
            if margin > EDGE * size
                && let Some(dark) = truth(point + step)
            {
                decided += 1;
                assert!(!dark, "outside at {point} of {shadow:?}: {occluder:?} {light:?} {frame:?}");
            }
        }
    }
    assert!(decided > 1_000_000, "a million steps over the edge: {decided}");
}

#[test]
fn areas_are_what_counting_gives() {
    /// Rays along each side of the box that is counted.
    const GRID: u32 = 120;
    let mut counted = 0;
    for (Setting { occluder, light, frame, .. }, shadow, window) in shadows(12, 1500) {
        let part = shadow.clipped(&window);
        let Some(bounds) = part.bounds() else { continue };
        let cell = (bounds.max - bounds.min) / f64::from(GRID);
        let is_dark = |i: u32| {
            let at = DVec2::new(f64::from(i % GRID) + 0.5, f64::from(i / GRID) + 0.5);
            blocked(&occluder, &light, frame.point(bounds.min + cell * at))
        };
        let dark = (0..GRID * GRID).filter(|&i| is_dark(i)).count();
        let fraction = dark as f64 / f64::from(GRID * GRID);
        let error = part.area() / bounds.area() - fraction;
        counted += 1;
        // A convex edge crosses at most 4 GRID cells, of which the rule of centres gets the sum wrong
        // by less than half of them in the worst case (an edge along the cells), 2 / GRID.
        assert!(error.abs() < 2.0 / f64::from(GRID), "{error} {fraction} {part:?}: {occluder:?} {light:?}");
    }
    assert!(counted > 1000, "enough shadows: {counted}");
}

#[test]
fn area_and_bounds_are_those_of_a_fine_outline() {
    const POINTS: usize = 20_000;
    let mut compared = 0;
    for (_, shadow, window) in shadows(13, 1500) {
        let part = shadow.clipped(&window);
        let (Some(bounds), fine) = (part.bounds(), part.outline(POINTS, &window)) else { continue };
        if fine.len() < 3 {
            continue;
        }
        compared += 1;
        let size = bounds.max - bounds.min;
        // Chords of a 20,000th of the length lose the square of that; arcs whose points are not
        // evenly spread lose more, and never a thousand times as much.
        let (area, _) = shoelace(&fine);
        let error = (part.area() - area) / bounds.area();
        assert!(error > -1e-9 && error < 1e-5, "area {error}: {part:?}");
        let min = fine.iter().copied().reduce(DVec2::min).expect("points");
        let max = fine.iter().copied().reduce(DVec2::max).expect("points");
        let gaps = [(min - bounds.min) / size, (bounds.max - max) / size];
        for gap in gaps.iter().flat_map(|gap| gap.to_array()) {
            assert!(gap > -1e-9 && gap < 1e-5, "bounds {gaps:?}: {part:?}");
        }
    }
    assert!(compared > 1000, "enough shadows: {compared}");
}

#[test]
fn equations_and_axes_describe_the_outline() {
    let mut compared = [0; 3];
    for (_, shadow, window) in shadows(14, 20_000) {
        let Some(conic) = shadow.conic() else { continue };
        let outline = shadow.outline(16, &window);
        for &point in &outline {
            // The value at the point against what it would be if all of its terms were positive.
            let p = point.abs().extend(1.0);
            let m = conic.matrix.to_cols_array().map(f64::abs);
            let terms = p.dot(glam::DMat3::from_cols_array(&m) * p);
            let margin = (point - window.min).min(window.max - point).min_element();
            let value = conic.value(point) / terms;
            assert!(value < 1e-9, "{point} is not outside: {value} {shadow:?}");
            if margin > 1e-9 * (window.max.x - window.min.x) {
                assert!(value > -1e-9, "{point} is not inside: {value} {shadow:?}");
            }
        }
        match (shadow.kind(), shadow.axes()) {
            (ShadowKind::Ellipse, Some(axes)) => {
                compared[0] += 1;
                let (a, b) = (axes.first.length(), axes.second.length());
                assert!(a >= b * (1.0 - 1e-9), "the longer one first: {a} {b}");
                assert!(axes.first.dot(axes.second).abs() <= 1e-7 * a * b, "perpendicular: {axes:?}");
                let error = shadow.area() / (std::f64::consts::PI * a * b) - 1.0;
                // The axes are as exact as the circle's shadow in the plane's coordinates.
                let rounding = 1e-15 * ((axes.center.length() + a) / b + (a / b).powi(2));
                assert!(error.abs() < 1e-9 + 10.0 * rounding, "area π a b, {error}: {shadow:?}");
                for inside in [1.0 - 1e-3, -1.0 + 1e-3] {
                    assert!(shadow.contains(axes.center + axes.first * inside), "{shadow:?}");
                    assert!(!shadow.contains(axes.center + axes.first * inside * 1.01), "{shadow:?}");
                    assert!(shadow.contains(axes.center + axes.second * inside), "{shadow:?}");
                    assert!(!shadow.contains(axes.center + axes.second * inside * 1.01), "{shadow:?}");
                }
            }
            (ShadowKind::Hyperbola, Some(axes)) => {
                if axes.first.length() < 1e-6 * axes.second.length() {
                    // Nearly a straight edge: the vertex is rounding of the other axis.
                    continue;
                }
                compared[1] += 1;
                let at = |s: f64, t: f64| axes.center + axes.first * s + axes.second * t;
                assert!(shadow.contains(at(1.001, 0.0)), "the vertex: {shadow:?} {axes:?}");
                assert!(!shadow.contains(at(0.999, 0.0)), "the vertex: {shadow:?} {axes:?}");
                assert!(!shadow.contains(at(-1.001, 0.0)), "not the other branch: {shadow:?}");
                assert!(shadow.contains(at(1.3, 0.8)), "1.69 - 0.64 > 1: {shadow:?}");
                assert!(!shadow.contains(at(1.25, 0.8)), "1.5625 - 0.64 < 1: {shadow:?}");
                assert_eq!(shadow.area(), f64::INFINITY, "unbounded");
            }
            (ShadowKind::Parabola, None) => {
                compared[2] += 1;
                assert_eq!(shadow.area(), f64::INFINITY, "unbounded");
            }
            other => panic!("a conic is one of three kinds: {other:?}"),
        }
    }
    assert!(compared[0] > 4000 && compared[1] > 1000 && compared[2] > 20, "{compared:?}");
}
