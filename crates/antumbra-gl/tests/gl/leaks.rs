//! OpenGL objects: deleted with the renderer, replaced when sizes change, not made in between.

use crate::context::{Gl, in_each_api, in_each_tier};
use crate::lights::many_lights;
use crate::shot::{Canvas, Shot, VIEWPORT, each_batch, known};
use antumbra_gl::{Encoding, Renderer, Surface, Technique};
use glow::HasContext;
use std::num::NonZeroU32;

/// Names that are looked through; drivers hand out the smallest free ones.
const NAMES: u32 = 3000;

/// The same for vertex arrays, which glow cannot ask for: every miss is an error of OpenGL.
const VERTEX_ARRAY_NAMES: u32 = 400;

/// Whether binding it works.
fn is_vertex_array(gl: &glow::Context, name: NonZeroU32) -> bool {
    // SAFETY: names that do not exist are an error and bind nothing; the binding is put back.
    unsafe {
        let was = gl.get_parameter_vertex_array(glow::VERTEX_ARRAY_BINDING);
        let talks = gl.supports_debug() && gl.is_enabled(glow::DEBUG_OUTPUT);
        if talks {
            gl.disable(glow::DEBUG_OUTPUT);
        }
        gl.bind_vertex_array(Some(glow::NativeVertexArray(name)));
        let found = gl.get_error() == glow::NO_ERROR;
        gl.bind_vertex_array(was);
        if talks {
            gl.enable(glow::DEBUG_OUTPUT);
        }
        found
    }
}

/// Live objects by kind: textures, buffers, framebuffers, vertex arrays, programs, shaders,
/// renderbuffers.
pub(crate) fn live(gl: &glow::Context) -> [usize; 7] {
    let mut count = [0; 7];
    for name in (1..=NAMES).filter_map(NonZeroU32::new) {
        // SAFETY: these accept any name.
        let is = unsafe {
            [
                gl.is_texture(glow::NativeTexture(name)),
                gl.is_buffer(glow::NativeBuffer(name)),
                gl.is_framebuffer(glow::NativeFramebuffer(name)),
                name.get() <= VERTEX_ARRAY_NAMES && is_vertex_array(gl, name),
                gl.is_program(glow::NativeProgram(name)),
                gl.is_shader(glow::NativeShader(name)),
                gl.is_renderbuffer(glow::NativeRenderbuffer(name)),
            ]
        };
        count.iter_mut().zip(is).for_each(|(count, is)| *count += usize::from(is));
    }
    count
}

/// The sizes of all live textures (in texels; OpenGL alone tells) and buffers (in bytes).
fn sizes(gl: &Gl) -> (Vec<[i32; 2]>, Vec<i32>) {
    let context = &gl.gl;
    let (mut textures, mut buffers) = (Vec::new(), Vec::new());
    for name in (1..=NAMES).filter_map(NonZeroU32::new) {
        // SAFETY: binds what exists, asks for its size, and unbinds it.
        unsafe {
            let buffer = glow::NativeBuffer(name);
            if context.is_buffer(buffer) {
                context.bind_buffer(glow::COPY_READ_BUFFER, Some(buffer));
                buffers.push(context.get_buffer_parameter_i32(glow::COPY_READ_BUFFER, glow::BUFFER_SIZE));
                context.bind_buffer(glow::COPY_READ_BUFFER, None);
            }
            let texture = glow::NativeTexture(name);
            if gl.is_desktop() && context.is_texture(texture) {
                context.bind_texture(glow::TEXTURE_2D, Some(texture));
                let size = |side| context.get_tex_level_parameter_i32(glow::TEXTURE_2D, 0, side);
                textures.push([glow::TEXTURE_WIDTH, glow::TEXTURE_HEIGHT].map(size));
                context.bind_texture(glow::TEXTURE_2D, None);
            }
        }
    }
    textures.sort_unstable();
    (textures, buffers)
}

/// The looking itself: what is made is seen.
#[test]
fn live_objects_are_counted() {
    in_each_api(|gl| {
        let before = live(&gl.gl);
        // SAFETY: made and deleted.
        unsafe {
            let program = gl.gl.create_program().expect("a program");
            let canvas = Canvas::white(gl, [2, 2], 2);
            let vertex_array = gl.gl.create_vertex_array().expect("a vertex array");
            let made: Vec<_> = live(&gl.gl).iter().zip(before).map(|(now, before)| now - before).collect();
            assert_eq!(made, [2, 0, 1, 1, 1, 0, 0], "two textures, a framebuffer, a vertex array, a program");
            gl.gl.delete_vertex_array(vertex_array);
            gl.gl.delete_program(program);
            drop(canvas);
        }
        assert_eq!(live(&gl.gl), before, "all are gone");
    });
}

