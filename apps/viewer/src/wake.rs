//! Events of the program's own.

use std::time::Duration;

/// What wakes the loop from outside.
#[derive(Debug)]
pub(crate) enum Wake {
    /// The interface wants a frame after a while.
    After(Duration),
    /// The reference has a new picture.
    Traced,
}
