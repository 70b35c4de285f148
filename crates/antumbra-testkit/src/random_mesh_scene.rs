//! Random scenes of triangles, the same for the same seed: meshes, closed and open, and flat shapes that
//! cast on a floor, walls and each other.
//!
//! Whatever is curved is a mesh here, so that the reference traces the very triangles that OpenGL casts
//! from and draws. Things pierce each other and the receivers, and stand on the floor; lights shine from
//! high, from low and from behind. Only a camera or a light inside of something is ruled out.

use core::f64::consts::TAU;
use core::ops::RangeInclusive;
use std::sync::Arc;

use antumbra_math::{MeshError, TriangleMesh};
use antumbra_scene::{Camera, Image, Light, LightKind, Mesh, Object, Pose, Scene, Shape};
use fastrand::Rng;
use glam::{DQuat, DVec3};

use crate::random_scene::{Random, apart, object, random_tilt};

/// What random scenes of meshes are made of.
#[derive(Clone, Debug, PartialEq)]
pub struct RandomMeshScene {
    /// How many walls there are beside the floor: 0 to 2.
    pub walls: RangeInclusive<usize>,
    /// How many things cast shadows, besides walls.
    pub casters: RangeInclusive<usize>,
    /// How many lights: point, spot and directional.
    pub lights: RangeInclusive<usize>,
    /// Whether shadows fall on what casts them too, or on floor and walls alone.
    pub casters_receive: bool,
    /// Pixels across and down.
    pub size: (u32, u32),
}

impl Default for RandomMeshScene {
    /// 0 to 2 walls, 3 to 8 casters that receive shadows, 1 to 4 lights, 480 by 270.
    fn default() -> Self {
        Self { walls: 0..=2, casters: 3..=8, lights: 1..=4, casters_receive: true, size: (480, 270) }
    }
}

/// Casters are in a ball of this radius round the origin, metres; the camera is outside.
const REACH: f64 = 4.4;

/// The scene of a seed. The floor is first, then come the walls, then the casters. Nothing moves. More
/// than two walls are taken as two.
///
/// The floor is a plane or a rectangle, a wall a rectangle; the floor casts nothing, and one wall in four
/// does. Total and deterministic: the generator is wyrand as `fastrand` 2 implements it.
pub fn random_mesh_scene(seed: u64, options: &RandomMeshScene) -> Scene {
    let mut random = Random(Rng::with_seed(seed));
    let mut objects = random.receivers(options.walls.clone());
    let receivers = objects.len();
    for i in 0..random.0.usize(options.casters.clone()) {
        let caster = random.caster(i, &objects[..receivers]);
        objects.push(Object { receives_shadow: options.casters_receive, ..caster });
    }
    let count = random.0.usize(options.lights.clone());
    let lights = (0..count).map(|i| random.mesh_light(i, &objects, receivers)).collect();
    let camera = random.view(&objects[..receivers]);
    let (width, height) = options.size;
    let image = Image { width, height, ..Image::default() };
    Scene { ambient: DVec3::splat(0.04), camera, image, lights, objects }
}

/// The shape of a mesh's triangles; a tetrahedron in place of a mesh that could not be made, which the
/// sizes below never ask for.
fn shape(mesh: Result<TriangleMesh, MeshError>) -> Shape {
    let (positions, triangles) = match mesh {
        Ok(mesh) => (mesh.positions().to_vec(), mesh.triangles().to_vec()),
        Err(_) => (
            vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
            vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
        ),
    };
    Shape::Mesh(Arc::new(Mesh { path: "random".into(), positions, triangles }))
}

/// How far a caster reaches from its origin, metres.
fn reach(shape: &Shape) -> f64 {
    match shape {
        Shape::Mesh(mesh) => mesh.positions.iter().map(|p| p.length()).fold(0.0, f64::max),
        Shape::Triangle { vertices } => vertices.iter().map(|p| p.length()).fold(0.0, f64::max),
        Shape::Rectangle { width, depth } => 0.5 * width.hypot(*depth),
        _ => 0.0,
    }
}

