//! What makes a mesh: welding, edges, borders, bounds, and what is refused.

use antumbra_math::{MeshError, TriangleMesh};
use glam::DVec3;

fn mesh(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<TriangleMesh, MeshError> {
    TriangleMesh::new(positions.iter().map(|&p| p.into()).collect(), triangles.to_vec())
}

const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
const CORNERS: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]];

#[test]
fn a_tetrahedron_is_closed_whether_or_not_its_vertices_are_split() {
    let whole = mesh(&CORNERS, &TETRAHEDRON).expect("a mesh");
    // As files with a normal a face write it, and with zeros of both signs.
    let split: Vec<[f64; 3]> = TETRAHEDRON
        .as_flattened()
        .iter()
        .enumerate()
        .map(|(k, &i)| CORNERS[i as usize].map(|x| if x == 0.0 && k % 2 == 1 { -0.0 } else { x }))
        .collect();
    let apart: Vec<[u32; 3]> = (0..4).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let welded = mesh(&split, &apart).expect("a mesh");
    for m in [&whole, &welded] {
        assert!(m.is_closed(), "{m:?}");
        assert_eq!((m.positions().len(), m.triangles().len(), m.edges().len()), (4, 4, 6), "{m:?}");
        for edge in m.edges() {
            let [a, b] = m.faces_of(edge) else { panic!("{edge:?} has two faces") };
            assert_ne!(a.forward, b.forward, "the faces of {edge:?} run against each other");
            assert!(edge.vertices[0] < edge.vertices[1], "{edge:?}");
        }
    }
    assert_ne!(whole.id(), welded.id(), "each has its own id");
    assert_eq!(whole.id(), whole.clone().id(), "a clone is the same mesh");
}

#[test]
fn a_border_or_a_turned_face_opens_a_mesh() {
    let open = mesh(&CORNERS, &TETRAHEDRON[1..]).expect("a mesh");
    assert!(!open.is_closed(), "without its base");
    assert_eq!(open.edges().iter().filter(|e| open.faces_of(e).len() == 1).count(), 3, "three borders");
    let mut turned = TETRAHEDRON;
    turned[2].reverse();
    assert!(!mesh(&CORNERS, &turned).expect("a mesh").is_closed(), "one face looks inward");
    // Three pages of a book.
    let pages = mesh(
        &[[0.0; 3], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [-1.0, 0.0, 0.5], [-1.0, 0.0, -0.5]],
        &[[0, 1, 2], [0, 1, 3], [1, 0, 4]],
    )
    .expect("a mesh");
    let spine = pages.edges().iter().find(|e| e.vertices == [0, 1]).expect("the spine");
    let faces: Vec<(u32, bool)> = pages.faces_of(spine).iter().map(|f| (f.face, f.forward)).collect();
    assert_eq!(faces, [(0, true), (1, true), (2, false)], "all three, with their directions");
    assert!(!pages.is_closed(), "pages have borders");
}

#[test]
fn solids_that_touch_in_an_edge_are_closed() {
    // Two boxes, corner to corner: four faces meet in the edge between them.
    let one = TriangleMesh::cuboid(DVec3::ONE).expect("a box");
    let mut positions = one.positions().to_vec();
    let mut triangles = one.triangles().to_vec();
    positions.extend(one.positions().iter().map(|p| *p + DVec3::new(1.0, 1.0, 0.0)));
    triangles.extend(one.triangles().iter().map(|t| t.map(|i| i + 8)));
    let both = TriangleMesh::new(positions, triangles).expect("a mesh");
    assert_eq!(both.positions().len(), 14, "two corners are shared");
    assert_eq!(both.edges().iter().filter(|e| both.faces_of(e).len() == 4).count(), 1, "one shared edge");
    assert!(both.is_closed(), "no border anywhere");
}

