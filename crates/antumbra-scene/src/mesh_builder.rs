//! A mesh on its way from a file: what every mesh must be.

use std::io::Read;
use std::path::Path;

use glam::DVec3;

use crate::Mesh;
use crate::limits::{MAX_COORDINATE, MAX_MESH_BYTES, MAX_MESH_ELEMENTS};
use crate::text::{one_line, shortened_path};
use crate::values::plain;

/// What is wrong with a mesh: the second half of a sentence that begins with its path.
#[derive(Debug)]
pub(crate) struct MeshError {
    pub(crate) what: String,
    pub(crate) instead: String,
}

impl MeshError {
    pub(crate) fn new(what: impl Into<String>, instead: impl Into<String>) -> Self {
        Self { what: what.into(), instead: instead.into() }
    }

    /// A file whose content is not what its format says.
    pub(crate) fn malformed(what: impl core::fmt::Display) -> Self {
        Self::new(
            format!("is malformed: {}", one_line(what.to_string().trim_end_matches([';', ' ']))),
            "write the mesh again with the program that made it",
        )
    }

    /// More of something than the limits allow.
    pub(crate) fn too_large(what: impl core::fmt::Display) -> Self {
        Self::new(format!("is too large: {what}"), "use a coarser mesh")
    }
}

/// The bytes of a mesh's file. Only regular files: a pipe or device may never end.
pub(crate) fn read_file(path: &Path) -> Result<Vec<u8>, MeshError> {
    let shown = shortened_path(&path.to_string_lossy());
    let unreadable = |error: &dyn core::fmt::Display| {
        MeshError::new(
            format!("cannot be read from {shown}: {}", one_line(&error.to_string())),
            "write a path relative to the scene file",
        )
    };
    // Looked at before it is opened, because opening a pipe waits for its other end.
    let about = std::fs::metadata(path).map_err(|e| unreadable(&e))?;
    if !about.is_file() {
        return Err(unreadable(&"it is not a regular file"));
    }
    if about.len() > MAX_MESH_BYTES {
        return Err(MeshError::too_large(format!(
            "{shown} has {} bytes, more than {MAX_MESH_BYTES}",
            about.len()
        )));
    }
    let mut bytes = Vec::new();
    std::fs::File::open(path)
        .and_then(|file| file.take(MAX_MESH_BYTES).read_to_end(&mut bytes))
        .map_err(|e| unreadable(&e))?;
    Ok(bytes)
}

/// A mesh as it is being read, within the limits.
pub(crate) struct Builder {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    max_vertices: usize,
    max_triangles: usize,
}

impl Builder {
    /// A mesh of at most so many vertices and triangles.
    pub(crate) fn new(max_vertices: usize, max_triangles: usize) -> Self {
        Self { positions: Vec::new(), triangles: Vec::new(), max_vertices, max_triangles }
    }

    /// How many vertices there are; the index of the next one.
    pub(crate) fn vertices(&self) -> usize {
        self.positions.len()
    }

    /// Refuses so many more vertices and triangles if they would pass the limits. Called before any
    /// memory is taken for them.
    pub(crate) fn expect(&self, vertices: usize, triangles: usize) -> Result<(), MeshError> {
        for (there, more, most, what) in [
            (self.positions.len(), vertices, self.max_vertices, "vertices"),
            (self.triangles.len(), triangles, self.max_triangles, "triangles"),
        ] {
            if more > most.saturating_sub(there) {
                return Err(MeshError::too_large(format!(
                    "it takes the scene past {MAX_MESH_ELEMENTS} {what} in all meshes"
                )));
            }
        }
        Ok(())
    }

    /// Adds a vertex, metres.
    pub(crate) fn vertex(&mut self, position: DVec3) -> Result<(), MeshError> {
        self.expect(1, 0)?;
        let bad = |what: &str, instead: &str| {
            let [x, y, z] = position.to_array().map(plain);
            Err(MeshError::new(format!("has the vertex ({x}, {y}, {z}), which is {what}"), instead))
        };
        if !position.is_finite() {
            return bad("not finite", "write numbers there, or the mesh again with the program that made it");
        }
        if position.abs().max_element() > MAX_COORDINATE {
            return bad(&format!("beyond {}", plain(MAX_COORDINATE)), "scale the mesh to metres");
        }
        self.positions.push(position);
        Ok(())
    }

    /// Adds a triangle of vertices that are there already.
    pub(crate) fn triangle(&mut self, corners: [u32; 3]) -> Result<(), MeshError> {
        self.expect(0, 1)?;
        if let Some(bad) = corners.iter().find(|i| **i as usize >= self.positions.len()) {
            return Err(MeshError::malformed(format!(
                "a triangle has vertex {bad}, but there are {}",
                self.positions.len()
            )));
        }
        self.triangles.push(corners);
        Ok(())
    }

    /// The mesh, without the triangles that have no area: they cast and catch nothing.
    pub(crate) fn finish(mut self, path: &str) -> Result<Mesh, MeshError> {
        let positions = &self.positions;
        self.triangles.retain(|corners| {
            let [a, b, c] = corners.map(|i| positions[i as usize]);
            (b - a).cross(c - a).length_squared() > 0.0
        });
        if self.triangles.is_empty() {
            return Err(MeshError::new("has no triangle with an area", "write a file with at least one"));
        }
        Ok(Mesh { path: path.to_owned(), positions: self.positions, triangles: self.triangles })
    }
}