#[test]
fn a_renderer_takes_its_objects_with_it() {
    in_each_tier(|gl| {
        let (few, many) = (many_lights(3), many_lights(9));
        let (shot, many_shot) = (Shot::new(gl, &few), Shot::new(gl, &many));
        let canvas = Canvas::new(gl);
        let able = Shot::able(&shot.frame());
        let before = live(&gl.gl);
        for round in 0..100 {
            let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
            renderer.set_technique(able[round / 10 % able.len()]).expect("a technique");
            // Some are dropped without a frame, some after a kind of frame each.
            let float = gl.has_floats();
            let frame = if round % 2 == 0 && float { many_shot.frame() } else { shot.frame() };
            match round % 10 {
                0 => {}
                1 => each_batch(&mut renderer, &frame, |_| {}).expect("the frame is right"),
                2 => {
                    let surface = Surface::from_depth(known(shot.depth));
                    renderer.overlay(&frame.surface(surface), Encoding::Linear).expect("right");
                }
                3..6 => {
                    let samples = frame.surface.with_samples(4096);
                    renderer.overlay(&frame.surface(samples), Encoding::Linear).expect_err("samples");
                    let attached = Surface::from_depth(known(canvas.colors[0]));
                    renderer.overlay(&frame.surface(attached), Encoding::Linear).expect_err("attached");
                }
                _ => renderer.overlay(&frame, Encoding::Linear).expect("the frame is right"),
            }
        }
        gl.assert_no_complaint("a hundred renderers");
        assert_eq!(live(&gl.gl), before, "textures, buffers, framebuffers, vertex arrays, programs, shaders");
    });
}

#[test]
fn another_size_replaces_the_old_targets() {
    in_each_tier(|gl| {
        let world = many_lights(9);
        let shot = Shot::new(gl, &world);
        let _canvas = Canvas::new(gl);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let float = gl.has_floats();
        let able = Shot::able(&shot.frame());
        let mut draw = |width: i32, height: i32| {
            let frame = shot.frame().viewport([0, 0, width, height]);
            for technique in &able {
                renderer.set_technique(*technique).expect("a technique");
                if float {
                    renderer.overlay(&frame, Encoding::Linear).expect("the frame is right");
                }
                each_batch(&mut renderer, &frame, |_| {}).expect("the frame is right");
            }
        };
        draw(VIEWPORT[2], VIEWPORT[3]);
        let before = live(&gl.gl);
        for round in 0..60 {
            draw(1 + (round * 37) % VIEWPORT[2], 1 + (round * 23) % VIEWPORT[3]);
        }
        assert_eq!(live(&gl.gl), before, "as many as after the first frame");
        gl.assert_no_complaint("resizing");
    });
}

/// A driver that refuses a size is reported, and what it did make is deleted.
#[test]
fn a_failed_frame_leaves_no_object_and_the_next_one_works() {
    in_each_api(|gl| {
        let world = many_lights(3);
        let shot = Shot::new(gl, &world);
        let canvas = Canvas::new(gl);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let able = Shot::able(&shot.frame());
        for technique in &able {
            renderer.set_technique(*technique).expect("a technique");
            renderer.overlay(&shot.frame(), Encoding::Linear).expect("the frame is right");
        }
        let before = live(&gl.gl);
        let attached = shot.frame().surface.with_ids(known(canvas.colors[0]));
        for round in 0..50 {
            renderer.set_technique(able[round % able.len()]).expect("a technique");
            let bad = shot.frame().surface(attached);
            renderer.overlay(&bad, Encoding::Linear).expect_err("attached");
            let bad = shot.frame().viewport([0, 0, 0, 10]);
            renderer.overlay(&bad, Encoding::Linear).expect_err("no viewport");
            renderer.overlay(&shot.frame(), Encoding::Linear).expect("the next frame is right");
        }
        assert_eq!(live(&gl.gl), before, "as many as after the first frame");
        gl.assert_no_complaint("failing frames");
    });
}

/// Objects and textures are the same for 9, 64 and 512 lights, and the buffers hold a batch: which
/// batch is the largest depends on where the lights are, and buffers double.
#[test]
fn memory_does_not_grow_with_the_lights() {
    in_each_api(|gl| {
        for technique in Shot::able(&Shot::new(gl, &many_lights(1)).frame()) {
            memory_by_lights(gl, technique);
        }
    });
}

fn memory_by_lights(gl: &Gl, technique: Technique) {
    let counts = [9, 64, 512];
    let used = counts.map(|count| {
        let world = many_lights(count);
        let shot = Shot::new(gl, &world);
        let _canvas = Canvas::new(gl);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        renderer.set_technique(technique).expect("a technique");
        renderer.overlay(&shot.frame(), Encoding::Linear).expect("the frame is right");
        each_batch(&mut renderer, &shot.frame(), |_| {}).expect("the frame is right");
        (live(&gl.gl), sizes(gl))
    });
    for (count, (objects, (textures, buffers))) in counts.iter().zip(&used) {
        let (first_objects, (first_textures, first_buffers)) = &used[0];
        assert_eq!(objects, first_objects, "{technique}: objects for {count} lights");
        assert_eq!(textures, first_textures, "{technique}: sizes of textures for {count} lights");
        let [bytes, first] = [buffers, first_buffers].map(|b| b.iter().sum::<i32>());
        assert!(
            first > 0 && bytes <= 2 * first,
            "{technique}: {bytes} bytes for {count} lights, {first} for {}",
            counts[0]
        );
    }
}
