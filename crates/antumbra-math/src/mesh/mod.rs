//! Triangle meshes, for the methods that cast shadows from triangles.

mod edges;
mod error;
mod flat;
mod projection;
mod silhouette;
mod solids;

use core::sync::atomic::{AtomicU64, Ordering};
use std::collections::HashMap;

use glam::DVec3;

pub use edges::{Edge, EdgeFace};
pub use error::MeshError;
pub use projection::planar_projection;
pub use silhouette::{CountRule, Silhouette};

use crate::Sphere;

/// An indexed triangle mesh that never changes: its edges are found once.
///
/// Any surface will do: closed or open, in one piece or several, with edges where more than two
/// faces meet. Counter-clockwise faces look outward, which matters to nothing but speed.
#[derive(Clone, Debug)]
pub struct TriangleMesh {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    normals: Vec<DVec3>,
    edges: Vec<Edge>,
    edge_faces: Vec<EdgeFace>,
    closed: bool,
    outward: bool,
    bounding_sphere: Sphere,
    id: u64,
}

/// More triangles than this have more sides than a `u32` counts.
const MAX_TRIANGLES: usize = (u32::MAX / 3) as usize;

impl TriangleMesh {
    /// A mesh of vertices, metres, and the corners of each triangle.
    ///
    /// Vertices at the same place become one, the first (files repeat a vertex for each of its
    /// normals), and 0 and -0 are the same place. Every triangle keeps its place in the list, those
    /// without area too. One that has two corners in the same place has no sides: what is left of it
    /// is a line, there and back. One with three corners on a line keeps its three sides, because the
    /// faces beside it meet it and not each other. So neither of them opens a closed mesh.
    ///
    /// # Errors
    /// [`MeshError::NotFinite`], [`MeshError::NoSuchVertex`], [`MeshError::NoTriangles`],
    /// [`MeshError::TooLarge`].
    pub fn new(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        if triangles.is_empty() {
            return Err(MeshError::NoTriangles);
        }
        if triangles.len() > MAX_TRIANGLES {
            return Err(MeshError::TooLarge);
        }
        if let Some(vertex) = positions.iter().position(|p| !p.is_finite()) {
            return Err(MeshError::NotFinite { vertex });
        }
        if let Some(triangle) =
            triangles.iter().position(|t| t.iter().any(|&i| i as usize >= positions.len()))
        {
            return Err(MeshError::NoSuchVertex { triangle });
        }
        let (positions, triangles) = weld(&positions, triangles);
        let normals: Vec<DVec3> = triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|i| positions[i as usize]);
                (b - a).cross(c - a)
            })
            .collect();
        let (edges, edge_faces) = edges::find(&triangles);
        let closed = edges::are_closed(&edges, &edge_faces);
        Ok(Self {
            closed,
            outward: closed && edges::are_outward(&positions, &triangles),
            bounding_sphere: bounding_sphere(&positions, &triangles),
            positions,
            triangles,
            normals,
            edges,
            edge_faces,
            id: next_id(),
        })
    }

    /// The vertices, metres; no two are at the same place.
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// The corners of each triangle, in the order given.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The corners of a triangle, metres; `None` past the last.
    pub fn corners(&self, triangle: usize) -> Option<[DVec3; 3]> {
        self.triangles.get(triangle).map(|t| t.map(|i| self.positions[i as usize]))
    }

    /// The sides of all triangles, each once, in the order of their vertices.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// The faces that meet at one of this mesh's [`Self::edges`]: one at a border, two inside a
    /// surface, more where surfaces meet.
    pub fn faces_of(&self, edge: &Edge) -> &[EdgeFace] {
        self.edge_faces.get(edge.range()).unwrap_or_default()
    }

    /// Whether the mesh has no border and its faces agree about their front: along every edge as many
    /// faces run one way as the other (one each, unless surfaces touch in an edge).
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// A sphere that holds every triangle: round the middle of their bounding box, and as small as
    /// that centre allows.
    pub fn bounding_sphere(&self) -> Sphere {
        self.bounding_sphere
    }

    /// A number that no other mesh made in this process has. A clone, being the same triangles, has it
    /// too.
    pub fn id(&self) -> u64 {
        self.id
    }

    /// How often the mesh winds round a point, counter-clockwise faces outward: for a closed one 1
    /// inside and 0 outside, and on the surface any of that range. It is the sum of the solid angles of the
    /// triangles over 4π (van Oosterom and Strackee, "The Solid Angle of a Plane Triangle", 1983).
    pub fn winding(&self, point: DVec3) -> f64 {
        let angle = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| self.positions[i as usize] - point);
            let (la, lb, lc) = (a.length(), b.length(), c.length());
            let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
            2.0 * a.dot(b.cross(c)).atan2(below)
        };
        self.triangles.iter().map(angle).sum::<f64>() / (4.0 * core::f64::consts::PI)
    }
}

fn next_id() -> u64 {
    static NEXT: AtomicU64 = AtomicU64::new(1);
    NEXT.fetch_add(1, Ordering::Relaxed)
}

/// One vertex for each place.
fn weld(positions: &[DVec3], mut triangles: Vec<[u32; 3]>) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut places = HashMap::with_capacity(positions.len());
    let mut welded = Vec::with_capacity(positions.len());
    let new_index: Vec<u32> = positions
        .iter()
        .map(|p| {
            let p = *p + DVec3::ZERO; // -0 + 0 = 0
            *places.entry(p.to_array().map(f64::to_bits)).or_insert_with(|| {
                welded.push(p);
                (welded.len() - 1) as u32
            })
        })
        .collect();
    for index in triangles.as_flattened_mut() {
        *index = new_index[*index as usize];
    }
    (welded, triangles)
}

fn bounding_sphere(positions: &[DVec3], triangles: &[[u32; 3]]) -> Sphere {
    // Only what triangles use: a vertex beside them bounds nothing.
    let used = || triangles.as_flattened().iter().map(|&i| positions[i as usize]);
    let (low, high) = used().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), p| (l.min(p), h.max(p)));
    let center = 0.5 * low + 0.5 * high;
    Sphere { center, radius: used().map(|p| p.distance(center)).fold(0.0, f64::max) }
}
