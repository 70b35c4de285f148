//! The shadow volumes of one batch of lights, as polygons for the GPU.

use super::Counting;
use super::boundary::{Boundary, Cap};
use super::eye::{is_clear, layers};
use super::polygon::{Eye, Front, front};
use crate::input::Light as Source;
use crate::masks::{Batch, Counts};
use crate::screen::{
    ProxyBuilder, TileGrid, View, crossing, hides_its_own_shadow, nearest_end, seen_half_spaces,
};
use crate::technique::Pass;
use crate::technique::casters::{Caster, caster_of};
use antumbra_math::blocking::Blockers;
use antumbra_math::{Light, Plane, Shape, Sphere};
use glam::{DVec2, DVec3, DVec4};

/// Flag in a polygon's id: it is counted on the surface with that id too.
const SHADOWS_ITSELF: u32 = 1 << 31;

/// By how much volumes go on beyond the half-space that holds all that is seen, as a part of their length to
/// there: what lies in its border is inside. Also as a part of the distance from the eye.
const BEYOND: f64 = 1e-3;

/// A homogeneous clip position that is this small a part of where it comes from is at the eye itself.
const AT_EYE: f64 = 1e-12;

/// A plane that has everything on its positive side, beyond any tolerance.
const EVERYWHERE: DVec4 = DVec4::new(0.0, 0.0, 0.0, 1e30);

/// A corner of a polygon, as the vertex shader reads it.
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct Vertex {
    /// Clip space: x, y, w.
    pub(super) position: [f32; 3],
    /// View space; points on its positive side are counted.
    pub(super) plane: [f32; 4],
    /// Tolerances to add to the distance from the plane: on any surface, on the caster's own.
    pub(super) lift: [f32; 2],
    /// The caster's, and [`SHADOWS_ITSELF`].
    pub(super) id: u32,
}

/// What one light needs.
#[derive(Clone, Copy, Debug)]
pub(super) struct LightDraw {
    /// Its place in the batch.
    pub(super) light: usize,
    /// Polygons to count: first vertex and how many.
    pub(super) polygons: (i32, i32),
    /// Tiles to look at: likewise.
    pub(super) tiles: (i32, i32),
    /// A rectangle round these tiles, pixels: x, y, width, height.
    pub(super) scissor: [i32; 4],
}

/// A mesh or shape that casts, in view space.
struct Posed {
    /// The occluder's or mesh's index in its list.
    index: usize,
    is_mesh: bool,
    shape: Option<Shape>,
    id: u32,
    center: DVec3,
    radius: f64,
}

/// Packs batches; keeps its memory from one to the next.
#[derive(Default)]
pub(super) struct Packer {
    posed: Vec<Posed>,
    bounds_vs: Vec<Plane>,
    /// Those of them that hold the eye, and so all of every sight.
    ends_vs: Vec<Plane>,
    boundary: Boundary,
    rays: Vec<(DVec3, DVec3)>,
    proxy: ProxyBuilder,
    light_tiles: TileGrid,
    /// What the buffers are to hold.
    pub(super) vertices: Vec<Vertex>,
    pub(super) tiles: Vec<[f32; 2]>,
    pub(super) draws: Vec<LightDraw>,
    /// Since the frame began.
    pub(super) counts: Counts,
}

