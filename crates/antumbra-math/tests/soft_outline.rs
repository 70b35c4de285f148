//! Outlines of umbra, penumbra and antumbra against visibilities, rays and tangents.

use core::f64::consts::TAU;

use antumbra_math::plane_shadow::Bounds;
use antumbra_math::soft::{AreaLight, Nodes, PenumbraOutline, Zone, pair_visibility};
use antumbra_math::{Light, Plane, PlaneFrame, PlaneShadow, ShadowKind, Shape, Sphere};
use glam::{DVec2, DVec3};

fn unit(rng: &mut fastrand::Rng) -> DVec3 {
    loop {
        let v = DVec3::from_array([0; 3].map(|_| rng.f64() * 2.0 - 1.0));
        if (0.01..1.0).contains(&v.length_squared()) {
            return v.normalize();
        }
    }
}

struct Setup {
    light: Sphere,
    ball: Sphere,
    frame: PlaneFrame,
    outline: PenumbraOutline,
}

/// Two balls apart in any direction, radii within a factor of 20 or equal, and a plane that passes
/// anywhere between the two, behind either, or through them.
fn setup(rng: &mut fastrand::Rng) -> Setup {
    let center = unit(rng) * (rng.f64() * 10.0);
    let (big_r, r) = (0.05 * 20.0_f64.powf(rng.f64()), 0.05 * 20.0_f64.powf(rng.f64()));
    let big_r = if rng.u8(..8) == 0 { r } else { big_r };
    let axis = unit(rng);
    let distance = (big_r + r) * (1.0 + 6.0 * rng.f64().powi(2));
    let light = Sphere { center: center - axis * distance, radius: big_r };
    let ball = Sphere { center, radius: r };
    // Most planes across the axis beyond the ball, some at any angle.
    let tilt = if rng.u8(..4) == 0 { 10.0 } else { 1.0 };
    let normal = (axis + unit(rng) * rng.f64() * tilt).normalize();
    let through = center + axis * (r * (rng.f64().powi(2) * 40.0 - 2.0)) + unit(rng) * r;
    let frame = PlaneFrame::of_plane(&Plane::through(through, normal)).expect("a plane");
    let outline = PenumbraOutline::new(&light, &ball, &frame).expect("apart");
    Setup { light, ball, frame, outline }
}

/// A point of the plane that something happens at: behind a point of the ball, slightly enlarged, as
/// seen from one of the light.
fn point(s: &Setup, rng: &mut fastrand::Rng) -> Option<DVec2> {
    let from = s.light.center + unit(rng) * s.light.radius;
    let over = s.ball.center + unit(rng) * (s.ball.radius * 1.5 * rng.f64());
    let (a, b) = (s.frame.height(from), s.frame.height(over));
    let p = from + (over - from) * (a / (a - b));
    ((p - s.ball.center).length() < 1e3).then(|| s.frame.coordinates(p))
}

/// Half-angles of light and ball and the angle between their centres.
fn angles(s: &Setup, p: DVec3) -> (f64, f64, f64) {
    let (l, c) = (s.light.center - p, s.ball.center - p);
    let half = |v: DVec3, radius: f64| (radius / v.length()).min(1.0).asin();
    (half(l, s.light.radius), half(c, s.ball.radius), l.cross(c).length().atan2(l.dot(c)))
}

/// Whether an edge passes by: an angle within `margin` of another, of light or ball.
fn is_near_an_edge(s: &Setup, p: DVec3, margin: f64) -> bool {
    let (alpha, beta, d) = angles(s, p);
    let surface = (s.ball.center - p).length() / s.ball.radius - 1.0;
    let nearest = (alpha + beta - d).abs().min(((alpha - beta).abs() - d).abs());
    nearest < margin * alpha.min(beta) || surface.abs() < margin
}

