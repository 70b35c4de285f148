//! Silhouettes and the counts of shadow volumes, against rays to the light.

mod plane_shadow_support;

use antumbra_math::TriangleMesh;
use antumbra_math::mesh::{CountRule, Silhouette};
use glam::{DVec3, DVec4};
use plane_shadow_support::Random;

/// Rays that pass this near to an edge, as a fraction of the triangle's size, decide nothing.
const EDGE: f64 = 1e-9;

/// Where a ray meets a triangle: 1 if it leaves through the front, -1 if through the back, 0 for a miss
/// (Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997). `None` near an edge or
/// an end.
fn crossing(from: DVec3, along: DVec3, to: f64, [a, b, c]: [DVec3; 3]) -> Option<i32> {
    let normal = (b - a).cross(c - a);
    if normal == DVec3::ZERO {
        return Some(0);
    }
    let det = along.dot(normal);
    let q = (from - a).cross(along);
    let (u, v, t) = (q.dot(c - a) / -det, q.dot(b - a) / det, (a - from).dot(normal) / det);
    let (near, least) = (t.min(to - t), u.min(v).min(1.0 - u - v));
    if !(det.is_normal() && least.abs() > EDGE && near.abs() > EDGE) {
        // A parallel ray, or one in doubt; but one that misses clearly in another way is no doubt.
        return if least < -EDGE || near < -EDGE { Some(0) } else { None };
    }
    Some(if least < 0.0 || near < 0.0 { 0 } else { det.signum() as i32 })
}

/// The sums of front and back crossings; `None` in doubt.
fn crossings(
    triangles: impl Iterator<Item = [DVec3; 3]>,
    from: DVec3,
    along: DVec3,
    to: f64,
) -> Option<(i32, i32)> {
    let (mut front, mut back) = (0, 0);
    for triangle in triangles {
        match crossing(from, along, to, triangle)? {
            1 => front += 1,
            -1 => back += 1,
            _ => {}
        }
    }
    Some((front, back))
}

fn corners(mesh: &TriangleMesh) -> impl Iterator<Item = [DVec3; 3]> {
    (0..).map_while(|i| mesh.corners(i))
}

/// How far points are pushed, as a multiple of their distance from a light with a position.
const PUSH: f64 = 1e5;

/// Whether the far caps are beyond every point asked about: 4 m from the origin, 13 from a light.
fn reaches(mesh: &TriangleMesh, light: DVec4) -> bool {
    light.w == 0.0
        || corners(mesh).all(|[a, b, c]| {
            let normal = (b - a).cross(c - a).normalize_or_zero();
            let height = normal.dot(light.truncate() / light.w - a).abs();
            normal == DVec3::ZERO || height * PUSH > 13.0
        })
}

/// All triangles of the volume, as the documentation says to make them.
fn volume(mesh: &TriangleMesh, silhouette: &Silhouette, light: DVec4) -> Vec<[DVec3; 3]> {
    let near = |i: u32| mesh.positions()[i as usize];
    let far = |i: u32| {
        let p = near(i);
        if light.w == 0.0 {
            p - light.truncate().normalize() * 1e3
        } else {
            p + (p - light.truncate() / light.w) * PUSH
        }
    };
    let mut triangles = Vec::new();
    for &[a, b, c] in &silhouette.caps {
        triangles.push([near(a), near(b), near(c)]);
        triangles.push([far(c), far(b), far(a)]);
    }
    for &[a, b] in &silhouette.edges {
        triangles.push([near(b), near(a), far(a)]);
        triangles.push([near(b), far(a), far(b)]);
    }
    triangles
}

/// How often a volume winds round a point, by the crossings of a ray in any direction.
fn winding(random: &mut Random, triangles: &[[DVec3; 3]], point: DVec3) -> Option<i32> {
    let (front, back) = crossings(triangles.iter().copied(), point, random.direction(), f64::INFINITY)?;
    Some(front - back)
}

/// Triangles and vertices to change before they become a mesh.
type Parts = (Vec<DVec3>, Vec<[u32; 3]>);

fn parts(mesh: Result<TriangleMesh, antumbra_math::MeshError>) -> Parts {
    let mesh = mesh.expect("a tessellation");
    (mesh.positions().to_vec(), mesh.triangles().to_vec())
}

