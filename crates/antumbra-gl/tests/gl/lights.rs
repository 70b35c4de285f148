//! Any number of lights, and how the host's pixels encode them.

use crate::context::{Gl, in_each_api, in_each_tier};
use crate::shot::{Canvas, Shot, assert_needs_floats, each_batch};
use crate::world::{ONE_OF_EACH, World};
use antumbra_gl::{BATCH_LIGHTS, Encoding, Frame, Light, Renderer, Technique};
use antumbra_math::{Plane, Shape};
use glam::{DVec3, Vec3};
use std::fmt::Write;

/// One step of 8 bits, rounding included.
pub(crate) const STEP: f32 = 1.01 / 255.0;

/// A world with as many lights as there are, round about.
pub(crate) fn many_lights(count: usize) -> World {
    let start = ONE_OF_EACH.find("[[light]]").expect("a light");
    let end = ONE_OF_EACH.find("[[object]]").expect("an object");
    let mut text = String::from(&ONE_OF_EACH[..start]);
    for i in 0..count {
        let (sin, cos) = (i as f64 * 2.4).sin_cos();
        let out = 1.0 + 5.0 * (i as f64 + 0.5) / count as f64;
        let (x, y, z) = (out * cos, 3.0 + (i % 5) as f64, 2.0 + out * sin);
        let (r, g) = (0.5 + 0.5 * sin, 0.5 + 0.5 * cos);
        write!(
            text,
            "[[light]]\nname = \"l{i}\"\ntype = \"point\"\nposition = [{x}, {y}, {z}]\ncolor = [{r}, {g}, 0.6]\nintensity = {}\n",
            100.0 / count as f64
        )
        .expect("writing to a string");
    }
    text.push_str(&ONE_OF_EACH[end..]);
    World::parse(&text)
}

pub(crate) fn overlay(
    gl: &Gl,
    renderer: &mut Renderer,
    frame: &Frame<'_>,
    encoding: Encoding,
) -> Vec<[u8; 4]> {
    let canvas = Canvas::new(gl);
    renderer.overlay(frame, encoding).expect("the frame is right");
    gl.assert_no_complaint("an overlay");
    canvas.read(0)
}

#[test]
fn the_overlay_is_what_arrives_over_what_is_sent() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let truth = world.truth(&shot);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let picture = overlay(gl, &mut renderer, &shot.frame(), Encoding::Linear);
        truth.assert_overlay(&picture, STEP);
        assert!(picture.iter().all(|texel| texel[3] == 255), "alpha stays");
    });
}

#[test]
fn masks_are_the_visibility_of_each_light() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let truth = world.truth(&shot);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let masks = shot.masks(&mut renderer, &shot.frame());
        assert_eq!(masks.len(), 3, "one a light");
        for (light, mask) in masks.iter().enumerate() {
            truth.assert_mask(light, mask);
        }
    });
}

/// A host that wrote radiance^(1/2.2) gets the factor^(1/2.2): half the light stays half the light.
#[test]
fn gamma_encoded_pixels_get_the_encoded_factor() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let linear = overlay(gl, &mut renderer, &shot.frame(), Encoding::Linear);
        let encoded = overlay(gl, &mut renderer, &shot.frame(), Encoding::Gamma(2.2));
        for (linear, encoded) in linear.iter().zip(&encoded) {
            for (l, e) in linear.iter().zip(encoded).take(3) {
                // Half a step of the linear byte is steeper than this in the encoded one.
                let [low, high] =
                    [-0.5, 0.5].map(|d| ((f32::from(*l) + d).max(0.0) / 255.0).powf(1.0 / 2.2) * 255.0);
                let e = f32::from(*e);
                assert!(low - 1.0 <= e && e <= high + 1.0, "{l} became {e}, not {low} to {high}");
            }
        }
        let one = overlay(gl, &mut renderer, &shot.frame(), Encoding::Gamma(1.0));
        assert!(one == linear, "a gamma of one is linear");
    });
}

#[test]
fn more_lights_than_a_batch_make_one_overlay() {
    in_each_tier(|gl| {
        let world = many_lights(20);
        let shot = Shot::new(gl, &world);
        let truth = world.truth(&shot);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        if !gl.has_floats() {
            return assert_needs_floats(&mut renderer, &shot.frame());
        }
        let picture = overlay(gl, &mut renderer, &shot.frame(), Encoding::Linear);
        truth.assert_overlay(&picture, STEP);
        assert_eq!(renderer.stats().batches, 3, "20 lights are three batches");
        assert_eq!(renderer.stats().pairs, 20 * world.occluders.len(), "every pair is looked at");
    });
}

