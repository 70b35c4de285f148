//! Area lights against what is known in closed form.

mod common;

use std::f64::consts::PI;

use antumbra_reference::{Surface, Tracer};
use antumbra_scene::{Light, LightKind, Shape};
use common::{Random, at, light, object, scene};
use glam::DVec3;

/// A point of a surface of its own, above nothing.
fn point(p: DVec3, normal: DVec3) -> Surface {
    Surface { point: p, normal, primitive: 0, slack: 1e-10 }
}

/// A floor far below, so that nothing is in the way, and one light.
fn tracer(light: Light) -> Tracer {
    Tracer::new(&scene(vec![light], vec![object("floor", Shape::Plane, at(DVec3::Y * -1e3))]), 0.0)
}

fn irradiance(light: Light, p: DVec3, normal: DVec3, samples: u32) -> f64 {
    tracer(light).unoccluded_irradiance(0, &point(p, normal), samples, 7)
}

fn close(name: &str, got: f64, want: f64, tolerance: f64) {
    assert!((got - want).abs() <= tolerance * want.abs(), "{name}: {got} and not {want}");
}

/// Irradiance from a sphere of unit radiance, sin² of whose half-angle is given, at an angle from the normal whose cosine
/// is given; cut by the horizon where need be (J. Snyder, Area Light Sources for Real-Time Graphics, 1996).
fn sphere_irradiance(sine_squared: f64, cosine: f64) -> f64 {
    let sine = (1.0 - cosine * cosine).sqrt();
    if cosine * cosine > sine_squared {
        return PI * sine_squared * cosine.max(0.0);
    }
    let x = (1.0 / sine_squared - 1.0).sqrt();
    let y = -x * cosine / sine;
    let s = sine * (1.0 - y * y).sqrt();
    (cosine * y.acos() - x * s) * sine_squared + (s / x).atan()
}

#[test]
fn a_sphere_above_and_across_the_horizon() {
    let mut random = Random::new(1);
    let mut cut = 0;
    for _ in 0..300 {
        let radius = random.size();
        let position = random.cube() * 5.0;
        let p = position + random.unit() * radius * random.between(1.001, 5.0);
        let normal = random.unit();
        let (distance, intensity) = (p.distance(position), random.between(0.1, 100.0));
        let cosine = normal.dot(position - p) / distance;
        let sine_squared = (radius / distance).powi(2);
        let got = irradiance(light(LightKind::Sphere { radius }, position, intensity), p, normal, 4096);
        let radiance = intensity / (PI * radius * radius);
        let want = radiance * sphere_irradiance(sine_squared, cosine);
        // Of the irradiance at normal incidence: 4096 points leave 1e-4 where the integrand is smooth, and a few
        // times that where the horizon cuts it.
        let error = (got - want).abs() / (radiance * PI * sine_squared);
        assert!(error < 1e-3, "{got} and not {want}: sin² {sine_squared}, cos {cosine}");
        cut += usize::from(cosine * cosine < sine_squared);
    }
    assert!(cut > 50, "only {cut} cut by the horizon");
}

/// Lambert's formula for a polygon wholly above the horizon: half the sum over its edges of the angle they fill times
/// the cosine between normal and the edge's plane.
fn polygon_irradiance(corners: &[DVec3], p: DVec3, normal: DVec3) -> f64 {
    let mut sum = 0.0;
    for (i, &corner) in corners.iter().enumerate() {
        let (a, b) = ((corner - p).normalize(), (corners[(i + 1) % corners.len()] - p).normalize());
        let across = a.cross(b);
        sum += across.length().atan2(a.dot(b)) * across.normalize().dot(normal);
    }
    0.5 * sum.abs()
}

#[test]
fn a_rectangle_by_lamberts_formula() {
    let mut random = Random::new(2);
    let mut tested = 0;
    while tested < 300 {
        let direction = random.unit();
        let right = direction.any_orthonormal_vector();
        let (width, height) = (random.size(), random.size());
        let position = random.cube() * 5.0;
        let (w, h) = (right * (0.5 * width), direction.cross(right) * (0.5 * height));
        let corners = [-w - h, w - h, w + h, h - w].map(|c| position + c);
        // From almost touching the light to five of its sizes away.
        let depth = width.min(height) * 10f64.powf(random.between(-2.0, 0.7));
        let p = position + direction * depth + (w * random.signed() + h * random.signed()) * 0.9;
        let normal = (random.unit() - direction * 2.5).normalize();
        if corners.iter().any(|c| (*c - p).dot(normal) <= 0.0) {
            continue;
        }
        tested += 1;
        let kind = LightKind::Rectangle { direction, right, width, height };
        let got = irradiance(light(kind, position, 3.0), p, normal, 16_384);
        let want = 3.0 / (width * height) * polygon_irradiance(&corners, p, normal);
        // Near the light, long thin ones are the hard case: 1/d² peaks within a few strata.
        close(&format!("{width} x {height} from {depth}"), got, want, 2e-2);
        let behind = irradiance(light(kind, position, 3.0), position - direction * depth, direction, 16);
        assert_eq!(behind, 0.0, "a one-sided light shines backwards");
    }
}

