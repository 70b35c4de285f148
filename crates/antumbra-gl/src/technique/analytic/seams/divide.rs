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

/// A piece that may have to be divided further: corners, each with the side that begins there.
#[derive(Clone, Copy, Debug)]
struct Part {
    corners: [(DVec3, Side); 4],
    count: usize,
}

/// What continues parts of an edge, sorted by where they begin.
pub(super) type Parts = [Vec<(f64, f64, Seam)>; 4];

/// Divides polygons; keeps its memory from one to the next.
#[derive(Default)]
pub(super) struct Divider {
    /// What continues the edges of the next polygon.
    pub(super) parts: Parts,
    open: Vec<Part>,
    pieces: Vec<Piece>,
}

impl Divider {
    /// The pieces of a polygon.
    pub(super) fn divide(&mut self, corners: &[DVec3], base: Half, light: DVec4) -> &[Piece] {
        let whole = |edge| Side::Edge { edge, from: 0.0, to: 1.0 };
        let corner = |i: usize| (corners[i.min(corners.len() - 1)], whole(i));
        self.pieces.clear();
        self.open.clear();
        self.open.push(Part { corners: [0, 1, 2, 3].map(corner), count: corners.len() });
        while let Some(part) = self.open.pop() {
            let breaks = (0..part.count).find_map(|i| Some((i, break_of(part.corners[i].1, &self.parts)?)));
            match breaks {
                Some((side, at)) if self.open.len() + self.pieces.len() < MOST => {
                    self.open.extend(cut(&part, side, at));
                }
                _ => self.pieces.extend(piece(&part, &self.parts, base, light)),
            }
        }
        &self.pieces
    }

    /// Nothing.
    pub(super) fn none(&mut self) -> &[Piece] {
        self.pieces.clear();
        &self.pieces
    }
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
    let count = part.count;
    let corner = |i: usize| part.corners[i % count];
    let (begin, Side::Edge { edge, from, to }) = corner(side) else { return [*part, *part] };
    let point = begin.lerp(corner(side + 1).0, (at - from) / (to - from));
    let far = corner(side + 2).0;
    let first =
        [(point, Side::Edge { edge, from: at, to }), corner(side + 1), (far, Side::Cut), (far, Side::Cut)];
    let last = (begin, Side::Edge { edge, from, to: at });
    let mut second = [(point, Side::Cut), corner(side + 2), corner(side + 3), last];
    second[count - 1] = last;
    [Part { corners: first, count: 3 }, Part { corners: second, count }]
}

/// A part with what continues its sides; `None` without an area.
fn piece(part: &Part, parts: &Parts, base: Half, light: DVec4) -> Option<Piece> {
    let count = part.count;
    let corners = part.corners.map(|(corner, _)| corner);
    let blocker = PolygonBlocker { base, ..PolygonBlocker::new(&corners[..count], light)? };
    let mut seams = [None; 4];
    for (seam, (_, side)) in seams.iter_mut().zip(&part.corners[..count]) {
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
