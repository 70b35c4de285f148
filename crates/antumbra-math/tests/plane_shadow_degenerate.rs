//! Every degenerate case that the documentation of shadows on planes defines, by name.

use antumbra_math::plane_shadow::{Bounds, PlaneFrame, PlaneShadow, ShadowKind};
use antumbra_math::{Cone, Disc, Light, Plane, Rectangle, Shape, Sphere, Triangle};
use glam::{DVec2, DVec3};

/// z = 0, so that the frame's coordinates are the world's x and y.
fn ground() -> PlaneFrame {
    PlaneFrame { origin: DVec3::ZERO, u: DVec3::X, v: DVec3::Y, normal: DVec3::Z }
}

fn cast(shape: impl Into<Shape>, light: &Light) -> PlaneShadow {
    PlaneShadow::cast(&shape.into(), light, &ground())
}

fn at(x: f64, y: f64, z: f64) -> Light {
    Light::Point { position: DVec3::new(x, y, z) }
}

fn along(x: f64, y: f64, z: f64) -> Light {
    Light::Directional { direction: DVec3::new(x, y, z).normalize() }
}

fn ball(x: f64, y: f64, z: f64, radius: f64) -> Sphere {
    Sphere { center: DVec3::new(x, y, z), radius }
}

fn disc(center: DVec3, normal: DVec3, radius: f64) -> Disc {
    Disc { center, normal, radius }
}

fn cone(base_center: DVec3, axis: DVec3, radius: f64, height: f64) -> Cone {
    Cone { base_center, axis, radius, height }
}

