//! The shadow volume of a mesh: its silhouette, seen from a light, and its caps.

use glam::{DVec3, DVec4};

use super::TriangleMesh;

/// What the sum over a shadow volume's faces counts at a point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CountRule {
    /// The faces between the point and the light that look towards the light. It takes half of the
    /// triangles, and it is above zero exactly where the point is in shadow if the mesh is closed, its
    /// faces look outward and the light is outside of it.
    #[default]
    TowardsLight,
    /// All faces between the point and the light, from both sides. It holds for any mesh and any light.
    EveryFace,
}

/// A silhouette and the caps that close its shadow volume.
///
/// With x' for a point x pushed straight away from the light by any amount, all points by the same
/// rule, the volume's outward faces are: the caps as they are, the caps pushed and turned round
/// ([c', b', a'] for [a, b, c]), and for each edge [a, b] the quad (b, a, a', b'). These close; how often they wind round a
/// point is what [`CountRule`] says. Sending every point to infinity is (x w - L) with weight 0, for
/// a light (L, w).
#[derive(Clone, Debug, Default)]
pub struct Silhouette {
    /// Directed edges, those that count twice there twice.
    pub edges: Vec<[u32; 2]>,
    /// The corners of the faces that count, turned to be counter-clockwise seen from the light.
    pub caps: Vec<[u32; 3]>,
    /// What the volume counts.
    pub rule: CountRule,
    towards: Vec<bool>,
}

/// A light whose winding is this far from zero may be inside. Outside rounding leaves some 1e-16 a
/// triangle.
const INSIDE: f64 = 1e-6;

impl TriangleMesh {
    /// Finds the silhouette from a light in the mesh's space: its position and 1, or the direction to
    /// it and 0; any multiple means the same, with a minus sign too if it has a position. `out` is
    /// overwritten, and keeps its memory.
    ///
    /// A face that is seen edge-on counts as turned away: it may be counted either way, because its
    /// part of the volume is empty. A light that is all zeros or not finite makes nothing.
    ///
    /// The rule is [`CountRule::TowardsLight`] where that is right: for closed meshes whose pieces hold
    /// positive volumes, with the light outside. (It leaves one case: a closed mesh that passes through
    /// itself may have inside-out pockets, and other things in such a pocket are lit.)
    pub fn silhouette(&self, light: DVec4, out: &mut Silhouette) {
        out.edges.clear();
        out.caps.clear();
        out.towards.clear();
        let light = if light.w < 0.0 { -light } else { light };
        if !light.is_finite() || light == DVec4::ZERO {
            return;
        }
        out.towards.extend(
            self.triangles.iter().zip(&self.normals).map(|(t, normal)| {
                normal.dot(light.truncate() - self.positions[t[0] as usize] * light.w) > 0.0
            }),
        );
        out.rule = if self.outward && !self.may_hold(light) {
            CountRule::TowardsLight
        } else {
            CountRule::EveryFace
        };
        let away = match out.rule {
            CountRule::TowardsLight => 0,
            CountRule::EveryFace => -1,
        };
        for (&[a, b, c], &towards) in self.triangles.iter().zip(&out.towards) {
            if a == b || b == c || c == a {
                continue; // no sides, so no cap
            }
            if towards {
                out.caps.push([a, b, c]);
            } else if away != 0 {
                out.caps.push([a, c, b]);
            }
        }
        for edge in &self.edges {
            let count: i32 = self
                .faces_of(edge)
                .iter()
                .map(|side| {
                    let turned = if out.towards[side.face as usize] { 1 } else { away };
                    if side.forward { turned } else { -turned }
                })
                .sum();
            let [a, b] = edge.vertices;
            let directed = if count > 0 { [a, b] } else { [b, a] };
            out.edges.extend(core::iter::repeat_n(directed, count.unsigned_abs() as usize));
        }
    }

    /// Whether a light may be inside the mesh.
    fn may_hold(&self, light: DVec4) -> bool {
        if light.w == 0.0 {
            return false;
        }
        let position: DVec3 = light.truncate() / light.w;
        let bounds = self.bounding_sphere;
        // The margin is for rounding in the bounds; beyond it the winding is zero.
        position.distance(bounds.center) <= bounds.radius * (1.0 + 1e-9)
            && self.winding(position).abs() > INSIDE
    }
}
