use glam::DVec3;

/// A ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Metres.
    pub center: DVec3,
    /// Metres, not negative; a ball of radius zero casts no shadow.
    pub radius: f64,
}
