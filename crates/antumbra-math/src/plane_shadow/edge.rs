//! One piece of a shadow's boundary: a straight line or an arc of a conic, in homogeneous
//! coordinates (x w, y w, w), so that its ends may lie at infinity (w = 0).
//!
//! An arc is a rational quadratic Bézier curve, B0 (1-t)² + 2 B1 t (1-t) + B2 t², which is every arc
//! of every conic (Farin, NURBS: from Projective Geometry to Practical Use, 1999; Lee, The rational
//! Bézier representation for conics, 1987). Nothing in it is singular at the parabola.

use glam::{DVec2, DVec3};

/// Directions this close to a coordinate axis count as parallel to it, where a bound would otherwise
/// jump between a number and infinity.
const PARALLEL: f64 = 1e-12;

/// Below this sine of the angle between two lines (as homogeneous vectors) their common point is taken
/// between the ends of the one that is cut: both ways of computing it are then equally good.
const NEARLY_SAME: f64 = 1e-8;

/// A line or an arc. All w >= 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Edge {
    /// From one point to another; a corner if they are the same.
    Line([DVec3; 2]),
    /// The control points of an arc.
    Arc([DVec3; 3]),
}

impl Edge {
    /// Where the edge begins.
    pub(super) fn start(&self) -> DVec3 {
        match self {
            Self::Line([a, _]) | Self::Arc([a, _, _]) => *a,
        }
    }

    /// Where the edge ends.
    pub(super) fn end(&self) -> DVec3 {
        match self {
            Self::Line([_, b]) | Self::Arc([_, _, b]) => *b,
        }
    }

    /// The point of parameter `t` in [0, 1].
    pub(super) fn at(&self, t: f64) -> DVec3 {
        self.at_pair([1.0 - t, t])
    }

    /// The point of parameters (1 - t, t), both of which are exact next to 0.
    fn at_pair(&self, [s, t]: [f64; 2]) -> DVec3 {
        match *self {
            Self::Line([a, b]) => a * s + b * t,
            Self::Arc([a, b, c]) => a * (s * s) + b * (2.0 * s * t) + c * (t * t),
        }
    }

    /// The same edge, run through backwards.
    pub(super) fn reversed(&self) -> Self {
        match *self {
            Self::Line([a, b]) => Self::Line([b, a]),
            Self::Arc([a, b, c]) => Self::Arc([c, b, a]),
        }
    }

    /// The edge under a linear map of homogeneous points.
    pub(super) fn map(&self, f: impl Fn(DVec3) -> DVec3) -> Self {
        match *self {
            Self::Line(p) => Self::Line(p.map(f)),
            Self::Arc(p) => Self::Arc(p.map(f)),
        }
    }

    /// Whether every number is finite.
    pub(super) fn is_finite(&self) -> bool {
        match self {
            Self::Line(p) => p.iter().all(|p| p.is_finite()),
            Self::Arc(p) => p.iter().all(|p| p.is_finite()),
        }
    }

    /// Whether an edge bends: an arc of a conic seen edge-on does not.
    pub(super) fn is_curved(&self) -> bool {
        match *self {
            Self::Line(_) => false,
            Self::Arc([a, b, c]) => b.dot(c.cross(a)).abs() > PARALLEL * a.length() * b.length() * c.length(),
        }
    }

    /// Twice the area of the control triangle times the weights: positive for an arc that turns left;
    /// 0 for a line.
    pub(super) fn turn(&self) -> f64 {
        match *self {
            Self::Line(_) => 0.0,
            Self::Arc([a, b, c]) => a.dot(b.cross(c)),
        }
    }

    /// The part from one pair of parameters to another.
    fn part(&self, from: [f64; 2], to: [f64; 2]) -> Self {
        match *self {
            Self::Line(_) => Self::Line([self.at_pair(from), self.at_pair(to)]),
            Self::Arc([a, b, c]) => {
                let ([s0, t0], [s1, t1]) = (from, to);
                let middle = a * (s0 * s1) + b * (s0 * t1 + s1 * t0) + c * (t0 * t1);
                Self::Arc([self.at_pair(from), middle, self.at_pair(to)])
            }
        }
    }

