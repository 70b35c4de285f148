//! Scene files of the antumbra shadow library: what a scene is, and reading one.
#![forbid(unsafe_code)]

mod model;

pub use model::*;