#[test]
fn zones_are_those_of_visibility() {
    let mut rng = fastrand::Rng::with_seed(1);
    let nodes = Nodes::new(16);
    let (mut counts, mut near, mut order) = ([0_u32; 4], 0, 0);
    while counts.iter().sum::<u32>() < 120_000 {
        let s = setup(&mut rng);
        let height = s.frame.height(s.light.center);
        if height.abs() < s.light.radius {
            continue; // visibility knows a horizon
        }
        let (normal, shape) = (s.frame.normal * height.signum(), Shape::from(s.ball));
        let light = AreaLight::Sphere { center: s.light.center, radius: s.light.radius };
        for q in (0..60).filter_map(|_| point(&s, &mut rng)).collect::<Vec<_>>() {
            let p = s.frame.point(q);
            // A quadrature cannot tell a sliver between its nodes from nothing; rays (below) can.
            if is_near_an_edge(&s, p, 0.01) {
                near += 1;
                continue;
            }
            let (l, c) = (s.light.center - p, s.ball.center - p);
            // Visibility compares the distances of the centres, which is not always which ball is before
            // the other.
            let power =
                c.length_squared() - s.ball.radius.powi(2) < l.length_squared() - s.light.radius.powi(2);
            if power != (c.length() < l.length()) {
                order += 1;
                continue;
            }
            let v = pair_visibility(&light, &shape, p, normal, &nodes);
            let zone = s.outline.zone(q);
            counts[zone as usize] += 1;
            let what = || format!("{zone:?} sees {v} at {p}, {:?}, {:?}, {:?}", s.light, s.ball, s.frame);
            match zone {
                // Sums of a few terms of size 1, and what the quadrature makes of a light all hidden.
                Zone::Lit => assert!(v > 1.0 - 1e-12, "{}", what()),
                Zone::Umbra => assert!(v < 1e-6, "{}", what()),
                Zone::Penumbra => assert!(0.0 < v && v < 1.0, "{}", what()),
                Zone::Antumbra => {
                    // The irradiance of a whole cap over that of the other, both above the horizon.
                    let (alpha, beta, _) = angles(&s, p);
                    let cap = |half: f64, to: DVec3| half.sin().powi(2) * normal.dot(to.normalize());
                    let exact = 1.0 - cap(beta, c) / cap(alpha, l);
                    // The quadrature's own error, on lights that fill half the sky.
                    assert!((v - exact).abs() < 0.004, "not {exact}: {}", what());
                }
            }
        }
    }
    println!("lit, penumbra, umbra, antumbra {counts:?}; left out: at edges {near}, order {order}");
    assert!(counts.iter().all(|&n| n > 4_000), "every zone is met: {counts:?}");
    assert!(near < 12_000 && order < 6_000, "few are left out: {near} at edges, {order} for their order");
}

