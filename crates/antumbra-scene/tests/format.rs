//! What a file says is what the scene is: values, defaults, units, poses, motions and bounds.

mod common;

use std::path::Path;

use antumbra_scene::{LightKind, Motion, Object, Scene, Shape};
use glam::{DQuat, DVec3};

fn parse(text: &str) -> Scene {
    Scene::parse(text, Path::new("scene.toml")).unwrap_or_else(|e| panic!("{e}"))
}

fn object<'a>(scene: &'a Scene, name: &str) -> &'a Object {
    scene.objects.iter().find(|o| o.name == name).unwrap_or_else(|| panic!("no object {name}"))
}

#[test]
fn every_key_arrives() {
    let scene = parse(common::EVERYTHING);
    common::assert_sound(&scene, 2.5);
    assert_eq!(scene.ambient, DVec3::new(0.05, 0.06, 0.07), "ambient");
    assert_eq!(scene.camera.eye, DVec3::new(0.0, 6.0, 12.0), "eye");
    assert_eq!(scene.camera.target, DVec3::Y, "target");
    assert_eq!(scene.camera.up, DVec3::Y, "up comes back as a unit vector");
    assert_eq!(scene.camera.fov_y, 50f64.to_radians(), "degrees become radians");
    assert_eq!((scene.image.width, scene.image.height, scene.image.exposure), (320, 180, 1.5), "the image");
    let kinds: Vec<LightKind> = scene.lights.iter().map(|l| l.kind).collect();
    assert_eq!(kinds[0], LightKind::Point, "an integer is a number");
    assert_eq!(scene.lights[0].intensity, 120.0, "an integer is a number");
    assert_eq!(scene.lights[0].color, DVec3::ONE, "lights are white if nothing else is said");
    let LightKind::Directional { direction } = kinds[1] else { panic!("{:?}", kinds[1]) };
    assert!((direction - DVec3::new(1.0, -2.0, 0.5).normalize()).length() < 1e-15, "a unit vector");
    let LightKind::Spot { inner_angle, outer_angle, .. } = kinds[2] else { panic!("{:?}", kinds[2]) };
    assert_eq!(
        (inner_angle, outer_angle),
        (15f64.to_radians(), 25f64.to_radians()),
        "half-angles in radians"
    );
    assert_eq!(kinds[3], LightKind::Sphere { radius: 0.5 }, "a sphere light");
    let LightKind::Rectangle { direction, right, width, height } = kinds[5] else { panic!("{:?}", kinds[5]) };
    assert_eq!((width, height), (2.0, 1.0), "the full size");
    assert!(
        direction.dot(right).abs() < 1e-15 && right.z > 0.8,
        "right is turned across the direction: {right}"
    );

    assert!(!object(&scene, "floor").casts_shadow && object(&scene, "floor").receives_shadow, "flags");
    assert!(object(&scene, "coin").casts_shadow && !object(&scene, "coin").receives_shadow, "flags");
    assert_eq!(
        object(&scene, "floor").color,
        DVec3::splat(0.8),
        "objects are light grey if nothing else is said"
    );
    let shapes: Vec<&Shape> = object(&scene, "snowman").parts.iter().map(|p| &p.shape).collect();
    assert_eq!(*shapes[3], Shape::Cylinder { radius: 0.3, height: 0.6, radius_top: 0.2 }, "a frustum");
    assert_eq!(*shapes[5], Shape::Box { size: DVec3::new(0.1, 0.2, 0.3) }, "a box");
    let turn = object(&scene, "snowman").pose.rotation;
    let quarter = DQuat::from_rotation_y(core::f64::consts::FRAC_PI_2);
    assert!((turn - quarter).length() < 1e-15, "{turn} is the unit quaternion of 0 1 0 1");
    let Some(Motion::Orbit { axis, period, .. }) = &object(&scene, "snowman").motion else {
        panic!("an orbit")
    };
    assert_eq!((*axis, *period), (DVec3::NEG_Y, -30.0), "an orbit");
}

