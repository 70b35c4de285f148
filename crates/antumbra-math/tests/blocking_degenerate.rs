//! Where closed forms break, case by case: what `blocking` says there is what its documentation says.

mod blocking_support;
mod plane_shadow_support;

use antumbra_math::blocking::{Blocker, Blockers, Footprint, Outline, PolygonBlocker};
use antumbra_math::{Cone, Disc, Light, Plane, Rectangle, Shape, Sphere, Triangle};
use blocking_support::{CONE, SPHERE, shape};
use glam::{DVec3, Vec3};
use plane_shadow_support::Random;

const O: DVec3 = DVec3::ZERO;
const X: DVec3 = DVec3::X;
const Y: DVec3 = DVec3::Y;
const Z: DVec3 = DVec3::Z;

fn point_light(position: DVec3) -> Light {
    Light::Point { position }
}

/// One of each kind, of size one at `center`, flat ones facing up.
fn each(center: DVec3) -> [Shape; 6] {
    [
        Sphere { center, radius: 1.0 }.into(),
        Disc { center, normal: Y, radius: 1.0 }.into(),
        Triangle { vertices: [center - X - Z, center + X - Z, center + Z] }.into(),
        Cone { base_center: center - Y * 0.5, axis: Y, radius: 1.0, height: 1.0 }.into(),
        Rectangle { center, half_right: X, half_forward: Z }.into(),
        Plane::through(center, Y).into(),
    ]
}

fn is_solid(shape: &Shape) -> bool {
    matches!(shape, Shape::Sphere(_) | Shape::Cone(_))
}

fn count(shape: impl Into<Shape>, light: Light) -> usize {
    Blockers::new(&shape.into(), &light).iter().count()
}

#[test]
fn only_what_is_between_point_and_light_blocks() {
    let light = point_light(Y * 10.0);
    for shape in each(Y * 3.0) {
        assert!(shape.blocks(&light, O), "between: {shape:?}");
        assert!(!shape.blocks(&light, Y * 5.0), "the shape is below the point: {shape:?}");
        assert!(!shape.blocks(&point_light(Y * 1.0), O), "the light is below the shape: {shape:?}");
        assert!(!shape.blocks(&point_light(Y * -1.0), O), "the light is below the point: {shape:?}");
        assert!(
            shape.blocks(&Light::Directional { direction: -Y }, O),
            "parallel light from above: {shape:?}"
        );
        assert!(!shape.blocks(&Light::Directional { direction: Y }, O), "and from below: {shape:?}");
        // The point's mirror image about the light: where the algebra of projections wraps round.
        assert!(!shape.blocks(&light, Y * 20.0), "beyond the light: {shape:?}");
    }
}

#[test]
fn a_light_in_the_plane_of_a_flat_shape_is_not_blocked() {
    for shape in each(O).into_iter().filter(|s| !is_solid(s)) {
        for light in [
            point_light(X * 5.0),
            point_light(X * 0.25 + Z * 0.1),
            Light::Directional { direction: X },
            Light::Spot { position: Z * -3.0, direction: Z, outer_angle: 1.0 },
        ] {
            assert_eq!(count(shape, light), 0, "{shape:?} {light:?}");
            for p in [Y, -Y, X * -3.0, O] {
                assert!(!shape.blocks(&light, p), "{p} {shape:?} {light:?}");
            }
        }
    }
}

#[test]
fn a_light_next_to_the_plane_of_a_flat_shape_is() {
    // From a hair above its middle the shape hides all but a sliver of what is below.
    for shape in each(O).into_iter().filter(|s| !is_solid(s)) {
        for height in [1e-3, 1e-6, 1e-9, 1e-12] {
            let light = point_light(Y * height + Z * 0.1);
            assert!(shape.blocks(&light, X * 20.0 - Y * 20.0), "below, {height:e}: {shape:?}");
            assert!(!shape.blocks(&light, X * 20.0 + Y * 20.0), "above, {height:e}: {shape:?}");
        }
    }
}

