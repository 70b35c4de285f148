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
#[cfg(test)]
mod twins;

pub use antumbra_math::PlacingError;
pub use gl::{Caps, Tier};
pub use input::{
    Allowed, Area, Camera, Choice, Color, Component, Depth, DepthFormat, Encoding, Error, Falloff, Frame,
    FrameFault, Framebuffer, HostState, Image, Light, LightFault, Matrix, MeshOccluder, NO_SHADOW,
    NormalSpace, Normals, Occluder, OptionError, OptionInfo, Part, Pattern, Reason, Receiver, ReceiverShape,
    Refusal, Resource, Scenery, Soft, Surface, Texture, Unsupported, Vector, components,
};
pub use masks::{
    BATCH_LIGHTS, DepthMap, DepthScale, IRRADIANCE_GLSL, MapFace, MaskBatch, ShaderLight, Stats,
};
pub use renderer::{MaskBatches, Renderer};
pub use technique::Technique;
