//! `shape = { .. }`: every shape.

use glam::DVec3;

use crate::limits::MIN_LENGTH;
use crate::mesh::Meshes;
use crate::table::{Field, Table};
use crate::text::{all_of, any_of, nearest, quoted_path};
use crate::values::plain;
use crate::{SceneError, Shape};

/// Every shape with its keys, required ones first.
const SHAPES: [(&str, &[&str]); 12] = [
    ("plane", &[]),
    ("rectangle", &["width", "depth"]),
    ("disc", &["radius"]),
    ("triangle", &["vertices"]),
    ("sphere", &["radius"]),
    ("ellipsoid", &["radii"]),
    ("cone", &["radius", "height"]),
    ("cylinder", &["radius", "height", "radius_top"]),
    ("capsule", &["radius", "height"]),
    ("box", &["size"]),
    ("torus", &["major_radius", "minor_radius"]),
    ("mesh", &["path"]),
];

/// Height of a triangle over its longest side, relative to that side, below which its plane is
/// rounding error.
const MIN_TRIANGLE_HEIGHT: f64 = 1e-9;

/// The shape in `field`.
pub(crate) fn shape(field: &Field<'_>, meshes: &mut Meshes<'_>) -> Result<Shape, SceneError> {
    let table = field.table(field.what.clone(), "shape = { type = \"sphere\", radius = 0.5 }")?;
    let kind = table.require("type", "type = \"sphere\"")?.word(&SHAPES.map(|(kind, _)| kind))?;
    allow(&table, kind)?;
    let length = |key: &str, example: &str| table.require(key, example)?.length(example);
    Ok(match kind {
        "rectangle" => Shape::Rectangle {
            width: length("width", "width = 2.0")?,
            depth: length("depth", "depth = 2.0")?,
        },
        "disc" => Shape::Disc { radius: length("radius", "radius = 0.5")? },
        "triangle" => triangle(&table)?,
        "sphere" => Shape::Sphere { radius: length("radius", "radius = 0.5")? },
        "ellipsoid" => {
            let example = "radii = [0.5, 0.3, 0.4]";
            Shape::Ellipsoid { radii: table.require("radii", example)?.lengths(example)? }
        }
        "cone" => Shape::Cone {
            radius: length("radius", "radius = 0.5")?,
            height: length("height", "height = 1.0")?,
        },
        "cylinder" => {
            let radius = length("radius", "radius = 0.5")?;
            let height = length("height", "height = 1.0")?;
            let example = "radius_top = 0.25, or a shape of type = \"cone\" for a pointed one";
            let radius_top = table.get("radius_top").map_or(Ok(radius), |field| field.length(example))?;
            Shape::Cylinder { radius, height, radius_top }
        }
        "capsule" => Shape::Capsule {
            radius: length("radius", "radius = 0.5")?,
            height: length("height", "height = 1.0, or a shape of type = \"sphere\"")?,
        },
        "box" => {
            let example = "size = [1.0, 1.0, 1.0]";
            Shape::Box { size: table.require("size", example)?.lengths(example)? }
        }
        "torus" => torus(&table)?,
        "mesh" => {
            let example = "path = \"meshes/knot.obj\" (.obj, .gltf or .glb, relative to the scene file)";
            let field = table.require("path", example)?;
            let path = field.string(example)?;
            Shape::Mesh(
                meshes.load(path).map_err(|e| {
                    field.error(format!("the mesh {} {}", quoted_path(path), e.what), e.instead)
                })?,
            )
        }
        _ => Shape::Plane,
    })
}

/// Refuses keys that this shape has not, and says which shapes have them.
fn allow(table: &Table<'_>, kind: &str) -> Result<(), SceneError> {
    let own = SHAPES.iter().find(|(k, _)| *k == kind).map_or(&[][..], |(_, keys)| keys);
    let valid: Vec<&str> = core::iter::once("type").chain(own.iter().copied()).collect();
    table.allow(&valid, |key| {
        let article = if kind == "ellipsoid" { "an" } else { "a" };
        let keys = match own {
            [] => format!("{article} {kind} has no keys but \"type\""),
            own => format!(
                "the keys of {article} {kind} are {}",
                all_of(&own.iter().map(|k| format!("\"{k}\"")).collect::<Vec<_>>())
            ),
        };
        let what = format!("\"{key}\" is no key of {article} {kind}");
        match key {
            "translation" | "rotation" => {
                Some((what, format!("write \"{key}\" beside \"shape\", not inside it; {keys}")))
            }
            _ => {
                let owners: Vec<String> = SHAPES
                    .iter()
                    .filter(|(_, keys)| keys.contains(&key))
                    .map(|(kind, _)| format!("\"{kind}\""))
                    .collect();
                if owners.is_empty() || nearest(key, own).is_some() {
                    return None;
                }
                Some((what, format!("{keys}; \"{key}\" belongs to the type {}", any_of(&owners))))
            }
        }
    })
}

fn triangle(table: &Table<'_>) -> Result<Shape, SceneError> {
    let example = "vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]";
    let list = table.require("vertices", example)?;
    let fields = list.array(example)?;
    if fields.len() != 3 {
        return Err(list.error(
            format!("{} has {} entries, but a triangle has 3", list.what, fields.len()),
            format!("write {example}"),
        ));
    }
    let mut vertices = [DVec3::ZERO; 3];
    for (vertex, field) in vertices.iter_mut().zip(&fields) {
        *vertex = field.point("a point such as [1.0, 0.0, 0.0]")?;
    }
    let [a, b, c] = vertices;
    let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
    if longest < MIN_LENGTH {
        return Err(list.error(
            format!("{} are one point, or nearer than {}", list.what, plain(MIN_LENGTH)),
            "write three corners that are apart",
        ));
    }
    let height = (b - a).cross(c - a).length() / longest;
    if height < MIN_TRIANGLE_HEIGHT * longest || height < MIN_LENGTH * MIN_TRIANGLE_HEIGHT {
        return Err(list.error(
            format!("{} lie on one line, so the triangle has no area", list.what),
            "move one of them off the line through the others",
        ));
    }
    Ok(Shape::Triangle { vertices })
}

fn torus(table: &Table<'_>) -> Result<Shape, SceneError> {
    let example = "major_radius = 1.0";
    let major_radius = table.require("major_radius", example)?.length(example)?;
    let example = "minor_radius = 0.25";
    let field = table.require("minor_radius", example)?;
    let minor_radius = field.length(example)?;
    if minor_radius > major_radius {
        return Err(field.error(
            format!(
                "{} is {}, which is above its \"major_radius\" of {}",
                field.what,
                plain(minor_radius),
                plain(major_radius)
            ),
            "write a minor radius of at most the major one",
        ));
    }
    Ok(Shape::Torus { major_radius, minor_radius })
}
