//! The document of a glTF file: parsed, of the version that is read, and valid.

use std::collections::HashMap;

use gltf::json::mesh::{Primitive, Semantic};
use gltf::json::validation::Checked;
use gltf::json::{Root, Value};
use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::mesh_builder::MeshError;
use crate::text::{one_line, quoted};

/// Extensions that are read.
const READ: [&str; 2] = ["EXT_mesh_gpu_instancing", QUANTIZATION];

/// The extension of positions that are integers.
const QUANTIZATION: &str = "KHR_mesh_quantization";

/// How the names of extensions begin that a file may require and that change no triangle.
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

/// The document in a .gltf or .glb file and the binary chunk that a .glb may have.
pub(super) fn read(bytes: &[u8]) -> Result<(Root, Option<Vec<u8>>), MeshError> {
    // Not of JSON, but of those who save text.
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    // The header of a .glb is 12 bytes: the magic, the version, and the length, from which the parser subtracts 12
    // unchecked.
    if bytes.starts_with(b"glTF") {
        let word =
            |at: usize| bytes.get(at..).and_then(|b| b.first_chunk()).map_or(0, |b| u32::from_le_bytes(*b));
        if word(4) == 1 {
            return Err(outdated("1.0"));
        }
        if word(8) < 12 {
            return Err(MeshError::malformed(format!("its header says that it has {} bytes", word(8))));
        }
    }
    let gltf::Gltf { document, blob } =
        gltf::Gltf::from_slice_without_validation(bytes).map_err(|error| {
            first_version(bytes).map_or_else(|| MeshError::malformed(error), |v| outdated(&v))
        })?;
    Ok((validated(document.into_json())?, blob))
}

/// Whether positions may be integers.
pub(super) fn is_quantized(root: &Root) -> bool {
    root.extensions_used.iter().any(|name| name == QUANTIZATION)
}

fn outdated(version: &str) -> MeshError {
    MeshError::new(
        format!("is glTF {}, and only 2.0 is read", one_line(version)),
        "convert it to 2.0, for example with gltf-pipeline",
    )
}

/// The version of a document that is of glTF 1, `None` of any other: it says so, or what glTF 2 has in a list it has
/// by name.
fn first_version(json: &[u8]) -> Option<String> {
    #[derive(Deserialize)]
    struct Document {
        asset: Asset,
    }
    #[derive(Deserialize)]
    struct Asset {
        version: String,
    }
    #[derive(Deserialize)]
    struct Named {
        #[expect(dead_code, reason = "that it can be read is all there is to know")]
        meshes: HashMap<String, IgnoredAny>,
    }
    match gltf::json::deserialize::from_slice::<Document>(json) {
        Ok(document) => Some(document.asset.version).filter(|v| v.starts_with("1.") && v.len() < 8),
        Err(_) => gltf::json::deserialize::from_slice::<Named>(json).ok().map(|_| "1.0".to_owned()),
    }
}

/// The document, valid: every index in it is in range, and no extension is required that may change what
/// its triangles are.
fn validated(mut root: Root) -> Result<Root, MeshError> {
    let positions = |p: &Primitive| p.attributes.get(&Checked::Valid(Semantic::Positions)).map(|i| i.value());
    let primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let all: Vec<usize> = primitives.filter_map(positions).collect();
    for index in all {
        // The validator takes this one index for granted (gltf-json 1.4.1, `primitive_validate_hook`).
        let Some(accessor) = root.accessors.get_mut(index) else {
            return Err(MeshError::malformed("a primitive has positions in an accessor that is not there"));
        };
        // And it insists on bounds, which some programs leave out and nothing here reads.
        accessor.min = Some(Value::from(vec![0.0; 3]));
        accessor.max = Some(Value::from(vec![0.0; 3]));
    }
    // What a file requires it also uses, whether or not it says so.
    let is_read = |name: &str| READ.contains(&name);
    root.extensions_used.extend(root.extensions_required.iter().filter(|name| is_read(name)).cloned());
    // The validator refuses every one that is left; these are read or change nothing.
    let is_harmless = |name: &str| HARMLESS.iter().any(|start| name.starts_with(start));
    root.extensions_required.retain(|name| !is_read(name) && !is_harmless(name));
    if let Some(name) = root.extensions_required.first() {
        return Err(MeshError::new(
            format!("requires the extension {}, which is not read", quoted(name)),
            "export the mesh without it, for example uncompressed",
        ));
    }
    let document = gltf::Document::from_json(root).map_err(|error| match &error {
        // One line for each thing wrong may be thousands.
        gltf::Error::Validation(all) if all.len() > 1 => {
            let first = &all[0];
            MeshError::malformed(format!("{}: {}, and {} more", first.0, first.1, all.len() - 1))
        }
        _ => MeshError::malformed(error),
    })?;
    Ok(document.into_json())
}
