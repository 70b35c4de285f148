//! The edges of shadows on planes and rectangles.
//!
//! Closed forms where the library has them: every shape of its own under lights without area, and balls under sphere
//! lights. For other convex occluders, and under other area lights, points of the exact edge from the planes that touch
//! light and occluder, see `body.rs`; no edge is approximated by anything but the chords between its points.

use std::f64::consts::FRAC_PI_2;

use antumbra::Area;
use antumbra::math::soft::PenumbraOutline;
use antumbra::math::{Light as Place, PlaneShadow, Shape, Sphere};
use glam::{DVec2, DVec3};

use super::body::{Body, Source, Standing, Touch};
use super::path::{Path, common, left_of};
use super::silhouette::{projected, silhouette};
use super::{Casting, Drawing, LineKind, Pair, PlanarReceiver, Situation};

/// Points of an edge where it bends, at least.
const POINTS: usize = 160;

/// Two corners closer than this fraction of the scene's size are one.
const SAME: f64 = 1e-9;

impl Situation<'_> {
    /// Adds the edges of the shadow of a primitive from a light, on every planar receiver but itself.
    ///
    /// - Under a light without area [`LineKind::HardEdge`]; for occluders that are not convex, and for those that are
    ///   meshes to the library and reach through the receiver or as high as the light, [`LineKind::Silhouette`].
    /// - Under an area light [`LineKind::Penumbra`], and [`LineKind::Umbra`] or [`LineKind::Antumbra`] where that is known:
    ///   the umbra for balls under sphere lights, for flat polygons, and for convex occluders under rectangle lights; the
    ///   antumbra for balls under sphere lights. For what is not known there is a note.
    /// - On infinite planes within four radii of the scene. Where the light does not shine, beyond a spot's cone or behind
    ///   a flat light, edges are left out. Where another occluder hides the light first they are drawn all the same, and
    ///   so are those beneath the receiver of a light that shines on it from there: its other side receives.
    ///
    /// Nothing for a light or a primitive that does not exist, or that casts no shadow.
    pub(crate) fn outlines(&self, light: usize, primitive: usize, drawing: &mut Drawing) {
        let Some(pair) = self.pair(light, primitive) else { return };
        for receiver in self.receivers_of(primitive) {
            if pair.is_hard() {
                self.hard_edge(&pair, receiver, drawing);
            } else if let Some(outline) =
                pair.balls().and_then(|(light, ball)| PenumbraOutline::new(&light, &ball, &receiver.frame))
            {
                let zones = [
                    (outline.penumbra(), LineKind::Penumbra),
                    (outline.umbra(), LineKind::Umbra),
                    (outline.antumbra(), LineKind::Antumbra),
                ];
                for (zone, kind) in zones {
                    receiver.draw_edge(zone, kind, POINTS, &pair, drawing);
                }
            } else {
                self.soft_edges(&pair, receiver, drawing);
            }
        }
    }

    fn hard_edge(&self, pair: &Pair<'_>, receiver: &PlanarReceiver, drawing: &mut Drawing) {
        if let Casting::Shape(shape) = pair.casting {
            let shadow = PlaneShadow::cast(&shape, &pair.light.place, &receiver.frame);
            receiver.draw_edge(&shadow, LineKind::HardEdge, POINTS, pair, drawing);
            return;
        }
        let standing = Body::of(pair.primitive)
            .map(|body| Source::of(pair.light).edge(&body, &receiver.frame, &receiver.bounds, POINTS));
        match standing {
            Some(Standing::Apart) => {}
            Some(Standing::Between(touches)) => {
                self.draw_touches(&touches, LineKind::HardEdge, pair, receiver, drawing);
            }
            Some(Standing::Through) | None => {
                for path in silhouette(self, pair) {
                    for shadow in projected(&path, pair.light.place.homogeneous(), &receiver.frame) {
                        for part in shadow.within(&receiver.bounds) {
                            receiver.draw(&part, LineKind::Silhouette, pair, drawing);
                        }
                    }
                }
            }
        }
    }

    fn soft_edges(&self, pair: &Pair<'_>, receiver: &PlanarReceiver, drawing: &mut Drawing) {
        let names = || {
            let (light, occluder) = (self.light_name(pair.light_index), self.name(pair.primitive_index));
            let receiver = self.name(receiver.primitive);
            format!("\"{occluder}\" under light \"{light}\" on \"{receiver}\"")
        };
        let Some(body) = Body::of(pair.primitive) else {
            drawing.note(pair, format!("{}: no penumbra drawn, the occluder is not convex", names()));
            return;
        };
        let source = Source::of(pair.light);
        let touches = match source.edge(&body, &receiver.frame, &receiver.bounds, POINTS) {
            Standing::Apart => return,
            Standing::Through => {
                let text =
                    "no penumbra drawn, something reaches through the receiver or as high as the light";
                drawing.note(pair, format!("{}: {text}", names()));
                return;
            }
            Standing::Between(touches) => touches,
        };
        self.draw_touches(&touches, LineKind::Penumbra, pair, receiver, drawing);
        match umbra(pair, &source, &body, receiver) {
            Some(polygon) if polygon.len() >= 3 => {
                receiver.draw_polygon(self.distinct(polygon), LineKind::Umbra, pair, drawing);
            }
            Some(_) => drawing.note(
                pair,
                format!("{}: no umbra here; where the antumbra lies, if there is one, is not drawn", names()),
            ),
            None => drawing.note(
                pair,
                format!("{}: the penumbra's inner edge is not drawn, only its outer one", names()),
            ),
        }
    }

    fn draw_touches(
        &self,
        touches: &[Touch],
        kind: LineKind,
        pair: &Pair<'_>,
        receiver: &PlanarReceiver,
        drawing: &mut Drawing,
    ) {
        let polygon = self.distinct(touches.iter().map(|touch| touch.end).collect());
        if polygon.len() < 2 {
            return;
        }
        for part in Path::closed(polygon).within(&receiver.bounds) {
            receiver.draw(&part, kind, pair, drawing);
        }
    }

    /// The corners that are apart.
    fn distinct(&self, mut polygon: Vec<DVec2>) -> Vec<DVec2> {
        let near = SAME * self.radius;
        polygon.dedup_by(|a, b| a.distance(*b) <= near);
        while polygon.len() > 1 && polygon[0].distance(polygon[polygon.len() - 1]) <= near {
            polygon.pop();
        }
        polygon
    }
}

