//! glTF 2.0, .gltf and .glb: the triangles of the default scene, every node's transform applied.
//!
//! The crate `gltf` reads and validates the document; the accessors are read here, because a mesh
//! file may lie about strides, offsets and counts and must get an error for it. Skins, morph
//! targets, materials, cameras and lights are passed over; points and lines have no area.

use std::path::Path;

use base64::Engine;
use glam::{DMat4, DQuat, DVec3};
use gltf::json::Root;
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::scene::Node;
use gltf::json::validation::Checked;

use crate::limits::MAX_MESH_BYTES;
use crate::mesh_builder::{Builder, MeshError, read_file};
use crate::text::quoted;

/// Adds the triangles of a glTF file to `mesh`. `folder` is where its buffers are looked for.
pub(crate) fn read(bytes: &[u8], folder: Option<&Path>, mesh: &mut Builder) -> Result<(), MeshError> {
    // The header of a .glb is 12 bytes and says so; the parser subtracts 12 unchecked.
    if bytes.starts_with(b"glTF") {
        let said = bytes.get(8..12).and_then(|b| b.try_into().ok()).map_or(0, u32::from_le_bytes);
        if said < 12 {
            return Err(MeshError::malformed(format!("its header says that it has {said} bytes")));
        }
    }
    let gltf::Gltf { document, blob } =
        gltf::Gltf::from_slice_without_validation(bytes).map_err(MeshError::malformed)?;
    let document = validated(document.into_json())?;
    let root = document.as_json();
    let buffers = Buffers::load(root, blob, folder)?;
    // The default scene, or the first, or every node where there is no scene.
    let scene = root.scene.map_or(0, |index| index.value());
    let roots: Vec<usize> = match root.scenes.get(scene) {
        Some(scene) => scene.nodes.iter().map(|n| n.value()).collect(),
        None => {
            let mut is_child = vec![false; root.nodes.len()];
            for child in root.nodes.iter().flat_map(|n| n.children.iter().flatten()) {
                if let Some(mark) = is_child.get_mut(child.value()) {
                    *mark = true;
                }
            }
            (0..root.nodes.len()).filter(|i| !is_child[*i]).collect()
        }
    };
    let mut seen = vec![false; root.nodes.len()];
    let mut open: Vec<(usize, DMat4)> = roots.into_iter().rev().map(|n| (n, DMat4::IDENTITY)).collect();
    while let Some((index, parent)) = open.pop() {
        let node =
            root.nodes.get(index).ok_or_else(|| MeshError::malformed(format!("there is no node {index}")))?;
        // Nodes form trees, so none is reached twice; a cycle would be.
        if core::mem::replace(&mut seen[index], true) {
            return Err(MeshError::malformed(format!("node {index} has two parents or is in a cycle")));
        }
        let to_world = parent * transform(node);
        for primitive in
            node.mesh.iter().filter_map(|m| root.meshes.get(m.value())).flat_map(|m| &m.primitives)
        {
            triangles(root, &buffers, primitive, to_world, mesh)?;
        }
        open.extend(node.children.iter().flatten().rev().map(|child| (child.value(), to_world)));
    }
    Ok(())
}

/// Extensions that a file may require and that change no triangle.
const HARMLESS: [&str; 8] = [
    "KHR_materials_",
    "KHR_texture_",
    "EXT_texture_",
    "MSFT_texture_",
    "KHR_technique_webgl",
    "KHR_techniques_webgl",
    "KHR_lights_punctual",
    "KHR_xmp",
];

/// The document, valid: every index in it is in range, and no extension is required that may change what
/// its triangles are.
fn validated(mut root: Root) -> Result<gltf::Document, MeshError> {
    // The validator takes this one index for granted (gltf-json 1.4.1, `primitive_validate_hook`).
    let mut primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let positions = |p: &Primitive| p.attributes.get(&Checked::Valid(Semantic::Positions)).map(|i| i.value());
    if primitives.any(|p| positions(p).is_some_and(|i| i >= root.accessors.len())) {
        return Err(MeshError::malformed("a primitive has positions in an accessor that is not there"));
    }
    root.extensions_required.retain(|name| !HARMLESS.iter().any(|start| name.starts_with(start)));
    if let Some(name) = root.extensions_required.first() {
        return Err(MeshError::new(
            format!("requires the extension {}, which is not read", quoted(name)),
            "export the mesh without it, for example uncompressed",
        ));
    }
    gltf::Document::from_json(root).map_err(|error| match &error {
        // One line for each thing wrong may be thousands.
        gltf::Error::Validation(all) if all.len() > 1 => {
            let first = &all[0];
            MeshError::malformed(format!("{}: {}, and {} more", first.0, first.1, all.len() - 1))
        }
        _ => MeshError::malformed(error),
    })
}