#[test]
fn triangles_without_area_keep_a_closed_mesh_closed() {
    // A needle: two corners in one place, as a pole of a sphere on a grid has.
    let mut needles = TETRAHEDRON.to_vec();
    needles.extend([[1, 1, 2], [3, 3, 3]]);
    let m = mesh(&CORNERS, &needles).expect("a mesh");
    assert!(m.is_closed() && m.edges().len() == 6, "needles have no sides: {m:?}");
    assert_eq!(m.triangles().len(), 6, "and are still listed");
    // A sliver: the middle of an edge, with the face on its other side split there and the one on this
    // side not. Without its sides the mesh would have a slit.
    let mut corners = CORNERS.to_vec();
    corners.push([0.5, 0.0, 0.0]);
    let slivers = [[0, 2, 1], [0, 4, 3], [4, 1, 3], [1, 2, 3], [2, 0, 3], [0, 1, 4]];
    let m = mesh(&corners, &slivers).expect("a mesh");
    assert!(m.is_closed() && m.edges().len() == 9, "a sliver has three sides: {m:?}");
    assert!(!mesh(&corners, &slivers[..5]).expect("a mesh").is_closed(), "without it there is a slit");
}

#[test]
fn the_bounding_sphere_holds_what_triangles_use() {
    let m = mesh(&[[1.0, 2.0, 3.0], [3.0, 2.0, 3.0], [2.0, 3.0, 3.0], [99.0, 0.0, 0.0]], &[[0, 1, 2]]);
    let sphere = m.expect("a mesh").bounding_sphere();
    assert_eq!(sphere.center, DVec3::new(2.0, 2.5, 3.0), "the middle of the box");
    assert!((sphere.radius - 1.25_f64.sqrt()).abs() < 1e-15, "{sphere:?} reaches the farthest corner");
    let huge = mesh(&[[1e308, 0.0, 0.0], [-1e308, 0.0, 0.0], [0.0, 1e308, 0.0]], &[[0, 1, 2]]);
    assert!(huge.is_ok_and(|m| m.bounding_sphere().center.is_finite()), "no overflow in the centre");
}

#[test]
fn winding_is_one_inside_and_zero_outside() {
    let m = TriangleMesh::cuboid(DVec3::new(1.0, 2.0, 3.0)).expect("a box");
    for (point, expected) in [
        (DVec3::ZERO, 1.0),
        (DVec3::new(0.49, -0.99, 1.49), 1.0),
        (DVec3::new(0.51, 0.0, 0.0), 0.0),
        (DVec3::new(40.0, -7.0, 3.0), 0.0),
    ] {
        let winding = m.winding(point);
        assert!((winding - expected).abs() < 1e-12, "{winding} at {point}, not {expected}");
    }
    let on = m.winding(DVec3::new(0.5, 0.1, 0.2));
    assert!((-1e-12..=1.0 + 1e-12).contains(&on), "{on} on the surface");
}

#[test]
fn what_is_no_mesh_is_refused() {
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(mesh(&corners, &[]).err(), Some(MeshError::NoTriangles), "no triangle");
    assert_eq!(mesh(&[], &[[0, 0, 0]]).err(), Some(MeshError::NoSuchVertex { triangle: 0 }), "no vertex");
    let past = mesh(&corners, &[[0, 1, 2], [0, 1, 3]]);
    assert_eq!(past.err(), Some(MeshError::NoSuchVertex { triangle: 1 }), "one past the last");
    for bad in [f64::NAN, f64::INFINITY] {
        let mut corners = corners;
        corners[2][1] = bad;
        assert_eq!(mesh(&corners, &[[0, 1, 2]]).err(), Some(MeshError::NotFinite { vertex: 2 }), "{bad}");
    }
    let point = mesh(&[[1.0; 3]; 3], &[[0, 1, 2]]).expect("a mesh without area");
    assert!(point.edges().is_empty() && point.positions().len() == 1, "one point has no sides: {point:?}");
}
