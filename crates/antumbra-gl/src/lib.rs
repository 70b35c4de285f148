//! Shadows for an OpenGL renderer of your own.
//!
//! The crate `antumbra` re-exports this one; its documentation has the quick start.

mod caps;
mod error;
mod frame;
mod host_target;
mod lights;
mod mesh_buffers;
mod overlay;
mod pairs;
mod proxy;
mod renderer;
mod resources;
mod results;
mod sampler;
mod samples;
mod scenery;
mod shader;
mod shading;
mod soft_pairs;
mod state;
mod stencil;
mod surface;
pub mod technique;
mod tiles;
mod union;
mod view;

pub use caps::{Caps, Tier};
pub use error::Error;
pub use frame::{Camera, DepthFormat, Frame, NO_SHADOW, NormalSpace, Normals, Surface};
pub use lights::ShaderLight;
pub use overlay::Encoding;
pub use pairs::BATCH_LIGHTS;
pub use renderer::Renderer;
pub use results::{MaskBatch, Stats};
pub use samples::{Pattern, Soft, light_points, sample_weight};
pub use scenery::{Area, Light, MeshOccluder, Occluder, Receiver, ReceiverShape, Scenery};
pub use shading::IRRADIANCE_GLSL;
pub use technique::Technique;
