//! Shadow maps as guests: nonsense, odd hosts, and what they make and leave behind.

use crate::context::{in_each_api, in_each_tier};
use crate::leaks::live;
use crate::lights::many_lights;
use crate::map::{FLOOR, dark, renderer};
use crate::odd_host::OddHost;
use crate::shot::{Canvas, Shot, VIEWPORT, each_batch};
use crate::snapshot::{assert_same, snapshot};
use crate::world::World;
use antumbra_gl::{Area, Encoding, Light, MeshOccluder, Occluder};
use antumbra_math::{Light as Place, TriangleMesh};
use glam::{DMat4, DVec3, Vec3};
use glow::HasContext;
use std::sync::Arc;

/// Casters without extent, and lights that are nowhere, change nothing for the others.
#[test]
fn nonsense_is_left_out() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let mut renderer = renderer(gl, "map");
        let alone = shot.masks(&mut renderer, &shot.frame());
        let bad = crate::occluders::nonsense();
        for occluder in &bad {
            let frame = shot.frame().occluders(std::slice::from_ref(occluder));
            let masks = shot.masks(&mut renderer, &frame);
            assert!(masks.iter().flatten().all(|&m| m == 255), "{occluder:?} casts a shadow");
        }
        let mut all = bad;
        all.extend(&world.occluders);
        let among = shot.masks(&mut renderer, &shot.frame().occluders(&all));
        assert!(among == alone, "the shadows of the others change");
        for bad in [f64::NAN, f64::INFINITY, 1e300] {
            let at = DVec3::new(0.0, bad, 0.0);
            let mut lights = vec![
                Light::point(at, Vec3::ONE),
                Light::directional(DVec3::ZERO, Vec3::ONE),
                Light::spot(at, DVec3::Y, 0.1, 0.2, Vec3::ONE),
                Light::spot(DVec3::Y, DVec3::ZERO, 0.0, 0.0, Vec3::ONE),
            ];
            lights.extend(&world.lights);
            let masks = shot.masks(&mut renderer, &shot.frame().lights(&lights));
            assert!(masks[4..] == alone[..], "the masks of the others change");
            assert!(masks[..4].iter().flatten().all(|&m| m == 255), "what is nowhere casts nothing");
            gl.assert_no_complaint("lights that are nowhere");
        }
        // Far too small and far too large.
        for size in [1e-30, 1e-9, 1e9, 1e30] {
            let occluders = [Occluder::sphere(DVec3::Y, size), Occluder::disc(DVec3::Y, DVec3::Y, size)];
            let _ = shot.masks(&mut renderer, &shot.frame().occluders(&occluders));
            gl.assert_no_complaint("extreme sizes");
        }
    });
}

/// Depth in a map does not depend on the host's own: its range, its clamping, its test.
#[test]
fn the_hosts_depth_state_does_not_matter() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let mut renderer = renderer(gl, "map");
        let plain = shot.masks(&mut renderer, &shot.frame());
        // SAFETY: plain settings, put back below.
        unsafe {
            gl.gl.depth_range_f32(0.7, 0.2);
            gl.gl.depth_func(glow::NEVER);
            gl.gl.depth_mask(false);
            gl.gl.enable(glow::SCISSOR_TEST);
            gl.gl.scissor(3, 4, 5, 6);
            if gl.is_desktop() {
                gl.gl.enable(glow::DEPTH_CLAMP);
            }
        }
        let odd = shot.masks(&mut renderer, &shot.frame());
        // SAFETY: as above.
        unsafe {
            gl.gl.depth_range_f32(0.0, 1.0);
            gl.gl.disable(glow::SCISSOR_TEST);
            gl.gl.depth_mask(true);
            if gl.is_desktop() {
                gl.gl.disable(glow::DEPTH_CLAMP);
            }
        }
        assert!(odd == plain, "the masks depend on the host's depth state");
    });
}