/// Rays to points of the light, whatever lies on either side of the plane.
#[test]
fn zones_are_those_of_rays() {
    let mut rng = fastrand::Rng::with_seed(2);
    let (mut counts, mut through, mut curved) = ([0_u32; 4], 0, [0_u32; 2]);
    for _ in 0..3_000 {
        let s = setup(&mut rng);
        through += u32::from(s.frame.height(s.light.center).abs() < s.light.radius);
        curved[0] += u32::from(s.outline.umbra().kind() == ShadowKind::Hull);
        curved[1] += u32::from(s.outline.antumbra().kind() == ShadowKind::Hyperbola);
        for q in (0..40).filter_map(|_| point(&s, &mut rng)).collect::<Vec<_>>() {
            let p = s.frame.point(q);
            let inside = (p - s.light.center).length() < s.light.radius;
            if is_near_an_edge(&s, p, 1e-6) || inside {
                continue;
            }
            let blocked = |to: DVec3| {
                let d = to - p;
                let t = ((s.ball.center - p).dot(d) / d.length_squared()).clamp(0.0, 1.0);
                (p + d * t - s.ball.center).length() < s.ball.radius
            };
            // The disc that the point sees the light as.
            let (alpha, beta, d) = angles(&s, p);
            let to_light = s.light.center - p;
            let (axis, reach) = (to_light.normalize(), to_light.length() * alpha.cos());
            let side = axis.any_orthonormal_vector();
            let at = |turn: f64, out: f64| {
                let across = side * turn.cos() + axis.cross(side) * turn.sin();
                p + (axis * (out * alpha).cos() + across * (out * alpha).sin()) * reach
            };
            let rim: Vec<bool> = (0..32).map(|i| blocked(at(f64::from(i) * TAU / 32.0, 1.0))).collect();
            let rays: Vec<bool> = (0..32).map(|_| blocked(at(rng.f64() * TAU, rng.f64()))).collect();
            let zone = s.outline.zone(q);
            counts[zone as usize] += 1;
            let what = format!("{zone:?} at {p}, {:?}, {:?}, {:?}", s.light, s.ball, s.frame);
            let (some, all) = (|r: &[bool]| r.iter().any(|&b| b), |r: &[bool]| r.iter().all(|&b| b));
            match zone {
                Zone::Lit => assert!(!some(&rim) && !some(&rays), "{what}"),
                Zone::Umbra => assert!(all(&rim) && all(&rays), "{what}"),
                Zone::Antumbra => assert!(
                    !some(&rim)
                        && d + beta < alpha
                        && blocked(s.light.center.lerp(s.ball.center, 1.0 - 1e-9)),
                    "{what}"
                ),
                Zone::Penumbra => {
                    // The rim's point nearest to the ball is hidden, the one farthest from it is not.
                    let toward = (s.ball.center - p).reject_from_normalized(axis).normalize();
                    let rim = |across: DVec3| p + (axis * alpha.cos() + across * alpha.sin()) * reach;
                    assert!(blocked(rim(toward)) && !blocked(rim(-toward)), "{what}");
                }
            }
        }
    }
    println!(
        "lit, penumbra, umbra, antumbra {counts:?}; lights through the plane {through}; hulls {curved:?}"
    );
    assert!(counts.iter().all(|&n| n > 3_000) && through > 100, "all are met: {counts:?}, {through}");
    assert!(curved[0] > 50 && curved[1] > 50, "tips cut at the ball, cones cut lengthwise: {curved:?}");
}

/// Distance of `center` from the line through `a` and `b`.
fn distance(center: DVec3, a: DVec3, b: DVec3) -> f64 {
    let along = (b - a).normalize();
    (center - a).cross(along).length()
}

#[test]
fn lines_through_the_outlines_and_the_apexes_touch_both_balls() {
    let mut rng = fastrand::Rng::with_seed(3);
    let mut touched = [0; 3];
    for _ in 0..2_000 {
        let s = setup(&mut rng);
        if s.frame.height(s.ball.center).abs() < s.ball.radius {
            continue; // the section's edge is no cone's
        }
        let outline = &s.outline;
        let window = Bounds::around(s.frame.coordinates(s.ball.center), 30.0);
        let apex = outline.outer_apex();
        let edges = [
            (outline.penumbra(), Some(outline.inner_apex())),
            (outline.umbra(), apex),
            (outline.antumbra(), apex),
        ];
        for (i, (shadow, apex)) in edges.into_iter().enumerate() {
            for p in shadow.outline(16, &window) {
                let off = (p - window.min).min(window.max - p).min_element();
                let p = s.frame.point(p);
                let Some(apex) = apex.filter(|apex| off > 1e-6 && (p - *apex).length() > 1e-2) else {
                    continue;
                };
                for ball in [s.light, s.ball] {
                    let error = (distance(ball.center, p, apex) - ball.radius).abs();
                    // The outline's points are right to 1e-12 of their distance; a line from a point near
                    // the apex carries that on by up to 1e4.
                    assert!(error < 1e-7, "edge {i} misses {ball:?} by {error:e} at {p}");
                    touched[i] += 1;
                }
            }
        }
    }
    assert!(touched.iter().all(|&n| n > 2_000), "{touched:?}");
}