impl Packer {
    /// Takes the frame's occluders into view space.
    pub(super) fn begin(&mut self, pass: &Pass<'_>) {
        self.counts = Counts::default();
        self.posed.clear();
        self.bounds_vs.clear();
        let (to_view, frame) = (&pass.view.view, &pass.frame);
        seen_half_spaces(frame.occluders, frame.bounds, pass.view, &mut self.bounds_vs);
        for (index, o) in frame.occluders.iter().enumerate() {
            let shape = o.shape.transformed(to_view);
            let (center, radius) = shape.bounding_sphere();
            let shape = Some(shape);
            self.posed.push(Posed { index, is_mesh: false, shape, id: o.id, center, radius });
        }
        self.ends_vs.clear();
        let eye = pass.view.eye_vs();
        self.ends_vs.extend(self.bounds_vs.iter().filter(|plane| plane.height_of(eye) > 0.0));
        for (index, m) in pass.frame.meshes.iter().enumerate() {
            let model = *to_view * m.model;
            let sphere = m.mesh.bounding_sphere();
            let center = model.transform_point3(sphere.center);
            // No direction is stretched by more than this (the Frobenius norm).
            let columns = [model.x_axis, model.y_axis, model.z_axis];
            let stretch = columns.iter().map(|c| c.length_squared()).sum::<f64>().sqrt();
            let radius = sphere.radius * stretch;
            self.posed.push(Posed { index, is_mesh: true, shape: None, id: m.id, center, radius });
        }
    }

    /// Packs the volumes of up to eight lights, and touches the tiles that shadows can reach.
    pub(super) fn pack(&mut self, pass: &Pass<'_>, counting: Counting, batch: &mut Batch<'_>) {
        self.vertices.clear();
        self.tiles.clear();
        self.draws.clear();
        let eye = Eye::new(pass.view, pass.frame.surface.depth_format.zero_to_one);
        for (index, light) in batch.lights.iter().enumerate() {
            let place = light.place.transformed(&pass.view.view);
            let l = place.homogeneous();
            let is_off = !l.is_finite() || l == DVec4::ZERO || light.intensity == glam::Vec3::ZERO;
            if is_off {
                continue;
            }
            let first = self.vertices.len();
            self.light_tiles.reset(pass.view.size());
            for i in 0..self.posed.len() {
                self.counts.pairs += 1;
                let drawn_before = self.counts.polygons;
                self.pack_pair(i, (light, &place), &eye, pass, counting);
                self.counts.drawn += usize::from(self.counts.polygons > drawn_before);
            }
            if self.vertices.len() == first {
                continue;
            }
            let first_tile = self.tiles.len();
            self.light_tiles.triangles(&mut self.tiles);
            batch.tiles.add(&self.light_tiles);
            self.draws.push(LightDraw {
                light: index,
                polygons: (first as i32, (self.vertices.len() - first) as i32),
                tiles: (first_tile as i32, (self.tiles.len() - first_tile) as i32),
                scissor: self.light_tiles.rectangle(),
            });
        }
    }

    fn pack_pair(
        &mut self,
        index: usize,
        (source, light): (&Source, &Light),
        eye: &Eye,
        pass: &Pass<'_>,
        counting: Counting,
    ) {
        let posed = &self.posed[index];
        let Posed { center, radius, id, is_mesh, .. } = *posed;
        if !source.may_reach(light, center, radius) {
            return;
        }
        let l = light.homogeneous();
        if let Some(shape @ Shape::Plane(plane)) = posed.shape {
            if !hides_its_own_shadow(&shape, id, light, eye.place) {
                self.pack_plane(&plane, id, l);
            }
            return;
        }
        let caster = if is_mesh {
            let m = &pass.frame.meshes[posed.index];
            Some(Caster { mesh: &m.mesh, model: m.model, id })
        } else {
            caster_of(&pass.frame.occluders[posed.index])
        };
        let Some(caster) = caster else { return };
        // Where the shadow can be seen.
        let solid = posed.shape.unwrap_or(Shape::Sphere(Sphere { center, radius }));
        let is_hollow = id == 0 || is_mesh;
        let mut reach = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for (_, outline) in Blockers::new(&solid, light).iter() {
            let polygon = self.proxy.bound(outline, is_hollow, l, pass.view, &self.bounds_vs);
            if polygon.len() >= 3 {
                self.light_tiles.touch(polygon);
                reach = polygon.iter().fold(reach, |(low, high), &p| (low.min(p), high.max(p)));
            }
        }
        if reach.0.x > reach.1.x {
            return;
        }
        let clear = is_clear(eye, l, center, radius);
        // A shape, being convex, may be spanned inside, unless one can look into it.
        let looked_into = (id == 0 && pass.frame.surface.ids.is_some())
            || center.length() <= radius * 1.01
            || center.z + radius >= eye.near;
        let cap = if is_mesh || looked_into { Cap::Faces } else { Cap::Inside };
        let to_view = pass.view.view * caster.model;
        let found = match (posed.shape, cap) {
            (Some(Shape::Sphere(ball)), Cap::Inside) => {
                self.boundary.of_ball(&ball, l, reach.0.distance(reach.1))
            }
            _ => false,
        };
        if !found {
            self.boundary.of_mesh(&caster, &to_view, l, cap);
        }
        let how = match counting {
            Counting::DepthFail => How::Behind,
            Counting::PerVolume if !clear => How::Behind,
            _ => How::InFront,
        };
        let id = if is_mesh || id == 0 { id | SHADOWS_ITSELF } else { id };
        self.pack_volume(l, eye, pass.view, id, how);
        if how == How::InFront && !clear {
            for _ in 0..layers(eye, l, &self.boundary) {
                self.push_screen(EVERYWHERE, id);
            }
        }
    }