/// A ball with dents and bumps, which never passes through itself.
fn rock(random: &mut Random) -> Parts {
    let (mut positions, triangles) = parts(TriangleMesh::sphere(1.0, 3 + random.choice(12) as u32));
    for p in &mut positions {
        *p *= random.within(0.5, 1.4);
    }
    (positions, triangles)
}

fn add(parts: &mut Parts, other: &Parts, shift: DVec3) {
    let first = parts.0.len() as u32;
    parts.0.extend(other.0.iter().map(|p| *p + shift));
    parts.1.extend(other.1.iter().map(|t| t.map(|i| i + first)));
}

fn turn(parts: &mut Parts) {
    parts.1.iter_mut().for_each(|t| t.reverse());
}

const KINDS: [&str; 9] = ["rock", "box", "torus", "two", "inverted", "hollow", "open", "soup", "pages"];

fn random_mesh(random: &mut Random, kind: &str) -> TriangleMesh {
    let mut parts = match kind {
        "box" => {
            parts(TriangleMesh::cuboid(DVec3::new(random.within(0.2, 2.0), 1.0, random.within(0.2, 2.0))))
        }
        "torus" => parts(TriangleMesh::torus(0.9, random.within(0.2, 0.8), 3 + random.choice(8) as u32)),
        "soup" | "pages" => {
            let n = 3 + random.choice(20) as u32;
            let points = (0..n).map(|_| random.vector(1.4)).collect();
            // Pages share vertices, and many edges have more than two faces.
            let vertex = |random: &mut Random| {
                random.choice(u64::from(if kind == "pages" { n.min(6) } else { n })) as u32
            };
            (points, (0..n).map(|_| [0; 3].map(|_| vertex(random))).collect())
        }
        _ => rock(random),
    };
    match kind {
        "two" => {
            let other = rock(random);
            let shift = random.vector(2.0);
            add(&mut parts, &other, shift);
        }
        "inverted" => turn(&mut parts),
        "hollow" => {
            let mut inside = parts.clone();
            inside.0.iter_mut().for_each(|p| *p *= 0.7);
            turn(&mut inside);
            add(&mut parts, &inside, DVec3::ZERO);
        }
        "open" => {
            let kept = random.within(0.3, 0.95);
            parts.1.retain(|_| random.within(0.0, 1.0) < kept);
            parts.1.iter_mut().for_each(|t| {
                if random.choice(3) == 0 {
                    t.reverse();
                }
            });
            parts.1.push([0, 1, 2]);
        }
        _ => {}
    }
    TriangleMesh::new(parts.0, parts.1).expect("a mesh")
}

fn check(kind: &str, seed: u64) {
    let mut random = Random(seed);
    let mut out = Silhouette::default();
    let (mut asked, mut decided, mut dark, mut towards) = (0, 0, 0, 0);
    for _ in 0..400 {
        let mesh = random_mesh(&mut random, kind);
        let light = match random.choice(4) {
            0 => random.direction().extend(0.0) * random.decades(-2.0, 2.0),
            1 => random.vector(1.2).extend(1.0), // inside, or among the triangles
            2 => random.direction().extend(1.0) * random.within(1.5, 3.0),
            _ => (random.direction() * random.within(1.5, 8.0)).extend(1.0) * -random.decades(-2.0, 2.0),
        };
        if !reaches(&mesh, light) {
            continue;
        }
        mesh.silhouette(light, &mut out);
        towards += usize::from(out.rule == CountRule::TowardsLight);
        let sides = volume(&mesh, &out, light);
        for _ in 0..12 {
            asked += 1;
            let point = random.vector(4.0);
            let (along, to) = match light.w {
                0.0 => (light.truncate().normalize(), f64::INFINITY),
                w => (light.truncate() / w - point, 1.0),
            };
            let counted = winding(&mut random, &sides, point);
            let crossed = crossings(corners(&mesh), point, along, to);
            let (Some(count), Some((front, back))) = (counted, crossed) else { continue };
            decided += 1;
            // A ray from the point leaves through the front of faces towards the light.
            let expected = match out.rule {
                CountRule::TowardsLight => front,
                CountRule::EveryFace => front + back,
            };
            assert_eq!(count, expected, "{kind}: {front}, {back} at {point}, light {light}, {:?}", out.rule);
            assert_eq!(count > 0, front + back > 0, "{kind}: dark or lit at {point}, light {light}");
            dark += usize::from(count > 0);
        }
    }
    assert!(decided * 100 > asked * 98, "{kind}: {decided} of {asked} decided");
    assert!(dark * 25 > decided, "{kind}: {dark} of {decided} in shadow");
    match kind {
        "rock" | "box" | "torus" | "two" => {
            assert!(towards > 250, "{kind}: {towards} of 400 by half the faces")
        }
        // At random there may be no sides at all, or two triangles back to back.
        "soup" | "pages" => assert!(towards < 20, "{kind}: {towards} closed meshes"),
        _ => assert_eq!(towards, 0, "{kind}: every face counts"),
    }
}

