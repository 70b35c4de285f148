//! Rays that graze an occluder on their way from a light to the edge of its shadow.

use std::f64::consts::TAU;

use antumbra::math::{Light as Place, Shape, Sphere};
use glam::{DVec3, DVec4};

use super::body::{Body, Source, Standing, Touch};
use super::silhouette::silhouette;
use super::{Casting, Drawing, LineKind, Pair, PlanarReceiver, Situation};

/// Points of an occluder's contour among which rays are chosen.
const CONTOUR: usize = 256;

/// A stretch of the contour longer than this share of all of it is straight: a side of a polygon, a line on a cone.
const STRAIGHT: f64 = 4.0 / CONTOUR as f64;

/// A ray towards a directional light is drawn for so many radii of the scene.
const FROM_AFAR: f64 = 2.0;

/// Heights within this fraction of the coordinates are rounding.
const RESTING: f64 = 1e-12;

/// From which side of the occluder an area light's tangents come.
#[derive(Clone, Copy, PartialEq)]
enum Tangent {
    /// Between the two: to the penumbra's outer edge.
    Inner,
    /// Around the two: to the umbra or the antumbra.
    Outer,
}

impl Situation<'_> {
    /// Adds `count` rays around a primitive from a light to each planar receiver but itself, fewer where rays miss the
    /// receiver (on infinite planes a window of four scene radii) or end where the light does not shine, and where
    /// several would be the same, as at a corner.
    ///
    /// [`LineKind::TangentRay`] from a light without area, [`LineKind::PenumbraRay`] from an area light, and
    /// [`LineKind::UmbraRay`] as well from a sphere light by a ball. From a directional light they start two scene radii
    /// away. What else stands in a ray's way is not looked at; of meshes that are not convex this may be the mesh. Discs,
    /// cones, triangles and rectangles that reach through the receiver or as high as the light have none, and under area
    /// lights neither has any other shape but balls.
    pub(crate) fn tangent_rays(&self, light: usize, primitive: usize, count: usize, drawing: &mut Drawing) {
        let Some(pair) = self.pair(light, primitive) else { return };
        let count = count.min(CONTOUR);
        if let Some((light, ball)) = pair.balls() {
            let axis = light.center - ball.center;
            for (tangent, kind) in
                [(Tangent::Inner, LineKind::PenumbraRay), (Tangent::Outer, LineKind::UmbraRay)]
            {
                let rays = ball_rays(&ball, axis, light.radius, tangent, count);
                self.draw_rays(&rays, kind, &pair, drawing);
            }
            return;
        }
        if let (Casting::Shape(Shape::Sphere(ball)), true) = (pair.casting, pair.is_hard()) {
            let rays = match pair.light.place {
                Place::Directional { direction } => self.parallel_rays(&ball, -direction, count),
                Place::Point { position } | Place::Spot { position, .. } => {
                    ball_rays(&ball, position - ball.center, 0.0, Tangent::Inner, count)
                }
            };
            self.draw_rays(&rays, LineKind::TangentRay, &pair, drawing);
            return;
        }
        let (source, body) = (Source::of(pair.light), Body::of(pair.primitive));
        let is_mesh = matches!(pair.casting, Casting::Mesh(_));
        let contour =
            if is_mesh && pair.is_hard() { silhouette_points(self, &pair, count) } else { Vec::new() };
        for receiver in self.receivers_of(primitive) {
            let directions = if pair.is_hard() { CONTOUR } else { count };
            let standing =
                body.as_ref().map(|body| source.edge(body, &receiver.frame, &receiver.bounds, directions));
            match (standing, pair.is_hard()) {
                (Some(Standing::Between(touches)), true) => {
                    for p in along_contour(&touches, count) {
                        self.draw_hard_ray(p, receiver, &pair, drawing);
                    }
                }
                (Some(Standing::Between(touches)), false) => {
                    let mut last = None;
                    for Touch { on_light, on_body, .. } in touches {
                        if let Some(from) = on_light
                            && last != Some((from, on_body))
                        {
                            self.draw_ray(from, on_body, LineKind::PenumbraRay, receiver, &pair, drawing);
                            last = Some((from, on_body));
                        }
                    }
                }
                (Some(Standing::Through) | None, true) => {
                    for &p in &contour {
                        self.draw_hard_ray(p, receiver, &pair, drawing);
                    }
                }
                _ => {}
            }
        }
    }

    fn draw_hard_ray(&self, by: DVec3, receiver: &PlanarReceiver, pair: &Pair<'_>, drawing: &mut Drawing) {
        let from = self.start(pair.light.place.homogeneous(), by);
        self.draw_ray(from, by, LineKind::TangentRay, receiver, pair, drawing);
    }

    /// From where to draw the ray that touches at `p`.
    fn start(&self, light: DVec4, p: DVec3) -> DVec3 {
        if light.w == 0.0 {
            p + light.truncate().normalize_or_zero() * (FROM_AFAR * self.radius)
        } else {
            light.truncate()
        }
    }

    fn parallel_rays(&self, ball: &Sphere, to_light: DVec3, count: usize) -> Vec<(DVec3, DVec3)> {
        let Some(axis) = to_light.try_normalize() else { return Vec::new() };
        let touching = circle(axis, 0.0, count).map(|n| ball.center + n * ball.radius);
        touching.map(|p| (self.start(axis.extend(0.0), p), p)).collect()
    }

    fn draw_rays(&self, rays: &[(DVec3, DVec3)], kind: LineKind, pair: &Pair<'_>, drawing: &mut Drawing) {
        for receiver in self.receivers_of(pair.primitive_index) {
            for &(from, by) in rays {
                self.draw_ray(from, by, kind, receiver, pair, drawing);
            }
        }
    }

    /// Adds the ray from a light by a point to the receiver, if it gets there.
    fn draw_ray(
        &self,
        from: DVec3,
        by: DVec3,
        kind: LineKind,
        receiver: &PlanarReceiver,
        pair: &Pair<'_>,
        drawing: &mut Drawing,
    ) {
        let frame = &receiver.frame;
        let (mut h, mut k) = (frame.height(from), frame.height(by));
        if let Place::Directional { .. } = pair.light.place {
            // The start is no more than a place to draw from, perhaps beneath the receiver.
            let rise = frame.normal.dot(from - by);
            if rise * k >= 0.0 {
                h = k + rise;
            }
        }
        if h < 0.0 {
            (h, k) = (-h, -k);
        }
        let slack = RESTING * (from.length() + by.length() + frame.origin.length());
        if !(k >= -slack && h > k.max(slack)) {
            return;
        }
        let end = from + (by - from) * (h / (h - k));
        if receiver.bounds.contains(frame.coordinates(end)) && pair.shines_on(end) > 0.0 {
            drawing.add(pair, kind, vec![from, by, end], false);
        }
    }
}

