//! Storage of textures.

use glow::HasContext;

/// One level of texels that are fetched, never filtered.
///
/// # Safety
/// A texture of this context is bound to `TEXTURE_2D`.
pub(super) unsafe fn texture_storage(gl: &glow::Context, internal: u32, width: i32, height: i32) {
    let kind = match internal {
        glow::RGBA8 => glow::UNSIGNED_BYTE,
        glow::RGBA16F => glow::HALF_FLOAT,
        _ => glow::FLOAT,
    };
    let none = glow::PixelUnpackData::Slice(None);
    // SAFETY: the caller's; no memory of ours is read.
    unsafe {
        gl.tex_image_2d(glow::TEXTURE_2D, 0, internal as i32, width, height, 0, glow::RGBA, kind, none);
        for (name, value) in [
            (glow::TEXTURE_MIN_FILTER, glow::NEAREST),
            (glow::TEXTURE_MAG_FILTER, glow::NEAREST),
            (glow::TEXTURE_WRAP_S, glow::CLAMP_TO_EDGE),
            (glow::TEXTURE_WRAP_T, glow::CLAMP_TO_EDGE),
        ] {
            gl.tex_parameter_i32(glow::TEXTURE_2D, name, value as i32);
        }
        gl.tex_parameter_i32(glow::TEXTURE_2D, glow::TEXTURE_MAX_LEVEL, 0);
    }
}
