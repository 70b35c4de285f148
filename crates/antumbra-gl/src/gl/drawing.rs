//! One frame of the host as everything that draws reads it.

use super::{Caps, Needs, Program, Target, TargetFormat};
use crate::input::{Error, Frame, HostState, Texture};
use crate::screen::View;
use glow::HasContext;

/// Where and from what a frame's shadows are drawn.
#[derive(Clone, Copy)]
pub(crate) struct Drawing<'a> {
    pub(crate) gl: &'a glow::Context,
    pub(crate) caps: &'a Caps,
    pub(crate) frame: Frame<'a>,
    pub(crate) view: &'a View,
    /// What is done about the host's state.
    pub(crate) host: HostState,
    /// What is in the host's frame.
    pub(crate) needs: Needs,
}

impl Drawing<'_> {
    /// The offset from the pixels of targets of the viewport's size, such as masks, to the surface's texels.
    pub(crate) fn mask_offset(&self) -> [i32; 2] {
        [self.view.viewport[0], self.view.viewport[1]]
    }

    /// Makes a slot hold a target as large as the viewport, of the surface's samples, unless it does already.
    ///
    /// # Safety
    /// A [`super::StateGuard`] is alive: bindings are changed.
    pub(crate) unsafe fn ensure_target(
        &self,
        slot: &mut Option<Target>,
        format: TargetFormat,
    ) -> Result<(), Error> {
        let [.., width, height] = self.view.viewport;
        // SAFETY: the caller's.
        unsafe { Target::ensure(slot, self.gl, format, (width, height), self.frame.surface.samples) }
    }

    /// Uses a program, binds the surface's textures to units 0 to 2 and sets what surface.glsl reads; `offset` leads
    /// from the target's pixels to the surface's texels.
    ///
    /// # Safety
    /// A [`super::StateGuard`] is alive, the surface's textures exist.
    pub(crate) unsafe fn use_program(&self, program: &Program, offset: [i32; 2]) {
        let Self { gl, view, frame, .. } = self;
        let (u, surface, numbers) = (&program.uniforms, &frame.surface, &view.surface);
        let [x, y, width, height] = view.viewport;
        // SAFETY: the caller's.
        unsafe {
            gl.use_program(Some(program.raw));
            for (unit, (location, texture)) in [
                (&u.depth, surface.depth_texture()),
                (&u.normals, surface.normals.map(|n| n.texture.glow())),
                (&u.ids, surface.ids.map(Texture::glow)),
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
            gl.uniform_matrix_4_f32_slice(u.unproject.as_ref(), false, &numbers.unproject.to_cols_array());
            gl.uniform_4_f32_slice(u.pixel_step.as_ref(), &numbers.pixel_step);
            gl.uniform_3_f32_slice(u.background_depth.as_ref(), &numbers.background_depth);
            gl.uniform_2_i32(u.surface_offset.as_ref(), offset[0], offset[1]);
            gl.uniform_4_i32(u.surface_range.as_ref(), x, y, x + width - 1, y + height - 1);
            gl.uniform_matrix_3_f32_slice(
                u.normal_to_view.as_ref(),
                false,
                &numbers.normal_to_view.to_cols_array(),
            );
            gl.uniform_2_f32_slice(u.normal_decode.as_ref(), &numbers.normal_decode);
        }
    }
}

/// # Safety
/// A [`super::StateGuard`] is alive; the texture has that many samples.
pub(crate) unsafe fn bind_texture(gl: &glow::Context, unit: u32, samples: u32, texture: glow::Texture) {
    // SAFETY: the caller's.
    unsafe {
        gl.active_texture(glow::TEXTURE0 + unit);
        let kind = if samples > 1 { glow::TEXTURE_2D_MULTISAMPLE } else { glow::TEXTURE_2D };
        gl.bind_texture(kind, Some(texture));
    }
}
