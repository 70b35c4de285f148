//! The numbers of a comparison, for programs and as text.

use serde::Serialize;

use super::measure::{Comparison, Entry, VisibilityError};
use super::{Subject, digits, lines};
use crate::console;
use crate::draw::Driver;
use crate::error::{CliError, OneLine};
use crate::report::count;
use crate::timing::Timing;

/// `compare.json`; with `--json` printed as it is.
#[derive(Debug, Serialize)]
pub(super) struct Report {
    /// The scene file.
    pub(super) scene: String,
    /// Pixels across.
    pub(super) width: u32,
    /// Pixels down.
    pub(super) height: u32,
    /// The moment, seconds.
    pub(super) time: f64,
    /// Names of the lights.
    pub(super) lights: Vec<String>,
    /// How many objects the scene has.
    pub(super) objects: usize,
    /// The OpenGL driver.
    pub(super) driver: Driver,
    /// The ray tracer, which the others are held against.
    pub(super) reference: Reference,
    /// The picture without any shadow: what the others are to be seen against.
    pub(super) without_shadows: Without,
    /// The techniques that can do the scene.
    pub(super) techniques: Vec<Row>,
    /// Those that cannot, and why.
    pub(super) refused: Vec<Refusal>,
    /// What was written.
    pub(super) files: Vec<String>,
}

/// The reference.
#[derive(Debug, Serialize)]
pub(super) struct Reference {
    /// Its name.
    pub(super) technique: &'static str,
    /// Rays a pixel of its picture.
    pub(super) samples: u32,
    /// A whole frame on the CPU with one ray a pixel.
    #[serde(flatten)]
    pub(super) timing: Timing,
}

/// How far off a picture without shadows is.
#[derive(Debug, Serialize)]
pub(super) struct Without {
    /// As of a technique.
    pub(super) rmse: f64,
    /// As of a technique.
    pub(super) flip: f64,
}

/// One technique.
#[derive(Debug, Serialize)]
pub(super) struct Row {
    /// The technique, with the options that were set.
    pub(super) technique: String,
    /// What it does.
    pub(super) summary: &'static str,
    /// Pixels of all lights' visibility on the wrong side of 1/2, outside a band of one pixel round the true edges.
    pub(super) misclassified_1px: usize,
    /// The same outside two pixels.
    pub(super) misclassified_2px: usize,
    /// Pixels that are partly lit in truth, of all lights.
    pub(super) edge_pixels: usize,
    /// Root mean squared error of visibility on those; `null` where there are none.
    pub(super) edge_rms: Option<f64>,
    /// Root mean squared error of the picture in linear light.
    pub(super) rmse: f64,
    /// Mean ꟻLIP of the picture.
    pub(super) flip: f64,
    /// What a frame takes.
    #[serde(flatten)]
    pub(super) timing: Timing,
    /// The same for each light.
    pub(super) lights: Vec<LightRow>,
}

/// One light of one technique.
#[derive(Debug, Serialize)]
pub(super) struct LightRow {
    /// Name of the light.
    pub(super) light: String,
    /// As of the technique.
    pub(super) misclassified_1px: usize,
    /// As of the technique.
    pub(super) misclassified_2px: usize,
    /// As of the technique.
    pub(super) edge_pixels: usize,
    /// As of the technique.
    pub(super) edge_rms: Option<f64>,
}

/// A technique that cannot do the scene.
#[derive(Debug, Serialize)]
pub(super) struct Refusal {
    /// The technique, with the options that were set.
    pub(super) technique: String,
    /// What it cannot do, and what can.
    pub(super) reason: String,
}

