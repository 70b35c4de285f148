//! What shadows fall on, for techniques that have to be told.

use antumbra_math::{Plane, Rectangle};

/// A flat surface that the host has drawn and that shadows fall on, for the techniques that are confined to
/// planes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Receiver {
    /// Where it is.
    pub shape: ReceiverShape,
    /// What the host's id texture shows there; 0 for a host without ids.
    pub id: u32,
}

/// The shapes of receivers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ReceiverShape {
    /// An infinite plane.
    Plane(Plane),
    /// A flat rectangle.
    Rectangle(Rectangle),
}

impl Receiver {
    /// The plane the receiver lies in, its normal to either side; not finite for a rectangle without area.
    pub fn plane(&self) -> Plane {
        match self.shape {
            ReceiverShape::Plane(plane) => plane,
            ReceiverShape::Rectangle(r) => {
                Plane::through(r.center, r.half_right.cross(r.half_forward).normalize())
            }
        }
    }
}
