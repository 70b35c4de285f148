//! Soft shadows where formulas have nothing to hold on to.

use antumbra_math::soft::{AreaLight, Nodes, pair_visibility, visibility};
use antumbra_math::{Cone, Disc, Plane, Rectangle, Shape, Sphere, Triangle};
use glam::DVec3;

const UP: DVec3 = DVec3::Y;

fn ball(y: f64, radius: f64) -> AreaLight {
    AreaLight::Sphere { center: DVec3::Y * y, radius }
}

fn disc(y: f64, radius: f64) -> AreaLight {
    AreaLight::Disc { center: DVec3::Y * y, direction: -UP, radius }
}

fn square(y: f64, half: f64) -> AreaLight {
    AreaLight::Rectangle {
        center: DVec3::Y * y,
        direction: -UP,
        half_right: DVec3::X * half,
        half_up: DVec3::Z * half,
    }
}

fn shapes(center: DVec3, size: f64) -> [Shape; 6] {
    let corner = |x: f64, z: f64| center + DVec3::new(x, 0.0, z) * size;
    [
        Sphere { center, radius: size }.into(),
        Disc { center, normal: UP, radius: size }.into(),
        Triangle { vertices: [corner(-1.0, -1.0), corner(1.0, -1.0), corner(0.0, 1.0)] }.into(),
        Rectangle { center, half_right: DVec3::X * size, half_forward: DVec3::Z * size }.into(),
        Cone { base_center: center, axis: UP, radius: size, height: 1.5 * size }.into(),
        Plane::through(center, UP).into(),
    ]
}

fn one(light: &AreaLight, shape: &Shape, point: DVec3, normal: DVec3) -> f64 {
    pair_visibility(light, shape, point, normal, &Nodes::new(8))
}

#[test]
fn behind_everything_and_beside_everything() {
    for light in [ball(4.0, 0.5), disc(4.0, 0.5), square(4.0, 0.5)] {
        for shape in shapes(DVec3::Y * 2.0, 1.5) {
            assert_eq!(one(&light, &shape, DVec3::ZERO, UP), 0.0, "{shape:?} hides all of {light:?}");
            let lower = shape.transformed(&glam::DMat4::from_translation(-UP * 6.0));
            assert_eq!(one(&light, &lower, DVec3::ZERO, UP), 1.0, "{lower:?} is below");
            let higher = shape.transformed(&glam::DMat4::from_translation(UP * 8.0));
            assert_eq!(one(&light, &higher, DVec3::ZERO, UP), 1.0, "{higher:?} is beyond the light");
            assert_eq!(one(&light, &shape, DVec3::ZERO, -UP), 0.0, "faces away");
        }
    }
}

#[test]
fn half_of_a_light_is_half() {
    for light in [ball(4.0, 0.5), disc(4.0, 0.5), square(4.0, 0.5)] {
        // Its side runs through the axis from the point to the light.
        let center = DVec3::new(5.0, 2.0, 0.0);
        let half: Shape =
            Rectangle { center, half_right: DVec3::X * 5.0, half_forward: DVec3::Z * 9.0 }.into();
        let v = one(&light, &half, DVec3::ZERO, UP);
        // The edge is straight across all strips, or along one: .003 is what eight nodes leave.
        assert!((v - 0.5).abs() < 5e-3, "{light:?}: {v}");
    }
}

#[test]
fn inside_and_behind() {
    let shape = shapes(DVec3::Y * 2.0, 0.5)[0];
    assert_eq!(one(&ball(0.0, 1.0), &shape, DVec3::ZERO, UP), 1.0, "inside a glowing ball");
    assert_eq!(one(&disc(-1.0, 1.0), &shape, DVec3::ZERO, -UP), 0.0, "behind a disc");
    assert_eq!(one(&square(0.0, 1.0), &shape, DVec3::X, UP), 0.0, "in a rectangle's plane");
    for shape in &shapes(DVec3::ZERO, 1.0)[..1] {
        assert_eq!(one(&ball(4.0, 0.5), shape, DVec3::Y * 0.2, UP), 0.0, "inside {shape:?}");
    }
    assert_eq!(one(&ball(9.0, 0.5), &shapes(DVec3::ZERO, 1.0)[4], DVec3::Y * 0.2, UP), 0.0, "inside a cone");
}