impl Random {
    fn receivers(&mut self, walls: RangeInclusive<usize>) -> Vec<Object> {
        let up = random_tilt(DVec3::Y, 0.3)(self).normalize();
        let height = self.range(1.0, 2.0);
        let shape = if self.chance(0.5) {
            Shape::Plane
        } else {
            Shape::Rectangle { width: self.range(6.0, 14.0), depth: self.range(6.0, 14.0) }
        };
        let spin = DQuat::from_rotation_y(self.range(0.0, TAU));
        let rotation = (DQuat::from_rotation_arc(DVec3::Y, up) * spin).normalize();
        let pose = Pose { translation: up * -height, rotation };
        let floor = object("floor".into(), shape, pose, self.color());
        let mut objects = vec![Object { casts_shadow: false, ..floor }];
        let mut turn = self.range(0.0, TAU);
        for i in 0..self.0.usize(walls).min(2) {
            let across = DQuat::from_axis_angle(up, turn) * up.any_orthonormal_vector();
            turn += self.range(70.0, 110.0).to_radians();
            let lean = self.range(-15.0, 15.0).to_radians();
            let normal = (across * lean.cos() + up * lean.sin()).normalize();
            let rotation = (DQuat::from_rotation_arc(DVec3::Y, normal)
                * DQuat::from_rotation_y(self.range(-0.3, 0.3)))
            .normalize();
            let pose = Pose { translation: normal * -self.range(2.5, 4.0), rotation };
            let shape = Shape::Rectangle { width: self.range(4.0, 9.0), depth: self.range(4.0, 9.0) };
            let wall = object(format!("wall-{i}"), shape, pose, self.color());
            objects.push(Object { casts_shadow: self.chance(0.25), ..wall });
        }
        objects
    }

    /// Anything made of triangles: anywhere, through a receiver, or standing on the floor.
    fn caster(&mut self, index: usize, receivers: &[Object]) -> Object {
        let shape = match self.0.usize(0..10) {
            0 | 1 => self.rock(),
            2 => shape(TriangleMesh::cuboid(self.sizes(0.3, 1.6))),
            3 => self.ribbon(),
            4 => self.pages(),
            5 => self.curved(),
            6 => self.round(),
            7 => shape(TriangleMesh::disc(self.range(0.3, 1.1), self.0.u32(5..=40))),
            8 => {
                let size = self.range(0.5, 1.4);
                let vertices = [0; 3].map(|_| self.direction() * size);
                Shape::Triangle { vertices: apart(vertices, size) }
            }
            _ => Shape::Rectangle { width: self.range(0.4, 2.0), depth: self.range(0.4, 2.0) },
        };
        let room = REACH - reach(&shape);
        let mut pose = Pose { translation: self.in_ball(room.min(2.6)), rotation: self.rotation() };
        let receiver = &receivers[self.0.usize(0..receivers.len())];
        let normal = receiver.pose.direction(DVec3::Y);
        let above = |p: DVec3| (p - receiver.pose.translation).dot(normal);
        if self.chance(0.2) {
            // Through the receiver.
            pose.translation += normal * (self.range(-0.4, 0.4) - above(pose.translation));
        } else {
            let low = match &shape {
                Shape::Mesh(mesh) => mesh.positions.iter().map(|p| above(pose.point(*p))).fold(9.0, f64::min),
                _ => above(pose.translation),
            };
            if low < 0.0 || self.chance(0.1) {
                // Standing on it.
                pose.translation -= normal * low;
            }
        }
        pose.translation = pose.translation.clamp_length_max(room);
        object(format!("caster-{index}"), shape, pose, self.color())
    }

    fn sizes(&mut self, low: f64, high: f64) -> DVec3 {
        DVec3::new(self.range(low, high), self.range(low, high), self.range(low, high))
    }

