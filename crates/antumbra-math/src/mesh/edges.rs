//! Which faces meet where: found by sorting all sides of all triangles.

use core::ops::Range;

use glam::DVec3;

/// A side that triangles share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// Its ends, the lower index first.
    pub vertices: [u32; 2],
    first: u32,
    count: u32,
}

impl Edge {
    pub(super) fn range(&self) -> Range<usize> {
        self.first as usize..(self.first + self.count) as usize
    }
}

/// A face at an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EdgeFace {
    /// Index of the triangle.
    pub face: u32,
    /// Whether the triangle's corners run from the edge's first vertex to its second.
    pub forward: bool,
}

/// The three sides of a triangle from corner to corner; none where two corners are one vertex.
fn sides(t: [u32; 3]) -> impl Iterator<Item = [u32; 2]> {
    let [a, b, c] = t;
    let flat = a == b || b == c || c == a;
    [[a, b], [b, c], [c, a]].into_iter().filter(move |_| !flat)
}

/// All edges in the order of their vertices, and their faces one edge after the other.
pub(super) fn find(triangles: &[[u32; 3]]) -> (Vec<Edge>, Vec<EdgeFace>) {
    let mut all: Vec<([u32; 2], EdgeFace)> = Vec::with_capacity(3 * triangles.len());
    for (face, &triangle) in (0..).zip(triangles) {
        for [from, to] in sides(triangle) {
            all.push(([from.min(to), from.max(to)], EdgeFace { face, forward: from < to }));
        }
    }
    // By face as well, so that the order does not depend on how the sort breaks ties.
    all.sort_unstable_by_key(|(vertices, side)| (*vertices, side.face));
    let mut edges: Vec<Edge> = Vec::with_capacity(all.len() / 2);
    for (index, (vertices, _)) in (0..).zip(&all) {
        match edges.last_mut() {
            Some(edge) if edge.vertices == *vertices => edge.count += 1,
            _ => edges.push(Edge { vertices: *vertices, first: index, count: 1 }),
        }
    }
    (edges, all.into_iter().map(|(_, side)| side).collect())
}

/// Whether along every edge as many faces run one way as the other. True without edges.
pub(super) fn are_closed(edges: &[Edge], faces: &[EdgeFace]) -> bool {
    edges.iter().all(|edge| {
        let forward = faces[edge.range()].iter().filter(|side| side.forward).count();
        2 * forward == edge.count as usize
    })
}

/// Whether every connected piece of a closed mesh holds a positive volume: faces look outward.
pub(super) fn are_outward(positions: &[DVec3], triangles: &[[u32; 3]]) -> bool {
    let mut parent: Vec<u32> = (0..positions.len() as u32).collect();
    for &[a, b, c] in triangles {
        for other in [b, c] {
            let (a, other) = (root(&mut parent, a), root(&mut parent, other));
            parent[other as usize] = a;
        }
    }
    let mut volumes = vec![0.0; positions.len()];
    for &t in triangles {
        let piece = root(&mut parent, t[0]) as usize;
        // From a vertex of the piece, so that a place far from the origin costs no digits.
        let [a, b, c] = t.map(|i| positions[i as usize] - positions[piece]);
        volumes[piece] += a.dot(b.cross(c));
    }
    volumes.iter().all(|&six_volumes| six_volumes >= 0.0)
}

/// The vertex that stands for the piece a vertex is in; halves the way there as it goes.
fn root(parent: &mut [u32], mut vertex: u32) -> u32 {
    while parent[vertex as usize] != vertex {
        let up = parent[vertex as usize];
        parent[vertex as usize] = parent[up as usize];
        vertex = up;
    }
    vertex
}
