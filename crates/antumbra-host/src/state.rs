//! The OpenGL state that the stage draws in, whatever another user of the context left.

use glow::HasContext;

/// Switches, whether they are to be on, and whether they are of desktop OpenGL only.
const SWITCHES: [(u32, bool, bool); 18] = [
    (glow::BLEND, false, false),
    (glow::CULL_FACE, false, false),
    (glow::DEPTH_TEST, false, false),
    (glow::DITHER, false, false),
    (glow::POLYGON_OFFSET_FILL, false, false),
    (glow::RASTERIZER_DISCARD, false, false),
    (glow::SAMPLE_ALPHA_TO_COVERAGE, false, false),
    (glow::SAMPLE_COVERAGE, false, false),
    (glow::SCISSOR_TEST, false, false),
    (glow::STENCIL_TEST, false, false),
    (glow::COLOR_LOGIC_OP, false, true),
    (glow::DEPTH_CLAMP, false, true),
    (glow::FRAMEBUFFER_SRGB, false, true),
    (glow::MULTISAMPLE, true, true),
    (glow::POLYGON_SMOOTH, false, true),
    (glow::PRIMITIVE_RESTART, false, true),
    (glow::SAMPLE_ALPHA_TO_ONE, false, true),
    (glow::SAMPLE_MASK, false, true),
];

const CLIP_DISTANCES: u32 = 8;

/// Sets what drawing, clearing and resolving depend on, but for what each draw sets itself.
///
/// # Safety
/// The context is current.
pub(crate) unsafe fn reset(gl: &glow::Context) {
    let desktop = !gl.version().is_embedded;
    // SAFETY: settings that exist in every context of this kind.
    unsafe {
        for (switch, on, only_desktop) in SWITCHES {
            match on {
                _ if only_desktop && !desktop => (),
                true => gl.enable(switch),
                false => gl.disable(switch),
            }
        }
        gl.color_mask(true, true, true, true);
        gl.depth_mask(true);
        gl.depth_range_f32(0.0, 1.0);
        gl.front_face(glow::CCW);
        gl.blend_equation(glow::FUNC_ADD);
        // Bound, it would be read in place of no texels.
        gl.bind_buffer(glow::PIXEL_UNPACK_BUFFER, None);
        if desktop {
            gl.polygon_mode(glow::FRONT_AND_BACK, glow::FILL);
            (0..CLIP_DISTANCES).for_each(|i| gl.disable(glow::CLIP_DISTANCE0 + i));
        }
    }
}

/// Sets how pixels are written to memory: row by row, without gaps, into the caller's.
///
/// # Safety
/// The context is current.
pub(crate) unsafe fn reset_packing(gl: &glow::Context) {
    // SAFETY: as in `reset`.
    unsafe {
        gl.bind_buffer(glow::PIXEL_PACK_BUFFER, None);
        gl.pixel_store_i32(glow::PACK_ALIGNMENT, 4);
        for name in [glow::PACK_ROW_LENGTH, glow::PACK_SKIP_ROWS, glow::PACK_SKIP_PIXELS] {
            gl.pixel_store_i32(name, 0);
        }
        if !gl.version().is_embedded {
            gl.pixel_store_i32(glow::PACK_SWAP_BYTES, 0);
        }
    }
}
