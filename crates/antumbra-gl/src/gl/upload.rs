//! Vertices and data of a batch on their way to the driver: made when first needed, grown, never made in a steady frame.

use super::Caps;
use super::storage::texture_storage;
use crate::input::{Error, Resource, Unsupported};
use glow::HasContext;

/// Texels in a row of a data texture.
const ROW: usize = 1024;

/// Vertices and blocker data of one batch.
pub(crate) struct Upload {
    pub(crate) vertex_array: glow::VertexArray,
    pub(crate) texture: glow::Texture,
    buffer: glow::Buffer,
    buffer_bytes: usize,
    rows: usize,
}

impl Upload {
    /// Empty storage; `stride` is the vertex's: two floats, then, in vertices of 16 bytes, two unsigned integers.
    ///
    /// # Safety
    /// A [`super::StateGuard`] is alive: bindings are changed.
    unsafe fn new(gl: &glow::Context, stride: i32) -> Result<Self, Error> {
        // SAFETY: the caller's; every object is deleted if the next one cannot be made.
        unsafe {
            let vertex_array = gl.create_vertex_array().map_err(|_| Error::Resource(Resource::Vertices))?;
            let Ok(buffer) = gl.create_buffer() else {
                gl.delete_vertex_array(vertex_array);
                return Err(Error::Resource(Resource::Vertices));
            };
            let Ok(texture) = gl.create_texture() else {
                gl.delete_vertex_array(vertex_array);
                gl.delete_buffer(buffer);
                return Err(Error::Resource(Resource::Data));
            };
            gl.bind_vertex_array(Some(vertex_array));
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(buffer));
            gl.enable_vertex_attrib_array(0);
            gl.vertex_attrib_pointer_f32(0, 2, glow::FLOAT, false, stride, 0);
            if stride >= 16 {
                gl.enable_vertex_attrib_array(1);
                gl.vertex_attrib_pointer_i32(1, 2, glow::UNSIGNED_INT, stride, 8);
            }
            Ok(Self { vertex_array, texture, buffer, buffer_bytes: 0, rows: 0 })
        }
    }

    /// Makes room for that many bytes of vertices and rows of texels: storage doubles when it is
    /// too small.
    ///
    /// # Safety
    /// A [`super::StateGuard`] is alive: bindings are changed.
    unsafe fn reserve(
        &mut self,
        gl: &glow::Context,
        caps: &Caps,
        bytes: usize,
        texels: usize,
    ) -> Result<(), Error> {
        let rows = texels.div_ceil(ROW).max(1);
        if rows > caps.max_texture_size as usize {
            return Err(Error::Unsupported(Unsupported::ManyOccluders));
        }
        // SAFETY: the caller's; sizes are within the driver's limits.
        unsafe {
            if bytes > self.buffer_bytes {
                self.buffer_bytes = bytes.next_power_of_two();
                gl.bind_buffer(glow::ARRAY_BUFFER, Some(self.buffer));
                gl.buffer_data_size(glow::ARRAY_BUFFER, self.buffer_bytes as i32, glow::STREAM_DRAW);
            }
            if texels > 0 && rows > self.rows {
                self.rows = rows.next_power_of_two().min(caps.max_texture_size as usize);
                gl.bind_texture(glow::TEXTURE_2D, Some(self.texture));
                texture_storage(gl, glow::RGBA32F, ROW as i32, self.rows as i32);
            }
        }
        Ok(())
    }

    /// Uploads one batch.
    ///
    /// # Safety
    /// A [`super::StateGuard`] is alive: bindings are changed. There is room for the batch.
    unsafe fn fill(&self, gl: &glow::Context, vertices: &[u8], texels: &mut Vec<glam::Vec4>) {
        let rows = texels.len().div_ceil(ROW);
        texels.resize(rows * ROW, glam::Vec4::ZERO);
        // SAFETY: the caller's; the slices outlive the calls, and texels fill whole rows.
        unsafe {
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(self.buffer));
            gl.buffer_sub_data_u8_slice(glow::ARRAY_BUFFER, 0, vertices);
            if texels.is_empty() {
                return;
            }
            gl.bind_texture(glow::TEXTURE_2D, Some(self.texture));
            gl.tex_sub_image_2d(
                glow::TEXTURE_2D,
                0,
                0,
                0,
                ROW as i32,
                rows as i32,
                glow::RGBA,
                glow::FLOAT,
                glow::PixelUnpackData::Slice(Some(bytemuck::cast_slice(texels))),
            );
        }
    }

    /// # Safety
    /// The upload is of this context and not used afterwards.
    pub(crate) unsafe fn delete(&self, gl: &glow::Context) {
        // SAFETY: the caller's.
        unsafe {
            gl.delete_vertex_array(self.vertex_array);
            gl.delete_buffer(self.buffer);
            gl.delete_texture(self.texture);
        }
    }
}

/// Uploads in flight, so that a batch does not wait for the one before it to be drawn.
const UPLOADS: usize = 3;

/// A few [`Upload`]s that take turns.
pub(crate) struct UploadRing {
    uploads: [Upload; UPLOADS],
    next: usize,
}

impl UploadRing {
    /// Empty storage, as [`Upload::new`].
    ///
    /// # Safety
    /// A [`super::StateGuard`] is alive: bindings are changed.
    pub(crate) unsafe fn new(gl: &glow::Context, stride: i32) -> Result<Self, Error> {
        let mut made: Vec<Upload> = Vec::with_capacity(UPLOADS);
        for _ in 0..UPLOADS {
            // SAFETY: the caller's.
            match unsafe { Upload::new(gl, stride) } {
                Ok(upload) => made.push(upload),
                Err(error) => {
                    // SAFETY: made above.
                    made.iter().for_each(|upload| unsafe { upload.delete(gl) });
                    return Err(error);
                }
            }
        }
        let Ok(uploads) = made.try_into() else { unreachable!("as many as the array has") };
        Ok(Self { uploads, next: 0 })
    }

    /// Uploads vertices and texels, which are filled up to whole rows, into the next one.
    ///
    /// # Safety
    /// A [`super::StateGuard`] is alive: bindings are changed.
    pub(crate) unsafe fn upload(
        &mut self,
        gl: &glow::Context,
        caps: &Caps,
        vertices: &[u8],
        texels: &mut Vec<glam::Vec4>,
    ) -> Result<&Upload, Error> {
        // SAFETY: the caller's.
        unsafe {
            // All grow together, so that none has to in a later frame.
            for upload in &mut self.uploads {
                upload.reserve(gl, caps, vertices.len(), texels.len())?;
            }
            let upload = &self.uploads[self.next];
            self.next = (self.next + 1) % UPLOADS;
            upload.fill(gl, vertices, texels);
            Ok(upload)
        }
    }

    /// # Safety
    /// The uploads are of this context and not used afterwards.
    pub(crate) unsafe fn delete(&self, gl: &glow::Context) {
        // SAFETY: the caller's.
        self.uploads.iter().for_each(|upload| unsafe { upload.delete(gl) });
    }
}
