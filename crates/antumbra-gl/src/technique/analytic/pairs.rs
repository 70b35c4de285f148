//! The pairs of light and occluder of one batch, culled and packed for upload.

use super::area_light::AreaLight;
use super::kind::{HardKind, Kind};
use super::seams::{Piece, Seams};
use super::union::UnionBuilder;
use crate::input::{Frame, Light};
use crate::masks::{BATCH_LIGHTS, Counts, GROUP_LIGHTS};
use crate::screen::{ProxyBuilder, TileGrid, View, hides_its_own_shadow, seen_half_spaces};
use crate::technique::polygons::{Vertex, push_polygon};
use antumbra_math::blocking::{Blocker, Blockers, Outline, PolygonBlocker};
use antumbra_math::soft::Standing;
use antumbra_math::{Plane, Shape};
use glam::{DVec3, DVec4, Vec3, Vec4};

/// The vertices of one target and one program: one draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Draw {
    pub(super) group: usize,
    /// The kind of blocker, by [`Kind::index`]: which program.
    pub(super) kind: usize,
    pub(super) first: i32,
    pub(super) count: i32,
}

/// One for each mask of the batch and each kind.
const LISTS: usize = Kind::COUNT * (BATCH_LIGHTS / GROUP_LIGHTS);

/// Packs batches; keeps its memory from one to the next.
#[derive(Default)]
pub(super) struct PairBuilder {
    shapes_vs: Vec<(Shape, u32, DVec3, f64)>,
    bounds_vs: Vec<Plane>,
    proxy: ProxyBuilder,
    union: UnionBuilder,
    seams: Seams,
    /// The ids of solids that hold a light.
    holders: Vec<u32>,
    /// [`LISTS`] of them.
    lists: Vec<Vec<Vertex>>,
    /// What the blockers' data texture is to hold.
    pub(super) texels: Vec<Vec4>,
    /// What the vertex buffer is to hold.
    pub(super) vertices: Vec<Vertex>,
    /// The draws of the batch.
    pub(super) draws: Vec<Draw>,
    /// Since the frame began.
    pub(super) counts: Counts,
}