#[test]
fn defaults() {
    let scene = parse(
        "camera.eye = [0, 2, 9]\n[[light]]\nname = 's'\ntype = 'spot'\nposition = [0, 4, 0]\ndirection = [0, -1, 0]\nintensity = 0\n[[object]]\nname = 'c'\nshape = { type = 'cylinder', radius = 2, height = 1 }",
    );
    assert_eq!(scene.ambient, DVec3::ZERO, "no ambient light");
    assert_eq!((scene.camera.target, scene.camera.up), (DVec3::ZERO, DVec3::Y), "the origin, +Y up");
    assert_eq!(scene.camera.fov_y, 45f64.to_radians(), "45 degrees");
    assert_eq!(scene.image, antumbra_scene::Image::default(), "the default image");
    assert_eq!((scene.image.width, scene.image.height), (960, 540), "960 by 540");
    let LightKind::Spot { inner_angle, outer_angle, .. } = scene.lights[0].kind else { panic!("a spot") };
    assert_eq!((inner_angle, outer_angle), (0.0, core::f64::consts::FRAC_PI_4), "glTF's defaults");
    assert_eq!(
        scene.objects[0].parts[0].shape,
        Shape::Cylinder { radius: 2.0, height: 1.0, radius_top: 2.0 },
        "no frustum"
    );
    assert_eq!(scene.objects[0].parts[0].pose, antumbra_scene::Pose::IDENTITY, "a plain shape is one part");
}

#[test]
fn limits_are_inclusive() {
    for (key, value) in [
        ("camera.eye", "[1e6, -1e6, 1000000]"),
        ("image.width", "16384"),
        ("image.height", "1"),
        ("image.exposure", "1e9"),
        ("ambient", "[0, 0, 1e9]"),
        ("camera.fov_y", "179"),
        ("camera.fov_y", "0.01"),
        ("camera.fov_y", "0b101101"),
        ("camera.fov_y", "1_0.5_0"),
        ("camera.fov_y", "+45"),
    ] {
        let eye = if key == "camera.eye" { "" } else { "camera.eye = [0, 2, 9]\n" };
        common::assert_sound(&parse(&format!("{eye}{key} = {value}")), 0.0);
    }
    for shape in [
        "{ type = 'sphere', radius = 1e-6 }",
        "{ type = 'sphere', radius = 1e6 }",
        "{ type = 'torus', major_radius = 0.5, minor_radius = 0.5 }",
        "{ type = 'triangle', vertices = [[0, 0, 0], [1e-6, 0, 0], [0, 1e-6, 0]] }",
        "{ type = 'triangle', vertices = [[-1e6, -1e6, -1e6], [1e6, 1e6, 1e6], [0, 1e6, 0]] }",
    ] {
        common::assert_sound(
            &parse(&format!("camera.eye = [0, 2, 9]\n[[object]]\nname = 'o'\nshape = {shape}")),
            0.0,
        );
    }
}

#[test]
fn windows_lines_and_byte_order_marks_are_fine() {
    let text = format!("\u{feff}{}", common::EVERYTHING.replace('\n', "\r\n"));
    assert_eq!(parse(&text), parse(common::EVERYTHING), "only the line ends differ");
}

#[test]
fn round_numbers_survive_exactly() {
    let text = "camera.eye = [0.1, 0.2, 1e-3]\n[[object]]\nname = 'o'\nshape = { type = 'sphere', radius = 0.3 }\ntranslation = [1.1, -2.2, 3.3]\nrotation = [0, 0, 0, 2]";
    let scene = parse(text);
    let p = &scene.moment(17.0).primitives[0];
    assert_eq!(scene.camera.eye, DVec3::new(0.1, 0.2, 1e-3), "the nearest float64");
    assert_eq!(
        (p.pose.translation, p.pose.rotation),
        (DVec3::new(1.1, -2.2, 3.3), DQuat::IDENTITY),
        "no rounding"
    );
    assert_eq!(p.shape, Shape::Sphere { radius: 0.3 }, "no rounding");
}

#[test]
fn moments_place_parts_in_the_world() {
    let scene = parse(common::EVERYTHING);
    let moment = scene.moment(7.5);
    let (index, snowman) =
        scene.objects.iter().enumerate().find(|(_, o)| o.name == "snowman").expect("it is in the scene");
    // The orbit has made a quarter turn: backwards about -Y, which is forwards about +Y.
    let quarter = DQuat::from_rotation_y(core::f64::consts::FRAC_PI_2);
    let place = quarter * DVec3::new(2.0, 0.0, 0.0);
    for (part, p) in moment.primitives.iter().filter(|p| p.object == index).enumerate() {
        assert_eq!(p.part, part, "parts are in order");
        let expected = place + quarter * snowman.parts[part].pose.translation;
        assert!((p.pose.translation - expected).length() < 1e-14, "{} is not {expected}", p.pose.translation);
        // Only the translation moves; the object's own rotation is a quarter turn too.
        let turn = quarter * snowman.parts[part].pose.rotation;
        assert!((p.pose.rotation - turn).length() < 1e-14, "{} is not {turn}", p.pose.rotation);
    }
    // Half of the path's first side: 2.5 s of a period of 5 s over three sides is half of the second.
    let stage = scene.moment(2.5).lights.into_iter().find(|l| l.name == "stage").expect("it is in the scene");
    assert!((stage.position - DVec3::new(-3.0, 6.0, 3.0)).length() < 1e-14, "{}", stage.position);
    assert!(moment.lights.iter().all(|l| l.motion.is_none()), "a moment does not move");
    assert_eq!(scene.moment(f64::NAN), scene.moment(0.0), "a time that is none is 0");
}

