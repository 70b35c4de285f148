//! `motion = { .. }`, of lights and objects alike.

use crate::limits::{MAX_PATH_POINTS, MAX_PERIOD, MIN_PERIOD};
use crate::table::{Field, Table};
use crate::values::plain;
use crate::{Motion, SceneError};

const ORBIT: &str =
    "motion = { type = \"orbit\", center = [0.0, 8.0, 0.0], axis = [0.0, 1.0, 0.0], period = 8.0 }";
const PATH: &str = "motion = { type = \"path\", points = [[0.0, 1.0, 0.0], [2.0, 1.0, 0.0]], period = 8.0 }";

/// The motion in `field`.
pub(crate) fn motion(field: &Field<'_>) -> Result<Motion, SceneError> {
    let table = field.table(field.what.clone(), ORBIT)?;
    let kind = table.require("type", "type = \"orbit\" or type = \"path\"")?.word(&["orbit", "path"])?;
    if kind == "orbit" {
        table.allow(&["type", "center", "axis", "period"], |key| {
            (key == "points").then(|| {
                (
                    format!("\"points\" is no key of an orbit, which {} is", table.what),
                    format!("write {PATH}"),
                )
            })
        })?;
        let center =
            table.require("center", "center = [0.0, 8.0, 0.0]")?.point("center = [0.0, 8.0, 0.0]")?;
        let axis = table.require("axis", "axis = [0.0, 1.0, 0.0]")?.direction("axis = [0.0, 1.0, 0.0]")?;
        return Ok(Motion::Orbit { center, axis, period: period(&table, true)? });
    }
    table.allow(&["type", "points", "period"], |key| {
        matches!(key, "center" | "axis").then(|| {
            (format!("\"{key}\" is no key of a path, which {} is", table.what), format!("write {ORBIT}"))
        })
    })?;
    let list = table.require("points", "points = [[0.0, 1.0, 0.0], [2.0, 1.0, 0.0]]")?;
    let fields = list.array("points = [[0.0, 1.0, 0.0], [2.0, 1.0, 0.0]]")?;
    if !(2..=MAX_PATH_POINTS).contains(&fields.len()) {
        return Err(list.error(
            format!("{} has {} points, but a path has from 2 to {MAX_PATH_POINTS}", table.what, fields.len()),
            "write points = [[0.0, 1.0, 0.0], [2.0, 1.0, 0.0]]",
        ));
    }
    let points =
        fields.iter().map(|f| f.point("a point such as [0.0, 1.0, 0.0]")).collect::<Result<_, _>>()?;
    Ok(Motion::Path { points, period: period(&table, false)? })
}

/// Seconds for one round; an orbit may turn the other way.
fn period(table: &Table<'_>, either_way: bool) -> Result<f64, SceneError> {
    let example = "period = 8.0 (seconds for one round)";
    let field = table.require("period", example)?;
    let period = field.number(-MAX_PERIOD, MAX_PERIOD, example)?;
    let size = if either_way { period.abs() } else { period };
    if size >= MIN_PERIOD {
        return Ok(period);
    }
    let (sign, more) =
        if either_way { (" in size", ", or a negative one to turn the other way") } else { ("", "") };
    Err(field.error(
        format!("{} is {}, which is below {}{sign}", field.what, plain(period), plain(MIN_PERIOD)),
        format!("write {example}{more}"),
    ))
}
