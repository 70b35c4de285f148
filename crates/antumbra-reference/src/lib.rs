//! A float64 CPU ray tracer of antumbra scenes: the ground truth that everything else is measured against.
//!
//! It knows every light and every shape of the scene format and shares no visibility code with the rest of the
//! project: it asks by ray casting what the others answer in closed form. It is itself held against Mitsuba 3, the
//! ray casts of parry3d and the analytic irradiance of area lights, in its tests.
//!
//! ```
//! use antumbra_reference::{Sampling, Tracer};
//! use antumbra_scene::Scene;
//!
//! let text = r#"
//! [camera]
//! eye = [0, 3, 6]
//! fov_y = 45
//! [[light]]
//! name = "lamp"
//! type = "sphere"
//! position = [2, 4, 0]
//! radius = 0.5
//! intensity = 100
//! [[object]]
//! name = "floor"
//! shape = { type = "plane" }
//! [[object]]
//! name = "ball"
//! shape = { type = "sphere", radius = 0.5 }
//! translation = [0, 1, 0]
//! "#;
//! let scene = Scene::parse(text, "lamp.toml".as_ref())?;
//! let tracer = Tracer::new(&scene, 0.0);
//! let radiance = tracer.render(32, 24, 16, &|_done, _total| {});
//! let lamp = tracer.visibility(0, 32, 24, Sampling::Center { light_samples: 64 }, &|_, _| {});
//! assert!(lamp.contains(&0.0) && lamp.contains(&1.0) && lamp.iter().any(|&v| 0.0 < v && v < 1.0));
//! # assert_eq!(radiance.len(), 32 * 24);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What is defined where
//!
//! - Surfaces are two-sided and Lambertian; normals are geometric and turned towards the viewer.
//! - A convex primitive never shadows itself: its own facing says all. A torus or a mesh may; the other parts of an object
//!   do shadow a part.
//!   Seen from inside, a convex solid is lit by every light its inner side faces, those outside it too.
//! - A point inside a solid occluder gets no light. A light inside one lights nothing outside. A light on the surface of
//!   one is not behind that surface. Rays that only touch a solid pass.
//! - Shadow rays start off the surface and stop short of the light by a share of 1e-10 of the scene's extent, which
//!   decides coincident surfaces: of two in one place, neither shadows the other.
//! - Lights are not seen by the camera and block nothing.
//! - No input makes it panic, but for the number of a light that does not exist. Numbers that are not finite meet
//!   nothing.
#![forbid(unsafe_code)]

mod bvh;
pub mod intersect;
mod light;
mod ray;
mod render;
mod sampling;
mod tracer;

pub use ray::{Hit, Ray};
pub use render::{Progress, Sampling};
pub use tracer::{Surface, Tracer};
