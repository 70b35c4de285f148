//! What the tests of `blocking` share: the ray tracer of `antumbra-reference` as the other side,
//! and random settings, most of them next to something degenerate.
#![allow(dead_code, reason = "each test program uses a part")]

use antumbra_math::{Cone, Disc, Light, Plane, Rectangle, Shape, Sphere, Triangle};
use antumbra_reference::Ray;
use antumbra_reference::intersect::Body;
use antumbra_scene as scene;
use glam::{DMat3, DQuat, DVec3};

use crate::plane_shadow_support::{Random, grown, normal};

/// How many times the usual number of cases to run, from the environment variable ANTUMBRA_CASES.
pub(crate) fn cases(usual: usize) -> usize {
    let factor = std::env::var("ANTUMBRA_CASES").ok().and_then(|v| v.parse::<usize>().ok()).unwrap_or(1);
    usual * factor.max(1)
}

/// A shape ready for the ray tracer.
pub(crate) fn body(shape: &Shape) -> Body {
    let upright = |center, axis| scene::Pose {
        translation: center,
        rotation: DQuat::from_rotation_arc(DVec3::Y, axis),
    };
    let (shape, pose) = match *shape {
        Shape::Plane(p) => (scene::Shape::Plane, upright(p.normal * p.offset, p.normal)),
        Shape::Disc(d) => (scene::Shape::Disc { radius: d.radius }, upright(d.center, d.normal)),
        Shape::Sphere(s) => (scene::Shape::Sphere { radius: s.radius }, upright(s.center, DVec3::Y)),
        Shape::Cone(c) => {
            let middle = c.base_center + c.axis * (0.5 * c.height);
            (scene::Shape::Cone { radius: c.radius, height: c.height }, upright(middle, c.axis))
        }
        Shape::Triangle(t) => (
            scene::Shape::Triangle { vertices: t.vertices.map(|v| v - t.vertices[0]) },
            upright(t.vertices[0], DVec3::Y),
        ),
        Shape::Rectangle(r) => {
            let (x, z) = (r.half_right.normalize(), r.half_forward.normalize());
            let rotation = DQuat::from_mat3(&DMat3::from_cols(x, z.cross(x), z));
            let (width, depth) = (2.0 * r.half_right.length(), 2.0 * r.half_forward.length());
            (scene::Shape::Rectangle { width, depth }, scene::Pose { translation: r.center, rotation })
        }
        _ => unreachable!("a shape that this test does not know"),
    };
    Body::new(&scene::Primitive {
        object: 0,
        part: 0,
        shape,
        pose,
        color: DVec3::ONE,
        casts_shadow: true,
        receives_shadow: true,
    })
}

/// The way from a point to a light.
pub(crate) fn way(light: &Light, point: DVec3) -> Ray {
    match *light {
        Light::Point { position } | Light::Spot { position, .. } => Ray::segment(point, position),
        Light::Directional { direction } => Ray::new(point, -direction),
    }
}

/// The ray tracer's answers for a shape and a light.
pub(crate) struct Oracle {
    shape: Shape,
    light: Light,
    exact: Body,
}

impl Oracle {
    pub(crate) fn new(shape: &Shape, light: &Light) -> Self {
        Self { shape: *shape, light: *light, exact: body(shape) }
    }

    /// Whether the way from `point` to the light is blocked.
    pub(crate) fn blocks(&self, point: DVec3) -> bool {
        self.exact.blocks(&way(&self.light, point))
    }

    /// The same, `None` where a shape larger or smaller by `edge` metres, in every direction,
    /// changes the answer. So do a point and a light that are moved by so much.
    pub(crate) fn decide(&self, point: DVec3, edge: f64) -> Option<bool> {
        let ray = way(&self.light, point);
        let answer = self.exact.blocks(&ray);
        let mut edge = edge;
        if self.is_flat() {
            // A step across the plane moves the crossing in the plane by step / tan(elevation).
            let normal = normal(&self.shape);
            let elevation = normal.dot(ray.direction).abs() / ray.direction.length();
            let height = |p: DVec3| normal.dot(p - self.anchor()).abs();
            let light_touches = ray.max == 1.0 && height(ray.at(1.0)) <= edge;
            // The plane of a narrow shape tilts if a corner moves.
            let elevation = elevation - edge / self.thinness();
            if height(point) <= edge || light_touches || !(elevation > 0.0) {
                return None;
            }
            edge /= elevation;
        }
        let other = if answer {
            if self.thinness() <= 2.0 * edge {
                return None;
            }
            grown(&self.shape, -edge)
        } else {
            grown(&self.shape, edge)
        };
        (body(&other).blocks(&ray) == answer).then_some(answer)
    }

    /// Whether the point is in a solid, or within the edge of it.
    pub(crate) fn may_hold(&self, point: DVec3, edge: f64) -> bool {
        let there = Ray { max: 1e-300, ..Ray::new(point, DVec3::X) };
        !self.is_flat() && body(&grown(&self.shape, edge)).blocks(&there)
    }

