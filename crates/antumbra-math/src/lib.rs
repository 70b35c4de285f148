//! The closed forms of shadows.
#![forbid(unsafe_code)]

pub mod blocking;
pub mod composite;
mod light;
pub mod mesh;
pub mod plane_shadow;
pub mod real;
pub mod shape;
pub mod soft;

pub use light::Light;
pub use mesh::{MeshError, TriangleMesh};
pub use plane_shadow::{PlaneFrame, PlaneShadow, ShadowKind};
pub use shape::{Cone, Disc, PlacingError, Plane, Rectangle, Shape, Sphere, Triangle};
