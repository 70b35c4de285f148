//! Every solid against its implicit function, by walking along each ray: the one method that works for all of them,
//! torus, ellipsoid and frustum included, and has nothing in common with solving for the crossing.
//!
//! A crossing must lie on the surface to 1e-13 of the size (plus 1e-14 of the distance it was seen from), and nothing
//! before it may be on the other side of the surface by more than ten times that.

mod common;

use antumbra_reference::{Ray, intersect::Body};
use antumbra_scene::{Pose, Shape};
use common::{Implicit, Random, awkward, first_crossing, primitive};
use glam::DVec3;
use parry3d_f64::{
    math::Vector,
    query::{Ray as Cast, RayCast},
    shape::Ball,
};

const RAYS: usize = 30_000;

fn hold(seed: u64, make: impl Fn(&mut Random) -> (Shape, Implicit, DVec3)) {
    let mut random = Random::new(seed);
    let (mut hits, mut misses) = (0, 0);
    for _ in 0..RAYS / 100 {
        let (shape, implicit, extents) = make(&mut random);
        let body = Body::new(&primitive(shape.clone(), Pose::IDENTITY));
        for _ in 0..100 {
            let ray = awkward(&mut random, extents);
            let hit = body.nearest(&ray);
            let verdict = first_crossing(&implicit, &ray, hit.map(|hit| hit.t), extents.length());
            assert_eq!(verdict, Ok(()), "{shape:?}, {ray:?}");
            assert_eq!(hit.is_some(), body.blocks(&ray), "nearest and blocks differ: {shape:?}, {ray:?}");
            match hit {
                Some(hit) => {
                    hits += 1;
                    check_normal(&implicit, &ray, hit.t, hit.normal, extents, &shape);
                }
                None => misses += 1,
            }
        }
    }
    println!("{hits} hits, {misses} misses");
    assert!(hits > RAYS / 10 && misses > RAYS / 50, "{hits} hits and {misses} misses: a lopsided test");
}

/// The normal is a unit vector that leads out: a short way along it the function has grown, and it has shrunk a
/// short way back.
fn check_normal(implicit: &Implicit, ray: &Ray, t: f64, normal: DVec3, extents: DVec3, shape: &Shape) {
    assert!((normal.length() - 1.0).abs() < 1e-12, "normal {normal}");
    let (p, step) = (ray.at(t), 1e-7 * extents.min_element());
    if ray.origin.length() < 100.0 * extents.max_element() {
        assert!(implicit(p + normal * step) > 0.0, "{shape:?}: no way out along {normal} at {p}");
        let across = implicit(p - normal * step);
        assert!(
            across < 0.0 || at_an_edge(implicit, p, step),
            "{shape:?}: no way in against {normal} at {p}"
        );
    }
}

/// Whether the surface near `p` is an edge or apex, where a step against one face's normal may leave by another.
fn at_an_edge(implicit: &Implicit, p: DVec3, step: f64) -> bool {
    let gradient = |p: DVec3| {
        let along = |axis: DVec3| implicit(p + axis * step) - implicit(p - axis * step);
        DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z)).normalize_or_zero()
    };
    let here = gradient(p);
    [DVec3::X, DVec3::Y, DVec3::Z].iter().any(|&axis| {
        gradient(p + axis * 3.0 * step).dot(here) < 0.99 || gradient(p - axis * 3.0 * step).dot(here) < 0.99
    })
}

fn frustum(bottom: f64, top: f64, half: f64) -> Implicit {
    Box::new(move |p: DVec3| {
        let slope = (top - bottom) / (2.0 * half);
        let side = (p.x.hypot(p.z) - 0.5 * (top + bottom) - slope * p.y) / 1f64.hypot(slope);
        side.max(p.y.abs() - half)
    })
}

#[test]
fn sphere() {
    hold(1, |random| {
        let radius = random.size();
        (Shape::Sphere { radius }, Box::new(move |p| p.length() - radius), DVec3::splat(radius))
    });
}

