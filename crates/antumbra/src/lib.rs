//! Exact real-time shadows for any OpenGL renderer.
#![forbid(unsafe_code)]

pub use antumbra_gl::*;

/// The closed forms themselves: shapes, shadows on planes, point tests.
pub use antumbra_math as math;

/// The vectors and matrices of the API.
pub use glam;
/// The OpenGL context of the API.
pub use glow;
