//! The tessellations: closed, outward, on the true surface, and as large as the true solids.

use antumbra_math::{MeshError, TriangleMesh};
use core::f64::consts::PI;
use glam::{DVec2, DVec3};

/// A solid, made with so many segments, its volume, and how far a point is from its surface.
struct Solid {
    name: &'static str,
    make: fn(u32) -> Result<TriangleMesh, MeshError>,
    volume: f64,
    distance: fn(DVec3) -> f64,
}

/// Distance of (r, y) from a segment of the profile.
fn from_segment(p: DVec3, a: [f64; 2], b: [f64; 2]) -> f64 {
    let (p, a, b) = (DVec2::new(p.x.hypot(p.z), p.y), DVec2::from(a), DVec2::from(b));
    let t = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
    p.distance(a.lerp(b, t))
}

fn solids() -> Vec<Solid> {
    let frustum = |p: DVec3| {
        let side = from_segment(p, [0.7, -0.6], [0.3, 0.6]);
        side.min(from_segment(p, [0.0, -0.6], [0.7, -0.6])).min(from_segment(p, [0.0, 0.6], [0.3, 0.6]))
    };
    let cone =
        |p: DVec3| from_segment(p, [0.7, -0.6], [0.0, 0.6]).min(from_segment(p, [0.0, -0.6], [0.7, -0.6]));
    let cylinder = |p: DVec3| {
        let side = from_segment(p, [0.7, -0.6], [0.7, 0.6]);
        side.min(from_segment(p, [0.0, -0.6], [0.7, -0.6])).min(from_segment(p, [0.0, 0.6], [0.7, 0.6]))
    };
    vec![
        Solid {
            name: "sphere",
            make: |n| TriangleMesh::sphere(0.7, n),
            volume: 4.0 / 3.0 * PI * 0.343,
            distance: |p| p.length() - 0.7,
        },
        Solid {
            name: "ellipsoid",
            make: |n| TriangleMesh::ellipsoid(DVec3::new(0.3, 1.2, 0.7), n),
            volume: 4.0 / 3.0 * PI * 0.3 * 1.2 * 0.7,
            distance: |p| (p / DVec3::new(0.3, 1.2, 0.7)).length() - 1.0,
        },
        Solid {
            name: "cone",
            make: |n| TriangleMesh::cone(0.7, 1.2, n),
            volume: PI * 0.49 * 1.2 / 3.0,
            distance: cone,
        },
        Solid {
            name: "cylinder",
            make: |n| TriangleMesh::cylinder(0.7, 1.2, 0.7, n),
            volume: PI * 0.49 * 1.2,
            distance: cylinder,
        },
        Solid {
            name: "frustum",
            make: |n| TriangleMesh::cylinder(0.7, 1.2, 0.3, n),
            volume: PI * 1.2 / 3.0 * (0.49 + 0.21 + 0.09),
            distance: frustum,
        },
        Solid {
            name: "capsule",
            make: |n| TriangleMesh::capsule(0.7, 1.2, n),
            volume: PI * 0.49 * 1.2 + 4.0 / 3.0 * PI * 0.343,
            distance: |p| from_segment(p, [0.0, -0.6], [0.0, 0.6]) - 0.7,
        },
        Solid {
            name: "capsule without a middle",
            make: |n| TriangleMesh::capsule(0.7, 0.0, n),
            volume: 4.0 / 3.0 * PI * 0.343,
            distance: |p| p.length() - 0.7,
        },
        Solid {
            name: "torus",
            make: |n| TriangleMesh::torus(0.7, 0.3, n),
            volume: 2.0 * PI * PI * 0.7 * 0.09,
            distance: |p| (p.x.hypot(p.z) - 0.7).hypot(p.y) - 0.3,
        },
        Solid {
            name: "torus without a hole",
            make: |n| TriangleMesh::torus(0.7, 0.7, n),
            volume: 2.0 * PI * PI * 0.7 * 0.49,
            distance: |p| (p.x.hypot(p.z) - 0.7).hypot(p.y) - 0.7,
        },
    ]
}

