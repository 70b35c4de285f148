//! The tracer as a whole: who shadows whom, what is defined where, and that threads change nothing.

mod common;

use std::sync::{
    Arc,
    atomic::{AtomicU64, Ordering},
};

use antumbra_reference::{Ray, Sampling, Tracer, intersect::Body};
use antumbra_scene::{LightKind, Object, Part, Pose, Scene, Shape};
use common::{Random, at, ball, light, mesh, object, scene};
use glam::{DQuat, DVec3};

const QUIET: &(dyn Fn(u64, u64) + Sync) = &|_, _| {};
const CENTER: Sampling = Sampling::Center { light_samples: 1 };

fn floor() -> Object {
    object("floor", Shape::Plane, at(DVec3::ZERO))
}

/// The visibility of light 0 at the surface straight below a point.
fn below(tracer: &Tracer, p: DVec3) -> f64 {
    let surface = tracer.surface(&Ray::new(p, DVec3::NEG_Y)).expect("a surface below");
    tracer.visibility_at(0, &surface, 64, 1)
}

fn lamp(position: DVec3) -> antumbra_scene::Light {
    light(LightKind::Point, position, 10.0)
}

#[test]
fn a_ball_shadows_the_floor_by_the_closed_ellipse() {
    let (l, c, r) = (DVec3::new(0.5, 5.0, -0.2), DVec3::new(-0.4, 1.5, 0.3), 0.7);
    let tracer = Tracer::new(
        &scene(vec![lamp(l)], vec![floor(), object("ball", Shape::Sphere { radius: r }, at(c))]),
        0.0,
    );
    let mut random = Random::new(1);
    let mut dark = 0;
    for _ in 0..20_000 {
        let p = DVec3::new(random.signed() * 4.0, 0.0, random.signed() * 4.0);
        let surface = tracer.surface(&Ray::new(p - DVec3::Y, DVec3::Y)).expect("the floor from below");
        let surface = antumbra_reference::Surface { normal: DVec3::Y, ..surface };
        // The tangent cone from the light.
        let (d, m) = (p - l, c - l);
        let inside = d.cross(m).length() < r * d.length();
        let v = tracer.visibility_at(0, &surface, 1, 1);
        assert_eq!(v, if inside { 0.0 } else { 1.0 }, "at {p}");
        dark += usize::from(inside);
    }
    assert!(dark > 500, "only {dark} points in shadow");
}

#[test]
fn parts_shadow_each_other_but_convex_ones_not_themselves() {
    let mut pair = object("pair", Shape::Sphere { radius: 1.0 }, at(DVec3::ZERO));
    pair.parts = vec![
        Part { shape: Shape::Box { size: DVec3::new(4.0, 0.2, 4.0) }, pose: Pose::IDENTITY },
        Part { shape: Shape::Sphere { radius: 0.5 }, pose: at(DVec3::Y * 2.0) },
    ];
    let tracer = Tracer::new(&scene(vec![lamp(DVec3::Y * 6.0)], vec![pair]), 0.0);
    assert_eq!(below(&tracer, DVec3::new(0.1, 1.0, 0.0)), 0.0, "the ball's shadow on its own object's box");
    assert_eq!(below(&tracer, DVec3::new(1.5, 1.0, 0.0)), 1.0, "beside it");
    assert_eq!(below(&tracer, DVec3::new(0.1, 4.0, 0.0)), 1.0, "the top of the ball");
}

#[test]
fn casting_and_receiving_can_be_turned_off() {
    let ball = |casts_shadow| Object {
        casts_shadow,
        ..object("ball", Shape::Sphere { radius: 0.5 }, at(DVec3::Y * 2.0))
    };
    let floor = |receives_shadow| Object { receives_shadow, ..floor() };
    for (casts, receives, expected) in [(true, true, 0.0), (false, true, 1.0), (true, false, 1.0)] {
        let tracer = Tracer::new(&scene(vec![lamp(DVec3::Y * 6.0)], vec![floor(receives), ball(casts)]), 0.0);
        assert_eq!(below(&tracer, DVec3::new(0.1, 1.0, 0.0)), expected, "casts {casts}, receives {receives}");
    }
    // What receives no shadow still faces away: the floor from above, lit from below.
    let tracer = Tracer::new(&scene(vec![lamp(DVec3::Y * -6.0)], vec![floor(false)]), 0.0);
    assert_eq!(below(&tracer, DVec3::Y), 0.0, "the light is behind the floor");
}