impl Report {
    pub(super) fn new(
        scene: &str,
        subject: &Subject,
        driver: Driver,
        comparison: &Comparison,
        refused: Vec<Refusal>,
        files: Vec<String>,
    ) -> Self {
        Self {
            scene: scene.to_owned(),
            width: subject.size.width,
            height: subject.size.height,
            time: subject.time,
            lights: comparison.lights.clone(),
            objects: subject.scene.objects.len(),
            driver,
            reference: Reference {
                technique: "raytraced",
                samples: subject.samples,
                timing: comparison.traced.clone(),
            },
            without_shadows: Without { rmse: comparison.without.rmse, flip: comparison.without.flip },
            techniques: comparison.entries.iter().map(|entry| row(entry, &comparison.lights)).collect(),
            refused,
            files,
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
        lines(self.files.iter().map(|file| OneLine(file).to_string()))?;
        let (lights, objects) = (count(self.lights.len(), "light"), count(self.objects, "object"));
        console::line(format_args!(
            "{}x{}, {lights}, {objects}, on {}; times are medians of {} frames, {}",
            self.width,
            self.height,
            OneLine(&self.driver.renderer),
            self.techniques.first().map_or(0, |row| row.timing.frames),
            self.techniques.first().map_or("", |row| row.timing.timer),
        ))?;
        lines(self.table())?;
        lines(
            self.refused
                .iter()
                .map(|refusal| format!("not {}: {}", refusal.technique, OneLine(&refusal.reason))),
        )
    }

    fn table(&self) -> Vec<String> {
        let names = self.techniques.iter().map(|row| row.technique.chars().count());
        let wide = names.max().unwrap_or(0).max("without shadows".len());
        let line = |name: &str, cells: [String; 7]| {
            let [one, two, edge, rmse, flip, ms, plain] = cells;
            format!("{name:wide$} {one:>9} {two:>9} {edge:>9} {rmse:>8} {flip:>8} {ms:>9} {plain:>9}")
        };
        let head =
            ["wrong 1px", "wrong 2px", "edge RMS", "RMSE", "FLIP", "ms", "ms plain"].map(str::to_owned);
        let mut table = vec![line("", head)];
        for row in &self.techniques {
            table.push(line(
                &row.technique,
                [
                    row.misclassified_1px.to_string(),
                    row.misclassified_2px.to_string(),
                    row.edge_rms.map_or_else(|| "-".to_owned(), |rms| digits(rms, 4)),
                    digits(row.rmse, 4),
                    digits(row.flip, 4),
                    digits(row.timing.median_ms, 2),
                    digits(row.timing.plain_ms, 2),
                ],
            ));
        }
        let dash = || "-".to_owned();
        let (rmse, flip) = (digits(self.without_shadows.rmse, 4), digits(self.without_shadows.flip, 4));
        table.push(line("without shadows", [dash(), dash(), dash(), rmse, flip, dash(), dash()]));
        let traced = &self.reference.timing;
        let (ms, plain) = (digits(traced.median_ms, 2), digits(traced.plain_ms, 2));
        table.push(line("raytraced (CPU)", [dash(), dash(), dash(), dash(), dash(), ms, plain]));
        table
    }
}

fn row(entry: &Entry, names: &[String]) -> Row {
    let sum = |of: fn(&VisibilityError) -> usize| entry.lights.iter().map(of).sum();
    let edge_pixels: usize = sum(|light| light.edge_pixels);
    let squares: f64 =
        entry.lights.iter().map(|light| light.edge_rms.powi(2) * light.edge_pixels as f64).sum();
    let rms = |pixels: usize, value: f64| (pixels > 0).then_some(value);
    Row {
        technique: entry.technique.to_string(),
        summary: entry.technique.summary(),
        misclassified_1px: sum(|light| light.wrong_1px),
        misclassified_2px: sum(|light| light.wrong_2px),
        edge_pixels,
        edge_rms: rms(edge_pixels, (squares / edge_pixels.max(1) as f64).sqrt()),
        rmse: entry.picture.rmse,
        flip: entry.picture.flip,
        timing: entry.timing.clone(),
        lights: entry
            .lights
            .iter()
            .zip(names)
            .map(|(light, name)| LightRow {
                light: name.clone(),
                misclassified_1px: light.wrong_1px,
                misclassified_2px: light.wrong_2px,
                edge_pixels: light.edge_pixels,
                edge_rms: rms(light.edge_pixels, light.edge_rms),
            })
            .collect(),
    }
}
