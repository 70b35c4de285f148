//! The technique `projected`: what falls on its receivers, and what must not.

mod host;
mod paint;

use crate::context::{Gl, in_each_api};
use crate::lights::{many_lights, overlay};
use crate::samples;
use crate::shot::{Shot, VIEWPORT, each_batch, known};
use crate::world::{ONE_OF_EACH, World};
use antumbra_gl::{
    Camera, Depth, DepthFormat, Encoding, Frame, Light, Occluder, Receiver, ReceiverShape, Renderer,
    Technique,
};
use antumbra_math::{Plane, Rectangle};
use glam::{DMat4, DVec3, Vec3};
use std::cell::Cell;

fn renderer(gl: &Gl, technique: &str) -> Renderer {
    let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
    let technique = Technique::parse(technique).expect("a technique");
    renderer.set_technique(technique).expect("the driver has what it needs");
    renderer
}

/// Asserts that the masks on the receivers' pixels are the tracer's visibilities, and 255 elsewhere; edges, which are
/// not antialiased, are left out. Returns how many pixels are dark.
fn assert_right(world: &World, shot: &Shot<'_>, masks: &[Vec<u8>], what: &str) -> usize {
    let truth = world.truth(shot);
    let on_receiver = |i: usize| {
        shot.seen[i].is_some_and(|s| {
            let id = s.primitive + 1;
            world.receives[s.primitive as usize] && world.receivers.iter().any(|r| r.id == id)
        })
    };
    let mut dark = 0;
    for (light, mask) in masks.iter().enumerate() {
        for (i, &value) in mask.iter().enumerate() {
            if !on_receiver(i) {
                assert_eq!(value, 255, "{what}, light {light}, pixel {i}: no receiver, no shadow");
                continue;
            }
            let (visibility, irradiance) = truth.lights[light][i];
            if truth.sure[i] && irradiance != Vec3::ZERO {
                let right = value == if visibility > 0.5 { 255 } else { 0 };
                assert!(right, "{what}, light {light}, pixel {i}: {value} for {visibility}");
                dark += usize::from(visibility < 0.5);
            }
        }
    }
    dark
}

/// A scene of one camera over a floor.
fn over_floor(lights: &str, objects: &str) -> World {
    World::parse(&format!(
        r#"
        camera = {{ eye = [1.0, 3.5, 7.0], target = [0.0, 0.6, 0.0] }}
        {lights}
        [[object]]
        name = "floor"
        shape = {{ type = "plane" }}
        {objects}
        "#
    ))
}

fn point(position: [f64; 3]) -> String {
    format!("[[light]]\nname = \"l\"\ntype = \"point\"\nposition = {position:?}\nintensity = 50.0\n")
}

fn sun(direction: [f64; 3]) -> String {
    format!("[[light]]\nname = \"l\"\ntype = \"directional\"\ndirection = {direction:?}\nintensity = 2.0\n")
}

fn object(shape: &str, translation: [f64; 3]) -> String {
    format!("[[object]]\nname = \"o\"\nshape = {{ {shape} }}\ntranslation = {translation:?}\n")
}

/// Draws a world's masks and judges them.
fn dark_pixels(gl: &Gl, world: &World, what: &str) -> usize {
    let shot = Shot::new(gl, world);
    let masks = shot.masks(&mut renderer(gl, "projected"), &shot.frame());
    assert_right(world, &shot, &masks, what)
}

#[test]
fn every_caster_shadows_every_receiver_and_nothing_else() {
    in_each_api(|gl| {
        let dark = dark_pixels(gl, &World::one_of_each(), "one of each");
        assert!(dark > 500, "there are shadows: {dark}");
        // Two targets; more than one batch.
        let dark = dark_pixels(gl, &many_lights(11), "eleven lights");
        assert!(dark > 3000, "there are shadows: {dark}");
    });
}