#[test]
fn bounds_are_tight() {
    let scene = parse(common::EVERYTHING);
    let mut random = fastrand::Rng::with_seed(7);
    for mut p in scene.moment(0.0).primitives {
        for _ in 0..20 {
            let component = |r: &mut fastrand::Rng| r.f64() * 2.0 - 1.0;
            let q = DQuat::from_array(core::array::from_fn(|_| component(&mut random)));
            p.pose.rotation = q.normalize();
            let Some((low, high)) = p.bounds() else { continue };
            let (mut seen_low, mut seen_high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            let mut see = |v: DVec3| {
                let v = p.pose.point(v);
                assert!(
                    v.cmpge(low - 1e-12).all() && v.cmple(high + 1e-12).all(),
                    "{p:?}: {v} is outside {low} {high}"
                );
                (seen_low, seen_high) = (seen_low.min(v), seen_high.max(v));
            };
            surface(&p.shape, &mut see);
            // The samples are 2° apart, and a circle of radius 1 leaves a chord of that by 1.5e-4; the
            // two angles of an ellipsoid make it twice that.
            let gap = (seen_low - low).max(high - seen_high).max_element();
            assert!(gap < 4e-4, "{p:?}: {low} {high} leaves {gap} to {seen_low} {seen_high}");
        }
    }
}

/// Points all over a shape, its extreme ones among them or nearly.
fn surface(shape: &Shape, see: &mut impl FnMut(DVec3)) {
    const STEPS: usize = 180;
    let circles = |see: &mut dyn FnMut(DVec3), ring: &[(f64, f64)]| {
        for (radius, y) in ring {
            for i in 0..STEPS {
                let (s, c) = (i as f64 * core::f64::consts::TAU / STEPS as f64).sin_cos();
                see(DVec3::new(radius * c, *y, radius * s));
            }
        }
    };
    let ball = |radius: f64, at: f64, middle: f64| -> Vec<(f64, f64)> {
        (0..=STEPS)
            .map(|i| (i as f64 * core::f64::consts::TAU / STEPS as f64).sin_cos())
            .map(|(s, c)| (middle + radius * c, at + radius * s))
            .collect()
    };
    match *shape {
        Shape::Plane => {}
        Shape::Rectangle { width, depth } => {
            for (x, z) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                see(DVec3::new(0.5 * width * x, 0.0, 0.5 * depth * z));
            }
        }
        Shape::Disc { radius } => circles(see, &[(radius, 0.0)]),
        Shape::Triangle { vertices } => vertices.into_iter().for_each(see),
        Shape::Sphere { radius } => circles(see, &ball(radius, 0.0, 0.0)),
        Shape::Ellipsoid { radii } => circles(&mut |v| see(v * radii), &ball(1.0, 0.0, 0.0)),
        Shape::Cone { radius, height } => circles(see, &[(radius, -0.5 * height), (0.0, 0.5 * height)]),
        Shape::Cylinder { radius, height, radius_top } => {
            circles(see, &[(radius, -0.5 * height), (radius_top, 0.5 * height)]);
        }
        Shape::Capsule { radius, height } => {
            circles(see, &ball(radius, 0.5 * height, 0.0));
            circles(see, &ball(radius, -0.5 * height, 0.0));
        }
        Shape::Box { size } => {
            for i in 0..8 {
                let sign = |bit: u32| if i >> bit & 1 == 0 { -0.5 } else { 0.5 };
                see(size * DVec3::new(sign(0), sign(1), sign(2)));
            }
        }
        Shape::Torus { major_radius, minor_radius } => circles(see, &ball(minor_radius, 0.0, major_radius)),
        Shape::Mesh(ref mesh) => mesh.positions.iter().copied().for_each(see),
    }
}