#[test]
fn ellipsoid() {
    hold(2, |random| {
        let radii = DVec3::new(random.size(), random.size(), random.size());
        // Scaled by the smallest axis, so that it is no steeper than a distance.
        let implicit = move |p: DVec3| ((p / radii).length() - 1.0) * radii.min_element();
        (Shape::Ellipsoid { radii }, Box::new(implicit), radii)
    });
}

#[test]
fn cone() {
    hold(3, |random| {
        let (radius, half) = (random.size(), random.size());
        let shape = Shape::Cone { radius, height: 2.0 * half };
        (shape, frustum(radius, 0.0, half), DVec3::new(radius, half, radius))
    });
}

#[test]
fn cylinder_and_frustum() {
    hold(4, |random| {
        let (radius, half) = (random.size(), random.size());
        let radius_top =
            [radius, random.size(), radius * (1.0 + 1e-9 * random.signed()), 0.0][random.below(4)];
        let shape = Shape::Cylinder { radius, height: 2.0 * half, radius_top };
        let widest = radius.max(radius_top);
        (shape, frustum(radius, radius_top, half), DVec3::new(widest, half, widest))
    });
}

#[test]
fn capsule() {
    hold(5, |random| {
        let (radius, half) = (random.size(), random.size());
        let implicit = move |p: DVec3| (p - DVec3::Y * p.y.clamp(-half, half)).length() - radius;
        let shape = Shape::Capsule { radius, height: 2.0 * half };
        (shape, Box::new(implicit), DVec3::new(radius, radius + half, radius))
    });
}

#[test]
fn cuboid() {
    hold(6, |random| {
        let half = DVec3::new(random.size(), random.size(), random.size());
        (Shape::Box { size: 2.0 * half }, Box::new(move |p| (p.abs() - half).max_element()), half)
    });
}

#[test]
fn torus() {
    hold(7, |random| {
        let major_radius = random.size();
        // Rings down to a thousandth of their size thick, and one without a hole.
        let minor_radius = major_radius * [random.between(0.05, 1.0), 1e-3, 1.0][random.below(3)];
        let implicit = move |p: DVec3| (p.x.hypot(p.z) - major_radius).hypot(p.y) - minor_radius;
        let wide = major_radius + minor_radius;
        (
            Shape::Torus { major_radius, minor_radius },
            Box::new(implicit),
            DVec3::new(wide, minor_radius, wide),
        )
    });
}

/// All four crossings of rays through both sides of a ring, one after the other.
#[test]
fn torus_crossings_alternate() {
    let mut random = Random::new(8);
    let (mut fours, mut twos) = (0, 0);
    for _ in 0..RAYS {
        let (major_radius, minor_radius) = (1.0, random.between(0.01, 0.99));
        let body = Body::new(&primitive(Shape::Torus { major_radius, minor_radius }, Pose::IDENTITY));
        let extents = DVec3::new(1.0 + minor_radius, minor_radius, 1.0 + minor_radius);
        let target = random.cube() * extents * 0.8;
        let origin = (random.unit() * DVec3::new(1.0, 0.2, 1.0)).normalize() * 4.0;
        let mut ray = Ray::new(origin, (target - origin).normalize());
        let mut crossings: usize = 0;
        while let Some(hit) = body.nearest(&ray) {
            let outwards = hit.normal.dot(ray.direction) > 0.0;
            assert_eq!(outwards, crossings % 2 == 1, "crossing {crossings} of {ray:?} goes the wrong way");
            crossings += 1;
            ray.min = hit.t + 1e-12;
            assert!(crossings <= 4, "a line meets a torus four times at most: {ray:?}");
        }
        assert_eq!(crossings % 2, 0, "in and not out: {ray:?}");
        fours += usize::from(crossings == 4);
        twos += usize::from(crossings == 2);
    }
    assert!(fours > RAYS / 20 && twos > RAYS / 20, "{fours} with four crossings, {twos} with two");
}