#[test]
fn a_volume_counts_what_rays_to_the_light_cross() {
    for (kind, seed) in KINDS.into_iter().zip(7..) {
        check(kind, seed);
    }
}

#[test]
fn silhouettes_of_known_meshes() {
    let mut out = Silhouette::default();
    let cuboid = TriangleMesh::cuboid(DVec3::ONE).expect("a box");
    cuboid.silhouette(DVec4::Y, &mut out);
    assert_eq!((out.edges.len(), out.caps.len()), (4, 2), "light from above: the top's rim: {out:?}");
    for [a, b] in &out.edges {
        let [a, b] = [a, b].map(|i| cuboid.positions()[*i as usize]);
        assert!(a.y == 0.5 && b.y == 0.5, "{a} to {b} is of the top");
        assert!(a.cross(b).y > 0.0, "{a} to {b} runs counter-clockwise");
    }
    cuboid.silhouette(DVec4::new(3.0, 4.0, 5.0, 1.0), &mut out);
    assert_eq!((out.edges.len(), out.caps.len()), (6, 6), "light from a corner: a hexagon");
    cuboid.silhouette(DVec4::W, &mut out);
    assert_eq!((out.edges.len(), out.caps.len()), (0, 12), "light inside: everywhere outside is dark");
    assert_eq!(out.rule, CountRule::EveryFace, "because no face is towards the light");
    let sheet = TriangleMesh::rectangle(1.0, 1.0).expect("a rectangle");
    for y in [2.0, -2.0] {
        sheet.silhouette(DVec4::new(0.1, y, 0.0, 1.0), &mut out);
        assert_eq!((out.edges.len(), out.caps.len()), (4, 2), "from either side, the rim: {out:?}");
    }
    // Folded along its diagonal towards the light, so that light passes both faces: the fold counts
    // twice.
    let fold = [DVec3::ZERO, DVec3::Y, DVec3::new(1.0, 0.0, 0.5), DVec3::new(1.0, 0.0, -0.5)];
    let fold = TriangleMesh::new(fold.to_vec(), vec![[0, 1, 2], [1, 0, 3]]).expect("a mesh");
    fold.silhouette(DVec4::new(0.0, 0.5, 9.0, 1.0), &mut out);
    let doubled = out.edges.iter().filter(|e| **e == [0, 1] || **e == [1, 0]).count();
    assert_eq!((out.edges.len(), doubled), (6, 2), "{out:?}");
}

#[test]
fn lights_that_are_none_make_nothing() {
    let mut out = Silhouette::default();
    let mesh = TriangleMesh::sphere(1.0, 8).expect("a sphere");
    for light in [DVec4::ZERO, DVec4::new(f64::NAN, 0.0, 0.0, 1.0), DVec4::new(0.0, 1.0, 0.0, f64::INFINITY)]
    {
        mesh.silhouette(DVec4::Y, &mut out);
        assert!(!out.edges.is_empty(), "something to overwrite");
        mesh.silhouette(light, &mut out);
        assert!(out.edges.is_empty() && out.caps.is_empty(), "{light}: {out:?}");
    }
    // Numbers at the ends of float64 do no harm.
    for size in [1e-308, 1e-160, 1e160, 1e308] {
        let mesh = TriangleMesh::sphere(size, 8).expect("a sphere");
        for light in [DVec4::Y, DVec4::new(0.0, 5.0, 0.0, 1.0), DVec4::splat(1e308)] {
            mesh.silhouette(light, &mut out);
            let known = out.caps.as_flattened().iter().chain(out.edges.as_flattened());
            assert!(known.max().is_none_or(|i| (*i as usize) < mesh.positions().len()), "{size}: {out:?}");
        }
    }
}