#[test]
fn inside_solids_it_is_dark() {
    let mut random = Random(5);
    for kind in [SPHERE, CONE] {
        for _ in 0..2000 {
            let shape = shape(&mut random, kind, 1.0, random_point());
            let inside = |random: &mut Random| match shape {
                Shape::Sphere(s) => s.center + random.direction() * (0.999 * s.radius),
                Shape::Cone(c) => {
                    let up = random.within(0.001, 0.999);
                    let around = c.axis.cross(random.direction());
                    c.base_center + c.axis * (c.height * up) + around * (0.999 * c.radius * (1.0 - up))
                }
                _ => O,
            };
            let (a, b) = (inside(&mut random), inside(&mut random));
            let outside = random.direction() * 30.0;
            assert!(shape.blocks(&point_light(outside), a), "a point inside: {a} {shape:?}");
            assert!(shape.blocks(&point_light(a), outside), "a light inside: {a} {shape:?}");
            assert!(shape.blocks(&point_light(a), b), "both inside: {a} {b} {shape:?}");
            let all = Blockers::new(&shape, &point_light(a));
            let (blocker, outline) = all.iter().next().expect("a blocker");
            assert_eq!(*blocker, Blocker::Polygon(PolygonBlocker::EVERYTHING), "{shape:?}");
            assert_eq!(*outline, Outline::Everywhere, "{shape:?}");
            assert!(blocker.to_f32().blocks(Vec3::splat(9.0)), "in float32 too: {shape:?}");
        }
    }
}

fn random_point() -> DVec3 {
    DVec3::new(0.3, -0.2, 0.1)
}

#[test]
fn a_light_that_touches_a_solid_leaves_the_far_side_of_the_tangent_plane_dark() {
    let cone = Cone { base_center: O, axis: Y, radius: 3.0, height: 4.0 };
    let side = DVec3::new(4.0, 3.0, 0.0) / 5.0; // outward normal
    let touching: [(Shape, DVec3, DVec3); 4] = [
        (Sphere { center: O, radius: 2.0 }.into(), X * 2.0, X),
        (cone.into(), DVec3::new(1.5, 2.0, 0.0), side),
        (cone.into(), DVec3::new(0.75, 3.0, 0.0), side),
        (cone.into(), DVec3::new(1.0, 0.0, 0.5), -Y),
    ];
    let mut random = Random(6);
    for (shape, light, normal) in touching {
        for _ in 0..1000 {
            let p = light + random.direction() * random.decades(-1.0, 3.0);
            let above = normal.dot((p - light).normalize());
            if above.abs() > 1e-6 {
                assert_eq!(shape.blocks(&point_light(light), p), above < 0.0, "{p} {light} {shape:?}");
            }
        }
    }
    // On the rim both tangent planes count, and on the base's middle too.
    let rim = X * 3.0;
    for (p, dark) in [(Y, true), (Y * -1.0, false), (rim + Y * 2.0, false), (rim - X + Y * 0.1, true)] {
        assert_eq!(Shape::from(cone).blocks(&point_light(rim), p), dark, "{p} from the rim");
    }
    assert!(Shape::from(cone).blocks(&point_light(O), X * 50.0 + Y), "above the base, from its middle");
    assert!(!Shape::from(cone).blocks(&point_light(O), X * 50.0 - Y), "below");
    // From the apex the base alone is in the way.
    let apex = point_light(cone.apex());
    assert!(Shape::from(cone).blocks(&apex, Y * -1.0), "below the base, from the apex");
    assert!(Shape::from(cone).blocks(&apex, DVec3::new(3.5, -1.0, 0.0)), "inside the widening cone");
    assert!(!Shape::from(cone).blocks(&apex, DVec3::new(4.0, -1.0, 0.0)), "beside it");
}

#[test]
fn lights_around_a_cone() {
    let cone = Cone { base_center: O, axis: Y, radius: 1.0, height: 2.0 };
    let shape = Shape::from(cone);
    let ask = |light: DVec3, p: DVec3| shape.blocks(&point_light(light), p);
    // On the axis, above the apex and below the base: the base's disc alone.
    for light in [Y * 5.0, Y * -5.0] {
        assert_eq!(count(cone, point_light(light)), 1, "{light}");
    }
    assert!(ask(Y * 5.0, X * 1.19 - Y) && !ask(Y * 5.0, X * 1.21 - Y), "the base's shadow from above");
    assert!(ask(Y * -5.0, X * 1.19 + Y) && !ask(Y * -5.0, X * 1.21 + Y), "and from below");
    // Level with the apex: its shadow is at infinity; a light along the horizontal sees the whole profile.
    assert!(ask(X * 4.0 + Y * 2.0, X * -4.0 + Y * 1.9), "just below the apex's shadow");
    assert!(!ask(X * 4.0 + Y * 2.0, X * -4.0 + Y * 2.1), "just above it");
    let level = Light::Directional { direction: -X };
    assert!(shape.blocks(&level, X * -9.0 + Y * 1.9), "just below the apex");
    assert!(!shape.blocks(&level, X * -9.0 + Y * 2.1), "just above it");
    assert!(shape.blocks(&level, X * -9.0 + Y * 0.01 + Z * 0.99), "the foot");
    // Level with the base: the disc is edge-on, the triangle is all.
    assert_eq!(count(cone, point_light(X * 4.0)), 1, "edge-on");
    assert!(ask(X * 4.0, X * -4.0 + Y * 0.01) && !ask(X * 4.0, X * -4.0 - Y * 0.01), "the base's level");
    // Where the apex starts to project inside the base there are no tangents any more.
    for slip in [-1e-3, -1e-9, 0.0, 1e-9, 1e-3] {
        let light = cone.apex() + (cone.apex() - X) + X * slip;
        assert!(ask(light, Y * -0.5), "behind the base, {slip:e}");
        assert!(!ask(light, X * 1.6 - Y * 0.5), "beside, {slip:e}");
    }
}

