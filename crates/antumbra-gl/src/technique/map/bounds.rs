//! Where the casters are and what can be seen: what maps are fitted to.

use super::window::{Eye, Window};
use crate::screen::{View, seen_half_spaces};
use crate::technique::Pass;
use crate::technique::casters::{Caster, casters, planes};
use antumbra_math::{Plane, TriangleMesh};
use glam::{DMat4, DVec3, DVec4, Vec4Swizzles};
use std::collections::HashMap;

/// A ball and a box that hold a caster, world space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) center: DVec3,
    pub(super) radius: f64,
    /// Of a parallelepiped; by bit, x 1, y 2, z 4.
    corners: [DVec3; 8],
}

impl Bounds {
    fn new(caster: &Caster<'_>, (low, high): (DVec3, DVec3)) -> Self {
        let model = &caster.model;
        let ball = caster.mesh.bounding_sphere();
        let stretch = [model.x_axis, model.y_axis, model.z_axis].map(|axis| axis.truncate().length_squared());
        let corner = |i: usize| {
            let side = |bit: usize, low: f64, high: f64| if i >> bit & 1 == 1 { high } else { low };
            let p = DVec3::new(side(0, low.x, high.x), side(1, low.y, high.y), side(2, low.z, high.z));
            model.transform_point3(p)
        };
        let corners = std::array::from_fn(corner);
        // A matrix lengthens no vector by more than the root of the sum of its columns' squares; where they are at
        // right angles, by no more than the longest.
        let [x, y, z] = [model.x_axis, model.y_axis, model.z_axis].map(|axis| axis.truncate());
        let square = x.dot(y).abs() + y.dot(z).abs() + z.dot(x).abs() <= 1e-9 * stretch.iter().sum::<f64>();
        let stretch = if square { stretch.into_iter().fold(0.0, f64::max) } else { stretch.iter().sum() };
        Self { center: model.transform_point3(ball.center), radius: ball.radius * stretch.sqrt(), corners }
    }

    /// Where the caster is seen; `None` if it is behind.
    pub(super) fn window(&self, eye: &Eye) -> Option<Window> {
        eye.window_of_ball(self.center, self.radius)?.and(eye.window_of_points(&self.corners)?)
    }

    /// The nearest and the farthest depth along the light's way.
    pub(super) fn depths(&self, eye: &Eye) -> (f64, f64) {
        let middle = eye.see(self.center).z;
        let depths = self.corners.map(|p| eye.see(p).z);
        let (low, high) = depths.iter().fold((f64::MAX, f64::MIN), |(l, h), &z| (l.min(z), h.max(z)));
        (low.max(middle - self.radius), high.min(middle + self.radius))
    }

    /// A distance from `point` to the caster, or less.
    pub(super) fn distance(&self, point: DVec3) -> f64 {
        let to_ball = self.center.distance(point) - self.radius;
        let [first, x, y, z] = [0, 1, 2, 4].map(|i| self.corners[i]);
        let sides = [x - first, y - first, z - first];
        let skew = sides[0].dot(sides[1]).abs() + sides[1].dot(sides[2]).abs() + sides[2].dot(sides[0]).abs();
        let size: f64 = sides.iter().map(|s| s.length_squared()).sum();
        let to_box = if skew <= 1e-9 * size {
            let nearest = sides.iter().fold(first, |at, side| {
                let along = side.dot(point - first) / side.length_squared();
                at + *side * if along.is_finite() { along.clamp(0.0, 1.0) } else { 0.0 }
            });
            point.distance(nearest)
        } else {
            0.0
        };
        to_ball.max(to_box).max(0.0)
    }
}

/// Boxes round the meshes of recent frames, by their ids.
#[derive(Default)]
struct Boxes(HashMap<u64, (DVec3, DVec3, u32)>);

/// Frames that a box may go unused before it is forgotten, as for the meshes' buffers.
const KEPT_FRAMES: u32 = 60;

impl Boxes {
    fn begin_frame(&mut self) {
        self.0.retain(|_, (.., unused)| {
            *unused += 1;
            *unused <= KEPT_FRAMES
        });
    }

    fn of(&mut self, mesh: &TriangleMesh) -> (DVec3, DVec3) {
        let (low, high, unused) = self.0.entry(mesh.id()).or_insert_with(|| {
            let used = mesh.triangles().as_flattened().iter().map(|&i| mesh.positions()[i as usize]);
            let (low, high) =
                used.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), p| (l.min(p), h.max(p)));
            (low, high, 0)
        });
        *unused = 0;
        (*low, *high)
    }
}

/// What a frame's maps are fitted to; keeps its memory from frame to frame.
#[derive(Default)]
pub(super) struct Surroundings {
    boxes: Boxes,
    /// In the order of the casters.
    pub(super) casters: Vec<Bounds>,
    /// Planes that take light from something that is seen, if their light is on the right side.
    pub(super) planes: Vec<(Plane, u32)>,
    /// Each holds everything that is seen: a frustum cut off by a half-space. World space.
    pub(super) seen: Vec<[DVec3; 8]>,
    /// View space.
    pub(super) half_spaces: Vec<Plane>,
}

impl Surroundings {
    pub(super) fn begin(&mut self, pass: &Pass<'_>) {
        self.boxes.begin_frame();
        self.casters.clear();
        for caster in casters(&pass.frame) {
            let sides = self.boxes.of(caster.mesh);
            self.casters.push(Bounds::new(&caster, sides));
        }
        self.planes.clear();
        self.planes.extend(planes(&pass.frame).filter(|(p, _)| p.normal.is_finite() && p.offset.is_finite()));
        self.half_spaces.clear();
        seen_half_spaces(pass.frame.occluders, pass.frame.bounds, pass.view, &mut self.half_spaces);
        self.seen.clear();
        if let Some(rays) = corner_rays(pass.view) {
            let to_world = pass.view.view.inverse();
            let cut = self.half_spaces.iter().filter_map(|half_space| cut_off(&rays, half_space));
            self.seen.extend(cut.map(|points| points.map(|p| to_world.transform_point3(p))));
        }
    }
}

/// The directions through the corners of the picture, view space; `None` for a parallel camera.
fn corner_rays(view: &View) -> Option<[DVec3; 4]> {
    if !view.is_perspective() {
        return None;
    }
    let back: DMat4 = view.projection.inverse();
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    Some(corners.map(|(x, y)| {
        // Some depth or other between near and far, whichever half of clip space it is.
        let p = back * DVec4::new(x, y, 0.5, 1.0);
        let ray = p.xyz() / p.w;
        ray * -ray.z.signum()
    }))
}

/// The frustum from the eye to where it leaves a half-space; `None` if it never does.
fn cut_off(rays: &[DVec3; 4], half_space: &Plane) -> Option<[DVec3; 8]> {
    let mut points = [DVec3::ZERO; 8];
    for (i, ray) in rays.iter().enumerate() {
        let leaving = -half_space.normal.dot(*ray);
        if !(leaving > 1e-6 * ray.length()) {
            return None;
        }
        points[4 + i] = *ray * (half_space.height(DVec3::ZERO).max(0.0) / leaving);
    }
    Some(points)
}
