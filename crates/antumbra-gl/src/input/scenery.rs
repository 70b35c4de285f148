//! Lights, what blocks them, and what shadows fall on.

use super::{Light, MeshOccluder, Occluder, Receiver};

/// What a technique is asked to do: everything of a frame but the camera and the host's surfaces.
#[derive(Clone, Copy, Debug, Default)]
#[non_exhaustive]
pub struct Scenery<'a> {
    /// The lights.
    pub lights: &'a [Light],
    /// Shapes that block them.
    pub occluders: &'a [Occluder],
    /// Meshes that block them.
    pub meshes: &'a [MeshOccluder],
    /// Flat surfaces that shadows fall on.
    pub receivers: &'a [Receiver],
}

impl<'a> Scenery<'a> {
    /// The same with these lights.
    pub fn lights(self, lights: &'a [Light]) -> Self {
        Self { lights, ..self }
    }

    /// The same with these occluders.
    pub fn occluders(self, occluders: &'a [Occluder]) -> Self {
        Self { occluders, ..self }
    }

    /// The same with these meshes.
    pub fn meshes(self, meshes: &'a [MeshOccluder]) -> Self {
        Self { meshes, ..self }
    }

    /// The same with these receivers.
    pub fn receivers(self, receivers: &'a [Receiver]) -> Self {
        Self { receivers, ..self }
    }
}
