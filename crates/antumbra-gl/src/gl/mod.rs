//! OpenGL as the rest of the library uses it: what a context can do, state that is put back, objects that are kept.

mod caps;
mod drawing;
mod host_target;
mod mesh_buffers;
mod program;
mod state;
mod stencil;
mod storage;
mod target;
mod tile_mesh;
mod upload;

pub use caps::{Caps, Tier};
pub(crate) use drawing::{Drawing, bind_texture};
pub(crate) use host_target::{OtherBuffers, refuse_feedback};
pub(crate) use mesh_buffers::MeshCache;
pub(crate) use program::{
    AREA, COVERAGE, Needs, Program, ProgramSet, ProgramSource, SURFACE, Stage, Variant, When,
};
pub(crate) use state::{Blend, RasterGuard, StateGuard, set_color_mask};
pub(crate) use stencil::StencilBuffer;
pub(crate) use target::{Target, TargetFormat};
pub(crate) use tile_mesh::TileMesh;
pub(crate) use upload::UploadRing;
