//! Shadows on planes against published closed forms: sections of the tangent cone of a ball, its
//! focus, and the composite method's discs, triangles and cones (2013, 2017) where they are exact.

mod plane_shadow_support;

use antumbra_math::plane_shadow::{Axes, Bounds, PlaneFrame, PlaneShadow, ShadowKind};
use antumbra_math::{Cone, Disc, Light, Plane, Rectangle, Shape, Sphere, Triangle};
use glam::{DVec2, DVec3};
use plane_shadow_support::Random;

/// The floor y = 0.
fn floor() -> PlaneFrame {
    PlaneFrame::of_plane(&Plane { normal: DVec3::Y, offset: 0.0 }).expect("a plane")
}

fn point_light(x: f64, y: f64, z: f64) -> Light {
    Light::Point { position: DVec3::new(x, y, z) }
}

fn cast(shape: impl Into<Shape>, light: &Light) -> PlaneShadow {
    PlaneShadow::cast(&shape.into(), light, &floor())
}

/// The world's x and z of a point of the floor.
fn xz(point: DVec2) -> DVec2 {
    let p = floor().point(point);
    DVec2::new(p.x, p.z)
}

/// A direction of the floor in the world's x and z.
fn xz_direction(d: DVec2) -> DVec2 {
    xz(d) - xz(DVec2::ZERO)
}

/// The frame's coordinates of a point of the floor.
fn on_floor(x: f64, z: f64) -> DVec2 {
    floor().coordinates(DVec3::new(x, 0.0, z))
}

#[test]
fn spheres_follow_the_section_of_their_tangent_cone() {
    let mut random = Random(21);
    for _ in 0..10_000 {
        let (light_height, r) = (random.within(2.0, 10.0), random.within(0.1, 1.0));
        let c = random.within(r, light_height + 0.9 * r);
        let (delta, angle) = (random.within(0.0, 5.0), random.within(0.0, std::f64::consts::TAU));
        let (a, h) = (light_height - c, light_height);
        let (q, square) = (a * a - r * r, a * a + delta * delta - r * r);
        if q.abs() < 1e-3 || square < 1e-3 {
            continue;
        }
        let away = DVec2::from_angle(angle);
        let light = point_light(1.0, h, -2.0);
        let center = DVec3::new(1.0 + delta * away.x, c, -2.0 + delta * away.y);
        let shadow = cast(Sphere { center, radius: r }, &light);
        let axes = shadow.axes().expect("an ellipse or a hyperbola");
        let middle = xz(axes.center) - DVec2::new(1.0, -2.0);
        let error = middle.distance(away * (delta * a * h / q));
        let radial = h * r * square.sqrt() / q.abs();
        let transverse = h * r / q.abs().sqrt();
        let size = middle.length() + radial + transverse;
        assert!(error < 1e-10 * size, "centre: {error}");
        if q > 0.0 {
            assert_eq!(shadow.kind(), ShadowKind::Ellipse, "H > c + r");
            assert!((axes.first.length() - radial.max(transverse)).abs() < 1e-10 * size, "{axes:?}");
            assert!((axes.second.length() - radial.min(transverse)).abs() < 1e-10 * size, "{axes:?}");
            let area = std::f64::consts::PI * radial * transverse;
            assert!((shadow.area() / area - 1.0).abs() < 1e-9, "area {} {area}", shadow.area());
        } else {
            assert_eq!(shadow.kind(), ShadowKind::Hyperbola, "|H - c| < r");
            let first = xz_direction(axes.first);
            assert!((first - away * radial).length() < 1e-9 * size, "towards the ball: {first}");
            assert!((axes.second.length() - transverse).abs() < 1e-9 * size, "{axes:?}");
        }
    }
}

#[test]
fn a_resting_ball_touches_the_plane_at_a_focus() {
    let mut random = Random(22);
    for _ in 0..10_000 {
        let r = random.within(0.1, 1.0);
        let light = point_light(0.0, r * random.within(2.05, 20.0), 0.0);
        let center = DVec3::new(random.within(-5.0, 5.0), r, random.within(-5.0, 5.0));
        let shadow = cast(Sphere { center, radius: r }, &light);
        assert_eq!(shadow.kind(), ShadowKind::Ellipse, "the light is above the ball");
        let Axes { center: middle, first, second } = shadow.axes().expect("an ellipse");
        let eccentricity = (1.0 - second.length_squared() / first.length_squared()).max(0.0).sqrt();
        let touch = on_floor(center.x, center.z);
        let miss = [1.0, -1.0].map(|s| (middle + first * (s * eccentricity)).distance(touch));
        let miss = miss[0].min(miss[1]);
        // A focus of a nearly circular ellipse is known to the root of the axes' rounding.
        assert!(miss < 1e-7 * first.length(), "{miss} {first} {second}");
    }
}

