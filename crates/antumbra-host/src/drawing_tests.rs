//! Shapes drawn as triangles against the reference's rays, and what they leave behind in OpenGL.

use std::num::NonZeroU32;
use std::sync::Arc;

use antumbra::glam::{DVec3, Vec3};
use antumbra_reference::{Ray, Surface, Tracer};
use antumbra_scene::{Camera, Image, Light, LightKind, Mesh, Object, Part, Pose, Scene, Shape};
use glam::DQuat;
use glow::HasContext;

use crate::picture::SurfaceCopy;
use crate::tessellate::SEGMENTS;
use crate::{Api, Buffers, ColorFormat, Setting, Stage, TestContext};

const WIDTH: u32 = 192;
const HEIGHT: u32 = 128;

fn mesh(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Shape {
    let positions = positions.iter().map(|p| DVec3::from(*p)).collect();
    Shape::Mesh(Arc::new(Mesh { path: "mesh".into(), positions, triangles: triangles.to_vec() }))
}

/// A shape, how much more its normals turn than a unit ball's over the same distance, and whether the
/// triangles are the shape itself.
fn shapes() -> Vec<(Shape, f64, bool)> {
    // A pyramid without a base, on a place far from its origin.
    let far = [1000.0, -2000.0, 500.0];
    let at = |p: [f64; 3]| [p[0] + far[0], p[1] + far[1], p[2] + far[2]];
    let corners =
        [[-1.0, -0.5, -1.0], [1.0, -0.5, -1.0], [1.0, -0.5, 1.0], [-1.0, -0.5, 1.0], [0.0, 0.9, 0.2]];
    let sides = [[1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4]];
    vec![
        (Shape::Ellipsoid { radii: DVec3::new(0.6, 0.9, 1.1) }, 3.0, false),
        (Shape::Cylinder { radius: 0.8, height: 1.4, radius_top: 0.8 }, 1.3, false),
        (Shape::Cylinder { radius: 0.9, height: 1.2, radius_top: 0.3 }, 3.4, false),
        (Shape::Capsule { radius: 0.6, height: 0.9 }, 1.7, false),
        (Shape::Torus { major_radius: 0.8, minor_radius: 0.35 }, 2.9, false),
        (Shape::Box { size: DVec3::new(1.0, 1.4, 0.8) }, 0.0, true),
        (mesh(&corners.map(at), &sides), 0.0, true),
        (mesh(&[[-1.0, 0.0, -0.8], [1.0, 0.2, 0.0], [-0.2, 0.7, 1.0]], &[[0, 1, 2]]), 0.0, true),
    ]
}

fn object(name: &str, shape: Shape, pose: Pose) -> Object {
    Object {
        name: name.into(),
        parts: vec![Part { shape, pose: Pose::IDENTITY }],
        pose,
        color: DVec3::new(0.8, 0.6, 0.3),
        casts_shadow: false,
        receives_shadow: true,
        motion: None,
    }
}

/// A shape through a floor, with lights that shine everywhere.
fn scene(shape: &Shape, eye: DVec3, lights: usize) -> Scene {
    let rotation = turned();
    let middle = match shape {
        Shape::Mesh(mesh) => mesh.positions.iter().sum::<DVec3>() / mesh.positions.len() as f64,
        _ => DVec3::ZERO,
    };
    let pose = Pose { translation: DVec3::Y * 0.3 - rotation * middle, rotation };
    let light = |i: usize| {
        let (z, x) = (i as f64 * 2.4).sin_cos();
        let position = DVec3::new(3.0 * x, 2.0 + 0.01 * i as f64, 3.0 * z);
        let color = DVec3::new(1.0, 0.5 + 0.5 * x, 0.5 - 0.5 * x);
        let intensity = 30.0 / lights as f64;
        Light { name: format!("l{i}"), kind: LightKind::Point, position, color, intensity, motion: None }
    };
    let (width, height) = (WIDTH, HEIGHT);
    Scene {
        ambient: DVec3::splat(0.05),
        camera: Camera { eye, target: DVec3::new(0.1, 0.25, 0.05), up: DVec3::Y, fov_y: 0.9 },
        image: Image { width, height, ..Image::default() },
        lights: (0..lights).map(light).collect(),
        objects: vec![object("floor", Shape::Plane, Pose::IDENTITY), object("shape", shape.clone(), pose)],
    }
}

/// From three sides, one of them below the floor.
const EYES: [DVec3; 3] = [DVec3::new(1.0, 2.2, 3.4), DVec3::new(-3.0, 0.8, -1.8), DVec3::new(1.4, -2.4, 1.0)];

/// Inside a shape of [`scene`], if it has an inside.
fn inside(shape: &Shape) -> Option<DVec3> {
    let middle = DVec3::new(-0.06, 0.34, 0.11);
    match shape {
        // The middle of a torus is not in the tube.
        Shape::Torus { major_radius, .. } => Some(middle + turned() * DVec3::X * *major_radius),
        Shape::Mesh(mesh) if mesh.triangles.len() == 1 => None,
        // Near the pyramid's open base, so that its sides are seen.
        Shape::Mesh(_) => Some(middle + turned() * DVec3::new(0.2, -0.15, 0.3)),
        _ => Some(middle),
    }
}

fn turned() -> DQuat {
    DQuat::from_xyzw(0.3, -0.2, 0.5, 0.8).normalize()
}

fn setting(stage: &mut Stage, scene: &Scene) -> Setting {
    stage.setting(scene, 0.0, f64::from(WIDTH) / f64::from(HEIGHT)).expect("a setting")
}

/// What the reference sees through each pixel's centre, rows from top to bottom.
fn seen(scene: &Scene) -> Vec<Option<Surface>> {
    let tracer = Tracer::new(scene, 0.0);
    let centers = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (f64::from(x) + 0.5, f64::from(y) + 0.5)));
    centers
        .map(|(x, y)| {
            let (origin, direction) = scene.camera.ray(x, y, WIDTH, HEIGHT);
            tracer.surface(&Ray::new(origin, direction))
        })
        .collect()
}