fn floor() -> PlaneFrame {
    PlaneFrame::of_plane(&Plane::through(DVec3::ZERO, DVec3::Y)).expect("a plane")
}

fn sphere(x: f64, y: f64, radius: f64) -> Sphere {
    Sphere { center: DVec3::new(x, y, 0.0), radius }
}

fn new(light: Sphere, ball: Sphere) -> PenumbraOutline {
    PenumbraOutline::new(&light, &ball, &floor()).expect("apart")
}

fn radius(shadow: &PlaneShadow) -> f64 {
    shadow.axes().map_or(0.0, |axes| axes.first.length())
}

#[test]
fn a_light_straight_above_gives_circles() {
    // Larger, equal, smaller; the radii follow from the half-angles, with h the apex's height.
    let of = |h: f64, sine: f64| h * sine / (1.0 - sine * sine).sqrt();
    for (y, big_r, r, inner, is_umbra) in [
        (6.0, 2.0, 1.0, of(2.0, 1.0 / 4.0), true),
        (6.0, 2.0, 0.5, of(2.0 / 3.0, 1.5 / 4.0), false),
        (6.0, 0.5, 1.0, of(10.0, 0.5 / 4.0), true),
        (6.0, 1.0, 1.0, 1.0, true),
    ] {
        let ball_y = 2.0;
        let o = new(sphere(0.0, y, big_r), sphere(0.0, ball_y, r));
        let apex = ball_y + (y - ball_y) * r / (big_r + r);
        let outer = of(apex, (big_r + r) / (y - ball_y));
        assert!((radius(o.penumbra()) - outer).abs() < 1e-12, "outer {outer}");
        let (shown, hidden) = if is_umbra { (o.umbra(), o.antumbra()) } else { (o.antumbra(), o.umbra()) };
        assert!((radius(shown) - inner).abs() < 1e-12, "inner {inner}: {:?}", shown.axes());
        assert_eq!(hidden.kind(), ShadowKind::Nothing, "one of the two");
    }
}

#[test]
fn nearly_equal_radii_are_nearly_a_cylinder() {
    for part in [1e-13, 1e-11, 1e-9, 1e-6] {
        for big_r in [1.0 + part, 1.0 - part] {
            let o = new(sphere(0.0, 6.0, big_r), sphere(0.0, 2.0, 1.0));
            // From the ball's contact to the floor the cone narrows by half the difference.
            let error = radius(o.umbra()) - (1.0 - 0.5 * (big_r - 1.0));
            assert!(error.abs() < 1e-12, "{big_r}: {error:e}");
            assert_eq!(o.antumbra().kind(), ShadowKind::Nothing, "far away");
        }
    }
}

#[test]
fn at_the_apex_the_inner_region_is_nothing() {
    // (R C - r L) / (R - r) = 2 · 2 - 4 = 0.
    let o = new(sphere(0.0, 4.0, 1.0), sphere(0.0, 2.0, 0.5));
    assert_eq!(o.outer_apex(), Some(DVec3::ZERO), "in the plane");
    assert_eq!([o.umbra().kind(), o.antumbra().kind()], [ShadowKind::Nothing; 2], "a point");
    assert_eq!(o.zone(DVec2::splat(1e-3)), Zone::Penumbra, "around it");
    for (lift, zone) in [(1e-6, Zone::Antumbra), (-1e-6, Zone::Umbra)] {
        let o = new(sphere(0.0, 4.0 + lift, 1.0), sphere(0.0, 2.0 + lift, 0.5));
        assert_eq!(o.zone(DVec2::ZERO), zone, "apex {lift} above");
    }
}

