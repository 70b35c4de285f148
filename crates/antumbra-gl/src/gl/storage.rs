//! Storage of textures.

use glow::HasContext;

/// One level of texels, or of depths, that are fetched, never filtered or compared.
///
/// # Safety
/// A texture of this context is bound to `TEXTURE_2D`.
pub(crate) unsafe fn texture_storage(gl: &glow::Context, internal: u32, width: i32, height: i32) {
    let (format, kind) = match internal {
        glow::RGBA8 => (glow::RGBA, glow::UNSIGNED_BYTE),
        glow::RGBA16F => (glow::RGBA, glow::HALF_FLOAT),
        glow::DEPTH_COMPONENT16 => (glow::DEPTH_COMPONENT, glow::UNSIGNED_SHORT),
        glow::DEPTH_COMPONENT24 | glow::DEPTH_COMPONENT32 => (glow::DEPTH_COMPONENT, glow::UNSIGNED_INT),
        glow::DEPTH_COMPONENT32F => (glow::DEPTH_COMPONENT, glow::FLOAT),
        glow::DEPTH24_STENCIL8 => (glow::DEPTH_STENCIL, glow::UNSIGNED_INT_24_8),
        glow::DEPTH32F_STENCIL8 => (glow::DEPTH_STENCIL, glow::FLOAT_32_UNSIGNED_INT_24_8_REV),
        _ => (glow::RGBA, glow::FLOAT),
    };
    let none = glow::PixelUnpackData::Slice(None);
    // SAFETY: the caller's; no memory of ours is read.
    unsafe {
        gl.tex_image_2d(glow::TEXTURE_2D, 0, internal as i32, width, height, 0, format, kind, none);
        for (name, value) in [
            (glow::TEXTURE_MIN_FILTER, glow::NEAREST),
            (glow::TEXTURE_MAG_FILTER, glow::NEAREST),
            (glow::TEXTURE_WRAP_S, glow::CLAMP_TO_EDGE),
            (glow::TEXTURE_WRAP_T, glow::CLAMP_TO_EDGE),
            (glow::TEXTURE_COMPARE_MODE, glow::NONE),
        ] {
            gl.tex_parameter_i32(glow::TEXTURE_2D, name, value as i32);
        }
        gl.tex_parameter_i32(glow::TEXTURE_2D, glow::TEXTURE_MAX_LEVEL, 0);
    }
}
