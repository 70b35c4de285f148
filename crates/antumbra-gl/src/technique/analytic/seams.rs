//! Polygons that abut: where the edge of one is continued by another, no line of light runs through their shadow.
//!
//! Each of two polygons that share an edge takes the part of a pixel on its side, and the minimum of what is left is half the
//! light. So on an edge that another polygon continues, on the light's other side of it, each takes all of the pixel, up to the
//! other's far edge. An edge that is continued in part is divided, and its polygon with it.

mod divide;

use crate::input::Occluder;
use antumbra_math::Shape;
use antumbra_math::blocking::PolygonBlocker;
use glam::{DMat4, DVec3, DVec4};

use divide::Divider;
pub(super) use divide::Piece;

/// How far from another edge's line, in lengths of the longer, an edge may lie that is taken to lie in it: what float32 leaves
/// of corners that are meant to be the same.
const SAME: f64 = 1e-5;
/// The least part of an edge that counts.
const LEAST: f64 = 1e-4;

/// A plane as blockers have them.
type Half = (DVec3, f64);

/// Holds everywhere.
const ANYWHERE: Half = (DVec3::ZERO, 1.0);

/// What continues an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Seam {
    /// The plane of the other polygon.
    pub(super) base: Half,
    /// Its far edge, and those of its edges that begin where the seam ends and bend the outline of both inwards.
    pub(super) edges: [Half; 3],
}

/// A part of an edge that lies on an edge of another polygon.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Contact {
    /// The other polygon's place among the occluders.
    other: usize,
    /// The part, from 0 to 1.
    from: f64,
    to: f64,
}

/// The corners of a polygon, in order.
fn corners(shape: &Shape) -> Option<([DVec3; 4], usize)> {
    match shape {
        Shape::Triangle(s) => {
            let [a, b, c] = s.vertices;
            Some(([a, b, c, c], 3))
        }
        Shape::Rectangle(s) => Some((s.corners(), 4)),
        _ => None,
    }
}

/// Which polygons of a frame share edges with which; kept while the occluders stay as they are.
#[derive(Default)]
pub(super) struct Seams {
    known: Vec<Occluder>,
    /// Of each occluder, what touches each of its edges.
    contacts: Vec<[Vec<Contact>; 4]>,
    divider: Divider,
}

/// An edge of a polygon.
struct Edge {
    occluder: usize,
    edge: usize,
    ends: [DVec3; 2],
    low: DVec3,
    high: DVec3,
}

impl Seams {
    /// Looks at the frame's occluders.
    pub(super) fn begin(&mut self, occluders: &[Occluder]) {
        if self.known == occluders {
            return;
        }
        self.known.clear();
        self.known.extend_from_slice(occluders);
        self.contacts.clear();
        self.contacts.resize_with(occluders.len(), Default::default);
        let mut edges: Vec<Edge> = Vec::new();
        for (occluder, o) in occluders.iter().enumerate() {
            let Some((corners, count)) = corners(&o.shape).filter(|(c, _)| c.iter().all(|c| c.is_finite()))
            else {
                continue;
            };
            for edge in 0..count {
                let ends = [corners[edge], corners[(edge + 1) % count]];
                let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
                edges.push(Edge { occluder, edge, ends, low, high });
            }
        }
        for (other, o) in occluders.iter().enumerate() {
            let Shape::Plane(plane) = o.shape else { continue };
            for edge in &edges {
                let near = SAME * edge.ends[0].distance(edge.ends[1]);
                if edge.ends.iter().all(|end| plane.height(*end).abs() <= near) {
                    self.contacts[edge.occluder][edge.edge].push(Contact { other, from: 0.0, to: 1.0 });
                }
            }
        }
        edges.sort_by(|a, b| a.low.x.total_cmp(&b.low.x));
        for (i, a) in edges.iter().enumerate() {
            let length = a.ends[0].distance(a.ends[1]);
            for b in &edges[i + 1..] {
                let near = SAME * length.max(b.ends[0].distance(b.ends[1]));
                if b.low.x > a.high.x + near {
                    break;
                }
                let apart = (b.low - near).cmpgt(a.high).any() || (a.low - near).cmpgt(b.high).any();
                if apart || a.occluder == b.occluder {
                    continue;
                }
                for (one, other) in [(a, b), (b, a)] {
                    if let Some((from, to)) = shared(one.ends, other.ends, near) {
                        let contact = Contact { other: other.occluder, from, to };
                        self.contacts[one.occluder][one.edge].push(contact);
                    }
                }
            }
        }
    }

    /// Whether any edge of an occluder lies on another's.
    pub(super) fn touches(&self, occluder: usize) -> bool {
        self.contacts[occluder].iter().any(|contacts| !contacts.is_empty())
    }

