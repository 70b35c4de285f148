//! A host that has set every piece of OpenGL state to something odd.

use crate::context::Gl;
use crate::full_screen;
use crate::shot::{Canvas, texture};
use crate::snapshot::{DESKTOP_SWITCHES, SWITCHES, UNITS, has_indexed_blend, has_indexed_switches};
use glow::HasContext;

/// A host that has everything bound and every switch in the other position, and draws to two
/// buffers of its own.
pub(crate) struct OddHost {
    /// Where its colours are.
    pub(crate) canvas: Canvas,
    program: glow::Program,
    read_framebuffer: glow::Framebuffer,
}

impl OddHost {
    /// Draws to a white canvas of this size; leaves its state set.
    pub(crate) fn new(gl: &Gl, size: [i32; 2]) -> Self {
        let context = &gl.gl;
        let canvas = Canvas::white(gl, size, 2);
        let desktop = gl.is_desktop();
        // SAFETY: settings that the context's version has, of objects made here.
        unsafe {
            let program =
                full_screen::program(context, "out vec4 o_color; void main() { o_color = vec4(1.0); }");
            let read_framebuffer = context.create_framebuffer().expect("a framebuffer");
            context.bind_framebuffer(glow::READ_FRAMEBUFFER, Some(read_framebuffer));
            set_bindings(gl);
            set_numbers(gl);
            context.use_program(Some(program));
            for (name, switch) in SWITCHES.iter().chain(if desktop { DESKTOP_SWITCHES } else { &[] }) {
                // Of colour encoding, which changes pictures, the host's is right.
                if *name != "FRAMEBUFFER_SRGB" {
                    if context.is_enabled(*switch) {
                        context.disable(*switch)
                    } else {
                        context.enable(*switch)
                    }
                }
            }
            set_blending(gl);
            Self { canvas, program, read_framebuffer }
        }
    }

    /// The state of a fresh context, as far as it decides how things are drawn and read.
    pub(crate) fn calm_down(self, gl: &Gl) -> Canvas {
        let context = &gl.gl;
        // SAFETY: settings that the context's version has.
        unsafe {
            for (name, switch) in SWITCHES.iter().chain(if gl.is_desktop() { DESKTOP_SWITCHES } else { &[] })
            {
                let on = matches!(*name, "DITHER" | "MULTISAMPLE");
                if on { context.enable(*switch) } else { context.disable(*switch) }
            }
            context.color_mask(true, true, true, true);
            context.use_program(None);
            context.delete_program(self.program);
            context.delete_framebuffer(self.read_framebuffer);
            for buffer in [glow::PIXEL_PACK_BUFFER, glow::PIXEL_UNPACK_BUFFER] {
                context.bind_buffer(buffer, None);
            }
            for (name, _) in PIXEL_STORE {
                let fresh = if matches!(name, glow::PACK_ALIGNMENT | glow::UNPACK_ALIGNMENT) { 4 } else { 0 };
                context.pixel_store_i32(name, fresh);
            }
            for name in DESKTOP_PIXEL_STORE.into_iter().filter(|_| gl.is_desktop()) {
                context.pixel_store_i32(name, 0);
            }
        }
        self.canvas
    }
}

/// How texels lie in memory: nothing as in a fresh context.
const PIXEL_STORE: [(u32, i32); 10] = [
    (glow::UNPACK_ALIGNMENT, 1),
    (glow::UNPACK_ROW_LENGTH, 3),
    (glow::UNPACK_SKIP_ROWS, 2),
    (glow::UNPACK_SKIP_PIXELS, 1),
    (glow::UNPACK_SKIP_IMAGES, 1),
    (glow::UNPACK_IMAGE_HEIGHT, 9),
    (glow::PACK_ALIGNMENT, 2),
    (glow::PACK_ROW_LENGTH, 500),
    (glow::PACK_SKIP_ROWS, 3),
    (glow::PACK_SKIP_PIXELS, 2),
];

/// The same, switches of OpenGL alone: on.
const DESKTOP_PIXEL_STORE: [u32; 4] =
    [glow::UNPACK_SWAP_BYTES, glow::UNPACK_LSB_FIRST, glow::PACK_SWAP_BYTES, glow::PACK_LSB_FIRST];

