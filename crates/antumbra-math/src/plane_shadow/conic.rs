//! Conics: as an equation, by centre and axes, and as the shadow of a circle.

use glam::{DMat3, DVec2, DVec3};

use super::ShadowKind;
use super::angles::Angles;
use super::edge::Edge;

/// Conics this close to a parabola, as a fraction of their weight at the vertex, are made parabolas,
/// and those that reach no more than this in front of the light do not. Rounding leaves 1e-16 of a
/// light that stands exactly as high as the top of a ball or its bottom; what changes lies beyond 1e12
/// times the size of the shadow's near end.
const PARABOLIC: f64 = 1e-12;

/// Weights 1 - h/H below this are zero, and the shadow at infinity: rounding leaves 1e-16 of a point
/// meant to be as high as the light.
pub(super) const IDEAL: f64 = 1e-14;

/// A conic of the plane: the points p = (x, y, 1) with pᵀ K p = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conic {
    /// The symmetric matrix K, of Frobenius norm 1, its sign such that pᵀ K p < 0 inside: in an
    /// ellipse, on the side of a parabola's or a hyperbola's foci. The two branches of a hyperbola
    /// are one conic; only one of them is a shadow.
    pub matrix: DMat3,
}

impl Conic {
    /// pᵀ K p: negative inside, positive outside, 0 on the conic; not a distance.
    pub fn value(&self, point: DVec2) -> f64 {
        let p = point.extend(1.0);
        p.dot(self.matrix * p)
    }
}

/// The centre and the axes of an ellipse or a hyperbola.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes {
    /// Metres.
    pub center: DVec2,
    /// From the centre to a vertex, metres. Of an ellipse the longer semi-axis; of a hyperbola the
    /// transverse one, to the vertex of the branch that is the shadow.
    pub first: DVec2,
    /// Perpendicular to it: of an ellipse the shorter semi-axis, of a hyperbola the conjugate one
    /// (the asymptotes run along `first ± second`), metres.
    pub second: DVec2,
}

/// A circle in space, its coordinates (x, y, height) in a plane's frame: center + a cos t + b sin t
/// with b parallel to the plane, so that t = 0 is the lowest point and t = π the highest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ring {
    pub(super) center: DVec3,
    pub(super) a: DVec3,
    pub(super) b: DVec3,
}

impl Ring {
    /// The circle of this centre and radius perpendicular to the unit vector `normal`.
    pub(super) fn new(center: DVec3, normal: DVec3, radius: f64) -> Self {
        let level = DVec2::new(normal.y, -normal.x).normalize_or(DVec2::X);
        let b = level.extend(0.0);
        let a = b.cross(normal).normalize_or(DVec3::Y);
        let a = if a.z > 0.0 { -a } else { a };
        Self { center, a: a * radius, b: b * radius }
    }

    /// The point at angle `t`.
    pub(super) fn at(&self, t: f64) -> DVec3 {
        let (sin, cos) = t.sin_cos();
        self.center + self.a * cos + self.b * sin
    }

    /// The height of the highest point.
    pub(super) fn top(&self) -> f64 {
        self.center.z - self.a.z
    }

    /// The angles where the circle is above the plane.
    pub(super) fn above(&self) -> Angles {
        Angles::where_nonnegative(self.center.z, self.a.z, 0.0)
    }
}

/// A conic by its homogeneous points c + a cos t + b sin t, b.z = 0 <= a.z: the image of a circle
/// under a projection, the weight (z) largest at t = 0. Only points of weight >= 0 count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Curve {
    c: DVec3,
    a: DVec3,
    b: DVec3,
}

impl Curve {
    /// The curve c + a cos t + b sin t with b.z = 0; made a parabola if it nearly is one.
    pub(super) fn new(c: DVec3, a: DVec3, b: DVec3) -> Self {
        let mut curve = Self { c, a, b };
        if (c.z - a.z.abs()).abs() <= IDEAL + PARABOLIC * (c.z.abs() + a.z.abs()) {
            curve.a.z = c.z.copysign(a.z);
        }
        curve
    }

