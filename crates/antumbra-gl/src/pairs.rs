//! The pairs of light and occluder of one batch, culled and packed for upload.

use crate::proxy::ProxyBuilder;
use crate::results::Counts;
use crate::scenery::{Light, Occluder};
use crate::soft_pairs::{AreaLight, SOFT_SHAPES};
use crate::tiles::TileGrid;
use crate::union::UnionBuilder;
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
    pub(crate) position: [f32; 2],
    /// Channel + 4 * first texel.
    pub(crate) blocker: u32,
    /// The occluder's id.
    pub(crate) id: u32,
}

/// The vertices of one target and one program: one draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Draw {
    pub(crate) group: usize,
    /// The kind of blocker: which program.
    pub(crate) kind: usize,
    pub(crate) first: i32,
    pub(crate) count: i32,
}

/// Kinds of blocker of lights without extent: sphere, disc, polygon.
pub(crate) const HARD_KINDS: usize = 3;
/// All kinds: after those, each shape past a ball, and past a flat light; all shapes past a ball, and past a flat light.
const KINDS: usize = HARD_KINDS + 2 * SOFT_SHAPES + 2;
const LISTS: usize = KINDS * (BATCH_LIGHTS / GROUP_LIGHTS);

/// Packs batches; keeps its memory from one to the next.
#[derive(Default)]
pub(crate) struct PairBuilder {
    shapes_vs: Vec<(Shape, u32, DVec3, f64)>,
    bounds_vs: Vec<Plane>,
    proxy: ProxyBuilder,
    union: UnionBuilder,
    /// [`LISTS`] of them.
    lists: Vec<Vec<Vertex>>,
    /// What the blockers' data texture is to hold.
    pub(crate) texels: Vec<Vec4>,
    /// What the vertex buffer is to hold.
    pub(crate) vertices: Vec<Vertex>,
    /// The draws of the batch.
    pub(crate) draws: Vec<Draw>,
    /// Since the frame began.
    pub(crate) counts: Counts,
}

impl PairBuilder {
    /// Takes the frame's occluders into view space.
    pub(crate) fn begin(&mut self, occluders: &[Occluder], bounds: &[Plane], view: &View) {
        self.counts = Counts::default();
        self.shapes_vs.clear();
        self.bounds_vs.clear();
        seen_half_spaces(occluders, bounds, view, &mut self.bounds_vs);
        for o in occluders {
            let shape = o.shape.transformed(&view.view);
            let (center, radius) = shape.bounding_sphere();
            self.shapes_vs.push((shape, o.id, center, radius));
        }
    }

    /// Packs the pairs of up to [`BATCH_LIGHTS`] lights, and touches the tiles that their polygons do.
    /// `exact` puts what occluders hide of an area light together as a union.
    pub(crate) fn pack(&mut self, lights: &[Light], view: &View, tiles: &mut TileGrid, exact: bool) {
        self.texels.clear();
        self.lists.resize_with(LISTS, Vec::new);
        self.lists.iter_mut().for_each(Vec::clear);
        for (i, light) in lights.iter().enumerate() {
            if light.intensity == glam::Vec3::ZERO {
                continue; // takes nothing away
            }
            let place = light.place.transformed(&view.view);
            match AreaLight::new(light.area, place.homogeneous().truncate(), &view.view) {
                None => self.pack_light(i, &place, view, tiles),
                Some(area) => self.pack_area_light(i, &area, &place, view, tiles, exact),
            }
        }
        self.vertices.clear();
        self.draws.clear();
        for (i, list) in self.lists.iter().enumerate().filter(|(_, list)| !list.is_empty()) {
            self.draws.push(Draw {
                group: i / KINDS,
                kind: i % KINDS,
                first: self.vertices.len() as i32,
                count: list.len() as i32,
            });
            self.vertices.extend_from_slice(list);
        }
    }

    fn pack_light(
        &mut self,
        index: usize,
        light_vs: &antumbra_math::Light,
        view: &View,
        tiles: &mut TileGrid,
    ) {
        let size = view.size();
        for &(shape, id, center, radius) in &self.shapes_vs {
            self.counts.pairs += 1;
            let drawn_before = self.counts.polygons;
            if !light_vs.may_reach(center, radius) || hides_its_own_shadow(&shape, id, light_vs) {
                continue;
            }
            for (blocker, outline) in Blockers::new(&shape, light_vs).iter() {
                let polygon =
                    self.proxy.bound(outline, id == 0, light_vs.homogeneous(), view, &self.bounds_vs);
                if polygon.len() < 3 {
                    continue;
                }
                self.counts.polygons += 1;
                tiles.touch(polygon);
                let first = self.texels.len() as u32;
                let kind = pack_blocker(blocker, &mut self.texels);
                let list = &mut self.lists[index / GROUP_LIGHTS * KINDS + kind];
                pack_polygon(list, polygon, size, first * 4 + (index % GROUP_LIGHTS) as u32, id);
            }
            self.counts.drawn += usize::from(self.counts.polygons > drawn_before);
        }
    }

