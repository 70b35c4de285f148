//! Lights with an area as collections of points: a guest as good as without.

use crate::context::{Gl, in_each_api};
use crate::leaks::live;
use crate::lights::many_lights;
use crate::odd_host::OddHost;
use crate::shot::{Canvas, Shot, VIEWPORT, read_texture};
use crate::snapshot::{assert_same, snapshot};
use crate::twins::{Random, on_gpu};
use crate::world::World;
use antumbra_gl::{
    Area, Encoding, Error, Frame, Light, MaskBatch, Renderer, Soft, Technique, Tier, sample_weight,
};
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

/// Near and far points, of either kind of light, above and below horizons.
#[test]
fn sample_weight_is_its_twin() {
    const SAMPLES: &str = include_str!("../../src/shaders/samples.glsl");
    in_each_api(|gl| {
        let mut random = Random::new();
        let (mut inputs, mut cpu) = (Vec::new(), Vec::new());
        for i in 0..10_000 {
            let [point, center, position] = [0; 3].map(|_| random.vector(8.0).as_vec3());
            let emitter = random.unit().as_vec3().extend((i % 2) as f32);
            let normal = random.unit().as_vec3();
            cpu.push(sample_weight(point, center, emitter, position, normal));
            let [a, b, c, d] = [point, center, position, normal].map(|v| v.extend(0.0));
            inputs.push([a, b, emitter, c, d]);
        }
        let body =
            "o_out = vec4(sample_weight(INPUT(0).xyz, INPUT(1).xyz, INPUT(2), INPUT(3).xyz, INPUT(4).xyz));";
        let Some(gpu) = on_gpu(gl, &[SAMPLES], body, &inputs) else { return };
        for ((gpu, cpu), input) in gpu.iter().zip(&cpu).zip(&inputs) {
            // A dozen roundings, and dot products whose terms cancel.
            assert!((gpu.x - cpu).abs() <= 4e-6 * (1.0 + cpu), "{} for {cpu}: {input:?}", gpu.x);
        }
        let lit = cpu.iter().filter(|weight| **weight > 0.0).count();
        assert!(lit > 2000 && lit < 8000, "some are lit: {lit}");
    });
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
    able.map(|technique| {
        let mut renderer = Renderer::new(gl.clone()).expect("a renderer");
        renderer.set_technique(technique).expect("the technique");
        renderer.set_soft(soft);
        renderer
    })
    .collect()
}

#[test]
fn sampling_leaves_the_state_as_it_was() {
    in_each_api(|gl| {
        let (few, many) = (area_lights(4), area_lights(11));
        let (shot, many_shot) = (Shot::new(gl, &few), Shot::new(gl, &many));
        let host = OddHost::new(gl, [VIEWPORT[2], VIEWPORT[3]]);
        let before = snapshot(gl);
        for frame in [shot.frame(), many_shot.frame()] {
            for mut renderer in renderers(&gl.gl, &frame, Soft::samples(5)) {
                let name = renderer.technique().name();
                if renderer.caps().tier == Tier::Es3 {
                    let refused = renderer.overlay(&frame, Encoding::Linear);
                    assert!(matches!(refused, Err(Error::Unsupported { .. })), "{name} needs float targets");
                } else {
                    renderer.overlay(&frame, Encoding::Linear).expect("the frame is right");
                    renderer.masks(&frame, |_| ()).expect("the frame is right");
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
    in_each_api(|gl| {
        let world = area_lights(3);
        let shot = Shot::new(gl, &world);
        let _canvas = Canvas::new(gl);
        let frame = shot.frame();
        let before = live(&gl.gl);
        let mut renderers = renderers(&gl.gl, &frame, Soft::samples(9));
        renderers.retain(|renderer| renderer.caps().tier != Tier::Es3);
        for renderer in &mut renderers {
            let mut draw = || {
                renderer.overlay(&frame, Encoding::Linear).expect("the frame is right");
                renderer.masks(&frame, |_| ()).expect("the frame is right");
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
                return read_texture(&gl.gl, texture, [width, height]);
            }
            let bytes: Vec<[u8; 4]> = read_texture(&gl.gl, texture, [width, height]);
            bytes.into_iter().map(|texel| texel.map(|v| f32::from(v) / 255.0)).collect()
        });
        for light in 0..batch.lights {
            masks.push(textures[light / 4].iter().map(|texel| texel[light % 4]).collect());
        }
    };
    renderer.masks(frame, read).expect("the frame is right");
    masks
}

/// Lights without area are drawn as without sampling, beside lights with one and alone; and the
/// renderer can change from one frame to the next.
#[test]
fn hard_lights_stay_as_they_are() {
    in_each_api(|gl| {
        let world = area_lights(8);
        let hard: Vec<Light> =
            world.lights.iter().map(|light| Light { area: Area::None, ..*light }).collect();
        let shot = Shot::new(gl, &world);
        let (mixed, hard) = (shot.frame(), Frame { lights: &hard, ..shot.frame() });
        for mut renderer in renderers(&gl.gl, &mixed, Soft::samples(3)) {
            if renderer.caps().tier == Tier::Es3 {
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
