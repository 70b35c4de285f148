//! Random scenes, the same for the same seed: a few occluders, a few lights, two receivers at an angle,
//! and a camera that sees them.
//!
//! Nothing is avoided on purpose: objects pierce each other and the receivers, touch the floor, lie in
//! the plane of a light or hide it, and lights shine from behind a receiver. Only a camera or a light
//! inside a solid is ruled out, because then everything is dark.

use core::f64::consts::TAU;
use core::ops::RangeInclusive;

use antumbra_scene::{Camera, Image, Light, LightKind, Object, Part, Pose, Scene, Shape};
use fastrand::Rng;
use glam::{DQuat, DVec3};

/// What random scenes are made of.
#[derive(Clone, Debug, PartialEq)]
pub struct RandomScene {
    /// How many occluders: discs, triangles, spheres and cones in any pose.
    pub occluders: RangeInclusive<usize>,
    /// How many lights: point, spot and directional.
    pub lights: RangeInclusive<usize>,
    /// Pixels across and down.
    pub size: (u32, u32),
}

impl Default for RandomScene {
    /// 1 to 8 occluders, 1 to 8 lights, 640 by 360.
    fn default() -> Self {
        Self { occluders: 1..=8, lights: 1..=8, size: (640, 360) }
    }
}

/// Lights and cameras keep at least this distance from solids, metres: enough that rounding to
/// float32 does not put them inside.
const CLEARANCE: f64 = 1e-3;

/// The scene of a seed. The first two objects are the receivers ("floor" and "wall"), planes or
/// rectangles that cast no shadow; then come the occluders. Nothing moves.
///
/// Total and deterministic: the generator is wyrand as `fastrand` 2 implements it. Lengths are metres
/// and the action is within some 4 m of the origin.
pub fn random_scene(seed: u64, options: &RandomScene) -> Scene {
    let mut random = Random(Rng::with_seed(seed));
    let floor = random.receiver("floor", random_tilt(DVec3::Y, 0.45), 0.8..2.0);
    let floor_normal = floor.pose.direction(DVec3::Y);
    // Between 30 and 150 degrees from the floor, to any side.
    let angle = random.range(30.0, 150.0).to_radians();
    let across =
        DQuat::from_axis_angle(floor_normal, random.range(0.0, TAU)) * floor_normal.any_orthonormal_vector();
    let wall = random.receiver("wall", |_| floor_normal * angle.cos() + across * angle.sin(), 2.0..4.0);
    let receivers = [floor, wall];
    let mut objects = receivers.to_vec();
    for i in 0..random.0.usize(options.occluders.clone()) {
        objects.push(random.occluder(i, &receivers));
    }
    let solids: Vec<Object> = objects[2..].to_vec();
    let count = random.0.usize(options.lights.clone());
    let lights = (0..count).map(|i| random.light(i, &solids)).collect();
    let camera = random.camera(&receivers, &solids);
    let (width, height) = options.size;
    let image = Image { width, height, ..Image::default() };
    Scene { ambient: DVec3::splat(0.04), camera, image, lights, objects }
}

/// A function that tilts `axis` by up to `most` radians to any side.
pub(crate) fn random_tilt(axis: DVec3, most: f64) -> impl Fn(&mut Random) -> DVec3 {
    move |random| {
        let (tilt, around) = (random.range(0.0, most), random.range(0.0, TAU));
        let side = DQuat::from_axis_angle(axis, around) * axis.any_orthonormal_vector();
        axis * tilt.cos() + side * tilt.sin()
    }
}

pub(crate) struct Random(pub(crate) Rng);