/// A convex mesh and the upper half of a torus, lit from anywhere they face: no speck of their own shadow.
#[test]
fn no_acne_on_what_may_shadow_itself() {
    let (positions, triangles) = ball(48, 32, 1.0, || 1.0);
    let round = mesh(positions, triangles);
    let torus = Shape::Torus { major_radius: 1.0, minor_radius: 0.3 };
    let sun = light(LightKind::Directional { direction: DVec3::NEG_Y }, DVec3::ZERO, 1.0);
    let mut random = Random::new(2);
    for (name, shape, light) in [("mesh", round, lamp(DVec3::new(3.0, 4.0, 2.0))), ("torus", torus, sun)] {
        for offset in [0.0, 1e3, 1e6] {
            let shift = DVec3::new(offset, -offset, 0.5 * offset);
            let moved = antumbra_scene::Light { position: light.position + shift, ..light.clone() };
            let tracer =
                Tracer::new(&scene(vec![moved.clone()], vec![object(name, shape.clone(), at(shift))]), 0.0);
            let (mut lit, mut tested) = (0, 0);
            for _ in 0..20_000 {
                let origin = shift + DVec3::new(random.signed() * 1.3, 5.0, random.signed() * 1.3);
                let Some(surface) = tracer.surface(&Ray::new(origin, DVec3::NEG_Y)) else { continue };
                tested += 1;
                let towards = match moved.kind {
                    LightKind::Directional { direction } => -direction,
                    _ => (moved.position - surface.point).normalize(),
                };
                let v = tracer.visibility_at(0, &surface, 1, 1);
                if surface.normal.dot(towards) > 0.0 {
                    lit += 1;
                    assert_eq!(v, 1.0, "{name} at {offset}: a speck at {surface:?}");
                } else {
                    assert_eq!(v, 0.0, "{name} at {offset}: lit from behind at {surface:?}");
                }
            }
            assert!(tested > 5_000 && lit > tested / 2, "{name}: {lit} of {tested} lit");
        }
    }
}

/// And where a torus does shadow itself, it does: the inside of the ring, lit along its axis' plane.
#[test]
fn a_torus_shadows_itself() {
    let torus = object("torus", Shape::Torus { major_radius: 1.0, minor_radius: 0.3 }, at(DVec3::ZERO));
    let sun =
        light(LightKind::Directional { direction: DVec3::new(1.0, -0.1, 0.0).normalize() }, DVec3::ZERO, 1.0);
    let tracer = Tracer::new(&scene(vec![sun], vec![torus]), 0.0);
    let inner = tracer.surface(&Ray::new(DVec3::new(0.0, 0.05, 0.0), DVec3::X)).expect("the inner side");
    assert_eq!(tracer.visibility_at(0, &inner, 1, 1), 0.0, "behind the near side of the ring");
    let top = tracer.surface(&Ray::new(DVec3::new(1.0, 2.0, 0.0), DVec3::NEG_Y)).expect("the top");
    assert_eq!(tracer.visibility_at(0, &top, 1, 1), 1.0, "the top of the ring");
}

