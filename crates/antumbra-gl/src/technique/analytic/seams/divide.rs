//! A polygon divided where what continues its edges begins and ends.

use super::{ANYWHERE, Half, LEAST, Seam};
use antumbra_math::blocking::{Outline, PolygonBlocker};
use glam::{DVec3, DVec4};

/// More pieces than this no polygon is divided into: what is left keeps its edges as they are.
const MOST: usize = 32;

/// A part of a polygon.
#[derive(Clone, Copy, Debug)]
pub(in crate::technique::analytic) struct Piece {
    corners: [DVec3; 4],
    count: usize,
    pub(in crate::technique::analytic) blocker: PolygonBlocker<DVec3>,
    /// Of each of the blocker's edges, what continues it.
    pub(in crate::technique::analytic) seams: [Option<Seam>; 4],
}

impl Piece {
    /// Where its shadow begins.
    pub(in crate::technique::analytic) fn outline(&self) -> Outline {
        Outline::Corners { corners: self.corners, count: self.count }
    }

    #[cfg(test)]
    pub(super) fn area(&self) -> f64 {
        let [a, b, c, d] = self.corners;
        let half = |p: DVec3, q: DVec3| (p - a).cross(q - a).length() * 0.5;
        half(b, c) + if self.count == 4 { half(c, d) } else { 0.0 }
    }
}

/// A side of a piece: a part of an edge of the polygon, or a cut.
#[derive(Clone, Copy, Debug)]
enum Side {
    Edge { edge: usize, from: f64, to: f64 },
    Cut,
}

/// A piece that may have to be divided further.
type Part = Vec<(DVec3, Side)>;

/// What continues parts of an edge, sorted by where they begin.
type Parts = [Vec<(f64, f64, Seam)>; 4];

/// The pieces of a polygon.
pub(super) fn divide(corners: &[DVec3], parts: &Parts, base: Half, light: DVec4) -> Vec<Piece> {
    let whole = |edge| Side::Edge { edge, from: 0.0, to: 1.0 };
    let mut open: Vec<Part> = vec![corners.iter().enumerate().map(|(i, &p)| (p, whole(i))).collect()];
    let mut pieces = Vec::new();
    while let Some(part) = open.pop() {
        let breaks = (0..part.len()).find_map(|i| Some((i, break_of(part[i].1, parts)?)));
        match breaks {
            Some((side, at)) if open.len() + pieces.len() < MOST => open.extend(cut(&part, side, at)),
            _ => pieces.extend(piece(&part, parts, base, light)),
        }
    }
    pieces
}

/// Where, on its edge, a side begins or ends to be continued.
fn break_of(side: Side, parts: &Parts) -> Option<f64> {
    let Side::Edge { edge, from, to } = side else { return None };
    let within = |at: f64| at > from + LEAST && at < to - LEAST;
    let covered = |at: f64| parts[edge].iter().any(|(a, b, _)| *a < at && at < *b);
    // Where two that continue it meet it is not broken.
    let broken = |at: &f64| within(*at) && !(covered(at - LEAST * 0.5) && covered(at + LEAST * 0.5));
    parts[edge].iter().flat_map(|(a, b, _)| [*a, *b]).find(broken)
}

/// Two parts, divided from a point of a side to the corner after the next.
fn cut(part: &Part, side: usize, at: f64) -> [Part; 2] {
    let count = part.len();
    let Side::Edge { edge, from, to } = part[side].1 else { return [part.clone(), Vec::new()] };
    let (begin, end) = (part[side].0, part[(side + 1) % count].0);
    let point = begin.lerp(end, (at - from) / (to - from));
    let far = (side + 2) % count;
    let first =
        vec![(point, Side::Edge { edge, from: at, to }), part[(side + 1) % count], (part[far].0, Side::Cut)];
    let mut second = vec![(point, Side::Cut)];
    second.extend((0..count - 1).map(|i| part[(far + i) % count]).take(count - 2));
    second.push((begin, Side::Edge { edge, from, to: at }));
    [first, second]
}

/// A part with what continues its sides; `None` without an area.
fn piece(part: &Part, parts: &Parts, base: Half, light: DVec4) -> Option<Piece> {
    let mut corners = [part.first()?.0; 4];
    corners.iter_mut().zip(part).for_each(|(corner, (p, _))| *corner = *p);
    let count = part.len();
    let blocker = PolygonBlocker { base, ..PolygonBlocker::new(&corners[..count], light)? };
    let mut seams = [None; 4];
    for (seam, (_, side)) in seams.iter_mut().zip(part) {
        *seam = match *side {
            Side::Cut => Some(Seam { base, edges: [ANYWHERE; 3] }),
            Side::Edge { edge, from, to } => continued(&parts[edge], from, to),
        };
    }
    Some(Piece { corners, count, blocker, seams })
}

/// What continues all of a side, if anything does.
fn continued(parts: &[(f64, f64, Seam)], from: f64, to: f64) -> Option<Seam> {
    let mut at = from;
    let mut found = None;
    for (begin, end, seam) in parts {
        if *begin <= at + LEAST && *end > at {
            at = *end;
            found.get_or_insert(*seam);
        }
    }
    found.filter(|_| at >= to - LEAST)
}
