//! What is to be drawn: every light, receiver and caster, culled, with its matrix.

use super::receivers::{Receivers, plane_model};
use crate::gl::MeshCache;
use crate::input::{Error, Light};
use crate::masks::Counts;
use crate::screen::{ProxyBuilder, TileGrid, hides_its_own_shadow};
use crate::technique::Pass;
use crate::technique::casters::{casters, planes};
use antumbra_math::mesh::planar_projection;
use antumbra_math::{Plane, TriangleMesh};
use glam::{DMat4, DVec3, DVec4};
use std::sync::LazyLock;

/// Heights and weights within this part of the numbers they are the difference of are zero.
const ROUNDING: f64 = 1e-9;

/// A shadow is bounded by the shadows of its caster's box where these are nearer than this many times the light's
/// height: farther away it is bounded by its receiver.
const FARTHEST: f64 = 1e6;

/// Four triangles with a tip and a base of four corners. With the base at infinity they are a whole plane.
static PYRAMID: LazyLock<TriangleMesh> = LazyLock::new(|| {
    let positions = vec![DVec3::Y, DVec3::X, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Z];
    let triangles = vec![[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]];
    TriangleMesh::new(positions, triangles).expect("five corners and four triangles are a mesh")
});

/// A caster in the world.
pub(super) struct Posed {
    pub(super) vertex_array: glow::VertexArray,
    /// Elements: three a triangle.
    pub(super) count: i32,
    /// To the world: affine, or for an infinite plane projective.
    model: DMat4,
    id: u32,
    /// Of the box round the mesh: homogeneous, world space.
    corners: [DVec4; 8],
    /// Whether it is an infinite plane.
    infinite: bool,
    /// The plane that it lies in, if it is flat in its own axes.
    flat: Option<Plane>,
}

/// One caster's shadow on one receiver.
pub(super) struct Draw {
    /// Index in [`Receivers::placed`].
    pub(super) receiver: usize,
    /// Index in the batch.
    pub(super) light: usize,
    /// Index in [`Plan::posed`].
    pub(super) caster: usize,
    /// From the mesh to clip space.
    pub(super) to_clip: [f32; 16],
    /// Height over the receiver's plane, from the mesh's space.
    pub(super) height: [f32; 4],
}

/// The draws of a batch of lights; keeps its memory from one to the next.
#[derive(Default)]
pub(super) struct Plan {
    pub(super) posed: Vec<Posed>,
    /// Sorted by receiver.
    pub(super) draws: Vec<Draw>,
    /// Since the frame began: a pair is a light, a caster and a receiver, and polygons are triangles.
    pub(super) counts: Counts,
}

impl Plan {
    /// Poses the frame's casters.
    ///
    /// # Safety
    /// A [`crate::state::StateGuard`] is alive.
    pub(super) unsafe fn begin(&mut self, pass: &Pass<'_>, meshes: &mut MeshCache) -> Result<(), Error> {
        self.posed.clear();
        self.counts = Counts::default();
        for caster in casters(&pass.frame) {
            // SAFETY: the caller's.
            unsafe { self.pose(pass, meshes, caster.mesh, caster.model, caster.id)? };
            let posed = self.posed.last_mut().expect("posed above");
            posed.flat = flat(&posed.corners);
        }
        for (plane, id) in planes(&pass.frame) {
            if plane.normal.is_finite() && plane.offset.is_finite() && plane.normal != DVec3::ZERO {
                let model = plane_model(&plane, pass.view);
                // SAFETY: the caller's.
                unsafe { self.pose(pass, meshes, &PYRAMID, model, id)? };
                let posed = self.posed.last_mut().expect("posed above");
                (posed.infinite, posed.flat) = (true, Some(plane));
            }
        }
        Ok(())
    }

    /// # Safety
    /// As for [`Self::begin`].
    unsafe fn pose(
        &mut self,
        pass: &Pass<'_>,
        meshes: &mut MeshCache,
        mesh: &TriangleMesh,
        model: DMat4,
        id: u32,
    ) -> Result<(), Error> {
        // SAFETY: the caller's.
        let buffers = unsafe { meshes.get(pass.gl, mesh)? };
        let [low, high] = buffers.bounds;
        let corners = [0, 1, 2, 3, 4, 5, 6, 7].map(|corner: u32| {
            let end = |axis: u32| corner >> axis & 1 == 1;
            let corner = DVec3::select(glam::BVec3::new(end(0), end(1), end(2)), high, low);
            model * corner.extend(1.0)
        });
        let (vertex_array, count) = (buffers.vertex_array, buffers.count);
        self.posed.push(Posed { vertex_array, count, model, id, corners, infinite: false, flat: None });
        Ok(())
    }

