//! `[[object]]`: looks, pose, motion, and one shape or several parts.

use glam::{DQuat, DVec3};

use crate::limits::MAX_PARTS;
use crate::mesh::Meshes;
use crate::parse_motion::motion;
use crate::parse_shape::shape;
use crate::table::Table;
use crate::text::quoted;
use crate::{Object, Part, Pose, SceneError};

const KEYS: [&str; 9] = [
    "name",
    "shape",
    "parts",
    "translation",
    "rotation",
    "color",
    "casts_shadow",
    "receives_shadow",
    "motion",
];

const SHAPE: &str = "shape = { type = \"sphere\", radius = 0.5 }";
const PARTS: &str =
    "parts = [ { shape = { type = \"sphere\", radius = 0.5 }, translation = [0.0, 1.0, 0.0] } ]";

/// An object whose name the caller has checked. `count` is the number of parts so far in the scene.
pub(crate) fn object(
    mut table: Table<'_>,
    count: &mut usize,
    meshes: &mut Meshes<'_>,
) -> Result<Object, SceneError> {
    let name = table.require("name", "name = \"ball\"")?.name()?.to_owned();
    table.what = format!("object {}", quoted(&name));
    table.allow(&KEYS, |key| match key {
        "position" => Some((
            format!("unknown key \"position\" in {}", table.what),
            "an object is placed by translation = [0.0, 1.0, 0.0]".to_owned(),
        )),
        "type" | "radius" | "height" | "width" | "depth" | "size" | "vertices" | "radii" | "path" => Some((
            format!("\"{key}\" is no key of {}, but one of its shape", table.what),
            format!("write {SHAPE}"),
        )),
        _ => None,
    })?;
    let parts = parts(&table, count, meshes)?;
    let color = match table.get("color") {
        Some(field) => field.vector(0.0, 1.0, "color = [0.8, 0.8, 0.8] (albedo, linear RGB)")?,
        None => DVec3::splat(0.8),
    };
    let flag = |key: &str| table.get(key).map_or(Ok(true), |field| field.boolean());
    Ok(Object {
        parts,
        pose: pose(&table)?,
        color,
        casts_shadow: flag("casts_shadow")?,
        receives_shadow: flag("receives_shadow")?,
        motion: table.get("motion").map(|field| motion(&field)).transpose()?,
        name,
    })
}

fn pose(table: &Table<'_>) -> Result<Pose, SceneError> {
    let translation = match table.get("translation") {
        Some(field) => field.point("translation = [0.0, 1.0, 0.0]")?,
        None => DVec3::ZERO,
    };
    let rotation = table.get("rotation").map_or(Ok(DQuat::IDENTITY), |field| field.rotation())?;
    Ok(Pose { translation, rotation })
}

fn parts(table: &Table<'_>, count: &mut usize, meshes: &mut Meshes<'_>) -> Result<Vec<Part>, SceneError> {
    let fields = match (table.get("shape"), table.get("parts")) {
        (Some(field), None) => {
            more_parts(count, 1).map_err(|(what, instead)| field.error(what, instead))?;
            return Ok(vec![Part { shape: shape(&field, meshes)?, pose: Pose::IDENTITY }]);
        }
        (None, Some(field)) => {
            let fields = field.array(PARTS)?;
            if fields.is_empty() {
                return Err(field.error(
                    format!("\"parts\" of {} is empty", table.what),
                    format!("write at least one part, {PARTS}, or one shape, {SHAPE}"),
                ));
            }
            more_parts(count, fields.len()).map_err(|(what, instead)| field.error(what, instead))?;
            fields
        }
        (Some(_), Some(_)) => {
            return Err(table.key_error(
                "parts",
                format!("{} has both \"shape\" and \"parts\"", table.what),
                "leave one of them out; a composite object has its first shape among its parts",
            ));
        }
        (None, None) => {
            return Err(table.error(
                format!("{} has neither \"shape\" nor \"parts\"", table.what),
                format!("write {SHAPE} or {PARTS}"),
            ));
        }
    };
    let mut parts = Vec::with_capacity(fields.len());
    for (i, field) in fields.iter().enumerate() {
        let part = field.table(format!("part {} of {}", i + 1, table.what), PARTS)?;
        part.allow(&["shape", "translation", "rotation"], |key| {
            matches!(key, "color" | "casts_shadow" | "receives_shadow" | "motion" | "name").then(|| {
                (
                    format!("\"{key}\" is no key of a part",),
                    "write it in the object, for all its parts".to_owned(),
                )
            })
        })?;
        let shape = shape(&part.require("shape", SHAPE)?, meshes)?;
        parts.push(Part { shape, pose: pose(&part)? });
    }
    Ok(parts)
}

fn more_parts(count: &mut usize, more: usize) -> Result<(), (String, &'static str)> {
    *count += more;
    if *count > MAX_PARTS {
        return Err((format!("more than {MAX_PARTS} parts in all objects"), "leave some out, or use a mesh"));
    }
    Ok(())
}
