//! Shadows for an OpenGL renderer of your own.
//!
//! The crate `antumbra` re-exports this one; its documentation has the quick start.
//!
//! In rooms, each of which knows those below it alone: the renderer, the techniques, the masks they draw into, OpenGL, the
//! screen, and what the host says.

mod gl;
mod input;
mod masks;
mod renderer;
mod screen;
pub mod technique;

#[cfg(test)]
mod program_tests;

pub use gl::{Caps, Tier};
pub use input::{
    Allowed, Area, Camera, Choice, Component, DepthFormat, Encoding, Error, Frame, FrameFault, Image, Light,
    LightFault, MeshOccluder, NO_SHADOW, NormalSpace, Normals, Occluder, OptionError, OptionInfo, Part,
    Pattern, Reason, Receiver, ReceiverShape, Refusal, Resource, Scenery, Soft, Surface, Unsupported,
    components,
};
pub use masks::{
    BATCH_LIGHTS, DepthMap, DepthScale, IRRADIANCE_GLSL, MapFace, MaskBatch, ShaderLight, Stats,
    light_points, sample_weight,
};
pub use renderer::Renderer;
pub use technique::Technique;
