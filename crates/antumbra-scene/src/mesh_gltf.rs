//! glTF 2.0, .gltf and .glb: the triangles of the default scene, every node's transform applied.
//!
//! The crate `gltf` reads and validates the document ([`document`]); the accessors are read here ([`buffers`]). Skins,
//! morph targets, materials, cameras and lights are passed over; points and lines have no area.

mod buffers;
mod document;
mod placing;

use std::path::Path;

use glam::{DMat4, DVec3};
use gltf::json::Root;
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::Checked;

use buffers::{Buffers, count_of};
use placing::{Copies, transform};

use crate::mesh_builder::{Builder, MeshError};

/// Adds the triangles of a glTF file to `mesh`. `folder` is where its buffers are looked for.
pub(crate) fn read(bytes: &[u8], folder: Option<&Path>, mesh: &mut Builder) -> Result<(), MeshError> {
    let (root, blob) = document::read(bytes)?;
    let buffers = Buffers::load(&root, blob, folder)?;
    let mut seen = vec![false; root.nodes.len()];
    let mut open: Vec<(usize, DMat4)> =
        roots(&root).into_iter().rev().map(|n| (n, DMat4::IDENTITY)).collect();
    while let Some((index, parent)) = open.pop() {
        let node =
            root.nodes.get(index).ok_or_else(|| MeshError::malformed(format!("there is no node {index}")))?;
        // Nodes form trees, so none is reached twice; a cycle would be.
        if core::mem::replace(&mut seen[index], true) {
            return Err(MeshError::malformed(format!("node {index} has two parents or is in a cycle")));
        }
        let to_world = parent * transform(node);
        if let Some(primitives) = node.mesh.and_then(|m| root.meshes.get(m.value())).map(|m| &m.primitives) {
            let copies = Copies::of(&root, &buffers, node, mesh)?;
            for primitive in primitives {
                if let Some(surface) = Surface::read(&root, &buffers, primitive, mesh)? {
                    surface.place(to_world, &copies, mesh)?;
                }
            }
        }
        open.extend(node.children.iter().flatten().rev().map(|child| (child.value(), to_world)));
    }
    Ok(())
}

/// The nodes without parents: those of the default scene, or of the first, or all where there is no scene.
fn roots(root: &Root) -> Vec<usize> {
    let scene = root.scene.map_or(0, |index| index.value());
    if let Some(scene) = root.scenes.get(scene) {
        return scene.nodes.iter().map(|n| n.value()).collect();
    }
    let mut is_child = vec![false; root.nodes.len()];
    for child in root.nodes.iter().flat_map(|n| n.children.iter().flatten()) {
        if let Some(mark) = is_child.get_mut(child.value()) {
            *mark = true;
        }
    }
    (0..root.nodes.len()).filter(|i| !is_child[*i]).collect()
}

/// The triangles of a primitive, as its accessors have them.
struct Surface {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

impl Surface {
    /// Those of a primitive, or `None` if it has no triangles. `mesh` has the limits.
    fn read(
        root: &Root,
        buffers: &Buffers,
        primitive: &Primitive,
        mesh: &Builder,
    ) -> Result<Option<Self>, MeshError> {
        let Checked::Valid(mode) = primitive.mode else {
            return Err(MeshError::malformed("a primitive has an unknown mode"));
        };
        if matches!(mode, Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip) {
            return Ok(None);
        }
        let Some(positions) = primitive.attributes.get(&Checked::Valid(Semantic::Positions)) else {
            return Ok(None);
        };
        mesh.expect(count_of(root, positions.value())?, 0)?;
        let (float, any) = (
            [ComponentType::F32],
            [
                ComponentType::F32,
                ComponentType::I8,
                ComponentType::U8,
                ComponentType::I16,
                ComponentType::U16,
            ],
        );
        let components: &[ComponentType] = if document::is_quantized(root) { &any } else { &float };
        let positions = buffers.numbers(root, positions.value(), Type::Vec3, components)?;
        let positions: Vec<DVec3> =
            (0..positions.len()).map(|i| DVec3::from_array(positions.element(i))).collect();
        let is_list = !matches!(mode, Mode::TriangleStrip | Mode::TriangleFan);
        let of_corners = |corners: usize| if is_list { corners / 3 } else { corners.saturating_sub(2) };
        let indices: Vec<u32> = match primitive.indices {
            Some(index) => {
                mesh.expect(0, of_corners(count_of(root, index.value())?))?;
                buffers.indices(root, index.value())?
            }
            None => (0..positions.len() as u32).collect(),
        };
        if let Some(bad) = indices.iter().find(|i| **i as usize >= positions.len()) {
            let there = positions.len();
            return Err(MeshError::malformed(format!("a triangle has vertex {bad}, but there are {there}")));
        }
        let triangles: Vec<[u32; 3]> = match mode {
            // Every other triangle of a strip runs the other way.
            Mode::TriangleStrip => {
                let turned = |(i, w): (usize, &[u32])| {
                    if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[0], w[2], w[1]] }
                };
                indices.windows(3).enumerate().map(turned).collect()
            }
            Mode::TriangleFan => indices.split_first().map_or_else(Vec::new, |(center, rim)| {
                rim.windows(2).map(|w| [*center, w[0], w[1]]).collect()
            }),
            _ => indices.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
        };
        Ok((!triangles.is_empty()).then_some(Self { positions, triangles }))
    }

    /// Adds the triangles to `mesh`, once for each of the copies of a node.
    fn place(&self, to_world: DMat4, copies: &Copies, mesh: &mut Builder) -> Result<(), MeshError> {
        mesh.expect(
            self.positions.len().saturating_mul(copies.count()),
            self.triangles.len().saturating_mul(copies.count()),
        )?;
        for copy in copies.transforms() {
            let to_world = to_world * copy;
            let first = mesh.vertices();
            for p in &self.positions {
                mesh.vertex(to_world.transform_point3(*p))?;
            }
            let mirrored = to_world.determinant() < 0.0;
            for &[a, b, c] in &self.triangles {
                // What a transform mirrors keeps its front (glTF 2.0, section 3.7.4).
                let corners = if mirrored { [a, c, b] } else { [a, b, c] };
                // Both are far below 2^32: the limit on vertices is 2^24.
                mesh.triangle(corners.map(|i| i + first as u32))?;
            }
        }
        Ok(())
    }
}
