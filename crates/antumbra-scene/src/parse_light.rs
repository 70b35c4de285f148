//! `[[light]]`: every kind of light.

use glam::DVec3;

use crate::limits::{MAX_BRIGHTNESS, MAX_LIGHT_COLOR};
use crate::parse_motion::motion;
use crate::table::Table;
use crate::text::{any_of, quoted};
use crate::unit::perpendicular;
use crate::values::plain;
use crate::{Light, LightKind, SceneError};

/// What every light has.
const COMMON: [&str; 4] = ["name", "type", "color", "intensity"];

/// What each kind has beside it.
const KINDS: [(&str, &[&str]); 6] = [
    ("point", &["position", "motion"]),
    ("directional", &["direction"]),
    ("spot", &["position", "direction", "inner_angle", "outer_angle", "motion"]),
    ("sphere", &["position", "radius", "motion"]),
    ("disc", &["position", "direction", "radius", "motion"]),
    ("rectangle", &["position", "direction", "right", "width", "height", "motion"]),
];

/// Sine of the angle between `right` and `direction` of a rectangle below which `right` gives none.
const MIN_RIGHT_SINE: f64 = 1e-6;

/// A light whose name the caller has checked.
pub(crate) fn light(mut table: Table<'_>) -> Result<Light, SceneError> {
    let name = table.require("name", "name = \"key\"")?.file_name()?.to_owned();
    table.what = format!("light {}", quoted(&name));
    let kind = table.require("type", "type = \"point\"")?.word(&KINDS.map(|(kind, _)| kind))?;
    allow(&table, kind)?;

    let position = if kind == "directional" {
        DVec3::ZERO
    } else {
        table.require("position", "position = [4.0, 8.0, 0.0]")?.point("position = [4.0, 8.0, 0.0]")?
    };
    let color = match table.get("color") {
        Some(field) => field.vector(0.0, MAX_LIGHT_COLOR, "color = [1.0, 1.0, 1.0] (linear RGB)")?,
        None => DVec3::ONE,
    };
    let example = if kind == "directional" { "intensity = 3.0 (lux)" } else { "intensity = 120.0 (candela)" };
    let intensity = table.require("intensity", example)?.number(0.0, MAX_BRIGHTNESS, example)?;
    let motion = table.get("motion").map(|field| motion(&field)).transpose()?;
    Ok(Light { kind: light_kind(&table, kind)?, name, position, color, intensity, motion })
}

/// Refuses keys that this kind of light has not, and says which kinds have them.
fn allow(table: &Table<'_>, kind: &str) -> Result<(), SceneError> {
    let own = KINDS.iter().find(|(k, _)| *k == kind).map_or(&[][..], |(_, keys)| keys);
    let valid: Vec<&str> = COMMON.iter().chain(own).copied().collect();
    table.allow(&valid, |key| {
        let owners: Vec<&str> =
            KINDS.iter().filter(|(_, keys)| keys.contains(&key)).map(|(kind, _)| *kind).collect();
        let what = format!("\"{key}\" is no key of a {kind} light, which {} is", table.what);
        match (owners.as_slice(), kind, key) {
            ([], ..) => None,
            (_, "directional", "position" | "motion") => {
                Some((what, "leave it out: a directional light is infinitely far away".to_owned()))
            }
            (owners, ..) => {
                Some((what, format!("leave it out, or write type = {}", any_of(&in_quotes(owners)))))
            }
        }
    })
}

fn in_quotes(words: &[&str]) -> Vec<String> {
    words.iter().map(|w| format!("\"{w}\"")).collect()
}

fn light_kind(table: &Table<'_>, kind: &str) -> Result<LightKind, SceneError> {
    let direction = || {
        let example = "direction = [0.0, -1.0, 0.0] (where the light shines)";
        table.require("direction", example)?.direction(example)
    };
    let length = |key: &str, example: &str| table.require(key, example)?.length(example);
    Ok(match kind {
        "directional" => LightKind::Directional { direction: direction()? },
        "spot" => {
            let direction = direction()?;
            let (inner_angle, outer_angle) = spot_angles(table)?;
            LightKind::Spot { direction, inner_angle, outer_angle }
        }
        "sphere" => LightKind::Sphere { radius: length("radius", "radius = 0.5")? },
        "disc" => LightKind::Disc { direction: direction()?, radius: length("radius", "radius = 0.5")? },
        "rectangle" => {
            let direction = direction()?;
            let example = "right = [1.0, 0.0, 0.0] (along the rectangle's width)";
            let field = table.require("right", example)?;
            let right = field.direction(example)?;
            if direction.cross(right).length() < MIN_RIGHT_SINE {
                return Err(field.error(
                    format!("{} is parallel to its \"direction\"", field.what),
                    "write a vector in the rectangle's plane, along its width",
                ));
            }
            LightKind::Rectangle {
                direction,
                right: perpendicular(right, direction),
                width: length("width", "width = 1.0")?,
                height: length("height", "height = 1.0")?,
            }
        }
        _ => LightKind::Point,
    })
}

/// Half-angles in radians; 0 and 45° where the file gives none, as in glTF.
fn spot_angles(table: &Table<'_>) -> Result<(f64, f64), SceneError> {
    // Narrower cones than this cannot be told from rays, and their cosines not from each other.
    const NARROWEST: f64 = 0.01;
    let (inner, outer) = (table.get("inner_angle"), table.get("outer_angle"));
    let example = "inner_angle = 20.0 (half-angle in degrees, below outer_angle)";
    let inner_degrees = inner.as_ref().map_or(Ok(0.0), |f| f.number(0.0, 90.0, example))?;
    let example = "outer_angle = 30.0 (half-angle in degrees, at most 90)";
    let outer_degrees = outer.as_ref().map_or(Ok(45.0), |f| f.number(NARROWEST, 90.0, example))?;
    if inner_degrees < outer_degrees && inner_degrees.to_radians() < outer_degrees.to_radians() {
        return Ok((inner_degrees.to_radians(), outer_degrees.to_radians()));
    }
    let what = format!(
        "\"inner_angle\" of {} is {}, which is not below its \"outer_angle\" of {}",
        table.what,
        plain(inner_degrees),
        plain(outer_degrees)
    );
    let instead = "write half-angles in degrees, 0 <= inner_angle < outer_angle <= 90";
    Err(inner.or(outer).map_or_else(|| table.error(&*what, instead), |field| field.error(&*what, instead)))
}