/// Something bound wherever something can be.
///
/// # Safety
/// The context is current.
unsafe fn set_bindings(gl: &Gl) {
    let context = &gl.gl;
    let buffer = |target, index: Option<u32>| {
        // SAFETY: a fresh buffer.
        unsafe {
            let buffer = context.create_buffer().expect("a buffer");
            context.bind_buffer(target, Some(buffer));
            context.buffer_data_size(target, 4096, glow::STATIC_DRAW);
            if let Some(index) = index {
                context.bind_buffer_range(target, index, Some(buffer), 256, 512);
            }
        }
    };
    let image =
        || texture(context, [2, 2], [glow::RGBA8, glow::RGBA, glow::UNSIGNED_BYTE], &[[1u8, 2, 3, 4]; 4]);
    // SAFETY: fresh objects, bound where the context's version has a place for them.
    unsafe {
        // What is created with pixels comes before odd unpacking.
        for unit in 0..UNITS {
            context.active_texture(glow::TEXTURE0 + unit);
            context.bind_texture(glow::TEXTURE_2D, Some(image()));
            let mut others = vec![glow::TEXTURE_3D, glow::TEXTURE_2D_ARRAY, glow::TEXTURE_CUBE_MAP];
            if gl.is_desktop() {
                others.extend([glow::TEXTURE_1D, glow::TEXTURE_2D_MULTISAMPLE]);
                others.extend([glow::TEXTURE_RECTANGLE, glow::TEXTURE_BUFFER]);
            }
            for target in others {
                let texture = context.create_texture().expect("a texture");
                context.bind_texture(target, Some(texture));
            }
            let sampler = context.create_sampler().expect("a sampler");
            context.sampler_parameter_i32(
                sampler,
                glow::TEXTURE_MIN_FILTER,
                glow::LINEAR_MIPMAP_LINEAR as i32,
            );
            context.sampler_parameter_i32(
                sampler,
                glow::TEXTURE_COMPARE_MODE,
                glow::COMPARE_REF_TO_TEXTURE as i32,
            );
            context.bind_sampler(unit, Some(sampler));
        }
        context.active_texture(glow::TEXTURE0 + 6);
        let vertex_array = context.create_vertex_array().expect("a vertex array");
        context.bind_vertex_array(Some(vertex_array));
        buffer(glow::ELEMENT_ARRAY_BUFFER, None);
        buffer(glow::ARRAY_BUFFER, None);
        context.enable_vertex_attrib_array(1);
        context.vertex_attrib_pointer_f32(1, 3, glow::FLOAT, false, 24, 4);
        buffer(glow::ARRAY_BUFFER, None);
        for target in [
            glow::COPY_READ_BUFFER,
            glow::COPY_WRITE_BUFFER,
            glow::PIXEL_PACK_BUFFER,
            glow::PIXEL_UNPACK_BUFFER,
        ] {
            buffer(target, None);
        }
        for index in 0..4 {
            buffer(glow::UNIFORM_BUFFER, Some(index));
            buffer(glow::TRANSFORM_FEEDBACK_BUFFER, Some(index));
        }
        if gl.is_desktop() {
            buffer(glow::TEXTURE_BUFFER, None);
        }
        let renderbuffer = context.create_renderbuffer().expect("a renderbuffer");
        context.bind_renderbuffer(glow::RENDERBUFFER, Some(renderbuffer));
    }
}

/// # Safety
/// The context is current.
unsafe fn set_numbers(gl: &Gl) {
    let context = &gl.gl;
    // SAFETY: values that OpenGL allows.
    unsafe {
        context.viewport(3, 5, 17, 19);
        context.scissor(1, 2, 4, 3);
        context.clear_color(0.1, 0.2, 0.3, 0.4);
        context.clear_depth_f32(0.25);
        context.clear_stencil(7);
        context.blend_color(0.5, 0.6, 0.7, 0.8);
        context.depth_func(glow::NEVER);
        context.depth_mask(false);
        context.depth_range_f32(0.25, 0.75);
        context.cull_face(glow::FRONT_AND_BACK);
        context.front_face(glow::CW);
        context.line_width(1.0);
        context.polygon_offset(3.0, 4.0);
        context.sample_coverage(0.25, true);
        context.stencil_func_separate(glow::FRONT, glow::NEVER, 3, 0x0f);
        context.stencil_func_separate(glow::BACK, glow::GREATER, 4, 0x1f);
        context.stencil_op_separate(glow::FRONT, glow::INVERT, glow::INCR, glow::DECR);
        context.stencil_op_separate(glow::BACK, glow::ZERO, glow::REPLACE, glow::INCR_WRAP);
        context.stencil_mask_separate(glow::FRONT, 0x33);
        context.stencil_mask_separate(glow::BACK, 0x55);
        context.hint(glow::FRAGMENT_SHADER_DERIVATIVE_HINT, glow::NICEST);
        for (name, value) in PIXEL_STORE {
            context.pixel_store_i32(name, value);
        }
        if gl.is_desktop() {
            context.polygon_mode(glow::FRONT_AND_BACK, glow::LINE);
            for name in DESKTOP_PIXEL_STORE {
                context.pixel_store_i32(name, 1);
            }
        }
    }
}

/// Odd blending and masks, different for each draw buffer where they can be.
///
/// # Safety
/// The context is current.
unsafe fn set_blending(gl: &Gl) {
    let context = &gl.gl;
    // SAFETY: values that OpenGL allows, of draw buffers that every context has.
    unsafe {
        context.blend_func_separate(glow::DST_COLOR, glow::ONE, glow::DST_ALPHA, glow::SRC_ALPHA);
        context.blend_equation_separate(glow::FUNC_SUBTRACT, glow::MAX);
        context.color_mask(false, true, false, false);
        if has_indexed_switches(gl) {
            for buffer in [1, 2] {
                context.disable_draw_buffer(glow::BLEND, buffer);
            }
            context.color_mask_draw_buffer(1, true, false, true, false);
        }
        if has_indexed_blend(gl) {
            context.blend_func_separate_draw_buffer(
                1,
                glow::ONE,
                glow::SRC_COLOR,
                glow::ZERO,
                glow::DST_ALPHA,
            );
            context.blend_equation_separate_draw_buffer(1, glow::MIN, glow::FUNC_REVERSE_SUBTRACT);
        }
    }
}
