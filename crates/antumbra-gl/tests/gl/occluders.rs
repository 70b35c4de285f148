//! Occluders of every number and kind, and what is wrong with them.

use crate::context::in_each_api;
use crate::lights::{STEP, overlay};
use crate::shot::Shot;
use crate::world::{ONE_OF_EACH, World};
use antumbra_gl::{DepthFormat, Encoding, Light, Occluder, Renderer};
use antumbra_math::{Plane, Rectangle, Sphere};
use glam::{DVec3, Vec3};
use std::fmt::Write;

#[test]
fn no_occluders_no_shadows() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let frame = shot.frame().occluders(&[]);
        let picture = overlay(gl, &mut renderer, &frame, Encoding::Linear);
        assert!(picture.iter().all(|texel| *texel == [255; 4]), "nothing takes anything");
        assert!(shot.masks(&mut renderer, &frame).iter().flatten().all(|&m| m == 255), "all is lit");
        assert_eq!(renderer.stats().polygons, 0, "nothing is drawn");
    });
}

/// Occluders that are none: zero sizes, NaN, infinities.
pub(crate) fn nonsense() -> Vec<Occluder> {
    let mut all = Vec::new();
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let at = DVec3::new(bad, 1.0, 0.0);
        all.extend([
            Occluder::sphere(at, 1.0),
            Occluder::sphere(DVec3::Y, bad),
            Occluder::disc(at, DVec3::Y, 1.0),
            Occluder::disc(DVec3::Y, at, 1.0),
            Occluder::disc(DVec3::Y, DVec3::Y, bad),
            Occluder::triangle([at, DVec3::X, DVec3::Y]),
            Occluder::cone(at, DVec3::Y, 1.0),
            Occluder::cone(DVec3::Y, at, 1.0),
            Occluder::cone(DVec3::ZERO, DVec3::Y, bad),
            Occluder::new(Plane { normal: at, offset: 0.0 }),
            Occluder::new(Plane { normal: DVec3::Y, offset: bad }),
            Occluder::new(Rectangle { center: at, half_right: DVec3::X, half_forward: DVec3::Z }),
            Occluder::new(Rectangle { center: DVec3::Y, half_right: at, half_forward: DVec3::Z }),
        ]);
    }
    all.extend([
        Occluder::sphere(DVec3::Y, 0.0),
        Occluder::sphere(DVec3::Y, -1.0),
        Occluder::disc(DVec3::Y, DVec3::ZERO, 1.0),
        Occluder::disc(DVec3::Y, DVec3::Y, 0.0),
        Occluder::disc(DVec3::Y, DVec3::Y, -1.0),
        Occluder::triangle([DVec3::Y; 3]),
        Occluder::triangle([DVec3::ZERO, DVec3::Y, DVec3::Y * 2.0]),
        Occluder::cone(DVec3::Y, DVec3::Y, 0.0),
        Occluder::cone(DVec3::ZERO, DVec3::Y, 0.0),
        Occluder::cone(DVec3::ZERO, DVec3::Y, -1.0),
        Occluder::new(Rectangle { center: DVec3::Y, half_right: DVec3::ZERO, half_forward: DVec3::Z }),
    ]);
    all
}

#[test]
fn occluders_that_are_none_cast_nothing() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        for id in [0, 99] {
            for occluder in nonsense() {
                let these = [occluder.with_id(id)];
                let frame = shot.frame().occluders(&these);
                let masks = shot.masks(&mut renderer, &frame);
                assert!(masks.iter().flatten().all(|&m| m == 255), "{occluder:?} casts a shadow");
            }
        }
        gl.assert_no_complaint("nonsense");
        // And it does not get in the way of the others.
        let alone = shot.masks(&mut renderer, &shot.frame());
        let mut all = nonsense();
        all.extend(&world.occluders);
        all.extend(nonsense());
        let among = shot.masks(&mut renderer, &shot.frame().occluders(&all));
        assert!(among == alone, "the shadows of the others change");
    });
}

#[test]
fn lights_that_are_nowhere_take_nothing() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let alone = shot.masks(&mut renderer, &shot.frame());
        for bad in [f64::NAN, f64::INFINITY] {
            let at = DVec3::new(0.0, bad, 0.0);
            let nowhere = [
                Light::point(at, Vec3::ONE),
                Light::directional(DVec3::ZERO, Vec3::ONE),
                Light::directional(at, Vec3::ONE),
                Light::spot(at, DVec3::Y, 0.1, 0.2, Vec3::ONE),
            ];
            let mut lights = nowhere.to_vec();
            lights.extend(&world.lights);
            let masks = shot.masks(&mut renderer, &shot.frame().lights(&lights));
            assert!(masks[4..] == alone[..], "the masks of the others change");
            assert!(masks[..4].iter().flatten().all(|&m| m == 255), "what is nowhere casts nothing");
            let frame = shot.frame().lights(&nowhere);
            let picture = crate::lights::overlay(gl, &mut renderer, &frame, Encoding::Linear);
            assert!(picture.iter().all(|texel| *texel == [255; 4]), "and takes nothing");
            gl.assert_no_complaint("lights that are nowhere");
        }
    });
}

