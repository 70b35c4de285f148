//! The other side of the tests of shadows on planes: rays against shapes, one at a time and by the
//! book, and random settings. It uses the library's types and frames and none of its geometry.
#![allow(dead_code, reason = "each test program uses a part")]

pub(crate) mod settings;

use antumbra_math::{Cone, Disc, Light, Rectangle, Shape, Sphere, Triangle};
use glam::DVec3;

/// SplitMix64 (Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators, 2014).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// In [from, to).
    pub(crate) fn within(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// 0 .. n.
    pub(crate) fn choice(&mut self, n: u64) -> u64 {
        self.bits() % n
    }

    /// As likely between 1e-3 and 1e-2 as between 1 and 10, for decades `from` to `to`.
    pub(crate) fn decades(&mut self, from: f64, to: f64) -> f64 {
        10.0_f64.powf(self.within(from, to))
    }

    pub(crate) fn direction(&mut self) -> DVec3 {
        loop {
            let v = DVec3::new(self.within(-1.0, 1.0), self.within(-1.0, 1.0), self.within(-1.0, 1.0));
            if (0.01..1.0).contains(&v.length()) {
                return v.normalize();
            }
        }
    }

    pub(crate) fn vector(&mut self, size: f64) -> DVec3 {
        self.direction() * self.within(0.0, size)
    }
}

/// The open segment or ray from `from` along `along`, of parameters in (0, `to`).
#[derive(Clone, Copy)]
struct Ray {
    from: DVec3,
    along: DVec3,
    to: f64,
}

/// The occluder, a bit larger (`grow` > 0) or smaller, in metres in every direction.
pub(crate) fn grown(shape: &Shape, grow: f64) -> Shape {
    match *shape {
        Shape::Sphere(s) => Shape::Sphere(Sphere { radius: s.radius + grow, ..s }),
        Shape::Disc(d) => Shape::Disc(Disc { radius: d.radius + grow, ..d }),
        Shape::Cone(c) => {
            // Every face moves out by `grow`: the base down, the side along its normal.
            let slant = c.radius.hypot(c.height);
            let apex = c.apex() + c.axis * (grow * slant / c.radius);
            let base_center = c.base_center - c.axis * grow;
            let height = c.axis.dot(apex - base_center);
            Shape::Cone(Cone { base_center, height, radius: height * c.radius / c.height, ..c })
        }
        Shape::Triangle(Triangle { vertices: [a, b, c] }) => {
            // Every side moves out by `grow`.
            let (la, lb, lc) = (b.distance(c), c.distance(a), a.distance(b));
            let incenter = (a * la + b * lb + c * lc) / (la + lb + lc);
            let inradius = (b - a).cross(c - a).length() / (la + lb + lc);
            let scale = 1.0 + grow / inradius;
            Shape::Triangle(Triangle { vertices: [a, b, c].map(|p| incenter + (p - incenter) * scale) })
        }
        Shape::Rectangle(r) => Shape::Rectangle(Rectangle {
            half_right: r.half_right + r.half_right.normalize() * grow,
            half_forward: r.half_forward + r.half_forward.normalize() * grow,
            ..r
        }),
        Shape::Plane(p) => Shape::Plane(p),
        _ => unreachable!("a shape that this test does not know"),
    }
}

/// Whether the way from `point` to the light is blocked.
pub(crate) fn blocked(shape: &Shape, light: &Light, point: DVec3) -> bool {
    let ray = match *light {
        Light::Point { position } | Light::Spot { position, .. } => {
            Ray { from: point, along: position - point, to: 1.0 }
        }
        Light::Directional { direction } => Ray { from: point, along: -direction, to: f64::INFINITY },
    };
    match shape {
        Shape::Sphere(s) => hits_sphere(&ray, s),
        Shape::Disc(d) => hits_flat(&ray, d.center, d.normal)
            .is_some_and(|p| p.distance_squared(d.center) < d.radius * d.radius),
        Shape::Triangle(t) => hits_triangle(&ray, t.vertices),
        Shape::Rectangle(r) => {
            let [a, b, c, d] = r.corners();
            hits_triangle(&ray, [a, b, c]) || hits_triangle(&ray, [a, c, d])
        }
        Shape::Cone(c) => hits_cone(&ray, c),
        Shape::Plane(p) => hits_flat(&ray, p.normal * p.offset, p.normal).is_some(),
        _ => unreachable!("a shape that this test does not know"),
    }
}

