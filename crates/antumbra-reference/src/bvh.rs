//! A bounding volume hierarchy in float64.
//!
//! The crate obvhs builds a good tree, in float32. Only the tree is taken from it: the boxes are computed again in
//! float64 from the exact bounds, so that no ray is lost to rounding, however far from the origin the scene is.

use glam::{DVec3, Vec3A};
use obvhs::{BvhBuildParams, aabb::Aabb, bvh2::builder::build_bvh2};

use crate::ray::Ray;

/// Lower and upper corner of an axis-aligned box.
pub(crate) type Bounds = (DVec3, DVec3);

#[derive(Clone, Copy, Debug)]
struct Node {
    min: DVec3,
    max: DVec3,
    /// First child (the other follows it), or first entry of `order`.
    first: u32,
    /// Entries of `order` in this leaf; 0 for an inner node.
    count: u32,
}

/// A hierarchy over numbered boxes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bvh {
    nodes: Vec<Node>,
    order: Vec<u32>,
}

/// Boxes grow by this share of their size and distance from the origin: a thousand times what the float64
/// transformation of a ray into a shape's space can be wrong by, and far too little to cost time.
const PADDING: f64 = 1e-12;

/// Entries of the traversal stack that need no allocation. Built trees are rarely deeper than 40.
const STACK: usize = 64;

impl Bvh {
    /// Builds the hierarchy over finite boxes.
    pub(crate) fn new(bounds: &[Bounds]) -> Self {
        let whole = bounds.iter().fold(EMPTY, |a, &b| union(a, b));
        let center = 0.5 * whole.0 + 0.5 * whole.1;
        // Scaled to [-1, 1], so that float32 neither overflows nor loses the differences.
        let scale = (whole.1 - center).max_element().max(f64::MIN_POSITIVE).recip();
        let scale = if scale.is_finite() { scale } else { 1.0 };
        let to_f32 = |p: DVec3| Vec3A::from(((p - center) * scale).as_vec3());
        let boxes: Vec<Aabb> = bounds.iter().map(|b| Aabb::new(to_f32(b.0), to_f32(b.1))).collect();
        if boxes.is_empty() {
            return Self::default();
        }
        let built = build_bvh2(&boxes, BvhBuildParams::medium_build(), &mut std::time::Duration::default());
        // Copied breadth by breadth, so that children come after their parents.
        let mut nodes = vec![built.nodes[0]];
        let mut next = 0;
        while next < nodes.len() {
            if nodes[next].prim_count == 0 {
                let child = nodes[next].first_index as usize;
                nodes[next].first_index = nodes.len() as u32;
                nodes.extend([built.nodes[child], built.nodes[child + 1]]);
            }
            next += 1;
        }
        let nodes = nodes
            .iter()
            .map(|n| Node { min: EMPTY.0, max: EMPTY.1, first: n.first_index, count: n.prim_count })
            .collect();
        let mut bvh = Self { nodes, order: built.primitive_indices };
        bvh.fit(bounds);
        bvh
    }

    /// Computes the boxes from the leaves up; children come after their parents.
    fn fit(&mut self, bounds: &[Bounds]) {
        for index in (0..self.nodes.len()).rev() {
            let Node { first, count, .. } = self.nodes[index];
            let (min, max) = if count > 0 {
                self.order[first as usize..(first + count) as usize].iter().fold(EMPTY, |a, &i| {
                    let (lo, hi) = bounds[i as usize];
                    let pad = (lo.abs().max(hi.abs()) + (hi - lo)) * PADDING;
                    union(a, (lo - pad, hi + pad))
                })
            } else {
                let (a, b) = (self.nodes[first as usize], self.nodes[first as usize + 1]);
                union((a.min, a.max), (b.min, b.max))
            };
            self.nodes[index].min = min;
            self.nodes[index].max = max;
        }
    }