/// An ellipsoid is a ball under an affine map, which keeps the ray's parameter: parry casts on the ball.
#[test]
fn ellipsoid_is_a_mapped_ball() {
    let mut random = Random::new(9);
    let (mut hits, mut worst) = (0, 0f64);
    for _ in 0..RAYS {
        let radii = DVec3::new(random.size(), random.size(), random.size());
        let origin = random.unit() * radii.max_element() * random.between(1.5, 20.0);
        let direction = random.cube() * radii - origin;
        let ours = Body::new(&primitive(Shape::Ellipsoid { radii }, Pose::IDENTITY))
            .nearest(&Ray::new(origin, direction));
        let mapped = |v: DVec3| Vector::from_array((v / radii).to_array());
        let theirs =
            Ball::new(1.0).cast_local_ray(&Cast::new(mapped(origin), mapped(direction)), f64::MAX, false);
        match (ours, theirs) {
            (Some(a), Some(b)) => {
                hits += 1;
                let cosine = (a.normal.dot(direction) / direction.length()).abs();
                worst = worst.max((a.t - b).abs() * cosine);
            }
            (None, None) => {}
            // At most twenty radii times a hundredfold squash away: parry's b² - ac is good to 1e-9 of the radius.
            (ours, _) => {
                let large =
                    Body::new(&primitive(Shape::Ellipsoid { radii: radii * (1.0 + 1e-9) }, Pose::IDENTITY));
                let small =
                    Body::new(&primitive(Shape::Ellipsoid { radii: radii * (1.0 - 1e-9) }, Pose::IDENTITY));
                let ray = Ray::new(origin, direction);
                assert!(
                    large.blocks(&ray) && !small.blocks(&ray),
                    "{ours:?} against {theirs:?} for {radii}, {ray:?}"
                );
            }
        }
    }
    println!("{hits} hits, worst {worst:e}");
    assert!(hits > RAYS / 3, "only {hits} hits");
    assert!(worst < 1e-9, "off by {worst:e} of the way");
}

/// Disc and rectangle are the plane, cut: the crossing is where y changes sign, which bisection finds.
#[test]
fn disc_and_rectangle() {
    let mut random = Random::new(10);
    let mut hits = 0;
    for _ in 0..RAYS {
        let (a, b) = (random.size(), random.size());
        let (shape, outside): (_, Implicit) = if random.below(2) == 0 {
            (Shape::Disc { radius: a }, Box::new(move |p| p.x.hypot(p.z) - a))
        } else {
            let shape = Shape::Rectangle { width: 2.0 * a, depth: 2.0 * b };
            (shape, Box::new(move |p| (p.x.abs() - a).max(p.z.abs() - b)))
        };
        let ray = awkward(&mut random, DVec3::new(a, a.min(b), b));
        let our = Body::new(&primitive(shape.clone(), Pose::IDENTITY)).nearest(&ray);
        let (mut low, mut high) = (0.0, 1e4);
        if ray.origin.y * ray.at(high).y >= 0.0 {
            assert!(
                our.is_none() || ray.origin.y == 0.0 || our.is_some_and(|h| h.t > high),
                "{shape:?}, {ray:?}"
            );
            continue;
        }
        for _ in 0..200 {
            let middle: f64 = 0.5 * (low + high);
            if ray.at(middle).y * ray.origin.y > 0.0 { low = middle } else { high = middle }
        }
        let p = ray.at(low);
        let rounding = 1e-13 * (p.length() + ray.origin.length());
        match our {
            Some(hit) => {
                hits += 1;
                assert!(
                    (ray.at(hit.t) - p).length()
                        <= 2.0 * rounding / (ray.direction.y.abs() / ray.direction.length()),
                    "{} against {low} on {shape:?}, {ray:?}",
                    hit.t
                );
                assert!(outside(p) <= rounding, "{shape:?} hit outside at {p}");
            }
            None => assert!(outside(p) >= -rounding, "{shape:?} missed inside at {p}, {ray:?}"),
        }
    }
    assert!(hits > RAYS / 10, "only {hits} hits");
}
