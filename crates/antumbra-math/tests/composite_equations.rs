//! The composite method's equations with numbers worked by hand, and the same in any pose.

mod plane_shadow_support;

use antumbra_math::composite::{
    self, PaperFrame, PaperLight, PartShape, SphereForm, shade, shadow_apex_x, shadow_base, shadow_radius,
    shadow_x,
};
use antumbra_math::{Cone, Disc, Light, Plane, PlaneFrame, Shape, Sphere, Triangle};
use glam::{DMat4, DQuat, DVec2, DVec3};
use plane_shadow_support::Random;

/// Sums of a few products of small numbers.
const ROUNDING: f64 = 1e-14;

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= ROUNDING * (1.0 + b.abs())
}

/// The papers' plane, y = 0.
fn floor() -> PlaneFrame {
    PlaneFrame::of_plane(&Plane::through(DVec3::ZERO, DVec3::Y)).expect("a plane")
}

/// The papers' light, (x_i, y_i, 0).
fn point_light(x: f64, y: f64) -> Light {
    Light::Point { position: DVec3::new(x, y, 0.0) }
}

/// Shapes in world space and shades of a shadow on the floor.
fn cast(shape: impl Into<Shape>, light: &Light, form: SphereForm) -> Vec<(Shape, f64)> {
    let shadow = composite::cast(&shape.into(), light, &floor(), form).expect("the papers' pose");
    shadow.parts().map(|part| (part.shape.in_world(&floor()), part.shade)).collect()
}

fn assert_disc(shape: &Shape, x: f64, radius: f64) {
    let Shape::Disc(disc) = shape else { panic!("a disc, not {shape:?}") };
    assert!(disc.center.abs_diff_eq(DVec3::new(x, 0.0, 0.0), ROUNDING * 10.0), "centre {}", disc.center);
    assert!(close(disc.radius, radius), "radius {}, not {radius}", disc.radius);
}

fn assert_triangle(shape: &Shape, xz: [[f64; 2]; 3]) {
    let Shape::Triangle(triangle) = shape else { panic!("a triangle, not {shape:?}") };
    for (corner, [x, z]) in triangle.vertices.iter().zip(xz) {
        assert!(corner.abs_diff_eq(DVec3::new(x, 0.0, z), ROUNDING * 10.0), "{corner}, not {x} {z}");
    }
}

#[test]
fn the_numbered_equations() {
    let light = PaperLight { x: 3.0, y: 6.0, w: 1.0 };
    // (2): -2 * 3 / (6 - 2) = -6/4.
    assert_eq!(shadow_x(light, 2.0), -1.5, "x_s");
    // (3): 1 * 6 / (6 - 2) = 6/4.
    assert_eq!(shadow_radius(light, 1.0, 2.0), 1.5, "r_s");
    // (4): 2 * 6 / (6 - 2) = 12/4.
    assert_eq!(shadow_base(light, 2.0, 2.0), 3.0, "a_1");
    // (8): 3 * (1 + 2) / (2 + 1 - 6) = 9/-3.
    assert_eq!(shadow_apex_x(light, 1.0, 2.0), -3.0, "x_s3");
    // (2) with d = 0: "x_s is zero".
    assert_eq!(shadow_x(light, 0.0), 0.0, "an object on the surface");
    // (1): distObj = √(1.5² + 2²) = 2.5, distLight = √(4.5² + 6²) = 7.5, k = 1 - 2.5/7.5.
    let k = shade(DVec3::new(0.0, 2.0, 0.0), DVec3::new(3.0, 6.0, 0.0), DVec3::new(-1.5, 0.0, 0.0));
    assert!(close(k, 2.0 / 3.0), "k: {k}");
}

/// A light that moves away along (3, 4): x_s -> -d 3/4, r_s -> r, k -> 1.
#[test]
fn directional_lights_are_the_limit() {
    let limit = PaperLight { x: 0.6, y: 0.8, w: 0.0 };
    assert!(close(shadow_x(limit, 2.0), -1.5), "-2 * 0.6 / 0.8");
    assert!(close(shadow_radius(limit, 1.7, 2.0), 1.7), "r");
    assert!(close(shadow_apex_x(limit, 1.0, 2.0), -2.25), "-(1 + 2) * 0.6 / 0.8");
    let far = PaperLight { x: 0.6e9, y: 0.8e9, w: 1.0 };
    assert!((shadow_x(far, 2.0) - shadow_x(limit, 2.0)).abs() < 1e-8, "x_s");
    assert!((shadow_radius(far, 1.7, 2.0) - 1.7).abs() < 1e-8, "r_s");
    assert!((shadow_apex_x(far, 1.0, 2.0) + 2.25).abs() < 1e-8, "x_s3");
    let sun = Light::Directional { direction: DVec3::new(-3.0, -4.0, 0.0) };
    let disc = Disc { center: DVec3::Y * 2.0, normal: DVec3::Y, radius: 1.7 };
    let parts = cast(disc, &sun, SphereForm::Tangent);
    assert_disc(&parts[0].0, -1.5, 1.7);
    assert_eq!(parts[0].1, 1.0, "white: infinitely faint");
    for form in [SphereForm::Circle, SphereForm::Tangent] {
        let parts = cast(Sphere { center: DVec3::Y * 2.0, radius: 1.7 }, &sun, form);
        assert_disc(&parts[0].0, -1.5, 1.7);
    }
}

