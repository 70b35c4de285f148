//! The renderer against real contexts, OpenGL and OpenGL ES: what it leaves behind, what it
//! allocates, and what it draws for hosts that differ from each other in every way they can.
//!
//! One program, so that it links once. Surfaces are traced on the CPU and uploaded: every
//! projection, depth format and viewport is then one line, and the expected shadows come from the
//! ray tracer, which shares no code with the renderer.

mod bare_gles;
mod context;
mod full_screen;
mod odd_host;
mod shot;
mod snapshot;
mod truth;
mod world;

mod averted;
mod bad_frames;
mod cameras;
mod composite;
mod composite_guest;
mod composite_soft;
mod depth_copy;
mod depth_map;
mod depth_only;
mod falloffs;
mod hosts;
mod leaks;
mod lights;
mod map;
mod map_guest;
mod occluders;
mod projected;
mod sampled;
mod samples;
mod state;
mod stats;
mod steady;
mod surprises;
mod viewports;
mod volumes;