#[test]
fn a_cone_without_height_is_a_disc() {
    let mut random = Random(8);
    for _ in 0..20_000 {
        let (base_center, axis) = (random.vector(2.0), random.direction());
        let cone = Shape::from(Cone { base_center, axis, radius: 1.0, height: 0.0 });
        let disc = Shape::from(Disc { center: base_center, normal: axis, radius: 1.0 });
        let (light, p) = (point_light(random.vector(5.0)), random.vector(5.0));
        assert_eq!(cone.blocks(&light, p), disc.blocks(&light, p), "{p} {light:?} {cone:?}");
    }
}

#[test]
fn nothing_of_no_size_blocks() {
    let light = point_light(Y * 4.0);
    let line = Triangle { vertices: [-X, O, X * 2.0] };
    let dot = Triangle { vertices: [X; 3] };
    let nothing: [Shape; 10] = [
        Sphere { center: O, radius: 0.0 }.into(),
        Disc { center: O, normal: Y, radius: 0.0 }.into(),
        Disc { center: O, normal: O, radius: 1.0 }.into(),
        Cone { base_center: O, axis: Y, radius: 0.0, height: 1.0 }.into(),
        line.into(),
        dot.into(),
        Rectangle { center: O, half_right: O, half_forward: Z }.into(),
        Rectangle { center: O, half_right: X, half_forward: O }.into(),
        Sphere { center: O, radius: -1.0 }.into(),
        Cone { base_center: O, axis: Y, radius: 1.0, height: -1.0 }.into(),
    ];
    for shape in nothing {
        assert_eq!(count(shape, light), 0, "{shape:?}");
        assert_eq!(count(shape, Light::Directional { direction: -Y }), 0, "{shape:?}");
        assert!(!shape.blocks(&light, -Y), "{shape:?}");
    }
    for shape in each(O) {
        assert_eq!(count(shape, Light::Directional { direction: O }), 0, "light from nowhere: {shape:?}");
        // Light, shape and point in one place: inside a solid, in the plane of a flat one.
        let blocked = shape.blocks(&point_light(O), O);
        assert_eq!(blocked, is_solid(&shape), "coincident: {shape:?}");
    }
}

#[test]
fn corners_beyond_four_and_below_three() {
    let light = Y.extend(0.0);
    for few in [&[][..], &[O], &[O, X]] {
        assert_eq!(PolygonBlocker::new(few, light), None, "{few:?}");
    }
    let square = [-X - Z, X - Z, X + Z, Z - X];
    let more = [square[0], square[1], square[2], square[3], O];
    assert_eq!(PolygonBlocker::new(&more, light), PolygonBlocker::new(&square, light), "four count");
}

