//! Lights with an area as collections of points: a guest as good as without.

use crate::context::{Gl, in_each_tier};
use crate::leaks::live;
use crate::lights::many_lights;
use crate::odd_host::OddHost;
use crate::shot::{Canvas, Shot, VIEWPORT, assert_needs_floats, each_batch, read_texture};
use crate::snapshot::{assert_same, snapshot};
use crate::world::World;
use antumbra_gl::{Area, Encoding, Frame, Light, MaskBatch, Renderer, Soft, Technique};
use antumbra_math::Light as Place;
use glam::DVec3;

/// Many lights, two of three of those at a point with an area of each kind in turn.
pub(crate) fn area_lights(count: usize) -> World {
    let mut world = many_lights(count);
    let points = world.lights.iter_mut().filter(|light| matches!(light.place, Place::Point { .. }));
    for (i, light) in points.enumerate() {
        light.area = match i % 4 {
            0 => Area::Sphere { radius: 0.3 },
            1 => Area::Disc { direction: DVec3::NEG_Y, radius: 0.4 },
            2 => Area::Rectangle {
                direction: DVec3::NEG_Y,
                half_right: DVec3::X * 0.3,
                half_up: DVec3::Z * 0.2,
            },
            _ => Area::None,
        };
    }
    world
}

/// The techniques that can sample the lights of a frame, with a renderer for each.
fn renderers(gl: &std::sync::Arc<glow::Context>, frame: &Frame<'_>, soft: Soft) -> Vec<Renderer> {
    let physical = Technique::all().map(|mut technique| {
        if technique.paints() {
            technique.set("shade", "physical").expect("an option of techniques that paint");
        }
        technique
    });
    let able = physical.filter(|technique| technique.refusal_with(soft, &frame.scenery()).is_none());
    let renderers = able.map(|technique| {
        let mut renderer = Renderer::new(gl.clone()).expect("a renderer");
        renderer.set_technique(technique).expect("the technique");
        renderer.set_soft(soft);
        renderer
    });
    let renderers: Vec<Renderer> = renderers.collect();
    let names: Vec<&str> = renderers.iter().map(|renderer| renderer.technique().name()).collect();
    assert_eq!(names, ["analytic", "projected", "volume", "map"], "all that need no single plane");
    renderers
}

#[test]
fn sampling_leaves_the_state_as_it_was() {
    in_each_tier(|gl| {
        let (few, many) = (area_lights(4), area_lights(11));
        let (shot, many_shot) = (Shot::new(gl, &few), Shot::new(gl, &many));
        let host = OddHost::new(gl, [VIEWPORT[2], VIEWPORT[3]]);
        let before = snapshot(gl);
        for frame in [shot.frame(), many_shot.frame()] {
            for mut renderer in renderers(&gl.gl, &frame, Soft::samples(5)) {
                let name = renderer.technique().name();
                if !gl.has_floats() {
                    assert_needs_floats(&mut renderer, &frame);
                } else {
                    renderer.overlay(&frame, Encoding::Linear).expect("the frame is right");
                    each_batch(&mut renderer, &frame, |_| ()).expect("the frame is right");
                }
                gl.assert_no_complaint(name);
                assert_same(&before, &snapshot(gl), name);
            }
        }
        host.calm_down(gl);
    });
}

/// Objects are deleted with the renderer; a frame like the one before makes none and allocates nothing.
#[test]
fn steady_frames_of_sampled_lights_allocate_nothing() {
    in_each_tier(|gl| {
        let world = area_lights(3);
        let shot = Shot::new(gl, &world);
        let _canvas = Canvas::new(gl);
        let frame = shot.frame();
        let before = live(&gl.gl);
        let mut renderers = renderers(&gl.gl, &frame, Soft::samples(9));
        if !gl.has_floats() {
            renderers.iter_mut().for_each(|renderer| assert_needs_floats(renderer, &frame));
            renderers.clear();
        }
        for renderer in &mut renderers {
            let mut draw = || {
                renderer.overlay(&frame, Encoding::Linear).expect("the frame is right");
                each_batch(renderer, &frame, |_| ()).expect("the frame is right");
            };
            draw();
            draw();
            let steady = live(&gl.gl);
            let counted = allocation_counter::measure(|| (0..2).for_each(|_| draw()));
            assert_eq!(live(&gl.gl), steady, "OpenGL objects");
            assert_eq!(counted.count_total, 0, "{}: allocations", renderer.technique());
        }
        drop(renderers);
        assert_eq!(live(&gl.gl), before, "all are gone with the renderers");
        gl.assert_no_complaint("steady frames");
    });
}

/// Masks of all lights, whatever the format: on OpenGL ES floats cannot be read as bytes, nor the reverse.
fn masks(gl: &Gl, renderer: &mut Renderer, frame: &Frame<'_>) -> Vec<Vec<f32>> {
    let [_, _, width, height] = frame.viewport;
    let soft = renderer.soft() != Soft::Native && frame.lights.iter().any(|light| light.area != Area::None);
    let mut masks = Vec::new();
    let read = |batch: &MaskBatch| {
        let textures = batch.textures.map(|texture| -> Vec<[f32; 4]> {
            if soft {
                return read_texture(&gl.gl, texture.glow(), [width, height]);
            }
            let bytes: Vec<[u8; 4]> = read_texture(&gl.gl, texture.glow(), [width, height]);
            bytes.into_iter().map(|texel| texel.map(|v| f32::from(v) / 255.0)).collect()
        });
        for light in 0..batch.lights {
            masks.push(textures[light / 4].iter().map(|texel| texel[light % 4]).collect());
        }
    };
    each_batch(renderer, frame, read).expect("the frame is right");
    masks
}

/// Lights without area are drawn as without sampling, beside lights with one and alone; and the
/// renderer can change from one frame to the next.
#[test]
fn hard_lights_stay_as_they_are() {
    in_each_tier(|gl| {
        let world = area_lights(8);
        let hard: Vec<Light> = world.lights.iter().map(|light| light.with_area(Area::None)).collect();
        let shot = Shot::new(gl, &world);
        let (mixed, hard) = (shot.frame(), shot.frame().lights(&hard));
        for mut renderer in renderers(&gl.gl, &mixed, Soft::samples(3)) {
            if !gl.has_floats() {
                assert_needs_floats(&mut renderer, &mixed);
                continue;
            }
            let expected = masks(gl, &mut renderer, &hard);
            renderer.set_soft(Soft::Native);
            assert_eq!(masks(gl, &mut renderer, &hard), expected, "without areas there is nothing to sample");
            renderer.set_soft(Soft::samples(3));
            let found = masks(gl, &mut renderer, &mixed);
            let mut changed = 0;
            for (i, light) in world.lights.iter().enumerate() {
                if light.area == Area::None {
                    // Half floats for bytes: half a step of each.
                    let worst =
                        found[i].iter().zip(&expected[i]).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
                    assert!(found[i].iter().all(|m| m.is_finite()), "{}: numbers", renderer.technique());
                    assert!(worst < 0.5 / 255.0 + 5e-4, "{}: light {i}: {worst}", renderer.technique());
                } else {
                    changed += usize::from(found[i] != expected[i]);
                }
            }
            assert!(changed > 0, "areas are seen");
        }
        gl.assert_no_complaint("mixed lights");
    });
}
