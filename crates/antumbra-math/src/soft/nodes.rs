//! Where the strips are, and what each counts.

use super::Interval;
use crate::real::Real;

/// Nodes and weights of Gauss's quadratures on [-1, 1]: of Chebyshev's polynomials of the second kind for round
/// lights, whose strips end like square roots, and of Legendre's for rectangles, whose do not. A light alone is
/// integrated to rounding, or nearly, by a few; a corner of the outline inside the interval leaves an error that falls
/// about as N^-2.
#[derive(Clone, Debug, PartialEq)]
pub struct Nodes<R: Real> {
    round: Vec<(R, R)>,
    square: Vec<(R, R)>,
}

impl<R: Real> Nodes<R> {
    /// `count` of them, at least one; from 1 downwards.
    pub fn new(count: usize) -> Self {
        let count = count.max(1);
        let step = core::f64::consts::PI / (count + 1) as f64;
        let round = |k: usize| {
            let (sine, cosine) = (k as f64 * step).sin_cos();
            (R::from_f64(cosine), R::from_f64(step * sine))
        };
        let square = |k: usize| {
            let (node, weight) = legendre(count, k);
            (R::from_f64(node), R::from_f64(weight))
        };
        Self { round: (1..=count).map(round).collect(), square: (1..=count).map(square).collect() }
    }

    fn of(&self, round: bool) -> &[(R, R)] {
        if round { &self.round } else { &self.square }
    }

    /// The integral over an interval, for a round light or a square one; 0 over an empty one.
    pub fn integrate(&self, round: bool, interval: Interval<R>, mut value: impl FnMut(R) -> R) -> R {
        if interval.is_empty() {
            return R::ZERO;
        }
        let half = (interval.high - interval.low) * R::HALF;
        let middle = (interval.high + interval.low) * R::HALF;
        let mut sum = R::ZERO;
        for &(x, weight) in self.of(round) {
            sum = sum + weight * value(middle + half * x);
        }
        sum * half
    }

    /// The part of an interval where a concave function is positive, from its values at the nodes: where it changes
    /// sign between two, the chord's zero, and from there once more.
    ///
    /// What an occluder hides of a light is convex, so the width of that on a strip, negative where the two pass by
    /// each other, is concave. The nodes belong on the strips where it is positive, and on no others.
    pub fn support(&self, round: bool, interval: Interval<R>, mut value: impl FnMut(R) -> R) -> Interval<R> {
        if interval.is_empty() {
            return interval;
        }
        let half = (interval.high - interval.low) * R::HALF;
        let middle = (interval.high + interval.low) * R::HALF;
        let mut support = Interval::empty();
        let mut last: Option<(R, R)> = None;
        // From high to low, as the nodes are listed.
        for &(x, _) in self.of(round) {
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
            } else if let Some(inside) = last.filter(|(_, width)| *width > R::ZERO) {
                support.low = crossing(inside, (y, here), &mut value);
                return support;
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

/// The k-th zero of Legendre's polynomial, counted from 1 downwards, and its weight: Newton's method from the usual
/// first guess.
fn legendre(count: usize, k: usize) -> (f64, f64) {
    let n = count as f64;
    let mut x = (core::f64::consts::PI * (k as f64 - 0.25) / (n + 0.5)).cos();
    let mut slope = 1.0;
    for _ in 0..8 {
        let (mut before, mut here) = (1.0, x);
        for i in 2..=count {
            let i = i as f64;
            (before, here) = (here, ((2.0 * i - 1.0) * x * here - (i - 1.0) * before) / i);
        }
        slope = n * (x * here - before) / (x * x - 1.0);
        x -= here / slope;
    }
    (x, 2.0 / ((1.0 - x * x) * slope * slope))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_and_circles_are_exact() {
        let all = Interval { low: -1.0, high: 1.0 };
        for count in [1, 2, 3, 8, 24] {
            let nodes = Nodes::<f64>::new(count);
            for power in 0..2 * count {
                let exact = if power % 2 == 0 { 2.0 / (power as f64 + 1.0) } else { 0.0 };
                let sum = nodes.integrate(false, all, |x| x.powi(power as i32));
                assert!((sum - exact).abs() < 1e-13, "{count} nodes, x^{power}: {sum}");
            }
            let disc = nodes.integrate(true, all, |x: f64| 2.0 * (1.0 - x * x).sqrt());
            assert!((disc - core::f64::consts::PI).abs() < 1e-13, "{count} nodes, a disc: {disc}");
        }
    }

    #[test]
    fn the_support_of_a_concave_function() {
        let nodes = Nodes::<f64>::new(8);
        for (low, high) in [(-0.3, 0.9), (-1.5, 0.2), (-0.05, 0.3), (-2.0, 2.0)] {
            let found = nodes.support(true, Interval { low: -1.0, high: 1.0 }, |y| (y - low) * (high - y));
            let [a, b] = [low.max(-1.0), high.min(1.0)];
            // A chord lies inside: by less than a sixth of the way between two nodes.
            assert!((found.low - a).abs() < 0.05 && (found.high - b).abs() < 0.05, "{low} {high}: {found:?}");
        }
        let none = nodes.support(false, Interval { low: -1.0, high: 1.0 }, |_| -1.0);
        assert!(none.is_empty(), "nowhere positive: {none:?}");
    }
}
