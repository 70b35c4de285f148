//! The antialiased coverage against areas: by clipping polygons for one edge, by a grid of rays from
//! the eye and point tests for the shadows of the shapes.

mod blocking_support;
mod plane_shadow_support;

use antumbra_math::blocking::{Blockers, Footprint, half_plane_coverage, screen_footprint};
use antumbra_math::{Cone, Disc, Light, Plane, Rectangle, Shape, Sphere, Triangle};
use blocking_support::{CONE, DISC, NAMES, Oracle, PLANE, RECTANGLE, SPHERE, TRIANGLE, cases};
use glam::{DMat4, DVec2, DVec3};
use plane_shadow_support::Random;

/// The area of the unit square around the origin where value + slope·p > 0: Sutherland and Hodgman's
/// clipping (Reentrant Polygon Clipping, 1974) and the shoelace formula.
fn clipped_area(value: f64, slope: DVec2) -> f64 {
    let corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)].map(|(x, y)| DVec2::new(x, y));
    let height = |p: DVec2| value + slope.dot(p);
    let mut inside = Vec::new();
    for i in 0..4 {
        let (p, q) = (corners[i], corners[(i + 1) % 4]);
        if height(p) > 0.0 {
            inside.push(p);
        }
        if (height(p) > 0.0) != (height(q) > 0.0) {
            inside.push(p.lerp(q, height(p) / (height(p) - height(q))));
        }
    }
    let twice: f64 = (0..inside.len()).map(|i| inside[i].perp_dot(inside[(i + 1) % inside.len()])).sum();
    twice / 2.0
}

#[test]
fn half_planes_are_exact() {
    let mut random = Random(1);
    let (mut worst, mut worst_single) = (0.0_f64, 0.0_f64);
    for _ in 0..cases(1_000_000) {
        let turn = random.within(0.0, std::f64::consts::TAU);
        let turn = if random.choice(4) == 0 {
            (turn * 4.0).round() / 4.0 + random.decades(-12.0, -1.0)
        } else {
            turn
        };
        let slope = DVec2::from_angle(turn) * random.decades(-6.0, 6.0);
        let value = random.within(-1.0, 1.0) * slope.length();
        let (area, truth) = (half_plane_coverage(value, slope.x, slope.y), clipped_area(value, slope));
        worst = worst.max((area - truth).abs());
        // Symmetric: in both axes, in their exchange, and in the sides of the edge.
        assert_eq!(area, half_plane_coverage(value, -slope.x, slope.y), "mirrored at {value} {slope}");
        assert_eq!(area, half_plane_coverage(value, slope.y, slope.x), "turned at {value} {slope}");
        let rest = half_plane_coverage(-value, slope.x, slope.y);
        assert!((area + rest - 1.0).abs() <= f64::EPSILON, "the other side of {value} {slope}: {rest}");
        assert!((0.0..=1.0).contains(&area), "{area} at {value} {slope}");
        // Monotone: moving the edge outwards never takes away more than rounding.
        let more = half_plane_coverage(value + random.decades(-9.0, 0.0) * slope.length(), slope.x, slope.y);
        assert!(more >= area - 1e-15, "{more} after {area} at {value} {slope}");
        let single = half_plane_coverage(value as f32, slope.x as f32, slope.y as f32);
        assert!(single.is_finite(), "{value} {slope} in float32");
        worst_single = worst_single.max((f64::from(single) - truth).abs());
    }
    println!("farthest from the area: {worst:e}, in float32 {worst_single:e}");
    assert!(worst < 1e-12, "exact to rounding: {worst:e}");
    assert!(worst_single < 1e-6, "float32 rounds at 6e-8, some operations more: {worst_single:e}");
}

#[test]
fn half_planes_without_extent() {
    for (value, area) in [(1.0, 1.0), (1e-300, 1.0), (0.0, 0.0), (-1.0, 0.0), (f64::NAN, 0.0)] {
        assert_eq!(half_plane_coverage(value, 0.0, 0.0), area, "no slope, {value}");
    }
    assert_eq!(half_plane_coverage(0.0, 3.0, 0.0), 0.5, "through the middle");
    for (value, sx, sy) in
        [(1.0, f64::NAN, 0.0), (f64::INFINITY, 1.0, 1.0), (1.0, f64::INFINITY, f64::INFINITY)]
    {
        let area = half_plane_coverage(value, sx, sy);
        assert!((0.0..=1.0).contains(&area), "{area} at {value} {sx} {sy}");
    }
    // Slopes whose product underflows in float32.
    let area = half_plane_coverage(5.4e-21_f32, 1e-20, 1e-21);
    assert!((area - 0.999_5).abs() < 1e-3, "a small corner left out: {area}");
}

