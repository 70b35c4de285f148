//! Meshes in place of shapes, made once and kept while they are used.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

use antumbra::math::{MeshError, TriangleMesh};
use antumbra_scene::{Mesh, Shape};

use crate::tessellate::tessellated;

/// What tells shapes that become triangles apart.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Key {
    /// The kind, and the bits of the sizes.
    Sizes([u64; 4]),
    /// A mesh of a file.
    Mesh(ByAddress),
}

/// A mesh told from others by where it is in memory. Held, so that no other comes to lie there.
#[derive(Clone, Debug)]
pub(crate) struct ByAddress(Arc<Mesh>);

impl PartialEq for ByAddress {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Eq for ByAddress {}

impl Hash for ByAddress {
    fn hash<H: Hasher>(&self, state: &mut H) {
        Arc::as_ptr(&self.0).hash(state);
    }
}

impl Key {
    /// `None` for shapes that are not drawn as triangles.
    pub(crate) fn new(shape: &Shape) -> Option<Self> {
        let sizes = |kind, sizes: [f64; 3]| {
            let [a, b, c] = sizes.map(f64::to_bits);
            Some(Self::Sizes([kind, a, b, c]))
        };
        match *shape {
            Shape::Ellipsoid { radii } => sizes(0, radii.to_array()),
            Shape::Cylinder { radius, height, radius_top } => sizes(1, [radius, height, radius_top]),
            Shape::Capsule { radius, height } => sizes(2, [radius, height, 0.0]),
            Shape::Box { size } => sizes(3, size.to_array()),
            Shape::Torus { major_radius, minor_radius } => sizes(4, [major_radius, minor_radius, 0.0]),
            Shape::Mesh(ref mesh) => Some(Self::Mesh(ByAddress(Arc::clone(mesh)))),
            Shape::Plane
            | Shape::Rectangle { .. }
            | Shape::Disc { .. }
            | Shape::Triangle { .. }
            | Shape::Sphere { .. }
            | Shape::Cone { .. } => None,
        }
    }
}

/// The meshes of shapes. A renderer finds what it keeps of a mesh by the mesh's id, which lasts as long as the mesh.
#[derive(Default)]
pub(crate) struct Meshes {
    of: HashMap<Key, Arc<TriangleMesh>>,
}

impl Meshes {
    /// The mesh of a shape, the same one for equal shapes.
    pub(crate) fn get(&mut self, shape: &Shape) -> Result<Arc<TriangleMesh>, MeshError> {
        let Some(key) = Key::new(shape) else { return tessellated(shape).map(Arc::new) };
        Ok(match self.of.entry(key) {
            Entry::Occupied(known) => Arc::clone(known.get()),
            Entry::Vacant(vacant) => Arc::clone(vacant.insert(Arc::new(tessellated(shape)?))),
        })
    }

    /// Forgets the meshes that nobody else holds.
    pub(crate) fn trim(&mut self) {
        self.of.retain(|_, mesh| Arc::strong_count(mesh) > 1);
    }
}
