//! Random settings in any pose, most of them next to something degenerate.

use antumbra_math::plane_shadow::PlaneFrame;
use antumbra_math::{Cone, Disc, Light, Plane, Rectangle, Shape, Sphere, Triangle};
use glam::{DQuat, DVec3};

use super::Random;

/// An occluder over a plane, in the world.
#[derive(Debug)]
pub(crate) struct Setting {
    pub(crate) occluder: Shape,
    pub(crate) light: Light,
    pub(crate) frame: PlaneFrame,
    /// Of the occluder, about, metres.
    pub(crate) size: f64,
}

/// A setting; `shape` 0: sphere, 1: disc, 2: triangle, 3: cone, 4: rectangle.
pub(crate) fn setting(random: &mut Random, shape: usize) -> Setting {
    let (occluder, light, size) = flat_setting(random, shape);
    let turn = DQuat::from_axis_angle(random.direction(), random.within(0.0, 3.2));
    let turn = if random.choice(4) == 0 { DQuat::IDENTITY } else { turn };
    let shift = if random.choice(4) == 0 { DVec3::ZERO } else { random.vector(10.0) };
    // Half of the time the frame's normal is on the other side of the plane.
    let normal = turn * if random.choice(2) == 0 { DVec3::Z } else { -DVec3::Z };
    let frame = PlaneFrame::of_plane(&Plane::through(shift, normal)).expect("a plane");
    let occluder = posed(&occluder, turn, shift);
    let light = match light {
        Light::Point { position } => Light::Point { position: turn * position + shift },
        Light::Spot { position, direction, outer_angle } => {
            Light::Spot { position: turn * position + shift, direction: turn * direction, outer_angle }
        }
        Light::Directional { direction } => Light::Directional { direction: turn * direction },
    };
    Setting { occluder, light, frame, size }
}

/// A number that is often one of the special ones.
fn special(random: &mut Random, values: &[f64], from: f64, to: f64) -> f64 {
    let value = values[random.choice(values.len() as u64) as usize];
    match random.choice(4) {
        0 => value,
        1 => value + random.within(-1.0, 1.0) * random.decades(-12.0, -1.0),
        _ => random.within(from, to),
    }
}

/// An occluder and a light over the plane h = 0 (h is z), and the occluder's size.
fn flat_setting(random: &mut Random, shape: usize) -> (Shape, Light, f64) {
    let size = random.decades(-1.0, 0.5);
    // Heights in units of the size, special where something happens.
    let light_height = random.decades(-0.5, 1.5) * size;
    let relative = [0.0, 1.0, -1.0, 0.5];
    let height = match random.choice(3) {
        0 => special(random, &relative, -1.0, 2.0) * size,
        1 => light_height + special(random, &relative, -2.0, 1.0) * size,
        _ => random.within(0.0, 1.0) * light_height,
    };
    let at = DVec3::new(random.within(-3.0, 3.0) * size, random.within(-3.0, 3.0) * size, height);
    let light = DVec3::new(
        at.x + special(random, &[0.0, 1.0], -4.0, 4.0) * size,
        at.y + special(random, &[0.0], -4.0, 4.0) * size,
        light_height,
    );
    let axis = match random.choice(5) {
        0 => DVec3::Z,
        1 => DVec3::X,
        // Nearly edge-on, or nearly pointing at the light.
        2 => {
            let to = (light - at).normalize_or(DVec3::Z);
            let across = to.cross(random.direction()).normalize_or(DVec3::X);
            if random.choice(2) == 0 { across } else { to }
        }
        _ => random.direction(),
    };
    let tilt = random.direction() * if random.choice(2) == 0 { 0.0 } else { random.decades(-9.0, -1.0) };
    let axis = (axis + tilt).normalize_or(DVec3::Z) * if random.choice(2) == 0 { 1.0 } else { -1.0 };
    let occluder = match shape {
        0 => Shape::Sphere(Sphere { center: at, radius: size }),
        1 => Shape::Disc(Disc { center: at, normal: axis, radius: size }),
        2 => Shape::Triangle(Triangle {
            vertices: [0, 1, 2].map(|_| {
                let flat = axis.any_orthonormal_pair();
                let p = at + (flat.0 * random.within(-1.0, 1.0) + flat.1 * random.within(-1.0, 1.0)) * size;
                // Corners exactly on the plane and at the light's height.
                match random.choice(8) {
                    0 => p.with_z(0.0),
                    1 => p.with_z(light.z),
                    _ => p,
                }
            }),
        }),
        3 => {
            let height = special(random, &[1.0], 0.1, 3.0).abs() * size;
            let back = [0.0, height, 0.5 * height][random.choice(3) as usize];
            Shape::Cone(Cone { base_center: at - axis * back, axis, radius: size, height })
        }
        _ => {
            let flat = axis.any_orthonormal_pair();
            let half_forward = flat.1 * size * random.within(0.1, 2.0);
            Shape::Rectangle(Rectangle { center: at, half_right: flat.0 * size, half_forward })
        }
    };
    let light = match random.choice(4) {
        0 => Light::Directional { direction: (at - light).with_z(-light.z).normalize_or(-DVec3::Z) },
        1 => Light::Spot { position: light, direction: -DVec3::Z, outer_angle: 0.5 },
        _ => Light::Point { position: light },
    };
    (occluder, light, size)
}

/// The occluder, turned and then moved.
fn posed(shape: &Shape, turn: DQuat, shift: DVec3) -> Shape {
    let point = |p: DVec3| turn * p + shift;
    match *shape {
        Shape::Sphere(s) => Shape::Sphere(Sphere { center: point(s.center), ..s }),
        Shape::Disc(d) => Shape::Disc(Disc { center: point(d.center), normal: turn * d.normal, ..d }),
        Shape::Triangle(t) => Shape::Triangle(Triangle { vertices: t.vertices.map(point) }),
        Shape::Cone(c) => Shape::Cone(Cone { base_center: point(c.base_center), axis: turn * c.axis, ..c }),
        Shape::Rectangle(r) => Shape::Rectangle(Rectangle {
            center: point(r.center),
            half_right: turn * r.half_right,
            half_forward: turn * r.half_forward,
        }),
        Shape::Plane(p) => {
            let normal = turn * p.normal;
            Shape::Plane(Plane::through(point(p.normal * p.offset), normal))
        }
        _ => unreachable!("a shape that this test does not know"),
    }
}
