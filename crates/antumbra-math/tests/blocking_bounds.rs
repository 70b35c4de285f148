//! What a renderer may leave out: the hull around a shadow holds all of it, balls hold their shapes, no
//! light is culled that arrives; and nothing depends on where the world's origin is.

mod blocking_support;
mod plane_shadow_support;

use antumbra_math::blocking::{Blockers, Outline};
use antumbra_math::{Light, Shape};
use blocking_support::{NAMES, Oracle, PLANE, Setting, ask, cases, point_of, setting, shape};
use glam::{DMat4, DQuat, DVec3, DVec4};
use plane_shadow_support::Random;

/// The facets of the convex hull of points and rays, as homogeneous planes that are not negative
/// inside: by trying all triples of the generators (p, 1) and (d, 0) of a cone in four dimensions.
fn facets(generators: &[DVec4]) -> Vec<DVec4> {
    let mut facets = Vec::new();
    for (i, a) in generators.iter().enumerate() {
        for (j, b) in generators.iter().enumerate().skip(i + 1) {
            for c in &generators[j + 1..] {
                let plane = orthogonal(*a, *b, *c);
                // Three generators that depend on each other span nothing.
                if plane.length() < 1e-7 {
                    continue;
                }
                let plane = plane.normalize();
                for plane in [plane, -plane] {
                    if generators.iter().all(|g| plane.dot(*g) >= -1e-10) {
                        facets.push(plane);
                    }
                }
            }
        }
    }
    facets
}

/// The vector orthogonal to three in four dimensions.
fn orthogonal(a: DVec4, b: DVec4, c: DVec4) -> DVec4 {
    let minor = |i: usize, j: usize, k: usize| {
        DVec3::new(a[i], a[j], a[k]).dot(DVec3::new(b[i], b[j], b[k]).cross(DVec3::new(c[i], c[j], c[k])))
    };
    DVec4::new(minor(1, 2, 3), -minor(0, 2, 3), minor(0, 1, 3), -minor(0, 1, 2))
}

/// A setting at the origin, with a light that does not graze the shape.
fn moderate(random: &mut Random, kind: u64) -> Setting {
    let center = random.vector(1.0);
    let light = match random.choice(4) {
        0 => Light::Directional { direction: random.direction() },
        _ => Light::Point { position: center + random.direction() * random.decades(-0.5, 1.2) },
    };
    Setting { shape: shape(random, kind, 1.0, center), light, size: 1.0, center }
}

#[test]
fn the_hull_of_a_shadow_holds_it() {
    for kind in 0..PLANE {
        let mut random = Random(20 + kind);
        let (mut held, mut near_edge) = (0_u64, 0_u64);
        for _ in 0..cases(1500) {
            let setting = moderate(&mut random, kind);
            for (blocker, outline) in Blockers::new(&setting.shape, &setting.light).iter() {
                if *outline == Outline::Everywhere {
                    continue;
                }
                for hollow in [true, false] {
                    let light = setting.light.homogeneous();
                    let mut generators = Vec::new();
                    outline.near_end(light, hollow, |p, extends| {
                        generators.push(p.extend(1.0).normalize());
                        if extends {
                            generators.push((p * light.w - light.truncate()).normalize().extend(0.0));
                        }
                    });
                    let facets = facets(&generators);
                    assert!(facets.len() >= 4, "{} facets of {setting:?}", facets.len());
                    for _ in 0..40 {
                        let p = ask(&mut random, &setting);
                        let inside =
                            matches!(setting.shape, Shape::Sphere(s) if p.distance(s.center) <= s.radius);
                        if !blocker.blocks(p) || (inside && !hollow) {
                            continue;
                        }
                        let p = p.extend(1.0).normalize();
                        let least = facets.iter().map(|f| f.dot(p)).fold(f64::INFINITY, f64::min);
                        held += 1;
                        near_edge += u64::from(least < 0.01);
                        assert!(least >= -1e-9, "{least:e} outside, of {setting:?}, hollow {hollow}");
                    }
                }
            }
        }
        println!("{}: {held} dark points in their hulls, {near_edge} near an edge", NAMES[kind as usize]);
        assert!(held > 20_000 && near_edge > 1000, "enough points: {held}, {near_edge}");
    }
}