#[test]
fn lights_in_and_on_occluders() {
    let ball = || object("ball", Shape::Sphere { radius: 0.5 }, at(DVec3::Y * 2.0));
    let dark = Tracer::new(&scene(vec![lamp(DVec3::new(0.1, 2.1, 0.0))], vec![floor(), ball()]), 0.0);
    let tube = object("tube", Shape::Torus { major_radius: 1.0, minor_radius: 0.3 }, at(DVec3::Y * 2.0));
    let in_tube = Tracer::new(&scene(vec![lamp(DVec3::new(1.0, 2.0, 0.0))], vec![floor(), tube]), 0.0);
    for x in [-3.0, -0.2, 0.0, 0.7, 5.0] {
        assert_eq!(below(&dark, DVec3::new(x, 1.0, 0.3)), 0.0, "a light in a ball lights x = {x}");
        assert_eq!(below(&in_tube, DVec3::new(x, 1.0, 0.3)), 0.0, "a light in a torus lights x = {x}");
    }
    // On the surface: the near side sees it, the far side does not.
    let on = Tracer::new(&scene(vec![lamp(DVec3::Y * 1.5)], vec![floor(), ball()]), 0.0);
    assert_eq!(below(&on, DVec3::new(0.3, 1.0, 0.2)), 1.0, "a light under the ball");
    let on = Tracer::new(&scene(vec![lamp(DVec3::Y * 2.5)], vec![floor(), ball()]), 0.0);
    assert_eq!(below(&on, DVec3::new(0.3, 1.0, 0.2)), 0.0, "a light on top of the ball");
    // An area light that an occluder pokes into: only what is before the light's surface blocks.
    let sphere = light(LightKind::Sphere { radius: 1.0 }, DVec3::Y * 3.0, 1.0);
    let buried = object("buried", Shape::Sphere { radius: 0.5 }, at(DVec3::Y * 3.0));
    let tracer = Tracer::new(&scene(vec![sphere], vec![floor(), buried]), 0.0);
    assert_eq!(below(&tracer, DVec3::new(0.4, 1.0, 0.0)), 1.0, "an occluder inside the light");
}

#[test]
fn points_inside_occluders_are_dark() {
    // The floor inside a box that stands in it, the light inside the box as well.
    let solids = [
        Shape::Box { size: DVec3::splat(2.0) },
        Shape::Sphere { radius: 1.0 },
        Shape::Ellipsoid { radii: DVec3::new(1.0, 1.2, 0.9) },
        Shape::Cone { radius: 2.0, height: 3.0 },
        Shape::Cylinder { radius: 1.0, height: 2.0, radius_top: 0.8 },
        Shape::Capsule { radius: 0.9, height: 0.5 },
    ];
    for shape in solids {
        let solid = object("solid", shape.clone(), at(DVec3::ZERO));
        for position in [DVec3::new(0.1, 0.2, 0.0), DVec3::new(0.1, 5.0, 0.0)] {
            let sphere = light(LightKind::Sphere { radius: 0.05 }, position, 1.0);
            for light in [lamp(position), sphere] {
                let tracer = Tracer::new(&scene(vec![light], vec![floor(), solid.clone()]), 0.0);
                let mut surface =
                    tracer.surface(&Ray::new(DVec3::new(9.0, 1.0, 9.0), DVec3::NEG_Y)).expect("floor");
                surface.point = DVec3::new(0.2, 0.0, 0.1);
                assert_eq!(
                    tracer.visibility_at(0, &surface, 16, 1),
                    0.0,
                    "inside {shape:?}, light at {position}"
                );
            }
        }
    }
    let torus = object("torus", Shape::Torus { major_radius: 1.0, minor_radius: 0.5 }, at(DVec3::ZERO));
    let tracer = Tracer::new(&scene(vec![lamp(DVec3::new(1.0, 0.2, 0.0))], vec![floor(), torus]), 0.0);
    let mut surface = tracer.surface(&Ray::new(DVec3::new(9.0, 1.0, 9.0), DVec3::NEG_Y)).expect("floor");
    surface.point = DVec3::new(1.0, 0.0, 0.1);
    assert_eq!(tracer.visibility_at(0, &surface, 1, 1), 0.0, "inside a torus, with the light");
}

