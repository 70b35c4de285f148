//! The composite method as published: shadows on one plane from a few characteristic points, and
//! their shade.
//!
//! A. Pljaskovic, Dž. Avdić, P. Spalević, D. Rančić, "Sphere and Cone Composite Realtime Shadows in
//! OpenGL" (2013), and Dž. Avdić, D. Rančić, P. Spalević, A. Avdić, E. Doličanin, "Real-Time Shadows
//! in OpenGL Caused by the Presence of Multiple Light Sources" (2017). For exact shadows on a plane
//! see [`plane_shadow`](crate::plane_shadow).
//!
//! ```
//! use antumbra_math::composite::{self, PartShape, SphereForm};
//! use antumbra_math::{Light, Plane, PlaneFrame, Sphere};
//! use glam::DVec3;
//!
//! let floor = PlaneFrame::of_plane(&Plane::through(DVec3::ZERO, DVec3::Y)).unwrap();
//! let light = Light::Point { position: DVec3::new(0.0, 8.0, 0.0) };
//! let ball = Sphere { center: DVec3::new(0.0, 2.0, 0.0), radius: 0.6 };
//! let shadow = composite::cast(&ball.into(), &light, &floor, SphereForm::Circle).unwrap();
//! let part = shadow.parts().next().unwrap();
//! // r_s = r y_i / (y_i - d) = 0.6 * 8 / 6, and k = 1 - 2 / 8.
//! assert!(matches!(part.shape, PartShape::Disc { radius, .. } if (radius - 0.8).abs() < 1e-12));
//! assert!((part.shade - 0.75).abs() < 1e-12);
//! ```
//!
//! # What is drawn
//! - A disc parallel to the plane: a disc, by Eq. (2) and (3). Exact.
//! - A triangle in any pose: a triangle, each corner by Eq. (2), which is Eq. (8) for the apex, in the
//!   corner's own [`PaperFrame`]. Exact. The first two corners are the papers' base.
//! - A sphere: a disc, by the disc's equations, of the circle that [`SphereForm`] says.
//! - A cone with its axis along the plane's normal, either way up: the disc of its base, and the
//!   triangle of the projected apex and the ends of the base's diameter across the light's plane. The
//!   true shadow is the hull of disc and apex: two slivers are lost. If the apex falls inside the
//!   disc, as with the light straight above, the disc alone.
//! - An object of several shapes: the union of their parts.
//!
//! # What is changed, and why
//! - The papers print the ends of a base along z as (0, 0, z_s1) and (0, 0, z_s2). Under a light off
//!   the axis the base is projected to x = x_s like everything at its height, so the ends are
//!   (x_s, 0, ±a_1 / 2).
//! - The papers' code takes d for the distance from the object's centre to the light's; their
//!   equations and figures take it from the object to the plane, as here.
//! - The papers' code gives a triangle's base the radius' function and then halves it; Eq. (4) to (7)
//!   have a_1 of the whole base, as here.
//! - In Eq. (1) the object's centre is what the papers' list of letters says: the centre of a disc, a
//!   sphere, of a cone's base, of a triangle's base. (By their code a sphere would have that of its
//!   tangent circle.)
//!
//! # What counts
//! The papers demand an object wholly between the plane and the height of the light. So:
//! - A light that is not above all of the object by a billionth of its own height, whether beside it,
//!   below it, inside it or in the plane: no shadow. One that sinks loses its shadow; none turns over.
//! - An object on the other side of the plane than the light, a disc or a triangle that lies in the
//!   plane ("no shadow appears if the object is on the surface"), the plane itself and rectangles in it,
//!   a triangle whose shadow is a line, shapes without extent, and anything with an infinity or a NaN: no shadow.
//! - A shape that passes through the plane, a tilted disc or cone, and shapes that the papers do not
//!   have: a [`Refusal`].
//! - A directional light: the equations' limit, and k = 1.
//! - A spot is a point light here: outside its cone no light arrives, blocked or not.
//!
//! Nothing panics, and every number that comes out is finite.

mod coverage;
mod equations;
mod frame;
mod refusal;
mod shadow;

pub use coverage::{PlacedPart, part_coverage};
pub use equations::{PaperLight, shade, shadow_apex_x, shadow_base, shadow_radius, shadow_x};
pub use frame::PaperFrame;
pub use refusal::{Refusal, refusal};
pub use shadow::{CompositeShadow, Part, PartShape, SphereForm, cast};