/// `count` points of the silhouette of the caster's triangles.
fn silhouette_points(situation: &Situation<'_>, pair: &Pair<'_>, count: usize) -> Vec<DVec3> {
    let points: Vec<DVec3> = silhouette(situation, pair).into_iter().flat_map(|path| path.points).collect();
    (0..count.min(points.len())).map(|index| points[index * points.len() / count.min(points.len())]).collect()
}

/// Unit vectors around `axis`, evenly, whose product with it is `cosine`.
fn circle(axis: DVec3, cosine: f64, count: usize) -> impl Iterator<Item = DVec3> {
    let (u, v) = axis.any_orthonormal_pair();
    let sine = ((1.0 - cosine) * (1.0 + cosine)).max(0.0).sqrt();
    (0..count).map(move |index| {
        let (sin, cos) = (index as f64 * TAU / count as f64).sin_cos();
        axis * cosine + (u * cos + v * sin) * sine
    })
}

/// The common tangents of a ball and a glowing ball at `to_light` from it: where they touch the light and the ball.
///
/// With n the unit normal where a tangent touches the ball, C + r n and L - R n of an inner tangent, L + R n of an outer
/// one, both are in the plane across n, so n · (L - C) is r + R or r - R.
fn ball_rays(
    ball: &Sphere,
    to_light: DVec3,
    radius: f64,
    tangent: Tangent,
    count: usize,
) -> Vec<(DVec3, DVec3)> {
    let on_light = if tangent == Tangent::Inner { -radius } else { radius };
    let distance = to_light.length();
    let cosine = (ball.radius - on_light) / distance;
    let apart = distance > ball.radius + radius && distance.is_finite();
    if !(apart && cosine.abs() < 1.0 && ball.radius > 0.0) {
        return Vec::new();
    }
    let ends = |n: DVec3| (ball.center + to_light + n * on_light, ball.center + n * ball.radius);
    circle(to_light / distance, cosine, count).map(ends).collect()
}

/// `count` points of the closed contour through the touching points, evenly by length: on its straight stretches anywhere,
/// where it bends at the nearest touching point.
fn along_contour(touches: &[Touch], count: usize) -> Vec<DVec3> {
    let next = touches.iter().cycle().skip(1);
    let pieces: Vec<(DVec3, DVec3, f64)> = touches
        .iter()
        .zip(next)
        .map(|(a, b)| (a.on_body, b.on_body, a.on_body.distance(b.on_body)))
        .filter(|piece| piece.2 > 0.0)
        .collect();
    let total: f64 = pieces.iter().map(|piece| piece.2).sum();
    let mut points: Vec<DVec3> = Vec::with_capacity(count);
    let (mut index, mut before) = (0, 0.0);
    for step in 0..count {
        let at = total * step as f64 / count as f64;
        while index + 1 < pieces.len() && before + pieces[index].2 <= at {
            before += pieces[index].2;
            index += 1;
        }
        let Some(&(a, b, length)) = pieces.get(index) else { break };
        let t = (at - before) / length;
        let point = if length > STRAIGHT * total {
            a.lerp(b, t)
        } else if t < 0.5 {
            a
        } else {
            b
        };
        if points.last() != Some(&point) {
            points.push(point);
        }
    }
    points
}
