//! Casters as the technique `volume` has them, triangles, and their silhouettes.

use std::collections::BTreeMap;

use antumbra::Occluder;
use antumbra::math::PlaneFrame;
use antumbra::math::mesh::Silhouette;
use glam::{DVec2, DVec3, DVec4};

use super::path::Path;
use super::{Casting, Pair, Situation};

/// A point this near the light's height, as a fraction of it, has its shadow at infinity.
const AS_HIGH: f64 = 1e-6;

/// The silhouette of the caster's triangles, seen from a light without area: chains of edges in the world, mostly loops.
/// None for area lights, infinite planes and degenerate poses.
pub(super) fn silhouette(situation: &Situation<'_>, pair: &Pair<'_>) -> Vec<Path<DVec3>> {
    let caster = match pair.casting {
        Casting::Nothing => None,
        Casting::Shape(shape) => Occluder::new(shape).tessellated(),
        Casting::Mesh(index) => situation.mesh(index).map(|posed| (&*posed.mesh, posed.model)),
    };
    let Some((mesh, model)) = caster.filter(|_| pair.is_hard()) else { return Vec::new() };
    if !(model.is_finite() && model.determinant() != 0.0) {
        return Vec::new();
    }
    let light: DVec4 = model.inverse() * pair.light.place.homogeneous();
    let mut found = Silhouette::default();
    mesh.silhouette(light, &mut found);
    let at = |index: u32| model.transform_point3(mesh.positions()[index as usize]);
    chains(&found.edges)
        .into_iter()
        .map(|chain| Path { points: chain.points.into_iter().map(at).collect(), closed: chain.closed })
        .collect()
}

/// Directed edges put end to end. Edges that count twice are taken once.
fn chains(edges: &[[u32; 2]]) -> Vec<Path<u32>> {
    let mut after: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    let mut before: BTreeMap<u32, i32> = BTreeMap::new();
    for &[a, b] in edges {
        let next = after.entry(a).or_default();
        if !next.contains(&b) {
            next.push(b);
            *before.entry(a).or_default() += 1;
            *before.entry(b).or_default() -= 1;
        }
    }
    // Where more edges leave than arrive a chain has to start; after those, only loops are left.
    let open = before.iter().filter(|(_, surplus)| **surplus > 0);
    let mut starts: Vec<u32> = open.flat_map(|(&v, &surplus)| vec![v; surplus as usize]).collect();
    starts.extend(after.keys().copied().collect::<Vec<_>>());
    let mut chains = Vec::new();
    for start in starts {
        while let Some(first) = after.get_mut(&start).and_then(Vec::pop) {
            let mut points = vec![start, first];
            let mut last = first;
            while last != start
                && let Some(next) = after.get_mut(&last).and_then(Vec::pop)
            {
                points.push(next);
                last = next;
            }
            let closed = last == start;
            if closed {
                points.pop();
            }
            chains.push(Path { points, closed });
        }
    }
    chains
}

/// The shadow of a path in space on the plane of a frame, as far as it lies between the plane and the light.
pub(super) fn projected(path: &Path<DVec3>, light: DVec4, frame: &PlaneFrame) -> Vec<Path<DVec2>> {
    let to_plane = light.truncate() - frame.origin * light.w;
    let height = frame.normal.dot(to_plane);
    if !(height.abs() > 1e-12 * to_plane.length()) {
        return Vec::new();
    }
    let side = height.signum();
    let weight = |p: DVec3| 1.0 - light.w * frame.height(p) / height;
    let above = path.where_positive(|p| frame.height(p) * side);
    let between = above.iter().flat_map(|part| part.where_positive(|p| weight(p) - AS_HIGH));
    between
        .map(|part| {
            let shadow = |p: &DVec3| {
                let toward = light.truncate() - *p * light.w;
                let q = *p - toward * (frame.height(*p) / (height * weight(*p)));
                frame.coordinates(q)
            };
            Path { points: part.points.iter().map(shadow).collect(), closed: part.closed }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_become_loops_and_chains() {
        let found = chains(&[[0, 1], [5, 6], [1, 2], [2, 0], [6, 7], [0, 1]]);
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found.contains(&Path::open(vec![5, 6, 7])), "{found:?}");
        assert!(found.iter().any(|path| path.closed && path.points.len() == 3), "{found:?}");
        assert!(chains(&[]).is_empty());
    }

    /// The shadow of a point is where its line from the light meets the plane.
    #[test]
    fn projection_from_a_point() {
        let frame = PlaneFrame { origin: DVec3::Y, u: DVec3::Z, v: DVec3::X, normal: DVec3::Y };
        let path = Path::open(vec![DVec3::new(1.0, 3.0, 0.0), DVec3::new(1.0, 3.0, 2.0)]);
        let found = projected(&path, DVec4::new(0.0, 5.0, 0.0, 1.0), &frame);
        assert_eq!(found, [Path::open(vec![DVec2::new(0.0, 2.0), DVec2::new(4.0, 2.0)])]);
        let found = projected(&path, DVec4::new(1.0, 1.0, 0.0, 0.0), &frame);
        assert_eq!(found, [Path::open(vec![DVec2::new(0.0, -1.0), DVec2::new(2.0, -1.0)])]);
        assert!(projected(&path, DVec4::new(0.0, 2.0, 0.0, 1.0), &frame).is_empty(), "above the light");
        assert!(projected(&path, DVec4::new(0.0, -5.0, 0.0, 1.0), &frame).is_empty(), "on the other side");
        assert!(projected(&path, DVec4::new(1.0, 0.0, 0.0, 0.0), &frame).is_empty(), "along the plane");
    }
}
