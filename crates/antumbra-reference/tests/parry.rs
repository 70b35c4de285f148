//! Every shape that parry3d has, ray against ray: the crate parry3d-f64 casts each of them by code of its own (GJK
//! for cone and cylinder, closed forms for the rest).
//!
//! Two numbers judge a ray. A distance may differ by `tolerance` of the shape's size, measured along the surface
//! normal (so divided by the cosine of incidence). A hit against a miss is accepted only for a grazing ray: one that
//! misses the shape shrunk by `grazing` and hits the shape grown by it.

mod common;

use antumbra_reference::{Ray, intersect::Body};
use antumbra_scene::{Pose, Shape};
use common::{Implicit, Random, awkward, first_crossing, primitive};
use glam::{DQuat, DVec3};
use parry3d_f64::{
    math::{Pose as Isometry, Rotation, Vector},
    query::{Ray as Cast, RayCast},
    shape::{Ball, Capsule, Cone, Cuboid, Cylinder, HalfSpace, TriMesh, Triangle},
};

const RAYS: usize = 30_000;

/// parry's closed forms, and ours: both are good to rounding, about 1e-15, amplified by rays that start 1e3 sizes away
/// and by transforms: 7e-13 at most.
const CLOSED_FORM: Judge = Judge { tolerance: 1e-12, grazing: 1e-10 };

/// parry's GJK usually stops within this, but not always: it walks past edges and apexes, by up to 5 % of the size.
/// Where it disagrees by more, walking along the ray decides who is right, and it must not be needed often.
const GJK: Judge = Judge { tolerance: 1e-6, grazing: 1e-5 };

/// parry's ball solves b² - ac, which cancels from 1e3 radii away: 1e6 times rounding, and some.
const BALL: Judge = Judge { tolerance: 5e-10, grazing: 1e-8 };

#[derive(Clone, Copy)]
struct Judge {
    tolerance: f64,
    grazing: f64,
}

fn vector(v: DVec3) -> Vector {
    Vector::from_array(v.to_array())
}

/// Holds `RAYS` rays against parry, for poses and sizes from `make`: it gives our shape at a scale, parry's, and half
/// extents.
fn hold(
    judge: Judge,
    seed: u64,
    make: impl Fn(&mut Random) -> (Box<dyn Fn(f64) -> Shape>, Box<dyn RayCast>, DVec3),
) {
    hold_or_walk(judge, seed, |random| {
        let (shape, theirs, extents) = make(random);
        (shape, theirs, extents, None)
    });
}

