//! The composite method as a guest: what it refuses, leaves behind, allocates, and what odd hosts do to it.

use crate::composite::{SCENE, floor, renderer, technique};
use crate::context::in_each_api;
use crate::leaks::live;
use crate::odd_host::OddHost;
use crate::shot::{Canvas, Shot, VIEWPORT, bare, each_batch};
use crate::snapshot::{assert_same, snapshot};
use crate::world::World;
use antumbra_gl::Part;
use antumbra_gl::technique::composite::{Shade, SphereForm};
use antumbra_gl::{Area, Encoding, Error, Light, Occluder, Receiver, ReceiverShape, Technique};
use antumbra_math::Rectangle;
use glam::{DVec2, DVec3, Vec3};

#[test]
fn what_it_cannot_do_is_refused_by_part() {
    in_each_api(|gl| {
        let world = World::parse(SCENE);
        let shot = Shot::new(gl, &world);
        let point = world.lights[0];
        let sun = Light::directional(-DVec3::Y, Vec3::ONE);
        let lamp = point.with_area(Area::Sphere { radius: 0.1 });
        let tilted = Occluder::disc(DVec3::Y, DVec3::new(0.1, 1.0, 0.0), 0.5);
        let table = Occluder::rectangle(DVec3::Y, DVec3::X, DVec3::Z);
        let sunk = Occluder::sphere(DVec3::ZERO, 0.5);
        let two = [floor(1)[0], floor(9)[0]];
        let flat = Rectangle { center: DVec3::ZERO, half_right: DVec3::X, half_forward: DVec3::ZERO };
        let nowhere = [Receiver::new(ReceiverShape::Rectangle(flat)).with_id(1)];
        let receivers = floor(1);
        let frame = shot.frame().receivers(&receivers);
        let (with_sun, with_lamp) = ([point, sun], [point, lamp]);
        let (sunk, table, tilted) = ([sunk], [table], [world.occluders[1], tilted]);
        let cases = [
            ("paper", frame.lights(&with_sun), Part::Light(1), "point lights alone"),
            ("physical", frame.lights(&with_lamp), Part::Light(1), "an area"),
            ("paper", frame.receivers(&[]), Part::Receivers, "needs one plane"),
            ("paper", frame.receivers(&two), Part::Receivers, "several"),
            ("paper", frame.receivers(&nowhere), Part::Receivers, "some extent"),
            ("physical", frame.occluders(&sunk), Part::Occluder(0), "passes through"),
            ("paper", frame.occluders(&table), Part::Occluder(0), "discs, triangles"),
            ("paper", frame.occluders(&tilted), Part::Occluder(1), "parallel"),
        ];
        let _canvas = Canvas::new(gl);
        for (shade, frame, part, says) in cases {
            let technique = Technique::parse(&format!("composite:shade={shade}")).expect("a shade");
            let mut renderer = renderer(gl, technique);
            for result in
                [renderer.overlay(&frame, Encoding::Linear), each_batch(&mut renderer, &frame, |_| {})]
            {
                let Err(Error::Refused { technique: "composite", refusal }) = result else {
                    panic!("{says}: {result:?}");
                };
                assert!(
                    refusal.part == part && refusal.reason.to_string().contains(says),
                    "{says}: {refusal:?}"
                );
            }
        }
        let physical = Technique::parse("composite:shade=physical:sphere=circle").expect("options");
        assert_eq!(physical, technique(Shade::Physical, SphereForm::Circle), "read");
        assert_eq!(physical.to_string(), "composite:shade=physical:sphere=circle", "written");
        let these_lights = [sun];
        let sunny = frame.lights(&these_lights);
        renderer(gl, physical)
            .overlay(&sunny, Encoding::Linear)
            .expect("physical shade takes any hard light");
        gl.assert_no_complaint("refusals");
    });
}