    /// By how much the light's place magnifies errors: next to a cone's rim, by the size of the cone
    /// over the distance. There the shadow is made of a disc and a triangle that the light both
    /// grazes, and rounding opens a gap between them.
    pub(crate) fn magnification(&self) -> f64 {
        let (Shape::Cone(c), Light::Point { position } | Light::Spot { position, .. }) =
            (self.shape, self.light)
        else {
            return 1.0;
        };
        let from_base = position - c.base_center;
        let height = c.axis.dot(from_base);
        let to_rim = ((from_base - c.axis * height).length() - c.radius).hypot(height);
        1.0 + c.radius / to_rim.max(1e-12 * c.radius)
    }

    fn is_flat(&self) -> bool {
        !matches!(self.shape, Shape::Sphere(_) | Shape::Cone(_))
    }

    fn anchor(&self) -> DVec3 {
        match self.shape {
            Shape::Triangle(t) => t.vertices[0],
            Shape::Plane(p) => p.normal * p.offset,
            _ => self.shape.bounding_sphere().0,
        }
    }

    /// The radius of a ball, or disc if flat, that fits into the shape.
    fn thinness(&self) -> f64 {
        match self.shape {
            Shape::Triangle(Triangle { vertices: [a, b, c] }) => {
                (b - a).cross(c - a).length() / (a.distance(b) + b.distance(c) + c.distance(a))
            }
            Shape::Rectangle(r) => r.half_right.length().min(r.half_forward.length()),
            Shape::Cone(c) => c.radius * c.height / (c.radius + c.radius.hypot(c.height)),
            Shape::Disc(Disc { radius, .. }) | Shape::Sphere(Sphere { radius, .. }) => radius,
            Shape::Plane(_) => f64::INFINITY,
            _ => unreachable!("a shape that this test does not know"),
        }
    }
}

/// A shape, a light and the length they are measured by.
#[derive(Debug)]
pub(crate) struct Setting {
    pub(crate) shape: Shape,
    pub(crate) light: Light,
    pub(crate) size: f64,
    pub(crate) center: DVec3,
}

/// The shapes, by number.
pub(crate) const SPHERE: u64 = 0;
pub(crate) const DISC: u64 = 1;
pub(crate) const TRIANGLE: u64 = 2;
pub(crate) const CONE: u64 = 3;
pub(crate) const RECTANGLE: u64 = 4;
pub(crate) const PLANE: u64 = 5;
pub(crate) const NAMES: [&str; 6] = ["sphere", "disc", "triangle", "cone", "rectangle", "plane"];

pub(crate) fn sign(random: &mut Random) -> f64 {
    if random.choice(2) == 0 { 1.0 } else { -1.0 }
}

/// A shape of about the given size; one in four is next to losing an extent.
pub(crate) fn shape(random: &mut Random, kind: u64, size: f64, center: DVec3) -> Shape {
    let axis = match random.choice(4) {
        0 => [DVec3::X, DVec3::Y, DVec3::Z][random.choice(3) as usize] * sign(random),
        _ => random.direction(),
    };
    let across = axis.any_orthonormal_vector();
    let thin = random.choice(4) == 0;
    let extent = size * if thin { random.decades(-5.0, 0.0) } else { random.decades(-0.7, 0.7) };
    match kind {
        SPHERE => Shape::Sphere(Sphere { center, radius: size }),
        DISC => Shape::Disc(Disc { center, normal: axis, radius: size }),
        TRIANGLE => {
            let corner = |x: f64, y: f64| center + across * (x * size) + axis.cross(across) * (y * extent);
            Shape::Triangle(Triangle {
                vertices: [0, 1, 2].map(|_| corner(random.within(-1.0, 1.0), random.within(-1.0, 1.0))),
            })
        }
        CONE => Shape::Cone(Cone { base_center: center, axis, radius: size, height: extent }),
        RECTANGLE => Shape::Rectangle(Rectangle {
            center,
            half_right: across * size,
            half_forward: axis.cross(across) * extent,
        }),
        _ => Shape::Plane(Plane::through(center, axis)),
    }
}