/// A light inside a solid lights nothing outside.
#[test]
fn a_light_inside_an_occluder_is_dark() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let lights = [Light::point(DVec3::Y * 4.0, Vec3::ONE)];
        let solids =
            [Occluder::sphere(DVec3::Y * 4.1, 0.5), Occluder::cone(DVec3::Y * 3.9, DVec3::Y * 5.0, 1.0)];
        for solid in solids {
            let these = [solid.with_id(99)];
            let frame = shot.frame().lights(&lights).occluders(&these);
            let masks = shot.masks(&mut renderer, &frame);
            let dark = (0..shot.seen.len()).all(|i| (masks[0][i] == 0) == shot.seen[i].is_some());
            assert!(dark, "{solid:?} lets light out");
        }
    });
}

#[test]
fn objects_that_receive_no_shadow_keep_their_light() {
    in_each_api(|gl| {
        let text = ONE_OF_EACH.replace("name = \"wall\"", "name = \"wall\"\nreceives_shadow = false");
        let text = text.replace("name = \"ball\"", "name = \"ball\"\nreceives_shadow = false");
        let world = World::parse(&text);
        let shot = Shot::new(gl, &world);
        let truth = world.truth(&shot);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        truth.assert_overlay(&overlay(gl, &mut renderer, &shot.frame(), Encoding::Linear), STEP);
        let masks = shot.masks(&mut renderer, &shot.frame());
        let refuses = |i: usize| shot.seen[i].is_some_and(|s| !world.receives[s.primitive as usize]);
        let pixels: Vec<usize> = (0..shot.seen.len()).filter(|&i| refuses(i)).collect();
        assert!(pixels.len() > 500, "{} pixels to look at", pixels.len());
        for mask in &masks {
            assert!(pixels.iter().all(|&i| mask[i] == 255), "a shadow falls where none may");
        }
    });
}

/// Occluders of one id are one solid; with ids of their own they shadow each other.
#[test]
fn parts_of_one_solid_do_not_shadow_each_other() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let floor = |i: usize| shot.seen[i].is_some_and(|s| s.primitive == 0);
        let ball = Occluder::new(Sphere { center: DVec3::Y, radius: 0.8 });
        let masks = [1, 50].map(|id| {
            let these = [ball.with_id(id)];
            let frame = shot.frame().occluders(&these);
            shot.masks(&mut renderer, &frame)
        });
        let dark = |masks: &[Vec<u8>]| (0..shot.seen.len()).filter(|&i| floor(i) && masks[0][i] == 0).count();
        assert_eq!(dark(&masks[0]), 0, "with the floor's id the ball is a part of the floor");
        assert!(dark(&masks[1]) > 100, "with its own it shadows the floor");
    });
}

#[test]
fn two_thousand_occluders_are_a_frame() {
    in_each_api(|gl| {
        let start = ONE_OF_EACH.find("[[object]]").expect("an object");
        let mut text = format!(
            "{}[[object]]\nname = \"floor\"\nshape = {{ type = \"plane\" }}\n",
            &ONE_OF_EACH[..start]
        );
        let mut random = fastrand::Rng::with_seed(5);
        for i in 0..2000 {
            let mut within = |low: f64, high: f64| low + random.f64() * (high - low);
            let (x, y, z) = (within(-8.0, 8.0), within(0.1, 2.0), within(-12.0, 3.0));
            let r = within(0.05, 0.15);
            let shape = match i % 3 {
                0 => format!("type = \"sphere\", radius = {r}"),
                1 => format!("type = \"disc\", radius = {r}"),
                _ => format!("type = \"cone\", radius = {r}, height = {}", 2.0 * r),
            };
            write!(
                text,
                "[[object]]\nname = \"o{i}\"\nshape = {{ {shape} }}\ntranslation = [{x}, {y}, {z}]\n"
            )
            .expect("writing to a string");
        }
        let world = World::parse(&text);
        // Pixels small beside the shadows.
        let viewport = [0, 0, 480, 360];
        let shot = Shot::with(gl, &world, world.camera(viewport), viewport, DepthFormat::default());
        let truth = world.truth(&shot);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        for (light, mask) in shot.masks(&mut renderer, &shot.frame()).iter().enumerate() {
            truth.assert_mask_where_sure(light, mask);
        }
        assert_eq!(renderer.stats().pairs, 3 * world.occluders.len(), "every pair is looked at");
        gl.assert_no_complaint("two thousand occluders");
    });
}