#[test]
fn a_disc() {
    // The numbers of the equations above.
    let disc = Disc { center: DVec3::Y * 2.0, normal: -DVec3::Y, radius: 1.0 };
    let parts = cast(disc, &point_light(3.0, 6.0), SphereForm::Tangent);
    assert_eq!(parts.len(), 1, "{parts:?}");
    assert_disc(&parts[0].0, -1.5, 1.5);
    assert!(close(parts[0].1, 2.0 / 3.0), "{parts:?}");
    // Straight above: centre 0, radius 1 * 6/4, k = 1 - 2/6.
    let parts = cast(disc, &point_light(0.0, 6.0), SphereForm::Tangent);
    assert_disc(&parts[0].0, 0.0, 1.5);
    assert!(close(parts[0].1, 2.0 / 3.0), "{parts:?}");
}

#[test]
fn a_triangle() {
    let light = point_light(3.0, 6.0);
    let (base, apex) = (DVec3::Y * 2.0, DVec3::Y * 3.0);
    // Base 2 along z at d = 2, h = 1: x_s = -1.5, a_1 / 2 = 1.5, x_s3 = -3 as above. The papers print
    // P1 and P2 at x = 0.
    let across = Triangle { vertices: [base - DVec3::Z, base + DVec3::Z, apex] };
    let parts = cast(across, &light, SphereForm::Tangent);
    assert_eq!(parts.len(), 1, "{parts:?}");
    assert_triangle(&parts[0].0, [[-1.5, -1.5], [-1.5, 1.5], [-3.0, 0.0]]);
    // k of the base's centre.
    assert!(close(parts[0].1, 2.0 / 3.0), "{parts:?}");
    // Base along x: x_s1 = -1.5 - 1.5, x_s2 = -1.5 + 1.5, x_s3: on one line, no area.
    let along = Triangle { vertices: [base - DVec3::X, base + DVec3::X, apex] };
    assert!(cast(along, &light, SphereForm::Tangent).is_empty(), "a line");
    let frame = PaperFrame::new(&floor(), &light, base).expect("above the plane");
    let (x_s, a_1) = (shadow_x(frame.light, frame.d), shadow_base(frame.light, 2.0, frame.d));
    assert_eq!([x_s - a_1 / 2.0, x_s + a_1 / 2.0], [-3.0, 0.0], "x_s1, x_s2: (6), (7)");
    // The corner at x = -1 by (2) in its own frame, where the light is at x = 4:
    // -1 + -2 * 4 / 4 = -3; that at x = 1: 1 + -2 * 2 / 4 = 0.
    for (corner, expected) in [(base - DVec3::X, -3.0), (base + DVec3::X, 0.0)] {
        let frame = PaperFrame::new(&floor(), &light, corner).expect("above the plane");
        let p = floor().point(frame.on_plane(shadow_x(frame.light, frame.d), 0.0));
        assert!(p.abs_diff_eq(DVec3::X * expected, ROUNDING), "{p}");
    }
}

#[test]
fn a_sphere_both_ways() {
    // Resting: d = r = 3, light (3, 7, 0), D = √(3² + 4²) = 5.
    let ball = Sphere { center: DVec3::Y * 3.0, radius: 3.0 };
    let light = point_light(3.0, 7.0);
    // x_s = -3 * 3 / 4; the circle has 3 * 7 / 4.
    let circle = cast(ball, &light, SphereForm::Circle);
    assert_disc(&circle[0].0, -2.25, 5.25);
    // The tangent circle: radius 3 √(1 - 9/25) = 2.4, its centre 9/5 nearer to the light, at height
    // 3 + 1.8 * 4/5 = 4.44; 2.4 * 7 / (7 - 4.44) = 16.8 / 2.56. Its centre is on the line from light to
    // ball: the same x_s.
    let tangent = cast(ball, &light, SphereForm::Tangent);
    assert_disc(&tangent[0].0, -2.25, 6.5625);
    // distObj = √(2.25² + 3²) = 3.75, distLight = √(5.25² + 7²) = 8.75: 1 - 3.75/8.75 = 4/7.
    for parts in [circle, tangent] {
        assert!(close(parts[0].1, 4.0 / 7.0), "{parts:?}");
    }
}