#[test]
fn only_what_is_between_plane_and_light_casts() {
    in_each_api(|gl| {
        let ball = "type = \"sphere\", radius = 0.5";
        let high = point([0.5, 3.0, -1.5]);
        let sliver = "type = \"triangle\", vertices = [[-0.4, 0.2, 0.0], [0.4, 0.2, 0.0], [0.2, 6.0, 0.3]]";
        let long = "type = \"triangle\", vertices = [[-0.3, 0.3, 0.0], [0.3, 0.3, 0.0], [0.0, 40.0, -9.0]]";
        for (what, light, shape, at, casts) in [
            ("between", &high, ball, [0.0, 1.0, 0.0], true),
            ("beyond the light", &high, ball, [1.5, 4.0, 0.0], false),
            ("level with the light", &high, ball, [0.3, 2.6, -2.4], true),
            ("through the light's plane", &high, sliver, [-1.0, 0.0, 0.0], true),
            ("far through the light's plane", &high, long, [-0.5, 0.0, 0.5], true),
            ("round the light", &high, ball, [0.4, 3.1, -1.5], true),
            ("behind the floor", &high, ball, [0.0, -0.6, 0.0], false),
            ("through the floor", &high, ball, [-1.5, 0.2, 1.5], true),
            ("through the floor and the light's plane", &high, sliver, [-1.0, -2.5, 0.0], true),
            ("on the floor", &high, ball, [0.0, 0.5, 0.0], true),
            ("in the floor", &high, "type = \"disc\", radius = 0.5", [0.0, 0.0, 0.0], false),
            ("a sun from above", &sun([0.4, -1.0, -0.3]), ball, [0.0, 1.0, 0.0], true),
            ("a sun, behind the floor", &sun([0.4, -1.0, -0.3]), ball, [0.0, -0.6, 0.0], false),
            ("a low sun, through the floor", &sun([1.0, -0.1, -0.3]), ball, [-1.0, 0.2, 0.0], true),
            ("a sun from below", &sun([0.4, 1.0, -0.3]), ball, [0.0, 1.0, 0.0], false),
            ("a sun along the floor", &sun([1.0, 0.0, 0.0]), ball, [0.0, 0.2, 0.0], false),
            ("a light in the floor", &point([2.0, 0.0, 1.0]), ball, [0.0, 0.2, 0.0], false),
            ("a light below the floor", &point([2.0, -1.0, 1.0]), ball, [0.0, 0.2, 0.0], false),
            ("a light just over the floor", &point([2.0, 0.02, 1.0]), ball, [0.0, 0.2, 0.0], true),
            ("a far light", &point([2e5, 4e5, 1e5]), ball, [0.0, 1.0, 0.0], true),
            (
                "a light on a sheet",
                &high,
                "type = \"rectangle\", width = 1.0, depth = 1.0",
                [0.5, 3.0, -1.5],
                false,
            ),
            ("a light level with a disc", &high, "type = \"disc\", radius = 0.5", [0.5, 3.0, -3.5], false),
            (
                "a light on a triangle",
                &high,
                "type = \"triangle\", vertices = [[-1, -1, 0], [2, -1, 0], [0, 2, 0]]",
                [0.4, 2.9, -1.5],
                false,
            ),
            ("a light on the ball", &point([0.0, 1.5, 0.0]), ball, [0.0, 1.0, 0.0], true),
        ] {
            let world = over_floor(light, &object(shape, at));
            let shot = Shot::new(gl, &world);
            let masks = shot.masks(&mut renderer(gl, "projected"), &shot.frame());
            // A light on a solid's surface lights half of the room or none: rounding says.
            let dark = if what == "a light on the ball" {
                masks[0].iter().filter(|&&m| m == 0).count()
            } else {
                assert_right(&world, &shot, &masks, what)
            };
            assert_eq!(dark > 40, casts, "{what}: {dark} dark pixels");
            // The overlay looks at the tiles alone that shadows were said to touch.
            let picture = overlay(gl, &mut renderer(gl, "projected"), &shot.frame(), Encoding::Linear);
            let truth = world.truth(&shot);
            for (i, texel) in picture.iter().enumerate() {
                let dark = masks[0][i] == 0 && truth.lights[0][i].1 != Vec3::ZERO;
                assert_eq!(texel[0] < 255, dark, "{what}: pixel {i} of the overlay is {texel:?}");
            }
            if !casts {
                assert!(masks[0].iter().all(|&m| m == 255), "{what}: nothing at all is darkened");
            }
            gl.assert_no_complaint(what);
        }
    });
}

