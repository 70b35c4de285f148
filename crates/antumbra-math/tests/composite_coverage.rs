//! How much of a pixel a part of a shadow covers: against points, and next to shadows far larger than
//! their objects.

mod plane_shadow_support;

use antumbra_math::blocking::Footprint;
use antumbra_math::composite::{PartShape, PlacedPart, part_coverage};
use antumbra_math::{Plane, PlaneFrame};
use glam::{DVec2, DVec3};
use plane_shadow_support::Random;

/// A disc or a triangle of about a metre.
fn part(random: &mut Random) -> PartShape {
    let mut point = || DVec2::new(random.within(-2.0, 2.0), random.within(-2.0, 2.0));
    let vertices = [point(), point(), point()];
    if random.choice(2) == 0 {
        PartShape::Disc { center: vertices[0], radius: random.within(0.2, 1.5) }
    } else {
        PartShape::Triangle { vertices }
    }
}

fn frame(random: &mut Random) -> PlaneFrame {
    let plane = Plane::through(random.vector(4.0), random.direction());
    PlaneFrame::of_plane(&plane).expect("a plane")
}

#[test]
fn points_are_in_or_out() {
    let mut random = Random(71);
    let (mut inside, mut all) = (0, 0);
    for _ in 0..20_000 {
        let (part, frame) = (part(&mut random), frame(&mut random));
        let Some(placed) = PlacedPart::new(&part, &frame) else { panic!("{part:?} has an area") };
        let at = DVec2::new(random.within(-2.0, 2.0), random.within(-2.0, 2.0));
        let coverage = part_coverage(&placed, &Footprint::point(frame.point(at)));
        assert_eq!(coverage, if part.contains(at) { 1.0 } else { 0.0 }, "{part:?} at {at}");
        inside += i32::from(part.contains(at));
        all += 1;
    }
    assert!(inside * 10 > all && inside * 10 < all * 9, "{inside} of {all} are inside");
}

/// Pixels of a fortieth of a metre against 32 x 32 points each.
#[test]
fn pixels_are_covered_by_their_area() {
    let mut random = Random(72);
    let (mut square, mut edges, mut worst) = (0.0, 0.0, 0.0_f64);
    for _ in 0..200_000 {
        let (part, frame) = (part(&mut random), frame(&mut random));
        let Some(placed) = PlacedPart::new(&part, &frame) else { panic!("{part:?} has an area") };
        let at = DVec2::new(random.within(-2.0, 2.0), random.within(-2.0, 2.0));
        let (dx, dy) = (DVec2::new(0.025, 0.004), DVec2::new(-0.006, 0.03));
        let vector = |v: DVec2| frame.u * v.x + frame.v * v.y;
        let footprint = Footprint { point: frame.point(at), dx: vector(dx), dy: vector(dy) };
        // What is far from every edge is told by the pixel's corners and its middle.
        let reach =
            [(-0.5, -0.5), (0.5, -0.5), (-0.5, 0.5), (0.5, 0.5)].map(|(u, v)| at + (dx * u + dy * v) * 1.2);
        if reach.iter().all(|&p| part.contains(p) == part.contains(at)) {
            continue;
        }
        let of = |i: u32| (f64::from(i) + 0.5) / 32.0 - 0.5;
        let points = (0..1024).map(|i| at + dx * of(i % 32) + dy * of(i / 32));
        let sampled = points.filter(|&p| part.contains(p)).count() as f64 / 1024.0;
        if !(0.001..0.999).contains(&sampled) {
            continue;
        }
        let coverage = part_coverage(&placed, &footprint);
        assert!((0.0..=1.0).contains(&coverage), "{coverage} of {part:?}");
        square += (coverage - sampled) * (coverage - sampled);
        edges += 1.0;
        worst = worst.max((coverage - sampled).abs());
    }
    let rms = f64::sqrt(square / edges);
    assert!(edges > 1500.0, "{edges} pixels with an edge");
    // Straight edges are exact but for the points' own 0.01; corners, and triangles that are slivers,
    // are not: as for blockers (blocking_coverage).
    assert!(rms < 0.016 && worst < 0.5, "{rms} rms, {worst} at worst, of {edges}");
}

/// In float32, next to the edge of a disc of a million kilometres that passes a few metres from the
/// eye: right to some roundings of those metres.
#[test]
fn huge_discs_keep_their_edges() {
    let frame = PlaneFrame::of_plane(&Plane::through(-DVec3::Y, DVec3::Y)).expect("a plane");
    let mut random = Random(73);
    for _ in 0..2000 {
        let radius = random.decades(0.0, 9.0);
        let away = DVec2::from_angle(random.within(0.0, std::f64::consts::TAU));
        let edge = away * random.within(-5.0, 5.0);
        let disc = PartShape::Disc { center: edge - away * radius, radius };
        let placed = PlacedPart::new(&disc, &frame).expect("a disc").to_f32();
        let along = away.perp() * random.within(-0.5, 0.5);
        for (inwards, expected) in [(1e-4, 1.0), (-1e-4, 0.0)] {
            // Along the arc the edge bends inwards by s² / 2r.
            let bend = radius - (radius * radius - along.length_squared()).max(0.0).sqrt();
            if along.length() >= 0.9 * radius {
                continue;
            }
            let point = frame.point(edge + along - away * (bend + inwards)).as_vec3();
            let coverage = part_coverage(&placed, &Footprint::point(point));
            assert_eq!(coverage, expected, "radius {radius}, {inwards} inwards");
        }
    }
}

#[test]
fn what_has_no_place_is_none() {
    let frame = PlaneFrame::of_plane(&Plane::through(DVec3::ZERO, DVec3::Y)).expect("a plane");
    let point = PartShape::Triangle { vertices: [DVec2::ONE; 3] };
    assert_eq!(PlacedPart::new(&point, &frame), None, "a point");
    let disc = PartShape::Disc { center: DVec2::NAN, radius: 1.0 };
    assert_eq!(PlacedPart::new(&disc, &frame), None, "nowhere");
    let disc = PartShape::Disc { center: DVec2::ZERO, radius: 1.0 };
    let placed = PlacedPart::new(&disc, &frame).expect("a disc");
    assert_eq!(part_coverage(&placed, &Footprint::point(DVec3::NAN)), 0.0, "no point");
    let center = part_coverage(&placed, &Footprint { point: DVec3::ZERO, dx: DVec3::X, dy: DVec3::Z });
    assert_eq!(center, 1.0, "its centre has no direction");
}
