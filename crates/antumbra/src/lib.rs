//! Exact real-time shadows for any OpenGL renderer.
//!
//! You draw with OpenGL (3.3, or ES 3.0) and nothing in your picture casts a shadow. Describe your
//! lights and what blocks them, call antumbra after drawing, and the shadows are there: closed
//! forms evaluated in the pixels a shadow can reach, with no shadow map, no bias to tune, no limit
//! on the number of lights, and no change to your shaders.
//!
//! Two ways in:
//!
//! 1. [`Renderer::overlay`] multiplies the picture you have drawn by what the shadows leave of each
//!    light. It needs your depth buffer, your camera, and lights as you compute them.
//! 2. [`Renderer::masks`] fills textures with the visibility of each light, which your own lighting
//!    samples.
//!
//! What casts: balls, discs, triangles, rectangles, cones and infinite planes ([`math::Shape`]), in
//! any pose and number. What receives: anything you have drawn. Lights are points, spots, suns, and
//! balls, discs and rectangles ([`Area`]), whose penumbrae are closed forms too, without samples or noise.
//! Hard edges are antialiased by the exact area of a pixel on either side.
//!
//! Other techniques stand beside the closed forms ([`Technique`]): projected shadows, shadow volumes and
//! shadow maps, which cast from meshes, and the painted shadows of the papers all this grew from.
//!
//! # Quick start
//!
//! `examples/own_renderer.rs`, a whole renderer that gets its shadows both ways:
//!
//! ```no_run
#![doc = include_str!("../examples/own_renderer.rs")]
//! ```
#![forbid(unsafe_code)]

pub use antumbra_gl::*;

/// The closed forms themselves: shapes, shadows on planes, point tests, coverage.
pub use antumbra_math as math;

/// The vectors and matrices of the API.
pub use glam;
/// The OpenGL context of the API.
pub use glow;