/// From inside a ball one sees its inner side, which a convex body never shadows: facing alone decides.
#[test]
fn the_camera_inside_a_ball() {
    let ball = object("ball", Shape::Sphere { radius: 20.0 }, at(DVec3::ZERO));
    let inside = Tracer::new(&scene(vec![lamp(DVec3::Y)], vec![ball.clone()]), 0.0);
    assert!(inside.primitives_seen(16, 12).iter().all(|&p| p == Some(0)), "the ball is all around");
    assert!(inside.visibility(0, 16, 12, CENTER, QUIET).iter().all(|&v| v == 1.0), "a light inside");
    let outside = Tracer::new(&scene(vec![lamp(DVec3::Y * 50.0)], vec![ball]), 0.0);
    for (direction, expected) in [(DVec3::Y, 0.0), (DVec3::NEG_Y, 1.0)] {
        let surface = outside.surface(&Ray::new(DVec3::ZERO, direction)).expect("the inner side");
        assert_eq!(surface.normal, -direction, "turned towards the viewer");
        assert_eq!(
            outside.visibility_at(0, &surface, 1, 1),
            expected,
            "a light outside, seen along {direction}"
        );
    }
}

/// A disc on the floor, two boxes with one top, a mesh over its double: neither shadows the other.
#[test]
fn coincident_surfaces_do_not_blotch() {
    let tilt = Pose { translation: DVec3::new(0.3, 0.7, 0.1), rotation: DQuat::from_rotation_x(0.4) };
    let (positions, triangles) = ball(24, 16, 1.0, || 1.0);
    let round = mesh(positions, triangles);
    let box_at = |x: f64| Pose { translation: tilt.point(DVec3::X * x), ..tilt };
    let size = DVec3::new(2.0, 1.0, 2.0);
    let pairs = [
        vec![object("plane", Shape::Plane, tilt), object("disc", Shape::Disc { radius: 1.5 }, tilt)],
        vec![object("a", Shape::Box { size }, box_at(0.0)), object("b", Shape::Box { size }, box_at(0.5))],
        vec![object("a", round.clone(), tilt), object("b", round, tilt)],
    ];
    for objects in pairs {
        let light = lamp(DVec3::new(1.0, 9.0, 3.0));
        let tracer = Tracer::new(&scene(vec![light], objects.clone()), 0.0);
        let mut lit = 0;
        let camera = scene(vec![], vec![]).camera;
        for y in 0..96 {
            for x in 0..128 {
                let (origin, direction) = camera.ray(f64::from(x) + 0.5, f64::from(y) + 0.5, 128, 96);
                let Some(surface) = tracer.surface(&Ray::new(origin, direction)) else { continue };
                let up = (tracer.lights()[0].position - surface.point).dot(surface.normal) > 0.0;
                let v = tracer.visibility_at(0, &surface, 1, 1);
                assert_eq!(v, f64::from(u8::from(up)), "{}: a blot at {surface:?}", objects[0].name);
                lit += usize::from(up);
            }
        }
        assert!(lit > 300, "only {lit} pixels lit");
    }
}

#[test]
fn scenes_without_lights_or_objects() {
    let dark = Scene { ambient: DVec3::new(0.1, 0.2, 0.3), ..scene(vec![], vec![floor()]) };
    let picture = Tracer::new(&dark, 0.0).render(8, 6, 3, QUIET);
    assert!(picture.iter().all(|&p| p == [0.1, 0.2, 0.3]), "ambient light alone");
    let empty = Tracer::new(&scene(vec![lamp(DVec3::Y)], vec![]), 0.0);
    assert!(empty.render(8, 6, 3, QUIET).iter().all(|&p| p == [0.25; 3]), "the background");
    assert!(empty.visibility(0, 8, 6, CENTER, QUIET).iter().all(|&v| v == 1.0), "the background is lit");
    assert!(empty.primitives_seen(8, 6).iter().all(Option::is_none), "nothing is seen");
    assert!(empty.render(0, 6, 3, QUIET).is_empty() && empty.primitives_seen(8, 0).is_empty(), "no pixels");
    let no_mesh = object("none", mesh(vec![], vec![]), at(DVec3::ZERO));
    assert!(
        Tracer::new(&scene(vec![], vec![no_mesh]), 0.0).primitives_seen(4, 4).iter().all(Option::is_none),
        "no mesh"
    );
}