impl Pair<'_> {
    /// The two balls, if the light and the occluder are.
    pub(super) fn balls(&self) -> Option<(Sphere, Sphere)> {
        match (self.light.place, self.light.area, self.casting) {
            (Place::Point { position }, Area::Sphere { radius }, Casting::Shape(Shape::Sphere(ball))) => {
                Some((Sphere { center: position, radius }, ball))
            }
            _ => None,
        }
    }
}

/// The umbra of an occluder that stands between light and receiver, within the receiver's bounds, counterclockwise;
/// without corners where there is none, and `None` where it is not known.
///
/// A convex occluder hides a rectangle from where it hides its four corners. A flat polygon hides anything from where
/// it is on the inner side of each plane through a side of the polygon that touches it on that side.
fn umbra(pair: &Pair<'_>, source: &Source, body: &Body, receiver: &PlanarReceiver) -> Option<Vec<DVec2>> {
    let Source::Body(light) = source else { return None };
    let window = receiver.bounds.corners().to_vec();
    if let Some(corners) = light.corners() {
        let mut polygon = window.clone();
        for &position in corners {
            let shadow = match pair.casting {
                Casting::Shape(shape) => {
                    let shadow = PlaneShadow::cast(&shape, &Place::Point { position }, &receiver.frame);
                    let outline = shadow.outline(POINTS, &receiver.bounds);
                    if shadow.area() > 0.0 { outline } else { Vec::new() }
                }
                _ => {
                    let source = Source::Body(Body::Points(vec![position]));
                    match source.edge(body, &receiver.frame, &receiver.bounds, POINTS) {
                        Standing::Between(touches) => touches.iter().map(|touch| touch.end).collect(),
                        Standing::Apart => Vec::new(),
                        Standing::Through => return None,
                    }
                }
            };
            polygon = if shadow.len() < 3 { Vec::new() } else { common(polygon, &shadow) };
        }
        return Some(polygon);
    }
    let corners = match pair.casting {
        Casting::Shape(Shape::Triangle(triangle)) => triangle.vertices.to_vec(),
        Casting::Shape(Shape::Rectangle(rectangle)) => rectangle.corners().to_vec(),
        _ => return None,
    };
    let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or_zero();
    let facing = |n: DVec3| n.dot(light.support(-n) - middle) > 0.0;
    let up = [normal, -normal].into_iter().find(|n| facing(*n))?;
    let mut polygon = within_half_space(window, receiver, up, middle);
    for (index, &a) in corners.iter().enumerate() {
        let b = corners[(index + 1) % corners.len()];
        let out = (b - a).cross(up).normalize_or_zero();
        let out = if out.dot(middle - a) > 0.0 { -out } else { out };
        let n = |angle: f64| out * angle.cos() + up * angle.sin();
        let (mut clear, mut over) = (-FRAC_PI_2, FRAC_PI_2);
        for _ in 0..56 {
            let half = 0.5 * (clear + over);
            if n(half).dot(light.support(n(half)) - a) > 0.0 {
                over = half;
            } else {
                clear = half;
            }
        }
        polygon = within_half_space(polygon, receiver, n(clear), a);
    }
    Some(polygon)
}

/// The part of a polygon on the receiver where n · (x - a) is not above zero.
fn within_half_space(polygon: Vec<DVec2>, receiver: &PlanarReceiver, n: DVec3, a: DVec3) -> Vec<DVec2> {
    let frame = &receiver.frame;
    let slope = DVec2::new(frame.u.dot(n), frame.v.dot(n));
    let value = n.dot(frame.origin - a);
    if slope.length() <= 1e-12 * n.length() {
        return if value <= 0.0 { polygon } else { Vec::new() };
    }
    // The line, with the half-plane where the function falls on its left.
    let foot = -slope * (value / slope.length_squared());
    left_of(&polygon, foot, foot + slope.perp())
}
