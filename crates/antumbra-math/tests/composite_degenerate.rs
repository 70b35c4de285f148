//! The composite method where its equations do not hold: nothing turns over, nothing is NaN, and what
//! is refused says why.

mod plane_shadow_support;

use antumbra_math::composite::{self, CompositeShadow, PartShape, Refusal, SphereForm};
use antumbra_math::{Cone, Disc, Light, Plane, PlaneFrame, Rectangle, Shape, Sphere, Triangle};
use glam::{DVec2, DVec3};
use plane_shadow_support::Random;

fn floor() -> PlaneFrame {
    PlaneFrame::of_plane(&Plane::through(DVec3::ZERO, DVec3::Y)).expect("a plane")
}

fn cast(shape: &Shape, light: &Light) -> Result<CompositeShadow, Refusal> {
    let circle = composite::cast(shape, light, &floor(), SphereForm::Circle);
    let tangent = composite::cast(shape, light, &floor(), SphereForm::Tangent);
    assert_eq!(circle.map(|s| s.is_empty()), tangent.map(|s| s.is_empty()), "{shape:?} {light:?}");
    tangent
}

fn point(x: f64, y: f64, z: f64) -> Light {
    Light::Point { position: DVec3::new(x, y, z) }
}

/// One of each, between heights 1 and 2.
fn shapes() -> [Shape; 5] {
    let center = DVec3::Y * 1.5;
    [
        Disc { center: DVec3::Y * 2.0, normal: DVec3::Y, radius: 0.5 }.into(),
        Sphere { center, radius: 0.5 }.into(),
        Triangle { vertices: [DVec3::new(-0.4, 1.0, 0.0), DVec3::new(0.4, 1.0, 0.3), DVec3::Y * 2.0] }.into(),
        Cone { base_center: DVec3::Y, axis: DVec3::Y, radius: 0.5, height: 1.0 }.into(),
        Cone { base_center: DVec3::Y * 2.0, axis: -DVec3::Y, radius: 0.5, height: 1.0 }.into(),
    ]
}

fn moved(shape: &Shape, by: DVec3) -> Shape {
    shape.transformed(&glam::DMat4::from_translation(by))
}

#[test]
fn a_sinking_light_loses_its_shadow() {
    for shape in shapes() {
        for above in [2.0 + 1e-6, 2.1, 3.0, 100.0] {
            let shadow = cast(&shape, &point(1.0, above, 0.5)).expect("papers' pose");
            assert!(!shadow.is_empty(), "{shape:?} from a light at {above}");
        }
        // At its height, beside it, below it, in the plane, and on the other side of the plane.
        for below in [2.0 + 1e-10, 2.0, 1.5, 0.5, 0.0, -1e-20, -3.0] {
            let shadow = cast(&shape, &point(1.0, below, 0.5)).expect("papers' pose");
            assert!(shadow.is_empty(), "{shape:?} from a light at {below}");
        }
        for center in [shape.bounding_sphere().0, DVec3::Y * 1.5] {
            let inside = Light::Point { position: center };
            assert!(cast(&shape, &inside).expect("papers' pose").is_empty(), "{shape:?}: light inside");
        }
        for direction in [DVec3::Y, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::ZERO] {
            let sun = Light::Directional { direction };
            assert!(cast(&shape, &sun).expect("papers' pose").is_empty(), "{shape:?} along {direction}");
        }
        let spot = Light::Spot { position: DVec3::Y * 4.0, direction: DVec3::X, outer_angle: 0.1 };
        let lamp = cast(&shape, &point(0.0, 4.0, 0.0));
        assert_eq!(cast(&shape, &spot), lamp, "a spot is a point light");
    }
}

/// Behind the plane there is no light to block; from the other side the same shadow as from above.
#[test]
fn both_sides_of_the_plane() {
    for shape in shapes() {
        let behind = moved(&shape, DVec3::Y * -3.0);
        let light = point(1.0, 4.0, 0.5);
        assert!(cast(&behind, &light).expect("wholly behind").is_empty(), "{behind:?}");
        let light = point(1.0, -5.0, 0.5);
        assert!(!cast(&behind, &light).expect("wholly before").is_empty(), "{behind:?} from below");
    }
}