#[test]
fn the_host_finds_everything_as_it_was() {
    in_each_api(|gl| {
        let mut world = World::parse(SCENE);
        // Two batches.
        world.lights = (0..10).map(|i| Light::point(DVec3::new(f64::from(i), 5.0, 1.0), Vec3::ONE)).collect();
        let shot = Shot::new(gl, &world);
        let few = &world.lights[..3];
        let host = OddHost::new(gl, [VIEWPORT[2], VIEWPORT[3]]);
        let before_all = live(&gl.gl);
        let before = snapshot(gl);
        let check = |what: &str| {
            gl.assert_no_complaint(what);
            assert_same(&before, &snapshot(gl), what);
        };
        for shade in [Shade::Paper, Shade::Physical] {
            let mut renderer = renderer(gl, technique(shade, SphereForm::Tangent));
            check("set_technique");
            let receivers = floor(1);
            let frame = shot.frame().receivers(&receivers);
            let depth_only = bare(&frame.surface);
            let mut objects = Vec::new();
            // The kinds of surface compile in the first round.
            for _ in 0..3 {
                for frame in [frame.lights(few), frame.lights(few).surface(depth_only), frame] {
                    if shade == Shade::Paper || frame.lights.len() <= 8 {
                        renderer.overlay(&frame, Encoding::Gamma(2.2)).expect("the frame is right");
                        check("overlay");
                    }
                    each_batch(&mut renderer, &frame, |_| check("masks, in the host's closure"))
                        .expect("right");
                    check("masks");
                }
                objects.push(live(&gl.gl));
            }
            assert_eq!(objects[1], objects[2], "nothing is made after the first frames");
            drop(renderer);
            check("dropping the renderer");
        }
        assert_eq!(live(&gl.gl), before_all, "and nothing is left");
        host.calm_down(gl);
    });
}

/// Under the odd host's scissors, masks and discards the paint is the same to the bit, and its second
/// buffer is left alone.
#[test]
fn an_odd_host_gets_the_same_paint() {
    in_each_api(|gl| {
        let world = World::parse(SCENE);
        let shot = Shot::new(gl, &world);
        let receivers = floor(1);
        let frame = shot.frame().receivers(&receivers);
        let size = [VIEWPORT[2], VIEWPORT[3]];
        let [plain, odd] = [false, true].map(|is_odd| {
            let mut renderer = renderer(gl, Technique::parse("composite").expect("the defaults"));
            let host = if is_odd { Ok(OddHost::new(gl, size)) } else { Err(Canvas::white(gl, size, 2)) };
            renderer.overlay(&frame, Encoding::Gamma(2.2)).expect("the frame is right");
            let canvas = match host {
                Ok(odd) => odd.calm_down(gl),
                Err(canvas) => canvas,
            };
            [canvas.read(0), canvas.read(1)]
        });
        assert!(plain[0].iter().any(|texel| texel[0] < 255), "there is paint");
        assert!(odd[0] == plain[0], "the paint depends on the host's state");
        for [_, other] in [&plain, &odd] {
            assert!(other.iter().all(|texel| *texel == [255; 4]), "the second buffer is left alone");
        }
    });
}

#[test]
fn steady_frames_allocate_nothing() {
    in_each_api(|gl| {
        let world = World::parse(SCENE);
        let shot = Shot::new(gl, &world);
        let _canvas = Canvas::new(gl);
        let mut renderer = renderer(gl, Technique::parse("composite").expect("the defaults"));
        let frames: Vec<Vec<Light>> = (0..50)
            .map(|step| {
                let angle = DVec2::from_angle(f64::from(step) * 0.4) * 3.0;
                (0..10).map(|i| Light::point([angle.x, 3.0 + f64::from(i), angle.y], Vec3::ONE)).collect()
            })
            .collect();
        let mut draw = |lights: &[Light]| {
            let receivers = floor(1);
            let frame = shot.frame().lights(lights).receivers(&receivers);
            let counted = allocation_counter::measure(|| {
                renderer.overlay(&frame, Encoding::Linear).expect("the frame is right");
                each_batch(&mut renderer, &frame, |_| {}).expect("the frame is right");
            });
            counted.count_total
        };
        let first: u64 = frames.iter().map(|lights| draw(lights)).sum();
        assert!(first > 0, "the first frames allocate, and are seen to");
        let counts: Vec<u64> = frames.iter().map(|lights| draw(lights)).collect();
        assert!(counts.iter().all(|n| *n == 0), "allocations by frame {counts:?}");
        gl.assert_no_complaint("steady frames");
    });
}