    /// The polygon `index` in pieces, each with what continues its edges as the light sees them; view space. None for a
    /// polygon that the light sees edge-on.
    pub(super) fn pieces(&mut self, index: usize, light: DVec4, view: &DMat4) -> &[Piece] {
        let Some((corners_vs, count)) = self.corners_vs(index, view) else { return self.divider.none() };
        let own = &corners_vs[..count];
        let Some(blocker) = PolygonBlocker::new(own, light) else { return self.divider.none() };
        let mut divider = std::mem::take(&mut self.divider);
        for (edge, parts) in divider.parts.iter_mut().enumerate() {
            parts.clear();
            if edge >= count {
                continue;
            }
            let ends = [own[edge], own[(edge + 1) % count]];
            for contact in &self.contacts[index][edge] {
                let seam = self.seam(contact.other, blocker.edges[edge], ends, own, light, view);
                parts.extend(seam.map(|seam| (contact.from, contact.to, seam)));
            }
            if parts.is_empty() {
                for contact in &self.contacts[index][edge] {
                    let fold = self.fold(contact.other, blocker.edges[edge], own, light, view);
                    parts.extend(fold.map(|fold| (contact.from, contact.to, fold)));
                }
            }
            // Unstable, because the other allocates.
            parts.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        }
        self.divider = divider;
        self.divider.divide(own, blocker.base, light)
    }

    /// What the polygon `other` beyond an edge is to it; `None` where it is on the same side, as the light sees them, or is seen
    /// edge-on. The plane of light and edge has the edge's own polygon on its positive side.
    fn seam(
        &self,
        other: usize,
        edge: Half,
        ends: [DVec3; 2],
        own: &[DVec3],
        light: DVec4,
        view: &DMat4,
    ) -> Option<Seam> {
        let index = other;
        let (corners, count) = self.corners_vs(index, view)?;
        let other = &corners[..count];
        let near = ends[0].distance(ends[1]) * SAME;
        let beyond = |p: &DVec3| -height(edge, *p);
        let farthest = other.iter().copied().max_by(|a, b| beyond(a).total_cmp(&beyond(b)))?;
        if !(beyond(&farthest) > near) {
            return None;
        }
        let PolygonBlocker { base, edges, .. } = PolygonBlocker::new(other, light)?;
        let to_light = light.truncate() - farthest * light.w;
        let far = to_light.cross(ends[1] - ends[0]).try_normalize()?;
        let far = if far.dot(edge.0) < 0.0 { -far } else { far };
        // Whether all of an edge of the other is continued in its turn.
        let continued = |i: usize| {
            let goes_on = |contact: &&Contact| {
                let third = self.corners_vs(contact.other, view);
                third
                    .is_some_and(|(third, count)| third[..count].iter().any(|p| -height(edges[i], *p) > near))
            };
            let mut at = 0.0;
            let further = |at: f64| {
                let parts = self.contacts[index][i].iter().filter(goes_on);
                parts.filter(|c| c.from <= at + LEAST && c.to > at).map(|c| c.to).fold(at, f64::max)
            };
            while further(at) > at {
                at = further(at);
            }
            at >= 1.0 - LEAST
        };
        // Its farthest edge, or the two that meet in its farthest corner.
        let is_farthest = |i: usize| beyond(&other[i % count]) >= beyond(&farthest) - near;
        let has_edge = (0..count).any(|i| is_farthest(i) && is_farthest(i + 1));
        let counts = |i: usize| {
            if has_edge { is_farthest(i) && is_farthest(i + 1) } else { is_farthest(i) || is_farthest(i + 1) }
        };
        let goes_on = (0..count).filter(|&i| counts(i)).all(continued);
        let far = if goes_on { ANYWHERE } else { (far, -far.dot(farthest)) };
        let sides = ends.map(|end| {
            // Of the other's two edges at that corner the one that leaves the seam, if all of this polygon is inside of it and
            // no third polygon continues it.
            let at = |p: DVec3| p.distance(end) <= near;
            let leaves = |i: usize| {
                let (a, b) = (other[i], other[(i + 1) % count]);
                (at(a) && beyond(&b) > near) || (at(b) && beyond(&a) > near)
            };
            let ends_there = |i: usize| !continued(i) && own.iter().all(|p| height(edges[i], *p) >= -near);
            let side = (0..count).find(|&i| leaves(i)).filter(|&i| ends_there(i));
            side.map_or(ANYWHERE, |i| edges[i])
        });
        Some(Seam { base, edges: [far, sides[0], sides[1]] })
    }

    /// What the polygon `other` is to an edge beyond which it does not go on: where a receiver runs into it, what is beyond is
    /// not seen, and the edge ends there.
    fn fold(&self, other: usize, edge: Half, own: &[DVec3], light: DVec4, view: &DMat4) -> Option<Seam> {
        let (normal, offset) = match self.known[other].shape.transformed(view) {
            Shape::Plane(plane) => (plane.normal, -plane.offset),
            _ => {
                let (corners, count) = self.corners_vs(other, view)?;
                PolygonBlocker::new(&corners[..count], light)?.base
            }
        };
        let middle = own.iter().sum::<DVec3>() / own.len() as f64;
        let side = if height((normal, offset), middle) < 0.0 { -1.0 } else { 1.0 };
        Some(Seam { base: (normal * side, offset * side), edges: [edge, ANYWHERE, ANYWHERE] })
    }