#[test]
fn a_disc_on_its_axis() {
    for radius in [0.01, 0.3, 1.0, 20.0] {
        for distance in [1e-4, 0.01, 0.2, 0.26, 1.0, 7.0] {
            let kind = LightKind::Disc { direction: DVec3::NEG_Y, radius };
            let got = irradiance(light(kind, DVec3::Y * distance, 5.0), DVec3::ZERO, DVec3::Y, 4096);
            let want =
                5.0 / (PI * radius * radius) * PI * radius * radius / (radius * radius + distance * distance);
            close(&format!("radius {radius}, distance {distance}"), got, want, 3e-3);
        }
    }
}

/// An area light of intensity I is a point light of I when it is small, and for a disc or rectangle seen on its axis.
#[test]
fn small_area_lights_are_point_lights() {
    let position = DVec3::new(1.0, 3.0, -2.0);
    let direction = -position.normalize();
    let right = direction.any_orthonormal_vector();
    let normal = DVec3::new(0.1, 0.9, -0.3).normalize();
    let point = irradiance(light(LightKind::Point, position, 17.0), DVec3::ZERO, normal, 1);
    close("point", point, 17.0 * normal.dot(position.normalize()) / position.length_squared(), 1e-14);
    for kind in [
        LightKind::Sphere { radius: 1e-3 },
        LightKind::Disc { direction, radius: 1e-3 },
        LightKind::Rectangle { direction, right, width: 2e-3, height: 1e-3 },
    ] {
        // 1e-3 of size at 3.7 m: the next term of the series is of order 1e-7.
        close(
            &format!("{kind:?}"),
            irradiance(light(kind, position, 17.0), DVec3::ZERO, normal, 256),
            point,
            1e-6,
        );
    }
}

#[test]
fn a_spot_falls_off_as_in_gltf() {
    let (inner_angle, outer_angle) = (0.3f64, 0.6f64);
    let kind = LightKind::Spot { direction: DVec3::NEG_Y, inner_angle, outer_angle };
    for angle in [0.0, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 2.0] {
        let p = DVec3::new(f64::sin(angle), -f64::cos(angle), 0.0) * 2.0;
        let got = irradiance(light(kind, DVec3::ZERO, 8.0), p, -p.normalize(), 1);
        let x = ((angle.cos() - outer_angle.cos()) / (inner_angle.cos() - outer_angle.cos())).clamp(0.0, 1.0);
        assert!((got - 2.0 * x * x).abs() < 1e-12, "angle {angle}: {got}");
    }
    // A cone without a soft edge is a step.
    let kind = LightKind::Spot { direction: DVec3::NEG_Y, inner_angle: 0.5, outer_angle: 0.5 };
    let at_angle = |angle: f64| DVec3::new(angle.sin(), -angle.cos(), 0.0);
    let step = |angle: f64| irradiance(light(kind, DVec3::ZERO, 1.0), at_angle(angle), -at_angle(angle), 1);
    assert!((step(0.499) - 1.0).abs() < 1e-12 && step(0.501) == 0.0, "a step at the cone");
    // Visibility says whether the way is free, cone or not.
    let spot =
        light(LightKind::Spot { direction: DVec3::Y, inner_angle: 0.1, outer_angle: 0.2 }, DVec3::Y, 1.0);
    assert_eq!(tracer(spot).visibility_at(0, &point(DVec3::ZERO, DVec3::Y), 1, 0), 1.0, "outside the cone");
}

#[test]
fn a_directional_light_gives_lux_times_cosine() {
    let direction = DVec3::new(1.0, -2.0, 0.5).normalize();
    let sun = light(LightKind::Directional { direction }, DVec3::ZERO, 4.0);
    close("sun", irradiance(sun.clone(), DVec3::ONE, DVec3::Y, 1), -4.0 * direction.y, 1e-14);
    assert_eq!(irradiance(sun, DVec3::ONE, DVec3::NEG_Y, 1), 0.0, "from behind");
}