/// As `hold`, with a function that is negative inside the shape for disagreements.
fn hold_or_walk(
    judge: Judge,
    seed: u64,
    make: impl Fn(&mut Random) -> (Box<dyn Fn(f64) -> Shape>, Box<dyn RayCast>, DVec3, Option<Implicit>),
) {
    let mut random = Random::new(seed);
    let (mut hits, mut misses, mut grazing, mut walked) = (0, 0, 0, 0);
    let mut worst: f64 = 0.0;
    for _ in 0..RAYS / 100 {
        let (shape, theirs, extents, implicit) = make(&mut random);
        let size = extents.max_element();
        let pose = Pose { translation: random.cube() * 10.0, rotation: random.rotation() };
        let isometry =
            Isometry::from_parts(vector(pose.translation), Rotation::from_array(pose.rotation.to_array()));
        let at_scale = |scale: f64| Body::new(&primitive(shape(scale), pose));
        let body = at_scale(1.0);
        for _ in 0..100 {
            let local = awkward(&mut random, extents);
            let ray = Ray::new(pose.point(local.origin), pose.direction(local.direction));
            let cast = Cast::new(vector(ray.origin), vector(ray.direction));
            let speed = ray.direction.length();
            // 0 for a ray that starts inside, where we ask for the way out.
            let (their_t, from_inside) = match theirs.cast_ray(&isometry, &cast, f64::MAX, true) {
                Some(t) => (Some(t), t == 0.0),
                None => (None, false),
            };
            let our = body.nearest(&ray);
            assert_eq!(our.is_some(), body.blocks(&ray), "nearest and blocks differ on {ray:?}");
            match (our, their_t) {
                (Some(hit), Some(_)) if from_inside => {
                    assert!(
                        body.blocks(&Ray { max: 1e-9 * size / speed, ..ray }),
                        "inside, but free: {ray:?}"
                    );
                    assert!(hit.normal.dot(ray.direction) > 0.0, "leaves against the normal: {ray:?}");
                    hits += 1;
                }
                (Some(hit), Some(t)) => {
                    let cosine = (hit.normal.dot(ray.direction) / speed).abs();
                    let error = (hit.t - t).abs() * speed * cosine / size;
                    if error <= judge.tolerance {
                        worst = worst.max(error);
                    } else if let Some(implicit) = &implicit {
                        walked += 1;
                        let verdict = first_crossing(implicit, &local, Some(hit.t), extents.length());
                        assert_eq!(verdict, Ok(()), "{:?}: {} against {t}; {local:?}", shape(1.0), hit.t);
                    } else {
                        panic!(
                            "{:?}: {} against {t}, off by {error:e} of its size, cosine {cosine:e}; {local:?}",
                            shape(1.0),
                            hit.t
                        );
                    }
                    hits += 1;
                }
                (None, None) => misses += 1,
                (our, their) => {
                    let (small, large) = (at_scale(1.0 - judge.grazing), at_scale(1.0 + judge.grazing));
                    if !small.blocks(&ray) && large.blocks(&ray) {
                        grazing += 1;
                    } else if let Some(implicit) = &implicit {
                        walked += 1;
                        let verdict =
                            first_crossing(implicit, &local, our.map(|hit| hit.t), extents.length());
                        assert_eq!(verdict, Ok(()), "{:?}: {our:?} against {their:?}; {local:?}", shape(1.0));
                    } else {
                        panic!("{:?}: {our:?} against {their:?}, and not grazing; {local:?}", shape(1.0));
                    }
                }
            }
        }
    }
    println!(
        "{hits} hits, {misses} misses, {grazing} grazing, {walked} walked; worst distance {worst:e} of the size"
    );
    assert!(hits > RAYS / 20 && misses > RAYS / 50, "{hits} hits and {misses} misses: a lopsided test");
    assert!(grazing <= RAYS / 50, "{grazing} rays called grazing");
    assert!(walked <= RAYS / 50, "{walked} rays needed walking");
}

#[test]
fn sphere() {
    hold(BALL, 1, |random| {
        let radius = random.size();
        (
            Box::new(move |scale| Shape::Sphere { radius: radius * scale }),
            Box::new(Ball::new(radius)),
            DVec3::splat(radius),
        )
    });
}

#[test]
fn cuboid() {
    hold(CLOSED_FORM, 2, |random| {
        let half = DVec3::new(random.size(), random.size(), random.size());
        (
            Box::new(move |scale| Shape::Box { size: 2.0 * half * scale }),
            Box::new(Cuboid::new(vector(half))),
            half,
        )
    });
}

#[test]
fn capsule() {
    hold(CLOSED_FORM, 3, |random| {
        let (radius, half_height) = (random.size(), random.size());
        (
            Box::new(move |scale| Shape::Capsule {
                radius: radius * scale,
                height: 2.0 * half_height * scale,
            }),
            Box::new(Capsule::new_y(half_height, radius)),
            DVec3::new(radius, radius + half_height, radius),
        )
    });
}

#[test]
fn cylinder() {
    hold_or_walk(GJK, 4, |random| {
        let (radius, half_height) = (random.size(), random.size());
        (
            Box::new(move |scale| Shape::Cylinder {
                radius: radius * scale,
                height: 2.0 * half_height * scale,
                radius_top: radius * scale,
            }),
            Box::new(Cylinder::new(half_height, radius)),
            DVec3::new(radius, half_height, radius),
            Some(Box::new(move |p| (p.x.hypot(p.z) - radius).max(p.y.abs() - half_height))),
        )
    });
}