/// An infinite plane takes the light from all that is behind it: its shadow on another plane is a half-plane,
/// everything or nothing. The planes here are not drawn, or they would hide their shadows.
#[test]
fn infinite_planes_cast() {
    in_each_api(|gl| {
        let high = DVec3::new(1.5, 3.0, 0.0);
        let sun = Light::directional([-1.0, -1.0, -0.2], Vec3::ONE);
        let above = Light::point(high, Vec3::ONE);
        let (wall, slope) = (DVec3::X, DVec3::new(0.4, 1.0, 0.5));
        // A plane with the light in it is edge-on, and so are flat shapes; the one with the light on it too.
        for (what, light, through, normal) in [
            ("a wall", above, [-0.4, 0.0, 0.0], wall),
            ("a wall from behind", above, [-0.4, 0.0, 0.0], -wall),
            ("a slope", above, [0.5, 0.2, 1.0], slope),
            ("a slope through the light's foot", above, [1.5, 0.0, 0.0], slope),
            ("a steep slope over the light", above, [1.4, 3.0, 0.0], DVec3::new(1.0, 0.01, 0.0)),
            ("a wall in the sun", sun, [0.3, 0.0, 0.0], wall),
            ("a slope in the sun", sun, [0.5, 0.2, 1.0], slope),
            ("a ceiling under the light", above, [0.0, 2.5, 0.0], DVec3::Y),
            ("a ceiling over the light", above, [0.0, 3.5, 0.0], DVec3::Y),
            ("a ceiling in the sun", sun, [0.0, 3.5, 0.0], DVec3::NEG_Y),
            ("the floor itself", above, [0.0, 0.0, 0.0], DVec3::Y),
            ("a wall through the light", above, [1.5, 0.0, 0.0], wall),
            ("a slope through the light", above, [1.5, 3.0, 0.0], slope),
            ("a ceiling through the light", above, [0.0, 3.0, 0.0], DVec3::Y),
        ] {
            let world = over_floor(&point([1.5, 3.0, 0.0]), "");
            let shot = Shot::new(gl, &world);
            let plane = Plane::through(through.into(), normal.normalize());
            let (lights, occluders) = ([light], [Occluder::new(plane)]);
            let frame = shot.frame().lights(&lights).occluders(&occluders);
            let masks = shot.masks(&mut renderer(gl, "projected"), &frame);
            let mut judged = 0;
            for (i, seen) in shot.seen.iter().enumerate() {
                let Some(seen) = seen else { continue };
                let l = light.place.homogeneous();
                let light_side = plane.normal.dot(l.truncate()) - plane.offset * l.w;
                let height = plane.height(seen.point);
                // Two pixels of the farthest floor in sight; the floor itself has no other side.
                let nothing = what == "the floor itself" || what.ends_with("through the light");
                if height.abs() < 0.2 && !nothing {
                    continue;
                }
                let lit = nothing || height * light_side > 0.0;
                assert_eq!(masks[0][i], if lit { 255 } else { 0 }, "{what}: the floor at {}", seen.point);
                judged += 1;
            }
            assert!(judged > 5000, "{what}: {judged} pixels to look at");
        }
    });
}

/// A table over a floor: the table's shadow on the floor, the ball's on both, cut at the table's edge.
#[test]
fn shadows_end_where_their_receivers_do() {
    in_each_api(|gl| {
        let table = format!(
            "{}{}",
            object("type = \"rectangle\", width = 1.6, depth = 1.2", [0.0, 1.0, 0.5]),
            object("type = \"sphere\", radius = 0.45", [0.7, 1.6, 0.5]).replace("\"o\"", "\"ball\"")
        );
        let world = over_floor(&point([-0.5, 4.5, 1.5]), &table);
        let dark = dark_pixels(gl, &world, "a table");
        assert!(dark > 300, "there are shadows: {dark}");
        // Without ids it is geometry that tells floor and table.
        let shot = Shot::new(gl, &world);
        let mut frame = shot.frame();
        let mut renderer = renderer(gl, "projected");
        let with_ids = shot.masks(&mut renderer, &frame);
        let receivers: Vec<Receiver> = world.receivers.iter().map(|r| r.with_id(0)).collect();
        let occluders: Vec<Occluder> = world.occluders.iter().map(|o| o.with_id(0)).collect();
        (frame.receivers, frame.occluders, frame.surface.ids) = (&receivers, &occluders, None);
        assert!(with_ids == shot.masks(&mut renderer, &frame), "the same without ids");
    });
}

