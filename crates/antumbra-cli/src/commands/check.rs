//! `antumbra check`: whether scene files are right, and what is in them.

use std::path::Path;

use antumbra_scene::Scene;
use serde::Serialize;

use crate::args::CheckArgs;
use crate::console;
use crate::error::{CliError, OneLine};
use crate::report::{count, text};
use crate::technique::Technique;

/// What `--json` prints.
#[derive(Serialize)]
struct Report {
    /// One for each file, in the order they were named.
    scenes: Vec<Entry>,
}

/// One scene file.
#[derive(Serialize)]
#[serde(untagged)]
enum Entry {
    /// The file is right.
    Right(Box<Summary>),
    /// The file is wrong.
    Wrong {
        /// The file.
        scene: String,
        /// Always false.
        valid: bool,
        /// What is wrong, with line and column.
        error: String,
    },
}

/// What is in a scene.
#[derive(Serialize)]
struct Summary {
    /// The file.
    scene: String,
    /// Always true.
    valid: bool,
    /// Pixels across.
    width: u32,
    /// Pixels down.
    height: u32,
    /// How many lights of each kind, in the order of the first of each.
    lights: Vec<Tally>,
    /// How many objects; each has one shape or more.
    objects: usize,
    /// How many shapes of each kind, in the order of the first of each.
    shapes: Vec<Tally>,
    /// Whether a light or an object moves.
    moving: bool,
    /// The techniques that can do the scene.
    techniques: Vec<&'static str>,
    /// Why others cannot.
    limits: Vec<String>,
}

/// How many of a kind.
#[derive(Debug, PartialEq, Eq, Serialize)]
struct Tally {
    /// The kind, as scene files write it.
    kind: &'static str,
    /// How many.
    count: usize,
}

/// Checks scene files.
///
/// # Errors
/// The scene error where one file is wrong; where several are, one error that names the first, and standard output
/// lists all.
pub(crate) fn run(arguments: &CheckArgs) -> Result<(), CliError> {
    let mut entries = Vec::new();
    let mut wrong = Vec::new();
    for path in &arguments.scenes {
        entries.push(match Scene::load(path) {
            Ok(scene) => Entry::Right(Box::new(summarise(path, &scene))),
            Err(error) => {
                let message = error.to_string();
                wrong.push(error);
                Entry::Wrong { scene: text(path), valid: false, error: message }
            }
        });
    }
    if arguments.json {
        console::json(&Report { scenes: entries })?;
    } else {
        for entry in &entries {
            print(entry, wrong.len())?;
        }
    }
    let number = wrong.len();
    match wrong.into_iter().next() {
        None => Ok(()),
        Some(error) if number == 1 => Err(error.into()),
        Some(first) => {
            let all = arguments.scenes.len();
            Err(CliError::Usage(format!("{number} of {all} scenes are wrong, the first: {first}")))
        }
    }
}

fn print(entry: &Entry, wrong: usize) -> Result<(), CliError> {
    match entry {
        // A single wrong file is told of on standard error.
        Entry::Wrong { .. } if wrong == 1 => Ok(()),
        Entry::Wrong { error, .. } => console::line(format_args!("wrong: {}", OneLine(error))),
        Entry::Right(summary) => {
            console::line(format_args!("{}: right", OneLine(&summary.scene)))?;
            let moving = if summary.moving { ", moving" } else { "" };
            console::line(format_args!("  picture     {}x{}{moving}", summary.width, summary.height))?;
            console::line(format_args!("  lights      {}", list(&summary.lights)))?;
            let objects = count(summary.objects, "object");
            console::line(format_args!("  objects     {objects}: {}", list(&summary.shapes)))?;
            console::line(format_args!("  techniques  {}", summary.techniques.join(", ")))?;
            for limit in &summary.limits {
                console::line(format_args!("              {}", OneLine(limit)))?;
            }
            Ok(())
        }
    }
}

fn list(tallies: &[Tally]) -> String {
    if tallies.is_empty() {
        return "none".to_owned();
    }
    let counts: Vec<String> = tallies.iter().map(|tally| count(tally.count, tally.kind)).collect();
    counts.join(", ")
}

fn summarise(path: &Path, scene: &Scene) -> Summary {
    let shapes = scene.objects.iter().flat_map(|object| &object.parts).map(|part| part.shape.type_name());
    let mut techniques = Vec::new();
    let mut limits = Vec::new();
    for technique in Technique::all() {
        match technique.objection(scene, 0.0) {
            None => techniques.push(technique.name()),
            Some(objection) => limits.push(format!("not {}: {objection}", technique.name())),
        }
    }
    Summary {
        scene: text(path),
        valid: true,
        width: scene.image.width,
        height: scene.image.height,
        lights: tally(scene.lights.iter().map(|light| light.kind.type_name())),
        objects: scene.objects.len(),
        shapes: tally(shapes),
        moving: scene.lights.iter().any(|light| light.motion.is_some())
            || scene.objects.iter().any(|object| object.motion.is_some()),
        techniques,
        limits,
    }
}

fn tally(kinds: impl Iterator<Item = &'static str>) -> Vec<Tally> {
    let mut tallies: Vec<Tally> = Vec::new();
    for kind in kinds {
        match tallies.iter_mut().find(|tally| tally.kind == kind) {
            Some(tally) => tally.count += 1,
            None => tallies.push(Tally { kind, count: 1 }),
        }
    }
    tallies
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tallies_keep_the_order() {
        let tallies = tally(["sphere", "box", "sphere", "mesh", "box"].into_iter());
        assert_eq!(
            list(&tallies),
            "2 spheres, 2 boxes, 1 mesh",
            "counted, in the order of the first of each"
        );
        assert_eq!(list(&[]), "none", "no light at all is allowed");
    }
}
