//! Every piece of OpenGL state, read back.

use crate::context::Gl;
use glow::HasContext;

/// Texture units that are looked at; antumbra uses fewer.
pub(crate) const UNITS: u32 = 8;

/// The state, each piece under its name.
pub(crate) type Snapshot = Vec<(String, Vec<i64>)>;

macro_rules! names {
    ($($name:ident),* $(,)?) => { &[$((stringify!($name), glow::$name)),*] };
}

/// Switches of every tier.
pub(crate) const SWITCHES: &[(&str, u32)] = names!(
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
pub(crate) const DESKTOP_SWITCHES: &[(&str, u32)] = names!(
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
