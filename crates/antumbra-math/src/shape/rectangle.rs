use glam::DVec3;

/// A flat rectangle; both sides block light and receive shadows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// Metres.
    pub center: DVec3,
    /// From the centre to the middle of one side, metres.
    pub half_right: DVec3,
    /// From the centre to the middle of a neighbouring side, metres; perpendicular to `half_right`.
    pub half_forward: DVec3,
}

impl Rectangle {
    /// The corners in order around the rectangle.
    pub fn corners(&self) -> [DVec3; 4] {
        let (c, r, f) = (self.center, self.half_right, self.half_forward);
        [c - r - f, c + r - f, c + r + f, c - r + f]
    }
}
