//! Every piece of OpenGL state, and a host that has set each to something odd.

use crate::context::Gl;
use crate::shot::{Canvas, texture};
use glow::HasContext;

/// Texture units that are looked at; antumbra uses fewer.
const UNITS: u32 = 8;

/// The state, each piece under its name.
pub(crate) type Snapshot = Vec<(String, Vec<i64>)>;

macro_rules! names {
    ($($name:ident),* $(,)?) => { &[$((stringify!($name), glow::$name)),*] };
}

/// Switches of every tier.
const SWITCHES: &[(&str, u32)] = names!(
    BLEND,
    CULL_FACE,
    DEPTH_TEST,
    DITHER,
    POLYGON_OFFSET_FILL,
    RASTERIZER_DISCARD,
    SAMPLE_ALPHA_TO_COVERAGE,
    SAMPLE_COVERAGE,
    SCISSOR_TEST,
    STENCIL_TEST,
);

/// Switches of OpenGL alone.
const DESKTOP_SWITCHES: &[(&str, u32)] = names!(
    CLIP_DISTANCE0,
    CLIP_DISTANCE1,
    CLIP_DISTANCE2,
    CLIP_DISTANCE3,
    CLIP_DISTANCE4,
    CLIP_DISTANCE5,
    CLIP_DISTANCE6,
    CLIP_DISTANCE7,
    COLOR_LOGIC_OP,
    DEPTH_CLAMP,
    FRAMEBUFFER_SRGB,
    LINE_SMOOTH,
    MULTISAMPLE,
    POLYGON_OFFSET_LINE,
    POLYGON_OFFSET_POINT,
    POLYGON_SMOOTH,
    PRIMITIVE_RESTART,
    PROGRAM_POINT_SIZE,
    SAMPLE_ALPHA_TO_ONE,
    SAMPLE_MASK,
    TEXTURE_CUBE_MAP_SEAMLESS,
);

/// Bindings and whole numbers.
const NUMBERS: &[(&str, u32)] = names!(
    ACTIVE_TEXTURE,
    ARRAY_BUFFER_BINDING,
    BLEND_DST_ALPHA,
    BLEND_DST_RGB,
    BLEND_EQUATION_ALPHA,
    BLEND_EQUATION_RGB,
    BLEND_SRC_ALPHA,
    BLEND_SRC_RGB,
    COPY_READ_BUFFER_BINDING,
    COPY_WRITE_BUFFER_BINDING,
    CULL_FACE_MODE,
    CURRENT_PROGRAM,
    DEPTH_FUNC,
    DEPTH_WRITEMASK,
    DRAW_BUFFER0,
    DRAW_BUFFER1,
    DRAW_BUFFER2,
    DRAW_BUFFER3,
    DRAW_FRAMEBUFFER_BINDING,
    ELEMENT_ARRAY_BUFFER_BINDING,
    FRAGMENT_SHADER_DERIVATIVE_HINT,
    FRONT_FACE,
    PACK_ALIGNMENT,
    PACK_ROW_LENGTH,
    PACK_SKIP_PIXELS,
    PACK_SKIP_ROWS,
    PIXEL_PACK_BUFFER_BINDING,
    PIXEL_UNPACK_BUFFER_BINDING,
    READ_BUFFER,
    READ_FRAMEBUFFER_BINDING,
    RENDERBUFFER_BINDING,
    SAMPLE_COVERAGE_INVERT,
    STENCIL_BACK_FAIL,
    STENCIL_BACK_FUNC,
    STENCIL_BACK_PASS_DEPTH_FAIL,
    STENCIL_BACK_PASS_DEPTH_PASS,
    STENCIL_BACK_REF,
    STENCIL_BACK_VALUE_MASK,
    STENCIL_BACK_WRITEMASK,
    STENCIL_CLEAR_VALUE,
    STENCIL_FAIL,
    STENCIL_FUNC,
    STENCIL_PASS_DEPTH_FAIL,
    STENCIL_PASS_DEPTH_PASS,
    STENCIL_REF,
    STENCIL_VALUE_MASK,
    STENCIL_WRITEMASK,
    TRANSFORM_FEEDBACK_BUFFER_BINDING,
    UNIFORM_BUFFER_BINDING,
    UNPACK_ALIGNMENT,
    UNPACK_IMAGE_HEIGHT,
    UNPACK_ROW_LENGTH,
    UNPACK_SKIP_IMAGES,
    UNPACK_SKIP_PIXELS,
    UNPACK_SKIP_ROWS,
    VERTEX_ARRAY_BINDING,
);

/// The same, of OpenGL alone.
const DESKTOP_NUMBERS: &[(&str, u32)] = names!(
    LOGIC_OP_MODE,
    PACK_LSB_FIRST,
    PACK_SWAP_BYTES,
    TEXTURE_BUFFER_BINDING,
    UNPACK_LSB_FIRST,
    UNPACK_SWAP_BYTES,
);

/// Several numbers, or numbers that are not whole.
const VECTORS: &[(&str, u32)] = names!(
    BLEND_COLOR,
    COLOR_CLEAR_VALUE,
    COLOR_WRITEMASK,
    DEPTH_CLEAR_VALUE,
    DEPTH_RANGE,
    LINE_WIDTH,
    POLYGON_OFFSET_FACTOR,
    POLYGON_OFFSET_UNITS,
    SAMPLE_COVERAGE_VALUE,
    SCISSOR_BOX,
    VIEWPORT,
);

const TEXTURES: &[(&str, u32)] = names!(
    SAMPLER_BINDING,
    TEXTURE_BINDING_2D,
    TEXTURE_BINDING_2D_ARRAY,
    TEXTURE_BINDING_3D,
    TEXTURE_BINDING_CUBE_MAP,
);

