//! Ray against triangle mesh.

use antumbra_scene::Mesh;
use glam::DVec3;

use super::triangle::Sheared;
use crate::{
    bvh::Bvh,
    ray::{Hit, Ray},
};

/// The triangles of a mesh and a hierarchy over them. A mesh is a surface, open or closed: it has no inside.
#[derive(Clone, Debug)]
pub(super) struct Triangles {
    corners: Vec<[DVec3; 3]>,
    bvh: Bvh,
}

impl Triangles {
    /// Triangles with a corner that is not finite, or that is not in the mesh, are left out: no ray meets them.
    pub(super) fn new(mesh: &Mesh) -> Self {
        let corner = |i: u32| mesh.positions.get(i as usize).copied().filter(|p| p.is_finite());
        let corners: Vec<[DVec3; 3]> = mesh
            .triangles
            .iter()
            .filter_map(|&[a, b, c]| Some([corner(a)?, corner(b)?, corner(c)?]))
            .collect();
        let bounds: Vec<_> = corners.iter().map(|[a, b, c]| (a.min(*b).min(*c), a.max(*b).max(*c))).collect();
        Self { corners, bvh: Bvh::new(&bounds) }
    }

    pub(super) fn nearest(&self, ray: &Ray) -> Option<Hit> {
        let sheared = Sheared::new(ray);
        let mut found: Option<Hit> = None;
        self.bvh.traverse(ray, |index, ray| {
            if let Some(hit) = sheared.nearest(self.corners[index as usize])
                && hit.t < ray.max
            {
                ray.max = hit.t;
                found = Some(hit);
            }
            true
        });
        found
    }

    pub(super) fn blocks(&self, ray: &Ray) -> bool {
        let sheared = Sheared::new(ray);
        let mut blocked = false;
        self.bvh.traverse(ray, |index, _| {
            blocked = sheared.nearest(self.corners[index as usize]).is_some();
            !blocked
        });
        blocked
    }
}