impl Random {
    /// Uniform in [low, high).
    pub(crate) fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.f64()
    }

    /// True so often.
    pub(crate) fn chance(&mut self, often: f64) -> bool {
        self.0.f64() < often
    }

    /// Uniform on the sphere.
    pub(crate) fn direction(&mut self) -> DVec3 {
        let (y, turn) = (self.range(-1.0, 1.0), self.range(0.0, TAU));
        let r = (1.0 - y * y).max(0.0).sqrt();
        DVec3::new(r * turn.cos(), y, r * turn.sin())
    }

    /// Uniform over all rotations (Shoemake, Uniform Random Rotations, Graphics Gems III, 1992).
    pub(crate) fn rotation(&mut self) -> DQuat {
        let (u, a, b) = (self.0.f64(), self.range(0.0, TAU), self.range(0.0, TAU));
        let (s, c) = ((1.0 - u).sqrt(), u.sqrt());
        DQuat::from_xyzw(s * a.sin(), s * a.cos(), c * b.sin(), c * b.cos()).normalize()
    }

    /// Uniform in a ball.
    pub(crate) fn in_ball(&mut self, radius: f64) -> DVec3 {
        self.direction() * (radius * self.0.f64().cbrt())
    }

    pub(crate) fn color(&mut self) -> DVec3 {
        DVec3::new(self.range(0.2, 0.9), self.range(0.2, 0.9), self.range(0.2, 0.9))
    }

    /// A plane, or a rectangle, so far behind the origin, with the origin on its front.
    fn receiver(
        &mut self,
        name: &str,
        normal: impl Fn(&mut Self) -> DVec3,
        behind: core::ops::Range<f64>,
    ) -> Object {
        let normal = normal(self).normalize();
        let distance = self.range(behind.start, behind.end);
        let shape = if self.chance(0.5) {
            Shape::Plane
        } else {
            Shape::Rectangle { width: self.range(4.0, 14.0), depth: self.range(4.0, 14.0) }
        };
        let spin = DQuat::from_rotation_y(self.range(0.0, TAU));
        let rotation = (DQuat::from_rotation_arc(DVec3::Y, normal) * spin).normalize();
        let pose = Pose { translation: normal * -distance, rotation };
        Object { casts_shadow: false, ..object(name.to_owned(), shape, pose, self.color()) }
    }

    /// One of the four shapes: anywhere, through a receiver, or touching one.
    fn occluder(&mut self, index: usize, receivers: &[Object; 2]) -> Object {
        let shape = match self.0.usize(0..4) {
            0 => Shape::Disc { radius: self.range(0.2, 1.1) },
            1 => {
                let size = self.range(0.4, 1.4);
                // Nearly equilateral to nearly a line.
                let corner = |random: &mut Self| random.direction() * size;
                let vertices = [corner(self), corner(self), corner(self)];
                Shape::Triangle { vertices: apart(vertices, size) }
            }
            2 => Shape::Sphere { radius: self.range(0.2, 0.9) },
            _ => Shape::Cone { radius: self.range(0.2, 0.8), height: self.range(0.3, 1.8) },
        };
        let mut pose = Pose { translation: self.in_ball(2.6), rotation: self.rotation() };
        let receiver = &receivers[self.0.usize(0..2)];
        let normal = receiver.pose.direction(DVec3::Y);
        let height = (pose.translation - receiver.pose.translation).dot(normal);
        if self.chance(0.25) {
            // Through the receiver, by up to the object's own size.
            pose.translation += normal * (self.range(-0.5, 0.5) - height);
        } else if self.chance(0.15) {
            // Flat on it or across it: discs and triangles parallel to the receiver, spheres and
            // cones that touch it.
            let up = match shape {
                Shape::Sphere { radius } => radius,
                Shape::Cone { height, .. } => 0.5 * height,
                _ => self.range(0.1, 1.0),
            };
            pose.rotation = receiver.pose.rotation;
            pose.translation += normal * (up - height);
        }
        object(format!("occluder-{index}"), shape, pose, self.color())
    }

    fn light(&mut self, index: usize, solids: &[Object]) -> Light {
        let mut from = self.direction();
        if self.chance(0.85) {
            from.y = from.y.abs();
        }
        // Mostly at some distance, at times among the objects.
        let distance = if self.chance(0.8) { self.range(4.0, 10.0) } else { self.range(1.0, 4.0) };
        let aim = self.in_ball(1.5);
        let position = self.outside(from * distance, solids);
        let direction = (aim - position).try_normalize().unwrap_or(DVec3::NEG_Y);
        let (kind, intensity) = match self.0.usize(0..3) {
            0 => (LightKind::Point, 3.0 * distance * distance),
            1 => {
                let outer_angle = self.range(12.0, 60.0).to_radians();
                let inner_angle = outer_angle * self.range(0.0, 0.95);
                (LightKind::Spot { direction, inner_angle, outer_angle }, 4.0 * distance * distance)
            }
            _ => (LightKind::Directional { direction }, 2.0),
        };
        let position = if matches!(kind, LightKind::Directional { .. }) { DVec3::ZERO } else { position };
        let color = DVec3::new(self.range(0.3, 1.0), self.range(0.3, 1.0), self.range(0.3, 1.0));
        Light { name: format!("light-{index}"), kind, position, color, intensity, motion: None }
    }

    /// The point, or one further out on its ray from the origin, outside of all solids.
    fn outside(&mut self, mut point: DVec3, solids: &[Object]) -> DVec3 {
        // Solids end some 5 m from the origin, so this does too.
        while solids.iter().any(|o| contains(o, point)) {
            point += point.try_normalize().unwrap_or(DVec3::Y) * self.range(0.2, 0.6);
        }
        point
    }

    /// In front of both receivers, looking at the middle of things.
    fn camera(&mut self, receivers: &[Object; 2], solids: &[Object]) -> Camera {
        let normals = [0, 1].map(|i| receivers[i].pose.direction(DVec3::Y));
        // The bisector is at most 75 degrees from either normal, so a direction is found soon; it is
        // one itself.
        let bisector = (normals[0] + normals[1]).normalize();
        let mut direction = bisector;
        for _ in 0..64 {
            let candidate = self.direction();
            if normals.iter().all(|n| candidate.dot(*n) > 0.2) && candidate.y.abs() < 0.97 {
                direction = candidate;
                break;
            }
        }
        let eye = direction * self.range(7.5, 12.0);
        let eye = self.outside(eye, solids);
        let target = self.in_ball(0.8);
        let up = if (target - eye).normalize().cross(DVec3::Y).length() < 0.1 { DVec3::Z } else { DVec3::Y };
        Camera { eye, target, up, fov_y: self.range(32.0, 48.0).to_radians() }
    }
}

