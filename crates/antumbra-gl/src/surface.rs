//! The host's surface as the shaders read it.

use crate::frame::Surface;
use crate::shader::Program;
use crate::view::View;
use glow::HasContext;

/// # Safety
/// A [`crate::state::StateGuard`] is alive; the texture has that many samples.
pub(crate) unsafe fn bind_texture(gl: &glow::Context, unit: u32, samples: u32, texture: glow::Texture) {
    // SAFETY: the caller's.
    unsafe {
        gl.active_texture(glow::TEXTURE0 + unit);
        let kind = if samples > 1 { glow::TEXTURE_2D_MULTISAMPLE } else { glow::TEXTURE_2D };
        gl.bind_texture(kind, Some(texture));
    }
}

/// Uses a program, binds the surface's textures to units 0 to 2 and sets what surface.glsl reads; `offset` leads
/// from the target's pixels to the surface's texels.
///
/// # Safety
/// A [`crate::state::StateGuard`] is alive, the surface's textures exist.
pub(crate) unsafe fn set_surface(
    gl: &glow::Context,
    program: &Program,
    view: &View,
    surface: &Surface,
    offset: [i32; 2],
) {
    let u = &program.uniforms;
    let [x, y, width, height] = view.viewport;
    // SAFETY: the caller's.
    unsafe {
        gl.use_program(Some(program.raw));
        for (unit, (location, texture)) in [
            (&u.depth, Some(surface.depth)),
            (&u.normals, surface.normals.map(|n| n.texture)),
            (&u.ids, surface.ids),
        ]
        .into_iter()
        .enumerate()
        {
            // Samplers of different types may not share a unit, read or not.
            gl.uniform_1_i32(location.as_ref(), unit as i32);
            if let Some(texture) = texture {
                bind_texture(gl, unit as u32, surface.samples, texture);
            }
        }
        gl.uniform_matrix_4_f32_slice(u.unproject.as_ref(), false, &view.unproject.to_cols_array());
        gl.uniform_4_f32_slice(u.pixel_step.as_ref(), &view.pixel_step);
        gl.uniform_3_f32_slice(u.background_depth.as_ref(), &view.background_depth);
        gl.uniform_2_i32(u.surface_offset.as_ref(), offset[0], offset[1]);
        gl.uniform_4_i32(u.surface_range.as_ref(), x, y, x + width - 1, y + height - 1);
        gl.uniform_matrix_3_f32_slice(u.normal_to_view.as_ref(), false, &view.normal_to_view.to_cols_array());
        gl.uniform_2_f32_slice(u.normal_decode.as_ref(), &view.normal_decode);
    }
}
