//! `PlaneShadow::contains` against rays, over more than a million points a shape: every pose of
//! plane, light and occluder, most of them next to something degenerate.

mod plane_shadow_support;

use antumbra_math::plane_shadow::{PlaneFrame, PlaneShadow, ShadowKind};
use antumbra_math::{Cone, Disc, Light, Plane, Rectangle, Shape, Sphere, Triangle};
use glam::{DQuat, DVec2, DVec3};
use plane_shadow_support::{Random, blocked, grown, moved};

/// Settings per shape, and points in each. The environment variable ANTUMBRA_TEST_FACTOR multiplies
/// the settings.
const SETTINGS: usize = 50_000;
const POINTS: usize = 24;

/// Points where a growth of the occluder by this fraction of its size, or a shrinkage, changes what
/// the ray says are on the edge and decide nothing. 1e-8 is the rounding (1e-16) of the distances in
/// these settings, which reach 1e4 times the occluder's size, over the least angle (1e-4) that the
/// generator is meant to leave between the light's way and a flat occluder, with room for squares.
const EDGE: f64 = 1e-8;

/// A number that is often one of the special ones.
fn special(random: &mut Random, values: &[f64], from: f64, to: f64) -> f64 {
    let value = values[random.choice(values.len() as u64) as usize];
    match random.choice(4) {
        0 => value,
        1 => value + random.within(-1.0, 1.0) * random.decades(-12.0, -1.0),
        _ => random.within(from, to),
    }
}

/// A setting in the plane h = 0 (h is z), before it is turned and moved.
fn setting(random: &mut Random, shape: usize) -> (Shape, Light, f64) {
    let size = random.decades(-1.0, 0.5);
    // Heights in units of the size, special where something happens.
    let light_height = random.decades(-0.5, 1.5) * size;
    let relative = [0.0, 1.0, -1.0, 0.5];
    let height = match random.choice(3) {
        0 => special(random, &relative, -1.0, 2.0) * size,
        1 => light_height + special(random, &relative, -2.0, 1.0) * size,
        _ => random.within(0.0, 1.0) * light_height,
    };
    let at = DVec3::new(random.within(-3.0, 3.0) * size, random.within(-3.0, 3.0) * size, height);
    let light = DVec3::new(
        at.x + special(random, &[0.0, 1.0], -4.0, 4.0) * size,
        at.y + special(random, &[0.0], -4.0, 4.0) * size,
        light_height,
    );
    let axis = match random.choice(5) {
        0 => DVec3::Z,
        1 => DVec3::X,
        // Nearly edge-on, or nearly pointing at the light.
        2 => {
            let to = (light - at).normalize_or(DVec3::Z);
            let across = to.cross(random.direction()).normalize_or(DVec3::X);
            if random.choice(2) == 0 { across } else { to }
        }
        _ => random.direction(),
    };
    let tilt = random.direction() * if random.choice(2) == 0 { 0.0 } else { random.decades(-9.0, -1.0) };
    let axis = (axis + tilt).normalize_or(DVec3::Z) * if random.choice(2) == 0 { 1.0 } else { -1.0 };
    let occluder = match shape {
        0 => Shape::Sphere(Sphere { center: at, radius: size }),
        1 => Shape::Disc(Disc { center: at, normal: axis, radius: size }),
        2 => Shape::Triangle(Triangle {
            vertices: [0, 1, 2].map(|_| {
                let flat = axis.any_orthonormal_pair();
                let p = at + (flat.0 * random.within(-1.0, 1.0) + flat.1 * random.within(-1.0, 1.0)) * size;
                // Corners exactly on the plane and at the light's height.
                match random.choice(8) {
                    0 => p.with_z(0.0),
                    1 => p.with_z(light.z),
                    _ => p,
                }
            }),
        }),
        3 => {
            let height = special(random, &[1.0], 0.1, 3.0).abs() * size;
            let back = [0.0, height, 0.5 * height][random.choice(3) as usize];
            Shape::Cone(Cone { base_center: at - axis * back, axis, radius: size, height })
        }
        _ => {
            let flat = axis.any_orthonormal_pair();
            let half_forward = flat.1 * size * random.within(0.1, 2.0);
            Shape::Rectangle(Rectangle { center: at, half_right: flat.0 * size, half_forward })
        }
    };
    let light = match random.choice(4) {
        0 => Light::Directional { direction: (at - light).with_z(-light.z).normalize_or(-DVec3::Z) },
        1 => Light::Spot { position: light, direction: -DVec3::Z, outer_angle: 0.5 },
        _ => Light::Point { position: light },
    };
    (occluder, light, size)
}

fn posed(shape: &Shape, turn: DQuat, shift: DVec3) -> Shape {
    let point = |p: DVec3| turn * p + shift;
    match *shape {
        Shape::Sphere(s) => Shape::Sphere(Sphere { center: point(s.center), ..s }),
        Shape::Disc(d) => Shape::Disc(Disc { center: point(d.center), normal: turn * d.normal, ..d }),
        Shape::Triangle(t) => Shape::Triangle(Triangle { vertices: t.vertices.map(point) }),
        Shape::Cone(c) => Shape::Cone(Cone { base_center: point(c.base_center), axis: turn * c.axis, ..c }),
        Shape::Rectangle(r) => Shape::Rectangle(Rectangle {
            center: point(r.center),
            half_right: turn * r.half_right,
            half_forward: turn * r.half_forward,
        }),
        Shape::Plane(p) => {
            let normal = turn * p.normal;
            Shape::Plane(Plane::through(point(p.normal * p.offset), normal))
        }
    }
}

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
        let (occluder, light, size) = setting(&mut random, shape);
        let turn = DQuat::from_axis_angle(random.direction(), random.within(0.0, 3.2));
        let turn = if random.choice(4) == 0 { DQuat::IDENTITY } else { turn };
        let shift = if random.choice(4) == 0 { DVec3::ZERO } else { random.vector(10.0) };
        // Half of the time the frame's normal is on the other side of the plane.
        let normal = turn * if random.choice(2) == 0 { DVec3::Z } else { -DVec3::Z };
        let frame = PlaneFrame::of_plane(&Plane::through(shift, normal)).expect("a plane");
        let occluder = posed(&occluder, turn, shift);
        let light = match light {
            Light::Point { position } => Light::Point { position: turn * position + shift },
            Light::Spot { position, direction, outer_angle } => {
                Light::Spot { position: turn * position + shift, direction: turn * direction, outer_angle }
            }
            Light::Directional { direction } => Light::Directional { direction: turn * direction },
        };
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
                // Rounding puts the light on one side of a flat occluder or the other.
                blocked(&occluder, &moved(&light, step), at),
                blocked(&occluder, &moved(&light, -step), at),
            ];
            let truth = blocked(&occluder, &light, at);
            asked += 1;
            let on_flat = !matches!(occluder, Shape::Sphere(_) | Shape::Cone(_))
                && blocked(&larger, &Light::Point { position: at + step }, at - step);
            if on_flat || answers.iter().any(|&answer| answer != truth) {
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