/// In one plane it is the bounds and the ids that tell what receives.
#[test]
fn shadows_end_inside_a_plane_too() {
    in_each_api(|gl| {
        let ball = object("type = \"sphere\", radius = 0.5", [0.0, 1.2, 0.0]).replace("\"o\"", "\"ball\"");
        let rug = object("type = \"rectangle\", width = 2.0, depth = 1.5", [-0.7, 0.3, -0.2])
            .replace("\"o\"", "\"rug\"");
        let other = object("type = \"rectangle\", width = 2.0, depth = 1.5", [1.3, 0.3, -0.2]);
        let world = over_floor(&point([0.2, 4.0, 1.5]), &(rug + &other + &ball));
        let shot = Shot::new(gl, &world);
        let mut renderer = renderer(gl, "projected");
        let count = |masks: &[Vec<u8>], what: &dyn Fn(u32, DVec3) -> bool| {
            let dark = |i: &usize| masks[0][*i] == 0;
            let seen = |i: &usize| shot.seen[*i].is_some_and(|s| what(s.primitive, s.point));
            (0..shot.seen.len()).filter(dark).filter(seen).count()
        };
        // The whole plane of the rug as a receiver with the rug's id: the other rectangle is none.
        let plane = ReceiverShape::Plane(Plane::through(DVec3::Y * 0.3, DVec3::Y));
        let receivers = [Receiver::new(plane).with_id(2)];
        let masks = shot.masks(&mut renderer, &shot.frame().receivers(&receivers));
        assert!(count(&masks, &|primitive, _| primitive == 1) > 50, "a shadow on the rug");
        assert_eq!(count(&masks, &|primitive, _| primitive != 1), 0, "and on nothing else");
        // A part of the floor as a receiver, without ids.
        let half_right = DVec3::X * 0.8;
        let part = Rectangle { center: DVec3::new(-0.8, 0.0, -0.5), half_right, half_forward: DVec3::Z };
        let receivers = [Receiver::new(ReceiverShape::Rectangle(part)).with_id(0)];
        let balls = [world.occluders[3].with_id(0)];
        let mut frame = shot.frame().receivers(&receivers).occluders(&balls);
        frame.surface.ids = None;
        let bare = over_floor(&point([0.2, 4.0, 1.5]), "");
        let bare_shot = Shot::new(gl, &bare);
        frame.surface.depth = Depth::Texture(known(bare_shot.depth));
        frame.surface.normals = None;
        let masks = bare_shot.masks(&mut renderer, &frame);
        let dark: Vec<DVec3> = (0..masks[0].len())
            .filter(|i| masks[0][*i] == 0)
            .map(|i| bare_shot.seen[i].expect("the floor").point)
            .collect();
        assert!(dark.len() > 50, "a shadow on the part: {}", dark.len());
        // A thousandth for the rounding of the depth buffer.
        assert!(dark.iter().all(|p| p.x < 1e-3 && p.x > -1.601 && p.z.abs() < 1.501), "none beside it");
    });
}

/// Twenty-five receivers side by side: more than the stencil buffer has marks for.
#[test]
fn there_may_be_more_receivers_than_marks() {
    in_each_api(|gl| {
        let mut tiles = String::new();
        for i in 0..25 {
            let at = [f64::from(i % 5) - 2.0, 0.3, f64::from(i / 5) - 2.0];
            tiles += &object("type = \"rectangle\", width = 0.9, depth = 0.9", at)
                .replace("\"o\"", &format!("\"tile {i}\""));
        }
        tiles += &object("type = \"sphere\", radius = 1.2", [0.2, 2.0, 0.0]).replace("\"o\"", "\"ball\"");
        let world = over_floor(&point([0.5, 6.0, 1.0]), &tiles);
        assert!(world.receivers.len() == 26, "the tiles and the floor");
        assert!(dark_pixels(gl, &world, "tiles") > 1000, "there are shadows");
    });
}

/// The side of a wall that is turned away from the light gets none of it, and no shadow is drawn there.
#[test]
fn the_back_of_a_wall_stays_as_it_is() {
    in_each_api(|gl| {
        let wall = |z: f64| {
            let world = format!(
                "{}rotation = [0.70710678, 0.0, 0.0, 0.70710678]\n{}",
                object("type = \"rectangle\", width = 4.0, depth = 3.0", [0.0, 1.5, 0.0]),
                object("type = \"sphere\", radius = 0.5", [0.0, 1.5, z]).replace("\"o\"", "\"ball\"")
            );
            let world = over_floor(&point([0.0, 2.0, 3.0 * z]), &world);
            let shot = Shot::new(gl, &world);
            let masks = shot.masks(&mut renderer(gl, "projected"), &shot.frame());
            assert_right(&world, &shot, &masks, "a wall");
            let on_wall = |i: &usize| shot.seen[*i].is_some_and(|s| s.primitive == 1);
            (0..shot.seen.len()).filter(on_wall).filter(|&i| masks[0][i] != 255).count()
        };
        assert!(wall(1.0) > 100, "the ball's shadow on the side that is seen");
        assert_eq!(wall(-1.0), 0, "on the back");
    });
}

