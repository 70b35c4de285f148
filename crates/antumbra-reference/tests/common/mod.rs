//! What the tests share: random numbers that are the same everywhere, and hand-made scenes.
#![allow(
    dead_code,
    unreachable_pub,
    reason = "each test is a crate of its own and uses its own share of this"
)]

use std::sync::Arc;

use antumbra_reference::Ray;
use antumbra_scene::{Camera, Image, Light, LightKind, Mesh, Object, Part, Pose, Primitive, Scene, Shape};
use glam::{DQuat, DVec3};

/// SplitMix64.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In [0, 1).
    pub fn real(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// In [-1, 1).
    pub fn signed(&mut self) -> f64 {
        2.0 * self.real() - 1.0
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.real()
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    /// From 0.05 to 5, evenly in the logarithm.
    pub fn size(&mut self) -> f64 {
        0.05 * 100f64.powf(self.real())
    }

    /// In the cube [-1, 1)³.
    pub fn cube(&mut self) -> DVec3 {
        DVec3::new(self.signed(), self.signed(), self.signed())
    }

    /// Evenly on the unit sphere.
    pub fn unit(&mut self) -> DVec3 {
        loop {
            let v = self.cube();
            if (1e-4..1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        }
    }

    pub fn rotation(&mut self) -> DQuat {
        DQuat::from_axis_angle(self.unit(), self.between(0.0, std::f64::consts::TAU))
    }
}

pub fn primitive(shape: Shape, pose: Pose) -> Primitive {
    Primitive {
        object: 0,
        part: 0,
        shape,
        pose,
        color: DVec3::ONE,
        casts_shadow: true,
        receives_shadow: true,
    }
}

pub fn at(translation: DVec3) -> Pose {
    Pose { translation, rotation: DQuat::IDENTITY }
}

pub fn object(name: &str, shape: Shape, pose: Pose) -> Object {
    Object {
        name: name.into(),
        parts: vec![Part { shape, pose: Pose::IDENTITY }],
        pose,
        color: DVec3::ONE,
        casts_shadow: true,
        receives_shadow: true,
        motion: None,
    }
}

pub fn light(kind: LightKind, position: DVec3, intensity: f64) -> Light {
    Light { name: "light".into(), kind, position, color: DVec3::ONE, intensity, motion: None }
}

/// Looks down on the origin from (0, 6, 8).
pub fn scene(lights: Vec<Light>, objects: Vec<Object>) -> Scene {
    Scene {
        ambient: DVec3::ZERO,
        camera: Camera { eye: DVec3::new(0.0, 6.0, 8.0), target: DVec3::ZERO, up: DVec3::Y, fov_y: 0.8 },
        image: Image { width: 64, height: 48, background: DVec3::splat(0.25), exposure: 1.0 },
        lights,
        objects,
    }
}

pub fn mesh(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Shape {
    Shape::Mesh(Arc::new(Mesh { path: "made.obj".into(), positions, triangles }))
}

/// A closed ball of 16 x 12 quads with a random radius at each vertex, at most `size`.
pub fn bumpy_ball(random: &mut Random, size: f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    ball(16, 12, size, || random.between(0.5, 1.0))
}

/// A closed ball of `columns` x `rows` quads; `bump` scales the radius at each vertex.
pub fn ball(
    columns: u32,
    rows: u32,
    size: f64,
    mut bump: impl FnMut() -> f64,
) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut positions = vec![DVec3::Y * size * bump(), DVec3::NEG_Y * size * bump()];
    for row in 1..rows {
        let theta = std::f64::consts::PI * f64::from(row) / f64::from(rows);
        for column in 0..columns {
            let phi = std::f64::consts::TAU * f64::from(column) / f64::from(columns);
            let p = DVec3::new(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin());
            positions.push(p * size * bump());
        }
    }
    let vertex = |row: u32, column: u32| match row {
        0 => 0,
        row if row == rows => 1,
        row => 2 + (row - 1) * columns + column % columns,
    };
    let mut triangles = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let (a, b) = (vertex(row, column), vertex(row, column + 1));
            let (c, d) = (vertex(row + 1, column), vertex(row + 1, column + 1));
            if row > 0 {
                triangles.push([a, b, c]);
            }
            if row + 1 < rows {
                triangles.push([b, d, c]);
            }
        }
    }
    (positions, triangles)
}

