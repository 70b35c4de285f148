//! A plain OpenGL renderer of antumbra scenes: the host that the shadow library is a guest of.
//!
//! It knows nothing of shadows. It draws primitives by casting the eye's ray at their exact
//! shapes, lights them without occlusion, and hands its depth, normals and object ids to
//! `antumbra`, as any host would.

mod context;
mod describe;
mod error;
mod picture;
mod program;
mod stage;
mod targets;

pub use context::{Api, ContextInfo, HeadlessContext};
pub use describe::{Described, describe, objection};
pub use error::HostError;
pub use picture::{RenderOptions, Rendered};
pub use stage::{Buffers, Setting, Stage};
pub use targets::ColorFormat;