#[test]
fn a_sphere_straight_below_the_light() {
    let mut random = Random(41);
    for _ in 0..1000 {
        let (r, d) = (random.within(0.1, 2.0), random.within(2.0, 4.0));
        let y = d + r * random.within(1.01, 10.0);
        let ball = Sphere { center: DVec3::Y * d, radius: r };
        let distance = y - d;
        let tangent = cast(ball, &point_light(0.0, y), SphereForm::Tangent);
        let exact = r * y / (distance * distance - r * r).sqrt();
        let Shape::Disc(disc) = tangent[0].0 else { panic!("{tangent:?}") };
        // Next to the ball's surface 1 - r²/D² keeps two digits less.
        assert!((disc.radius / exact - 1.0).abs() < 1e-12, "{} {exact}", disc.radius);
        let circle = cast(ball, &point_light(0.0, y), SphereForm::Circle);
        assert_disc(&circle[0].0, 0.0, r * y / distance);
    }
}

#[test]
fn a_cone_either_way_up() {
    let light = point_light(6.0, 7.0);
    // Base at d = 1, h = 2: x_s = -1 * 6 / 6, r_s = 1 * 7 / 6, x_s3 = 6 * 3 / (3 - 7) = -4.5;
    // k: similar triangles, 1 - d / y_i = 6/7.
    let up = Cone { base_center: DVec3::Y, axis: DVec3::Y, radius: 1.0, height: 2.0 };
    let parts = cast(up, &light, SphereForm::Tangent);
    assert_eq!(parts.len(), 2, "{parts:?}");
    assert_disc(&parts[0].0, -1.0, 7.0 / 6.0);
    assert_triangle(&parts[1].0, [[-1.0, -7.0 / 6.0], [-1.0, 7.0 / 6.0], [-4.5, 0.0]]);
    for (_, shade) in parts {
        assert!(close(shade, 6.0 / 7.0), "{shade}");
    }
    // Upside down: base at d = 3, apex at 1: x_s = -3 * 6 / 4, r_s = 7/4, x_s3 = 6 * 1 / (1 - 7) = -1;
    // k = 1 - 3/7.
    let down = Cone { base_center: DVec3::Y * 3.0, axis: -DVec3::Y, radius: 1.0, height: 2.0 };
    let parts = cast(down, &light, SphereForm::Tangent);
    assert_disc(&parts[0].0, -4.5, 1.75);
    assert_triangle(&parts[1].0, [[-4.5, -1.75], [-4.5, 1.75], [-1.0, 0.0]]);
    for (_, shade) in parts {
        assert!(close(shade, 4.0 / 7.0), "{shade}");
    }
    // Straight above, and while the apex falls into the disc: x_i = 1 gives x_s = -1/6,
    // x_s3 = -3/4, and 7/12 < 7/6.
    for x in [0.0, 1.0] {
        let parts = cast(up, &point_light(x, 7.0), SphereForm::Tangent);
        assert_eq!(parts.len(), 1, "{parts:?}");
        assert_disc(&parts[0].0, -x / 6.0, 7.0 / 6.0);
    }
}

/// A setting on the papers' floor: one of the shapes, wholly between plane and light.
fn setting(random: &mut Random) -> (Shape, Light) {
    let (r, d, h) = (random.within(0.2, 1.0), random.within(1.0, 3.0), random.within(0.2, 2.0));
    let center = DVec3::Y * d + DVec3::new(random.within(-2.0, 2.0), 0.0, random.within(-2.0, 2.0));
    let shape = match random.choice(4) {
        0 => Disc { center, normal: DVec3::Y, radius: r }.into(),
        1 => Sphere { center, radius: r }.into(),
        2 => Triangle { vertices: [0; 3].map(|_| center + random.vector(1.0)) }.into(),
        _ => {
            let axis = DVec3::Y * if random.choice(2) == 0 { 1.0 } else { -1.0 };
            let base_center = center + DVec3::Y * if axis.y < 0.0 { h } else { 0.0 };
            Cone { base_center, axis, radius: r, height: h }.into()
        }
    };
    let to_light = DVec3::new(random.within(-8.0, 8.0), random.within(5.5, 20.0), random.within(-8.0, 8.0));
    let light = if random.choice(5) == 0 {
        Light::Directional { direction: -to_light }
    } else {
        Light::Point { position: to_light }
    };
    (shape, light)
}

