//! Vertex buffers for volumes.

use super::packer::Vertex;
use crate::input::{Error, Resource, Unsupported};
use glow::HasContext;
use std::mem::offset_of;

/// Uploads in flight, so that a batch does not wait for the one before it to be drawn.
const UPLOADS: usize = 3;

#[derive(Clone, Copy)]
struct Upload {
    vertex_array: glow::VertexArray,
    buffer: glow::Buffer,
}

/// A few vertex buffers that take turns.
pub(super) struct VolumeBuffers {
    uploads: Vec<Upload>,
    next: usize,
    bytes: usize,
}

impl VolumeBuffers {
    /// Empty storage.
    ///
    /// # Safety
    /// A [`crate::gl::StateGuard`] is alive: bindings are changed.
    pub(super) unsafe fn new(gl: &glow::Context) -> Result<Self, Error> {
        let mut buffers = Self { uploads: Vec::with_capacity(UPLOADS), next: 0, bytes: 0 };
        for _ in 0..UPLOADS {
            // SAFETY: the caller's; what was made is deleted if the next one cannot be.
            unsafe {
                match Upload::new(gl) {
                    Ok(upload) => buffers.uploads.push(upload),
                    Err(error) => {
                        buffers.delete(gl);
                        return Err(error);
                    }
                }
            }
        }
        Ok(buffers)
    }

    /// Uploads vertices into the next buffer; all double when they are too small, so that none has to in a later
    /// frame.
    ///
    /// # Safety
    /// A [`crate::gl::StateGuard`] is alive: bindings are changed.
    pub(super) unsafe fn upload(
        &mut self,
        gl: &glow::Context,
        vertices: &[Vertex],
    ) -> Result<glow::VertexArray, Error> {
        let bytes: &[u8] = bytemuck::cast_slice(vertices);
        // SAFETY: the caller's; the slice fits.
        unsafe {
            if bytes.len() > self.bytes {
                let size = bytes.len().checked_next_power_of_two().and_then(|size| i32::try_from(size).ok());
                let Some(size) = size else {
                    return Err(Error::Unsupported(Unsupported::ManyPolygons));
                };
                self.bytes = size as usize;
                for upload in &self.uploads {
                    gl.bind_buffer(glow::ARRAY_BUFFER, Some(upload.buffer));
                    gl.buffer_data_size(glow::ARRAY_BUFFER, size, glow::STREAM_DRAW);
                }
            }
            let upload = self.uploads[self.next];
            self.next = (self.next + 1) % UPLOADS;
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(upload.buffer));
            gl.buffer_sub_data_u8_slice(glow::ARRAY_BUFFER, 0, bytes);
            Ok(upload.vertex_array)
        }
    }

    /// # Safety
    /// The context is current, and the buffers are not used afterwards.
    pub(super) unsafe fn delete(&mut self, gl: &glow::Context) {
        for upload in self.uploads.drain(..) {
            // SAFETY: the caller's.
            unsafe {
                gl.delete_vertex_array(upload.vertex_array);
                gl.delete_buffer(upload.buffer);
            }
        }
    }
}

impl Upload {
    unsafe fn new(gl: &glow::Context) -> Result<Self, Error> {
        let refused = || Error::Resource(Resource::Vertices);
        let stride = size_of::<Vertex>() as i32;
        // SAFETY: a guard is alive; the attributes are the vertex's fields.
        unsafe {
            let vertex_array = gl.create_vertex_array().map_err(|_| refused())?;
            let Ok(buffer) = gl.create_buffer() else {
                gl.delete_vertex_array(vertex_array);
                return Err(refused());
            };
            gl.bind_vertex_array(Some(vertex_array));
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(buffer));
            let floats = [
                (0, 3, offset_of!(Vertex, position)),
                (1, 4, offset_of!(Vertex, plane)),
                (2, 2, offset_of!(Vertex, lift)),
            ];
            for (attribute, count, offset) in floats {
                gl.enable_vertex_attrib_array(attribute);
                gl.vertex_attrib_pointer_f32(attribute, count, glow::FLOAT, false, stride, offset as i32);
            }
            gl.enable_vertex_attrib_array(3);
            gl.vertex_attrib_pointer_i32(3, 1, glow::UNSIGNED_INT, stride, offset_of!(Vertex, id) as i32);
            Ok(Self { vertex_array, buffer })
        }
    }
}
