//! A guest leaves everything as it was and is not disturbed by what it finds.

use crate::context::{Gl, in_each_api, in_each_tier};
use crate::lights::many_lights;
use crate::odd_host::OddHost;
use crate::shot::{Canvas, Shot, VIEWPORT, each_batch, known};
use crate::snapshot::{assert_same, has_indexed_switches, snapshot};
use antumbra_gl::{DepthFormat, Encoding, Error, Frame, Image, Renderer, Surface, Technique};
use glam::DMat4;
use glow::HasContext;

const SIZE: [i32; 2] = [VIEWPORT[2], VIEWPORT[3]];

/// The odd host is odd: nearly everything that is read is not what a fresh context has.
#[test]
fn an_odd_host_differs_from_a_fresh_context() {
    in_each_api(|gl| {
        let fresh = snapshot(gl);
        let odd_host = OddHost::new(gl, SIZE);
        let odd = snapshot(gl);
        let same: Vec<&str> =
            fresh.iter().zip(&odd).filter(|(a, b)| a == b).map(|(a, _)| a.0.as_str()).collect();
        // Widths of lines are 1 or an error, references are of a stencil buffer; the rest has no
        // other value or is not set by `OddHost`.
        let expected = |name: &str| {
            ["LINE_WIDTH", "LOGIC_OP_MODE", "FRAMEBUFFER_SRGB", "READ_BUFFER"].contains(&name)
                || name.starts_with("DRAW_BUFFER")
                || name.ends_with("_REF")
                || name.starts_with("VERTEX_ATTRIB")
                || name.contains("of buffer")
        };
        let surprises: Vec<_> = same.into_iter().filter(|name| !expected(name)).collect();
        assert!(surprises.is_empty(), "these are as in a fresh context: {surprises:?}");
        gl.assert_no_complaint("the odd settings");
        odd_host.calm_down(gl);
    });
}

#[test]
fn every_call_leaves_the_state_as_it_was() {
    in_each_tier(|gl| {
        let (few, many) = (many_lights(3), many_lights(20));
        let (shot, many_shot) = (Shot::new(gl, &few), Shot::new(gl, &many));
        let host = OddHost::new(gl, SIZE);
        let before = snapshot(gl);
        let check = |what: &str| {
            gl.assert_no_complaint(what);
            assert_same(&before, &snapshot(gl), what);
        };
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        check("Renderer::new");
        for technique in Shot::able(&shot.frame()) {
            eprintln!("{technique}");
            renderer.set_technique(technique).expect("a technique");
            check("set_technique");
            renderer.warm_up(&shot.frame().surface, &[]).expect("shaders");
            check("warm_up");
            let float = gl.has_floats();
            for frame in [shot.frame(), many_shot.frame(), depth_only(&shot)] {
                if float || frame.lights.len() <= 8 {
                    renderer.overlay(&frame, Encoding::Linear).expect("the frame is right");
                    check("overlay");
                    renderer.overlay(&frame, Encoding::Gamma(2.2)).expect("the frame is right");
                    check("overlay in gamma");
                }
                let mut batches = renderer.masks(&frame).expect("the frame is right");
                check("the first masks");
                while batches.next().expect("memory").is_some() {
                    check("a batch of masks");
                }
                check("masks");
            }
            for (what, frame) in bad_frames(&shot, &host.canvas) {
                renderer.overlay(&frame, Encoding::Linear).expect_err(what);
                check(what);
                let _ = each_batch(&mut renderer, &frame, |_| {});
                check(what);
            }
        }
        drop(renderer);
        check("dropping the renderer");
        host.calm_down(gl);
    });
}

fn depth_only<'w>(shot: &Shot<'w>) -> Frame<'w> {
    let frame = shot.frame();
    frame.surface(Surface::from_depth(known(shot.depth)).with_format(DepthFormat::default()))
}

/// Frames that are refused before and after the state has been touched.
fn bad_frames<'w>(shot: &Shot<'w>, canvas: &Canvas) -> Vec<(&'static str, Frame<'w>)> {
    let frame = shot.frame();
    let mut nan = frame;
    nan.camera.view = DMat4::NAN;
    let attached = Surface::from_depth(known(canvas.colors[0]));
    let too_many_samples = frame.surface.with_samples(1 << 20);
    vec![
        ("a bad camera", nan),
        ("an attached surface", frame.surface(attached)),
        ("too many samples", frame.surface(too_many_samples)),
    ]
}

/// A shadowed buffer, the one beside it, and the masks of the last batch.
struct Drawn {
    picture: Vec<[u8; 4]>,
    other: Vec<[u8; 4]>,
    masks: Vec<Vec<u8>>,
}