#[test]
fn balls_that_touch_and_balls_that_overlap() {
    let ball = sphere(0.0, 2.0, 1.0);
    let o = new(sphere(3.0, 2.0, 2.0), ball);
    assert_eq!(o.penumbra().kind(), ShadowKind::Polygon, "behind the tangent plane");
    assert_eq!(
        [o.zone(DVec2::X * 1.1), o.zone(floor().coordinates(DVec3::X * 0.9))][1],
        Zone::Penumbra,
        "x < 1"
    );
    assert_eq!(o.zone(floor().coordinates(DVec3::X * 1.1)), Zone::Lit, "x > 1");
    for light in [sphere(2.9, 2.0, 2.0), sphere(0.0, 2.0, 5.0), sphere(0.0, 2.0, 0.1), ball] {
        assert_eq!(PenumbraOutline::new(&light, &ball, &floor()), None, "{light:?} overlaps");
    }
}

#[test]
fn points_for_lights_and_for_balls() {
    let ball = sphere(1.0, 2.0, 0.5);
    let o = new(sphere(0.0, 5.0, 0.0), ball);
    let hard = PlaneShadow::cast(&ball.into(), &Light::Point { position: DVec3::Y * 5.0 }, &floor());
    for edge in [o.penumbra(), o.umbra()] {
        let (a, b) = (edge.axes().expect("an ellipse"), hard.axes().expect("an ellipse"));
        // Of the sizes here, some roundings.
        for error in [
            (a.center - b.center).length(),
            a.first.length() - b.first.length(),
            a.second.length() - b.second.length(),
        ] {
            assert!(error.abs() < 1e-13, "the hard shadow, but for {error:e}");
        }
    }
    for big_r in [0.0, 1.0] {
        let o = new(sphere(0.0, 5.0, big_r), sphere(0.0, 2.0, 0.0));
        for edge in [o.penumbra(), o.umbra(), o.antumbra()] {
            assert_eq!(edge.kind(), ShadowKind::Nothing, "a ball without a radius");
        }
    }
}

#[test]
fn below_the_plane_and_through_it() {
    let light = sphere(0.0, 5.0, 1.0);
    assert_eq!(new(light, sphere(0.0, -2.0, 0.5)).penumbra().kind(), ShadowKind::Nothing, "below");
    assert_eq!(new(light, sphere(0.0, 9.0, 0.5)).penumbra().kind(), ShadowKind::Nothing, "above the light");
    let dipping = new(light, sphere(0.0, -0.25, 0.5));
    assert_eq!(dipping.zone(DVec2::ZERO), Zone::Umbra, "inside the ball");
    assert!((radius(dipping.umbra()) - 0.1875_f64.sqrt()).abs() < 1e-12, "its section is all the umbra");
    let resting = new(light, sphere(0.0, 0.5, 0.5));
    assert!(radius(resting.umbra()) > 0.1, "a ball on the floor has an umbra");
    let mirrored = new(sphere(0.0, -5.0, 1.0), sphere(0.0, -0.5, 0.5));
    assert!((radius(mirrored.umbra()) - radius(resting.umbra())).abs() < 1e-12, "on either side");
}

#[test]
fn any_input_is_answered() {
    let values = [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e-300, 1.0, 2.0, 1e300];
    let mut rng = fastrand::Rng::with_seed(4);
    for _ in 0..20_000 {
        let mut any = || values[rng.usize(..values.len())];
        let (a, b) = (sphere(any(), any(), any()), sphere(any(), any(), any()));
        let frame = PlaneFrame { origin: DVec3::splat(any()), ..floor() };
        let usable = |s: &Sphere| s.center.is_finite() && s.radius.is_finite() && s.radius >= 0.0;
        match PenumbraOutline::new(&a, &b, &frame) {
            None => {}
            Some(o) => {
                assert!(usable(&a) && usable(&b), "{a:?} {b:?}");
                assert_eq!(o.zone(DVec2::new(f64::NAN, 0.0)), Zone::Lit, "no point");
                let _any_zone = o.zone(DVec2::new(any(), any()));
            }
        }
    }
}