/// A pixel of some camera: the eye is the origin, the sight is -Z.
struct Pixel {
    /// Of the pixel's centre on the plane at distance one, and the pixel's size there.
    center: DVec2,
    size: DVec2,
    receiver: Plane,
}

impl Pixel {
    /// What is seen through the pixel at (u, v) from its centre, in pixels.
    fn seen(&self, u: f64, v: f64) -> Option<DVec3> {
        let through = (self.center + DVec2::new(u, v) * self.size).extend(-1.0);
        let t = self.receiver.offset / self.receiver.normal.dot(through);
        (t > 0.0).then_some(through * t)
    }

    /// What the library makes of it.
    fn footprint(&self) -> Option<Footprint<DVec3>> {
        let point = self.seen(0.0, 0.0)?;
        Some(screen_footprint(point, self.receiver.normal, self.size.into(), true))
    }
}

/// A pixel from `across` metres wide that sees `point` of the receiver, up to `off_center` pixels from its
/// middle, from a random side; in view space.
fn pixel(random: &mut Random, point: DVec3, normal: DVec3, across: f64, off_center: f64) -> (DMat4, Pixel) {
    let away = loop {
        // Edge-on footprints are longer than the shadow has a straight edge.
        let away = random.direction();
        if away.dot(normal).abs() > 0.2 {
            break away;
        }
    };
    let distance = random.decades(0.0, 1.0);
    let eye = point + away * distance;
    let off = random.direction() * (0.4 * distance);
    let view = glam::dcamera::rh::view::look_at_mat4(eye, point + off, away.any_orthonormal_vector());
    let at = view.transform_point3(point);
    let receiver = Plane::through(at, view.transform_vector3(normal));
    let size = DVec2::splat(across / -at.z) * DVec2::new(1.0, random.within(0.7, 1.0));
    let shift = DVec2::new(random.within(-1.0, 1.0), random.within(-1.0, 1.0)) * off_center;
    (view, Pixel { center: at.truncate() / -at.z + shift * size, size, receiver })
}

#[test]
fn footprints_are_the_change_of_what_is_seen() {
    let mut random = Random(2);
    let mut worst = 0.0_f64;
    for _ in 0..cases(100_000) {
        let (point, normal) = (random.vector(10.0), random.direction());
        let (_, pixel) = pixel(&mut random, point, normal, 1e-3, 0.5);
        let footprint = pixel.footprint().expect("in front of the eye");
        let seen = |u, v| pixel.seen(u, v).expect("the same plane");
        let h = 1e-3;
        for (step, plus, minus) in
            [(footprint.dx, seen(h, 0.0), seen(-h, 0.0)), (footprint.dy, seen(0.0, h), seen(0.0, -h))]
        {
            let difference = (plus - minus) / (2.0 * h);
            assert!(step.is_finite(), "{step}");
            worst = worst.max((step - difference).length() / difference.length());
        }
        let single = screen_footprint(
            footprint.point.as_vec3(),
            pixel.receiver.normal.as_vec3(),
            (pixel.size.x as f32, pixel.size.y as f32),
            true,
        );
        for (single, step) in [(single.dx, footprint.dx), (single.dy, footprint.dy)] {
            let error = (single.as_dvec3() - step).length() / step.length();
            assert!(error < 1e-4, "float32, the facing at least 0.2 of the sight: {error:e}");
        }
    }
    println!("farthest from the differences: {worst:e}");
    // Central differences over a thousandth of a pixel: rounding (1e-15 of a distance of ten over a step of
    // 1e-6) and the third derivative (1e-12) are both below.
    assert!(worst < 1e-6, "{worst:e}");
}

