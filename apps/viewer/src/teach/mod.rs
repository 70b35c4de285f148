//! What shadows are made of, as things to draw and to say: edges, tangent rays, conics and shadow volumes of one moment
//! of a scene. Pure geometry; nothing here draws.
//!
//! Everything is total: a pose that has no shadow, or whose shadow has no such line, gives no line, and no line has a
//! point that is not finite.

mod body;
pub(crate) mod conics;
pub(crate) mod outlines;
mod path;
pub(crate) mod rays;
mod silhouette;
#[cfg(test)]
mod tests;
pub(crate) mod volumes;

use antumbra::math::plane_shadow::Bounds;
use antumbra::math::{PlaneFrame, Shape};
use antumbra::{Area, Light, MeshOccluder, ReceiverShape};
use antumbra_host::Described;
use antumbra_scene::{Moment, Primitive, Scene};
use glam::DVec3;

/// An infinite plane counts as far as this many times the scene's radius from the scene's middle.
const WINDOW: f64 = 4.0;

/// What a line shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum LineKind {
    /// The edge of the shadow under a light without area.
    HardEdge,
    /// The shadow of a mesh's silhouette under a light without area. The shadow's edge is part of it, and so are the
    /// mesh's inner silhouettes; where the mesh passes through the receiver the edge is also its section, which is not
    /// drawn.
    Silhouette,
    /// The penumbra's outer edge: outside it all of the light is seen.
    Penumbra,
    /// The umbra's edge: inside it nothing of the light is seen.
    Umbra,
    /// The antumbra's edge: inside it the whole occluder is seen before the light.
    Antumbra,
    /// From a light without area by the occluder's silhouette to the shadow's edge: three points, the middle one where
    /// it touches.
    TangentRay,
    /// The same from where it touches the light, to the penumbra's outer edge: light and occluder lie on different sides
    /// of it.
    PenumbraRay,
    /// The same to the umbra's or the antumbra's edge: light and occluder lie on one side of it.
    UmbraRay,
    /// A side of a shadow volume: a quadrilateral, its first two points on the silhouette.
    VolumeSide,
    /// The outline of a shadow volume's near cap: the silhouette.
    NearCap,
    /// The outline of its far cap.
    FarCap,
}

/// Straight pieces through points, all finite, at least two of them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Line {
    /// World space, metres.
    pub(crate) points: Vec<DVec3>,
    /// Whether the last point is joined to the first, which is not repeated.
    pub(crate) closed: bool,
    pub(crate) kind: LineKind,
    /// Index in [`Moment::lights`].
    pub(crate) light: usize,
    /// What casts the shadow: index in [`Moment::primitives`].
    pub(crate) primitive: usize,
}

/// What is not drawn, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Note {
    /// Index in [`Moment::lights`].
    pub(crate) light: usize,
    /// Index in [`Moment::primitives`].
    pub(crate) primitive: usize,
    /// For people, names included.
    pub(crate) text: String,
}

/// What one or more of the functions have to show. Functions add to it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Drawing {
    pub(crate) lines: Vec<Line>,
    pub(crate) notes: Vec<Note>,
}

/// Numbers of one shadow, written for people.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Fact {
    /// Of what.
    pub(crate) title: String,
    /// Labels and values.
    pub(crate) lines: Vec<(String, String)>,
}

/// A moment of a scene, with what its shadows fall on.
pub(crate) struct Situation<'a> {
    scene: &'a Scene,
    moment: &'a Moment,
    described: &'a Described,
    /// By primitive.
    casting: Vec<Casting>,
    receivers: Vec<PlanarReceiver>,
    /// Metres; of what has bounds, and at least a centimetre.
    radius: f64,
}

/// How a primitive casts shadows.
#[derive(Clone, Copy, Debug)]
enum Casting {
    Nothing,
    /// A shape with a closed form.
    Shape(Shape),
    /// An index in [`Described::meshes`].
    Mesh(usize),
}

/// A plane or a rectangle that receives shadows.
#[derive(Clone, Copy, Debug)]
struct PlanarReceiver {
    primitive: usize,
    frame: PlaneFrame,
    /// The rectangle, or a window of the plane around the scene. Finite.
    bounds: Bounds,
}

/// A light and what casts its shadow.
#[derive(Clone, Copy)]
struct Pair<'a> {
    light: &'a Light,
    primitive: &'a Primitive,
    casting: Casting,
    light_index: usize,
    primitive_index: usize,
}