#[test]
fn a_ball_that_the_light_touches_has_no_outline() {
    use antumbra_math::Sphere;
    let ball = Shape::from(Sphere { center: DVec3::ZERO, radius: 2.0 });
    for (height, everywhere) in [(2.0, true), (2.0 + 1e-9, true), (2.0001, false)] {
        let light = Light::Point { position: DVec3::Y * height };
        let blockers = Blockers::new(&ball, &light);
        let (_, outline) = blockers.iter().next().expect("a blocker");
        assert_eq!(*outline == Outline::Everywhere, everywhere, "from {height}");
    }
}

#[test]
fn balls_hold_their_shapes() {
    let mut random = Random(30);
    for i in 0..cases(200_000) as u64 {
        let setting = setting(&mut random, i % PLANE);
        let (center, radius) = setting.shape.bounding_sphere();
        let p = point_of(&mut random, &setting);
        // Rounding of coordinates up to a hundred sizes.
        assert!(p.distance(center) <= radius + 1e-12 * setting.size, "{p} of {:?}", setting.shape);
    }
    let plane = setting(&mut random, PLANE);
    assert_eq!(plane.shape.bounding_sphere().1, f64::INFINITY, "a plane has no ball");
}

#[test]
fn no_light_is_culled_that_arrives() {
    let mut random = Random(31);
    let (mut culled, mut reached) = (0, 0);
    for i in 0..cases(300_000) as u64 {
        let Setting { shape, size, center, .. } = setting(&mut random, i % PLANE);
        let (position, direction) = (center + random.vector(10.0 * size), random.direction());
        let light = Light::Spot { position, direction, outer_angle: random.decades(-3.0, 0.196) };
        let Light::Spot { outer_angle, .. } = light else { continue };
        let (ball, radius) = shape.bounding_sphere();
        let p = ball + random.direction() * radius * random.within(0.0, 1.0);
        let lit = (p - position).angle_between(direction) < outer_angle;
        culled += u64::from(!light.may_reach(ball, radius));
        if lit {
            reached += 1;
            assert!(light.may_reach(ball, radius), "{p} in {shape:?} is lit by {light:?}");
        }
    }
    assert!(culled > 10_000 && reached > 10_000, "both kinds: {culled} culled, {reached} lit points");
    for light in [Light::Point { position: DVec3::ZERO }, Light::Directional { direction: DVec3::Y }] {
        assert!(light.may_reach(DVec3::ONE, 0.0), "nothing limits {light:?}");
    }
    let spot = Light::Spot { position: DVec3::ZERO, direction: DVec3::Y, outer_angle: 0.5 };
    assert!(spot.may_reach(-DVec3::Y, f64::INFINITY), "a plane is everywhere");
    assert!(spot.may_reach(DVec3::ZERO, 0.0), "the light's own place");
    assert!(!spot.may_reach(-DVec3::Y, 0.9), "behind the spot");
}

#[test]
fn moving_everything_changes_nothing() {
    let mut random = Random(32);
    let mut decided = 0;
    for i in 0..cases(100_000) as u64 {
        let kind = i % 6;
        let setting = setting(&mut random, kind);
        let turn = DQuat::from_axis_angle(random.direction(), random.within(-3.0, 3.0));
        let motion = DMat4::from_rotation_translation(turn, random.vector(10.0 * setting.size));
        let (shape, light) = (setting.shape.transformed(&motion), setting.light.transformed(&motion));
        let oracle = Oracle::new(&setting.shape, &setting.light);
        for _ in 0..4 {
            let p = ask(&mut random, &setting);
            if oracle.decide(p, 1e-9 * setting.size * oracle.magnification()).is_some() {
                decided += 1;
                let there = shape.blocks(&light, motion.transform_point3(p));
                assert_eq!(
                    there,
                    setting.shape.blocks(&setting.light, p),
                    "{p} {setting:?} moved by {motion}"
                );
            }
        }
    }
    assert!(decided > 200_000, "enough cases: {decided}");
}
