//! The masks: textures of lights' visibilities, a batch of lights at a time. How they are put over the host's picture, and
//! how points that stand for a light are averaged in them. How shadows get into them is the techniques' business.

mod batch;
mod depth_map;
mod lights;
mod overlay;
mod results;
mod sampler;
mod samples;
mod shading;

pub use batch::BATCH_LIGHTS;
pub(crate) use batch::{Batch, GROUP_LIGHTS, Masks};
pub use depth_map::{DepthMap, DepthScale, MapFace};
pub use lights::ShaderLight;
pub(crate) use overlay::{HostPicture, Overlay};
#[cfg(test)]
pub(crate) use overlay::{RATIO_PROGRAM, SUM_PROGRAMS};
pub(crate) use results::Counts;
pub use results::{MaskBatch, Stats};
#[cfg(test)]
pub(crate) use sampler::SAMPLE_PROGRAMS;
pub(crate) use sampler::{Points, Sampler, Sampling};
pub use shading::IRRADIANCE_GLSL;