/// Draws twice, and the masks once, in a calm context or in an odd one.
fn draw_under(gl: &Gl, technique: Technique, odd: bool, count: usize) -> Drawn {
    let world = many_lights(count);
    let shot = Shot::new(gl, &world);
    let mut masks = Vec::new();
    let host = if odd { Ok(OddHost::new(gl, SIZE)) } else { Err(Canvas::white(gl, SIZE, 2)) };
    let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
    renderer.set_technique(technique).expect("a technique");
    renderer.overlay(&shot.frame(), Encoding::Linear).expect("the frame is right");
    // The overlay's second frame goes through everything that the first one set up.
    renderer.overlay(&shot.frame(), Encoding::Linear).expect("the frame is right");
    if odd {
        each_batch(&mut renderer, &shot.frame(), |_| {}).expect("the frame is right");
    }
    let canvas = match host {
        Ok(odd) => odd.calm_down(gl),
        Err(canvas) => canvas,
    };
    if odd {
        // Masks stay what they are until the next call: read what the odd state has let through.
        let mut textures = Vec::new();
        let host = OddHost::new(gl, SIZE);
        each_batch(&mut renderer, &shot.frame(), |batch| textures.push((batch.textures, batch.lights)))
            .expect("right");
        host.calm_down(gl);
        let (textures, lights) = textures.pop().expect("a batch");
        for light in 0..lights {
            let texels = crate::shot::read_texture::<[u8; 4]>(&gl.gl, textures[light / 4].glow(), SIZE);
            masks.push(texels.iter().map(|t| t[light % 4]).collect());
        }
    } else {
        masks = shot.masks(&mut renderer, &shot.frame());
        masks.drain(..count.saturating_sub(1) / 8 * 8);
    }
    gl.assert_no_complaint("drawing");
    Drawn { picture: canvas.read(0), other: canvas.read(1), masks }
}

/// With scissors, stencil, discard, masks, samplers, lines for polygons and the rest in the way,
/// the picture is the same to the bit.
#[test]
fn an_odd_host_gets_the_same_picture() {
    in_each_tier(|gl| {
        let able = Shot::able(&Shot::new(gl, &many_lights(3)).frame());
        let counts = if gl.has_floats() { &[3, 20][..] } else { &[3] };
        for (technique, count) in able.iter().flat_map(|t| counts.iter().map(move |count| (*t, count))) {
            let [plain, odd] = [false, true].map(|odd| draw_under(gl, technique, odd, *count));
            assert!(plain.picture.iter().any(|texel| texel[0] < 200), "there are shadows");
            for drawn in [&plain, &odd] {
                assert!(
                    drawn.other.iter().all(|texel| *texel == [255; 4]),
                    "the second buffer is left alone"
                );
            }
            assert!(
                odd.picture == plain.picture,
                "{technique}, {count} lights: the picture depends on the host's state"
            );
            assert!(
                odd.masks == plain.masks,
                "{technique}, {count} lights: the masks depend on the host's state"
            );
        }
    });
}

/// Masks of colour of the second buffer cannot be asked for one by one: clearing shows them.
#[test]
fn the_colour_mask_of_another_buffer_stays() {
    in_each_api(|gl| {
        if !has_indexed_switches(gl) {
            return;
        }
        let world = many_lights(3);
        let shot = Shot::new(gl, &world);
        let host = OddHost::new(gl, SIZE);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        renderer.overlay(&shot.frame(), Encoding::Linear).expect("the frame is right");
        each_batch(&mut renderer, &shot.frame(), |_| {}).expect("the frame is right");
        // SAFETY: clears a buffer of the bound framebuffer.
        unsafe {
            gl.gl.disable(glow::RASTERIZER_DISCARD);
            gl.gl.disable(glow::SCISSOR_TEST);
            gl.gl.clear_buffer_f32_slice(glow::COLOR, 1, &[0.0; 4]);
        }
        let canvas = host.calm_down(gl);
        assert!(
            canvas.read(1).iter().all(|t| *t == [0, 255, 0, 255]),
            "red and blue alone are written: {:?}",
            canvas.read(1)[0]
        );
    });
}

/// What is attached is named, and nothing is drawn.
#[test]
fn a_surface_that_is_drawn_to_is_refused() {
    in_each_api(|gl| {
        let world = many_lights(3);
        let shot = Shot::new(gl, &world);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let canvas = Canvas::white(gl, SIZE, 2);
        let frame = shot.frame();
        // SAFETY: attaches textures of the framebuffer's size.
        unsafe {
            gl.gl.framebuffer_texture_2d(
                glow::FRAMEBUFFER,
                glow::DEPTH_ATTACHMENT,
                glow::TEXTURE_2D,
                Some(shot.depth),
                0,
            );
        }
        let refused = renderer.overlay(&frame, Encoding::Linear);
        assert_eq!(refused, Err(Error::SurfaceAttached { image: Image::Depth }), "depth is attached");
        // SAFETY: as above.
        unsafe {
            gl.gl.framebuffer_texture_2d(
                glow::FRAMEBUFFER,
                glow::DEPTH_ATTACHMENT,
                glow::TEXTURE_2D,
                None,
                0,
            );
            gl.gl.framebuffer_texture_2d(
                glow::FRAMEBUFFER,
                glow::COLOR_ATTACHMENT1,
                glow::TEXTURE_2D,
                Some(shot.normals),
                0,
            );
        }
        let refused = renderer.overlay(&frame, Encoding::Linear);
        assert_eq!(refused, Err(Error::SurfaceAttached { image: Image::Normals }), "normals are attached");
        // SAFETY: as above.
        unsafe {
            gl.gl.framebuffer_texture_2d(
                glow::FRAMEBUFFER,
                glow::COLOR_ATTACHMENT1,
                glow::TEXTURE_2D,
                Some(shot.ids),
                0,
            );
        }
        let refused = renderer.overlay(&frame, Encoding::Linear);
        assert_eq!(refused, Err(Error::SurfaceAttached { image: Image::Ids }), "ids are attached");
        assert!(canvas.read(0).iter().all(|texel| *texel == [255; 4]), "nothing is drawn");
        // Masks have targets of their own: any framebuffer may be bound.
        each_batch(&mut renderer, &frame, |_| {}).expect("masks do not draw to the host's framebuffer");
        gl.assert_no_complaint("refusals");
    });
}
