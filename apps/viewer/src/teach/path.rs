//! Lines cut into the parts that count: by a window, by where a light shines, without the window's own sides.

use antumbra::math::PlaneShadow;
use antumbra::math::plane_shadow::{Bounds, ShadowKind};
use glam::{DVec2, DVec3};

use super::{Drawing, LineKind, Pair, PlanarReceiver};

/// What is this close to a window's side, as a fraction of its size, lies on it.
const ON_SIDE: f64 = 1e-9;

/// Straight pieces through points of a plane or of space.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Path<P> {
    pub(super) points: Vec<P>,
    /// Whether the last point is joined to the first, which is not repeated.
    pub(super) closed: bool,
}

impl<P: Copy + PartialEq> Path<P> {
    pub(super) fn closed(points: Vec<P>) -> Self {
        Self { points, closed: true }
    }

    pub(super) fn open(points: Vec<P>) -> Self {
        Self { points, closed: false }
    }

    /// The parts that `part` leaves of the straight pieces, joined where they still meet.
    pub(super) fn split(&self, part: impl Fn(P, P) -> Option<(P, P)>) -> Vec<Self> {
        let next = self.points.iter().cycle().skip(1);
        let count = self.points.len() - usize::from(!self.closed && !self.points.is_empty());
        let mut runs: Vec<Vec<P>> = Vec::new();
        for (&a, &b) in self.points.iter().zip(next).take(count) {
            let Some((a, b)) = part(a, b).filter(|(a, b)| a != b) else { continue };
            match runs.last_mut() {
                Some(run) if run.last() == Some(&a) => run.push(b),
                _ => runs.push(vec![a, b]),
            }
        }
        if self.closed {
            if let [run] = &mut runs[..]
                && run.len() > 2
                && run.first() == run.last()
            {
                run.pop();
                return runs.into_iter().map(Self::closed).collect();
            }
            if runs.len() > 1
                && runs[0].first() == runs[runs.len() - 1].last()
                && let Some(mut last) = runs.pop()
            {
                last.extend_from_slice(&runs[0][1..]);
                runs[0] = last;
            }
        }
        runs.into_iter().map(Self::open).collect()
    }
}

impl Path<DVec3> {
    /// The parts where `value`, which is concave along straight lines, is above zero.
    pub(super) fn where_positive(&self, value: impl Fn(DVec3) -> f64) -> Vec<Self> {
        self.split(|a, b| match (value(a) > 0.0, value(b) > 0.0) {
            (true, true) => Some((a, b)),
            (true, false) => Some((a, zero(a, b, &value))),
            (false, true) => Some((zero(b, a, &value), b)),
            (false, false) => {
                let top = highest(a, b, &value);
                (value(top) > 0.0).then(|| (zero(top, a, &value), zero(top, b, &value)))
            }
        })
    }
}

/// Where a concave function is highest between two points, to a millionth of their distance.
fn highest(a: DVec3, b: DVec3, value: impl Fn(DVec3) -> f64) -> DVec3 {
    let (mut from, mut to) = (0.0, 1.0);
    for _ in 0..34 {
        let third = (to - from) / 3.0;
        if value(a.lerp(b, from + third)) < value(a.lerp(b, to - third)) {
            from += third;
        } else {
            to -= third;
        }
    }
    a.lerp(b, 0.5 * (from + to))
}

/// Where `value` falls to zero from `inside` to `outside`, on the inner side of it.
fn zero(inside: DVec3, outside: DVec3, value: impl Fn(DVec3) -> f64) -> DVec3 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..54 {
        let middle = 0.5 * (low + high);
        if value(inside.lerp(outside, middle)) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    inside.lerp(outside, low)
}

impl Path<DVec2> {
    /// The parts in a box (Liang and Barsky, A New Concept and Method for Line Clipping, 1984).
    pub(super) fn within(&self, bounds: &Bounds) -> Vec<Self> {
        self.split(|a, b| {
            let (mut from, mut to) = (0.0_f64, 1.0_f64);
            for axis in 0..2 {
                let d = b[axis] - a[axis];
                for (gap, slope) in [(a[axis] - bounds.min[axis], d), (bounds.max[axis] - a[axis], -d)] {
                    if slope > 0.0 {
                        from = from.max(-gap / slope);
                    } else if slope < 0.0 {
                        to = to.min(gap / -slope);
                    } else if gap < 0.0 {
                        return None;
                    }
                }
            }
            let at = |t: f64| {
                if t == 0.0 {
                    a
                } else if t == 1.0 {
                    b
                } else {
                    a.lerp(b, t)
                }
            };
            (from < to).then(|| (at(from), at(to)))
        })
    }

    /// The parts that do not run along the box' sides.
    fn off_the_sides(&self, bounds: &Bounds) -> Vec<Self> {
        let near = ON_SIDE * (bounds.max - bounds.min).max_element();
        let along = |a: DVec2, b: DVec2| {
            (0..2).any(|axis| {
                [bounds.min, bounds.max]
                    .iter()
                    .any(|side| (a[axis] - side[axis]).abs() <= near && (b[axis] - side[axis]).abs() <= near)
            })
        };
        self.split(|a, b| (!along(a, b)).then_some((a, b)))
    }
}

