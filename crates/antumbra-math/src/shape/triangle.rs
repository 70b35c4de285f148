use glam::DVec3;

/// A flat triangle that blocks light from both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// Corners, metres; a triangle without area casts no shadow.
    pub vertices: [DVec3; 3],
}