    /// The corners of an occluder that is a polygon, view space.
    fn corners_vs(&self, index: usize, view: &DMat4) -> Option<([DVec3; 4], usize)> {
        let (corners, count) = corners(&self.known[index].shape)?;
        Some((corners.map(|corner| view.transform_point3(corner)), count))
    }
}

/// The part of an edge that lies on another, from 0 to 1.
fn shared([a, b]: [DVec3; 2], other: [DVec3; 2], near: f64) -> Option<(f64, f64)> {
    let along = b - a;
    let square = along.length_squared();
    if !(square > 0.0) {
        return None;
    }
    let [p, q] = other.map(|point| (point - a).dot(along) / square);
    let off = |point: DVec3, at: f64| point.distance(a + along * at);
    if off(other[0], p) > near || off(other[1], q) > near {
        return None;
    }
    let (from, to) = (p.min(q).max(0.0), p.max(q).min(1.0));
    (to - from > LEAST).then_some((from, to))
}

fn height((normal, offset): Half, p: DVec3) -> f64 {
    normal.dot(p) + offset
}

#[cfg(test)]
mod tests {
    use super::*;
    use antumbra_math::Light;

    fn board(x: f64, z: f64, half: f64) -> Occluder {
        Occluder::rectangle([x, 1.0, z], [half, 0.0, 0.0], [0.0, 0.0, half])
    }

    fn above() -> DVec4 {
        Light::Point { position: DVec3::new(0.1, 5.0, 0.2) }.homogeneous()
    }

    fn pieces(occluders: &[Occluder], index: usize) -> Vec<Piece> {
        let mut seams = Seams::default();
        seams.begin(occluders);
        seams.pieces(index, above(), &DMat4::IDENTITY).to_vec()
    }

    fn seamed(pieces: &[Piece]) -> usize {
        pieces.iter().flat_map(|piece| piece.seams).flatten().count()
    }

    #[test]
    fn boards_side_by_side_have_one_seam_each() {
        let occluders = [board(0.0, 0.0, 0.5), board(1.0, 0.0, 0.5), board(3.0, 0.0, 0.5)];
        for index in 0..2 {
            let pieces = pieces(&occluders, index);
            assert_eq!((pieces.len(), seamed(&pieces)), (1, 1), "board {index}");
        }
        let mut seams = Seams::default();
        seams.begin(&occluders);
        assert_eq!([0, 1, 2].map(|i| seams.touches(i)), [true, true, false], "the third is alone");
    }

    #[test]
    fn boards_that_are_shifted_are_divided() {
        let pieces = pieces(&[board(0.0, 0.0, 0.5), board(1.0, 0.3, 0.5)], 0);
        assert_eq!(pieces.len(), 2, "where the other begins");
        // One edge is continued in part, and each piece has the cut.
        assert_eq!(seamed(&pieces), 3, "{pieces:?}");
        let area: f64 = pieces.iter().map(Piece::area).sum();
        assert!((area - 1.0).abs() < 1e-9, "nothing is lost: {area}");
    }

    #[test]
    fn a_long_edge_on_two_short_ones_is_whole() {
        let long = Occluder::rectangle([0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.5]);
        let occluders = [long, board(-0.5, 1.0, 0.5), board(0.5, 1.0, 0.5)];
        let pieces = pieces(&occluders, 0);
        assert_eq!((pieces.len(), seamed(&pieces)), (1, 1), "two continue it together");
    }

    #[test]
    fn what_folds_back_is_no_seam() {
        // Both boards lie on one side of their edge, one over the other.
        let lower = Occluder::rectangle([0.0, 0.5, 0.0], [0.5, 0.5, 0.0], [0.0, 0.0, 0.5]);
        let light = Light::Point { position: DVec3::new(-9.0, 9.0, 0.0) }.homogeneous();
        let mut seams = Seams::default();
        seams.begin(&[board(0.0, 0.0, 0.5), lower]);
        assert!(seams.touches(0), "they share an edge");
        let pieces = seams.pieces(0, light, &DMat4::IDENTITY);
        let folds = pieces[0].seams.iter().enumerate().filter_map(|(i, seam)| Some((i, (*seam)?)));
        let edges = &pieces[0].blocker.edges;
        let own = |(i, seam): (usize, Seam)| seam.edges == [edges[i], ANYWHERE, ANYWHERE];
        assert_eq!((pieces.len(), folds.clone().count()), (1, 1), "{pieces:?}");
        assert!(folds.clone().all(own), "which ends the shadow where it is: {pieces:?}");
    }
}