    /// Ellipse, parabola or hyperbola: by whether the weight vanishes nowhere, once or twice.
    pub(super) fn kind(&self) -> ShadowKind {
        let swing = self.a.z.abs();
        if self.c.z > swing {
            ShadowKind::Ellipse
        } else if self.c.z == swing {
            ShadowKind::Parabola
        } else {
            ShadowKind::Hyperbola
        }
    }

    /// The angles where the weight is not negative; none if the curve only touches the light's height
    /// from above.
    pub(super) fn in_front(&self) -> Angles {
        let swing = self.a.z.abs();
        if self.c.z + swing <= IDEAL + PARABOLIC * (self.c.z.abs() + swing) {
            return Angles::none();
        }
        Angles::where_nonnegative(self.c.z, self.a.z, 0.0)
    }

    /// The parts of the curve over `angles`, which must all be in front: a chain for each span, of
    /// arcs of at most a quarter turn.
    pub(super) fn chains(&self, angles: &Angles) -> Vec<Vec<Edge>> {
        self.chains_between(angles, |t| self.c + self.a * t.cos() + self.b * t.sin())
    }

    /// The same with the arcs' ends as `end` computes them.
    pub(super) fn chains_between(&self, angles: &Angles, end: impl Fn(f64) -> DVec3) -> Vec<Vec<Edge>> {
        let arc = |(from, to): (f64, f64)| {
            let (half, middle) = (0.5 * (to - from), 0.5 * (to + from));
            let control = self.c * half.cos() + self.a * middle.cos() + self.b * middle.sin();
            let control = match self.kind() {
                // The tangents at a parabola's point at infinity are there too.
                ShadowKind::Parabola => self.snapped(control),
                _ => control.with_z(control.z.max(0.0)),
            };
            Edge::Arc([self.snapped(end(from)), control, self.snapped(end(to))])
        };
        angles.quarters().into_iter().map(|span| span.into_iter().map(arc).collect()).collect()
    }

    /// A point of the curve; at infinity, if it was meant to be.
    pub(super) fn snapped(&self, p: DVec3) -> DVec3 {
        let fraction = if self.kind() == ShadowKind::Parabola { 2.0 * PARABOLIC } else { IDEAL };
        let noise = IDEAL + fraction * (self.c.z.abs() + self.a.z.abs());
        if p.z.abs() <= noise { p.with_z(0.0) } else { p }
    }

    /// The equation.
    ///
    /// With M = [c a b] the points are M (1, cos t, sin t), so K = M⁻ᵀ diag(-1, 1, 1) M⁻¹; the rows
    /// of M⁻¹ are vector products. It is the inverse of the dual conic P Q* Pᵀ = a aᵀ + b bᵀ - c cᵀ
    /// of the projected dual quadric Q* of the disc (Hartley and Zisserman, Multiple View Geometry,
    /// 2nd edition, §8.3, Result 8.6). `None` if the circle is seen edge-on.
    pub(super) fn conic(&self) -> Option<Conic> {
        let outer = |n: DVec3| DMat3::from_cols(n * n.x, n * n.y, n * n.z);
        let (nc, na, nb) = (self.a.cross(self.b), self.b.cross(self.c), self.c.cross(self.a));
        let k = outer(na) + outer(nb) - outer(nc);
        let norm = k.to_cols_array().iter().map(|x| x * x).sum::<f64>().sqrt();
        (norm > 0.0 && norm.is_finite()).then(|| Conic { matrix: k * (1.0 / norm) })
    }