/// A ball before the middle of a sphere light, seen on the common axis: V = 1 - sin²β/sin²α.
#[test]
fn a_ball_inside_a_sphere_light() {
    for (radius, distance) in [(0.1, 1.0), (0.2, 2.0), (0.4, 2.5), (0.05, 0.3)] {
        let lamp = light(LightKind::Sphere { radius: 1.0 }, DVec3::Y * 4.0, 10.0);
        let ball = object("ball", Shape::Sphere { radius }, at(DVec3::Y * distance));
        let floor = object("floor", Shape::Plane, at(DVec3::ZERO));
        let tracer = Tracer::new(&scene(vec![lamp], vec![floor, ball]), 0.0);
        let got = tracer.visibility_at(0, &point(DVec3::ZERO, DVec3::Y), 16_384, 3);
        let want = 1.0 - (radius / distance).powi(2) / (1.0f64 / 4.0).powi(2);
        // Points per boundary: 16384 samples put about 1e-3 of them astride the ball's outline.
        assert!((got - want.max(0.0)).abs() < 2e-3, "ball {radius} at {distance}: {got} and not {want}");
    }
}

/// Half of a disc light behind the edge of a screen is half its irradiance, by symmetry.
#[test]
fn half_a_light_behind_a_screen() {
    let kinds = [
        LightKind::Sphere { radius: 0.5 },
        LightKind::Disc { direction: DVec3::NEG_Y, radius: 0.5 },
        LightKind::Rectangle { direction: DVec3::NEG_Y, right: DVec3::X, width: 0.7, height: 0.4 },
    ];
    for kind in kinds {
        let screen =
            object("screen", Shape::Rectangle { width: 10.0, depth: 10.0 }, at(DVec3::new(5.0, 1.0, 0.0)));
        let floor = object("floor", Shape::Plane, at(DVec3::ZERO));
        let tracer = Tracer::new(&scene(vec![light(kind, DVec3::Y * 2.0, 1.0)], vec![floor, screen]), 0.0);
        let got = tracer.visibility_at(0, &point(DVec3::ZERO, DVec3::Y), 16_384, 5);
        assert!((got - 0.5).abs() < 2e-3, "{kind:?}: {got}");
    }
}

/// Inside, on and at the centre of every area light: finite, and continuous across a sphere light's surface.
#[test]
fn points_in_and_on_lights() {
    let sphere = |p: DVec3, normal: DVec3| {
        irradiance(light(LightKind::Sphere { radius: 1.0 }, DVec3::ZERO, PI), p, normal, 4096)
    };
    // Unit radiance: a glowing half space above a surface gives π.
    close("at the centre", sphere(DVec3::ZERO, DVec3::Y), PI, 1e-3);
    close("inside", sphere(DVec3::Y * -0.5, DVec3::Y), PI, 1e-3);
    close("on it, facing it", sphere(DVec3::NEG_Y, DVec3::Y), PI, 1e-3);
    close("just off it", sphere(DVec3::NEG_Y * (1.0 + 1e-9), DVec3::Y), PI, 1e-3);
    close("on it, across", sphere(DVec3::NEG_Y, DVec3::X), PI / 2.0, 1e-3);
    assert!(sphere(DVec3::NEG_Y, DVec3::NEG_Y).abs() < 1e-6, "on it, facing away");

    let disc = LightKind::Disc { direction: DVec3::NEG_Y, radius: 1.0 };
    let rectangle =
        LightKind::Rectangle { direction: DVec3::NEG_Y, right: DVec3::X, width: 1.0, height: 1.0 };
    for kind in [disc, rectangle] {
        for p in [DVec3::ZERO, DVec3::X * 0.3, DVec3::X * 7.0] {
            assert_eq!(
                irradiance(light(kind, DVec3::ZERO, 1.0), p, DVec3::Y, 64),
                0.0,
                "in the plane of {kind:?}"
            );
        }
    }
    for kind in [LightKind::Point, disc, rectangle, LightKind::Sphere { radius: 1.0 }] {
        let tracer = tracer(light(kind, DVec3::ZERO, 1.0));
        for p in [DVec3::ZERO, DVec3::splat(1e-300), DVec3::splat(f64::NAN), DVec3::splat(f64::INFINITY)] {
            let v = tracer.visibility_at(0, &point(p, DVec3::Y), 16, 1);
            assert!((0.0..=1.0).contains(&v), "{kind:?} at {p}: {v}");
        }
    }
}