#[test]
fn a_resting_ball_under_directional_light_touches_at_a_focus() {
    let light = Light::Directional { direction: DVec3::new(0.6, -0.8, 0.0) };
    let shadow = cast(Sphere { center: DVec3::Y, radius: 1.0 }, &light);
    let axes = shadow.axes().expect("an ellipse");
    assert!((axes.first.length() - 1.0 / 0.8).abs() < 1e-12, "r / sin of the elevation: {axes:?}");
    assert!((axes.second.length() - 1.0).abs() < 1e-12, "the ball's own radius: {axes:?}");
    assert!((xz(axes.center) - DVec2::new(0.75, 0.0)).length() < 1e-12, "centre {:?}", xz(axes.center));
    let focus = (axes.first.length_squared() - axes.second.length_squared()).sqrt();
    assert!((focus - 0.75).abs() < 1e-12, "as far as the point of contact: {focus}");
}

#[test]
fn a_ball_straight_below_the_light() {
    // 2017: the disc of the tangent cone; r y / sqrt(D² - r²).
    let (y, d, r) = (7.0, 2.0, 1.2);
    let shadow = cast(Sphere { center: DVec3::new(0.5, d, 0.0), radius: r }, &point_light(0.5, y, 0.0));
    let axes = shadow.axes().expect("a circle");
    let radius = r * y / ((y - d).powi(2) - r * r).sqrt();
    assert!((axes.first.length() - radius).abs() < 1e-12, "{axes:?} {radius}");
    assert!((axes.second.length() - radius).abs() < 1e-12, "{axes:?} {radius}");
    // 2013 takes the disc through the centre instead, which is smaller.
    assert!(radius > r * y / (y - d) * 1.02, "the two differ: {radius}");
}

#[test]
fn a_disc_parallel_to_the_plane() {
    let mut random = Random(23);
    for _ in 0..1000 {
        let (x, y) = (random.within(-5.0, 5.0), random.within(2.0, 9.0));
        let (d, r) = (random.within(0.1, 1.8), random.within(0.1, 2.0));
        let disc = Disc { center: DVec3::new(0.0, d, 0.0), normal: DVec3::Y, radius: r };
        let shadow = cast(disc, &point_light(x, y, 0.0));
        let axes = shadow.axes().expect("a circle");
        let (x_s, r_1) = (-d * x / (y - d), r * y / (y - d));
        assert!((xz(axes.center) - DVec2::new(x_s, 0.0)).length() < 1e-12 * (1.0 + x_s.abs()), "{axes:?}");
        for axis in [axes.first, axes.second] {
            assert!((axis.length() - r_1).abs() < 1e-12 * r_1, "{axis} {r_1}");
        }
    }
}

/// The triangle of the composite method: base a along `along`, height h, at distance d.
fn upright(along: DVec3, a: f64, h: f64, d: f64) -> Triangle {
    let base = DVec3::Y * d;
    Triangle { vertices: [base - along * (0.5 * a), base + along * (0.5 * a), base + DVec3::Y * h] }
}

#[test]
fn the_composite_methods_triangle() {
    let (x, y, a, h, d) = (3.0, 6.0, 1.5, 2.0, 0.7);
    let (x_s, a_1) = (-d * x / (y - d), a * y / (y - d));
    let x_s3 = x * (h + d) / (d + h - y);
    let shadow = cast(upright(DVec3::Z, a, h, d), &point_light(x, y, 0.0));
    assert_eq!(shadow.kind(), ShadowKind::Polygon, "base across the light's direction");
    let corners = shadow.outline(0, &Bounds::around(DVec2::ZERO, 100.0));
    assert_eq!(corners.len(), 3, "{corners:?}");
    for expected in [DVec2::new(x_s, -0.5 * a_1), DVec2::new(x_s, 0.5 * a_1), DVec2::new(x_s3, 0.0)] {
        let nearest = corners.iter().map(|&p| xz(p).distance(expected)).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-12, "{expected}: {corners:?}");
    }
    assert!((shadow.area() - 0.5 * a_1 * (x_s - x_s3).abs()).abs() < 1e-12, "area {}", shadow.area());

    // With the base along the light's direction the light is in the triangle's plane.
    let shadow = cast(upright(DVec3::X, a, h, d), &point_light(x, y, 0.0));
    assert_eq!(shadow.kind(), ShadowKind::Segment, "collinear points");
    let ends = shadow.outline(0, &Bounds::around(DVec2::ZERO, 100.0));
    assert_eq!(ends.len(), 2, "{ends:?}");
    let mut ends = [xz(ends[0]).x, xz(ends[1]).x];
    ends.sort_by(f64::total_cmp);
    assert!((ends[0] - x_s3).abs() < 1e-12 && (ends[1] - (x_s + 0.5 * a_1)).abs() < 1e-12, "{ends:?}");
    assert_eq!(shadow.area(), 0.0, "a segment has no area");
    assert!(!shadow.contains(on_floor(x_s, 0.0)), "and no points");
}