fn same(a: &Shape, b: &Shape, tolerance: f64) -> bool {
    match (a, b) {
        (Shape::Disc(a), Shape::Disc(b)) => {
            a.center.abs_diff_eq(b.center, tolerance) && (a.radius - b.radius).abs() <= tolerance
        }
        (Shape::Triangle(a), Shape::Triangle(b)) => {
            a.vertices.iter().zip(b.vertices).all(|(a, b)| a.abs_diff_eq(b, tolerance))
        }
        _ => false,
    }
}

/// Plane, light and shape moved together: the shadow comes along, whichever way the plane's normal
/// points.
#[test]
fn any_pose_is_the_papers_pose_moved() {
    let mut random = Random(42);
    let mut shapes = 0;
    for _ in 0..5000 {
        let (shape, light) = setting(&mut random);
        let turn = DQuat::from_axis_angle(random.direction(), random.within(0.0, 6.0));
        let motion = DMat4::from_rotation_translation(turn, random.vector(30.0));
        let side = if random.choice(2) == 0 { 1.0 } else { -1.0 };
        let plane = Plane { normal: DVec3::Y * side, offset: 0.0 }.transformed(&motion);
        let frame = PlaneFrame::of_plane(&plane).expect("a plane");
        for form in [SphereForm::Circle, SphereForm::Tangent] {
            let here = cast(shape, &light, form);
            let there =
                composite::cast(&shape.transformed(&motion), &light.transformed(&motion), &frame, form)
                    .expect("the papers' pose, moved");
            let there: Vec<_> = there.parts().map(|part| (part.shape.in_world(&frame), part.shade)).collect();
            assert_eq!(here.len(), there.len(), "{shape:?} {light:?}");
            for ((here, k), (there, moved_k)) in here.iter().zip(&there) {
                // Coordinates up to a hundred metres.
                assert!(same(&here.transformed(&motion), there, 1e-11), "{here:?} {there:?}");
                assert!((k - moved_k).abs() < 1e-12, "{k} {moved_k}");
                shapes += 1;
            }
        }
    }
    assert!(shapes > 9000, "{shapes} parts");
}

/// The frame itself: light and object where the papers draw them.
#[test]
fn the_papers_frame() {
    let mut random = Random(43);
    for _ in 0..1000 {
        let normal = random.direction();
        let plane = Plane::through(random.vector(5.0), normal);
        let frame = PlaneFrame::of_plane(&plane).expect("a plane");
        let (point, position) = (random.vector(9.0), random.vector(20.0));
        let Some(paper) = PaperFrame::new(&frame, &Light::Point { position }, point) else {
            panic!("the light is in no such plane: {plane:?} {position}");
        };
        let y = normal * paper.side;
        let place = |x: f64, height: f64| frame.point(paper.on_plane(x, 0.0)) + y * height;
        assert!(place(0.0, paper.d).abs_diff_eq(point, 1e-12), "object at (0, d, 0)");
        let PaperLight { x, y: y_i, w } = paper.light;
        assert!(place(x, y_i).abs_diff_eq(position, 1e-12), "light at (x_i, y_i, 0)");
        assert!(x >= 0.0 && y_i > 0.0 && w == 1.0, "{:?}", paper.light);
        let [x, z] = [paper.x_axis, paper.z_axis].map(|a| frame.point(a) - frame.point(DVec2::ZERO));
        assert!(x.cross(y).abs_diff_eq(z, 1e-12), "z = x × y");
    }
}

#[test]
fn parts_hold_their_points() {
    let disc = PartShape::Disc { center: DVec2::new(1.0, 2.0), radius: 0.5 };
    assert!(disc.contains(DVec2::new(1.4, 2.0)) && !disc.contains(DVec2::new(1.4, 2.4)), "disc");
    let vertices = [DVec2::ZERO, DVec2::X, DVec2::Y];
    for vertices in [vertices, [vertices[1], vertices[0], vertices[2]]] {
        let triangle = PartShape::Triangle { vertices };
        assert!(triangle.contains(DVec2::splat(0.4)), "inside, either order");
        assert!(!triangle.contains(DVec2::splat(0.6)), "outside, either order");
    }
    for part in [disc, PartShape::Triangle { vertices }] {
        assert!(!part.contains(DVec2::NAN), "no point");
        assert!(!part.contains(DVec2::INFINITY), "no point");
    }
}
