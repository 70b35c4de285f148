use glam::DVec3;

/// A flat disc that blocks light from both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Metres.
    pub center: DVec3,
    /// Unit normal; which of the two does not matter.
    pub normal: DVec3,
    /// Metres, not negative; a disc of radius zero casts no shadow.
    pub radius: f64,
}