#[test]
fn a_cone_is_the_hull_of_base_and_apex() {
    let mut random = Random(24);
    for _ in 0..2000 {
        let (x, y) = (random.within(-8.0, 8.0), random.within(4.0, 9.0));
        let (r, height, d) = (random.within(0.2, 1.0), random.within(0.5, 2.5), random.within(0.0, 1.0));
        let cone = Cone { base_center: DVec3::new(0.0, d, 0.0), axis: DVec3::Y, radius: r, height };
        let shadow = cast(cone, &point_light(x, y, 0.0));
        let (x_s, r_1) = (-d * x / (y - d), r * y / (y - d));
        let apex = -(d + height) * x / (y - d - height);
        let distance = (apex - x_s).abs();
        let circle = std::f64::consts::PI * r_1 * r_1;
        if distance <= r_1 {
            assert_eq!(shadow.kind(), ShadowKind::Ellipse, "the apex falls into the base's shadow");
            assert!((shadow.area() - circle).abs() < 1e-11 * circle, "area {}", shadow.area());
        } else {
            // The circle, and the two tangents from the apex less the sector between them.
            assert_eq!(shadow.kind(), ShadowKind::Hull, "two tangents");
            let tangent = (distance * distance - r_1 * r_1).sqrt();
            let exact = circle + r_1 * tangent - r_1 * r_1 * (r_1 / distance).acos();
            assert!((shadow.area() - exact).abs() < 1e-11 * exact, "{} {exact}", shadow.area());
            let bounds = shadow.bounds().expect("a shadow");
            let apex = on_floor(apex, 0.0);
            assert!(
                (apex.clamp(bounds.min, bounds.max) - apex).length() < 1e-12 * apex.length(),
                "{bounds:?}"
            );
            let corners = shadow.outline(100, &Bounds::around(DVec2::ZERO, 1e6));
            let nearest = corners.iter().map(|p| p.distance(apex)).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-12 * (1.0 + apex.length()), "the apex is a corner: {nearest}");
        }
    }
}

#[test]
fn a_cone_straight_below_the_light_is_its_disc() {
    let cone = Cone { base_center: DVec3::Y, axis: DVec3::Y, radius: 0.5, height: 2.0 };
    let shadow = cast(cone, &point_light(0.0, 5.0, 0.0));
    assert_eq!(shadow.kind(), ShadowKind::Ellipse, "the disc alone");
    // To the 1e-13 by which things that stand on the plane are kept from being cut by it.
    assert!((shadow.axes().expect("a circle").first.length() - 0.625).abs() < 1e-12, "r y / (y - d)");
}

#[test]
fn a_rectangle_receives_its_part() {
    let receiver =
        Rectangle { center: DVec3::new(1.0, 0.0, 0.0), half_right: DVec3::X, half_forward: -2.0 * DVec3::Z };
    let (frame, bounds) = PlaneFrame::of_rectangle(&receiver).expect("a rectangle");
    let disc = Disc { center: DVec3::Y, normal: DVec3::Y, radius: 0.5 };
    let light = point_light(0.0, 2.0, 0.0);
    let whole = PlaneShadow::cast(&disc.into(), &light, &frame);
    let part = whole.clipped(&bounds);
    assert!((whole.area() - std::f64::consts::PI).abs() < 1e-12, "radius 1: {}", whole.area());
    assert!((part.area() - 0.5 * std::f64::consts::PI).abs() < 1e-12, "half of it: {}", part.area());
    assert_eq!(part.kind(), ShadowKind::Hull, "half a disc");
    let inside = part.bounds().expect("a shadow");
    assert!((inside.min - DVec2::new(-1.0, -1.0)).length() < 1e-12, "{inside:?}");
    assert!((inside.max - DVec2::new(0.0, 1.0)).length() < 1e-12, "{inside:?}");
    assert!(part.contains(DVec2::new(-0.9, 0.1)), "in the part");
    assert!(!part.contains(DVec2::new(-1.1, 0.1)), "in the shadow but off the rectangle");
    let outline = part.outline(50, &bounds);
    assert!(outline.len() >= 50, "{}", outline.len());
    assert!(outline.iter().all(|p| p.x >= -1.0 - 1e-15), "on the rectangle: {outline:?}");
}
