//! What a host tells antumbra, and what it is told when that cannot be done: plain data. Nothing here calls OpenGL or knows
//! how shadows are found.

mod area;
mod components;
mod encoding;
mod error;
mod falloff;
mod fault;
mod frame;
mod host_state;
mod light;
mod names;
mod occluder;
mod options;
mod receiver;
mod refusal;
mod scenery;
mod soft;
mod surface;
mod vectors;

pub use area::Area;
pub(crate) use components::push_components;
pub use components::{Component, components};
pub use encoding::Encoding;
pub use error::{Error, Image, Resource, Unsupported};
pub use falloff::Falloff;
pub use fault::{FrameFault, LightFault};
pub use frame::{Camera, Frame};
pub use host_state::HostState;
pub use light::Light;
pub use names::{Framebuffer, Texture};
pub use occluder::{MeshOccluder, Occluder};
pub use options::{Allowed, Choice, OptionError, OptionInfo};
pub use receiver::{Receiver, ReceiverShape};
pub use refusal::{Part, Reason, Refusal};
pub use scenery::Scenery;
pub use soft::{Pattern, Soft};
pub use surface::{Depth, DepthFormat, NO_SHADOW, NormalSpace, Normals, Surface};
pub use vectors::{Color, Matrix, Vector};
