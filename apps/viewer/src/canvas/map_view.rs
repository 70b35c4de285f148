//! The shadow map of a light, as a picture in shades of grey: near is light, far is dark, nothing is black.

use antumbra::{DepthMap, DepthScale};
use antumbra_host::HostError;
use glow::HasContext;

use super::picture::Picture;
use super::program::Program;

/// Pixels of a side of a face in the picture.
const FACE: i32 = 192;

/// Where the faces of a cube are in the unfolded picture, columns and rows from the bottom left: +X, -X, +Y, -Y, +Z, -Z.
pub(crate) const CROSS: [[i32; 2]; 6] = [[2, 1], [0, 1], [1, 2], [1, 0], [3, 1], [1, 1]];

/// Size of the texture: an unfolded cube. One face alone takes the left part of it. It is never made anew, because the
/// interface goes by it.
pub(crate) const TEXTURE: [i32; 2] = [4 * FACE, 3 * FACE];

/// A map as a picture.
pub(crate) struct MapPicture {
    pub(crate) texture: glow::Texture,
    /// The part of the texture that it takes, from its first row and column.
    pub(crate) size: [i32; 2],
    /// What it is, for people.
    pub(crate) caption: String,
}

/// What draws it.
#[derive(Default)]
pub(crate) struct MapView {
    program: Option<Program>,
    vertex_array: Option<glow::VertexArray>,
    picture: Option<Picture>,
}

impl MapView {
    /// Draws a map into a picture of its own.
    ///
    /// # Errors
    /// [`HostError::Driver`].
    ///
    /// # Safety
    /// The context is current, and the map is still there.
    pub(crate) unsafe fn draw(
        &mut self,
        gl: &glow::Context,
        map: &DepthMap,
    ) -> Result<MapPicture, HostError> {
        let size = if map.cube { TEXTURE } else { [TEXTURE[1]; 2] };
        // SAFETY: the caller's.
        unsafe {
            if self.program.is_none() {
                let vertex = include_str!("shaders/screen.vert.glsl");
                self.program = Some(Program::new(gl, vertex, include_str!("shaders/map.frag.glsl"))?);
                self.vertex_array = Some(gl.create_vertex_array().map_err(HostError::Driver)?);
            }
            let Some(program) = &self.program else { return Err(HostError::Driver("no program".into())) };
            let picture = Picture::ensure(&mut self.picture, gl, TEXTURE)?;
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(picture.framebuffer));
            gl.disable(glow::SCISSOR_TEST);
            gl.clear_buffer_f32_slice(glow::COLOR, 0, &[0.05, 0.05, 0.06, 1.0]);
            gl.use_program(Some(program.raw));
            gl.active_texture(glow::TEXTURE0);
            gl.bind_texture(glow::TEXTURE_2D, Some(map.texture.glow()));
            gl.bind_sampler(0, None);
            gl.bind_vertex_array(self.vertex_array);
            let uniform = |name| program.uniform(gl, name);
            gl.uniform_1_i32(uniform("u_map").as_ref(), 0);
            gl.uniform_2_f32(uniform("u_range").as_ref(), map.range[0] as f32, map.range[1] as f32);
            // Distance = x / depth, or x + y * depth.
            let scale = match map.scale {
                DepthScale::Central { near } => [near as f32, 0.0, 1.0],
                DepthScale::Parallel { near, far } => [far as f32, (near - far) as f32, 0.0],
            };
            gl.uniform_3_f32_slice(uniform("u_scale").as_ref(), &scale);
            gl.uniform_1_i32(uniform("u_side").as_ref(), map.side as i32);
            for (i, face) in map.faces.iter().enumerate() {
                let Some(face) = face else { continue };
                let ([column, row], side) = if map.cube { (CROSS[i], FACE) } else { ([0, 0], TEXTURE[1]) };
                gl.viewport(column * side, row * side, side, side);
                gl.uniform_2_i32(uniform("u_corner").as_ref(), face.corner[0] as i32, face.corner[1] as i32);
                gl.draw_arrays(glow::TRIANGLES, 0, 3);
            }
            gl.bind_vertex_array(None);
            gl.bind_texture(glow::TEXTURE_2D, None);
            let faces = map.faces.iter().flatten().count();
            let faces = if map.cube { format!("{faces} of 6 faces of ") } else { String::new() };
            let caption = format!(
                "{faces}{0} × {0} texels, {1:.2} m to {2:.2} m",
                map.side, map.range[0], map.range[1]
            );
            Ok(MapPicture { texture: picture.texture, size, caption })
        }
    }

    /// # Safety
    /// The context is current, and this is not used afterwards.
    pub(crate) unsafe fn delete(&self, gl: &glow::Context) {
        // SAFETY: the caller's.
        unsafe {
            if let Some(program) = &self.program {
                gl.delete_program(program.raw);
            }
            if let Some(vertex_array) = self.vertex_array {
                gl.delete_vertex_array(vertex_array);
            }
            if let Some(picture) = &self.picture {
                picture.delete(gl);
            }
        }
    }
}
