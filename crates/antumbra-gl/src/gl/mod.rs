//! OpenGL as the rest of the library uses it: what a context can do, state that is put back, objects that are kept.

mod caps;
mod depth;
mod drawing;
mod host_target;
#[cfg(not(target_arch = "wasm32"))]
pub(crate) mod load;
mod mesh_buffers;
mod program;
mod state;
mod stencil;
mod storage;
mod target;
mod tile_mesh;
mod upload;

pub use caps::{Caps, Tier};
pub(crate) use depth::{DepthAttachment, DepthCopy};
pub(crate) use drawing::{Drawing, bind_texture};
pub(crate) use host_target::{HostDraw, refuse_feedback, refuse_upper_left};
pub(crate) use mesh_buffers::MeshCache;
pub(crate) use program::{
    AREA, COVERAGE, Needs, Program, ProgramSet, ProgramSource, SURFACE, Stage, Variant, When,
};
pub(crate) use state::{Blend, RasterGuard, StateGuard, bound_framebuffer, set_color_mask};
pub(crate) use stencil::StencilBuffer;
pub(crate) use storage::texture_storage;
pub(crate) use target::{Target, TargetFormat};
pub(crate) use tile_mesh::TileMesh;
pub(crate) use upload::UploadRing;