    /// The parts of the edge where `f` · point >= 0, in order.
    pub(super) fn clipped(&self, f: DVec3) -> Vec<Self> {
        match *self {
            Self::Line([a, b]) => {
                // Ends on the cut to rounding are on it: a point at infinity would turn into one far away.
                let on = |p: DVec3| {
                    let value = f.dot(p);
                    if value.abs() <= 4.0 * f64::EPSILON * f.abs().dot(p.abs()) { 0.0 } else { value }
                };
                let (fa, fb) = (on(a), on(b));
                // b fa - a fb: in a form that stays exact when the ends are far away to both sides,
                // but not if the line and the cut are nearly the same.
                let line = a.cross(b);
                let between = (a * fb.abs() + b * fa.abs()) / (fa.abs() + fb.abs());
                let exact = line.cross(f);
                let same = exact.length() <= NEARLY_SAME * line.length() * f.length();
                let exact = exact * (between.z / exact.z);
                let cut = if same || !exact.is_finite() { between } else { exact };
                match (fa >= 0.0, fb >= 0.0) {
                    (true, true) => vec![*self],
                    (true, false) if fa > 0.0 => vec![Self::Line([a, cut])],
                    (false, true) if fb > 0.0 => vec![Self::Line([cut, b])],
                    _ => Vec::new(),
                }
            }
            Self::Arc([a, b, c]) => {
                let mut cuts = bernstein_roots(f.dot(a), f.dot(b), f.dot(c)).to_vec();
                cuts.extend([[1.0, 0.0], [0.0, 1.0]]);
                cuts.sort_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
                let kept = |pair: &[[f64; 2]]| {
                    let middle = [0, 1].map(|i| 0.5 * (pair[0][i] + pair[1][i]));
                    let inside = pair[0] != pair[1] && f.dot(self.at_pair(middle)) >= 0.0;
                    inside.then(|| self.part(pair[0], pair[1]))
                };
                cuts.windows(2).filter_map(kept).collect()
            }
        }
    }

    /// The largest `direction` · point on the edge, and the homogeneous point where it is; infinite
    /// where the edge runs off that way.
    pub(super) fn support(&self, direction: DVec2) -> (f64, DVec3) {
        let d = direction.extend(0.0);
        let mut best = (f64::NEG_INFINITY, self.start());
        let mut consider = |p: DVec3, value: f64| {
            if value > best.0 {
                best = (value, p);
            }
        };
        let is_ideal_beyond = |p: DVec3| d.dot(p) > PARALLEL * p.length();
        for end in [self.start(), self.end()] {
            if end.z > 0.0 {
                consider(end, d.dot(end) / end.z);
            } else if is_ideal_beyond(end) {
                consider(end, f64::INFINITY);
            }
        }
        if let Self::Arc([a, b, c]) = *self {
            // An arc that ends at infinity across the direction: it has an asymptote, the tangent
            // there, or none (a parabola), and then it runs off along the tangent.
            for end in [a, c] {
                if end.z <= 0.0 && d.dot(end).abs() <= PARALLEL * end.length() {
                    if b.z > 0.0 {
                        consider(end, d.dot(b) / b.z);
                    } else if is_ideal_beyond(b) {
                        consider(end, f64::INFINITY);
                    }
                }
            }
            // Zeros of the derivative of x(t) / w(t).
            let cross = |p: DVec3, q: DVec3| d.dot(q) * p.z - d.dot(p) * q.z;
            for pair in bernstein_roots(cross(a, b), 0.5 * cross(a, c), cross(b, c)) {
                let p = self.at_pair(pair);
                if p.z > 0.0 {
                    consider(p, d.dot(p) / p.z);
                }
            }
        }
        best
    }

    /// The area between the arc and its chord, the ends being finite: 0 for a line.
    ///
    /// With the weights brought to (1, ω, 1) the arc is the affine image of a circle's arc of
    /// half-angle α, ω = cos α, or of a hyperbola's, ω = cosh β; the ratio of segment to control
    /// triangle is the same for both.
    pub(super) fn bulge(&self) -> f64 {
        let Self::Arc([a, b, c]) = *self else { return 0.0 };
        let ends = a.z * c.z;
        let omega = b.z / ends.sqrt();
        0.5 * self.turn() * segment_ratio(omega) / (ends * ends.sqrt())
    }

    /// Whether a point is on the inner side of the edge, which runs counterclockwise round a convex
    /// region; `p` = (x, y, 1). Every edge says yes if and only if the point is in the region. Edges
    /// of which both ends are seen from the origin within `short` radians always say yes.
    pub(super) fn admits(&self, p: DVec3, short: f64) -> bool {
        let (a, b) = (self.start(), self.end());
        let chord = a.cross(b);
        // A line at infinity leaves nothing out.
        if a.z <= 0.0 && b.z <= 0.0 {
            return true;
        }
        if chord.length() <= short * a.length() * b.length() || chord.dot(p) >= 0.0 {
            return true;
        }
        match *self {
            Self::Line(_) => false,
            Self::Arc([a, m, b]) => {
                // In the triangle of the control points p = α a + β m + γ b, and the arc is
                // β² = 4 α γ; here all three are multiplied by the same number.
                let (alpha, beta, gamma) = (m.cross(b).dot(p), -chord.dot(p), a.cross(m).dot(p));
                alpha >= 0.0 && gamma >= 0.0 && beta * beta <= 4.0 * alpha * gamma
            }
        }
    }
}

/// The pairs of parameters (1 - t, t), t in (0, 1), where f0 (1-t)² + 2 f1 t (1-t) + f2 t² is zero;
/// (0, 1), the end, for each that is missing. A polynomial that is zero everywhere has none.
fn bernstein_roots(f0: f64, f1: f64, f2: f64) -> [[f64; 2]; 2] {
    const END: [f64; 2] = [0.0, 1.0];
    let discriminant = f1 * f1 - f0 * f2;
    if discriminant.is_nan() || discriminant < 0.0 {
        return [END, END];
    }
    // In t / (1-t) it is f2 x² + 2 f1 x + f0; the two forms of the root avoid cancellation.
    let q = -(f1 + discriminant.sqrt().copysign(f1));
    [(q, f2), (f0, q)].map(|(up, down)| {
        let (s, t) = (down / (up + down), up / (up + down));
        if s > 0.0 && t > 0.0 { [s, t] } else { END }
    })
}

