//! Antialiasing without derivatives of neighbours: how much of a pixel lies on one side of an edge.

use crate::real::{Real, Vector};

/// A pixel's patch of a receiver: the point seen through the pixel's centre, and how it moves on
/// the receiver's tangent plane from one pixel to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint<V: Vector> {
    /// The point seen through the centre.
    pub point: V,
    /// Its change for one pixel to the right.
    pub dx: V,
    /// Its change for one pixel up.
    pub dy: V,
}

impl<V: Vector> Footprint<V> {
    /// A pixel without extent: every coverage is 0 or 1.
    pub fn point(point: V) -> Self {
        let zero = V::new(V::Real::ZERO, V::Real::ZERO, V::Real::ZERO);
        Self { point, dx: zero, dy: zero }
    }
}

/// The footprint of a pixel on the plane through `point` with normal `normal`, in view space
/// (the eye at the origin, looking along -Z). `pixel` is the size of a pixel at distance one,
/// 2/(width P₀₀) and 2/(height P₁₁), or in metres for an orthographic projection.
///
/// Length and sign of the normal do not matter, except that a surface seen edge-on has no finite
/// footprint: for a unit normal its slope is limited to about 1000. A point at the eye has a
/// footprint without extent.
pub fn screen_footprint<V: Vector>(
    point: V,
    normal: V,
    pixel: (V::Real, V::Real),
    perspective: bool,
) -> Footprint<V> {
    let (zero, one) = (V::Real::ZERO, V::Real::ONE);
    let forward = V::new(zero, zero, -one);
    let (sight, distance) = if perspective { (point, point.dot(forward)) } else { (forward, one) };
    let limit = (distance * V::Real::from_f64(1e-3)).max(V::Real::from_f64(1e-30));
    let facing = sight.dot(normal);
    let facing = if facing < zero { facing.min(-limit) } else { facing.max(limit) };
    let slope = sight * (one / facing);
    let on_plane = |step: V| step - slope * normal.dot(step);
    Footprint {
        point,
        dx: on_plane(V::new(distance * pixel.0, zero, zero)),
        dy: on_plane(V::new(zero, distance * pixel.1, zero)),
    }
}

/// The area of the unit pixel in which `value + slope_x·u + slope_y·v > 0`, u and v in
/// [-1/2, 1/2]: exact for a straight edge. Without slope it is 1 for positive values and else 0,
/// across an infinite one 1/2; 0 for a value that is NaN. Never outside [0, 1].
pub fn half_plane_coverage<R: Real>(value: R, slope_x: R, slope_y: R) -> R {
    let (sx, sy) = (slope_x.abs(), slope_y.abs());
    let (major, minor) = (sx.max(sy), sx.min(sy));
    let reach = (major + minor) * R::HALF;
    let distance = value.abs();
    // The smaller of the two parts: nothing, a triangle cut off a corner, or a trapezium.
    let rest = (reach - distance).max(R::ZERO);
    let corner = distance >= (major - minor) * R::HALF;
    let (above, below) = if corner {
        // The product of two small slopes may underflow.
        (rest * rest, ((R::ONE + R::ONE) * major * minor).max(R::from_f64(1e-37)))
    } else {
        (major * R::HALF - distance, major)
    };
    let small = if rest > R::ZERO { (above / below).min(R::HALF) } else { R::ZERO };
    if value > R::ZERO { R::ONE - small } else { small }
}

/// An edge across a pixel: what lies on its inner side, and how it runs there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Edge<R: Real> {
    /// The area of the pixel on the inner side, in [0, 1].
    pub(crate) coverage: R,
    /// Change of the distance inwards, for one pixel to the right and one up.
    slope: (R, R),
}

impl<R: Real> Edge<R> {
    /// No edge: everything is inside.
    pub(crate) const NONE: Self = Self { coverage: R::ONE, slope: (R::ZERO, R::ZERO) };

    /// The edge where `value` is zero, given the gradient of `value` in space.
    pub(crate) fn new<V: Vector<Real = R>>(value: R, gradient: V, footprint: &Footprint<V>) -> Self {
        let slope = (gradient.dot(footprint.dx), gradient.dot(footprint.dy));
        Self { coverage: half_plane_coverage(value, slope.0, slope.1), slope }
    }
}

/// The area of the pixel inside both of two edges.
///
/// What is known is the area inside each and the angle between them: for parallel edges that face
/// the same way it is the smaller one, for edges that face each other (the tip of a triangle) the
/// sum less one, at right angles close to the product; between those it is interpolated by the
/// cosine.
pub(crate) fn corner_coverage<R: Real>(a: &Edge<R>, b: &Edge<R>) -> R {
    let (p, q) = (a.slope, b.slope);
    let lengths = (p.0 * p.0 + p.1 * p.1) * (q.0 * q.0 + q.1 * q.1);
    // The least float32 keeps: right angles are what pixels below a nanometre get.
    let cosine = (p.0 * q.0 + p.1 * q.1) / lengths.max(R::from_f64(1e-37)).sqrt();
    let product = a.coverage * b.coverage;
    let extreme = if cosine > R::ZERO {
        a.coverage.min(b.coverage)
    } else {
        (a.coverage + b.coverage - R::ONE).max(R::ZERO)
    };
    product + (extreme - product) * cosine.abs().min(R::ONE)
}
