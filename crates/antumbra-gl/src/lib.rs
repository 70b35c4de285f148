//! Analytic shadows for an OpenGL renderer of your own.
//!
//! The crate `antumbra` re-exports this one; its documentation has the quick start.

mod caps;
mod error;
mod frame;
mod host_target;
mod lights;
mod pairs;
mod proxy;
mod renderer;
mod resources;
mod shader;
mod state;
mod tiles;
mod view;

pub use caps::{Caps, Tier};
pub use error::Error;
pub use frame::{Camera, DepthFormat, Frame, Light, NO_SHADOW, NormalSpace, Normals, Occluder, Surface};
pub use lights::ShaderLight;
pub use pairs::BATCH_LIGHTS;
pub use renderer::{Encoding, MaskBatch, Renderer, Stats};
