//! Multisampled surfaces: every sample is a pixel of its own.

use crate::context::{Gl, in_each_api};
use crate::full_screen;
use crate::lights::{STEP, many_lights, overlay};
use crate::shot::{Shot, VIEWPORT, each_batch, known, read_texture, texture};
use crate::world::World;
use antumbra_gl::{Camera, DepthFormat, Encoding, NormalSpace, Normals, Renderer, Surface, Technique};
use glam::{DMat4, DVec3, Vec4};
use glow::HasContext;
use std::cell::Cell;

pub(crate) const SAMPLES: i32 = 4;
pub(crate) const SIZE: [i32; 2] = [VIEWPORT[2], VIEWPORT[3]];

const HEADER: &str = "#extension GL_ARB_sample_shading : require\n";

/// One triangle over the whole of `target`, of this program's fragment shader, with textures on units
/// from 0 on.
fn draw(
    gl: &Gl,
    fragment: &str,
    target: glow::Framebuffer,
    size: [i32; 2],
    textures: &[(u32, glow::Texture)],
    sample: i32,
) {
    let context = &gl.gl;
    // SAFETY: objects are made, used and deleted in this context.
    unsafe {
        let program = full_screen::program(context, fragment);
        context.use_program(Some(program));
        for (unit, &(kind, texture)) in textures.iter().enumerate() {
            context.active_texture(glow::TEXTURE0 + unit as u32);
            context.bind_texture(kind, Some(texture));
            context.uniform_1_i32(
                context.get_uniform_location(program, &format!("u_{unit}")).as_ref(),
                unit as i32,
            );
        }
        context.active_texture(glow::TEXTURE0);
        context.uniform_1_i32(context.get_uniform_location(program, "u_sample").as_ref(), sample);
        context.enable(glow::DEPTH_TEST);
        context.depth_func(glow::ALWAYS);
        full_screen::draw(context, target, size);
        context.disable(glow::DEPTH_TEST);
        context.use_program(None);
        context.delete_program(program);
    }
}

/// Multisampled textures of these formats on a framebuffer; a depth format comes last.
pub(crate) fn multisampled(
    gl: &Gl,
    size: [i32; 2],
    formats: &[u32],
) -> (Vec<glow::Texture>, glow::Framebuffer) {
    let kind = glow::TEXTURE_2D_MULTISAMPLE;
    // SAFETY: fresh objects in this context.
    unsafe {
        let framebuffer = gl.gl.create_framebuffer().expect("a framebuffer");
        gl.gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
        let mut colors = Vec::new();
        let textures = formats.iter().map(|&format| {
            let texture = gl.gl.create_texture().expect("a texture");
            gl.gl.bind_texture(kind, Some(texture));
            gl.gl.tex_image_2d_multisample(kind, SAMPLES, format as i32, size[0], size[1], true);
            gl.gl.bind_texture(kind, None);
            let slot = if format == glow::DEPTH_COMPONENT32F {
                glow::DEPTH_ATTACHMENT
            } else {
                colors.push(glow::COLOR_ATTACHMENT0 + colors.len() as u32);
                colors[colors.len() - 1]
            };
            gl.gl.framebuffer_texture_2d(glow::FRAMEBUFFER, slot, kind, Some(texture), 0);
            texture
        });
        let textures = textures.collect();
        gl.gl.draw_buffers(&colors);
        let status = gl.gl.check_framebuffer_status(glow::FRAMEBUFFER);
        assert_eq!(status, glow::FRAMEBUFFER_COMPLETE, "a multisampled framebuffer");
        (textures, framebuffer)
    }
}

/// One sample of every pixel of a colour texture.
pub(crate) fn read_sample(gl: &Gl, source: glow::Texture, size: [i32; 2], sample: i32) -> Vec<Vec4> {
    let float = [glow::RGBA32F, glow::RGBA, glow::FLOAT];
    let target = texture(&gl.gl, size, float, &vec![Vec4::NAN; (size[0] * size[1]) as usize]);
    let fragment = "uniform sampler2DMS u_0; uniform int u_sample; out vec4 o;\n\
                    void main() { o = texelFetch(u_0, ivec2(gl_FragCoord.xy), u_sample); }";
    // SAFETY: fresh objects in this context, deleted again.
    unsafe {
        let framebuffer = full_screen::framebuffer(&gl.gl, target);
        draw(gl, fragment, framebuffer, size, &[(glow::TEXTURE_2D_MULTISAMPLE, source)], sample);
        let texels = read_texture(&gl.gl, target, size);
        gl.gl.delete_framebuffer(framebuffer);
        gl.gl.delete_texture(target);
        texels
    }
}

