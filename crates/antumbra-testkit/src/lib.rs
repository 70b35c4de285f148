//! What antumbra is measured with, in its tests and by `antumbra compare`: image metrics, ground truth and random
//! scenes.
//!
//! The metrics keep away from two mistakes: measuring over the whole image, where lit pixels hide the
//! error at the edges, and counting pixels that no image can get right, because an edge runs through
//! them.
#![forbid(unsafe_code)]

pub mod flip;
pub mod metrics;
pub mod penumbra;
pub mod random_mesh_scene;
pub mod random_scene;
pub mod truth;