    /// A ball with dents and bumps, closed.
    fn rock(&mut self) -> Shape {
        let radius = self.range(0.4, 1.0);
        let depth = self.range(0.0, 0.4);
        let segments = self.0.u32(4..=16);
        shape(TriangleMesh::sphere(radius, segments).and_then(|ball| {
            let positions =
                ball.positions().iter().map(|p| *p * self.range(1.0 - depth, 1.0 + depth)).collect();
            TriangleMesh::new(positions, ball.triangles().to_vec())
        }))
    }

    /// A twisted band, open at its sides and ends.
    fn ribbon(&mut self) -> Shape {
        let (steps, length, width) = (self.0.u32(2..=12), self.range(0.8, 2.4), self.range(0.2, 0.8));
        let (twist, bend) = (self.range(-3.0, 3.0), self.range(-0.8, 0.8));
        let mut positions = Vec::new();
        for i in 0..=steps {
            let t = f64::from(i) / f64::from(steps) - 0.5;
            let (s, c) = (twist * t).sin_cos();
            let middle = DVec3::new(length * t, bend * (t * TAU).cos(), bend * t * t);
            let half = DVec3::new(0.0, s, c) * (0.5 * width);
            positions.extend([middle - half, middle + half]);
        }
        let quads = (0..steps).map(|i| 2 * i);
        shape(TriangleMesh::new(
            positions,
            quads.flat_map(|i| [[i, i + 1, i + 2], [i + 1, i + 3, i + 2]]).collect(),
        ))
    }

    /// Triangles that share one edge, facing either way.
    fn pages(&mut self) -> Shape {
        let (count, height) = (self.0.u32(2..=5), self.range(0.4, 1.0));
        let mut positions = vec![DVec3::Y * height, DVec3::Y * -height];
        let mut triangles = Vec::new();
        for i in 0..count {
            let (s, c) = ((f64::from(i) + self.range(0.1, 0.9)) / f64::from(count) * TAU).sin_cos();
            positions.push(DVec3::new(c, self.range(-0.8, 0.8), s) * self.range(0.4, 1.0));
            triangles.push(if self.chance(0.5) { [0, 1, i + 2] } else { [1, 0, i + 2] });
        }
        shape(TriangleMesh::new(positions, triangles))
    }

    /// A tessellated solid with corners, or a torus.
    fn curved(&mut self) -> Shape {
        let segments = self.0.u32(5..=32);
        let (radius, height) = (self.range(0.3, 0.8), self.range(0.4, 1.6));
        shape(match self.0.usize(0..3) {
            0 => TriangleMesh::cone(radius, height, segments),
            1 => TriangleMesh::cylinder(radius, height, radius * self.range(0.3, 1.0), segments),
            _ => TriangleMesh::torus(radius, radius * self.range(0.2, 0.9), segments),
        })
    }

    /// A tessellated solid without corners.
    fn round(&mut self) -> Shape {
        let segments = self.0.u32(6..=32);
        shape(match self.0.usize(0..3) {
            0 => TriangleMesh::sphere(self.range(0.3, 0.9), segments),
            1 => TriangleMesh::ellipsoid(self.sizes(0.2, 1.1), segments),
            _ => TriangleMesh::capsule(self.range(0.2, 0.5), self.range(0.2, 1.2), segments),
        })
    }

    /// High or low, mostly in front of the floor, and in no caster.
    fn mesh_light(&mut self, index: usize, objects: &[Object], receivers: usize) -> Light {
        let floor = &objects[0].pose;
        let up = floor.direction(DVec3::Y);
        let mut from = self.direction();
        let height = from.dot(up);
        if self.chance(0.35) {
            // Low: long shadows.
            from = (from - up * (height - self.range(0.05, 0.35))).normalize();
        } else if self.chance(0.9) {
            from -= up * (height - height.abs());
        }
        let distance = if self.chance(0.8) { self.range(5.0, 10.0) } else { self.range(2.0, 5.0) };
        let mut position = from * distance;
        // Casters end within `REACH`, so this does too.
        let inside = |p: DVec3| {
            let near = |o: &Object| o.pose.translation.distance(p) < reach(&o.parts[0].shape) + 0.1;
            objects[receivers..].iter().any(near)
        };
        while inside(position) {
            position += from * 0.3;
        }
        let distance = position.length();
        let direction = (self.in_ball(1.0) - position).try_normalize().unwrap_or(-up);
        let (kind, intensity) = match self.0.usize(0..3) {
            0 => (LightKind::Point, 3.0 * distance * distance),
            1 => {
                let outer_angle = self.range(20.0, 60.0).to_radians();
                let inner_angle = outer_angle * self.range(0.0, 0.95);
                (LightKind::Spot { direction, inner_angle, outer_angle }, 4.0 * distance * distance)
            }
            _ => (LightKind::Directional { direction }, 2.0),
        };
        let position = if matches!(kind, LightKind::Directional { .. }) { DVec3::ZERO } else { position };
        let color = self.sizes(0.3, 1.0);
        Light { name: format!("light-{index}"), kind, position, color, intensity, motion: None }
    }