    /// The half-space behind an infinite plane.
    fn pack_plane(&mut self, plane: &Plane, id: u32, light: DVec4) {
        let height = plane.height_of(light);
        let in_plane = height.abs() <= 1e-12 * (light.length() + plane.offset.abs() * light.w);
        if in_plane || !plane.normal.is_finite() || !plane.offset.is_finite() {
            return;
        }
        let side = -height.signum();
        let behind = (plane.normal * side).extend(-plane.offset * side);
        self.light_tiles.touch_all();
        self.push_screen(behind, if id == 0 { SHADOWS_ITSELF } else { id });
    }

    /// Sides, near cap and far cap, as far as they are needed.
    fn pack_volume(&mut self, light: DVec4, eye: &Eye, view: &View, id: u32, how: How) {
        let away = |p: DVec3| p * light.w - light.truncate();
        self.rays.clear();
        self.rays.extend(self.boundary.edges.iter().map(|&[a, _]| (a, away(a))));
        if how == How::Behind {
            // The far cap is the near one, drawn out.
            self.boundary.caps(|cap| self.rays.extend(cap.map(|p| (p, away(p)))));
        }
        let end = if self.rays.is_empty() { None } else { nearest_end(&self.rays, &self.ends_vs).copied() };
        let far = |p: DVec3| match &end {
            Some(plane) => {
                let length = crossing(plane, p, away(p));
                let more = BEYOND * (length + p.length() / away(p).length());
                (p + away(p) * (length + more)).extend(1.0)
            }
            None => away(p).extend(0.0),
        };
        let Self { boundary, vertices, counts, .. } = self;
        let mut target = Polygons { vertices, count: &mut counts.polygons, eye, view, id, how };
        for &[a, b] in &boundary.edges {
            // Through the light and the edge.
            let Some(normal) = unit_cross(light.truncate() - a * light.w, b - a) else { continue };
            let corners = [b.extend(1.0), a.extend(1.0), far(a), far(b)];
            // Parallel rays meet at infinity.
            let distinct = if light.w == 0.0 && end.is_none() { 3 } else { 4 };
            target.push(&corners[..distinct], normal, a, Kind::Side);
        }
        boundary.caps(|[a, b, c]| {
            if let Some(normal) = unit_cross(b - a, c - a) {
                target.push(&[a, b, c].map(|p| p.extend(1.0)), normal, a, Kind::Cap);
            }
        });
        let far_cap = how == How::Behind && (light.w != 0.0 || end.is_some());
        if far_cap {
            boundary.caps(|[a, b, c]| target.push_beyond_all(&[c, b, a].map(far)));
        }
    }

