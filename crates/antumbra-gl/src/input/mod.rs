//! What a host tells antumbra, and what it is told when that cannot be done: plain data. Nothing here calls OpenGL or knows
//! how shadows are found.

mod components;
mod encoding;
mod error;
mod fault;
mod frame;
mod light;
mod occluder;
mod options;
mod receiver;
mod refusal;
mod scenery;
mod soft;
mod surface;

pub(crate) use components::push_components;
pub use components::{Component, components};
pub use encoding::Encoding;
pub use error::{Error, Image, Resource, Unsupported};
pub use fault::{FrameFault, LightFault};
pub use frame::{Camera, Frame};
pub use light::{Area, Light};
pub use occluder::{MeshOccluder, Occluder};
pub use options::{Allowed, Choice, OptionError, OptionInfo};
pub use receiver::{Receiver, ReceiverShape};
pub use refusal::{Part, Reason, Refusal};
pub use scenery::Scenery;
pub use soft::{Pattern, Soft};
pub use surface::{DepthFormat, NO_SHADOW, NormalSpace, Normals, Surface};
