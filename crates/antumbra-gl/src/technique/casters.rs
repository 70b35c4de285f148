//! What blocks light, as triangles: for the techniques that cast from meshes.

use crate::input::{Frame, Occluder};
use antumbra_math::{MeshError, Plane, Shape, TriangleMesh};
use glam::{DMat3, DMat4, DQuat, DVec3};
use std::sync::LazyLock;

/// Sides of a tessellated circle: its chords leave the arc by 3e-4 of the radius, a tenth of a pixel for a shadow of
/// 600 pixels across.
const SEGMENTS: u32 = 128;

/// The shapes of size one, centred on the origin, axis +Y.
struct UnitShapes {
    sphere: TriangleMesh,
    disc: TriangleMesh,
    cone: TriangleMesh,
    rectangle: TriangleMesh,
    triangle: TriangleMesh,
}

impl UnitShapes {
    fn new(segments: u32) -> Self {
        let made = |mesh: Result<TriangleMesh, MeshError>| mesh.expect("shapes of size one are meshes");
        Self {
            sphere: made(TriangleMesh::sphere(1.0, segments)),
            disc: made(TriangleMesh::disc(1.0, segments)),
            cone: made(TriangleMesh::cone(1.0, 1.0, segments)),
            rectangle: made(TriangleMesh::rectangle(2.0, 2.0)),
            triangle: made(TriangleMesh::triangle([DVec3::ZERO, DVec3::X, DVec3::Z])),
        }
    }
}

static UNIT: LazyLock<UnitShapes> = LazyLock::new(|| UnitShapes::new(SEGMENTS));

/// The same with fewer sides, for pictures that have no room for more.
static COARSE: LazyLock<[(u32, UnitShapes); 2]> =
    LazyLock::new(|| [SEGMENTS / 4, SEGMENTS / 2].map(|segments| (segments, UnitShapes::new(segments))));

/// A mesh with at least so many sides to a circle, if that is fewer than it has, for the round shapes of
/// [`casters`]; other meshes as they are.
pub(crate) fn with_sides(mesh: &TriangleMesh, sides: f64) -> &TriangleMesh {
    let (fine, coarse): (&UnitShapes, &[(u32, UnitShapes)]) = (&UNIT, &*COARSE);
    let Some((_, coarse)) = coarse.iter().find(|(segments, _)| f64::from(*segments) >= sides) else {
        return mesh;
    };
    [(&fine.sphere, &coarse.sphere), (&fine.disc, &coarse.disc), (&fine.cone, &coarse.cone)]
        .into_iter()
        .find_map(|(fine, coarse)| (fine.id() == mesh.id()).then_some(coarse))
        .unwrap_or(mesh)
}

/// A mesh in the world that casts a shadow.
#[derive(Clone, Copy)]
pub(crate) struct Caster<'a> {
    pub(crate) mesh: &'a TriangleMesh,
    /// To the world: affine, invertible.
    pub(crate) model: DMat4,
    /// As [`Occluder::id`].
    pub(crate) id: u32,
}

/// The frame's occluders and meshes as posed triangle meshes. Shapes without extent (a radius of zero, not finite)
/// cast none and are left out, and so are infinite planes: see [`planes`].
pub(crate) fn casters<'a>(frame: &Frame<'a>) -> impl Iterator<Item = Caster<'a>> + use<'a> {
    let shapes = frame.occluders.iter().filter_map(|o| -> Option<Caster<'a>> { caster_of(o) });
    let meshes = frame.meshes.iter().map(|m| Caster { mesh: &m.mesh, model: m.model, id: m.id });
    shapes.chain(meshes)
}

/// The infinite planes among the frame's occluders, which have no mesh, with their ids.
pub(crate) fn planes<'a>(frame: &Frame<'a>) -> impl Iterator<Item = (Plane, u32)> + use<'a> {
    frame.occluders.iter().filter_map(|occluder| match occluder.shape {
        Shape::Plane(plane) => Some((plane, occluder.id)),
        _ => None,
    })
}

impl Occluder {
    /// The triangles that the techniques with triangles take for the shape, and the matrix that puts them into the
    /// world: affine, invertible. `None` for infinite planes, and for shapes without extent or with a NaN.
    pub fn tessellated(&self) -> Option<(&'static TriangleMesh, DMat4)> {
        caster_of(self).map(|caster| (caster.mesh, caster.model))
    }
}

/// A shape as a posed mesh, under the same conditions as in [`casters`].
pub(crate) fn caster_of(occluder: &Occluder) -> Option<Caster<'static>> {
    let unit: &'static UnitShapes = &UNIT;
    let (mesh, model) = match occluder.shape {
        Shape::Sphere(s) if s.radius > 0.0 => {
            (&unit.sphere, DMat4::from_translation(s.center) * DMat4::from_scale(DVec3::splat(s.radius)))
        }
        Shape::Disc(s) if s.radius > 0.0 => {
            (&unit.disc, standing(s.center, s.normal, DVec3::splat(s.radius))?)
        }
        Shape::Cone(s) if s.radius > 0.0 && s.height > 0.0 => {
            let middle = s.base_center + s.axis * (0.5 * s.height);
            (&unit.cone, standing(middle, s.axis, DVec3::new(s.radius, s.height, s.radius))?)
        }
        Shape::Rectangle(s) => {
            let normal = s.half_forward.cross(s.half_right).normalize_or_zero();
            let axes = DMat3::from_cols(s.half_right, normal, s.half_forward);
            (&unit.rectangle, DMat4::from_mat3_translation(axes, s.center))
        }
        Shape::Triangle(s) => {
            let [a, b, c] = s.vertices;
            let normal = (c - a).cross(b - a).normalize_or_zero();
            (&unit.triangle, DMat4::from_mat3_translation(DMat3::from_cols(b - a, normal, c - a), a))
        }
        _ => return None,
    };
    // A size of zero, an infinity or a NaN has no inverse.
    let casts = model.is_finite() && model.determinant() != 0.0;
    casts.then_some(Caster { mesh, model, id: occluder.id })
}

/// From the unit shape's space to where its axis is `axis`.
fn standing(center: DVec3, axis: DVec3, scale: DVec3) -> Option<DMat4> {
    let axis = axis.try_normalize()?;
    Some(DMat4::from_scale_rotation_translation(scale, DQuat::from_rotation_arc(DVec3::Y, axis), center))
}