    /// A polygon over the whole screen.
    fn push_screen(&mut self, plane: DVec4, id: u32) {
        let lift = Kind::Cap.tolerances().map(|t| -t);
        let plane = plane.as_vec4().to_array();
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        self.vertices.extend(corners.map(|[x, y]| Vertex { position: [x, y, 1.0], plane, lift, id }));
        self.counts.polygons += 1;
    }
}

/// Which of a volume's polygons are counted at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum How {
    /// Those between the point and the eye: depth-pass.
    InFront,
    /// Those behind the point: depth-fail.
    Behind,
}

/// What a polygon is of its volume.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Side,
    Cap,
}

impl Kind {
    /// Whether the tolerance is for any surface, and for the caster's own. A cap is where the caster is: what lies
    /// in its plane is lit. A side is where the shadow ends, and only begins at the caster.
    fn tolerances(self) -> [f32; 2] {
        match self {
            Self::Side => [0.0, 1.0],
            Self::Cap => [1.0, 1.0],
        }
    }
}

/// Where polygons go.
struct Polygons<'a> {
    vertices: &'a mut Vec<Vertex>,
    count: &'a mut usize,
    eye: &'a Eye,
    view: &'a View,
    id: u32,
    how: How,
}

impl Polygons<'_> {
    /// A convex polygon, its corners counter-clockwise seen from outside the volume, with a unit normal to
    /// either side, through `point`.
    fn push(&mut self, corners: &[DVec4], normal: DVec3, point: DVec3, kind: Kind) {
        let plane = match front(self.eye, corners, normal, point) {
            Front::Of(plane) => plane,
            Front::Nothing => -EVERYWHERE,
            // Everything on the way from there is behind it.
            Front::Touching(_) if self.how == How::Behind => return,
            Front::Touching(plane) => plane,
        };
        self.fan(corners, plane, kind);
    }

    /// A polygon behind everything that is seen.
    fn push_beyond_all(&mut self, corners: &[DVec4]) {
        self.fan(corners, -EVERYWHERE, Kind::Cap);
    }

    /// A polygon in front of what is on the positive side of a plane.
    fn fan(&mut self, corners: &[DVec4], plane: DVec4, kind: Kind) {
        let mut positions = [[0.0; 3]; 4];
        for (position, &corner) in positions.iter_mut().zip(corners) {
            let Some(clip) = self.clip_position(corner) else { return };
            *position = clip;
        }
        // A point that is nearer to a polygon than its tolerance is taken to be in front of it.
        let (plane, sign) = if self.how == How::Behind { (-plane, 1.0) } else { (plane, -1.0) };
        let lift = kind.tolerances().map(|t| sign * t);
        let plane = plane.as_vec4().to_array();
        let vertex = |position| Vertex { position, plane, lift, id: self.id };
        for i in 2..corners.len() {
            let [p, q, r] = [positions[0], positions[i - 1], positions[i]];
            // What is behind is counted with the opposite sign.
            let corners = if self.how == How::Behind { [p, r, q] } else { [p, q, r] };
            self.vertices.extend(corners.map(vertex));
        }
        *self.count += 1;
    }

    /// x, y and w of clip space up to a positive factor; `None` at the eye, where there is no picture.
    fn clip_position(&self, p: DVec4) -> Option<[f32; 3]> {
        let clip = self.view.projection * p;
        let clip = DVec3::new(clip.x, clip.y, clip.w);
        let size = clip.abs().max_element();
        (size.is_finite() && size > AT_EYE * p.length()).then(|| (clip / size).as_vec3().to_array())
    }
}

/// The direction of a × b; `None` where they are parallel to rounding.
fn unit_cross(a: DVec3, b: DVec3) -> Option<DVec3> {
    let cross = a.cross(b);
    let length = cross.length();
    (length > 1e-14 * a.length() * b.length() && length.is_finite()).then(|| cross / length)
}