/// The pixel and those around it.
fn around(i: usize) -> impl Iterator<Item = usize> {
    let (width, height) = (WIDTH as usize, HEIGHT as usize);
    let (x, y) = (i % width, i / width);
    (y.saturating_sub(1)..(y + 2).min(height))
        .flat_map(move |ny| (x.saturating_sub(1)..(x + 2).min(width)).map(move |nx| ny * width + nx))
}

/// Compares a drawn surface with the reference's: everywhere the same primitive, normal and distance as
/// in this pixel or, where an edge runs through, one beside it. Returns pixels of the shape.
fn compare(name: &str, scene: &Scene, drawn: &SurfaceCopy, turn: f64, exact: bool) -> usize {
    let view = scene.camera.view();
    let truth = seen(scene);
    // A ray that just misses the surface's top meets a triangle a sagitta below by up to half a
    // segment's turn away, and the normal there is as different; float32 gives 1e-5.
    let angle = turn * core::f64::consts::PI / f64::from(SEGMENTS) + 1e-5;
    // The sagitta of a curve of radius 1, seen at up to 80 degrees; beyond, a pixel's neighbours differ
    // by more. In float32 the distance has six digits.
    let depth = if exact { 2e-5 } else { 6.0 * (1.0 - (core::f64::consts::PI / f64::from(SEGMENTS)).cos()) };
    let mut on_shape = 0;
    for (i, expected) in truth.iter().enumerate() {
        let (x, y) = (i % WIDTH as usize, i / WIDTH as usize);
        let j = (HEIGHT as usize - 1 - y) * WIDTH as usize + x;
        let id = drawn.ids[j];
        let same = |k: &usize| truth[*k].as_ref().map_or(0, |s| s.primitive + 1) == id;
        let near: Vec<usize> = around(i).filter(same).collect();
        assert!(!near.is_empty(), "{name}: primitive {id} at {x}, {y} is not {expected:?}");
        on_shape += usize::from(id == 2);
        // Next to a silhouette the triangles of a curved shape end a tenth of a pixel early, and there a
        // ray's length and the normal change fast.
        let at_silhouette = around(i).any(|k| !same(&k));
        if id == 0 || (at_silhouette && !exact) {
            continue;
        }
        let (normal, position) = (drawn.normals[j].as_dvec3(), drawn.positions[j].as_dvec3());
        assert!((normal.length() - 1.0).abs() < 1e-5, "{name}: {normal} at {x}, {y} is unit");
        let surfaces = || near.iter().filter_map(|&k| truth[k].as_ref());
        let off = surfaces().map(|s| {
            let n = view.transform_vector3(s.normal);
            n.cross(normal).length().atan2(n.dot(normal))
        });
        let off = off.fold(f64::INFINITY, f64::min);
        assert!(off <= angle, "{name}: the normal {normal} at {x}, {y} is {off} off {expected:?}");
        let distances = || surfaces().map(|s| -view.transform_point3(s.point).z);
        let (low, high) = (distances().fold(f64::INFINITY, f64::min), distances().fold(0.0, f64::max));
        let distance = -position.z;
        let slack = depth * distance.max(1.0);
        assert!(
            distance > low - slack && distance < high + slack,
            "{name}: {distance} away at {x}, {y}, where the reference has {low} to {high}"
        );
    }
    on_shape
}

fn draw(stage: &mut Stage, setting: &Setting, samples: u32) {
    stage
        .draw(setting, WIDTH, HEIGHT, samples, ColorFormat::Rgba16F, Buffers::All)
        .expect("the setting draws");
}

