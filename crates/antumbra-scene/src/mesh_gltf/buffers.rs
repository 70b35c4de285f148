//! The buffers of a glTF document and what its accessors read from them.
//!
//! The crate `gltf` reads accessors too, but a mesh file may lie about strides, offsets and counts and must get an error
//! for it.

use std::path::Path;

use base64::Engine;
use gltf::json::Root;
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::validation::Checked;

use crate::limits::MAX_MESH_BYTES;
use crate::mesh_builder::{MeshError, read_file};
use crate::text::quoted_path;

/// How many elements an accessor says it has.
pub(super) fn count_of(root: &Root, accessor: usize) -> Result<usize, MeshError> {
    let count = root.accessors.get(accessor).and_then(|a| usize::try_from(a.count.0).ok());
    count.ok_or_else(|| MeshError::malformed(format!("there is no accessor {accessor}")))
}

/// The buffers of a document.
pub(super) struct Buffers(Vec<Vec<u8>>);

impl Buffers {
    /// Those of a document, from the binary chunk, the document itself and files in `folder`.
    pub(super) fn load(
        root: &Root,
        mut blob: Option<Vec<u8>>,
        folder: Option<&Path>,
    ) -> Result<Self, MeshError> {
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

    /// The elements of an accessor as numbers; otherwise as [`Buffers::accessor`].
    pub(super) fn numbers(
        &self,
        root: &Root,
        index: usize,
        kind: Type,
        components: &[ComponentType],
    ) -> Result<Numbers, MeshError> {
        let bytes = self.accessor(root, index, kind, components)?;
        match &root.accessors[index].component_type {
            Checked::Valid(component) => Ok(Numbers {
                bytes,
                component: component.0,
                normalized: root.accessors[index].normalized,
                width: kind.multiplicity(),
            }),
            Checked::Invalid => Err(MeshError::malformed(format!("accessor {index} is of no known type"))),
        }
    }

    /// The indices in an accessor.
    pub(super) fn indices(&self, root: &Root, index: usize) -> Result<Vec<u32>, MeshError> {
        let kinds = [ComponentType::U8, ComponentType::U16, ComponentType::U32];
        let bytes = self.accessor(root, index, Type::Scalar, &kinds)?;
        let count = count_of(root, index)?.max(1);
        Ok(bytes.chunks_exact((bytes.len() / count).max(1)).map(little_endian).collect())
    }
}

/// The elements of an accessor, packed, to be taken as numbers.
pub(super) struct Numbers {
    bytes: Vec<u8>,
    component: ComponentType,
    normalized: bool,
    width: usize,
}

impl Numbers {
    /// How many elements there are.
    pub(super) fn len(&self) -> usize {
        self.bytes.len() / (self.component.size() * self.width)
    }

    /// The first components of element `i`; 0 for what is not there.
    pub(super) fn element<const N: usize>(&self, i: usize) -> [f64; N] {
        let size = self.component.size();
        core::array::from_fn(|k| {
            let at = (i * self.width + k) * size;
            self.bytes.get(at..at + size).map_or(0.0, |bytes| self.number(bytes))
        })
    }

    /// One component. Integers that are normalized are fractions of their greatest (glTF 2.0, section 3.11).
    fn number(&self, bytes: &[u8]) -> f64 {
        let bits = little_endian(bytes);
        let (number, greatest) = match self.component {
            ComponentType::F32 => return f64::from(f32::from_bits(bits)),
            ComponentType::I8 => (f64::from(bits as u8 as i8), f64::from(i8::MAX)),
            ComponentType::I16 => (f64::from(bits as u16 as i16), f64::from(i16::MAX)),
            ComponentType::U8 => (f64::from(bits), f64::from(u8::MAX)),
            ComponentType::U16 => (f64::from(bits), f64::from(u16::MAX)),
            ComponentType::U32 => (f64::from(bits), f64::from(u32::MAX)),
        };
        if self.normalized { (number / greatest).max(-1.0) } else { number }
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
            format!("refers to {}, which is not beside it", quoted_path(uri)),
            "keep the buffers of a glTF file in its folder, or embed them",
        ));
    }
    read_file(&folder.map_or_else(|| Path::new(&*path).to_owned(), |folder| folder.join(&*path)))
        .map_err(|e| MeshError::new(format!("refers to a file that {}", e.what), "put its buffers beside it"))
}