#[test]
fn footprints_without_a_slope() {
    // Parallel projection: the steps do not depend on the distance.
    let normal = DVec3::new(0.0, 0.6, 0.8);
    let f = screen_footprint(DVec3::new(3.0, 1.0, -7.0), normal, (0.1, 0.2), false);
    assert!((f.dx - DVec3::X * 0.1).length() < 1e-15, "along the slope's level: {:?}", f.dx);
    assert!((f.dy - DVec3::new(0.0, 0.2, -0.15)).length() < 1e-15, "up the slope: {:?}", f.dy);
    // Edge-on: limited.
    let f = screen_footprint(DVec3::new(0.0, 0.0, -2.0), DVec3::Y, (0.1, 0.1), true);
    assert!(f.dy.is_finite() && f.dy.length() <= 0.1 * 2.0 * 1001.0, "edge-on: {:?}", f.dy);
    for point in [DVec3::ZERO, DVec3::NEG_Z] {
        let f = screen_footprint(point, DVec3::ZERO, (0.1, 0.1), true);
        assert!(f.dx.is_finite() && f.dy.is_finite(), "at the eye, and without a normal: {f:?}");
    }
}

/// The fraction of the pixel that is dark by point tests, on a grid.
fn dark_area(oracle: &Oracle, pixel: &Pixel, to_world: &DMat4) -> Option<f64> {
    const GRID: usize = 48;
    let at = |i: usize| (i as f64 + 0.5) / GRID as f64 - 0.5;
    let mut dark = 0;
    for y in 0..GRID {
        for x in 0..GRID {
            let point = to_world.transform_point3(pixel.seen(at(x), at(y))?);
            dark += usize::from(oracle.blocks(point));
        }
    }
    Some(dark as f64 / (GRID * GRID) as f64)
}

/// Root mean square and largest of the differences.
#[derive(Default)]
struct Errors {
    count: usize,
    squares: f64,
    largest: f64,
}

impl Errors {
    fn add(&mut self, error: f64) {
        self.count += 1;
        self.squares += error * error;
        self.largest = self.largest.max(error.abs());
    }

    fn rms(&self) -> f64 {
        (self.squares / self.count as f64).sqrt()
    }
}

/// A well-formed shape of size one, a light that does not graze it, and a receiver behind: a point
/// on the edge of the shadow there, and the receiver's normal.
fn edge_of_shadow(random: &mut Random, kind: u64) -> Option<(Shape, Light, Oracle, DVec3, DVec3)> {
    let center = random.vector(3.0);
    let axis = random.direction();
    let across = axis.any_orthonormal_vector();
    let shape = match kind {
        SPHERE => Shape::Sphere(Sphere { center, radius: 1.0 }),
        DISC => Shape::Disc(Disc { center, normal: axis, radius: 1.0 }),
        TRIANGLE => Shape::Triangle(Triangle {
            vertices: [0.0, 2.1, 4.2].map(|from| {
                let turn = from + random.within(0.0, 1.5);
                center + across * turn.cos() + axis.cross(across) * turn.sin()
            }),
        }),
        CONE => Shape::Cone(Cone { base_center: center, axis, radius: 1.0, height: random.within(0.5, 3.0) }),
        RECTANGLE => Shape::Rectangle(Rectangle {
            center,
            half_right: across,
            half_forward: axis.cross(across) * random.within(0.4, 1.0),
        }),
        _ => Shape::Plane(Plane::through(center, axis)),
    };
    let toward = random.direction();
    if !matches!(kind, SPHERE | CONE) && toward.dot(axis).abs() < 0.3 {
        return None;
    }
    let light = match random.choice(3) {
        0 => Light::Directional { direction: -toward },
        _ => Light::Point { position: center + toward * random.within(4.0, 20.0) },
    };
    let oracle = Oracle::new(&shape, &light);
    let dark = center - toward * random.within(4.0, 10.0);
    let normal = random.direction();
    if normal.dot(toward).abs() < 0.3 || !oracle.blocks(dark) {
        return None;
    }
    let (mut dark, mut lit) = (dark, dark + normal.cross(random.direction()).normalize() * 30.0);
    if oracle.blocks(lit) {
        return None;
    }
    for _ in 0..50 {
        let middle = dark.midpoint(lit);
        *(if oracle.blocks(middle) { &mut dark } else { &mut lit }) = middle;
    }
    Some((shape, light, oracle, dark, normal))
}