/// Numbers that a scene file would refuse do no harm.
#[test]
fn numbers_that_are_not_finite() {
    let bad = [f64::NAN, f64::INFINITY, 0.0, 1e200, 1e-300];
    for value in bad {
        let shapes = [
            Shape::Sphere { radius: value },
            Shape::Ellipsoid { radii: DVec3::new(1.0, value, 1.0) },
            Shape::Cone { radius: value, height: 1.0 },
            Shape::Cylinder { radius: 1.0, height: value, radius_top: 0.0 },
            Shape::Capsule { radius: 1.0, height: value },
            Shape::Box { size: DVec3::new(1.0, value, 1.0) },
            Shape::Torus { major_radius: value, minor_radius: 0.1 },
            Shape::Disc { radius: value },
            Shape::Rectangle { width: value, depth: 1.0 },
            Shape::Triangle { vertices: [DVec3::X, DVec3::Y * value, DVec3::Z] },
            mesh(vec![DVec3::X, DVec3::Y * value, DVec3::Z], vec![[0, 1, 2], [0, 0, 0]]),
            Shape::Plane,
        ];
        for shape in shapes {
            for pose in [
                at(DVec3::ZERO),
                at(DVec3::X * value),
                Pose { rotation: DQuat::from_xyzw(value, 0.0, 0.0, 1.0), ..at(DVec3::ZERO) },
            ] {
                let lights = vec![
                    lamp(DVec3::Y * value),
                    light(LightKind::Sphere { radius: value }, DVec3::Y * 3.0, 1.0),
                    light(LightKind::Disc { direction: DVec3::NEG_Y, radius: value }, DVec3::Y * 3.0, value),
                ];
                let tracer =
                    Tracer::new(&scene(lights, vec![object("bad", shape.clone(), pose), floor()]), 0.0);
                assert_eq!(tracer.render(8, 6, 2, QUIET).len(), 48, "{shape:?}");
                for light in 0..3 {
                    let v =
                        tracer.visibility(light, 8, 6, Sampling::Area { grid: 2, light_samples: 2 }, QUIET);
                    assert!(v.iter().all(|v| (0.0..=1.0).contains(v)), "{shape:?}: {v:?}");
                }
            }
        }
    }
}

fn busy_scene() -> Scene {
    let mut random = Random::new(4);
    let (positions, triangles) = common::bumpy_ball(&mut random, 1.0);
    let lights = vec![
        lamp(DVec3::new(2.0, 5.0, 1.0)),
        light(LightKind::Sphere { radius: 0.6 }, DVec3::new(-2.0, 5.0, 1.0), 10.0),
        light(LightKind::Disc { direction: DVec3::NEG_Y, radius: 0.6 }, DVec3::new(0.0, 5.0, 1.0), 10.0),
    ];
    let objects = vec![
        floor(),
        object("star", mesh(positions, triangles), at(DVec3::new(0.0, 1.2, 0.0))),
        object("torus", Shape::Torus { major_radius: 1.0, minor_radius: 0.3 }, at(DVec3::new(1.5, 0.5, 1.5))),
        object("cone", Shape::Cone { radius: 0.6, height: 1.5 }, at(DVec3::new(-2.0, 0.75, 0.5))),
    ];
    scene(lights, objects)
}

#[test]
fn threads_change_nothing() {
    let tracer = Tracer::new(&busy_scene(), 0.0);
    let all = || {
        let picture = tracer.render(64, 48, 5, QUIET);
        let soft = tracer.visibility(1, 64, 48, Sampling::Area { grid: 2, light_samples: 7 }, QUIET);
        (picture, soft, tracer.primitives_seen(64, 48))
    };
    let with = |threads: usize| {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool").install(all)
    };
    let one = with(1);
    assert!(one.1.iter().any(|&v| 0.0 < v && v < 1.0), "no penumbra in the picture");
    for threads in [2, 7] {
        assert!(with(threads) == one, "{threads} threads draw another picture than one");
    }
}

