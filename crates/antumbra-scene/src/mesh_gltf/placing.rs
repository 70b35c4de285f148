//! Where the nodes of a glTF document put their meshes.

use glam::{DMat4, DQuat, DVec3};
use gltf::json::Root;
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::scene::Node;

use super::buffers::{Buffers, Numbers, count_of};
use crate::mesh_builder::{Builder, MeshError};

/// From the node to its parent.
pub(super) fn transform(node: &Node) -> DMat4 {
    if let Some(m) = node.matrix {
        return DMat4::from_cols_array(&m.map(f64::from));
    }
    let vector = |v: Option<[f32; 3]>, default| v.map_or(default, |v| DVec3::from_array(v.map(f64::from)));
    let rotation = node.rotation.as_ref().map_or(DQuat::IDENTITY, |q| DQuat::from_array(q.0.map(f64::from)));
    placed(vector(node.translation, DVec3::ZERO), rotation, vector(node.scale, DVec3::ONE))
}

/// A rotation is of float32 or less, so nearly of length 1; the zero quaternion, which is none, turns nothing.
fn placed(translation: DVec3, rotation: DQuat, scale: DVec3) -> DMat4 {
    let rotation = if rotation.length() > 0.0 { rotation.normalize() } else { DQuat::IDENTITY };
    DMat4::from_scale_rotation_translation(scale, rotation, translation)
}

/// Where the copies of a node's mesh are: many, where the extension `EXT_mesh_gpu_instancing` says so, or one.
pub(super) struct Copies {
    count: usize,
    translations: Option<Numbers>,
    rotations: Option<Numbers>,
    scales: Option<Numbers>,
}

impl Copies {
    /// Those of a node. `mesh` has the limit on how many there may be: each has a vertex at least.
    pub(super) fn of(root: &Root, buffers: &Buffers, node: &Node, mesh: &Builder) -> Result<Self, MeshError> {
        let mut copies = Self { count: 1, translations: None, rotations: None, scales: None };
        let extension = node.extensions.as_ref().and_then(|all| all.others.get("EXT_mesh_gpu_instancing"));
        let Some(extension) = extension else { return Ok(copies) };
        let attributes = extension.get("attributes");
        let mut count = None;
        let mut numbers = |name: &str, kind: Type, components: &[ComponentType]| {
            let Some(index) = attributes.and_then(|a| a.get(name)) else { return Ok(None) };
            let accessor = index.as_u64().and_then(|i| usize::try_from(i).ok()).ok_or_else(|| {
                MeshError::malformed(format!("the {name} of a node's instances is no accessor"))
            })?;
            let these = count_of(root, accessor)?;
            if *count.get_or_insert(these) != these {
                return Err(MeshError::malformed("a node's instances have attributes of different number"));
            }
            mesh.expect(these, 0)?;
            buffers.numbers(root, accessor, kind, components).map(Some)
        };
        let float = [ComponentType::F32];
        copies.translations = numbers("TRANSLATION", Type::Vec3, &float)?;
        copies.rotations =
            numbers("ROTATION", Type::Vec4, &[ComponentType::F32, ComponentType::I8, ComponentType::I16])?;
        copies.scales = numbers("SCALE", Type::Vec3, &float)?;
        // With other attributes alone, such as colours, all are in the same place.
        copies.count = count.unwrap_or(1);
        Ok(copies)
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// From each copy to the node.
    pub(super) fn transforms(&self) -> impl Iterator<Item = DMat4> {
        (0..self.count).map(|i| {
            let vector = |numbers: &Option<Numbers>, default: DVec3| {
                numbers.as_ref().map_or(default, |n| DVec3::from_array(n.element(i)))
            };
            let rotation =
                self.rotations.as_ref().map_or(DQuat::IDENTITY, |n| DQuat::from_array(n.element(i)));
            placed(vector(&self.translations, DVec3::ZERO), rotation, vector(&self.scales, DVec3::ONE))
        })
    }
}
