//! What it asks of the host and leaves behind, and what it makes of nonsense.

use super::renderer;
use crate::context::in_each_api;
use crate::leaks::live;
use crate::lights::many_lights;
use crate::occluders::nonsense;
use crate::odd_host::OddHost;
use crate::samples;
use crate::shot::{Shot, each_batch};
use crate::snapshot::{assert_same, snapshot};
use crate::world::{ONE_OF_EACH, World};
use antumbra_gl::Part;
use antumbra_gl::{Area, Encoding, Error, Frame, Light, Receiver, ReceiverShape};
use antumbra_math::{Plane, Rectangle};
use glam::{DVec3, Vec3};

#[test]
fn casters_and_receivers_that_are_none_do_nothing() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let mut renderer = renderer(gl, "projected");
        let alone = shot.masks(&mut renderer, &shot.frame());
        let casters = nonsense();
        let masks = shot.masks(&mut renderer, &shot.frame().occluders(&casters));
        assert!(masks.iter().flatten().all(|&m| m == 255), "nonsense casts nothing");
        let mut receivers: Vec<Receiver> = [f64::NAN, f64::INFINITY, 0.0]
            .into_iter()
            .flat_map(|bad| {
                let bad = DVec3::splat(bad);
                let rectangle = |center, half_right, half_forward| {
                    ReceiverShape::Rectangle(Rectangle { center, half_right, half_forward })
                };
                [
                    rectangle(DVec3::Y, bad, DVec3::Z),
                    rectangle(DVec3::Y, DVec3::X, bad),
                    rectangle(bad / bad, DVec3::X, DVec3::Z),
                    ReceiverShape::Plane(Plane { normal: bad, offset: 0.0 }),
                    ReceiverShape::Plane(Plane { normal: DVec3::Y, offset: bad.x / bad.x }),
                ]
            })
            .map(|shape| Receiver::new(shape).with_id(1))
            .collect();
        let masks = shot.masks(&mut renderer, &shot.frame().receivers(&receivers));
        assert!(masks.iter().flatten().all(|&m| m == 255), "nothing falls on nonsense");
        receivers.extend(&world.receivers);
        let mut occluders = nonsense();
        occluders.extend(&world.occluders);
        let frame = shot.frame().receivers(&receivers).occluders(&occluders);
        assert!(shot.masks(&mut renderer, &frame) == alone, "nor is it in the way of the others");
        let bad = DVec3::new(0.0, f64::NAN, 1.0);
        let lights = [Light::point(bad, Vec3::ONE), Light::directional(bad, Vec3::ONE)];
        let masks = shot.masks(&mut renderer, &shot.frame().lights(&lights));
        assert!(masks.iter().flatten().all(|&m| m == 255), "lights that are nowhere take nothing");
        gl.assert_no_complaint("nonsense");
    });
}

/// State, errors, objects and allocations, however it draws.
#[test]
fn every_way_of_drawing_leaves_no_trace() {
    in_each_api(|gl| {
        let world = many_lights(6);
        let shot = Shot::new(gl, &world);
        for technique in ["projected", "projected:shade=paper", "projected:shade=paper:stencil=off"] {
            let host = OddHost::new(gl, samples::SIZE);
            let (before, objects) = (snapshot(gl), live(&gl.gl));
            let mut renderer = renderer(gl, technique);
            let mut draw = || {
                renderer.overlay(&shot.frame(), Encoding::Linear).expect("the frame is right");
                assert_same(&before, &snapshot(gl), technique);
                let inside = || assert_same(&before, &snapshot(gl), technique);
                each_batch(&mut renderer, &shot.frame(), |_| inside()).expect("the frame is right");
                assert_same(&before, &snapshot(gl), technique);
                gl.assert_no_complaint(technique);
                let frame = shot.frame();
                let counted = allocation_counter::measure(|| {
                    renderer.overlay(&frame, Encoding::Linear).expect("the frame is right");
                    each_batch(&mut renderer, &frame, |_| {}).expect("the frame is right");
                });
                (counted.count_total, live(&gl.gl))
            };
            let first = draw();
            assert!(
                draw() == (0, first.1) && first.1 != objects,
                "{technique}: a steady frame makes nothing"
            );
            drop(renderer);
            assert_eq!(live(&gl.gl), objects, "{technique}: objects outlive the renderer");
            host.calm_down(gl);
        }
    });
}

#[test]
fn what_it_cannot_do_is_refused() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let refused = |technique: &str, frame: &Frame<'_>| match each_batch(
            &mut renderer(gl, technique),
            frame,
            |_| {},
        ) {
            Err(Error::Refused { technique: "projected", refusal }) => refusal,
            other => panic!("{technique}: {other:?}"),
        };
        let frame = shot.frame();
        let nowhere = refused("projected", &frame.receivers(&[]));
        assert!(
            nowhere.part == Part::Receivers && nowhere.reason.to_string().contains("none to fall on"),
            "{nowhere:?}"
        );
        let area = world.lights[0].with_area(Area::Sphere { radius: 0.1 });
        let lights = [world.lights[1], area];
        assert_eq!(refused("projected", &frame.lights(&lights)).part, Part::Light(1), "an area");
        let options = refused("projected:stencil=off", &frame);
        assert!(
            options.part == Part::Options && options.reason.to_string().contains("shade=paper"),
            "{options:?}"
        );
        each_batch(&mut renderer(gl, "projected:shade=paper:stencil=off"), &frame, |_| {})
            .expect("for teaching");
    });
}

#[test]
fn counts_are_of_casters_receivers_and_triangles() {
    in_each_api(|gl| {
        let text = ONE_OF_EACH.replace("casts_shadow = true", "");
        let world = World::parse(&text);
        let shot = Shot::new(gl, &world);
        let mut renderer = renderer(gl, "projected");
        // The triangle alone, over a floor that two lights and a spot shine on.
        let triangle = [*world.occluders.last().expect("a triangle")];
        let frame = shot.frame().occluders(&triangle).receivers(&world.receivers[..1]);
        each_batch(&mut renderer, &frame, |_| {}).expect("the frame is right");
        let stats = renderer.stats();
        assert_eq!(stats.pairs, 3, "three lights, a caster and a receiver");
        assert!((1..=3).contains(&stats.polygons), "one triangle for each light in sight: {stats:?}");
        each_batch(&mut renderer, &frame.receivers(&world.receivers), |_| {}).expect("the frame is right");
        assert_eq!(renderer.stats().pairs, 6, "and two receivers");
    });
}