/// From the node to its parent.
fn transform(node: &Node) -> DMat4 {
    if let Some(m) = node.matrix {
        return DMat4::from_cols_array(&m.map(f64::from));
    }
    let vector = |v: Option<[f32; 3]>, default| v.map_or(default, |v| DVec3::from_array(v.map(f64::from)));
    // float32 quaternions of length nearly 1; the zero quaternion, which is none, turns nothing.
    let rotation = node.rotation.as_ref().map_or(DQuat::IDENTITY, |q| DQuat::from_array(q.0.map(f64::from)));
    let rotation = if rotation.length() > 0.0 { rotation.normalize() } else { DQuat::IDENTITY };
    DMat4::from_scale_rotation_translation(
        vector(node.scale, DVec3::ONE),
        rotation,
        vector(node.translation, DVec3::ZERO),
    )
}

/// Adds the triangles of one primitive.
fn triangles(
    root: &Root,
    buffers: &Buffers,
    primitive: &Primitive,
    to_world: DMat4,
    mesh: &mut Builder,
) -> Result<(), MeshError> {
    let Checked::Valid(mode) = primitive.mode else {
        return Err(MeshError::malformed("a primitive has an unknown mode"));
    };
    if matches!(mode, Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip) {
        return Ok(());
    }
    let Some(positions) = primitive.attributes.get(&Checked::Valid(Semantic::Positions)) else {
        return Ok(());
    };
    let first = mesh.vertices();
    let count = count_of(root, positions.value())?;
    mesh.expect(count, 0)?;
    for p in buffers.accessor(root, positions.value(), Type::Vec3, &[ComponentType::F32])?.chunks_exact(12) {
        let part = |i: usize| p[i..].first_chunk().map_or(0.0, |b| f64::from(f32::from_le_bytes(*b)));
        mesh.vertex(to_world.transform_point3(DVec3::new(part(0), part(4), part(8))))?;
    }
    let indices: Vec<u32> = match primitive.indices {
        Some(index) => {
            let corners = count_of(root, index.value())?;
            mesh.expect(0, corners / 3)?;
            buffers.indices(root, index.value())?
        }
        None => (0..count as u32).collect(),
    };
    let mirrored = to_world.determinant() < 0.0;
    let mut add = |[a, b, c]: [u32; 3]| -> Result<(), MeshError> {
        // What a transform mirrors keeps its front (glTF 2.0, section 3.7.4).
        let corners = if mirrored { [a, c, b] } else { [a, b, c] };
        if let Some(bad) = corners.iter().find(|i| **i as usize >= count) {
            return Err(MeshError::malformed(format!("a triangle has vertex {bad}, but there are {count}")));
        }
        // Both are far below 2^32: the limit on vertices is 2^24.
        mesh.triangle(corners.map(|i| i + first as u32))
    };
    match mode {
        // Every other triangle of a strip runs the other way.
        Mode::TriangleStrip => indices.windows(3).enumerate().try_for_each(|(i, w)| {
            if i % 2 == 0 { add([w[0], w[1], w[2]]) } else { add([w[0], w[2], w[1]]) }
        }),
        Mode::TriangleFan => match indices.split_first() {
            Some((center, rim)) => rim.windows(2).try_for_each(|w| add([*center, w[0], w[1]])),
            None => Ok(()),
        },
        _ => indices.chunks_exact(3).try_for_each(|c| add([c[0], c[1], c[2]])),
    }
}

/// How many elements an accessor says it has.
fn count_of(root: &Root, accessor: usize) -> Result<usize, MeshError> {
    let count = root.accessors.get(accessor).and_then(|a| usize::try_from(a.count.0).ok());
    count.ok_or_else(|| MeshError::malformed(format!("there is no accessor {accessor}")))
}

/// The buffers of a document.
struct Buffers(Vec<Vec<u8>>);

impl Buffers {
    fn load(root: &Root, mut blob: Option<Vec<u8>>, folder: Option<&Path>) -> Result<Self, MeshError> {
        let mut buffers = Vec::new();
        let mut left = MAX_MESH_BYTES;
        for buffer in &root.buffers {
            let bytes = match &buffer.uri {
                None => {
                    blob.take().ok_or_else(|| MeshError::malformed("a buffer has neither uri nor data"))?
                }
                Some(uri) => fetch(uri, folder)?,
            };
            if (bytes.len() as u64) < buffer.byte_length.0 {
                return Err(MeshError::malformed(format!(
                    "a buffer of {} bytes has only {}",
                    buffer.byte_length.0,
                    bytes.len()
                )));
            }
            left = left.checked_sub(bytes.len() as u64).ok_or_else(|| {
                MeshError::too_large(format!("its buffers have more than {MAX_MESH_BYTES} bytes"))
            })?;
            buffers.push(bytes);
        }
        Ok(Self(buffers))
    }

