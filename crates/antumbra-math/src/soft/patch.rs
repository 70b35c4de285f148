//! A light as one point sees it: flat, and lined with strips.

use super::{Interval, Nodes};
use crate::real::{Real, Vector};

/// The directions from a point to a light: `origin + x right + y up` over a unit disc or a square.
///
/// Disc and rectangle lights are flat already. Of a sphere light a point sees the cap inside its tangent cone, and
/// that cone meets the plane through the light's centre in a disc. So every light is a patch of a plane, and the
/// strips of constant y are what occluders are cut into intervals on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch<V: Vector> {
    /// Unit vector to the light's centre.
    pub origin: V,
    /// Half the patch along x, at the distance of 1.
    pub right: V,
    /// Half the patch along y, at right angles to `right`.
    pub up: V,
    /// Whether it is the disc x² + y² < 1; the square |x|, |y| < 1 otherwise.
    pub round: bool,
    /// Distance of the light's centre, metres: what is farther along a direction, in units of it, does not block.
    pub reach: V::Real,
    /// The square of the tangents' length to a ball, of `reach` to a flat light: a ball with longer tangents is behind.
    pub tangent_2: V::Real,
    /// The square of a ball's radius, 0 of a flat light.
    pub radius_2: V::Real,
}

/// A unit vector at right angles to the unit vector `axis`, and to `normal` if the two are not parallel.
fn level_axis<V: Vector>(axis: V, normal: V) -> V {
    let (zero, one) = (V::Real::ZERO, V::Real::ONE);
    let across = normal.cross(axis);
    // Of two axes of space at least one is far from parallel.
    let (x, y) = (V::new(one, zero, zero), V::new(zero, one, zero));
    let other = axis.cross(if axis.dot(x).abs() < V::Real::from_f64(0.6) { x } else { y });
    let across = if across.dot(across) > V::Real::from_f64(1e-12) { across } else { other };
    across * (one / across.length())
}

impl<V: Vector> Patch<V> {
    /// A glowing ball seen from `point`; `None` from inside it.
    ///
    /// Strips run level with the receiver, whose unit normal is `normal`: the horizon is then a strip's edge.
    pub fn of_sphere(center: V, radius: V::Real, point: V, normal: V) -> Option<Self> {
        let to_light = center - point;
        let square = to_light.dot(to_light);
        let outside = square - radius * radius;
        if !(outside > V::Real::ZERO) {
            return None;
        }
        let reach = square.sqrt();
        let origin = to_light * (V::Real::ONE / reach);
        let tangent = radius / outside.sqrt();
        let right = level_axis(origin, normal);
        let up = origin.cross(right) * tangent;
        Some(Self {
            origin,
            right: right * tangent,
            up,
            round: true,
            reach,
            tangent_2: outside,
            radius_2: radius * radius,
        })
    }

    /// A disc that shines along the unit vector `direction`; `None` from behind, or in its plane.
    pub fn of_disc(center: V, direction: V, radius: V::Real, point: V, normal: V) -> Option<Self> {
        let right = level_axis(direction, normal);
        let half = [right * radius, direction.cross(right) * radius];
        Self::of_flat(center, direction, half, true, point)
    }

    /// A rectangle that shines along the unit vector `direction`, given by the vectors from its centre to the
    /// middles of two neighbouring sides; `None` from behind, or in its plane.
    pub fn of_rectangle(center: V, direction: V, half: [V; 2], point: V) -> Option<Self> {
        Self::of_flat(center, direction, half, false, point)
    }

    fn of_flat(center: V, direction: V, half: [V; 2], round: bool, point: V) -> Option<Self> {
        let to_light = center - point;
        if !(to_light.dot(direction) < V::Real::ZERO) {
            return None;
        }
        let reach = to_light.length();
        let scale = V::Real::ONE / reach;
        Some(Self {
            origin: to_light * scale,
            right: half[0] * scale,
            up: half[1] * scale,
            round,
            reach,
            tangent_2: reach * reach,
            radius_2: V::Real::ZERO,
        })
    }

    /// Positive where the plane of a flat occluder is before the light; `normal`, of unit length, points away from the
    /// point, and the light's centre is so far over the plane along it.
    ///
    /// Of a ball the parts before and beyond are told apart by the chord between the points in which the plane's circle
    /// touches the outline: what is beyond it and outside of the circle is hidden.
    pub(super) fn before(&self, normal: V, over: V::Real) -> Line<V::Real> {
        Line {
            one: over * self.reach - self.radius_2 * normal.dot(self.origin),
            x: self.tangent_2 * normal.dot(self.right),
            y: self.tangent_2 * normal.dot(self.up),
        }
    }

    /// A linear function of direction, over the patch.
    pub(super) fn line(&self, weight: V) -> Line<V::Real> {
        Line { one: weight.dot(self.origin), x: weight.dot(self.right), y: weight.dot(self.up) }
    }
}

/// The function `one + x·x + y·y` on a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line<R: Real> {
    /// Its value at the centre.
    pub one: R,
    /// What x adds.
    pub x: R,
    /// What y adds.
    pub y: R,
}

impl<R: Real> Line<R> {
    /// Its value on the strip at `y`, at x = 0.
    pub fn at(&self, y: R) -> R {
        self.one + self.y * y
    }