#[test]
fn surfaces_that_receive_nothing_and_casters_of_the_receivers_own_id_are_left_out() {
    in_each_api(|gl| {
        let ball = object("type = \"sphere\", radius = 0.5", [0.0, 1.0, 0.0]);
        let world = over_floor(&point([0.5, 3.0, 1.0]), &ball);
        let shot = Shot::new(gl, &world);
        let mut renderer = renderer(gl, "projected");
        let lit = |frame: &Frame<'_>, renderer: &mut Renderer| {
            shot.masks(renderer, frame)[0].iter().all(|&m| m == 255)
        };
        let own = [world.occluders[1].with_id(world.receivers[0].id)];
        assert!(!lit(&shot.frame(), &mut renderer), "a ball casts");
        assert!(lit(&shot.frame().occluders(&own), &mut renderer), "a part of the floor does not");
        let mut deaf =
            over_floor(&point([0.5, 3.0, 1.0]), &ball.replace("name", "receives_shadow = true\nname"));
        deaf.receives[0] = false;
        let deaf_shot = Shot::new(gl, &deaf);
        assert!(deaf_shot.masks(&mut renderer, &deaf_shot.frame())[0].iter().all(|&m| m == 255), "NO_SHADOW");
    });
}

/// A parallel view, in a viewport that is not at the corner.
#[test]
fn any_camera_will_do() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let viewport = [13, 9, 150, 110];
        let mut parallel = DMat4::from_scale(DVec3::new(0.22, 0.3, -0.05));
        parallel.w_axis.z = -0.5;
        let cameras = [Camera::new(world.view, parallel), world.camera(viewport)];
        for camera in cameras {
            let shot = Shot::with(gl, &world, camera, viewport, DepthFormat::default());
            let masks = shot.masks(&mut renderer(gl, "projected"), &shot.frame());
            let dark = assert_right(&world, &shot, &masks, "a camera");
            assert!(dark > 300, "{camera:?}: there are shadows: {dark}");
        }
    });
}

/// Each sample of a multisampled surface is a pixel of its own.
#[test]
fn every_sample_has_its_own_shadow() {
    in_each_api(|gl| {
        let mut renderer = renderer(gl, "projected");
        if renderer.caps().max_samples < samples::SAMPLES as u32 {
            assert!(!gl.is_desktop(), "OpenGL has samples: {:?}", renderer.caps());
            return; // a refusal has a test of its own
        }
        let low = ONE_OF_EACH.replace("translation = [-1.0, 1.0, 0.3]", "translation = [-1.0, 0.2, 0.3]");
        let world =
            World::parse(&low.replace("translation = [0.2, 1.6, 0.0]", "translation = [0.2, 0.1, 0.0]"));
        let camera = world.camera(VIEWPORT);
        let shots: Vec<Shot<'_>> = samples::sample_positions(gl)
            .into_iter()
            .map(|at| {
                let camera = samples::shifted(&camera, at);
                Shot::with(gl, &world, camera, VIEWPORT, DepthFormat::default())
            })
            .collect();
        let frame = shots[0].frame().camera(camera).surface(samples::surface(gl, &shots));
        let textures = Cell::new(None);
        each_batch(&mut renderer, &frame, |batch| textures.set(Some(batch.textures)))
            .expect("the frame is right");
        gl.assert_no_complaint("masks");
        let textures = textures.take().expect("one batch");
        for (sample, shot) in shots.iter().enumerate() {
            let texels = samples::read_sample(gl, textures[0].glow(), samples::SIZE, sample as i32);
            let mask = |light: usize| texels.iter().map(|t| (t[light] * 255.0).round() as u8).collect();
            let masks: Vec<Vec<u8>> = (0..3).map(mask).collect();
            let dark = assert_right(&world, shot, &masks, "a sample");
            assert!(dark > 200, "there are shadows: {dark}");
        }
    });
}
