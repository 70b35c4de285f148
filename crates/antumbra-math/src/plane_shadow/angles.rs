//! Sets of angles: which part of a circle is above the plane, below the light, seen by the light.

use core::f64::consts::{PI, TAU};

/// A set of angles, radians, as disjoint spans [from, to] modulo 2π. The whole circle is the one
/// span [-π, π]; no other span is as long.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Angles {
    spans: Vec<(f64, f64)>,
}

impl Angles {
    /// No angle.
    pub(super) fn none() -> Self {
        Self { spans: Vec::new() }
    }

    /// Every angle.
    pub(super) fn all() -> Self {
        Self { spans: vec![(-PI, PI)] }
    }

    /// The angles within `half` of `middle`.
    pub(super) fn around(middle: f64, half: f64) -> Self {
        Self { spans: vec![(middle - half, middle + half)] }
    }

    /// The angles t with f0 + fa cos t + fb sin t >= 0: all, none, or one span. A function that is
    /// zero everywhere gives all of them, one with a NaN none.
    pub(super) fn where_nonnegative(f0: f64, fa: f64, fb: f64) -> Self {
        let swing = fa.hypot(fb);
        if f0 >= swing {
            return Self::all();
        }
        if f0 <= -swing || (f0 + swing).is_nan() {
            return Self::none();
        }
        // acos(-f0 / swing), with full precision at both ends.
        let half = ((swing - f0) * (swing + f0)).sqrt().atan2(-f0);
        Self::around(fb.atan2(fa), half)
    }

    /// Whether this is the whole circle.
    pub(super) fn is_all(&self) -> bool {
        self.spans == [(-PI, PI)]
    }

    /// Whether no angle is in the set.
    pub(super) fn is_none(&self) -> bool {
        self.spans.is_empty()
    }

    /// The ends of a set of one span; `None` for the whole circle, no angle or several spans.
    pub(super) fn ends(&self) -> Option<[f64; 2]> {
        match self.spans[..] {
            [(from, to)] if !self.is_all() => Some([from, to]),
            _ => None,
        }
    }

    /// The other angles, for a set of at most one span.
    pub(super) fn complement(&self) -> Self {
        match self.ends() {
            Some([from, to]) => Self { spans: vec![(to, from + TAU)] },
            None if self.is_none() => Self::all(),
            None => Self::none(),
        }
    }

    /// The angles in both sets.
    pub(super) fn and(&self, other: &Self) -> Self {
        if self.is_all() {
            return other.clone();
        }
        if other.is_all() {
            return self.clone();
        }
        let mut spans = Vec::new();
        for a in &self.spans {
            for b in &other.spans {
                // Ends lie within [-3π, 3π], so two turns bring any pair together.
                for turns in -3..=3 {
                    let shift = TAU * f64::from(turns);
                    let (from, to) = (a.0.max(b.0 + shift), a.1.min(b.1 + shift));
                    if from < to {
                        spans.push((from, to));
                    }
                }
            }
        }
        Self { spans }
    }

    /// The spans.
    pub(super) fn spans(&self) -> impl Iterator<Item = (f64, f64)> {
        self.spans.iter().copied()
    }

    /// The spans, each cut at every multiple of π/2.
    pub(super) fn quarters(&self) -> Vec<Vec<(f64, f64)>> {
        let quarter = |&(from, to): &(f64, f64)| {
            let mut cut = Vec::new();
            let mut at = from;
            let mut next = (from / (PI / 2.0)).floor() + 1.0;
            while next * (PI / 2.0) < to {
                cut.push((at, next * (PI / 2.0)));
                at = next * (PI / 2.0);
                next += 1.0;
            }
            cut.push((at, to));
            cut
        };
        self.spans.iter().map(quarter).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarters_of_the_circle() {
        let quarters = Angles::all().quarters().concat();
        assert_eq!(quarters.len(), 4, "four quarters: {quarters:?}");
        let total: f64 = quarters.iter().map(|q| q.1 - q.0).sum();
        assert!((total - TAU).abs() < 1e-14, "they make up the circle: {total}");
    }

    #[test]
    fn sets_agree_with_their_functions() {
        // Two functions, their common part, and the complement of the first, at 1000 angles.
        let (f, g) = ([0.3, -0.8, 0.5], [-0.2, 0.1, 0.9]);
        let value = |f: [f64; 3], t: f64| f[0] + f[1] * t.cos() + f[2] * t.sin();
        let first = Angles::where_nonnegative(f[0], f[1], f[2]);
        let both = first.and(&Angles::where_nonnegative(g[0], g[1], g[2]));
        let not = first.complement();
        let has = |set: &Angles, t: f64| {
            set.spans.iter().any(|s| (-2..=2).any(|k| (s.0..=s.1).contains(&(t + TAU * f64::from(k)))))
        };
        for i in 0..1000 {
            let t = f64::from(i) * TAU / 1000.0 + 1e-4;
            assert_eq!(has(&both, t), value(f, t) >= 0.0 && value(g, t) >= 0.0, "both, at {t}");
            assert_eq!(has(&not, t), value(f, t) < 0.0, "complement, at {t}");
        }
    }

    #[test]
    fn degenerate_functions() {
        assert!(Angles::where_nonnegative(0.0, 0.0, 0.0).is_all(), "zero everywhere");
        assert!(Angles::where_nonnegative(-1.0, 1.0, 0.0).is_none(), "touches from below");
        assert!(Angles::where_nonnegative(1.0, 0.0, -1.0).is_all(), "touches from above");
        assert!(Angles::where_nonnegative(f64::NAN, 1.0, 1.0).is_none(), "NaN");
        assert!(Angles::where_nonnegative(1.0, f64::NAN, 1.0).is_none(), "NaN");
    }
}
