//! What shadows fall on, for techniques that have to be told.

use antumbra_math::{Plane, Rectangle};

/// A flat surface that the host has drawn and that shadows fall on, for the techniques that are confined to
/// planes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Receiver {
    /// Where it is.
    pub shape: ReceiverShape,
    /// What the host's id texture shows there; 0 for a host without ids.
    pub id: u32,
}

/// The shapes of receivers.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ReceiverShape {
    /// An infinite plane.
    Plane(Plane),
    /// A flat rectangle.
    Rectangle(Rectangle),
}

impl Receiver {
    /// A receiver without an id.
    pub fn new(shape: ReceiverShape) -> Self {
        Self { shape, id: 0 }
    }

    /// The same with an id.
    pub fn with_id(self, id: u32) -> Self {
        Self { id, ..self }
    }

    /// The plane the receiver lies in, its normal to either side; not finite for a rectangle without area.
    pub(crate) fn plane(&self) -> Plane {
        match self.shape {
            ReceiverShape::Plane(plane) => plane,
            ReceiverShape::Rectangle(r) => {
                Plane::through(r.center, r.half_right.cross(r.half_forward).normalize())
            }
        }
    }
}