#[test]
fn cone() {
    hold_or_walk(GJK, 5, |random| {
        let (radius, half_height) = (random.size(), random.size());
        (
            Box::new(move |scale| Shape::Cone { radius: radius * scale, height: 2.0 * half_height * scale }),
            Box::new(Cone::new(half_height, radius)),
            DVec3::new(radius, half_height, radius),
            Some(Box::new(move |p| {
                // Across the side: the profile falls by `radius` over the height.
                let slant = radius.hypot(2.0 * half_height);
                let side = (p.x.hypot(p.z) * 2.0 * half_height + (p.y - half_height) * radius) / slant;
                side.max(p.y.abs() - half_height)
            })),
        )
    });
}

#[test]
fn triangle() {
    hold(CLOSED_FORM, 6, |random| {
        let size = random.size();
        let vertices = [(); 3].map(|()| random.cube() * size);
        let center = (vertices[0] + vertices[1] + vertices[2]) / 3.0;
        let [a, b, c] = vertices.map(vector);
        (
            Box::new(move |scale| Shape::Triangle {
                vertices: vertices.map(|v| center + (v - center) * scale),
            }),
            Box::new(Triangle::new(a, b, c)),
            DVec3::splat(size),
        )
    });
}

#[test]
fn mesh() {
    hold(CLOSED_FORM, 7, |random| {
        let size = random.size();
        let (positions, triangles) = common::bumpy_ball(random, size);
        let theirs = TriMesh::new(positions.iter().map(|&p| vector(p)).collect(), triangles.clone())
            .expect("a valid mesh");
        (
            Box::new(move |scale| {
                common::mesh(positions.iter().map(|&p| p * scale).collect(), triangles.clone())
            }),
            Box::new(theirs),
            DVec3::splat(size),
        )
    });
}

/// parry's half space is solid, the plane is not: rays from above agree, rays from below must hit the plane from
/// behind exactly when their mirror images hit from above.
#[test]
fn plane() {
    let mut random = Random::new(8);
    let mut hits = 0;
    for _ in 0..RAYS {
        let pose = Pose { translation: random.cube() * 10.0, rotation: random.rotation() };
        let body = Body::new(&primitive(Shape::Plane, pose));
        let isometry =
            Isometry::from_parts(vector(pose.translation), Rotation::from_array(pose.rotation.to_array()));
        let theirs = HalfSpace::new(Vector::Y);
        let mut local = awkward(&mut random, DVec3::ONE);
        local.origin.y = local.origin.y.abs() + 1e-3;
        let mirror = |v: DVec3| DVec3::new(v.x, -v.y, v.z);
        let world = |o: DVec3, d: DVec3| Ray::new(pose.point(o), pose.direction(d));
        let ray = world(local.origin, local.direction);
        let below = world(mirror(local.origin), mirror(local.direction));
        let t =
            theirs.cast_ray(&isometry, &Cast::new(vector(ray.origin), vector(ray.direction)), f64::MAX, true);
        for ray in [ray, below] {
            let our = body.nearest(&ray).map(|hit| hit.t);
            match (our, t) {
                // Errors of 1e-14 in the origin and 1e-16 in the direction, whose lever is the distance.
                (Some(a), Some(b)) => {
                    let slope = pose.rotation.inverse().mul_vec3(ray.direction).y.abs();
                    let bound = 1e-14 * (100.0 + a * ray.direction.length());
                    assert!((a - b).abs() * slope <= bound, "{a} against {b} on {ray:?}");
                    hits += 1;
                }
                (None, None) => {}
                (a, b) => {
                    let slope = local.direction.y / local.direction.length();
                    assert!(slope.abs() < 1e-12, "{a:?} against {b:?} on {ray:?}");
                }
            }
        }
    }
    assert!(hits > RAYS / 4, "only {hits} hits");
}

/// A rotation by nothing in particular, to be sure that both sides read quaternions alike.
#[test]
fn quaternions_mean_the_same() {
    let rotation = DQuat::from_xyzw(0.1, -0.4, 0.3, 0.8).normalize();
    let theirs = Rotation::from_array(rotation.to_array()) * Vector::new(1.0, 2.0, 3.0);
    let ours = rotation * DVec3::new(1.0, 2.0, 3.0);
    assert!((DVec3::from_array(theirs.to_array()) - ours).length() < 1e-14, "{theirs} against {ours}");
}
