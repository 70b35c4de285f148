//! Intervals of a strip.

use crate::real::Real;

/// An interval of the reals, empty unless `low < high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval<R: Real> {
    /// Its lower end; -∞ for none.
    pub low: R,
    /// Its upper end; +∞ for none.
    pub high: R,
}

impl<R: Real> Interval<R> {
    /// Everything.
    pub fn all() -> Self {
        Self { low: -R::INFINITY, high: R::INFINITY }
    }

    /// Nothing.
    pub fn empty() -> Self {
        Self { low: R::INFINITY, high: -R::INFINITY }
    }

    /// Whether there is nothing in it.
    pub fn is_empty(&self) -> bool {
        !(self.low < self.high)
    }

    /// What is in both.
    pub fn and(self, other: Self) -> Self {
        Self { low: self.low.max(other.low), high: self.high.min(other.high) }
    }

    /// The least interval that holds both.
    pub fn hull(self, other: Self) -> Self {
        if self.is_empty() {
            return other;
        }
        if other.is_empty() {
            return self;
        }
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }
}