fn triangle(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> Triangle {
    Triangle { vertices: [a, b, c].map(DVec3::from) }
}

/// One of each that casts, around (0, 0, 1), with a light at (0, 0, 4).
fn each() -> [Shape; 5] {
    [
        ball(0.0, 0.0, 1.0, 0.5).into(),
        disc(DVec3::Z, DVec3::Z, 0.5).into(),
        cone(DVec3::Z, DVec3::X, 0.5, 1.0).into(),
        triangle([0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.5]).into(),
        Rectangle { center: DVec3::Z, half_right: DVec3::X, half_forward: DVec3::Y }.into(),
    ]
}

#[test]
fn a_light_in_the_plane_lights_none_of_it() {
    for shape in each() {
        assert_eq!(cast(shape, &at(3.0, 1.0, 0.0)).kind(), ShadowKind::Nothing, "{shape:?}");
        assert_eq!(cast(shape, &along(1.0, 0.3, 0.0)).kind(), ShadowKind::Nothing, "{shape:?}");
    }
}

#[test]
fn a_light_below_the_occluder_casts_nothing_of_it() {
    for shape in each() {
        // The algebra alone would yield an anti-shadow.
        assert_eq!(cast(shape, &at(0.1, 0.2, 0.3)).kind(), ShadowKind::Nothing, "{shape:?}");
        assert_eq!(cast(shape, &at(0.1, 0.2, -3.0)).kind(), ShadowKind::Nothing, "beyond the plane");
        assert_eq!(cast(shape, &along(0.1, 0.2, 1.0)).kind(), ShadowKind::Nothing, "from below");
    }
}

#[test]
fn a_light_below_the_plane_casts_on_its_own_side() {
    let shadow = cast(ball(1.0, 0.0, -2.0, 0.5), &at(1.0, 0.0, -4.0));
    assert_eq!(shadow.kind(), ShadowKind::Ellipse, "mirrored");
    let axes = shadow.axes().expect("a circle");
    assert!((axes.center - DVec2::X).length() < 1e-15, "{axes:?}");
    assert!((axes.first.length() - 2.0 / 3.75_f64.sqrt()).abs() < 1e-15, "H r / √q: {axes:?}");
}

#[test]
fn spot_lights_cast_what_point_lights_do() {
    for shape in each() {
        let position = DVec3::new(0.3, 0.2, 4.0);
        let spot = Light::Spot { position, direction: DVec3::X, outer_angle: 0.1 };
        assert_eq!(cast(shape, &spot), cast(shape, &Light::Point { position }), "{shape:?}");
    }
}

#[test]
fn occluders_without_extent_cast_nothing() {
    let shapes: [Shape; 8] = [
        ball(0.0, 0.0, 1.0, 0.0).into(),
        ball(0.0, 0.0, 1.0, -1.0).into(),
        disc(DVec3::Z, DVec3::X, 0.0).into(),
        disc(DVec3::Z, DVec3::ZERO, 1.0).into(),
        cone(DVec3::Z, DVec3::Z, 0.0, 1.0).into(),
        cone(DVec3::Z, DVec3::Z, 1.0, -1.0).into(),
        triangle([0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [3.0, 0.0, 1.0]).into(),
        Rectangle { center: DVec3::Z, half_right: DVec3::X, half_forward: DVec3::ZERO }.into(),
    ];
    for shape in shapes {
        for light in [at(0.2, 0.4, 4.0), along(0.2, 0.4, -1.0)] {
            let shadow = cast(shape, &light);
            assert_eq!(shadow.kind(), ShadowKind::Nothing, "{shape:?}");
            assert_eq!((shadow.area(), shadow.bounds()), (0.0, None), "{shape:?}");
            assert!(shadow.conic().is_none() && shadow.axes().is_none(), "{shape:?}");
            assert!(!shadow.contains(DVec2::ZERO), "{shape:?}");
            assert!(shadow.outline(8, &Bounds::around(DVec2::ZERO, 9.0)).is_empty(), "{shape:?}");
        }
    }
}

#[test]
fn a_cone_without_height_is_a_disc() {
    for light in [at(0.2, 0.4, 4.0), along(0.2, 0.4, -1.0)] {
        let flat = cast(cone(DVec3::Z, DVec3::new(0.6, 0.0, 0.8), 0.5, 0.0), &light);
        assert_eq!(flat, cast(disc(DVec3::Z, DVec3::new(0.6, 0.0, 0.8), 0.5), &light), "{light:?}");
    }
}

#[test]
fn occluders_that_only_touch_the_plane_from_beyond_cast_nothing() {
    let shapes: [Shape; 5] = [
        ball(0.0, 0.0, -0.5, 0.5).into(),
        disc(-0.5 * DVec3::Z, DVec3::X, 0.5).into(),
        cone(-DVec3::Z, DVec3::Z, 0.5, 1.0).into(),
        cone(DVec3::ZERO, -DVec3::Z, 0.5, 1.0).into(),
        triangle([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, -1.0]).into(),
    ];
    for shape in shapes {
        assert_eq!(cast(shape, &at(0.3, 0.0, 4.0)).kind(), ShadowKind::Nothing, "{shape:?}");
    }
    let lying: [Shape; 2] = [
        disc(DVec3::ZERO, DVec3::Z, 0.5).into(),
        triangle([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]).into(),
    ];
    for shape in lying {
        assert_eq!(cast(shape, &at(0.3, 0.0, 4.0)).kind(), ShadowKind::Nothing, "flat in it: {shape:?}");
    }
}

#[test]
fn occluders_that_stand_on_the_plane_are_not_cut() {
    let light = at(4.0, 0.0, 4.0);
    assert_eq!(cast(ball(0.0, 0.0, 0.7, 0.7), &light).kind(), ShadowKind::Ellipse, "a ball");
    assert_eq!(cast(disc(0.7 * DVec3::Z, DVec3::X, 0.7), &light).kind(), ShadowKind::Ellipse, "a disc");
    let standing = cast(cone(DVec3::ZERO, DVec3::Z, 0.7, 1.1), &light);
    assert_eq!(standing.kind(), ShadowKind::Hull, "a cone");
    assert!(standing.contains(DVec2::new(0.69, 0.0)), "its base is dark");
}

#[test]
fn a_ball_that_dips_into_the_plane() {
    // Straight above a ball sunk to below its centre, the light sees all of the section's edge.
    let shadow = cast(ball(0.0, 0.0, -0.3, 0.5), &at(0.0, 0.0, 4.0));
    assert_eq!(shadow.kind(), ShadowKind::Ellipse, "the section itself");
    let radius = shadow.axes().expect("a circle").first.length();
    assert!((radius - 0.4).abs() < 1e-15, "√(0.25 - 0.09): {radius}");
    // Sunk less, it overhangs its section on every side.
    let shadow = cast(ball(0.0, 0.0, 0.3, 0.5), &at(0.0, 0.0, 4.0));
    assert_eq!(shadow.kind(), ShadowKind::Ellipse, "the tangent cone's section");
    assert!(shadow.area() > std::f64::consts::PI * 0.25, "larger than the ball: {}", shadow.area());
    // From the side: the section towards the light, the tangent cone away from it.
    let shadow = cast(ball(0.0, 0.0, 0.0, 0.5), &at(3.0, 0.0, 3.0));
    assert_eq!(shadow.kind(), ShadowKind::Hull, "two arcs");
    let bounds = shadow.bounds().expect("a shadow");
    assert!((bounds.max.x - 0.5).abs() < 1e-15, "the section: {bounds:?}");
    // The tangent cone's far vertex: a H δ / q and the radial semi-axis, a = H = 3, δ = 3 away.
    let (q, s) = (8.75_f64, 17.75_f64.sqrt());
    let far = 3.0 - (3.0 * 3.0 * 3.0 + 3.0 * 0.5 * s) / q;
    assert!((bounds.min.x - far).abs() < 1e-14, "the cone: {bounds:?} {far}");
    assert!((bounds.max.y - 3.0 * 0.5 / q.sqrt()).abs() < 1e-14, "its transverse axis: {bounds:?}");
}

#[test]
fn the_light_at_the_height_of_a_balls_top_makes_a_parabola() {
    let shadow = cast(ball(1.0, 0.0, 1.3, 0.7), &at(-1.0, 0.0, 2.0));
    assert_eq!(shadow.kind(), ShadowKind::Parabola, "H = c + r");
    assert_eq!(shadow.area(), f64::INFINITY, "unbounded");
    let bounds = shadow.bounds().expect("a shadow");
    assert!(bounds.min.x > -1.0 && bounds.min.x.is_finite(), "the vertex: {bounds:?}");
    let open = [bounds.max.x, bounds.max.y, -bounds.min.y];
    assert_eq!(open, [f64::INFINITY; 3], "a parabola is bounded on one side");
    assert!(shadow.axes().is_none() && shadow.conic().is_some(), "no centre, but an equation");
    // On either side of it, and so little off it that axes would overflow.
    for (change, kind) in [
        (1e-9, ShadowKind::Ellipse),
        (1e-11, ShadowKind::Ellipse),
        (1e-15, ShadowKind::Parabola),
        (-1e-15, ShadowKind::Parabola),
        (-1e-11, ShadowKind::Hyperbola),
        (-1e-9, ShadowKind::Hyperbola),
    ] {
        let near = cast(ball(1.0, 0.0, 1.3, 0.7), &at(-1.0, 0.0, 2.0 + change));
        assert_eq!(near.kind(), kind, "{change:e}");
        let vertex = near.bounds().expect("a shadow").min.x;
        assert!((vertex - bounds.min.x).abs() < 1e-8, "the near end hardly moves: {vertex}");
        assert!(near.contains(DVec2::new(1000.0, 0.0)), "it reaches far: {change:e}");
        assert_eq!(near.area() < 1e30, kind == ShadowKind::Ellipse, "area {} {kind:?}", near.area());
    }
}

#[test]
fn a_ball_around_the_lights_height_makes_one_branch_of_a_hyperbola() {
    let shadow = cast(ball(2.0, 0.0, 2.0, 0.5), &at(0.0, 0.0, 2.0));
    assert_eq!(shadow.kind(), ShadowKind::Hyperbola, "|H - c| < r");
    assert!(shadow.contains(DVec2::new(100.0, 0.0)), "away from the light");
    assert!(!shadow.contains(DVec2::new(-100.0, 0.0)), "the other branch is no shadow");
    let outline = shadow.outline(64, &Bounds::around(DVec2::ZERO, 20.0));
    assert!(outline.len() > 64 && outline.iter().all(|p| p.x > 0.0), "cut by the window: {outline:?}");
}

#[test]
fn the_light_inside_an_occluder_leaves_everything_dark() {
    let inside = [
        (Shape::from(ball(0.0, 0.0, 3.0, 1.5)), at(0.0, 0.5, 4.0)),
        (Shape::from(cone(DVec3::Z, DVec3::Z, 1.0, 4.0)), at(0.1, 0.1, 3.0)),
    ];
    for (shape, light) in inside {
        let shadow = cast(shape, &light);
        assert_eq!(shadow.kind(), ShadowKind::Everything, "{shape:?}");
        assert!(shadow.contains(DVec2::new(1e9, -1e9)), "{shape:?}");
        assert!(!shadow.contains(DVec2::new(f64::NAN, 0.0)), "NaN is nowhere");
        assert_eq!(shadow.bounds(), Some(Bounds::EVERYTHING), "{shape:?}");
        assert_eq!(shadow.area(), f64::INFINITY, "{shape:?}");
        let window = Bounds::around(DVec2::ONE, 2.0);
        assert_eq!(shadow.outline(9, &window).len(), 4, "the window's corners");
        assert!((shadow.clipped(&window).area() - 16.0).abs() < 1e-14, "all of the window");
    }
}

#[test]
fn a_light_on_a_balls_surface_is_cut_off_by_the_tangent_plane() {
    // At the right of the ball: what is left of x = 2 is dark.
    let shadow = cast(ball(1.0, 0.0, 3.0, 1.0), &at(2.0, 0.0, 3.0));
    assert_eq!(shadow.kind(), ShadowKind::Polygon, "a half-plane");
    assert!(shadow.contains(DVec2::new(1.99, 500.0)), "behind the tangent plane");
    assert!(!shadow.contains(DVec2::new(2.01, 0.0)), "before it");
    assert_eq!(shadow.area(), f64::INFINITY, "a half-plane");
    assert_eq!(cast(ball(0.0, 0.0, 2.0, 1.0), &at(0.0, 0.0, 3.0)).kind(), ShadowKind::Everything, "on top");
    assert_eq!(cast(ball(0.0, 0.0, 4.0, 1.0), &at(0.0, 0.0, 3.0)).kind(), ShadowKind::Nothing, "below it");
}

#[test]
fn a_light_on_a_cone() {
    // Upright, base radius 1 at height 2, apex at height 3.
    let solid = cone(2.0 * DVec3::Z, DVec3::Z, 1.0, 1.0);
    // In the apex: what the base hides, a circle of radius 3.
    let shadow = cast(solid, &at(0.0, 0.0, 3.0));
    assert_eq!(shadow.kind(), ShadowKind::Ellipse, "in the apex");
    assert!((shadow.axes().expect("a circle").first.length() - 3.0).abs() < 1e-12, "H r / h");
    // On the side, which slopes at 45°: what is behind x + z = 3.
    let shadow = cast(solid, &at(0.5, 0.0, 2.5));
    assert_eq!(shadow.kind(), ShadowKind::Polygon, "on the side");
    assert!(shadow.contains(DVec2::new(2.99, 50.0)) && !shadow.contains(DVec2::new(3.01, 0.0)), "x < 3");
    // On the base: it is above.
    assert_eq!(cast(solid, &at(0.1, 0.0, 2.0)).kind(), ShadowKind::Nothing, "on the base, from below");
    // On the rim of a cone that lies down: behind the base and behind the side.
    let lying = cone(2.0 * DVec3::Z, DVec3::X, 1.0, 1.0);
    let shadow = cast(lying, &at(0.0, 0.0, 3.0));
    assert!(shadow.contains(DVec2::new(0.1, 9.0)), "x > 0, and the side is above it all");
    assert!(!shadow.contains(DVec2::new(-0.1, 0.0)), "before the base");
    assert!(!shadow.contains(DVec2::new(3.1, 0.0)), "beyond x + z = 3");
}

#[test]
fn flat_occluders_seen_edge_on_leave_a_segment() {
    let standing = disc(DVec3::Z, DVec3::X, 0.5);
    let shadow = cast(standing, &at(0.0, 0.0, 3.0));
    assert_eq!(shadow.kind(), ShadowKind::Segment, "a disc");
    let ends = shadow.outline(9, &Bounds::around(DVec2::ZERO, 9.0));
    assert_eq!(ends.len(), 2, "{ends:?}");
    // In its plane the disc is a circle, and the tangents from the light at distance 2 leave it at
    // sin = 1/4.
    let reach = 3.0 * 0.25 / (1.0_f64 - 0.0625).sqrt();
    for end in &ends {
        assert!(end.x.abs() < 1e-12 && (end.y.abs() - reach).abs() < 1e-12, "{ends:?} {reach}");
    }
    assert!((ends[0].y + ends[1].y).abs() < 1e-12, "one on each side: {ends:?}");
    assert_eq!((shadow.area(), shadow.contains(DVec2::ZERO)), (0.0, false), "no area, no points");
    let flat = triangle([0.0, -1.0, 1.0], [0.0, 1.0, 1.0], [0.0, 0.0, 2.0]);
    assert_eq!(cast(flat, &along(0.0, 0.3, -1.0)).kind(), ShadowKind::Segment, "a triangle");
    // Up to the light's height the segment has no end.
    let shadow = cast(disc(DVec3::new(0.0, 3.0, 2.0), DVec3::X, 1.5), &at(0.0, 0.0, 3.0));
    assert_eq!(shadow.kind(), ShadowKind::Segment, "a disc as high as the light");
    assert_eq!(shadow.bounds().expect("a shadow").max.y, f64::INFINITY, "and infinitely long");
}

#[test]
fn a_cone_seen_along_its_axis_or_with_its_apex_inside_the_base() {
    for light in [at(0.0, 0.0, 5.0), at(0.2, -0.1, 5.0), along(0.05, 0.0, -1.0)] {
        let shadow = cast(cone(DVec3::Z, DVec3::Z, 0.5, 1.0), &light);
        assert_eq!(shadow.kind(), ShadowKind::Ellipse, "no tangents: {light:?}");
        // Upside down the apex hides behind the base.
        let shadow = cast(cone(2.0 * DVec3::Z, -DVec3::Z, 0.5, 1.0), &light);
        assert_eq!(shadow.kind(), ShadowKind::Ellipse, "no tangents: {light:?}");
    }
}

#[test]
fn a_cone_through_the_plane() {
    // Tip up, sunk to half its height, under a light straight above: its section.
    let shadow = cast(cone(-DVec3::Z, DVec3::Z, 1.0, 2.0), &at(0.0, 0.0, 5.0));
    assert_eq!(shadow.kind(), ShadowKind::Ellipse, "the section is all there is");
    assert!((shadow.axes().expect("a circle").first.length() - 0.5).abs() < 1e-12, "half the radius");
    // Tip down: the base hides the section.
    let shadow = cast(cone(DVec3::Z, -DVec3::Z, 1.0, 2.0), &at(0.0, 0.0, 5.0));
    assert!((shadow.axes().expect("a circle").first.length() - 1.25).abs() < 1e-12, "the base's shadow");
    // Lying, its axis in the plane, under directional light straight down: the section, a triangle.
    let shadow = cast(cone(DVec3::ZERO, DVec3::X, 1.0, 2.0), &along(0.0, 0.0, -1.0));
    assert!((shadow.area() - 2.0).abs() < 1e-12, "a triangle of base 2 and height 2: {}", shadow.area());
}

#[test]
fn a_cone_through_the_lights_height() {
    let shadow = cast(cone(DVec3::new(2.0, 0.0, 1.0), DVec3::Z, 0.5, 2.0), &at(0.0, 0.0, 2.0));
    assert_eq!(shadow.kind(), ShadowKind::Hull, "the apex is above the light");
    assert_eq!(shadow.area(), f64::INFINITY, "unbounded");
    assert!(shadow.contains(DVec2::new(1e6, 0.0)) && !shadow.contains(DVec2::new(-1e6, 0.0)), "away");
    let exact = cast(cone(DVec3::new(2.0, 0.0, 1.0), DVec3::Z, 0.5, 1.0), &at(0.0, 0.0, 2.0));
    assert_eq!(exact.bounds().expect("a shadow").max.x, f64::INFINITY, "the apex just reaches it");
    assert!(exact.contains(DVec2::new(1e6, 0.0)), "the tip's shadow narrows, infinitely long");
}

#[test]
fn planes_cast_half_planes() {
    let wall = |normal: DVec3, offset: f64| Plane { normal, offset };
    let shadow = cast(wall(DVec3::X, 1.0), &at(3.0, 0.0, 2.0));
    assert_eq!(shadow.kind(), ShadowKind::Polygon, "a half-plane");
    assert!(shadow.contains(DVec2::new(0.9, 7.0)) && !shadow.contains(DVec2::new(1.1, 7.0)), "beyond it");
    let part = shadow.clipped(&Bounds::around(DVec2::ZERO, 2.0));
    assert!((part.area() - 12.0).abs() < 1e-12, "3 by 4: {}", part.area());
    assert_eq!(cast(wall(DVec3::Z, 1.0), &at(0.0, 0.0, 2.0)).kind(), ShadowKind::Everything, "between");
    assert_eq!(cast(wall(DVec3::Z, 3.0), &at(0.0, 0.0, 2.0)).kind(), ShadowKind::Nothing, "above");
    assert_eq!(cast(wall(-DVec3::Z, 1.0), &at(0.0, 0.0, 2.0)).kind(), ShadowKind::Nothing, "below");
    assert_eq!(cast(wall(DVec3::Z, 0.0), &at(0.0, 0.0, 2.0)).kind(), ShadowKind::Nothing, "the receiver");
    assert_eq!(cast(wall(DVec3::X, 0.0), &at(0.0, 1.0, 2.0)).kind(), ShadowKind::Nothing, "edge-on");
    let shadow = cast(wall(DVec3::X, 1.0), &along(-1.0, 0.0, -1.0));
    assert!(shadow.contains(DVec2::new(0.0, 0.0)) && !shadow.contains(DVec2::new(2.0, 0.0)), "sunlight");
    // A strip of the window, its sides parallel to the wall.
    let strip = Bounds { min: DVec2::new(-1.0, f64::NEG_INFINITY), max: DVec2::new(5.0, f64::INFINITY) };
    let part = cast(wall(DVec3::X, 1.0), &at(3.0, 0.0, 2.0)).clipped(&strip);
    assert!(part.contains(DVec2::new(0.0, 1e3)), "in the strip");
    assert!(!part.contains(DVec2::new(-1.1, 0.0)) && !part.contains(DVec2::new(1.1, 0.0)), "{part:?}");
}

#[test]
fn frames_without_a_plane() {
    let nan = f64::NAN;
    for (normal, offset) in [(DVec3::ZERO, 0.0), (DVec3::X, nan), (DVec3::NAN, 0.0), (DVec3::INFINITY, 1.0)] {
        assert!(PlaneFrame::of_plane(&Plane { normal, offset }).is_none(), "{normal} {offset}");
    }
    let flat = Rectangle { center: DVec3::ZERO, half_right: DVec3::X, half_forward: DVec3::ZERO };
    assert!(PlaneFrame::of_rectangle(&flat).is_none(), "no area");
    for normal in [DVec3::Z, -DVec3::Z, DVec3::X, DVec3::new(1e-9, -1e-9, -1.0), DVec3::new(0.6, 0.0, -0.8)] {
        let frame = PlaneFrame::of_plane(&Plane { normal, offset: 2.0 }).expect("a plane");
        assert!((frame.u.cross(frame.v) - frame.normal).length() < 1e-15, "right-handed: {frame:?}");
        assert!((frame.u.length() - 1.0).abs() < 1e-15 && frame.u.dot(frame.v).abs() < 1e-15, "{frame:?}");
        assert!((frame.height(frame.point(DVec2::new(3.0, -4.0)))).abs() < 1e-14, "in the plane");
        let there = frame.coordinates(frame.point(DVec2::new(3.0, -4.0)));
        assert!((there - DVec2::new(3.0, -4.0)).length() < 1e-14, "and back: {there}");
    }
}
