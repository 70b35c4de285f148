//! Lights, what blocks them, and what shadows fall on.

use super::{Light, MeshOccluder, Occluder, Receiver};

/// What a technique is asked to do: everything of a frame but the camera and the host's surfaces.
#[derive(Clone, Copy, Debug, Default)]
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