impl<'a> Situation<'a> {
    /// `described` is that of `scene` at `moment`.
    pub(crate) fn new(scene: &'a Scene, moment: &'a Moment, described: &'a Described) -> Self {
        let boxes = moment.primitives.iter().filter_map(Primitive::bounds);
        let boxes = boxes.filter(|(low, high)| low.is_finite() && high.is_finite());
        let (low, high) =
            boxes.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap_or((-DVec3::ONE, DVec3::ONE));
        let (middle, radius) = (0.5 * (low + high), (0.5 * (high - low)).length().max(0.01));
        let receivers = described.receivers.iter().filter_map(|receiver| {
            let (frame, bounds) = match receiver.shape {
                ReceiverShape::Plane(plane) => {
                    let frame = PlaneFrame::of_plane(&plane)?;
                    (frame, Bounds::around(frame.coordinates(middle), WINDOW * radius))
                }
                ReceiverShape::Rectangle(rectangle) => PlaneFrame::of_rectangle(&rectangle)?,
                _ => return None,
            };
            let primitive = (receiver.id as usize).checked_sub(1)?;
            bounds.is_finite().then_some(PlanarReceiver { primitive, frame, bounds })
        });
        let mut casting = vec![Casting::Nothing; moment.primitives.len()];
        let mut set = |id: u32, how| {
            if let Some(slot) = (id as usize).checked_sub(1).and_then(|index| casting.get_mut(index)) {
                *slot = how;
            }
        };
        for occluder in &described.occluders {
            set(occluder.id, Casting::Shape(occluder.shape));
        }
        for (index, mesh) in described.meshes.iter().enumerate() {
            set(mesh.id, Casting::Mesh(index));
        }
        Self { scene, moment, described, receivers: receivers.collect(), casting, radius }
    }

    /// Every light with every primitive that casts shadows, as indices in [`Moment::lights`] and
    /// [`Moment::primitives`].
    pub(crate) fn pairs(&self) -> impl Iterator<Item = (usize, usize)> {
        let casters = |light: usize| {
            let casting = self.casting.iter().enumerate();
            casting.filter(|(_, how)| !matches!(how, Casting::Nothing)).map(move |(index, _)| (light, index))
        };
        (0..self.described.lights.len()).flat_map(casters)
    }

    /// `None` for a number that does not exist, and for what casts no shadow.
    fn pair(&self, light_index: usize, primitive_index: usize) -> Option<Pair<'a>> {
        let light = self.described.lights.get(light_index)?;
        let primitive = self.moment.primitives.get(primitive_index)?;
        let casting = *self.casting.get(primitive_index)?;
        let casts = !matches!(casting, Casting::Nothing);
        casts.then_some(Pair { light, primitive, casting, light_index, primitive_index })
    }

    /// The planar receivers that a primitive's shadow may fall on: all but itself.
    fn receivers_of(&self, primitive: usize) -> impl Iterator<Item = &PlanarReceiver> {
        self.receivers.iter().filter(move |receiver| receiver.primitive != primitive)
    }

    fn mesh(&self, index: usize) -> Option<&'a MeshOccluder> {
        self.described.meshes.get(index)
    }

    /// The name of a primitive's object; with the part's number if it has several.
    fn name(&self, primitive: usize) -> String {
        let Some(primitive) = self.moment.primitives.get(primitive) else { return String::new() };
        let Some(object) = self.scene.objects.get(primitive.object) else { return String::new() };
        if object.parts.len() > 1 {
            format!("{}, part {}", object.name, primitive.part + 1)
        } else {
            object.name.clone()
        }
    }

    fn light_name(&self, light: usize) -> &str {
        self.moment.lights.get(light).map_or("", |light| &light.name)
    }
}

impl Pair<'_> {
    /// Above zero where the light shines at all: inside a spot's cone, before a flat light.
    fn shines_on(&self, point: DVec3) -> f64 {
        use antumbra::math::Light as Place;
        let (origin, axis, cosine) = match (self.light.place, self.light.area) {
            (Place::Spot { position, direction, outer_angle }, _) => (position, direction, outer_angle.cos()),
            (Place::Point { position }, Area::Disc { direction, .. } | Area::Rectangle { direction, .. }) => {
                (position, direction, 0.0)
            }
            _ => return 1.0,
        };
        let to = point - origin;
        to.dot(axis) - cosine * to.length()
    }

    fn is_hard(&self) -> bool {
        matches!(self.light.area, Area::None)
    }
}

impl Drawing {
    /// Leaves out what has fewer than two points or one that is not finite.
    fn add(&mut self, pair: &Pair<'_>, kind: LineKind, points: Vec<DVec3>, closed: bool) {
        if points.len() >= 2 && points.iter().all(|p| p.is_finite()) {
            let (light, primitive) = (pair.light_index, pair.primitive_index);
            self.lines.push(Line { points, closed, kind, light, primitive });
        }
    }

    fn note(&mut self, pair: &Pair<'_>, text: String) {
        let note = Note { light: pair.light_index, primitive: pair.primitive_index, text };
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }
}
