//! Soft shadows without noise: what part of an area light's irradiance arrives past an occluder.
//!
//! From a point of a receiver every light is a flat [`Patch`]. It is cut into strips; a convex occluder takes one
//! interval of each, whose ends are roots of linear or quadratic equations, and the irradiance of an interval is
//! closed. Across the strips a quadrature of a few nodes does the rest: along a strip nothing is approximated, and
//! across them the integrand is smooth but for its ends, which the nodes are made for, and for the corners of the
//! outline.
//!
//! ```
//! use antumbra_math::soft::{AreaLight, Nodes, visibility};
//! use antumbra_math::{Shape, Sphere};
//! use glam::DVec3;
//!
//! let light = AreaLight::Sphere { center: DVec3::new(0.0, 4.0, 0.0), radius: 0.5 };
//! let ball = Shape::from(Sphere { center: DVec3::new(0.0, 2.0, 0.0), radius: 0.5 });
//! let nodes = Nodes::new(8);
//! let at = |x: f64| visibility(&light, &[ball], DVec3::new(x, 0.0, 0.0), DVec3::Y, &nodes);
//! assert!(at(0.0) < 1e-6 && at(5.0) == 1.0 && 0.2 < at(0.9) && at(0.9) < 0.8);
//! ```

mod interval;
mod nodes;
mod occluder;
mod outline;
mod patch;
mod region;
mod standing;

pub use interval::Interval;
pub use nodes::Nodes;
pub use occluder::{Hidden, cone_triangle};
pub use outline::{PenumbraOutline, Zone};
pub use patch::{Line, Patch, Strips, cap_irradiance};
pub use region::{Cap, Conic, Polygon};
pub use standing::Standing;

use crate::Shape;
use crate::real::{Real, Vector};
use glam::DVec3;

/// A light with a surface. Sizes in metres, positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AreaLight {
    /// A glowing ball.
    Sphere {
        /// Its centre.
        center: DVec3,
        /// Its radius.
        radius: f64,
    },
    /// A disc that shines to one side, Lambertian.
    Disc {
        /// Its centre.
        center: DVec3,
        /// Unit normal of the side that shines.
        direction: DVec3,
        /// Its radius.
        radius: f64,
    },
    /// A rectangle that shines to one side, Lambertian.
    Rectangle {
        /// Its centre.
        center: DVec3,
        /// Unit normal of the side that shines.
        direction: DVec3,
        /// From the centre to the middle of one side.
        half_right: DVec3,
        /// From the centre to the middle of a neighbouring side, at right angles.
        half_up: DVec3,
    },
}

impl AreaLight {
    /// The light as `point` sees it, for a receiver with unit normal `normal`; `None` where it sends nothing: from
    /// behind a flat light, and from inside a ball.
    pub fn patch<V: Vector>(&self, point: V, normal: V) -> Option<Patch<V>> {
        let vector = V::from_dvec3;
        let real = V::Real::from_f64;
        match *self {
            Self::Sphere { center, radius } => Patch::of_sphere(vector(center), real(radius), point, normal),
            Self::Disc { center, direction, radius } => {
                Patch::of_disc(vector(center), vector(direction), real(radius), point, normal)
            }
            Self::Rectangle { center, direction, half_right, half_up } => Patch::of_rectangle(
                vector(center),
                vector(direction),
                [half_right, half_up].map(vector),
                point,
            ),
        }
    }
}

/// The fraction of the light's irradiance at `point` of a receiver with unit normal `normal` that arrives past one
/// occluder: from 0 to 1.
///
/// 0 where no light arrives even without it: behind the receiver's horizon, behind a flat light. 1 inside a glowing
/// ball. 0 inside a solid, and of a light that a solid holds. Of a light that an occluder crosses that part is hidden
/// which is inside or beyond: exactly, but for cones, which hide with the part of their base and of their outline that is
/// before the light's middle.
pub fn pair_visibility<V: Vector>(
    light: &AreaLight,
    occluder: &Shape,
    point: V,
    normal: V,
    nodes: &Nodes<V::Real>,
) -> V::Real {
    visibility_of(light, core::slice::from_ref(occluder), point, normal, nodes, |hidden, strips| {
        hidden.iter().fold(V::Real::ZERO, |sum, one| sum + one.taken(strips, nodes))
    })
}

/// The same past all occluders together: the union of what they hide.
pub fn visibility<V: Vector>(
    light: &AreaLight,
    occluders: &[Shape],
    point: V,
    normal: V,
    nodes: &Nodes<V::Real>,
) -> V::Real {
    visibility_of(light, occluders, point, normal, nodes, |hidden, strips| {
        let rows = hidden.iter().fold(Interval::empty(), |rows, one| rows.hull(one.rows()));
        let mut intervals: Vec<Interval<V::Real>> = Vec::with_capacity(hidden.len());
        nodes.integrate(strips.round, rows.and(strips.rows()), |y| {
            let seen = strips.seen(y);
            intervals.clear();
            let all = hidden.iter().flat_map(|one| one.intervals(y)).map(|hidden| hidden.and(seen));
            intervals.extend(all.filter(|interval| !interval.is_empty()));
            intervals.sort_by(|a, b| a.low.partial_cmp(&b.low).unwrap_or(core::cmp::Ordering::Equal));
            let (mut sum, mut at) = (V::Real::ZERO, seen.low);
            for interval in &intervals {
                let rest = Interval { low: interval.low.max(at), high: interval.high };
                sum = sum + strips.irradiance(y, rest);
                at = at.max(interval.high);
            }
            sum
        })
    })
}

fn visibility_of<V: Vector>(
    light: &AreaLight,
    occluders: &[Shape],
    point: V,
    normal: V,
    nodes: &Nodes<V::Real>,
    taken: impl FnOnce(&[Hidden<V::Real>], &Strips<V::Real>) -> V::Real,
) -> V::Real {
    let (zero, one) = (V::Real::ZERO, V::Real::ONE);
    let Some(patch) = light.patch(point, normal) else {
        let inside = matches!(light, AreaLight::Sphere { .. });
        return if inside { one } else { zero };
    };
    let strips = Strips::new(&patch, normal);
    let whole = strips.whole(nodes);
    let hidden: Vec<_> = occluders.iter().map(|shape| Hidden::new(light, shape, point, &patch)).collect();
    if !(whole > zero) || hidden.iter().any(Hidden::is_all) {
        return zero;
    }
    (one - taken(&hidden, &strips) / whole).clamp(zero, one)
}
