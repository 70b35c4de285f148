//! The parts of a batch's shadows on the receiver, packed for upload.

use super::{Options, receiver_frame};
use crate::input::{Encoding, Frame, Light};
use crate::masks::{BATCH_LIGHTS, Counts, GROUP_LIGHTS};
use crate::screen::{ProxyBuilder, TileGrid, View};
use crate::technique::polygons::{Vertex, push_polygon};
use antumbra_math::composite::{self, Part, PartShape, PlacedPart, SphereForm};
use antumbra_math::plane_shadow::{Bounds, PlaneFrame};
use antumbra_math::{Plane, Shape};
use glam::{DVec2, DVec3, Vec3, Vec4};

/// Corners of the polygon drawn round a disc, which is then 5 % larger.
const SIDES: usize = 8;

/// What is drawn of the parts.
pub(super) enum Drawn<'a> {
    /// The lights' visibility, in any order, and the tiles it is in.
    Visibility(&'a mut TileGrid),
    /// Their shade, as the pixels have it: light after light, and of one light the lightest first, so that
    /// the darkest is what stays; and the tiles they are in.
    Shade(Encoding, &'a mut TileGrid),
    /// Components of one light, in the papers' shade k and in any order, and the tiles they are in.
    Components(&'a mut TileGrid),
}

/// The plane that shadows fall on.
struct Ground {
    /// World space.
    frame: PlaneFrame,
    /// View space.
    frame_vs: PlaneFrame,
    /// The height of the eye, or the slope of the sight in parallel views: its sign is the side that is seen.
    eye: f64,
}

/// Packs batches; keeps its memory from one to the next.
#[derive(Default)]
pub(super) struct PartBuilder {
    ground: Option<Ground>,
    sphere: SphereForm,
    /// World space, with a ball around each.
    casters: Vec<(Shape, DVec3, f64)>,
    proxy: ProxyBuilder,
    /// A light's parts, each with the index of its caster.
    of_light: Vec<(Part, usize)>,
    /// Of each caster whether the light at hand has drawn it.
    is_drawn: Vec<bool>,
    /// The receiver's plane and sides in view space, as the shader reads them.
    pub(super) receiver: [Vec4; 5],
    /// What the parts' data texture is to hold.
    pub(super) texels: Vec<Vec4>,
    /// What the vertex buffer is to hold, group after group.
    pub(super) vertices: Vec<Vertex>,
    /// First vertex and number of vertices of each group of lights.
    pub(super) groups: [(i32, i32); BATCH_LIGHTS / GROUP_LIGHTS],
    /// Since the frame began.
    pub(super) counts: Counts,
}

impl PartBuilder {
    /// Takes the frame's receiver and occluders. A frame that the technique refuses draws nothing.
    pub(super) fn begin(&mut self, frame: &Frame<'_>, view: &View, options: &Options) {
        self.counts = Counts::default();
        self.sphere = options.sphere;
        self.casters.clear();
        self.ground = None;
        let Some(receiver) = frame.receivers.first() else { return };
        let Some((plane_frame, bounds)) = receiver_frame(receiver) else { return };
        let occluders = frame.occluders.iter().filter(|o| o.id == 0 || o.id != receiver.id);
        self.casters.extend(occluders.map(|o| {
            let (center, radius) = o.shape.bounding_sphere();
            (o.shape, center, radius)
        }));
        let (point, vector) = (|p| view.view.transform_point3(p), |v: DVec3| view.view.transform_vector3(v));
        let PlaneFrame { origin, u, v, normal } = plane_frame;
        let frame_vs =
            PlaneFrame { origin: point(origin), u: vector(u), v: vector(v), normal: vector(normal) };
        let eye = if view.is_perspective() { frame_vs.height(DVec3::ZERO) } else { frame_vs.normal.z };
        self.receiver = planes(&frame_vs, &bounds);
        self.ground = Some(Ground { frame: plane_frame, frame_vs, eye });
    }

    /// Packs the parts of up to [`BATCH_LIGHTS`] lights.
    pub(super) fn pack(&mut self, lights: &[Light], view: &View, mut drawn: Drawn<'_>) {
        self.texels.clear();
        self.vertices.clear();
        self.groups = Default::default();
        for (group, lights) in lights.chunks(GROUP_LIGHTS).take(self.groups.len()).enumerate() {
            let first = self.vertices.len();
            for (channel, light) in lights.iter().enumerate().filter(|(_, l)| l.intensity != Vec3::ZERO) {
                self.pack_light(channel, light, view, &mut drawn);
            }
            self.groups[group] = (first as i32, (self.vertices.len() - first) as i32);
        }
    }

    fn pack_light(&mut self, channel: usize, light: &Light, view: &View, drawn: &mut Drawn<'_>) {
        let Some(ground) = &self.ground else { return };
        self.counts.pairs += self.casters.len();
        // What faces away from the light has no shadow to show.
        let l = light.place.homogeneous();
        let plane = Plane::through(ground.frame.origin, ground.frame.normal);
        if !(plane.height_of(l) * ground.eye > 0.0) {
            return;
        }
        self.of_light.clear();
        self.is_drawn.clear();
        self.is_drawn.resize(self.casters.len(), false);
        for (i, (shape, center, radius)) in self.casters.iter().enumerate() {
            if light.may_reach(&light.place, *center, *radius)
                && let Ok(shadow) = composite::cast(shape, &light.place, &ground.frame, self.sphere)
            {
                self.of_light.extend(shadow.parts().map(|part| (*part, i)));
            }
        }
        if !matches!(drawn, Drawn::Visibility(_)) {
            // White is the papers' unshaded ground.
            self.of_light.retain(|(part, _)| part.shade < 1.0);
            self.of_light.sort_unstable_by(|(a, _), (b, _)| b.shade.total_cmp(&a.shade));
        }
        for (part, caster) in &self.of_light {
            let Some(placed) = PlacedPart::new(&part.shape, &ground.frame_vs) else { continue };
            let mut corners = [DVec3::ZERO; SIDES];
            let polygon =
                self.proxy.bound_flat(corners_of(&part.shape, &ground.frame_vs, &mut corners), view);
            if polygon.len() < 3 {
                continue;
            }
            self.counts.polygons += 1;
            self.counts.drawn += usize::from(!std::mem::replace(&mut self.is_drawn[*caster], true));
            let (grey, tiles) = match drawn {
                Drawn::Visibility(tiles) => (0.0, tiles),
                Drawn::Shade(encoding, tiles) => (grey(part.shade, *encoding), tiles),
                Drawn::Components(tiles) => (part.shade as f32, tiles),
            };
            tiles.touch(polygon);
            let first = self.texels.len();
            self.texels.extend(texels(&placed, grey));
            push_polygon(&mut self.vertices, polygon, view, (channel, first), 0);
        }
    }
}

/// A receiver's plane and its four sides, each as normal and offset, positive inside; a side at infinity is (0, 1).
fn planes(frame_vs: &PlaneFrame, bounds: &Bounds) -> [Vec4; 5] {
    let plane = |normal: DVec3, from_origin: f64| {
        let offset = from_origin - normal.dot(frame_vs.origin);
        if offset.is_finite() { normal.as_vec3().extend(offset as f32) } else { Vec4::W }
    };
    let PlaneFrame { u, v, normal, .. } = *frame_vs;
    [
        plane(normal, 0.0),
        plane(u, -bounds.min.x),
        plane(v, -bounds.min.y),
        plane(-u, bounds.max.x),
        plane(-v, bounds.max.y),
    ]
}

/// The corners of a convex polygon around a part, view space.
fn corners_of<'a>(shape: &PartShape, frame_vs: &PlaneFrame, corners: &'a mut [DVec3; SIDES]) -> &'a [DVec3] {
    match *shape {
        PartShape::Disc { center, radius } => {
            let step = std::f64::consts::TAU / SIDES as f64;
            let reach = radius / (0.5 * step).cos();
            for (i, corner) in corners.iter_mut().enumerate() {
                *corner = frame_vs.point(center + DVec2::from_angle(step * i as f64) * reach);
            }
            corners
        }
        PartShape::Triangle { vertices } => {
            corners[..3].copy_from_slice(&vertices.map(|p| frame_vs.point(p)));
            &corners[..3]
        }
    }
}

/// A part as the shader's `part_coverage` reads it.
fn texels(part: &PlacedPart<DVec3>, grey: f32) -> [Vec4; 4] {
    match part.to_f32() {
        PlacedPart::Disc { center, radius, power } => {
            [center.extend(radius), Vec4::X * power, Vec4::ZERO, Vec4::new(grey, 1.0, 0.0, 0.0)]
        }
        PlacedPart::Triangle { edges: [a, b, c] } => {
            let plane = |(normal, offset): (Vec3, f32)| normal.extend(offset);
            [plane(a), plane(b), plane(c), Vec4::X * grey]
        }
    }
}

/// The linear value of a displayed one: IEC 61966-2-1. The twin of that in `grey.glsl`.
pub(crate) fn linear_grey(k: f64) -> f64 {
    if k <= 0.04045 { k / 12.92 } else { ((k + 0.055) / 1.055).powf(2.4) }
}

/// The value of a pixel that is displayed as the grey 255 k.
fn grey(k: f64, encoding: Encoding) -> f32 {
    match encoding {
        Encoding::Linear => linear_grey(k) as f32,
        Encoding::Gamma(_) => k as f32,
    }
}