    /// Finds the draws of some lights, and touches the tiles they may darken.
    pub(super) fn find(
        &mut self,
        pass: &Pass<'_>,
        receivers: &Receivers,
        lights: &[Light],
        proxy: &mut ProxyBuilder,
        tiles: &mut TileGrid,
    ) {
        self.draws.clear();
        let view = pass.view;
        let eye = view.eye_ws();
        let to_clip = view.projection * view.view;
        for (receiver, placed) in receivers.placed.iter().enumerate() {
            for (light, source) in lights.iter().enumerate() {
                let l = source.place.homogeneous();
                // The side that is seen must be the one that is lit; a light in the plane lights neither.
                let lit = l.is_finite()
                    && placed.plane.height_of(l) > 0.0
                    && placed.plane.facing(l).is_some()
                    && source.intensity != glam::Vec3::ZERO;
                if !lit {
                    continue;
                }
                let flatten = planar_projection(&placed.plane, l) * placed.plane.height_of(l).recip();
                for (caster, posed) in self.posed.iter().enumerate() {
                    self.counts.pairs += 1;
                    let own = posed.id != 0 && posed.id == placed.id;
                    if own
                        || posed.is_edge_on(l)
                        || posed.is_hidden(&source.place, eye)
                        || !posed.is_reached(source)
                    {
                        continue;
                    }
                    let shadow = posed.corners.map(|c| flatten * c);
                    let polygon = match posed.reach(&placed.plane, &placed.sides, &shadow) {
                        Reach::Nothing => continue,
                        Reach::Far => receivers.polygon(placed),
                        Reach::Near => proxy.bound_hull(shadow.map(|s| to_clip * (s / s.w)), [], view),
                    };
                    if polygon.len() < 3 {
                        continue;
                    }
                    tiles.touch(polygon);
                    self.counts.drawn += 1;
                    self.counts.polygons += posed.count as usize / 3;
                    let flat_model = flatten * posed.model;
                    let plane = placed.plane.normal.extend(-placed.plane.offset);
                    self.draws.push(Draw {
                        receiver,
                        light,
                        caster,
                        to_clip: (to_clip * flat_model).as_mat4().to_cols_array(),
                        height: (posed.model.transpose() * plane).as_vec4().to_array(),
                    });
                }
            }
        }
    }
}

/// The plane of a box without height along one of its edges; `corners` by bit.
fn flat(corners: &[DVec4; 8]) -> Option<Plane> {
    let corner = |i: usize| corners[i].truncate();
    let edges = [1, 2, 4].map(|i| corner(i) - corner(0));
    let thin = edges.iter().position(|edge| *edge == DVec3::ZERO)?;
    let normal = edges[(thin + 1) % 3].cross(edges[(thin + 2) % 3]).try_normalize()?;
    Some(Plane::through(corner(0), normal))
}

/// Where a caster's shadow is on a plane.
enum Reach {
    /// Nowhere.
    Nothing,
    /// Perhaps as far as one can see.
    Far,
    /// Between the shadows of its box's corners.
    Near,
}

impl Posed {
    /// Whether nothing that is seen can lie in the shadow of an infinite plane.
    fn is_hidden(&self, light: &antumbra_math::Light, eye: DVec4) -> bool {
        let plane = self.flat.filter(|_| self.infinite);
        plane.is_some_and(|plane| hides_its_own_shadow(&plane.into(), self.id, light, eye))
    }

    /// Whether it is flat and the light in its plane, which then takes nothing: its matrix would make of the light
    /// no point at all, and of what is round it, by rounding, anything.
    fn is_edge_on(&self, light: DVec4) -> bool {
        self.flat.is_some_and(|plane| plane.facing(light).is_none())
    }

    /// Whether any light arrives at the caster: false only outside a spot's cone.
    fn is_reached(&self, light: &Light) -> bool {
        if self.infinite {
            return true;
        }
        let [first, .., last] = self.corners.map(DVec4::truncate);
        // The middle of a box, whatever its pose.
        let center = (first + last) * 0.5;
        let radius = self.corners.iter().map(|c| c.truncate().distance(center)).fold(0.0, f64::max);
        light.may_reach(&light.place, center, radius)
    }

    /// `shadow`: the shadows of the corners of its box.
    fn reach(&self, plane: &Plane, sides: &[DVec4; 2], shadow: &[DVec4; 8]) -> Reach {
        let heights = self.corners.map(|c| {
            let h = plane.height_of(c);
            let rounding = ROUNDING * (c.truncate().length() + plane.offset.abs() * c.w);
            if h.abs() <= rounding { 0.0 } else { h }
        });
        // In the plane or behind it; level with the light or beyond.
        if heights.iter().all(|&h| h <= 0.0) || shadow.iter().all(|s| s.w <= 0.0) {
            return Reach::Nothing;
        }
        let bounded = !self.infinite && shadow.iter().all(|s| s.w * FARTHEST > 1.0);
        if !bounded {
            return Reach::Far;
        }
        let beside = |side: &DVec4, sign: f64| shadow.iter().all(|s| sign * side.dot(*s) > s.w);
        if sides.iter().any(|side| beside(side, 1.0) || beside(side, -1.0)) {
            return Reach::Nothing;
        }
        Reach::Near
    }
}
