//! The pairs of light and occluder of one batch, culled and packed for upload.

use crate::frame::{Light, Occluder};
use crate::proxy::ProxyBuilder;
use crate::shader::ProgramId;
use crate::tiles::TileGrid;
use crate::view::View;
use antumbra_math::blocking::{Blocker, Blockers};
use antumbra_math::{Plane, Shape};
use glam::{DVec2, DVec3, Vec4};

/// Lights in one batch: two RGBA targets, a channel a light.
pub const BATCH_LIGHTS: usize = 8;
/// Lights in one RGBA target.
pub(crate) const GROUP_LIGHTS: usize = 4;

/// A corner of a bounding polygon, as the vertex shader reads it.
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(crate) struct Vertex {
    /// Clip space.
    position: [f32; 2],
    /// Channel + 4 * first texel.
    blocker: u32,
    /// The occluder's id.
    id: u32,
}

/// The vertices of one target and one program: one draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Draw {
    pub(crate) group: usize,
    pub(crate) program: ProgramId,
    pub(crate) first: i32,
    pub(crate) count: i32,
}

const KINDS: [ProgramId; 3] = [ProgramId::Sphere, ProgramId::Disc, ProgramId::Polygon];
const LISTS: usize = KINDS.len() * (BATCH_LIGHTS / GROUP_LIGHTS);

/// Packs batches; keeps its memory from one to the next.
#[derive(Default)]
pub(crate) struct PairBuilder {
    shapes_vs: Vec<(Shape, u32, DVec3, f64)>,
    bounds_vs: Vec<Plane>,
    proxy: ProxyBuilder,
    lists: [Vec<Vertex>; LISTS],
    /// What the blockers' data texture is to hold.
    pub(crate) texels: Vec<Vec4>,
    /// What the vertex buffer is to hold.
    pub(crate) vertices: Vec<Vertex>,
    /// The draws of the batch.
    pub(crate) draws: Vec<Draw>,
    /// First and number of the vertices that cover the touched tiles.
    pub(crate) screen_draw: (i32, i32),
    /// The tiles that the batch's polygons touch, and those of the whole frame.
    tiles: [TileGrid; 2],
    /// Pairs that were looked at, and polygons that are drawn, since the frame began.
    pub(crate) counts: (usize, usize),
}

impl PairBuilder {
    /// Takes the frame's occluders into view space.
    pub(crate) fn begin(&mut self, occluders: &[Occluder], bounds: &[Plane], view: &View) {
        self.counts = (0, 0);
        self.tiles[1].reset(viewport_size(view));
        self.shapes_vs.clear();
        self.bounds_vs.clear();
        let eye_ws = view.view.inverse().transform_point3(DVec3::ZERO);
        self.bounds_vs.extend(bounds.iter().map(|b| b.transformed(&view.view)));
        for o in occluders {
            let shape = o.shape.transformed(&view.view);
            let (center, radius) = shape.bounding_sphere();
            self.shapes_vs.push((shape, o.id, center, radius));
            // Nothing is seen behind an opaque plane that the host draws, unless the eye is in it.
            if let (Shape::Plane(plane), true) = (&o.shape, o.id != 0) {
                self.bounds_vs.extend(plane.towards(eye_ws).map(|side| side.transformed(&view.view)));
            }
        }
    }

    /// Packs the pairs of up to [`BATCH_LIGHTS`] lights.
    pub(crate) fn pack(&mut self, lights: &[Light], view: &View) {
        self.texels.clear();
        self.tiles[0].reset(viewport_size(view));
        self.lists.iter_mut().for_each(Vec::clear);
        for (i, light) in lights.iter().enumerate() {
            if light.intensity == glam::Vec3::ZERO {
                continue; // takes nothing away
            }
            self.pack_light(i, &light.place.transformed(&view.view), view);
        }
        self.vertices.clear();
        self.draws.clear();
        for (i, list) in self.lists.iter().enumerate().filter(|(_, list)| !list.is_empty()) {
            self.draws.push(Draw {
                group: i / KINDS.len(),
                program: KINDS[i % KINDS.len()],
                first: self.vertices.len() as i32,
                count: list.len() as i32,
            });
            self.vertices.extend_from_slice(list);
        }
        let [batch, frame] = &mut self.tiles;
        frame.add(batch);
        self.screen_draw = pack_tiles(batch, &mut self.vertices);
    }