#[test]
fn standing_and_lying_on_the_plane() {
    let light = point(3.0, 4.0, 0.0);
    let ball = Sphere { center: DVec3::Y * 0.5, radius: 0.5 };
    assert!(!cast(&ball.into(), &light).expect("resting").is_empty(), "a resting ball");
    let cone: Shape = Cone { base_center: DVec3::ZERO, axis: DVec3::Y, radius: 0.5, height: 1.0 }.into();
    let shadow = cast(&cone, &light).expect("resting");
    // d = 0: x_s = 0, r_s = r, x_s3 = 3 * 1 / (1 - 4) = -1, k = 1: white, as published.
    let shapes: Vec<_> = shadow.parts().map(|part| part.shape).collect();
    assert_eq!(shapes.len(), 2, "{shapes:?}");
    let PartShape::Disc { center, radius } = shapes[0] else { panic!("{shapes:?}") };
    assert!(center.length() < 1e-15 && radius == 0.5, "{shapes:?}");
    assert!(shadow.parts().all(|part| part.shade == 1.0), "{shadow:?}");
    // Flat in the plane: nothing, as for any light.
    let disc = Disc { center: DVec3::ZERO, normal: DVec3::Y, radius: 1.0 };
    let triangle = Triangle { vertices: [DVec3::X, DVec3::Z, -DVec3::X] };
    for flat in [disc.into(), triangle.into()] {
        assert!(cast(&flat, &light).expect("on the surface").is_empty(), "{flat:?}");
    }
    // Model matrices in float32 may sink what stands on the plane by a ten-millionth.
    for shape in [ball.into(), cone] {
        let sunk = moved(&shape, DVec3::Y * -1e-7);
        assert!(!cast(&sunk, &light).expect("rounding").is_empty(), "{sunk:?}");
    }
}

#[test]
fn refusals_have_reasons() {
    let light = point(1.0, 6.0, 0.0);
    let tilted = DVec3::new(1e-5, 1.0, 0.0).normalize();
    let level = DVec3::new(1e-7, 1.0, 0.0).normalize();
    let disc = |normal| Shape::from(Disc { center: DVec3::Y, normal, radius: 0.5 });
    let cone = |axis| Shape::from(Cone { base_center: DVec3::Y, axis, radius: 0.5, height: 1.0 });
    assert_eq!(cast(&disc(tilted), &light), Err(Refusal::TiltedDisc), "a disc");
    assert_eq!(cast(&cone(tilted), &light), Err(Refusal::TiltedCone), "a cone");
    assert_eq!(cast(&cone(-tilted), &light), Err(Refusal::TiltedCone), "a cone upside down");
    for shape in [disc(level), disc(-level), cone(level), cone(-level)] {
        assert!(cast(&shape, &light).is_ok(), "{shape:?} is parallel but for rounding");
    }
    let plane = Plane::through(DVec3::Y, DVec3::Y);
    let rectangle = Rectangle { center: DVec3::Y, half_right: DVec3::X, half_forward: DVec3::Z };
    for shape in [plane.into(), rectangle.into()] {
        assert_eq!(cast(&shape, &light), Err(Refusal::Shape), "{shape:?}");
    }
    // In the plane they are the receiver itself.
    let own = Plane::through(DVec3::X, -DVec3::Y);
    let part = Rectangle { center: DVec3::X, half_right: DVec3::X, half_forward: DVec3::Z };
    for shape in [own.into(), part.into()] {
        assert_eq!(cast(&shape, &light), Ok(CompositeShadow::default()), "{shape:?}");
    }
    for shape in shapes().iter().skip(1) {
        let through = moved(shape, DVec3::Y * -1.5);
        for y in [6.0, -6.0, 0.0, 0.2] {
            let refused = cast(&through, &point(1.0, y, 0.0));
            assert_eq!(refused, Err(Refusal::ThroughPlane), "{through:?}: whatever the light");
        }
    }
    let reasons = [Refusal::Shape, Refusal::TiltedDisc, Refusal::TiltedCone, Refusal::ThroughPlane];
    let mut texts: Vec<String> = reasons.iter().map(ToString::to_string).collect();
    texts.sort();
    texts.dedup();
    assert_eq!(texts.len(), reasons.len(), "{texts:?}");
}