/// A random point of the shape, on its rim half of the time; of a plane, near `center`.
pub(crate) fn point_of(random: &mut Random, setting: &Setting) -> DVec3 {
    let turn = random.within(0.0, std::f64::consts::TAU);
    let ring = |axis: DVec3, radius: f64| {
        let u = axis.any_orthonormal_vector();
        (u * turn.cos() + axis.cross(u) * turn.sin()) * radius
    };
    let reach = if random.choice(2) == 0 { 1.0 } else { random.within(0.0, 1.0).sqrt() };
    match setting.shape {
        Shape::Sphere(s) => s.center + random.direction() * (s.radius * reach),
        Shape::Disc(d) => d.center + ring(d.normal, d.radius * reach),
        Shape::Triangle(Triangle { vertices: [a, b, c] }) => {
            let (u, v) = (random.within(0.0, 1.0), random.within(0.0, 1.0));
            let v = if reach == 1.0 { 0.0 } else { v };
            a.lerp(b, u).lerp(c, v)
        }
        Shape::Cone(c) => {
            let up = if random.choice(3) == 0 { 0.0 } else { random.within(0.0, 1.0) };
            c.base_center + c.axis * (c.height * up) + ring(c.axis, c.radius * reach * (1.0 - up))
        }
        Shape::Rectangle(r) => {
            let v = random.within(-1.0, 1.0) * reach;
            r.center + r.half_right * (if reach == 1.0 { sign(random) } else { reach }) + r.half_forward * v
        }
        Shape::Plane(p) => setting.center + ring(p.normal, setting.size * reach * 3.0),
        _ => unreachable!("a shape that this test does not know"),
    }
}

/// The axis of the shape; of a ball, any.
fn axis(random: &mut Random, shape: &Shape) -> DVec3 {
    match shape {
        Shape::Sphere(_) => random.direction(),
        _ => normal(shape).normalize_or(DVec3::Y),
    }
}

/// A setting: shapes from 1e-6 to 1e6 m, up to a hundred times their size from the origin, lights up to
/// 1e6 times as far, and two out of three next to something degenerate.
pub(crate) fn setting(random: &mut Random, kind: u64) -> Setting {
    let size = if random.choice(2) == 0 { 1.0 } else { random.decades(-6.0, 6.0) };
    let center = match random.choice(3) {
        0 => DVec3::ZERO,
        _ => random.direction() * size * random.decades(-1.0, 2.0),
    };
    let shape = shape(random, kind, size, center);
    let mut setting = Setting { shape, light: Light::Point { position: DVec3::ZERO }, size, center };
    let axis = axis(random, &shape);
    let sideways = axis.cross(random.direction()).normalize_or(axis.any_orthonormal_vector());
    let near = random.decades(-12.0, -1.0) * sign(random);
    let out = |distance: f64| center + sideways * (size * distance);
    let position = match random.choice(8) {
        // Anywhere.
        0 | 1 => center + random.direction() * size * random.decades(-1.0, 1.5),
        // Far.
        2 => center + random.direction() * size * random.decades(2.0, 6.0),
        // Edge-on.
        3 => out(random.decades(-1.0, 3.0)) + axis * (size * near),
        // Almost on the shape, or in it.
        4 => {
            let p = point_of(random, &setting);
            p + random.direction() * (size * near)
        }
        5 => {
            let p = point_of(random, &setting);
            center + (p - center) * (1.0 + near)
        }
        // On a cone's axis, or next to it.
        6 => center + axis * (size * random.decades(-1.0, 2.0) * sign(random)) + sideways * (size * near),
        // Level with a cone's apex; where the apex starts to project inside the base.
        _ => {
            if let Shape::Cone(c) = shape {
                let rim = c.base_center + sideways * c.radius;
                match random.choice(3) {
                    0 => out(random.decades(-3.0, 2.0)) + axis * (c.height * (1.0 + near)),
                    1 => {
                        c.apex()
                            + (c.apex() - rim) * random.decades(-2.0, 2.0)
                            + random.direction() * (size * near)
                    }
                    _ => {
                        rim + (rim - c.apex()) * random.decades(-2.0, 2.0)
                            + random.direction() * (size * near)
                    }
                }
            } else {
                out(random.decades(-3.0, 2.0)) + axis * (size * random.within(-2.0, 2.0))
            }
        }
    };
    let direction = match random.choice(3) {
        0 => (sideways + axis * near).normalize(),
        1 => (axis + sideways * near).normalize() * sign(random),
        _ => random.direction(),
    };
    setting.light = match random.choice(6) {
        0 => Light::Directional { direction },
        1 => Light::Spot { position, direction, outer_angle: random.within(0.1, 1.5) },
        _ => Light::Point { position },
    };
    setting
}

/// A point worth asking: behind some part of the shape, close to its surface, or anywhere.
pub(crate) fn ask(random: &mut Random, setting: &Setting) -> DVec3 {
    let size = setting.size;
    let on = point_of(random, setting);
    let beside = on + random.direction() * (size * random.decades(-9.0, 0.3));
    match random.choice(8) {
        0 => setting.center + random.direction() * (size * random.decades(-1.0, 3.5)),
        1 => beside,
        choice => {
            let through = if choice < 5 { on } else { beside };
            let away = (-setting.light.vector_from(through)).normalize_or(DVec3::Y);
            let back = if random.choice(8) == 0 { -1.0 } else { 1.0 };
            through + away * (back * size * random.decades(-6.0, 3.5))
        }
    }
}
