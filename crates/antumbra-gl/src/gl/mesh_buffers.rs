//! Triangle meshes in OpenGL's memory, kept as long as they are used.

use crate::input::{Error, Resource, Unsupported};
use antumbra_math::TriangleMesh;
use glam::DVec3;
use glow::HasContext;
use std::collections::HashMap;

/// Frames that a mesh may go unused before its buffers are deleted: one that blinks is not uploaded each time.
const KEPT_FRAMES: u32 = 60;

/// The vertices and triangles of one mesh.
pub(crate) struct MeshBuffers {
    /// Attribute 0 is the position, the mesh's own space; elements are bound.
    pub(crate) vertex_array: glow::VertexArray,
    /// Elements: `UNSIGNED_INT`, triangles.
    pub(crate) count: i32,
    /// The lowest and the highest coordinates of the triangles' corners.
    pub(crate) bounds: [DVec3; 2],
    buffers: [glow::Buffer; 2],
    unused: u32,
}

impl MeshBuffers {
    /// Draws all triangles.
    ///
    /// # Safety
    /// A [`super::StateGuard`] is alive, a program that reads attribute 0 is in use.
    pub(crate) unsafe fn draw(&self, gl: &glow::Context) {
        // SAFETY: the caller's; the elements are below the number of vertices.
        unsafe {
            gl.bind_vertex_array(Some(self.vertex_array));
            gl.draw_elements(glow::TRIANGLES, self.count, glow::UNSIGNED_INT, 0);
        }
    }

    unsafe fn new(gl: &glow::Context, mesh: &TriangleMesh) -> Result<Self, Error> {
        let triangles = mesh.triangles().len();
        let refused = || Error::Resource(Resource::Mesh { triangles });
        let count = i32::try_from(triangles * 3).map_err(|_| Error::Unsupported(Unsupported::LargeMesh))?;
        let corners = mesh.triangles().as_flattened().iter().map(|&i| mesh.positions()[i as usize]);
        let none = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let bounds = corners.fold(none, |[low, high], p| [low.min(p), high.max(p)]);
        let positions: Vec<[f32; 3]> = mesh.positions().iter().map(|p| p.as_vec3().to_array()).collect();
        // SAFETY: a guard is alive; every object is deleted if the next one cannot be made.
        unsafe {
            let vertex_array = gl.create_vertex_array().map_err(|_| refused())?;
            let Ok(vertices) = gl.create_buffer() else {
                gl.delete_vertex_array(vertex_array);
                return Err(refused());
            };
            let Ok(elements) = gl.create_buffer() else {
                gl.delete_vertex_array(vertex_array);
                gl.delete_buffer(vertices);
                return Err(refused());
            };
            gl.bind_vertex_array(Some(vertex_array));
            gl.bind_buffer(glow::ARRAY_BUFFER, Some(vertices));
            gl.buffer_data_u8_slice(glow::ARRAY_BUFFER, bytemuck::cast_slice(&positions), glow::STATIC_DRAW);
            gl.bind_buffer(glow::ELEMENT_ARRAY_BUFFER, Some(elements));
            let triangles = bytemuck::cast_slice(mesh.triangles());
            gl.buffer_data_u8_slice(glow::ELEMENT_ARRAY_BUFFER, triangles, glow::STATIC_DRAW);
            gl.enable_vertex_attrib_array(0);
            gl.vertex_attrib_pointer_f32(0, 3, glow::FLOAT, false, 12, 0);
            Ok(Self { vertex_array, count, bounds, buffers: [vertices, elements], unused: 0 })
        }
    }

    unsafe fn delete(&self, gl: &glow::Context) {
        // SAFETY: objects of this context that are not used afterwards.
        unsafe {
            gl.delete_vertex_array(self.vertex_array);
            self.buffers.iter().for_each(|&buffer| gl.delete_buffer(buffer));
        }
    }
}

/// The meshes of recent frames, by [`TriangleMesh::id`].
#[derive(Default)]
pub(crate) struct MeshCache {
    meshes: HashMap<u64, MeshBuffers>,
}

impl MeshCache {
    /// A new frame begins: deletes what has not been used for a while.
    ///
    /// # Safety
    /// A [`super::StateGuard`] is alive.
    pub(crate) unsafe fn begin_frame(&mut self, gl: &glow::Context) {
        self.meshes.retain(|_, mesh| {
            mesh.unused += 1;
            if mesh.unused > KEPT_FRAMES {
                // SAFETY: the caller's; it is forgotten here.
                unsafe { mesh.delete(gl) };
            }
            mesh.unused <= KEPT_FRAMES
        });
    }

    /// A mesh's buffers, uploaded if they are not there.
    ///
    /// # Safety
    /// A [`super::StateGuard`] is alive: bindings are changed.
    pub(crate) unsafe fn get(
        &mut self,
        gl: &glow::Context,
        mesh: &TriangleMesh,
    ) -> Result<&MeshBuffers, Error> {
        let buffers = match self.meshes.entry(mesh.id()) {
            std::collections::hash_map::Entry::Occupied(found) => found.into_mut(),
            std::collections::hash_map::Entry::Vacant(empty) => {
                // SAFETY: the caller's.
                let made = unsafe { MeshBuffers::new(gl, mesh)? };
                empty.insert(made)
            }
        };
        buffers.unused = 0;
        Ok(buffers)
    }

    /// # Safety
    /// The context is current, and the meshes are not used afterwards.
    pub(crate) unsafe fn delete(&mut self, gl: &glow::Context) {
        // SAFETY: the caller's.
        self.meshes.drain().for_each(|(_, mesh)| unsafe { mesh.delete(gl) });
    }
}
