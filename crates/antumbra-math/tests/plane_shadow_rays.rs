//! `PlaneShadow::contains` against rays, over more than a million points a shape: every pose of
//! plane, light and occluder, most of them next to something degenerate.

mod plane_shadow_support;

use antumbra_math::plane_shadow::{PlaneShadow, ShadowKind};
use antumbra_math::{Light, Shape};
use glam::DVec2;
use plane_shadow_support::settings::{Setting, setting};
use plane_shadow_support::{Random, blocked, grown, moved};

/// Settings per shape, and points in each. The environment variable ANTUMBRA_TEST_FACTOR multiplies
/// the settings.
const SETTINGS: usize = 50_000;
const POINTS: usize = 24;

/// Points where a growth of the occluder by this fraction of its size, or a shrinkage, or a step as
/// long of the point or the light, changes what the ray says are on the edge and decide nothing: at
/// most 2 % of the points. It is the square root of the rounding, 1e-16: where a ray grazes an
/// occluder, a light touches one or an occluder touches the plane, the one turns into the other.
const EDGE: f64 = 1e-8;

/// Points worth asking: around the shadow's boundary, in its bounds, far away, anywhere.
fn ask(random: &mut Random, shadow: &PlaneShadow, middle: DVec2, size: f64) -> DVec2 {
    let anywhere = middle
        + DVec2::new(random.within(-1.0, 1.0), random.within(-1.0, 1.0)) * size * random.decades(-1.0, 3.0);
    let Some(bounds) = shadow.bounds() else { return anywhere };
    let (min, max) = (bounds.min.max(middle - 50.0 * size), bounds.max.min(middle + 50.0 * size));
    let inside = DVec2::new(random.within(min.x, max.x), random.within(min.y, max.y));
    // Farther away than this the world's coordinates are too coarse to say where a ray goes.
    let near = inside.distance(middle) < 1e3 * size;
    if random.choice(3) == 0 || !near { anywhere } else { inside }
}

fn check(shape: usize, seed: u64) {
    let mut random = Random(seed);
    let (mut asked, mut decided, mut dark) = (0, 0, 0);
    let mut kinds = std::collections::HashMap::new();
    let factor = std::env::var("ANTUMBRA_TEST_FACTOR").ok().and_then(|n| n.parse().ok()).unwrap_or(1);
    for _ in 0..SETTINGS * factor {
        let Setting { occluder, light, frame, size } = setting(&mut random, shape);
        let shadow = PlaneShadow::cast(&occluder, &light, &frame);
        *kinds.entry(shadow.kind()).or_insert(0) += 1;
        let (larger, smaller) = (grown(&occluder, EDGE * size), grown(&occluder, -EDGE * size));
        let middle = frame.coordinates(match occluder {
            Shape::Sphere(s) => s.center,
            Shape::Disc(d) => d.center,
            Shape::Triangle(t) => t.vertices[0],
            Shape::Cone(c) => c.base_center,
            Shape::Rectangle(r) => r.center,
            Shape::Plane(p) => p.normal * p.offset,
            _ => unreachable!("a shape that this test does not know"),
        });
        for _ in 0..POINTS {
            let point = ask(&mut random, &shadow, middle, size);
            let at = frame.point(point);
            // Rounding puts the point a little above the plane or below.
            let step = plane_shadow_support::normal(&occluder) * (EDGE * size);
            let lift = frame.normal * (EDGE * size);
            let answers = [
                blocked(&larger, &light, at),
                blocked(&smaller, &light, at),
                blocked(&occluder, &light, at + lift),
                blocked(&occluder, &light, at - lift),
                // ... or on one side of a flat occluder seen edge-on or the other.
                blocked(&occluder, &light, at + step),
                blocked(&occluder, &light, at - step),
            ];
            let truth = blocked(&occluder, &light, at);
            asked += 1;
            // Rounding puts the light inside what it touches or outside, on one side of a flat
            // occluder or the other.
            let aside = [step, lift, frame.u * (EDGE * size), frame.v * (EDGE * size)];
            let near_light = aside
                .iter()
                .flat_map(|&by| [by, -by])
                .any(|by| blocked(&occluder, &moved(&light, by), at) != truth);
            let on_flat = !matches!(occluder, Shape::Sphere(_) | Shape::Cone(_))
                && blocked(&larger, &Light::Point { position: at + step }, at - step);
            if on_flat || near_light || answers.iter().any(|&answer| answer != truth) {
                continue;
            }
            decided += 1;
            dark += u64::from(truth);
            assert_eq!(
                shadow.contains(point),
                truth,
                "at {point:?} ({at:?}) of the shadow {:?} of {occluder:?} from {light:?} on {frame:?}:\n{shadow:?}",
                shadow.kind()
            );
        }
    }
    println!("shape {shape}: asked {asked}, decided {decided}, dark {dark}, kinds {kinds:?}");
    assert!(decided >= 1_000_000, "a million cases a shape: {decided}");
    assert!(decided * 100 >= asked * 98, "few on the edge: {decided} of {asked}");
    assert!(dark >= decided / 10, "enough of them in the dark: {dark} of {decided}");
    assert!(kinds.contains_key(&ShadowKind::Nothing), "{kinds:?}");
}

#[test]
fn spheres() {
    check(0, 1);
}

#[test]
fn discs() {
    check(1, 2);
}

#[test]
fn triangles() {
    check(2, 3);
}

#[test]
fn cones() {
    check(3, 4);
}

#[test]
fn rectangles() {
    check(4, 5);
}
