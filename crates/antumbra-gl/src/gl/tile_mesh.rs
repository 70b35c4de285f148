//! The touched tiles of the screen as triangles, for passes that look at the screen again.

use super::{Drawing, UploadRing};
use crate::input::Error;
use crate::screen::TileGrid;
use glow::HasContext;

/// Uploads tiles and draws them; keeps its memory from one pass to the next.
pub(crate) struct TileMesh {
    uploads: UploadRing,
    vertices: Vec<[f32; 2]>,
}

impl TileMesh {
    /// # Safety
    /// A [`super::StateGuard`] is alive: bindings are changed.
    pub(crate) unsafe fn new(gl: &glow::Context) -> Result<Self, Error> {
        // SAFETY: the caller's.
        let uploads = unsafe { UploadRing::new(gl, size_of::<[f32; 2]>() as i32)? };
        Ok(Self { uploads, vertices: Vec::new() })
    }

    /// Uploads the touched tiles and binds them; false, and nothing done, if there are none.
    ///
    /// # Safety
    /// As for [`Self::new`].
    pub(crate) unsafe fn bind(&mut self, drawing: &Drawing<'_>, tiles: &TileGrid) -> Result<bool, Error> {
        self.vertices.clear();
        tiles.triangles(&mut self.vertices);
        if self.vertices.is_empty() {
            return Ok(false);
        }
        let bytes = bytemuck::cast_slice(&self.vertices);
        // SAFETY: the caller's.
        unsafe {
            let upload = self.uploads.upload(drawing.gl, drawing.caps, bytes, &mut Vec::new())?;
            drawing.gl.bind_vertex_array(Some(upload.vertex_array));
        }
        Ok(true)
    }

    /// Draws the tiles that were bound last.
    ///
    /// # Safety
    /// [`Self::bind`] was the last to bind vertices, and a program that reads them is in use.
    pub(crate) unsafe fn draw(&self, gl: &glow::Context) {
        // SAFETY: the caller's; as many vertices as were uploaded.
        unsafe { gl.draw_arrays(glow::TRIANGLES, 0, self.vertices.len() as i32) };
    }

    /// # Safety
    /// The context is current, and the object is not used afterwards.
    pub(crate) unsafe fn delete(&self, gl: &glow::Context) {
        // SAFETY: the caller's.
        unsafe { self.uploads.delete(gl) };
    }
}