    /// Calls `visit` with the number of each box the ray may meet, near ones first, roughly. `visit` gets the
    /// ray and may shorten it; it returns false to end the search.
    pub(crate) fn traverse(&self, ray: &Ray, mut visit: impl FnMut(u32, &mut Ray) -> bool) {
        let mut ray = *ray;
        let slabs = Slabs::new(&ray);
        let mut stack = Stack::default();
        if let Some(root) = self.nodes.first()
            && slabs.entry(root, ray.max).is_some()
        {
            stack.push(0, 0.0);
        }
        while let Some((index, entry)) = stack.pop() {
            if entry > ray.max {
                continue;
            }
            let node = &self.nodes[index as usize];
            if node.count > 0 {
                for &item in &self.order[node.first as usize..(node.first + node.count) as usize] {
                    if !visit(item, &mut ray) {
                        return;
                    }
                }
                continue;
            }
            let [a, b] =
                [node.first, node.first + 1].map(|i| (i, slabs.entry(&self.nodes[i as usize], ray.max)));
            let (near, far) =
                if a.1.unwrap_or(f64::MAX) <= b.1.unwrap_or(f64::MAX) { (a, b) } else { (b, a) };
            for (child, entry) in [far, near] {
                if let Some(entry) = entry {
                    stack.push(child, entry);
                }
            }
        }
    }
}

const EMPTY: Bounds = (DVec3::INFINITY, DVec3::NEG_INFINITY);

fn union(a: Bounds, b: Bounds) -> Bounds {
    (a.0.min(b.0), a.1.max(b.1))
}

/// A ray made ready for many boxes.
struct Slabs {
    origin: DVec3,
    inverse: DVec3,
    min: f64,
}

impl Slabs {
    fn new(ray: &Ray) -> Self {
        // Clamped, so that 0 · ∞ never makes a NaN: a ray along a box's side counts as meeting it.
        let inverse = ray.direction.to_array().map(|d| (1.0 / d).clamp(-1e300, 1e300));
        Self { origin: ray.origin, inverse: inverse.into(), min: ray.min }
    }

    /// Where the ray enters the node's box, if it may meet it before `max`. Errs on the side of yes.
    fn entry(&self, node: &Node, max: f64) -> Option<f64> {
        let a = (node.min - self.origin) * self.inverse;
        let b = (node.max - self.origin) * self.inverse;
        let enter = a.min(b).max_element().max(self.min);
        let exit = a.max(b).min_element().min(max);
        // Each product is off by at most 2 ulp; twice that for the comparison.
        let slack = 1e-15 * (enter.abs() + exit.abs()).min(f64::MAX);
        (enter <= exit + slack).then_some(enter - slack)
    }
}

/// A stack of nodes and entry points that allocates only for trees deeper than any sensible one.
struct Stack {
    fixed: [(u32, f64); STACK],
    length: usize,
    spilled: Vec<(u32, f64)>,
}

impl Default for Stack {
    fn default() -> Self {
        Self { fixed: [(0, 0.0); STACK], length: 0, spilled: Vec::new() }
    }
}

impl Stack {
    fn push(&mut self, index: u32, entry: f64) {
        match self.fixed.get_mut(self.length) {
            Some(slot) => {
                *slot = (index, entry);
                self.length += 1;
            }
            None => self.spilled.push((index, entry)),
        }
    }

    fn pop(&mut self) -> Option<(u32, f64)> {
        self.spilled.pop().or_else(|| {
            self.length = self.length.checked_sub(1)?;
            Some(self.fixed[self.length])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stack_is_a_stack_beyond_its_fixed_part() {
        let mut stack = Stack::default();
        for i in 0..3 * STACK as u32 {
            stack.push(i, f64::from(i));
        }
        for i in (0..3 * STACK as u32).rev() {
            assert_eq!(stack.pop(), Some((i, f64::from(i))), "pops what was pushed last");
        }
        assert_eq!(stack.pop(), None, "empty in the end");
    }

    /// Boxes that coincide, have no size, or lie far outside the range of float32.
    #[test]
    fn awkward_boxes_are_all_visited() {
        let point = |x: f64| (DVec3::splat(x), DVec3::splat(x));
        let same = vec![point(1.0); 1000];
        let far: Vec<Bounds> = (0..100).map(|i| point(f64::from(i) * 1e120)).collect();
        let near: Vec<Bounds> = (0..100).map(|i| point(1e9 + f64::from(i) * 1e-3)).collect();
        for boxes in [same, far, near, vec![point(-3.0)], vec![]] {
            let mut seen = vec![0; boxes.len()];
            let ray = Ray::new(DVec3::splat(-5.0), DVec3::ONE);
            Bvh::new(&boxes).traverse(&ray, |i, _| {
                seen[i as usize] += 1;
                true
            });
            assert!(seen.iter().all(|&n| n == 1), "each box once: {seen:?}");
        }
    }
}