    /// The x of the strip at `y` where it is positive.
    pub(super) fn positive(&self, y: R) -> Interval<R> {
        // A slope that is no slope leaves everything or nothing: its zero is far away on the right side.
        let tiny = R::from_f64(1e-30);
        let rising = self.x > R::ZERO;
        let slope = if rising { self.x.max(tiny) } else { self.x.min(-tiny) };
        let zero = -(self.at(y) / slope);
        if rising {
            Interval { low: zero, high: R::INFINITY }
        } else {
            Interval { low: -R::INFINITY, high: zero }
        }
    }
}

/// What the strips of a patch send to a receiver: the horizon, and the irradiance of an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strips<R: Real> {
    /// Cosine at the receiver, times the length of the direction.
    pub level: Line<R>,
    /// The square of `right`.
    square: R,
    /// The x, less x = 0's, at which a strip is nearest to the point.
    shift: R,
    /// Coefficients of the squared distance of the strip at y from the point, in units of x: 1, 2 y, y².
    apart: [R; 3],
    /// Whether the light is round.
    pub round: bool,
}

impl<R: Real> Strips<R> {
    /// The strips of `patch` for a receiver with unit normal `normal`.
    pub fn new<V: Vector<Real = R>>(patch: &Patch<V>, normal: V) -> Self {
        let square = patch.right.dot(patch.right);
        let (k0, k1) = (patch.origin.cross(patch.right), patch.up.cross(patch.right));
        let scale = R::ONE / (square * square);
        Self {
            level: patch.line(normal),
            square,
            shift: patch.origin.dot(patch.right) / square,
            apart: [k0.dot(k0) * scale, k0.dot(k1) * scale, k1.dot(k1) * scale],
            round: patch.round,
        }
    }

    /// The y of the strips that are above the horizon, all or in part.
    pub fn rows(&self) -> Interval<R> {
        let best = Line { one: self.level.one + self.level.x.abs(), x: self.level.y, y: R::ZERO };
        best.positive(R::ZERO).and(Interval { low: -R::ONE, high: R::ONE })
    }

    /// The x of the strip at `y` that are light, and above the horizon.
    pub fn seen(&self, y: R) -> Interval<R> {
        let half = if self.round { (R::ONE - y * y).max(R::ZERO).sqrt() } else { R::ONE };
        self.level.positive(y).and(Interval { low: -half, high: half })
    }

    /// Irradiance from an interval of the strip at `y`, up to a factor that is the same for all strips of a patch; 0
    /// for an empty one. The interval is inside [`Self::seen`].
    ///
    /// The integral of `n·ω / |ω|⁴` along the strip: `|ω|²` is a quadratic without real roots, so it is an
    /// arctangent and two fractions.
    pub fn irradiance(&self, y: R, interval: Interval<R>) -> R {
        let [p0, p1, p2] = self.apart;
        let apart_2 = (p0 + y * (p1 + p1 + p2 * y)).max(R::from_f64(1e-30));
        let apart = apart_2.sqrt();
        let level = self.level.at(y) - self.level.x * self.shift;
        let (low, high) = (interval.low + self.shift, interval.high + self.shift);
        let width = (high - low).max(R::ZERO);
        let (low_2, high_2) = (low * low + apart_2, high * high + apart_2);
        let turn = upper_angle(width * apart, apart_2 + low * high) / apart;
        // high / high² - low / low² over one denominator, without cancelling.
        let both = R::ONE / (low_2 * high_2);
        let even = (width * (apart_2 - low * high) * both + turn) / (apart_2 + apart_2);
        let odd = width * (high + low) * R::HALF * both;
        let sum = (level * even + self.level.x * odd) / (self.square * self.square);
        if width > R::ZERO { sum } else { R::ZERO }
    }

    /// The irradiance of the whole patch, in the units of [`Self::irradiance`].
    pub fn whole(&self, nodes: &Nodes<R>) -> R {
        nodes.integrate(self.round, self.rows(), |y| self.irradiance(y, self.seen(y)))
    }
}

/// The angle of (x, y), y not negative.
fn upper_angle<R: Real>(y: R, x: R) -> R {
    y.atan2(x)
}

/// The cosine-weighted solid angle of a ball's cap over π: its irradiance for a radiance of 1/π. `sine` is that of the
/// cap's half-angle, in (0, 1), `cosine` that of the angle between its axis and the receiver's normal. S. Lagarde,
/// C. de Rousiers: Moving Frostbite to PBR, 2014, after J. Snyder.
pub fn cap_irradiance(sine: f32, cosine: f32) -> f32 {
    let sine_2 = sine * sine;
    if cosine > sine {
        return cosine * sine_2;
    }
    if cosine < -sine {
        return 0.0;
    }
    let x = (1.0 / sine_2.max(1e-30) - 1.0).max(0.0).sqrt();
    let across = (1.0 - cosine * cosine).max(1e-12).sqrt();
    let y = (-x * cosine / across).clamp(-1.0, 1.0);
    let z = across * (1.0 - y * y).sqrt();
    (((cosine * y.acos() - x * z) * sine_2 + z.atan2(x.max(1e-30))) * core::f32::consts::FRAC_1_PI).max(0.0)
}