/// With everything bound and every switch the other way round the picture is the same, and so is the state afterwards.
#[test]
fn an_odd_host_is_left_as_it_was() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let size = [VIEWPORT[2], VIEWPORT[3]];
        let canvas = Canvas::new(gl);
        let mut renderer = renderer(gl, "map:size=256");
        renderer.overlay(&shot.frame(), Encoding::Linear).expect("the frame is right");
        let plain = canvas.read(0);
        let host = OddHost::new(gl, size);
        let before = snapshot(gl);
        renderer.overlay(&shot.frame(), Encoding::Linear).expect("the frame is right");
        assert_same(&before, &snapshot(gl), "an overlay with maps");
        gl.assert_no_complaint("an odd host");
        assert!(host.calm_down(gl).read(0) == plain, "the picture depends on the host's state");
    });
}

/// Meshes of the host's own cast, and are forgotten some time after the host has stopped using them.
#[test]
fn meshes_cast_and_are_let_go() {
    in_each_api(|gl| {
        let world = World::parse(FLOOR);
        let shot = Shot::new(gl, &world);
        let mut renderer = renderer(gl, "map");
        let empty = shot.frame().occluders(&[]);
        shot.masks(&mut renderer, &empty);
        let torus = Arc::new(TriangleMesh::torus(0.8, 0.2, 32).expect("a torus"));
        let stretch = DMat4::from_scale(DVec3::new(1.5, 1.0, -1.0));
        let meshes = [MeshOccluder::new(torus, DMat4::from_translation(DVec3::Y) * stretch).with_id(5)];
        let mask = &shot.masks(&mut renderer, &empty.meshes(&meshes))[0];
        let (dark, _) = dark(&shot, mask);
        // The lamp is straight above the middle: its light falls through the hole.
        let middle = mask[(VIEWPORT[3] / 2 * VIEWPORT[2] + VIEWPORT[2] / 2) as usize];
        assert!(dark > 300 && middle == 255, "{dark} pixels are dark, the middle is {middle}");
        let with = live(&gl.gl);
        for _ in 0..70 {
            each_batch(&mut renderer, &empty, |_| {}).expect("the frame is right");
        }
        let without = live(&gl.gl);
        assert_eq!((with[1] - without[1], with[3] - without[3]), (2, 1), "two buffers and a vertex array go");
    });
}

/// A frame like the one before allocates nothing and makes no objects, whatever moves; and a renderer takes everything
/// with it.
#[test]
fn a_steady_frame_makes_nothing() {
    in_each_tier(|gl| {
        let world = many_lights(9);
        let shot = Shot::new(gl, &world);
        let _canvas = Canvas::new(gl);
        let before = live(&gl.gl);
        for technique in ["map:size=128", "map:size=128:filter=pcss"] {
            let mut renderer = renderer(gl, technique);
            let soft = technique.ends_with("pcss");
            let lights = |step: usize| -> Vec<Light> {
                let moved = |light: &Light| {
                    let position = light.place.homogeneous().truncate();
                    let at = position + DVec3::new((step as f64 * 0.7).sin(), 0.1, (step as f64 * 0.9).cos());
                    let moved = light.with_place(Place::Point { position: at });
                    if soft { moved.with_area(Area::Sphere { radius: 0.1 }) } else { moved }
                };
                world.lights.iter().map(moved).chain([world.lights[0]]).collect()
            };
            let steps: Vec<Vec<Light>> = (0..8).map(lights).collect();
            let float = gl.has_floats();
            let mut draw = |lights: &[Light]| {
                let frame = shot.frame().lights(lights);
                let counted = allocation_counter::measure(|| {
                    if float {
                        renderer.overlay(&frame, Encoding::Linear).expect("the frame is right");
                    }
                    each_batch(&mut renderer, &frame, |_| {}).expect("the frame is right");
                });
                counted.count_total
            };
            steps.iter().for_each(|lights| _ = draw(lights));
            let objects = live(&gl.gl);
            let counts: Vec<u64> = steps.iter().map(|lights| draw(lights)).collect();
            assert!(counts.iter().all(|&n| n == 0), "{technique}: allocations by frame {counts:?}");
            assert_eq!(live(&gl.gl), objects, "{technique}: OpenGL objects");
        }
        assert_eq!(live(&gl.gl), before, "a renderer takes its objects with it");
        gl.assert_no_complaint("steady frames");
    });
}
