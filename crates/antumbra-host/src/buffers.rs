//! Triangles on the GPU, one buffer for each shape that is drawn, kept while it is.

use std::collections::HashMap;
use std::sync::Arc;

use antumbra::glam::DVec3;
use antumbra_scene::{Mesh, Shape};
use glow::HasContext;

use crate::HostError;
use crate::surface::{Corner, Triangles};

/// What tells shapes apart: the kind, and the bits of the sizes or where the mesh is in memory.
type Key = [u64; 4];

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
    /// Held, so that no other mesh comes to lie where this one is.
    _mesh: Option<Arc<Mesh>>,
}

/// Of a shape that is drawn as triangles; `None` for the others.
fn key(shape: &Shape) -> Option<Key> {
    let bits = |kind, sizes: [f64; 3]| {
        let [a, b, c] = sizes.map(f64::to_bits);
        Some([kind, a, b, c])
    };
    match *shape {
        Shape::Ellipsoid { radii } => bits(0, radii.to_array()),
        Shape::Cylinder { radius, height, radius_top } => bits(1, [radius, height, radius_top]),
        Shape::Capsule { radius, height } => bits(2, [radius, height, 0.0]),
        Shape::Box { size } => bits(3, size.to_array()),
        Shape::Torus { major_radius, minor_radius } => bits(4, [major_radius, minor_radius, 0.0]),
        Shape::Mesh(ref mesh) => Some([5, Arc::as_ptr(mesh).addr() as u64, 0, 0]),
        Shape::Plane
        | Shape::Rectangle { .. }
        | Shape::Disc { .. }
        | Shape::Triangle { .. }
        | Shape::Sphere { .. }
        | Shape::Cone { .. } => None,
    }
}

impl Buffers {
    /// Makes what is missing for these shapes and deletes what none of them needs.
    pub(crate) fn prepare<'a>(
        &mut self,
        gl: &glow::Context,
        shapes: impl Iterator<Item = &'a Shape>,
    ) -> Result<(), HostError> {
        let needed: HashMap<Key, &Shape> = shapes.filter_map(|shape| Some((key(shape)?, shape))).collect();
        self.of.retain(|key, buffer| {
            let keep = needed.contains_key(key);
            if !keep {
                // SAFETY: made in this context, and forgotten here.
                unsafe { buffer.delete(gl) };
            }
            keep
        });
        for (key, shape) in needed {
            if let std::collections::hash_map::Entry::Vacant(vacant) = self.of.entry(key) {
                vacant.insert(Buffer::new(gl, shape)?);
            }
        }
        Ok(())
    }

    /// The triangles of a shape that [`Self::prepare`] was called with.
    pub(crate) fn get(&self, shape: &Shape) -> Option<&Buffer> {
        self.of.get(&key(shape)?)
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
            let mesh = if let Shape::Mesh(mesh) = shape { Some(Arc::clone(mesh)) } else { None };
            Ok(Self { vertex_array, buffer, count, origin: triangles.origin, _mesh: mesh })
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