    /// In front of all receivers, looking at the middle of things.
    fn view(&mut self, receivers: &[Object]) -> Camera {
        let normals: Vec<DVec3> = receivers.iter().map(|o| o.pose.direction(DVec3::Y)).collect();
        // Floor and walls stand at about right angles, so their sum is in front of each of them.
        let mut direction = normals.iter().sum::<DVec3>().normalize();
        for _ in 0..64 {
            let candidate = self.direction();
            if normals.iter().all(|n| candidate.dot(*n) > 0.2) && candidate.y.abs() < 0.97 {
                direction = candidate;
                break;
            }
        }
        let (eye, target) = (direction * self.range(7.5, 12.0), self.in_ball(0.6));
        let up = if (target - eye).normalize().cross(DVec3::Y).length() < 0.1 { DVec3::Z } else { DVec3::Y };
        Camera { eye, target, up, fov_y: self.range(34.0, 50.0).to_radians() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use antumbra_reference::{Sampling, Tracer};
    use std::collections::BTreeMap;

    fn scenes(count: u64) -> impl Iterator<Item = (u64, Scene)> {
        (0..count).map(|seed| (seed, random_mesh_scene(seed, &RandomMeshScene::default())))
    }

    fn walls(scene: &Scene) -> usize {
        scene.objects.iter().filter(|o| o.name.starts_with("wall")).count()
    }

    #[test]
    fn the_same_seed_is_the_same_scene() {
        let options = RandomMeshScene::default();
        for seed in [0, 1, u64::MAX] {
            assert_eq!(random_mesh_scene(seed, &options), random_mesh_scene(seed, &options), "seed {seed}");
        }
        assert_ne!(random_mesh_scene(1, &options), random_mesh_scene(2, &options), "another scene");
        let few = RandomMeshScene {
            walls: 2..=2,
            casters: 3..=3,
            lights: 1..=1,
            casters_receive: false,
            size: (64, 48),
        };
        let scene = random_mesh_scene(7, &few);
        assert_eq!((walls(&scene), scene.objects.len(), scene.lights.len()), (2, 6, 1), "as asked");
        assert_eq!((scene.image.width, scene.image.height), (64, 48), "as asked");
        assert!(scene.objects[3..].iter().all(|o| o.casts_shadow && !o.receives_shadow), "as asked");
    }

    #[test]
    fn everything_turns_up() {
        let mut counts = BTreeMap::new();
        let mut count = |what: String| *counts.entry(what).or_insert(0) += 1;
        for (seed, scene) in scenes(500) {
            count(format!("{} walls", walls(&scene)));
            count(format!("{} lights", scene.lights.len()));
            for object in &scene.objects[1 + walls(&scene)..] {
                match &object.parts[0].shape {
                    Shape::Mesh(mesh) => {
                        let made = TriangleMesh::new(mesh.positions.clone(), mesh.triangles.clone());
                        let made = made.unwrap_or_else(|e| panic!("seed {seed}: {e}"));
                        let many = made.edges().iter().any(|e| made.faces_of(e).len() > 2);
                        let kind = match (made.is_closed(), many) {
                            (true, _) => "closed",
                            (false, true) => "branching",
                            (false, false) => "open",
                        };
                        assert!(mesh.triangles.len() < 3000, "seed {seed}: small enough to trace");
                        count(kind.into());
                    }
                    Shape::Triangle { .. } => count("triangle".into()),
                    Shape::Rectangle { .. } => count("rectangle".into()),
                    other => panic!("seed {seed}: {other:?} is not made of triangles"),
                }
            }
            for light in &scene.lights {
                let kind = format!("{:?}", light.kind);
                count(kind.split(' ').next().unwrap_or_default().into());
                let from = match light.kind {
                    LightKind::Directional { direction } => -direction,
                    _ => light.position.normalize(),
                };
                let floor = &scene.objects[0].pose;
                count(match from.dot(floor.direction(DVec3::Y)) {
                    h if h < 0.0 => "from behind".into(),
                    h if h < 0.35 => "low".into(),
                    _ => "high".into(),
                });
            }
        }
        for (what, least) in [
            ("0 walls", 100),
            ("1 walls", 100),
            ("2 walls", 100),
            ("1 lights", 80),
            ("4 lights", 80),
            ("closed", 1000),
            ("open", 300),
            ("branching", 100),
            ("triangle", 150),
            ("rectangle", 150),
            ("Point", 250),
            ("Spot", 250),
            ("Directional", 250),
            ("low", 250),
            ("high", 250),
            ("from behind", 20),
        ] {
            assert!(counts.get(what).is_some_and(|n| *n >= least), "{what} in {counts:?}");
        }
    }

    #[test]
    fn cameras_and_lights_are_outside_and_numbers_are_sound() {
        for (seed, scene) in scenes(300) {
            let mut points = vec![scene.camera.eye];
            let placed = scene.lights.iter().filter(|l| !matches!(l.kind, LightKind::Directional { .. }));
            points.extend(placed.map(|l| l.position));
            for primitive in &scene.moment(0.0).primitives {
                assert!(primitive.pose.rotation.is_normalized(), "seed {seed}: {primitive:?}");
                let Shape::Mesh(mesh) = &primitive.shape else { continue };
                let made = TriangleMesh::new(mesh.positions.clone(), mesh.triangles.clone()).expect("a mesh");
                for point in &points {
                    let from = primitive.pose.rotation.inverse() * (*point - primitive.pose.translation);
                    let winding = if made.is_closed() { made.winding(from) } else { 0.0 };
                    assert!(winding.abs() < 1e-6, "seed {seed}: {point} is inside of something");
                }
            }
            for receiver in &scene.objects[..1 + walls(&scene)] {
                let height =
                    (scene.camera.eye - receiver.pose.translation).dot(receiver.pose.direction(DVec3::Y));
                assert!(height > 1.0, "seed {seed}: the eye is {height} above {}", receiver.name);
            }
        }
    }

    #[test]
    fn shadows_are_seen() {
        let options = RandomMeshScene { size: (96, 54), ..RandomMeshScene::default() };
        let (mut seen, mut dark, mut none, mut all) = (0, 0, 0, 0);
        for seed in 0..60 {
            let scene = random_mesh_scene(seed, &options);
            let tracer = Tracer::new(&scene, 0.0);
            let lit = Scene {
                objects: scene.objects.iter().map(|o| Object { casts_shadow: false, ..o.clone() }).collect(),
                ..scene.clone()
            };
            let bright = Tracer::new(&lit, 0.0);
            for i in 0..scene.lights.len() {
                let visibility =
                    |t: &Tracer| t.visibility(i, 96, 54, Sampling::Center { light_samples: 1 }, &|_, _| {});
                let (with, without) = (visibility(&tracer), visibility(&bright));
                let lost = with.iter().zip(&without).filter(|(a, b)| a < b).count();
                seen += with.len();
                dark += lost;
                none += usize::from(lost < 20);
                all += 1;
            }
        }
        assert!(dark * 20 > seen, "{dark} of {seen} pixels are in shadow");
        assert!(none * 5 < all, "{none} of {all} lights cast no shadow that is seen");
    }
}