/// The overlay of 20 lights is the one that the host computes from 20 masks, on edges too.
#[test]
fn masks_of_many_lights_come_in_batches_and_say_what_the_overlay_says() {
    in_each_tier(|gl| {
        let world = many_lights(20);
        let shot = Shot::new(gl, &world);
        let truth = world.truth(&shot);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let mut batches = Vec::new();
        each_batch(&mut renderer, &shot.frame(), |b| batches.push((b.first_light, b.lights)))
            .expect("the frame is right");
        assert_eq!(batches, [(0, BATCH_LIGHTS), (8, BATCH_LIGHTS), (16, 4)], "three batches");
        let masks = shot.masks(&mut renderer, &shot.frame());
        for (light, mask) in masks.iter().enumerate() {
            truth.assert_mask(light, mask);
        }
        if !gl.has_floats() {
            return assert_needs_floats(&mut renderer, &shot.frame());
        }
        let picture = overlay(gl, &mut renderer, &shot.frame(), Encoding::Linear);
        for (i, seen) in shot.seen.iter().enumerate() {
            let (mut arrives, mut all) = (world.ambient, world.ambient);
            for (light, mask) in masks.iter().enumerate() {
                let e = truth.lights[light][i].1;
                arrives += e * (f32::from(mask[i]) / 255.0);
                all += e;
            }
            let expected = if seen.is_some() { arrives / all } else { Vec3::ONE };
            let [r, g, b, _] = picture[i].map(|c| f32::from(c) / 255.0);
            let off = (Vec3::new(r, g, b) - expected).abs().max_element();
            assert!(off <= STEP, "pixel {i}: {:?} is not {expected}", picture[i]);
        }
    });
}

#[test]
fn bounds_save_time_and_change_nothing() {
    in_each_api(|gl| {
        let world = many_lights(9);
        let shot = Shot::new(gl, &world);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let sides = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::Z, DVec3::NEG_Z];
        // Everything that is seen lies in this box, what is rounded in the depth buffer far away too.
        let reach = |axis: DVec3| {
            let points = shot.seen.iter().flatten().map(|s| s.point.dot(axis));
            Plane { normal: axis, offset: points.fold(f64::INFINITY, f64::min) - 0.5 }
        };
        let bounds = sides.map(reach);
        // Opaque planes with ids bound what is seen by themselves: without the floor shadows go on below it.
        let shapes: Vec<_> =
            world.occluders.iter().copied().filter(|o| !matches!(o.shape, Shape::Plane(_))).collect();
        let frame = shot.frame().occluders(&shapes);
        for technique in ["analytic", "volume"] {
            renderer.set_technique(Technique::parse(technique).expect("a technique")).expect("it");
            let mut masks = |frame: &Frame<'_>| (shot.masks(&mut renderer, frame), renderer.stats());
            let ((without, all), (with, some)) = (masks(&frame), masks(&frame.bounds(&bounds)));
            assert!(with == without, "{technique}: the masks differ");
            assert!(
                some.touched_tiles < all.touched_tiles,
                "{technique}: {some:?} with bounds, {all:?} without"
            );
        }
        renderer.set_technique(Technique::analytic()).expect("a technique");
        let without = shot.masks(&mut renderer, &shot.frame());
        // Nonsense is not worse than nothing.
        let nan =
            [Plane { normal: DVec3::NAN, offset: f64::NAN }, Plane { normal: DVec3::ZERO, offset: 0.0 }];
        let with = shot.masks(&mut renderer, &shot.frame().bounds(&nan));
        assert!(with == without, "the masks differ where the bounds are not planes");
    });
}

#[test]
fn dark_lights_and_none_are_fine() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let white = vec![[255u8; 4]; shot.seen.len()];
        let none = shot.frame().lights(&[]);
        assert!(overlay(gl, &mut renderer, &none, Encoding::Linear) == white, "no light takes nothing");
        assert!(shot.masks(&mut renderer, &none).is_empty(), "no light has no mask");
        let dark: Vec<Light> = world.lights.iter().map(|l| l.with_intensity(Vec3::ZERO)).collect();
        let dark = shot.frame().lights(&dark).ambient(Vec3::ZERO);
        assert!(overlay(gl, &mut renderer, &dark, Encoding::Linear) == white, "dark lights take nothing");
        let masks = shot.masks(&mut renderer, &dark);
        assert!(masks.iter().flatten().all(|&m| m == 255), "a dark light's mask is one");
    });
}