fn volume(mesh: &TriangleMesh) -> f64 {
    let corners = (0..).map_while(|i| mesh.corners(i));
    corners.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

#[test]
fn solids_are_closed_at_every_number_of_segments() {
    for solid in solids() {
        for segments in (0..=17).chain([31, 64, 100]) {
            let mesh = (solid.make)(segments).expect(solid.name);
            assert!(mesh.is_closed(), "{} of {segments}", solid.name);
            assert!(volume(&mesh) > 0.0, "{} of {segments} looks outward", solid.name);
            for triangle in mesh.triangles() {
                let [a, b, c] = *triangle;
                assert!(a != b && b != c && c != a, "{} of {segments} has no needles", solid.name);
            }
            for p in mesh.positions() {
                let off = (solid.distance)(*p).abs();
                assert!(off < 1e-15, "{} of {segments}: {p} is {off} from the surface", solid.name);
            }
        }
    }
}

#[test]
fn volumes_converge_from_below_with_the_square_of_the_segments() {
    for solid in solids() {
        let missing = [32, 64, 128].map(|n| 1.0 - volume(&(solid.make)(n).expect(solid.name)) / solid.volume);
        let [coarse, middle, fine] = missing;
        // A circle of n segments lacks 2π²/3n² of its area; a ball lacks at most three times as much.
        assert!(fine < 6.6 * 3.0 / (128.0 * 128.0), "{}: {missing:?}", solid.name);
        for ratio in [coarse / middle, middle / fine] {
            assert!((ratio - 4.0).abs() < 0.05, "{}: {missing:?}", solid.name);
        }
    }
}

#[test]
fn the_box_and_the_flat_shapes_are_exact() {
    let cuboid = TriangleMesh::cuboid(DVec3::new(1.0, 2.0, 4.0)).expect("a box");
    assert!(cuboid.is_closed() && volume(&cuboid) == 8.0, "{cuboid:?}");
    assert_eq!((cuboid.positions().len(), cuboid.edges().len()), (8, 18), "with a diagonal a side");
    let area = |mesh: &TriangleMesh| -> DVec3 {
        (0..).map_while(|i| mesh.corners(i)).map(|[a, b, c]| 0.5 * (b - a).cross(c - a)).sum()
    };
    let rectangle = TriangleMesh::rectangle(2.0, 3.0).expect("a rectangle");
    assert_eq!(area(&rectangle), DVec3::Y * 6.0, "faces +Y");
    assert_eq!(rectangle.bounding_sphere().radius, 1.0_f64.hypot(1.5), "centred");
    let disc = TriangleMesh::disc(0.5, 256).expect("a disc");
    let off = area(&disc) - DVec3::Y * (PI * 0.25);
    assert!(off.length() < 6.6 / (256.0 * 256.0) * PI * 0.25, "{off} from the area of a disc");
    let vertices = [DVec3::X, DVec3::new(0.2, 0.3, 2.0), DVec3::Y];
    let triangle = TriangleMesh::triangle(vertices).expect("a triangle");
    assert_eq!(triangle.corners(0), Some(vertices), "as given");
    assert_eq!(triangle.corners(1), None, "one only");
    for flat in [&rectangle, &disc, &triangle] {
        assert!(!flat.is_closed(), "flat shapes have a border");
    }
}

#[test]
fn sizes_that_are_no_sizes_are_refused() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let made = [
            TriangleMesh::sphere(bad, 8),
            TriangleMesh::ellipsoid(DVec3::new(1.0, bad, 1.0), 8),
            TriangleMesh::cone(bad, 1.0, 8),
            TriangleMesh::cone(1.0, bad, 8),
            TriangleMesh::cylinder(1.0, bad, 1.0, 8),
            TriangleMesh::cylinder(bad, 1.0, bad, 8),
            TriangleMesh::capsule(bad, 1.0, 8),
            TriangleMesh::torus(1.0, bad, 8),
            TriangleMesh::torus(bad, 1.0, 8),
            TriangleMesh::cuboid(DVec3::new(1.0, 1.0, bad)),
            TriangleMesh::disc(bad, 8),
            TriangleMesh::rectangle(1.0, bad),
        ];
        for (i, mesh) in made.into_iter().enumerate() {
            assert_eq!(mesh.err(), Some(MeshError::BadSize), "number {i} of {bad}");
        }
        if bad != 0.0 {
            assert_eq!(TriangleMesh::cylinder(1.0, 1.0, bad, 8).err(), Some(MeshError::BadSize), "top {bad}");
            assert_eq!(TriangleMesh::cylinder(bad, 1.0, 1.0, 8).err(), Some(MeshError::BadSize), "{bad}");
            assert_eq!(TriangleMesh::capsule(1.0, bad, 8).err(), Some(MeshError::BadSize), "{bad}");
        }
    }
    assert_eq!(TriangleMesh::torus(1.0, 1.1, 8).err(), Some(MeshError::BadSize), "a torus through itself");
    // Sizes at the ends of float64 make something.
    for size in [f64::MIN_POSITIVE, 1e-300, 1e300] {
        assert!(TriangleMesh::sphere(size, 8).is_ok_and(|m| m.is_closed()), "a sphere of {size}");
    }
}