#[test]
fn nothing_comes_of_nothing() {
    let light = point(1.0, 6.0, 0.0);
    let center = DVec3::Y;
    for size in [0.0, -0.5, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut shapes: Vec<Shape> = vec![
            Disc { center, normal: DVec3::Y, radius: size }.into(),
            Sphere { center, radius: size }.into(),
            Cone { base_center: center, axis: DVec3::Y, radius: size, height: 1.0 }.into(),
        ];
        if size != 0.0 {
            shapes.push(Cone { base_center: center, axis: DVec3::Y, radius: 0.5, height: size }.into());
        }
        for shape in shapes {
            assert_eq!(cast(&shape, &light), Ok(CompositeShadow::default()), "{shape:?}");
        }
    }
    for vertices in [[center; 3], [DVec3::Y, DVec3::Y, DVec3::X + DVec3::Y], [DVec3::NAN; 3]] {
        let triangle = Triangle { vertices }.into();
        assert_eq!(cast(&triangle, &light), Ok(CompositeShadow::default()), "{vertices:?}");
    }
    let without_normal = Disc { center, normal: DVec3::ZERO, radius: 1.0 }.into();
    assert_eq!(cast(&without_normal, &light), Ok(CompositeShadow::default()), "no normal");
    let without_axis = Cone { base_center: center, axis: DVec3::ZERO, radius: 1.0, height: 1.0 }.into();
    assert_eq!(cast(&without_axis, &light), Ok(CompositeShadow::default()), "no axis");
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for shape in shapes() {
            for light in [point(bad, 6.0, 0.0), point(0.0, bad, 0.0), point(0.0, 6.0, bad)] {
                assert_eq!(cast(&shape, &light), Ok(CompositeShadow::default()), "{shape:?} {light:?}");
            }
            let frame = PlaneFrame { origin: DVec3::splat(bad), ..floor() };
            let shadow = composite::cast(&shape, &light, &frame, SphereForm::Tangent);
            assert_eq!(shadow, Ok(CompositeShadow::default()), "{frame:?}");
        }
    }
    // A cone of height zero is a disc.
    let flat = Cone { base_center: center, axis: DVec3::Y, radius: 0.5, height: 0.0 };
    let disc = Disc { center, normal: DVec3::Y, radius: 0.5 };
    assert_eq!(cast(&flat.into(), &light), cast(&disc.into(), &light), "a cone of height zero");
}

/// A number of any kind: usual, tiny, huge, zero, infinite, NaN.
fn any(random: &mut Random) -> f64 {
    match random.choice(12) {
        0 => 0.0,
        1 => f64::NAN,
        2 => f64::INFINITY,
        3 => random.decades(-300.0, 300.0),
        4 => -random.decades(-300.0, 300.0),
        5 => f64::from_bits(random.bits()),
        6 | 7 => random.within(-1.0, 1.0) * 1e-8,
        _ => random.within(-4.0, 4.0),
    }
}

#[test]
fn any_input_gives_finite_shapes() {
    let mut random = Random(61);
    let (mut shadows, mut refused) = (0, 0);
    for _ in 0..300_000 {
        let mut vector = || DVec3::new(any(&mut random), any(&mut random), any(&mut random));
        let (a, b, c, position, normal) = (vector(), vector(), vector(), vector(), vector());
        let up = if random.choice(2) == 0 { DVec3::Y } else { b };
        let (radius, height) = (any(&mut random), any(&mut random));
        let shape: Shape = match random.choice(4) {
            0 => Disc { center: a, normal: up, radius }.into(),
            1 => Sphere { center: a, radius }.into(),
            2 => Triangle { vertices: [a, b, c] }.into(),
            _ => Cone { base_center: a, axis: up, radius, height }.into(),
        };
        let light = match random.choice(3) {
            0 => Light::Directional { direction: position },
            _ => Light::Point { position },
        };
        let plane = Plane { normal, offset: any(&mut random) };
        let frame = match random.choice(3) {
            0 => PlaneFrame::of_plane(&plane).unwrap_or(floor()),
            1 => PlaneFrame { origin: c, u: a, v: b, normal },
            _ => floor(),
        };
        let form = if random.choice(2) == 0 { SphereForm::Circle } else { SphereForm::Tangent };
        let Ok(shadow) = composite::cast(&shape, &light, &frame, form) else {
            refused += 1;
            continue;
        };
        for part in shadow.parts() {
            shadows += 1;
            assert!((0.0..=1.0).contains(&part.shade), "{part:?}");
            let is_finite = match part.shape {
                PartShape::Disc { center, radius } => {
                    center.is_finite() && radius.is_finite() && radius > 0.0
                }
                PartShape::Triangle { vertices } => vertices.iter().all(|p| p.is_finite()),
            };
            assert!(is_finite, "{part:?} of {shape:?} from {light:?} on {frame:?}");
            part.shape.contains(DVec2::new(any(&mut random), any(&mut random)));
        }
    }
    assert!(shadows > 500 && refused > 500, "{shadows} shadows, {refused} refused");
}