fn surfaces_agree(api: Api) {
    let Some(context) = TestContext::new(api) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    for (shape, turn, exact) in shapes() {
        for eye in EYES.into_iter().chain(inside(&shape)) {
            let scene = scene(&shape, eye, 1);
            let setting = setting(&mut stage, &scene);
            draw(&mut stage, &setting, 1);
            let surface = stage.read_surface(&setting).expect("a surface");
            let name =
                format!("{api:?}, {} from {eye}", format!("{shape:?}").chars().take(40).collect::<String>());
            let count = compare(&name, &scene, &surface, turn, exact);
            // The triangle is seen almost edge-on once.
            assert!(count > 100, "{name}: {count} pixels see it");
        }
    }
}

#[test]
fn triangles_are_where_the_reference_sees_them() {
    surfaces_agree(Api::Gl33);
}

#[test]
fn triangles_are_where_the_reference_sees_them_with_opengl_es() {
    surfaces_agree(Api::Gles30);
}

/// Colour without shadows: the same light as the reference's, from one light and from more than one
/// pass holds, with one sample and with four.
#[test]
fn triangles_are_lit_as_the_reference_lights_them() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    for (shape, turn, _) in shapes() {
        for (lights, samples) in [(1, 1), (600, 1), (2, 4)] {
            let scene = scene(&shape, EYES[1], lights);
            let setting = setting(&mut stage, &scene);
            draw(&mut stage, &setting, samples);
            let drawn = stage.read_color().expect("a picture");
            let truth = Tracer::new(&scene, 0.0).render(WIDTH, HEIGHT, 1, &|_, _| {});
            let seen = seen(&scene);
            let mut compared = 0;
            for i in 0..truth.len() {
                let Some(here) = &seen[i] else { continue };
                let smooth = around(i).all(|k| {
                    seen[k]
                        .as_ref()
                        .is_some_and(|s| s.primitive == here.primitive && s.normal.dot(here.normal) > 0.99)
                });
                // Where surfaces turn away, and where pixels are edges, one ray is not the pixel.
                let sight = (here.point - scene.camera.eye).normalize();
                if !smooth || here.normal.dot(sight) > -0.2 {
                    continue;
                }
                compared += usize::from(here.primitive == 1);
                let (got, expected) = (Vec3::from(drawn[i]), Vec3::from(truth[i]));
                // float16 has three digits, light changes within a pixel, and the normal as it turns along
                // the sagitta's offset.
                let most = expected.max_element() * 1e-3 + 1e-3 + 2e-3 * turn as f32;
                assert!(
                    (got - expected).abs().max_element() < most,
                    "{shape:?}, {lights} lights, {samples} samples: {got} at {i}, not {expected}"
                );
            }
            assert!(compared > 300, "{shape:?}: {compared} pixels compared");
        }
    }
}

/// Live buffers, vertex arrays excepted: names are handed out from the smallest.
fn buffers(gl: &glow::Context) -> usize {
    let names = (1..2000).filter_map(NonZeroU32::new).map(glow::NativeBuffer);
    // SAFETY: accepts any name.
    names.filter(|name| unsafe { gl.is_buffer(*name) }).count()
}

#[test]
fn buffers_are_made_once_and_deleted() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let gl = context.gl();
    let before = buffers(gl);
    let mut stage = Stage::new(gl).expect("a stage");
    let plain = buffers(gl);
    let all: Vec<Setting> =
        shapes().iter().map(|(shape, ..)| setting(&mut stage, &scene(shape, EYES[0], 1))).collect();
    for round in 0..3 {
        for setting in &all {
            draw(&mut stage, setting, 1);
            draw(&mut stage, setting, 1);
            assert_eq!(buffers(gl), plain + 1, "round {round}: one shape, one buffer");
        }
    }
    // Shapes drawn together have a buffer each, and equal ones share it.
    let mut many = scene(&shapes()[0].0, EYES[0], 1);
    for (i, (shape, ..)) in shapes().into_iter().enumerate() {
        many.objects.push(object(&format!("o{i}"), shape, Pose::IDENTITY));
    }
    let many = setting(&mut stage, &many);
    draw(&mut stage, &many, 1);
    assert_eq!(buffers(gl), plain + shapes().len(), "the first shape is there twice");
    let ball = setting(&mut stage, &scene(&Shape::Sphere { radius: 1.0 }, EYES[0], 1));
    draw(&mut stage, &ball, 1);
    assert_eq!(buffers(gl), plain, "a ball needs none");
    draw(&mut stage, &many, 1);
    drop(stage);
    assert_eq!(buffers(gl), before, "nothing is left");
    // SAFETY: asks for the error flag.
    assert_eq!(unsafe { gl.get_error() }, glow::NO_ERROR, "and nothing went wrong");
}