#[test]
fn progress_ends_with_all_rows() {
    let (calls, last) = (Arc::new(AtomicU64::new(0)), Arc::new(AtomicU64::new(0)));
    Tracer::new(&busy_scene(), 0.0).render(16, 37, 1, &|done, total| {
        assert_eq!(total, 37, "rows in all");
        calls.fetch_add(1, Ordering::Relaxed);
        last.fetch_max(done, Ordering::Relaxed);
    });
    assert_eq!((calls.load(Ordering::Relaxed), last.load(Ordering::Relaxed)), (37, 37), "one call a row");
}

/// Away from edges a pixel's mean visibility is that of its centre.
#[test]
fn samplings_agree() {
    let tracer = Tracer::new(&busy_scene(), 0.0);
    let center = tracer.visibility(0, 64, 48, CENTER, QUIET);
    let area = tracer.visibility(0, 64, 48, Sampling::Area { grid: 4, light_samples: 1 }, QUIET);
    let different = center.iter().zip(&area).filter(|(c, a)| c != a).count();
    assert!(different > 20 && different < 64 * 48 / 4, "{different} pixels on edges");
    // Where they differ an edge is near: a neighbour sees another value or another primitive.
    let seen = tracer.primitives_seen(64, 48);
    for i in (0..center.len()).filter(|&i| center[i] != area[i]) {
        let (x, y) = (i as isize % 64, i as isize / 64);
        let near = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (x + dx, y + dy)));
        let near = near.filter(|(x, y)| (0..64).contains(x) && (0..48).contains(y));
        let mut near = near.map(|(x, y)| (y * 64 + x) as usize);
        let differs = near.any(|j| center[j] != center[i] || seen[j] != seen[i]);
        assert!(differs || (area[i] - center[i]).abs() < 0.5, "pixel {i} has no edge near it");
    }
    let far = center.iter().zip(&area).filter(|(c, a)| (**c - **a).abs() > 0.8).count();
    assert!(far < 40, "{far} pixels whose centre says the opposite of nearly all the rest");
}

/// Hundreds of primitives of every kind, near and far from the origin: the hierarchy loses none of them.
#[test]
fn the_hierarchy_finds_what_testing_everything_finds() {
    let mut random = Random::new(5);
    for offset in [0.0, 1e5] {
        let shift = DVec3::new(offset, offset, -offset);
        let objects: Vec<Object> = (0..400)
            .map(|i| {
                let size = 0.1 * random.size();
                let shape = match i % 10 {
                    0 => Shape::Sphere { radius: size },
                    1 => Shape::Ellipsoid { radii: random.unit().abs() * size + 0.01 },
                    2 => Shape::Cone { radius: size, height: random.size() },
                    3 => Shape::Cylinder { radius: size, height: random.size(), radius_top: 0.5 * size },
                    4 => Shape::Capsule { radius: size, height: random.size() },
                    5 => Shape::Box { size: random.unit().abs() * size + 0.01 },
                    6 => Shape::Torus { major_radius: size, minor_radius: 0.3 * size },
                    7 => Shape::Disc { radius: size },
                    8 => Shape::Rectangle { width: size, depth: random.size() },
                    _ => Shape::Triangle { vertices: [(); 3].map(|()| random.cube()) },
                };
                object(
                    "one",
                    shape,
                    Pose { translation: shift + random.cube() * 5.0, rotation: random.rotation() },
                )
            })
            .collect();
        let scene = scene(vec![], objects);
        let tracer = Tracer::new(&scene, 0.0);
        let bodies: Vec<Body> = scene.moment(0.0).primitives.iter().map(Body::new).collect();
        let mut hits = 0;
        for _ in 0..20_000 {
            let origin = shift + random.unit() * random.between(0.0, 12.0);
            let ray = Ray::new(origin, shift + random.cube() * 5.0 - origin);
            let found = tracer.surface(&ray).map(|surface| surface.point);
            let nearest =
                bodies.iter().filter_map(|body| body.nearest(&ray)).map(|hit| hit.t).reduce(f64::min);
            assert_eq!(found, nearest.map(|t| ray.at(t)), "along {ray:?}");
            hits += usize::from(found.is_some());
        }
        assert!(hits > 5_000, "only {hits} hits");
    }
}
