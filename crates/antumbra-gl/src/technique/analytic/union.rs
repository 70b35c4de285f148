//! Lists of the occluders that reach each tile of the screen, for unions of what they hide of one light.

use super::kind::SoftShape;
use crate::screen::TileGrid;
use glam::{DVec2, Vec4};

/// Collects the pairs of one light by tiles; keeps its memory from one light to the next.
#[derive(Default)]
pub(super) struct UnionBuilder {
    tiles: TileGrid,
    /// Of each tile, the pairs that reach it: kind, first texel, id.
    lists: Vec<Vec<(SoftShape, u32, u32)>>,
}

impl UnionBuilder {
    /// A new light, for a viewport of `size` pixels.
    pub(super) fn begin(&mut self, size: DVec2) {
        self.tiles.reset(size);
        self.lists.iter_mut().for_each(Vec::clear);
        self.lists.resize_with(self.tiles.len(), Vec::new);
    }

    /// A pair whose penumbra lies in the convex `polygon`.
    pub(super) fn add(&mut self, polygon: &[DVec2], kind: SoftShape, first_texel: usize, id: u32) {
        self.tiles.reset_touched();
        self.tiles.touch(polygon);
        for tile in self.tiles.touched() {
            self.lists[tile].push((kind, first_texel as u32, id));
        }
    }

    /// Appends the tiles' lists as `union.frag.glsl` reads them, and calls `tile` with the corners of each and its first
    /// texel.
    pub(super) fn pack(
        &mut self,
        light_texel: usize,
        texels: &mut Vec<Vec4>,
        mut tile: impl FnMut([DVec2; 4], usize),
    ) {
        for (i, list) in self.lists.iter_mut().enumerate().filter(|(_, list)| !list.is_empty()) {
            // By kind: each has a loop of its own. Triangles and rectangles have four corners both.
            list.sort_unstable();
            let first = texels.len();
            let mut counts = [0.0f32; SoftShape::COUNT];
            list.iter().for_each(|(kind, ..)| counts[*kind as usize] += 1.0);
            let [balls, discs, triangles, rectangles, cones, planes] = counts;
            texels.push(Vec4::new(light_texel as f32, (first + 2) as f32, balls, discs));
            texels.push(Vec4::new(triangles + rectangles, cones, planes, 0.0));
            texels.extend(list.iter().map(|&(_, texel, id)| {
                Vec4::new(texel as f32, (id & 0xffff) as f32, (id >> 16) as f32, 0.0)
            }));
            tile(self.tiles.corners(i), first);
        }
    }
}