/// A ray for a shape of the given half extents, in the shape's space: three in four are made to be awkward.
pub fn awkward(random: &mut Random, extents: DVec3) -> Ray {
    let size = extents.max_element();
    let within = |random: &mut Random| random.cube() * extents;
    match random.below(8) {
        // From outside to a point near the shape.
        0 | 1 => {
            let origin = random.unit() * size * random.between(2.0, 10.0);
            let target = within(random) * 1.2;
            Ray::new(origin, target - origin)
        }
        // From far away.
        2 => {
            let origin = random.unit() * size * 1e3;
            let target = within(random);
            Ray::new(origin, target - origin)
        }
        // From inside the box around it.
        3 => Ray::new(within(random), random.unit() * random.between(0.1, 10.0)),
        // Along a coordinate axis.
        4 => {
            let mut direction = DVec3::ZERO;
            direction[random.below(3)] = if random.below(2) == 0 { 1.0 } else { -1.0 };
            Ray::new(within(random) * 1.1 - direction * size * 5.0, direction)
        }
        // Nearly along one.
        5 => {
            let mut direction = random.cube() * 1e-9;
            direction[random.below(3)] = 1.0;
            Ray::new(within(random) * 1.1 - direction * size * 5.0, direction)
        }
        // Through the centre, or a hair beside it.
        6 => {
            let target = random.cube() * size * [0.0, 1e-12, 1e-6][random.below(3)];
            let origin = random.unit() * size * 5.0;
            Ray::new(origin, target - origin)
        }
        // Past a face, edge or corner of the box around it: the caps and the apex are there.
        _ => {
            let corner = DVec3::from_array([(); 3].map(|()| [-1.0, 0.0, 1.0][random.below(3)])) * extents;
            let target = corner * (1.0 + random.signed() * [0.0, 1e-12, 1e-6, 1e-3][random.below(4)]);
            let origin = random.unit() * size * 5.0;
            Ray::new(origin, target - origin)
        }
    }
}

/// A function that is negative inside a solid about the origin, positive outside, and no steeper than a distance by
/// much.
pub type Implicit = Box<dyn Fn(DVec3) -> f64>;

/// Whether `t` is where `ray` first crosses the surface where `implicit` vanishes, or `None` if it never does:
/// decided by walking along the ray alone. `size` bounds the solid's distance from the origin.
pub fn first_crossing(implicit: &Implicit, ray: &Ray, t: Option<f64>, size: f64) -> Result<(), String> {
    const STEPS: u32 = 400;
    let speed = ray.direction.length();
    // Rounding where the ray starts, and a hundred times that where it meets the solid.
    let rounding = 1e-13 * size + 1e-14 * ray.origin.length();
    let at = |t: f64| implicit(ray.at(t));
    if let Some(t) = t
        && at(t).abs() > rounding
    {
        return Err(format!("the point at {t} is {:e} off the surface", at(t)));
    }
    let nearest = -ray.origin.dot(ray.direction) / (speed * speed);
    let begin = (nearest - 1.1 * size / speed).max(0.0);
    let end = t.unwrap_or(nearest + 1.1 * size / speed);
    if end <= begin {
        return Ok(());
    }
    let side = if at(0.0) < 0.0 && t.is_some() { -1.0 } else { 1.0 };
    let step = (end - begin) / f64::from(STEPS);
    for i in 0..STEPS {
        // The lowest value of the stretch about this step, by golden sections: no crossing slips between steps.
        let (mut low, mut high) =
            (begin + step * (f64::from(i) - 1.0).max(0.0), begin + step * f64::from(i + 1));
        let middle = 0.5 * (low + high);
        let lowest =
            if side * at(middle) < side * at(low).min(at(high)) || side * at(middle) < 0.1 * step * speed {
                for _ in 0..60 {
                    let (a, b) = (low + 0.381_966 * (high - low), low + 0.618_034 * (high - low));
                    if side * at(a) < side * at(b) { high = b } else { low = a }
                }
                side * at(0.5 * (low + high))
            } else {
                side * at(middle)
            };
        if lowest < -10.0 * rounding {
            return Err(format!("{t:?}, but crossed before {high}, by {lowest:e}"));
        }
    }
    Ok(())
}
