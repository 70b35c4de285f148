//! The rows of a benchmark, for programs and as text.

use std::fmt;

use antumbra_scene::{LightKind, Scene};
use serde::Serialize;

use super::figures::Place;
use crate::args::FigureName;
use crate::console;
use crate::draw::Driver;
use crate::error::{CliError, OneLine};
use crate::technique::Technique;
use crate::timing::Timing;

/// `bench.json`; with `--json` printed as it is.
#[derive(Debug, Serialize)]
pub(super) struct Report {
    /// The OpenGL driver; `null` where only the CPU was measured.
    pub(super) driver: Option<Driver>,
    /// Threads that the ray tracer and a software renderer may use.
    pub(super) threads: usize,
    /// The measurements.
    pub(super) rows: Vec<Row>,
    /// What was not measured, and why.
    pub(super) refused: Vec<Refusal>,
    /// What was written.
    pub(super) files: Vec<String>,
}

/// One technique on one scene; also a line of `bench.csv`.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Row {
    /// The figure.
    pub(super) figure: &'static str,
    /// The technique, with the options that were set.
    pub(super) technique: String,
    /// How shadows of lights with an area are made; `null` where no light has one.
    pub(super) soft: Option<String>,
    /// How many points each light with an area is made of; `null` where none are, or no light has one.
    pub(super) components: Option<u32>,
    /// The technique whatever that number.
    #[serde(skip)]
    pub(super) family: String,
    /// The scene; `scenes/<scene>.toml`.
    pub(super) scene: String,
    /// How many lights.
    pub(super) lights: usize,
    /// How many shapes cast shadows.
    pub(super) occluders: usize,
    /// Pixels across.
    pub(super) width: u32,
    /// Pixels down.
    pub(super) height: u32,
    /// Median of the frames with shadows.
    pub(super) median_ms: f64,
    /// The time that 95 of 100 frames keep within.
    pub(super) p95_ms: f64,
    /// Median of the same frame without shadows.
    pub(super) plain_ms: f64,
    /// Which clock.
    pub(super) timer: &'static str,
    /// How many frames of each were measured.
    pub(super) frames: usize,
    /// Root mean square error of the visibility inside the penumbra, against the ray tracer at 4096 rays; `null` where
    /// it was not measured.
    pub(super) penumbra_rmse: Option<f64>,
}

/// A technique that cannot do a scene.
#[derive(Debug, Serialize)]
pub(super) struct Refusal {
    /// The technique.
    pub(super) technique: String,
    /// The scene.
    pub(super) scene: String,
    /// What it cannot do, and what can.
    pub(super) reason: String,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} on {}: {}", self.technique, self.scene, self.reason)
    }
}

impl Row {
    pub(super) fn new(
        figure: FigureName,
        technique: &Technique,
        place: &Place,
        scene: &Scene,
        timing: Timing,
    ) -> Self {
        let soft = scene.lights.iter().any(has_area);
        let casting = scene.objects.iter().filter(|object| object.casts_shadow);
        Self {
            figure: figure.text(),
            technique: technique.to_string(),
            soft: soft.then(|| technique.soft()),
            components: technique.components().filter(|_| soft),
            family: technique.family(),
            scene: place.scene.clone(),
            lights: scene.lights.len(),
            occluders: casting.map(|object| object.parts.len()).sum(),
            width: place.size.width,
            height: place.size.height,
            median_ms: timing.median_ms,
            p95_ms: timing.p95_ms,
            plain_ms: timing.plain_ms,
            timer: timing.timer,
            frames: timing.frames,
            penumbra_rmse: None,
        }
    }
}

fn has_area(light: &antumbra_scene::Light) -> bool {
    !matches!(light.kind, LightKind::Point | LightKind::Directional { .. } | LightKind::Spot { .. })
}

impl Report {
    pub(super) fn new(driver: Option<Driver>) -> Self {
        Self {
            driver,
            threads: std::thread::available_parallelism().map_or(1, usize::from),
            rows: Vec::new(),
            refused: Vec::new(),
            files: Vec::new(),
        }
    }

    /// Prints the report, as one JSON object or as text.
    ///
    /// # Errors
    /// Those of standard output.
    pub(super) fn print(&self, json: bool) -> Result<(), CliError> {
        if json {
            return console::json(self);
        }
        // The scenes are many; their directory goes without saying.
        let own = self.files.iter().filter(|file| !file.ends_with(".toml"));
        own.into_iter().try_for_each(|file| console::line(OneLine(file)))?;
        if let Some(driver) = &self.driver {
            console::line(format_args!("OpenGL on {}", OneLine(&driver.renderer)))?;
        }
        let scene = widest("scene", self.rows.iter().map(|row| row.scene.as_str()));
        let name = widest("technique", self.rows.iter().map(|row| row.technique.as_str()));
        let (first, second) = ("scene", "technique");
        console::line(format_args!(
            "{first:scene$}  {second:name$}  {:>9}  {:>9}  {:>9}  {:>9}  {:>6}  {:>8}  timer",
            "size", "median ms", "p95 ms", "plain ms", "frames", "penumbra"
        ))?;
        for row in &self.rows {
            console::line(format_args!(
                "{:scene$}  {:name$}  {:>9}  {:>9.2}  {:>9.2}  {:>9.2}  {:>6}  {:>8}  {}",
                row.scene,
                row.technique,
                format!("{}x{}", row.width, row.height),
                row.median_ms,
                row.p95_ms,
                row.plain_ms,
                row.frames,
                row.penumbra_rmse.map_or_else(|| "-".to_owned(), |error| format!("{error:.5}")),
                row.timer
            ))?;
        }
        self.refused.iter().try_for_each(|refusal| console::line(format_args!("not {}", OneLine(refusal))))
    }
}

fn widest<'a>(head: &'a str, texts: impl Iterator<Item = &'a str>) -> usize {
    texts.chain([head]).map(|text| text.chars().count()).max().unwrap_or(0)
}
