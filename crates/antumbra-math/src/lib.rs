//! The closed forms of shadows.
#![forbid(unsafe_code)]

mod light;
pub mod real;
pub mod shape;

pub use light::Light;
pub use shape::{Cone, Disc, Plane, Rectangle, Shape, Sphere, Triangle};
