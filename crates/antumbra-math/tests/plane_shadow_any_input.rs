//! Shadows on planes for any input: no panic and no contradiction whatever the numbers are, and the
//! same shadow whatever the unit of length.

mod plane_shadow_support;

use antumbra_math::plane_shadow::{Bounds, PlaneFrame, PlaneShadow, ShadowKind};
use antumbra_math::{Cone, Disc, Light, Plane, Rectangle, Shape, Sphere, Triangle};
use glam::{DVec2, DVec3};
use plane_shadow_support::Random;
use plane_shadow_support::settings::setting;

#[test]
fn the_unit_of_length_does_not_matter() {
    let mut random = Random(32);
    for i in 0..20_000 {
        let mut small = setting(&mut random, i % 5);
        if matches!(small.light, Light::Point { .. } | Light::Spot { .. }) {
            // A spot has a direction that must not be scaled, and a point light no other part.
            let position = small.light.homogeneous().truncate();
            small.light = Light::Point { position };
        }
        let shadow = PlaneShadow::cast(&small.occluder, &small.light, &small.frame);
        for unit in [2.0_f64.powi(100), 2.0_f64.powi(-100)] {
            let light = match small.light {
                Light::Point { position } => Light::Point { position: position * unit },
                light => light,
            };
            let frame = PlaneFrame { origin: small.frame.origin * unit, ..small.frame };
            let scaled = PlaneShadow::cast(&scaled(&small.occluder, unit), &light, &frame);
            assert_eq!(scaled.kind(), shadow.kind(), "{small:?}");
            for _ in 0..10 {
                let point = small.frame.coordinates(random.vector(10.0 * small.size));
                let (here, there) = (shadow.contains(point), scaled.contains(point * unit));
                assert_eq!(here, there, "{unit:e} {point} {small:?}");
            }
        }
    }
}

/// The occluder in another unit of length.
fn scaled(shape: &Shape, unit: f64) -> Shape {
    match *shape {
        Shape::Sphere(s) => Sphere { center: s.center * unit, radius: s.radius * unit }.into(),
        Shape::Disc(d) => Disc { center: d.center * unit, radius: d.radius * unit, ..d }.into(),
        Shape::Cone(c) => {
            Cone { base_center: c.base_center * unit, radius: c.radius * unit, height: c.height * unit, ..c }
                .into()
        }
        Shape::Triangle(t) => Triangle { vertices: t.vertices.map(|p| p * unit) }.into(),
        Shape::Rectangle(r) => Rectangle {
            center: r.center * unit,
            half_right: r.half_right * unit,
            half_forward: r.half_forward * unit,
        }
        .into(),
        Shape::Plane(p) => Plane { offset: p.offset * unit, ..p }.into(),
        _ => unreachable!("a shape that this test does not know"),
    }
}

/// A number of any kind.
fn wild(random: &mut Random) -> f64 {
    match random.choice(12) {
        0 => 0.0,
        1 => -0.0,
        2 => f64::NAN,
        3 => f64::INFINITY,
        4 => f64::NEG_INFINITY,
        5 => f64::from_bits(random.bits()),
        6 => f64::MIN_POSITIVE,
        7 => f64::MAX,
        8 => 1.0,
        _ => random.within(-3.0, 3.0),
    }
}

fn wild_vector(random: &mut Random) -> DVec3 {
    let usual = random.choice(3) > 0;
    if usual { random.vector(3.0) } else { DVec3::new(wild(random), wild(random), wild(random)) }
}

#[test]
fn no_input_panics() {
    let mut random = Random(31);
    let r = &mut random;
    for _ in 0..400_000 {
        let (a, b, c) = (wild_vector(r), wild_vector(r), wild_vector(r));
        let shape: Shape = match r.choice(6) {
            0 => Sphere { center: a, radius: wild(r) }.into(),
            1 => Disc { center: a, normal: b, radius: wild(r) }.into(),
            2 => Cone { base_center: a, axis: b, radius: wild(r), height: wild(r) }.into(),
            3 => Triangle { vertices: [a, b, c] }.into(),
            4 => Rectangle { center: a, half_right: b, half_forward: c }.into(),
            _ => Plane { normal: a, offset: wild(r) }.into(),
        };
        let position = wild_vector(r);
        let light = match r.choice(2) {
            0 => Light::Point { position },
            _ => Light::Directional { direction: position },
        };
        let plane = Plane { normal: wild_vector(r).normalize_or(DVec3::Z), offset: wild(r) };
        let Some(frame) = PlaneFrame::of_plane(&plane) else { continue };
        let shadow = PlaneShadow::cast(&shape, &light, &frame);
        let window = Bounds::around(DVec2::new(wild(r), wild(r)), wild(r));
        let point = DVec2::new(wild(r), wild(r));
        let part = shadow.clipped(&window);
        assert!(part.outline(20, &window).len() < 100, "{shape:?} {light:?}");
        assert!(shadow.area() >= 0.0 && part.area() >= 0.0, "{shape:?} {light:?} {plane:?}");
        assert!(point.is_finite() || !shadow.contains(point), "{shape:?} {light:?}");
        let none = shadow.kind() == ShadowKind::Nothing;
        assert_eq!(shadow.bounds().is_none(), none, "{shape:?} {light:?} {plane:?}");
        assert!(shadow.outline(0, &Bounds::EVERYTHING).iter().all(|p| p.is_finite()), "{shape:?}");
        let _ = (shadow.conic(), shadow.axes());
    }
}