/// (α - sin α cos α) / sin³ α for ω = cos α, continued through ω = 1, where it is 2/3, by
/// (sinh β cosh β - β) / sinh³ β for ω = cosh β.
fn segment_ratio(omega: f64) -> f64 {
    let z = if omega <= 1.0 { omega.acos().powi(2) } else { -omega.acosh().powi(2) };
    if z.abs() < 0.04 {
        // Both in powers of z = α² = -β²; six terms leave less than 1e-16.
        let (mut above, mut sine) = (0.0, 0.0);
        let (mut a, mut s) = (2.0 / 3.0, 1.0);
        for k in 0..6 {
            above += a;
            sine += s;
            let k = f64::from(k);
            a *= -4.0 * z / ((2.0 * k + 4.0) * (2.0 * k + 5.0));
            s *= -z / ((2.0 * k + 2.0) * (2.0 * k + 3.0));
        }
        return above / (sine * sine * sine);
    }
    let sine = ((omega - 1.0) * (omega + 1.0)).abs().sqrt();
    let numerator = if omega <= 1.0 { omega.acos() - sine * omega } else { sine * omega - omega.acosh() };
    numerator / (sine * sine * sine)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An arc of the unit circle from -α to α about the x axis.
    fn circle(alpha: f64) -> Edge {
        let (s, c) = alpha.sin_cos();
        Edge::Arc([DVec3::new(c, -s, 1.0), DVec3::new(1.0, 0.0, c), DVec3::new(c, s, 1.0)])
    }

    #[test]
    fn area_of_segments() {
        for alpha in [1e-3_f64, 0.1, 0.199, 0.201, 1.0, 1.5] {
            let exact = alpha - 0.5 * (2.0 * alpha).sin();
            // What matters is the error in units of the circle's area.
            let error = circle(alpha).bulge() - exact;
            assert!(error.abs() < 1e-15, "circle, {alpha}: {error:e}");
        }
        // y = x² from -1 to 1: Archimedes, 4/3.
        let parabola =
            Edge::Arc([DVec3::new(-1.0, 1.0, 1.0), DVec3::new(0.0, -1.0, 1.0), DVec3::new(1.0, 1.0, 1.0)]);
        assert!((parabola.bulge() - 4.0 / 3.0).abs() < 1e-15, "parabola: {}", parabola.bulge());
        // x² - y² = 1, x > 0, to y = ± sinh β: between arc and chord sinh β cosh β - β.
        let beta: f64 = 1.3;
        let (s, c) = (beta.sinh(), beta.cosh());
        let hyperbola = Edge::Arc([DVec3::new(c, -s, 1.0), DVec3::new(1.0, 0.0, c), DVec3::new(c, s, 1.0)]);
        let error = hyperbola.bulge().abs() - (s * c - beta);
        assert!(error.abs() < 1e-13, "hyperbola: {error:e}");
    }

    #[test]
    fn clipping_an_arc_keeps_the_circle() {
        let parts: Vec<Edge> = circle(1.2).clipped(DVec3::new(-1.0, 0.0, 0.7));
        assert_eq!(parts.len(), 2, "x <= 0.7 cuts the middle out: {parts:?}");
        for part in parts {
            for i in 0..=10 {
                let p = part.at(f64::from(i) / 10.0);
                let (x, y) = (p.x / p.z, p.y / p.z);
                assert!((x.hypot(y) - 1.0).abs() < 1e-14, "on the circle: {x} {y}");
                assert!(x <= 0.7 + 1e-14, "kept side: {x}");
            }
        }
    }

    #[test]
    fn support_of_arcs() {
        let (top, _) = circle(1.0).support(DVec2::X);
        assert!((top - 1.0).abs() < 1e-15, "circle along x: {top}");
        let (side, _) = circle(1.0).support(DVec2::Y);
        assert!((side - 1.0_f64.sin()).abs() < 1e-15, "circle along y: {side}");
        // The right half of y = x²: infinite along x and y though it ends in the direction y.
        let parabola = Edge::Arc([DVec3::Z, DVec3::new(0.5, 0.0, 0.0), DVec3::Y]);
        assert_eq!(parabola.support(DVec2::X).0, f64::INFINITY, "a parabola is infinitely wide");
        assert_eq!(parabola.support(-DVec2::X).0, 0.0, "the vertex");
        // x y = 1 from (1, 1) on: its asymptote is y = 0.
        let hyperbola = Edge::Arc([DVec3::ONE, DVec3::new(1.0, 0.0, 0.5), DVec3::X]);
        assert_eq!(hyperbola.support(-DVec2::Y).0, 0.0, "the asymptote bounds a hyperbola");
    }
}
