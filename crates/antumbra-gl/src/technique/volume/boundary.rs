//! The silhouette of what casts a shadow, and a surface that spans it: where the shadow volume begins.

use crate::technique::casters::Caster;
use antumbra_math::Sphere;
use antumbra_math::mesh::{CountRule, Silhouette};
use glam::{DMat4, DVec3, DVec4};
use std::f64::consts::TAU;
use std::sync::LazyLock;

/// Corners that the circle of a ball's silhouette has at most: as many as a tessellated ball has around.
const CIRCLE: usize = 128;

/// And at least.
const COARSEST: usize = 16;

/// By how much chords may leave a circle in the picture, pixels.
const SAGITTA: f64 = 0.125;

/// How many corners, a power of two, a circle needs whose shadow has this radius in the picture, pixels.
fn corners_for(radius: f64) -> usize {
    let enough = |n: &usize| radius * (1.0 - (TAU / 2.0 / *n as f64).cos()) <= SAGITTA;
    let mut counts = std::iter::successors(Some(COARSEST), |n| (*n < CIRCLE).then_some(2 * n));
    counts.find(enough).unwrap_or(CIRCLE)
}

static DIRECTIONS: LazyLock<[(f64, f64); CIRCLE]> =
    LazyLock::new(|| std::array::from_fn(|i| (TAU * i as f64 / CIRCLE as f64).sin_cos()));

/// The near end of a shadow volume, view space. Keeps its memory from one to the next.
#[derive(Default)]
pub(super) struct Boundary {
    /// Directed edges, the volume's outward sides to the right seen from the light.
    pub(super) edges: Vec<[DVec3; 2]>,
    /// Triangles, counter-clockwise seen from the light.
    caps: Vec<[DVec3; 3]>,
    /// In place of `caps`: the corner that all have in common, one triangle for each edge.
    hub: Option<DVec3>,
    silhouette: Silhouette,
    points: Vec<DVec3>,
}

/// What the near cap has to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cap {
    /// Any surface inside the caster, which is convex, or flat, and not looked into.
    Inside,
    /// The triangles that look towards the light.
    Faces,
}

impl Boundary {
    /// Calls `each` with the near cap's triangles.
    pub(super) fn caps(&self, mut each: impl FnMut([DVec3; 3])) {
        match self.hub {
            Some(hub) => self.edges.iter().for_each(|&[a, b]| each([a, b, hub])),
            None => self.caps.iter().for_each(|&cap| each(cap)),
        }
    }

    /// A ball's: the circle where the light's rays touch it, with as many corners as a shadow of `pixels` across
    /// needs. False if the light is not outside.
    pub(super) fn of_ball(&mut self, ball: &Sphere, light: DVec4, pixels: f64) -> bool {
        self.clear();
        let to_light = light.truncate() - ball.center * light.w;
        let distance = to_light.length();
        if !(distance.is_finite() && distance > ball.radius * light.w) {
            return false;
        }
        let axis = to_light / distance;
        let lift = if light.w == 0.0 { 0.0 } else { ball.radius * (ball.radius / distance) };
        let radius = (ball.radius * ball.radius - lift * lift).max(0.0).sqrt();
        let center = ball.center + axis * lift;
        let u = axis.any_orthonormal_vector();
        let v = axis.cross(u);
        let directions = DIRECTIONS.iter().step_by(CIRCLE / corners_for(0.5 * pixels));
        self.points.extend(directions.map(|&(sin, cos)| center + (u * cos + v * sin) * radius));
        let next = self.points.iter().cycle().skip(1);
        self.edges.extend(self.points.iter().zip(next).map(|(&a, &b)| [a, b]));
        self.hub = Some(center);
        true
    }

    /// A mesh's; `to_view` is its model matrix, then the view's.
    pub(super) fn of_mesh(&mut self, caster: &Caster<'_>, to_view: &DMat4, light: DVec4, cap: Cap) {
        self.clear();
        self.hub = None;
        // An affine map takes silhouettes to silhouettes.
        let light_ms = to_view.inverse() * light;
        caster.mesh.silhouette(light_ms, &mut self.silhouette);
        let Silhouette { edges, caps, rule, .. } = &self.silhouette;
        let positions = caster.mesh.positions();
        let at = |i: u32| to_view.transform_point3(positions[i as usize]);
        let mirrored = to_view.determinant() < 0.0;
        let turned = |[a, b]: [DVec3; 2]| if mirrored { [b, a] } else { [a, b] };
        self.edges.extend(edges.iter().map(|edge| turned(edge.map(at))));
        // With the light inside a solid, all of its faces count, and nothing inside spans their border.
        let holds_light = *rule == CountRule::EveryFace && caster.mesh.is_closed();
        if cap == Cap::Inside && !holds_light {
            let sum: DVec3 = self.edges.iter().map(|[a, _]| *a).sum();
            self.hub = Some(sum / self.edges.len().max(1) as f64);
        } else {
            let turned = |[a, b, c]: [DVec3; 3]| if mirrored { [a, c, b] } else { [a, b, c] };
            self.caps.extend(caps.iter().map(|cap| turned(cap.map(at))));
        }
    }

    fn clear(&mut self) {
        self.edges.clear();
        self.caps.clear();
        self.points.clear();
    }
}
