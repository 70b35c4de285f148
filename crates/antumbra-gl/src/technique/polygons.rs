//! Polygons on the screen that carry numbers to the fragments, as `blocker.vert.glsl` reads them.

use crate::screen::View;
use glam::DVec2;

/// A corner of a bounding polygon.
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct Vertex {
    /// Clip space.
    position: [f32; 2],
    /// Channel + 4 * first texel.
    blocker: u32,
    /// The occluder's id.
    id: u32,
}

/// Appends the triangles of a convex polygon, in pixels of the viewport. `channel` is where its light goes,
/// `first_texel` where its numbers begin in the data texture.
pub(super) fn push_polygon(
    vertices: &mut Vec<Vertex>,
    polygon: &[DVec2],
    view: &View,
    (channel, first_texel): (usize, usize),
    id: u32,
) {
    let blocker = first_texel as u32 * 4 + channel as u32;
    let vertex = |p: DVec2| Vertex { position: view.clip_position(p), blocker, id };
    for corners in polygon[1..].windows(2) {
        vertices.extend([polygon[0], corners[0], corners[1]].map(vertex));
    }
}
