use glam::DVec3;

/// A solid right circular cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Centre of the base, metres.
    pub base_center: DVec3,
    /// Unit vector from the base's centre to the apex.
    pub axis: DVec3,
    /// Radius of the base, metres, not negative; a cone of radius zero casts no shadow.
    pub radius: f64,
    /// From base to apex, metres, not negative; a cone of height zero is a disc.
    pub height: f64,
}

impl Cone {
    /// The tip, metres.
    pub fn apex(&self) -> DVec3 {
        self.base_center + self.axis * self.height
    }
}