impl PairBuilder {
    /// Takes the frame's occluders into view space.
    pub(super) fn begin(&mut self, frame: &Frame<'_>, view: &View) {
        let (occluders, bounds) = (frame.occluders, frame.bounds);
        self.counts = Counts::default();
        self.seams.begin(occluders);
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
    pub(super) fn pack(&mut self, lights: &[Light], view: &View, tiles: &mut TileGrid, exact: bool) {
        self.texels.clear();
        self.lists.resize_with(LISTS, Vec::new);
        self.lists.iter_mut().for_each(Vec::clear);
        for (i, light) in lights.iter().enumerate() {
            if light.intensity == Vec3::ZERO {
                continue; // takes nothing away
            }
            let place = light.place.transformed(&view.view);
            match AreaLight::new(light.area, place.homogeneous().truncate(), &view.view) {
                None => self.pack_light(i, light, &place, view, tiles),
                Some(area) => self.pack_area_light((i, light), &area, &place, view, tiles, exact),
            }
        }
        self.vertices.clear();
        self.draws.clear();
        for (i, list) in self.lists.iter().enumerate().filter(|(_, list)| !list.is_empty()) {
            self.draws.push(Draw {
                group: i / Kind::COUNT,
                kind: i % Kind::COUNT,
                first: self.vertices.len() as i32,
                count: list.len() as i32,
            });
            self.vertices.extend_from_slice(list);
        }
    }

    fn pack_light(
        &mut self,
        index: usize,
        light: &Light,
        light_vs: &antumbra_math::Light,
        view: &View,
        tiles: &mut TileGrid,
    ) {
        let channel = index % GROUP_LIGHTS;
        for (occluder, &(shape, id, center, radius)) in self.shapes_vs.iter().enumerate() {
            self.counts.pairs += 1;
            let drawn_before = self.counts.polygons;
            if !light.may_reach(light_vs, center, radius)
                || hides_its_own_shadow(&shape, id, light_vs, view.eye_vs())
            {
                continue;
            }
            if self.seams.touches(occluder) {
                for piece in self.seams.pieces(occluder, light_vs.homogeneous(), &view.view) {
                    let outline = piece.outline();
                    let polygon =
                        self.proxy.bound(&outline, id == 0, light_vs.homogeneous(), view, &self.bounds_vs);
                    if polygon.len() < 3 {
                        continue;
                    }
                    self.counts.polygons += 1;
                    tiles.touch(polygon);
                    let first = self.texels.len();
                    let kind = Kind::Hard(pack_piece(piece, &mut self.texels));
                    push_polygon(&mut self.lists[list(index, kind)], polygon, view, (channel, first), id);
                }
                self.counts.drawn += usize::from(self.counts.polygons > drawn_before);
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
                let first = self.texels.len();
                let kind = Kind::Hard(pack_blocker(blocker, &mut self.texels));
                push_polygon(&mut self.lists[list(index, kind)], polygon, view, (channel, first), id);
            }
            self.counts.drawn += usize::from(self.counts.polygons > drawn_before);
        }
    }

    /// A solid that holds the light: nothing arrives anywhere but on itself.
    fn pack_everything(&mut self, index: usize, id: u32, view: &View, tiles: &mut TileGrid) {
        let polygon = self.proxy.bound(&Outline::Everywhere, id == 0, DVec4::W, view, &self.bounds_vs);
        if polygon.len() < 3 {
            return;
        }
        self.counts.drawn += 1;
        self.counts.polygons += 1;
        tiles.touch(polygon);
        let first = self.texels.len();
        let kind = Kind::Hard(pack_blocker(&Blocker::Polygon(PolygonBlocker::EVERYTHING), &mut self.texels));
        push_polygon(&mut self.lists[list(index, kind)], polygon, view, (index % GROUP_LIGHTS, first), id);
    }

    /// `place` is where the light's centre is.
    fn pack_area_light(
        &mut self,
        (index, light): (usize, &Light),
        area: &AreaLight,
        place: &antumbra_math::Light,
        view: &View,
        tiles: &mut TileGrid,
        exact: bool,
    ) {
        let light_texel = self.texels.len();
        let channel = index % GROUP_LIGHTS;
        if exact {
            self.union.begin(view.size());
            area.pack(&mut self.texels);
        }
        let mut holders = std::mem::take(&mut self.holders);
        holders.clear();
        for &(shape, id, center, radius) in &self.shapes_vs {
            self.counts.pairs += 1;
            let hides_all = area.is_beside(&shape) && hides_its_own_shadow(&shape, id, place, view.eye_vs());
            if hides_all || !light.may_reach(place, center, radius) {
                continue;
            }
            let standing = area.standing(&shape);
            match standing {
                Standing::Behind => continue,
                Standing::Around => {
                    holders.push(id);
                    continue;
                }
                _ => {}
            }
            let first = self.texels.len();
            let Some(kind) = area.pack_pair(&shape, standing, &mut self.texels, exact) else { continue };
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
                self.union.add(polygon, kind, first, id);
                continue;
            }
            let list = list(index, Kind::Soft(area.emitter(), kind));
            push_polygon(&mut self.lists[list], polygon, view, (channel, first), id);
        }
        holders.iter().for_each(|&id| self.pack_everything(index, id, view, tiles));
        self.holders = holders;
        if exact {
            let list = &mut self.lists[list(index, Kind::Union(area.emitter()))];
            self.union.pack(light_texel, &mut self.texels, |corners, first| {
                push_polygon(list, &corners, view, (channel, first), 0);
            });
        }
    }
}

/// The list that a kind of blocker of the batch's light `index` is packed into.
fn list(index: usize, kind: Kind) -> usize {
    index / GROUP_LIGHTS * Kind::COUNT + kind.index()
}

/// Appends a blocker's texels, as its shader reads them, and says of which kind it is.
fn pack_blocker(blocker: &Blocker<DVec3>, texels: &mut Vec<Vec4>) -> HardKind {
    match blocker.to_f32() {
        Blocker::Sphere(b) => {
            texels.extend([b.center.extend(b.radius), b.light.extend(b.light_w)]);
            HardKind::Sphere
        }
        Blocker::Disc(b) => {
            texels.extend([b.center.extend(b.radius), b.normal.extend(b.nearness), b.toward.extend(0.0)]);
            HardKind::Disc
        }
        Blocker::Polygon(b) => {
            texels.extend(b.planes().map(|(normal, offset)| normal.extend(offset)));
            HardKind::Polygon
        }
    }
}

/// The same of a polygon's piece: with four texels for each edge where any is continued, the plane of what continues it and
/// three edges. Behind the plane of what is not there is nothing.
fn pack_piece(piece: &Piece, texels: &mut Vec<Vec4>) -> HardKind {
    let kind = pack_blocker(&Blocker::Polygon(piece.blocker), texels);
    if piece.seams.iter().all(Option::is_none) {
        return kind;
    }
    let texel = |(normal, offset): (DVec3, f64)| normal.as_vec3().extend(offset as f32);
    for seam in &piece.seams {
        texels.push(seam.map_or(-Vec4::W, |seam| texel(seam.base)));
        texels.extend(seam.map_or([Vec4::W; 3], |seam| seam.edges.map(texel)));
    }
    HardKind::Seamed
}