    /// `place` is where the light's centre is.
    fn pack_area_light(
        &mut self,
        index: usize,
        area: &AreaLight,
        place: &antumbra_math::Light,
        view: &View,
        tiles: &mut TileGrid,
        exact: bool,
    ) {
        let light_texel = self.texels.len();
        if exact {
            self.union.begin(view.size());
            area.pack(&mut self.texels);
        }
        for &(shape, id, ..) in &self.shapes_vs {
            self.counts.pairs += 1;
            if area.is_beside(&shape) && hides_its_own_shadow(&shape, id, place) {
                continue;
            }
            let first = self.texels.len();
            let Some(kind) = area.pack_pair(&shape, &mut self.texels, exact) else { continue };
            let (outline, origins) = area.outline(&shape);
            let polygon = self.proxy.bound_from(&outline, id == 0, origins.iter(), view, &self.bounds_vs);
            if polygon.len() < 3 {
                self.texels.truncate(first);
                continue;
            }
            self.counts.drawn += 1;
            self.counts.polygons += 1;
            tiles.touch(polygon);
            if exact {
                self.union.add(polygon, kind % SOFT_SHAPES, first, id);
                continue;
            }
            let list = &mut self.lists[index / GROUP_LIGHTS * KINDS + HARD_KINDS + kind];
            let blocker = first as u32 * 4 + (index % GROUP_LIGHTS) as u32;
            pack_polygon(list, polygon, view.size(), blocker, id);
        }
        if exact {
            let kind = HARD_KINDS + 2 * SOFT_SHAPES + usize::from(!area.is_ball());
            let list = &mut self.lists[index / GROUP_LIGHTS * KINDS + kind];
            self.union.pack(light_texel, &mut self.texels, |corners, first| {
                let blocker = first as u32 * 4 + (index % GROUP_LIGHTS) as u32;
                pack_polygon(list, &corners, view.size(), blocker, 0);
            });
        }
    }
}

/// Appends the half-spaces that hold everything seen, view space.
pub(crate) fn seen_half_spaces(
    occluders: &[Occluder],
    bounds: &[Plane],
    view: &View,
    half_spaces: &mut Vec<Plane>,
) {
    let eye_ws = view.view.inverse().transform_point3(DVec3::ZERO);
    half_spaces.extend(bounds.iter().map(|b| b.transformed(&view.view)));
    for o in occluders {
        // Nothing is seen behind an opaque plane that the host draws, unless the eye is in it.
        if let (Shape::Plane(plane), true) = (&o.shape, o.id != 0) {
            half_spaces.extend(plane.towards(eye_ws).map(|side| side.transformed(&view.view)));
        }
    }
}

/// From pixels of the viewport to clip space.
pub(crate) fn clip_position(p: DVec2, size: DVec2) -> [f32; 2] {
    (p / size * 2.0 - 1.0).as_vec2().to_array()
}

/// The triangles of a convex polygon.
fn pack_polygon(list: &mut Vec<Vertex>, polygon: &[DVec2], size: DVec2, blocker: u32, id: u32) {
    let vertex = |p: DVec2| Vertex { position: clip_position(p, size), blocker, id };
    for corners in polygon[1..].windows(2) {
        list.extend([polygon[0], corners[0], corners[1]].map(vertex));
    }
}

/// Whether nothing that is seen can lie in the shape's shadow: an opaque infinite plane, drawn by
/// the host, with the eye (the origin) on the light's side hides all that it takes the light from.
pub(crate) fn hides_its_own_shadow(shape: &Shape, id: u32, light_vs: &antumbra_math::Light) -> bool {
    let Shape::Plane(plane) = shape else { return false };
    let light = light_vs.homogeneous();
    let light_side = plane.normal.dot(light.truncate()) - plane.offset * light.w;
    id != 0 && light_side * plane.height(DVec3::ZERO) > 0.0
}

/// Appends a blocker's texels, as its shader reads them, and says of which kind it is.
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
