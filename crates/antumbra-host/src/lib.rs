//! A plain OpenGL renderer of antumbra scenes: the host that the shadow library is a guest of.
//!
//! It knows nothing of shadows. It draws the shapes with simple equations by casting the eye's ray
//! at them and all others as triangles, lights them without occlusion, and hands its depth, normals and object ids to
//! `antumbra`, as any host would.

mod buffers;
mod cast;
mod context;
mod describe;
#[cfg(test)]
mod drawing_tests;
mod error;
mod link;
mod meshes;
mod objection;
mod picture;
mod program;
mod setting;
mod stage;
mod state;
mod surface;
mod targets;
mod tessellate;
mod test_context;
mod test_display;
mod timer;
mod ways;

pub use context::{Api, ContextInfo, HeadlessContext};
pub use describe::{Described, describe, light};
pub use error::HostError;
pub use link::link_program;
pub use objection::objection;
pub use picture::{RenderOptions, Rendered};
pub use setting::Setting;
pub use stage::{Buffers, Picture, Stage};
pub use targets::ColorFormat;
pub use test_context::TestContext;
pub use test_display::TestDisplay;
pub use timer::FrameTimer;
pub use ways::Ways;
