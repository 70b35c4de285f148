//! Where the strips are, and what each counts.

use super::Interval;
use crate::real::Real;

/// Nodes and weights of a quadrature on [-1, 1] for integrands that end like square roots, as the widths of round
/// things do: Gauss's of Chebyshev's polynomials of the second kind. The light alone, a disc, is integrated to
/// rounding by a few; a corner of the outline inside the interval leaves an error that falls about as N^-2.
#[derive(Clone, Debug, PartialEq)]
pub struct Nodes<R: Real> {
    nodes: Vec<(R, R)>,
}

impl<R: Real> Nodes<R> {
    /// `count` of them, at least one.
    pub fn new(count: usize) -> Self {
        let count = count.max(1);
        let step = core::f64::consts::PI / (count + 1) as f64;
        let node = |k: usize| {
            let (sine, cosine) = (k as f64 * step).sin_cos();
            (R::from_f64(cosine), R::from_f64(step * sine))
        };
        Self { nodes: (1..=count).map(node).collect() }
    }

    /// The integral over an interval; 0 over an empty one.
    pub fn integrate(&self, interval: Interval<R>, mut value: impl FnMut(R) -> R) -> R {
        if interval.is_empty() {
            return R::ZERO;
        }
        let half = (interval.high - interval.low) * R::HALF;
        let middle = (interval.high + interval.low) * R::HALF;
        let mut sum = R::ZERO;
        for &(x, weight) in &self.nodes {
            sum = sum + weight * value(middle + half * x);
        }
        sum * half
    }

    /// The part of an interval where a concave function is positive, from its values at the nodes: where it changes
    /// sign between two, the chord's zero, and from there once more.
    ///
    /// What an occluder hides of a light is convex, so the width of that on a strip, negative where the two pass by
    /// each other, is concave. The nodes belong on the strips where it is positive, and on no others.
    pub fn support(&self, interval: Interval<R>, mut value: impl FnMut(R) -> R) -> Interval<R> {
        if interval.is_empty() {
            return interval;
        }
        let half = (interval.high - interval.low) * R::HALF;
        let middle = (interval.high + interval.low) * R::HALF;
        let mut support = Interval::empty();
        let mut last: Option<(R, R)> = None;
        // From high to low, as the nodes are listed.
        for &(x, _) in &self.nodes {
            let y = middle + half * x;
            let here = value(y);
            if here > R::ZERO {
                if support.is_empty() {
                    support.high = match last {
                        Some((y_out, out)) => crossing((y, here), (y_out, out), &mut value),
                        None => interval.high,
                    };
                }
                support.low = interval.low;
            } else if let (Some((y_in, inside)), false) = (last, support.is_empty()) {
                if inside > R::ZERO {
                    support.low = crossing((y_in, inside), (y, here), &mut value);
                    return support;
                }
            }
            last = Some((y, here));
        }
        support
    }
}

/// Where a concave function falls from positive (inside) to negative (outside), about.
fn crossing<R: Real>(inside: (R, R), outside: (R, R), value: &mut impl FnMut(R) -> R) -> R {
    let zero = |a: (R, R), b: (R, R)| a.0 + (b.0 - a.0) * (a.1 / (a.1 - b.1));
    // Not negative, because the chord lies below the function.
    let first = zero(inside, outside);
    let there = value(first);
    if there > R::ZERO { zero((first, there), outside) } else { first }
}