/// Flat shapes hide nothing from a point in their plane.
#[test]
fn in_the_plane_of_a_flat_shape() {
    for light in [ball(4.0, 0.5), disc(4.0, 0.5), square(4.0, 0.5)] {
        for shape in [&shapes(DVec3::ZERO, 1.0)[1..4], &shapes(DVec3::ZERO, 1.0)[5..]].concat() {
            for point in [DVec3::ZERO, DVec3::X * 0.5, DVec3::X * 3.0] {
                let v = one(&light, &shape, point, UP);
                assert_eq!(v, 1.0, "{shape:?} at {point}");
            }
        }
    }
}

/// Sizes of nothing, infinities, and numbers that are none: a visibility all the same, and no panic.
#[test]
fn any_number() {
    let odd = [0.0, -0.0, 1e-300, 1e300, -1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 1.0, 1e-9];
    let nodes = Nodes::new(8);
    let single = Nodes::new(8);
    let mut count = 0u32;
    for a in odd {
        for b in odd {
            for light in [ball(a, b), disc(a, b), square(b, a)] {
                for shape in shapes(DVec3::new(b, a, 0.5), b).into_iter().chain(shapes(DVec3::Y, a)) {
                    for point in [DVec3::ZERO, DVec3::new(a, 0.0, b)] {
                        let v = pair_visibility(&light, &shape, point, UP, &nodes);
                        let all = visibility(&light, &[shape, shape], point, UP, &nodes);
                        let s = pair_visibility(&light, &shape, point.as_vec3(), glam::Vec3::Y, &single);
                        for v in [v, all, f64::from(s)] {
                            assert!((0.0..=1.0).contains(&v), "{light:?}, {shape:?}, {point}: {v}");
                        }
                        count += 1;
                    }
                }
            }
        }
    }
    assert!(count > 5000, "{count} combinations");
}

/// A shape twice hides what it hides once, and the union is never less than one of its parts.
#[test]
fn unions() {
    let nodes = Nodes::new(24);
    for light in [ball(4.0, 0.8), disc(4.0, 0.8), square(4.0, 0.8)] {
        let shapes = shapes(DVec3::new(0.3, 1.5, 0.1), 0.4);
        for point in (0..20).map(|i| DVec3::new(f64::from(i) * 0.1 - 1.0, 0.0, 0.05)) {
            for shape in &shapes[..5] {
                let single = pair_visibility(&light, shape, point, UP, &nodes);
                let double = visibility(&light, &[*shape, *shape], point, UP, &nodes);
                assert!(
                    (single - double).abs() < 2e-3,
                    "{shape:?} at {point}: {single} once, {double} twice"
                );
            }
            let all = visibility(&light, &shapes[..5], point, UP, &nodes);
            for shape in &shapes[..5] {
                let single = pair_visibility(&light, shape, point, UP, &nodes);
                assert!(all <= single + 5e-3, "{all} past all, {single} past {shape:?}");
            }
        }
    }
}

/// A sun seen from a planet, in metres: half a degree of angle at 150 million kilometres.
#[test]
fn float32_at_the_sun_s_size() {
    let light = AreaLight::Sphere { center: DVec3::new(0.0, 1.5e11, 0.3e11), radius: 7e8 };
    let (nodes, nodes_32) = (Nodes::new(8), Nodes::new(8));
    let mut partial = 0;
    for i in 0..2000 {
        let point = DVec3::new(f64::from(i) * 1e-3 - 1.0, 0.0, -2.0);
        let shape: Shape = Sphere { center: DVec3::new(0.0, 10.0, 0.0), radius: 0.7 }.into();
        let v = pair_visibility(&light, &shape, point, UP, &nodes);
        let single = pair_visibility(&light, &shape, point.as_vec3(), glam::Vec3::Y, &nodes_32);
        partial += u32::from(v > 0.0 && v < 1.0);
        assert!((f64::from(single) - v).abs() < 1e-3, "at {point}: {single} for {v}");
    }
    assert!(partial > 50, "{partial} points are in the penumbra");
}