/// Where this driver's samples are, in pixels.
pub(crate) fn sample_positions(gl: &Gl) -> Vec<[f64; 2]> {
    let (textures, framebuffer) = multisampled(gl, [1, 1], &[glow::RGBA32F]);
    let fragment = format!("{HEADER}out vec4 o; void main() {{ o = vec4(gl_SamplePosition, 0.0, 1.0); }}");
    draw(gl, &fragment, framebuffer, [1, 1], &[], 0);
    (0..SAMPLES)
        .map(|sample| {
            let p = read_sample(gl, textures[0], [1, 1], sample)[0];
            [p.x.into(), p.y.into()]
        })
        .collect()
}

/// What a multisampling host has drawn: the same as one shot for each sample.
pub(crate) fn surface(gl: &Gl, shots: &[Shot<'_>]) -> Surface {
    let formats = [glow::RGBA32F, glow::R32UI, glow::DEPTH_COMPONENT32F];
    let (textures, framebuffer) = multisampled(gl, SIZE, &formats);
    // A sample a texture: of each shot its depth, normals and ids.
    let samplers: String = (0..shots.len())
        .map(|i| {
            format!(
                "uniform sampler2D u_{}; uniform sampler2D u_{}; uniform usampler2D u_{};\n",
                3 * i,
                3 * i + 1,
                3 * i + 2
            )
        })
        .collect();
    let cases: String = (0..shots.len())
        .map(|i| {
            let fetch = |unit: usize| format!("texelFetch(u_{unit}, p, 0)");
            format!(
                "if (gl_SampleID == {i}) {{ gl_FragDepth = {}.x; o_normal = {}; o_id = {}.x; }}\n",
                fetch(3 * i),
                fetch(3 * i + 1),
                fetch(3 * i + 2)
            )
        })
        .collect();
    let fragment = format!(
        "{HEADER}{samplers}layout(location = 0) out vec4 o_normal;\nlayout(location = 1) out uint o_id;\n\
         void main() {{ ivec2 p = ivec2(gl_FragCoord.xy); gl_FragDepth = 0.0; {cases} }}"
    );
    let inputs: Vec<_> =
        shots.iter().flat_map(|s| [s.depth, s.normals, s.ids]).map(|t| (glow::TEXTURE_2D, t)).collect();
    draw(gl, &fragment, framebuffer, SIZE, &inputs, 0);
    Surface::from_depth(known(textures[2]))
        .with_samples(SAMPLES as u32)
        .with_normals(Normals::new(known(textures[0]), NormalSpace::View))
        .with_ids(known(textures[1]))
}

/// The camera whose pixel centres are this one's samples.
pub(crate) fn shifted(camera: &Camera, [x, y]: [f64; 2]) -> Camera {
    let pixel = DVec3::new(2.0 / f64::from(SIZE[0]), 2.0 / f64::from(SIZE[1]), 0.0);
    let shift = DMat4::from_translation(pixel * DVec3::new(0.5 - x, 0.5 - y, 0.0));
    Camera::new(camera.view, shift * camera.projection)
}

/// A host that makes coverage of alpha, and alpha one: both act on multisampled targets alone.
fn alpha_switches(gl: &Gl, on: bool) {
    for switch in [glow::SAMPLE_ALPHA_TO_ONE, glow::SAMPLE_ALPHA_TO_COVERAGE] {
        // SAFETY: switches of OpenGL.
        unsafe { if on { gl.gl.enable(switch) } else { gl.gl.disable(switch) } };
    }
}

#[test]
fn every_sample_has_its_own_shadows() {
    in_each_api(|gl| {
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        if renderer.caps().max_samples < SAMPLES as u32 {
            assert!(!gl.is_desktop(), "OpenGL has samples: {:?}", renderer.caps());
            return; // a refusal has a test of its own
        }
        // Four lights: the last one's mask is the alpha channel.
        let world = many_lights(4);
        let camera = world.camera(VIEWPORT);
        let shots: Vec<Shot<'_>> = sample_positions(gl)
            .into_iter()
            .map(|at| Shot::with(gl, &world, shifted(&camera, at), VIEWPORT, DepthFormat::default()))
            .collect();
        let frame = shots[0].frame().camera(camera).surface(surface(gl, &shots));
        gl.assert_no_complaint("the host's drawing");
        // In all the kinds of surface that are told apart when compiling.
        let mut depth_only = frame;
        (depth_only.surface.normals, depth_only.surface.ids) = (None, None);
        each_batch(&mut renderer, &depth_only, |_| {}).expect("the frame is right");
        gl.assert_no_complaint("depth alone");
        let drawn = Cell::new(None);
        alpha_switches(gl, true);
        each_batch(&mut renderer, &frame, |batch| drawn.set(Some(batch.textures)))
            .expect("the frame is right");
        alpha_switches(gl, false);
        gl.assert_no_complaint("masks");
        let textures = drawn.take().expect("one batch");
        for (sample, shot) in shots.iter().enumerate() {
            let mut truth = world.truth(shot);
            truth.footprint = 0.5; // of four samples
            let texels = read_sample(gl, textures[0].glow(), SIZE, sample as i32);
            for light in 0..world.lights.len() {
                let mask: Vec<u8> = texels.iter().map(|t| (t[light] * 255.0).round() as u8).collect();
                truth.assert_mask(light, &mask);
            }
        }
        for counting in ["per-volume", "depth-fail"] {
            let technique = Technique::parse(&format!("volume:counting={counting}")).expect("a technique");
            renderer.set_technique(technique).expect("a technique");
            each_batch(&mut renderer, &frame, |batch| drawn.set(Some(batch.textures)))
                .expect("the frame is right");
            gl.assert_no_complaint("masks");
            let textures = drawn.take().expect("one batch");
            for (sample, shot) in shots.iter().enumerate() {
                let texels = read_sample(gl, textures[0].glow(), SIZE, sample as i32);
                for light in 0..world.lights.len() {
                    let mask: Vec<u8> = texels.iter().map(|t| (t[light] * 255.0).round() as u8).collect();
                    let what = format!("{technique}, sample {sample}");
                    let judged = world.truth(shot).assert_classified(light, &mask, &what);
                    assert!(judged * 2 > mask.len(), "{what}: {judged} pixels are judged");
                }
            }
        }
        renderer.set_technique(Technique::default()).expect("a technique");
        let (colors, canvas) = multisampled(gl, SIZE, &[glow::RGBA8]);
        // SAFETY: clears the bound framebuffer.
        unsafe { gl.gl.clear_buffer_f32_slice(glow::COLOR, 0, &[1.0; 4]) };
        gl.bind(canvas);
        alpha_switches(gl, true);
        renderer.overlay(&frame, Encoding::Linear).expect("the frame is right");
        gl.assert_no_complaint("the overlay");
        alpha_switches(gl, false);
        let mut resolved = vec![Vec4::ZERO; shots[0].seen.len()];
        for (sample, shot) in shots.iter().enumerate() {
            let texels = read_sample(gl, colors[0], SIZE, sample as i32);
            resolved.iter_mut().zip(&texels).for_each(|(sum, t)| *sum += *t / SAMPLES as f32);
            let bytes: Vec<[u8; 4]> =
                texels.iter().map(|t| t.to_array().map(|c| (c * 255.0).round() as u8)).collect();
            world.truth(shot).assert_overlay(&bytes, STEP);
        }
        compare_with_a_larger_picture(gl, &mut renderer, &world, &resolved);
    });
}

/// Four samples a pixel against sixteen: the mean difference is a step of 8 bits, and few pixels are
/// off by more than a sample.
fn compare_with_a_larger_picture(gl: &Gl, renderer: &mut Renderer, world: &World, resolved: &[Vec4]) {
    let offsets = (0..16).map(|i| [(f64::from(i % 4) + 0.5) / 4.0, (f64::from(i / 4) + 0.5) / 4.0]);
    let camera = world.camera(VIEWPORT);
    let mut sum = vec![Vec4::ZERO; resolved.len()];
    for at in offsets {
        let shot = Shot::with(gl, world, shifted(&camera, at), VIEWPORT, DepthFormat::default());
        let picture = overlay(gl, renderer, &shot.frame(), Encoding::Linear);
        for (sum, texel) in sum.iter_mut().zip(&picture) {
            *sum += Vec4::from_array(texel.map(f32::from)) / (255.0 * 16.0);
        }
    }
    let off: Vec<f32> = sum.iter().zip(resolved).map(|(a, b)| (*a - *b).abs().max_element()).collect();
    let mean = off.iter().sum::<f32>() / off.len() as f32;
    let far = off.iter().filter(|&&d| d > 0.25).count();
    eprintln!("mean difference {mean}, {far} of {} off by more than a sample", off.len());
    assert!(mean < 1.0 / 255.0, "mean difference {mean}");
    assert!(far <= off.len() / 1000, "{far} of {} are off by more than a sample", off.len());
}