/// Whether the point nearest to the centre is inside.
fn hits_sphere(ray: &Ray, sphere: &Sphere) -> bool {
    let t = (sphere.center - ray.from).dot(ray.along) / ray.along.length_squared();
    let nearest = ray.from + ray.along * t.clamp(0.0, ray.to);
    nearest.distance_squared(sphere.center) < sphere.radius * sphere.radius
}

/// Where the ray crosses a plane.
fn hits_flat(ray: &Ray, point: DVec3, normal: DVec3) -> Option<DVec3> {
    let t = (point - ray.from).dot(normal) / ray.along.dot(normal);
    (t > 0.0 && t < ray.to).then(|| ray.from + ray.along * t)
}

fn hits_triangle(ray: &Ray, [a, b, c]: [DVec3; 3]) -> bool {
    let normal = (b - a).cross(c - a);
    hits_flat(ray, a, normal).is_some_and(|p| {
        let side = |a: DVec3, b: DVec3| (b - a).cross(p - a).dot(normal) > 0.0;
        side(a, b) && side(b, c) && side(c, a)
    })
}

/// In the cone's own coordinates: over the heights that the ray passes, the distance from the axis
/// squared less the cone's radius squared there is a quadratic, and a negative value is inside.
fn hits_cone(ray: &Ray, cone: &Cone) -> bool {
    let relative = ray.from - cone.base_center;
    let (z0, dz) = (relative.dot(cone.axis), ray.along.dot(cone.axis));
    let (flat0, dflat) = (relative - cone.axis * z0, ray.along - cone.axis * dz);
    if dz == 0.0 && (z0 <= 0.0 || z0 >= cone.height) {
        return false;
    }
    // The part of the ray between base and apex; not farther than matters to any cone.
    let (mut t0, mut t1) = (0.0_f64, ray.to.min(1e9));
    if dz != 0.0 {
        let (a, b) = (-z0 / dz, (cone.height - z0) / dz);
        (t0, t1) = (t0.max(a.min(b)), t1.min(a.max(b)));
    }
    if t0 >= t1 {
        return false;
    }
    let slope = cone.radius / cone.height;
    let value = |t: f64| {
        let limit = (cone.height - (z0 + dz * t)) * slope;
        (flat0 + dflat * t).length_squared() - limit * limit
    };
    // The least value on [t0, t1]: at an end or at the vertex of the quadratic.
    let second = dflat.length_squared() - dz * dz * slope * slope;
    let first = 2.0 * (flat0.dot(dflat) + (cone.height - z0) * dz * slope * slope);
    let vertex = (-first / (2.0 * second)).clamp(t0, t1);
    let least = value(t0).min(value(t1));
    (if second > 0.0 { least.min(value(vertex)) } else { least }) < 0.0
}

/// A unit vector along which a small step of the light changes most: across a flat occluder, out of
/// a cone's base.
pub(crate) fn normal(shape: &Shape) -> DVec3 {
    match *shape {
        Shape::Sphere(_) => DVec3::X,
        Shape::Disc(d) => d.normal,
        Shape::Cone(c) => c.axis,
        Shape::Triangle(Triangle { vertices: [a, b, c] }) => (b - a).cross(c - a).normalize_or_zero(),
        Shape::Rectangle(r) => r.half_right.cross(r.half_forward).normalize_or_zero(),
        Shape::Plane(p) => p.normal,
        _ => unreachable!("a shape that this test does not know"),
    }
}

/// The light, moved if it has a position.
pub(crate) fn moved(light: &Light, by: DVec3) -> Light {
    match *light {
        Light::Point { position } => Light::Point { position: position + by },
        Light::Spot { position, direction, outer_angle } => {
            Light::Spot { position: position + by, direction, outer_angle }
        }
        light => light,
    }
}