    /// Centre and axes; `None` for a parabola.
    ///
    /// A boost in the plane of c and a (the conic stays what it is under every Lorentz
    /// transformation of (c, a, b)) takes the weight out of one of the two. What keeps it is the
    /// centre, the other one and b are conjugate semi-diameters, and turning them (Rytz's
    /// construction) gives the axes.
    pub(super) fn axes(&self) -> Option<Axes> {
        let (cw, aw) = (self.c.z, self.a.z.abs());
        let a = if self.a.z < 0.0 { -self.a } else { self.a };
        let (c, b) = (self.c, self.b.truncate());
        let square = (cw - aw) * (cw + aw);
        let center = ((c * cw - a * aw) / square).truncate();
        let (p, q) = (((a * cw - c * aw) / square).truncate(), b / square.abs().sqrt());
        let (pp, qq, pq) = (p.length_squared(), q.length_squared(), p.dot(q));
        let first = match self.kind() {
            ShadowKind::Ellipse => {
                let (sin, cos) = (0.5 * (2.0 * pq).atan2(pp - qq)).sin_cos();
                p * cos + q * sin
            }
            ShadowKind::Hyperbola => {
                let turn = 0.5 * (-2.0 * pq / (pp + qq)).atanh();
                p * turn.cosh() + q * turn.sinh()
            }
            _ => return None,
        };
        // Turning keeps the area between the two.
        let second = first.perp() * (p.perp_dot(q) / first.length_squared());
        let axes = Axes { center, first, second };
        (axes.center.is_finite() && axes.first.is_finite() && axes.second.is_finite()).then_some(axes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The curve with the first axis `first`, the second `second` and the centre `center`, seen
    /// through a boost and a turn.
    fn ellipse(center: DVec2, first: DVec2, second: DVec2, boost: f64) -> Curve {
        let (c, a) = (center.extend(1.0), first.extend(0.0));
        let (sinh, cosh) = (boost.sinh(), boost.cosh());
        Curve::new(c * cosh + a * sinh, a * cosh + c * sinh, second.extend(0.0))
    }

    #[test]
    fn axes_of_an_ellipse_survive_a_boost() {
        let (center, first, second) = (DVec2::new(3.0, -1.0), DVec2::new(2.0, 1.0), DVec2::new(-0.5, 1.0));
        for boost in [0.0, 0.5, -0.5, 2.0, 5.0] {
            let curve = ellipse(center, first, second, boost);
            assert_eq!(curve.kind(), ShadowKind::Ellipse, "boost {boost}");
            let axes = curve.axes().expect("an ellipse has axes");
            let error = (axes.center - center).length()
                + (axes.first.length() - first.length()).abs()
                + axes.first.dot(second).abs()
                + (axes.second.length() - second.length()).abs();
            assert!(error < 1e-15 * (4.0 * boost.abs()).exp() * 100.0, "boost {boost}: {error:e}");
        }
    }

    #[test]
    fn axes_of_a_hyperbola_lead_to_its_branch() {
        // (x - 1)²/4 - y²/9 = 1, the right branch: weight cos t, points (1 ± 2, ..).
        let curve = Curve::new(DVec3::new(2.0, 0.0, 0.0), DVec3::new(1.0, 0.0, 1.0), DVec3::Y * 3.0);
        assert_eq!(curve.kind(), ShadowKind::Hyperbola, "the weight changes sign");
        let axes = curve.axes().expect("a hyperbola has axes");
        assert!((axes.center - DVec2::X).length() < 1e-15, "centre {}", axes.center);
        assert!((axes.first - 2.0 * DVec2::X).length() < 1e-15, "towards the branch: {}", axes.first);
        assert!((axes.second.abs() - 3.0 * DVec2::Y).length() < 1e-15, "conjugate: {}", axes.second);
        let conic = curve.conic().expect("not edge-on");
        for (point, sign) in [(DVec2::new(4.0, 0.0), -1.0), (DVec2::new(1.0, 1.0), 1.0)] {
            assert!(conic.value(point) * sign > 0.0, "{point}: {}", conic.value(point));
        }
        assert!(conic.value(DVec2::new(3.0, 0.0)).abs() < 1e-15, "the vertex is on the conic");
    }

    #[test]
    fn nearly_parabolic_curves_are_parabolas() {
        let curve = |w: f64| Curve::new(DVec3::new(0.0, 0.0, w), DVec3::new(1.0, 0.0, 1.0), DVec3::Y);
        assert_eq!(curve(1.0 + 1e-13).kind(), ShadowKind::Parabola, "from the ellipses");
        assert_eq!(curve(1.0 - 1e-13).kind(), ShadowKind::Parabola, "from the hyperbolas");
        assert_eq!(curve(1.0 + 1e-11).kind(), ShadowKind::Ellipse, "an ellipse");
        assert_eq!(curve(1.0 - 1e-11).kind(), ShadowKind::Hyperbola, "a hyperbola");
        assert!(curve(1.0).axes().is_none(), "a parabola has no centre");
    }
}
