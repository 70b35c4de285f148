//! Ray against triangle, watertight: a ray through the edge that two triangles share hits at least one of them.
//!
//! Woop, Benthin and Wald, Watertight Ray/Triangle Intersection, JCGT 2(1), 2013, in float64. Edges belong to
//! the triangle.

use glam::DVec3;

use crate::ray::{Hit, Ray};

/// A ray made ready for many triangles: the axes permuted and sheared so that it runs along +Z.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sheared {
    ray: Ray,
    axes: [usize; 3],
    shear: DVec3,
}

impl Sheared {
    /// The ray must have a finite, non-zero direction.
    pub(super) fn new(ray: &Ray) -> Self {
        let d = ray.direction;
        let z = d.abs().max_position();
        let (mut x, mut y) = ((z + 1) % 3, (z + 2) % 3);
        if d[z] < 0.0 {
            (x, y) = (y, x);
        }
        Self { ray: *ray, axes: [x, y, z], shear: DVec3::new(d[x] / d[z], d[y] / d[z], 1.0 / d[z]) }
    }

    /// The vertex seen from the ray's origin, sheared.
    fn apply(&self, vertex: DVec3) -> DVec3 {
        let p = vertex - self.ray.origin;
        let [x, y, z] = self.axes.map(|axis| p[axis]);
        DVec3::new(x - self.shear.x * z, y - self.shear.y * z, self.shear.z * z)
    }

    /// The crossing inside the ray's interval. A triangle of no area and one seen edge-on have none.
    pub(super) fn nearest(&self, vertices: [DVec3; 3]) -> Option<Hit> {
        let [a, b, c] = vertices.map(|v| self.apply(v));
        // Each edge function is the negative of the neighbour's, exactly: that is what makes it watertight.
        let u = c.x * b.y - c.y * b.x;
        let v = a.x * c.y - a.y * c.x;
        let w = b.x * a.y - b.y * a.x;
        if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) {
            return None;
        }
        let sum = u + v + w;
        let t = (u * a.z + v * b.z + w * c.z) / sum;
        let normal = (vertices[1] - vertices[0]).cross(vertices[2] - vertices[0]);
        (sum != 0.0 && self.ray.contains(t))
            .then(|| Hit { t, normal: normal.normalize_or(-self.ray.direction) })
    }
}