    /// `count` elements of `size` bytes each, packed, from a view.
    fn packed(
        &self,
        root: &Root,
        view: usize,
        offset: u64,
        count: usize,
        size: usize,
    ) -> Result<Vec<u8>, MeshError> {
        let outside =
            || MeshError::malformed(format!("buffer view {view} is shorter than what is read from it"));
        let view_json = root.buffer_views.get(view).ok_or_else(outside)?;
        let start = usize::try_from(view_json.byte_offset.map_or(0, |o| o.0)).map_err(|_| outside())?;
        let length = usize::try_from(view_json.byte_length.0).map_err(|_| outside())?;
        let bytes = self.0.get(view_json.buffer.value()).ok_or_else(outside)?;
        let bytes = bytes.get(start..).and_then(|b| b.get(..length)).ok_or_else(outside)?;
        let stride = view_json.byte_stride.as_ref().map_or(size, |s| if s.0 == 0 { size } else { s.0 });
        let offset = usize::try_from(offset).map_err(|_| outside())?;
        // Nothing is allocated before the last element is known to be there, and a stride below the
        // size reads no byte more than `count` times.
        let last =
            count.checked_sub(1).and_then(|n| n.checked_mul(stride)).and_then(|n| n.checked_add(offset));
        let Some(last) = last else {
            return if count == 0 { Ok(Vec::new()) } else { Err(outside()) };
        };
        if stride == 0 || bytes.get(last..).is_none_or(|b| b.len() < size) {
            return Err(outside());
        }
        let mut packed = Vec::with_capacity(count.saturating_mul(size));
        for element in 0..count {
            packed.extend_from_slice(&bytes[offset + element * stride..][..size]);
        }
        Ok(packed)
    }

    /// The elements of an accessor, packed, little-endian. It must be of `kind` and one of
    /// `components`. The count is within the limits: the caller has checked.
    fn accessor(
        &self,
        root: &Root,
        index: usize,
        kind: Type,
        components: &[ComponentType],
    ) -> Result<Vec<u8>, MeshError> {
        let count = count_of(root, index)?;
        let accessor = &root.accessors[index];
        let component = match accessor.component_type {
            Checked::Valid(c) if components.contains(&c.0) && accessor.type_ == Checked::Valid(kind) => c.0,
            _ => {
                return Err(MeshError::malformed(format!("accessor {index} has the wrong type for its use")));
            }
        };
        let size = component.size() * kind.multiplicity();
        let mut elements = match accessor.buffer_view {
            Some(view) => {
                self.packed(root, view.value(), accessor.byte_offset.map_or(0, |o| o.0), count, size)?
            }
            None => vec![0; count.saturating_mul(size)],
        };
        let Some(sparse) = &accessor.sparse else { return Ok(elements) };
        let changes = usize::try_from(sparse.count.0).unwrap_or(usize::MAX);
        if changes > count {
            return Err(MeshError::malformed(format!("accessor {index} replaces more elements than it has")));
        }
        let Checked::Valid(index_type) = sparse.indices.component_type else {
            return Err(MeshError::malformed(format!(
                "accessor {index} has sparse indices of no known type"
            )));
        };
        let width = index_type.0.size();
        let (at, of) = (&sparse.indices, &sparse.values);
        let indices = self.packed(root, at.buffer_view.value(), at.byte_offset.0, changes, width)?;
        let values = self.packed(root, of.buffer_view.value(), of.byte_offset.0, changes, size)?;
        for (to, value) in indices.chunks_exact(width).zip(values.chunks_exact(size)) {
            let to = little_endian(to) as usize;
            let place = elements.chunks_exact_mut(size).nth(to).ok_or_else(|| {
                MeshError::malformed(format!("accessor {index} replaces element {to}, which it has not"))
            })?;
            place.copy_from_slice(value);
        }
        Ok(elements)
    }

    /// The indices in an accessor.
    fn indices(&self, root: &Root, index: usize) -> Result<Vec<u32>, MeshError> {
        let kinds = [ComponentType::U8, ComponentType::U16, ComponentType::U32];
        let bytes = self.accessor(root, index, Type::Scalar, &kinds)?;
        let count = count_of(root, index)?.max(1);
        Ok(bytes.chunks_exact((bytes.len() / count).max(1)).map(little_endian).collect())
    }
}

/// An unsigned integer of one to four bytes.
fn little_endian(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |value, byte| value << 8 | u32::from(*byte))
}

/// The bytes that a buffer's uri refers to: in the uri itself, or in a file beside the mesh.
fn fetch(uri: &str, folder: Option<&Path>) -> Result<Vec<u8>, MeshError> {
    if let Some(data) = uri.strip_prefix("data:") {
        let Some((_, base64)) = data.split_once(";base64,") else {
            return Err(MeshError::malformed("a data uri is not in base64"));
        };
        return base64::engine::general_purpose::STANDARD
            .decode(base64)
            .map_err(|e| MeshError::malformed(format!("a data uri is not in base64: {e}")));
    }
    let path = percent_encoding::percent_decode_str(uri).decode_utf8_lossy();
    if uri.contains(':') || Path::new(&*path).is_absolute() {
        return Err(MeshError::new(
            format!("refers to {}, which is not beside it", quoted(uri)),
            "keep the buffers of a glTF file in its folder, or embed them",
        ));
    }
    read_file(&folder.map_or_else(|| Path::new(&*path).to_owned(), |folder| folder.join(&*path)))
        .map_err(|e| MeshError::new(format!("refers to a file that {}", e.what), "put its buffers beside it"))
}