pub(crate) fn object(name: String, shape: Shape, pose: Pose, color: DVec3) -> Object {
    Object {
        name,
        parts: vec![Part { shape, pose: Pose::IDENTITY }],
        pose,
        color,
        casts_shadow: true,
        receives_shadow: true,
        motion: None,
    }
}

/// The vertices, or others where they are so nearly on a line that the triangle has no plane.
pub(crate) fn apart(vertices: [DVec3; 3], size: f64) -> [DVec3; 3] {
    let [a, b, c] = vertices;
    if (b - a).cross(c - a).length() < 1e-3 * size * size {
        return [DVec3::ZERO, DVec3::X * size, DVec3::Y * size];
    }
    vertices
}

/// Whether a point is inside a sphere or cone, or within [`CLEARANCE`] of it.
fn contains(object: &Object, point: DVec3) -> bool {
    object.parts.iter().any(|part| {
        let pose = object.pose.then(&part.pose);
        let p = pose.rotation.inverse() * (point - pose.translation);
        match part.shape {
            Shape::Sphere { radius } => p.length() < radius + CLEARANCE,
            Shape::Cone { radius, height } => {
                // Distance from the side, in the plane through the axis, and from the base.
                let slant = radius.hypot(height);
                let out = (p.x.hypot(p.z) * height + (p.y - 0.5 * height) * radius) / slant;
                out < CLEARANCE && p.y > -0.5 * height - CLEARANCE
            }
            _ => false,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scenes() -> impl Iterator<Item = (u64, Scene)> {
        (0..500).map(|seed| (seed, random_scene(seed, &RandomScene::default())))
    }

    fn occluders(scene: &Scene) -> &[Object] {
        &scene.objects[2..]
    }

    #[test]
    fn the_same_seed_is_the_same_scene() {
        let options = RandomScene::default();
        for seed in [0, 1, u64::MAX] {
            assert_eq!(random_scene(seed, &options), random_scene(seed, &options), "seed {seed}");
        }
        assert_ne!(random_scene(1, &options), random_scene(2, &options), "another seed is another scene");
    }

    #[test]
    fn everything_turns_up_as_often_as_asked() {
        let mut counts = std::collections::BTreeMap::new();
        for (_, scene) in scenes() {
            *counts.entry(format!("{} occluders", occluders(&scene).len())).or_insert(0) += 1;
            *counts.entry(format!("{} lights", scene.lights.len())).or_insert(0) += 1;
            for light in &scene.lights {
                let kind = format!("{:?}", light.kind);
                *counts.entry(kind.split(' ').next().unwrap_or_default().to_owned()).or_insert(0) += 1;
            }
            for object in &scene.objects {
                let shape = format!("{:?}", object.parts[0].shape);
                *counts.entry(shape.split(' ').next().unwrap_or_default().to_owned()).or_insert(0) += 1;
            }
        }
        for n in 1..=8 {
            assert!(counts[&format!("{n} occluders")] > 30, "{counts:?}");
            assert!(counts[&format!("{n} lights")] > 30, "{counts:?}");
        }
        for kind in
            ["Point", "Spot", "Directional", "Disc", "Triangle", "Sphere", "Cone", "Plane", "Rectangle"]
        {
            assert!(counts.get(kind).is_some_and(|n| *n > 300), "{kind} in {counts:?}");
        }
        assert_eq!(counts.len(), 8 + 8 + 9, "nothing else: {counts:?}");
        let few = RandomScene { occluders: 3..=3, lights: 2..=2, size: (64, 48) };
        let scene = random_scene(9, &few);
        assert_eq!((occluders(&scene).len(), scene.lights.len()), (3, 2), "as asked");
        assert_eq!((scene.image.width, scene.image.height), (64, 48), "as asked");
    }

    #[test]
    fn no_light_and_no_camera_is_inside_a_solid() {
        for (seed, scene) in scenes() {
            let mut points: Vec<DVec3> = vec![scene.camera.eye];
            let placed = scene.lights.iter().filter(|l| !matches!(l.kind, LightKind::Directional { .. }));
            points.extend(placed.map(|l| l.position));
            for o in occluders(&scene) {
                for p in &points {
                    let from = o.pose.rotation.inverse() * (*p - o.pose.translation);
                    let inside = match o.parts[0].shape {
                        Shape::Sphere { radius } => from.length() <= radius,
                        // A cone is where the radius at a height is not reached.
                        Shape::Cone { radius, height } => {
                            let part = 0.5 - from.y / height;
                            (0.0..=1.0).contains(&part) && from.x.hypot(from.z) <= radius * part
                        }
                        _ => false,
                    };
                    assert!(!inside, "seed {seed}: {p} is inside {}", o.name);
                }
            }
        }
    }

    #[test]
    fn everything_is_finite_and_valid() {
        for (seed, scene) in scenes() {
            let moment = scene.moment(0.0);
            for l in &moment.lights {
                assert!(l.position.is_finite() && l.intensity > 0.0, "seed {seed}: {l:?}");
                match l.kind {
                    LightKind::Directional { direction } | LightKind::Spot { direction, .. } => {
                        assert!((direction.length() - 1.0).abs() < 1e-12, "seed {seed}: {l:?}");
                    }
                    _ => {}
                }
                if let LightKind::Spot { inner_angle, outer_angle, .. } = l.kind {
                    assert!(
                        0.0 <= inner_angle
                            && inner_angle < outer_angle
                            && outer_angle < core::f64::consts::FRAC_PI_2,
                        "{l:?}"
                    );
                }
            }
            for p in &moment.primitives {
                assert!(p.pose.rotation.is_normalized(), "seed {seed}: {p:?}");
                if let Some((low, high)) = p.bounds() {
                    assert!(low.is_finite() && high.is_finite(), "seed {seed}: {p:?}");
                }
                if p.casts_shadow {
                    assert!(p.pose.translation.length() < 8.0, "seed {seed}: {p:?} is far out");
                }
            }
        }
    }

    #[test]
    fn the_camera_is_in_front_of_both_receivers_and_sees_the_objects() {
        let (mut seen, mut all) = (0, 0);
        for (seed, scene) in scenes() {
            for receiver in &scene.objects[..2] {
                let normal = receiver.pose.direction(DVec3::Y);
                let height = (scene.camera.eye - receiver.pose.translation).dot(normal);
                assert!(height > 1.0, "seed {seed}: the eye is {height} above the {}", receiver.name);
            }
            let aspect = f64::from(scene.image.width) / f64::from(scene.image.height);
            let clip = scene.camera.projection(aspect, 0.1, 100.0) * scene.camera.view();
            for o in occluders(&scene) {
                let ndc = clip.project_point3(o.pose.translation);
                seen += usize::from(ndc.abs().max_element() < 1.0);
                all += 1;
            }
        }
        assert!(seen * 10 > all * 9, "{seen} of {all} objects are in the picture");
    }

    #[test]
    fn objects_are_on_and_through_the_receivers() {
        let (mut through, mut touching) = (0, 0);
        for (_, scene) in scenes() {
            for o in occluders(&scene) {
                for receiver in &scene.objects[..2] {
                    let normal = receiver.pose.direction(DVec3::Y);
                    let height = (o.pose.translation - receiver.pose.translation).dot(normal);
                    if let Shape::Sphere { radius } = o.parts[0].shape {
                        through += usize::from(height.abs() < 0.9 * radius);
                        touching += usize::from((height - radius).abs() < 1e-9);
                    }
                }
            }
        }
        assert!(through > 50 && touching > 20, "{through} spheres through a receiver, {touching} touch one");
    }
}
