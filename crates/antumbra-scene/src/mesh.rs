//! Meshes from files, each found and read once.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::limits::MAX_MESH_ELEMENTS;
use crate::mesh_builder::{Builder, MeshError, read_file};
use crate::text::quoted;
use crate::{Mesh, mesh_gltf, mesh_obj};

/// The meshes of one scene: each file is read once, and all of them share a limit on size.
pub(crate) struct Meshes<'a> {
    folder: Option<&'a Path>,
    /// Whether files are read.
    read: bool,
    loaded: HashMap<String, Arc<Mesh>>,
    vertices_left: usize,
    triangles_left: usize,
}

impl<'a> Meshes<'a> {
    /// Meshes whose paths are relative to where `scene_file` is.
    pub(crate) fn beside(scene_file: &'a Path) -> Self {
        Self {
            folder: scene_file.parent(),
            read: true,
            loaded: HashMap::new(),
            vertices_left: MAX_MESH_ELEMENTS,
            triangles_left: MAX_MESH_ELEMENTS,
        }
    }

    /// Meshes that are not read: their paths are checked as far as the text tells, and they are empty.
    pub(crate) fn unread() -> Self {
        Self { read: false, ..Self::beside(Path::new("")) }
    }

    /// The mesh at `path`, as the scene file wrote it.
    pub(crate) fn load(&mut self, path: &str) -> Result<Arc<Mesh>, MeshError> {
        if let Some(mesh) = self.loaded.get(path) {
            return Ok(Arc::clone(mesh));
        }
        let file: PathBuf = self.folder.map_or_else(|| path.into(), |folder| folder.join(path));
        let extension = file.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
        let mut builder = Builder::new(self.vertices_left, self.triangles_left);
        match extension.as_str() {
            "obj" | "gltf" | "glb" if !self.read => {
                let mesh = Mesh { path: path.to_owned(), positions: Vec::new(), triangles: Vec::new() };
                return Ok(Arc::new(mesh));
            }
            "obj" => mesh_obj::read(&read_file(&file)?, &mut builder)?,
            "gltf" | "glb" => mesh_gltf::read(&read_file(&file)?, file.parent(), &mut builder)?,
            _ => {
                return Err(MeshError::new(
                    format!("has the extension {}, which no mesh format has", quoted(&extension)),
                    "write the path of an .obj, .gltf or .glb file",
                ));
            }
        }
        let mesh = Arc::new(builder.finish(path)?);
        self.vertices_left -= mesh.positions.len();
        self.triangles_left -= mesh.triangles.len();
        self.loaded.insert(path.to_owned(), Arc::clone(&mesh));
        Ok(mesh)
    }
}