/// The part of a convex polygon, counterclockwise, on the left of the line from `a` to `b`.
pub(super) fn left_of(polygon: &[DVec2], a: DVec2, b: DVec2) -> Vec<DVec2> {
    let side = |p: DVec2| (b - a).perp_dot(p - a);
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (index, &p) in polygon.iter().enumerate() {
        let q = polygon[(index + 1) % polygon.len()];
        let (fp, fq) = (side(p), side(q));
        if fp >= 0.0 {
            kept.push(p);
        }
        if (fp < 0.0 && fq > 0.0) || (fp > 0.0 && fq < 0.0) {
            kept.push(p.lerp(q, fp / (fp - fq)));
        }
    }
    kept
}

/// What two convex polygons have in common, both counterclockwise.
pub(super) fn common(mut polygon: Vec<DVec2>, other: &[DVec2]) -> Vec<DVec2> {
    for (index, &a) in other.iter().enumerate() {
        if polygon.is_empty() {
            break;
        }
        polygon = left_of(&polygon, a, other[(index + 1) % other.len()]);
    }
    polygon
}

impl PlanarReceiver {
    /// Adds the edge of a shadow on this receiver, where the light shines, with at least `points` points where it bends.
    pub(super) fn draw_edge(
        &self,
        shadow: &PlaneShadow,
        kind: LineKind,
        points: usize,
        pair: &Pair<'_>,
        drawing: &mut Drawing,
    ) {
        let outline = shadow.outline(points, &self.bounds);
        if shadow.kind() == ShadowKind::Segment {
            self.draw(&Path::open(outline), kind, pair, drawing);
        } else {
            self.draw_polygon(outline, kind, pair, drawing);
        }
    }

    /// Adds the outline of a polygon that lies in the bounds, without what runs along them.
    pub(super) fn draw_polygon(
        &self,
        polygon: Vec<DVec2>,
        kind: LineKind,
        pair: &Pair<'_>,
        drawing: &mut Drawing,
    ) {
        for path in Path::closed(polygon).off_the_sides(&self.bounds) {
            self.draw(&path, kind, pair, drawing);
        }
    }

    /// Adds a path on this receiver, where the light shines.
    pub(super) fn draw(&self, path: &Path<DVec2>, kind: LineKind, pair: &Pair<'_>, drawing: &mut Drawing) {
        let points = path.points.iter().map(|&p| self.frame.point(p)).collect();
        let path = Path { points, closed: path.closed };
        for part in path.where_positive(|p| pair.shines_on(p)) {
            drawing.add(pair, kind, part.points, part.closed);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: Bounds = Bounds { min: DVec2::ZERO, max: DVec2::ONE };

    #[test]
    fn a_square_over_a_corner_leaves_one_open_part() {
        let square = Path::closed([(0.5, 0.5), (1.5, 0.5), (1.5, 1.5), (0.5, 1.5)].map(DVec2::from).to_vec());
        let parts = square.within(&UNIT);
        assert_eq!(parts, [Path::open([(0.5, 1.0), (0.5, 0.5), (1.0, 0.5)].map(DVec2::from).to_vec())]);
        assert_eq!(square.within(&Bounds::around(DVec2::ONE, 1.0)), std::slice::from_ref(&square));
        assert!(square.within(&Bounds::around(DVec2::splat(-5.0), 1.0)).is_empty(), "all outside");
    }

    #[test]
    fn sides_of_the_window_are_no_edges() {
        let polygon =
            Path::closed([(0.0, 0.0), (0.5, 0.0), (0.5, 1.0), (0.0, 1.0)].map(DVec2::from).to_vec());
        let parts = polygon.off_the_sides(&UNIT);
        assert_eq!(parts, [Path::open([(0.5, 0.0), (0.5, 1.0)].map(DVec2::from).to_vec())]);
    }

    #[test]
    fn cuts_by_a_function() {
        let ring = Path::closed(vec![DVec3::X, DVec3::Y, -DVec3::X, -DVec3::Y]);
        let parts = ring.where_positive(|p| p.y);
        assert_eq!(parts.len(), 1, "one half: {parts:?}");
        assert!(!parts[0].closed && parts[0].points.contains(&DVec3::Y), "{parts:?}");
        assert!(parts[0].points.iter().all(|p| p.y >= 0.0), "{parts:?}");
        assert_eq!(ring.where_positive(|_| 1.0), std::slice::from_ref(&ring));
        let across = Path::open(vec![DVec3::X * -9.0, DVec3::X * 9.0]);
        let parts = across.where_positive(|p| 2.0 - (p - DVec3::X).length());
        assert_eq!(parts.len(), 1, "both ends outside: {parts:?}");
        let error = parts[0].points[0].distance(-DVec3::X) + parts[0].points[1].distance(DVec3::X * 3.0);
        assert!(error < 1e-12, "{parts:?}");
        assert!(ring.where_positive(|_| f64::NAN).is_empty(), "NaN is nowhere");
        assert!(Path::<DVec3>::closed(vec![]).where_positive(|_| 1.0).is_empty(), "of nothing nothing");
        assert!(Path::<DVec3>::open(vec![]).where_positive(|_| 1.0).is_empty(), "of nothing nothing");
    }

    #[test]
    fn polygons_intersect() {
        let square = Bounds::around(DVec2::ZERO, 1.0).corners().to_vec();
        let shifted = Bounds::around(DVec2::ONE, 1.0).corners();
        let both = common(square.clone(), &shifted);
        assert_eq!(both.len(), 4, "{both:?}");
        assert!(both.iter().all(|p| UNIT.contains(*p)), "{both:?}");
        assert!(common(square, &Bounds::around(DVec2::splat(5.0), 1.0).corners()).is_empty(), "apart");
    }
}