    /// Packs the tiles that any batch of the frame has touched, and nothing else.
    pub(crate) fn pack_frame_tiles(&mut self) {
        self.texels.clear();
        self.vertices.clear();
        self.draws.clear();
        self.screen_draw = pack_tiles(&self.tiles[1], &mut self.vertices);
    }

    fn pack_light(&mut self, index: usize, light_vs: &antumbra_math::Light, view: &View) {
        let size = viewport_size(view);
        for &(shape, id, center, radius) in &self.shapes_vs {
            self.counts.0 += 1;
            if !light_vs.may_reach(center, radius) || hides_its_own_shadow(&shape, id, light_vs) {
                continue;
            }
            for (blocker, outline) in Blockers::new(&shape, light_vs).iter() {
                let polygon =
                    self.proxy.bound(outline, id == 0, light_vs.homogeneous(), view, &self.bounds_vs);
                if polygon.len() < 3 {
                    continue;
                }
                self.counts.1 += 1;
                self.tiles[0].touch(polygon);
                let first = self.texels.len() as u32;
                let kind = pack_blocker(blocker, &mut self.texels);
                let vertex = |p: DVec2| Vertex {
                    position: clip_position(p, size),
                    blocker: first * 4 + (index % GROUP_LIGHTS) as u32,
                    id,
                };
                let list = &mut self.lists[index / GROUP_LIGHTS * KINDS.len() + kind];
                for corners in polygon[1..].windows(2) {
                    list.extend([polygon[0], corners[0], corners[1]].map(vertex));
                }
            }
        }
    }
}

fn viewport_size(view: &View) -> DVec2 {
    DVec2::new(f64::from(view.viewport[2]), f64::from(view.viewport[3]))
}

/// Two triangles a run of touched tiles; the first vertex and their number.
fn pack_tiles(tiles: &TileGrid, vertices: &mut Vec<Vertex>) -> (i32, i32) {
    let first = vertices.len();
    let size = tiles.size();
    tiles.runs(|a, b| {
        let corners = [a, DVec2::new(b.x, a.y), b, a, b, DVec2::new(a.x, b.y)];
        vertices.extend(corners.map(|p| Vertex { position: clip_position(p, size), blocker: 0, id: 0 }));
    });
    (first as i32, (vertices.len() - first) as i32)
}

/// From pixels of the viewport to clip space.
fn clip_position(p: DVec2, size: DVec2) -> [f32; 2] {
    (p / size * 2.0 - 1.0).as_vec2().to_array()
}

/// Whether nothing that is seen can lie in the shape's shadow: an opaque infinite plane, drawn by
/// the host, with the eye (the origin) on the light's side hides all that it takes the light from.
fn hides_its_own_shadow(shape: &Shape, id: u32, light_vs: &antumbra_math::Light) -> bool {
    let Shape::Plane(plane) = shape else { return false };
    let light = light_vs.homogeneous();
    let light_side = plane.normal.dot(light.truncate()) - plane.offset * light.w;
    id != 0 && light_side * plane.height(DVec3::ZERO) > 0.0
}

/// Appends a blocker's texels, as its shader reads them, and says which of [`KINDS`] it is.
fn pack_blocker(blocker: &Blocker<DVec3>, texels: &mut Vec<Vec4>) -> usize {
    match blocker.to_f32() {
        Blocker::Sphere(b) => {
            texels.extend([b.center.extend(b.radius), b.light.extend(b.light_w)]);
            0
        }
        Blocker::Disc(b) => {
            texels.extend([b.center.extend(b.radius), b.normal.extend(b.nearness), b.toward.extend(0.0)]);
            1
        }
        Blocker::Polygon(b) => {
            texels.extend(b.planes().map(|(normal, offset)| normal.extend(offset)));
            2
        }
    }
}
