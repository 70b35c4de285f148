//! Triangles on the GPU, one buffer for each shape that is drawn, kept while it is.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use antumbra::glam::DVec3;
use antumbra_scene::Shape;
use glow::HasContext;

use crate::HostError;
use crate::meshes::Key;
use crate::surface::{Corner, Triangles};

/// The buffers of the shapes that were drawn last.
#[derive(Default)]
pub(crate) struct Buffers {
    of: HashMap<Key, Buffer>,
}

/// One shape's triangles.
pub(crate) struct Buffer {
    pub(crate) vertex_array: glow::VertexArray,
    buffer: glow::Buffer,
    /// Corners to draw.
    pub(crate) count: i32,
    /// Of the corners, in the shape's space.
    pub(crate) origin: DVec3,
}

impl Buffers {
    /// Makes what is missing for these shapes and deletes what none of them needs.
    pub(crate) fn prepare<'a>(
        &mut self,
        gl: &glow::Context,
        shapes: impl Iterator<Item = &'a Shape>,
    ) -> Result<(), HostError> {
        let needed: HashMap<Key, &Shape> =
            shapes.filter_map(|shape| Some((Key::new(shape)?, shape))).collect();
        self.of.retain(|key, buffer| {
            let keep = needed.contains_key(key);
            if !keep {
                // SAFETY: made in this context, and forgotten here.
                unsafe { buffer.delete(gl) };
            }
            keep
        });
        for (key, shape) in needed {
            if let Entry::Vacant(vacant) = self.of.entry(key) {
                vacant.insert(Buffer::new(gl, shape)?);
            }
        }
        Ok(())
    }

    /// The triangles of a shape that [`Self::prepare`] was called with.
    pub(crate) fn get(&self, shape: &Shape) -> Option<&Buffer> {
        self.of.get(&Key::new(shape)?)
    }

    /// # Safety
    /// In the context that they were made in.
    pub(crate) unsafe fn delete(&mut self, gl: &glow::Context) {
        for (_, buffer) in self.of.drain() {
            // SAFETY: the caller's.
            unsafe { buffer.delete(gl) };
        }
    }
}

impl Buffer {
    fn new(gl: &glow::Context, shape: &Shape) -> Result<Self, HostError> {
        let triangles = Triangles::new(shape);
        let count = i32::try_from(triangles.corners.len())
            .map_err(|_| HostError::BadRequest("a mesh has too many triangles to draw".into()))?;
        // SAFETY: fresh objects; the attributes are laid out as `Corner` is, in a buffer of such.
        unsafe {
            let vertex_array = gl.create_vertex_array().map_err(HostError::Driver)?;
            let buffer = gl.create_buffer().map_err(|e| {
                gl.delete_vertex_array(vertex_array);
                HostError::Driver(e)
            })?;
            gl.bind_vertex_array(Some(vertex_array));
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(buffer));
            let bytes = bytemuck::cast_slice(&triangles.corners);
            gl.buffer_data_u8_slice(glow::ARRAY_BUFFER, bytes, glow::STATIC_DRAW);
            let mut offset = 0;
            for (location, floats) in (0..).zip([3, 3, 3, 4]) {
                gl.enable_vertex_attrib_array(location);
                let stride = size_of::<Corner>() as i32;
                gl.vertex_attrib_pointer_f32(location, floats, glow::FLOAT, false, stride, offset);
                offset += floats * size_of::<f32>() as i32;
            }
            gl.bind_buffer(glow::ARRAY_BUFFER, None);
            gl.bind_vertex_array(None);
            Ok(Self { vertex_array, buffer, count, origin: triangles.origin })
        }
    }

    /// # Safety
    /// In the context that it was made in, and not used afterwards.
    unsafe fn delete(&self, gl: &glow::Context) {
        // SAFETY: the caller's.
        unsafe {
            gl.delete_vertex_array(self.vertex_array);
            gl.delete_buffer(self.buffer);
        }
    }
}