/// The shadows of the corners of the shape on a plane through `point`.
fn corners(shape: &Shape, light: &Light, point: DVec3, normal: DVec3) -> Vec<DVec3> {
    let corners = match shape {
        Shape::Triangle(t) => t.vertices.to_vec(),
        Shape::Rectangle(r) => r.corners().to_vec(),
        Shape::Cone(c) => vec![c.apex()],
        _ => vec![],
    };
    let project = |corner: DVec3| {
        let way = light.vector_from(corner);
        corner - way * (normal.dot(corner - point) / normal.dot(way))
    };
    corners.into_iter().map(project).collect()
}

/// Limits of the root mean square error.
struct Limits {
    plain: f64,
    corners: f64,
}

/// Pixels on the edges of random shadows, a pixel being `across` of the shape's size where it is seen
/// head-on.
fn check(kind: u64, across: f64, limits: &Limits) {
    let mut random = Random(10 + kind);
    let (mut plain, mut cornered, mut single) = (Errors::default(), Errors::default(), Errors::default());
    while plain.count < cases(2000) {
        let Some((shape, light, oracle, edge, normal)) = edge_of_shadow(&mut random, kind) else { continue };
        // One in four at a corner.
        let all = corners(&shape, &light, edge, normal);
        let aim = if random.choice(4) == 0 { all.first().copied().unwrap_or(edge) } else { edge };
        let (view, pixel) = pixel(&mut random, aim, normal, across, 0.7);
        let Some(footprint) = pixel.footprint() else { continue };
        let Some(truth) = dark_area(&oracle, &pixel, &view.inverse()) else { continue };
        if !(0.001..=0.999).contains(&truth) {
            continue;
        }
        let (shape, light) = (shape.transformed(&view), light.transformed(&view));
        let blockers = Blockers::new(&shape, &light);
        let area = blockers.coverage(&footprint);
        let reach = 1.5 * footprint.dx.length().max(footprint.dy.length());
        let is_corner = corners(&shape, &light, footprint.point, pixel.receiver.normal)
            .iter()
            .any(|corner| corner.distance(footprint.point) < reach);
        (if is_corner { &mut cornered } else { &mut plain }).add(area - truth);
        let coarse = Footprint {
            point: footprint.point.as_vec3(),
            dx: footprint.dx.as_vec3(),
            dy: footprint.dy.as_vec3(),
        };
        let coarse = blockers.iter().map(|(b, _)| b.to_f32().coverage(&coarse)).fold(0.0, f32::max);
        single.add(f64::from(coarse) - area);
    }
    println!(
        "{} at {across}: {} pixels, RMS {:.4}, largest {:.3}; {} corners, RMS {:.4}, largest {:.3}; float32 RMS {:.6}",
        NAMES[kind as usize],
        plain.count,
        plain.rms(),
        plain.largest,
        cornered.count,
        cornered.rms(),
        cornered.largest,
        single.rms(),
    );
    assert!(plain.rms() <= limits.plain, "edges: {} > {}", plain.rms(), limits.plain);
    assert!(cornered.count == 0 || cornered.rms() <= limits.corners, "corners: {}", cornered.rms());
    // Rounding of 6e-8 of coordinates of ten, over a pixel of 2e-2, with room for the shear of footprints.
    assert!(single.rms() <= 1e-4, "float32: {}", single.rms());
}

/// Limits for pixels of 2 % and of 8 % of the shape's size: half as much again as measured. One pixel is one
/// straight edge to the closed forms; what is left is the edge's curvature, for polygons the
/// perspective inside a pixel, and for a cone the places where its disc and its triangle meet.
fn check_sizes(kind: u64, plain: [f64; 2]) {
    check(kind, 0.02, &Limits { plain: plain[0], corners: CORNERS });
    check(kind, 0.08, &Limits { plain: plain[1], corners: CORNERS });
}

/// At a corner two edges are put together by the angle between them: measured .0136 to .0156.
const CORNERS: f64 = 0.02;

#[test]
fn spheres() {
    check_sizes(SPHERE, [0.004, 0.013]);
}

#[test]
fn discs() {
    check_sizes(DISC, [0.004, 0.015]);
}

#[test]
fn triangles() {
    check_sizes(TRIANGLE, [0.002, 0.008]);
}

#[test]
fn cones() {
    check_sizes(CONE, [0.009, 0.022]);
}

#[test]
fn rectangles() {
    check_sizes(RECTANGLE, [0.002, 0.008]);
}

#[test]
fn planes() {
    check_sizes(PLANE, [0.002, 0.007]);
}