const DESKTOP_TEXTURES: &[(&str, u32)] = names!(
    TEXTURE_BINDING_1D,
    TEXTURE_BINDING_2D_MULTISAMPLE,
    TEXTURE_BINDING_BUFFER,
    TEXTURE_BINDING_RECTANGLE
);

/// What may differ from one draw buffer to the next.
const BLEND_OF_BUFFERS: &[(&str, u32)] = names!(
    BLEND_DST_ALPHA,
    BLEND_DST_RGB,
    BLEND_EQUATION_ALPHA,
    BLEND_EQUATION_RGB,
    BLEND_SRC_ALPHA,
    BLEND_SRC_RGB
);

/// Whether draw buffers have blend functions of their own.
pub(crate) fn has_indexed_blend(gl: &Gl) -> bool {
    gl.version() >= if gl.is_desktop() { (4, 0) } else { (3, 2) }
}

/// Whether draw buffers have switches and masks of their own.
pub(crate) fn has_indexed_switches(gl: &Gl) -> bool {
    gl.is_desktop() || gl.version() >= (3, 2)
}

/// Reads everything.
pub(crate) fn snapshot(gl: &Gl) -> Snapshot {
    let context = &gl.gl;
    let mut all = Snapshot::new();
    let both = |every: &'static [(&str, u32)], desktop: &'static [(&str, u32)]| {
        every.iter().chain(if gl.is_desktop() { desktop } else { &[] }).copied()
    };
    // SAFETY: queries of state that the context's version has, into memory that is large enough.
    unsafe {
        let number = |name| i64::from(context.get_parameter_i32(name));
        for (name, value) in both(SWITCHES, DESKTOP_SWITCHES) {
            all.push((name.into(), vec![context.is_enabled(value).into()]));
        }
        for (name, value) in both(NUMBERS, DESKTOP_NUMBERS) {
            all.push((name.into(), vec![number(value)]));
        }
        for (name, value) in VECTORS {
            let mut values = [0.0f32; 4];
            context.get_parameter_f32_slice(*value, &mut values);
            all.push(((*name).into(), values.map(|v| v.to_bits().into()).into()));
        }
        if gl.is_desktop() {
            let mut modes = [0; 2];
            context.get_parameter_i32_slice(glow::POLYGON_MODE, &mut modes);
            all.push(("POLYGON_MODE".into(), modes.map(i64::from).into()));
        }
        let active = context.get_parameter_i32(glow::ACTIVE_TEXTURE) as u32;
        for unit in 0..UNITS {
            context.active_texture(glow::TEXTURE0 + unit);
            for (name, value) in both(TEXTURES, DESKTOP_TEXTURES) {
                all.push((format!("{name} of unit {unit}"), vec![number(value)]));
            }
        }
        context.active_texture(active);
        let indexed = |name, index| context.get_parameter_indexed_i64(name, index);
        for (name, value, count) in [
            ("UNIFORM_BUFFER", glow::UNIFORM_BUFFER_BINDING, 4),
            ("UNIFORM_BUFFER_START", glow::UNIFORM_BUFFER_START, 4),
            ("UNIFORM_BUFFER_SIZE", glow::UNIFORM_BUFFER_SIZE, 4),
            ("TRANSFORM_FEEDBACK_BUFFER", glow::TRANSFORM_FEEDBACK_BUFFER_BINDING, 4),
        ] {
            all.extend((0..count).map(|i| (format!("{name} {i}"), vec![indexed(value, i)])));
        }
        for buffer in 0..4 {
            if has_indexed_switches(gl) {
                let on = context.get_parameter_indexed_i32(glow::BLEND, buffer);
                all.push((format!("BLEND of buffer {buffer}"), vec![on.into()]));
            }
            for (name, value) in BLEND_OF_BUFFERS.iter().filter(|_| has_indexed_blend(gl)) {
                let value = context.get_parameter_indexed_i32(*value, buffer);
                all.push((format!("{name} of buffer {buffer}"), vec![value.into()]));
            }
        }
        for attribute in 0..3 {
            for (name, value) in
                names!(VERTEX_ATTRIB_ARRAY_ENABLED, VERTEX_ATTRIB_ARRAY_SIZE, VERTEX_ATTRIB_ARRAY_STRIDE)
            {
                let mut values = [0.0f32; 4];
                context.get_vertex_attrib_parameter_f32_slice(attribute, *value, &mut values);
                all.push((format!("{name} {attribute}"), vec![values[0].to_bits().into()]));
            }
        }
    }
    all
}

/// Asserts that two snapshots are the same.
pub(crate) fn assert_same(before: &Snapshot, after: &Snapshot, what: &str) {
    let changed: Vec<_> = before.iter().zip(after).filter(|(a, b)| a != b).collect();
    assert!(changed.is_empty(), "{what} changed: {changed:?}");
}

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
            let program = tiny_program(context, desktop);
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

/// # Safety
/// The context is current.
unsafe fn tiny_program(context: &glow::Context, desktop: bool) -> glow::Program {
    let version = if desktop { "#version 330 core\n" } else { "#version 300 es\nprecision highp float;\n" };
    let stages = [
        (glow::VERTEX_SHADER, "void main() { gl_Position = vec4(0.0); }"),
        (glow::FRAGMENT_SHADER, "out vec4 o_color; void main() { o_color = vec4(1.0); }"),
    ];
    // SAFETY: objects are made and used in this context.
    unsafe {
        let program = context.create_program().expect("a program");
        for (kind, source) in stages {
            let shader = context.create_shader(kind).expect("a shader");
            context.shader_source(shader, &format!("{version}{source}"));
            context.compile_shader(shader);
            context.attach_shader(program, shader);
            context.delete_shader(shader);
        }
        context.link_program(program);
        program
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