/// Every number of a shape and of a light, one after the other, replaced by a value.
fn spoiled(bad: f64) -> Vec<(Shape, Light)> {
    let mut all = Vec::new();
    let good = point_light(Y * 5.0);
    let v = |i: usize| {
        if i < 3 { DVec3::select(glam::BVec3::new(i == 0, i == 1, i == 2), DVec3::splat(bad), O) } else { O }
    };
    for i in 0..3 {
        let light = Light::Directional { direction: -Y + v(i) };
        all.extend(each(O).map(|s| (s, light)));
        all.extend(each(O).map(|s| (s, point_light(Y * 5.0 + v(i)))));
        all.extend(each(O).map(|s| (s, Light::Spot { position: Y + v(i), direction: -Y, outer_angle: 1.0 })));
        let shapes: [Shape; 9] = [
            Sphere { center: v(i), radius: 1.0 }.into(),
            Disc { center: v(i), normal: Y, radius: 1.0 }.into(),
            Disc { center: O, normal: Y + v(i), radius: 1.0 }.into(),
            Triangle { vertices: [v(i), X, Z] }.into(),
            Cone { base_center: v(i), axis: Y, radius: 1.0, height: 1.0 }.into(),
            Cone { base_center: O, axis: Y + v(i), radius: 1.0, height: 1.0 }.into(),
            Rectangle { center: v(i), half_right: X, half_forward: Z }.into(),
            Rectangle { center: O, half_right: X + v(i), half_forward: Z }.into(),
            Plane { normal: Y + v(i), offset: 0.0 }.into(),
        ];
        all.extend(shapes.map(|s| (s, good)));
    }
    let shapes: [Shape; 5] = [
        Sphere { center: O, radius: bad }.into(),
        Disc { center: O, normal: Y, radius: bad }.into(),
        Cone { base_center: O, axis: Y, radius: bad, height: 1.0 }.into(),
        Cone { base_center: O, axis: Y, radius: 1.0, height: bad }.into(),
        Plane { normal: Y, offset: bad }.into(),
    ];
    all.extend(shapes.map(|s| (s, good)));
    all
}

#[test]
fn numbers_that_are_not_finite_block_nothing() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for (shape, light) in spoiled(bad) {
            assert_eq!(count(shape, light), 0, "{shape:?} {light:?}");
            assert!(!shape.blocks(&light, -Y), "{shape:?} {light:?}");
        }
        for shape in each(O) {
            for light in [point_light(Y * 5.0), point_light(Y * 0.1), Light::Directional { direction: -Y }] {
                for p in [Y * bad, X * bad, DVec3::splat(bad), DVec3::new(0.0, -2.0, bad)] {
                    assert!(!shape.blocks(&light, p), "{p} {shape:?} {light:?}");
                    let area = Blockers::new(&shape, &light).coverage(&Footprint { point: p, dx: X, dy: Z });
                    assert_eq!(area, 0.0, "{p} {shape:?}");
                }
                let spread = Footprint { point: -Y, dx: X * bad, dy: DVec3::splat(bad) };
                let area = Blockers::new(&shape, &light).coverage(&spread);
                assert!((0.0..=1.0).contains(&area), "{area} of an endless pixel: {shape:?} {light:?}");
            }
        }
    }
}

#[test]
fn finite_numbers_of_any_size_are_safe() {
    let mut random = Random(9);
    // Any bits at all, or one of all sizes.
    let any = |random: &mut Random| match random.choice(4) {
        0 => f64::from_bits(random.bits()),
        1 => random.decades(-200.0, 200.0) * if random.choice(2) == 0 { 1.0 } else { -1.0 },
        _ => random.within(-1.0, 2.0),
    };
    let vector = |random: &mut Random| DVec3::new(any(random), any(random), any(random));
    for _ in 0..200_000 {
        let (a, b, c, x, y) = (
            vector(&mut random),
            vector(&mut random),
            vector(&mut random),
            any(&mut random),
            any(&mut random),
        );
        let shapes: [Shape; 6] = [
            Sphere { center: a, radius: x }.into(),
            Disc { center: a, normal: b, radius: x }.into(),
            Triangle { vertices: [a, b, c] }.into(),
            Cone { base_center: a, axis: b, radius: x, height: y }.into(),
            Rectangle { center: a, half_right: b, half_forward: c }.into(),
            Plane { normal: a, offset: x }.into(),
        ];
        let shape = shapes[random.choice(6) as usize];
        let light = match random.choice(2) {
            0 => point_light(vector(&mut random)),
            _ => Light::Directional { direction: vector(&mut random) },
        };
        let footprint =
            Footprint { point: vector(&mut random), dx: vector(&mut random), dy: vector(&mut random) };
        let blockers = Blockers::new(&shape, &light);
        let area = blockers.coverage(&footprint);
        assert!((0.0..=1.0).contains(&area), "{area} {shape:?} {light:?} {footprint:?}");
        for (blocker, outline) in blockers.iter() {
            let single = Footprint { point: footprint.point.as_vec3(), dx: Vec3::X, dy: Vec3::Z };
            let _ = (blocker.to_f32().coverage(&single), blocker.blocks(footprint.point));
            outline.near_end(light.homogeneous(), true, |_, _| {});
        }
        let (center, radius) = shape.bounding_sphere();
        let _ = light.may_reach(center, radius);
    }
}
