//! The page: one file, with every picture in it.

use std::io;

use askama::Template;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::measure::Comparison;
use super::report::{LightRow, Refusal, Report, Row};
use super::{Subject, digits, error_map};
use crate::output::Picture;
use crate::output::png::{write_picture, write_rgb8};
use crate::report::count;

#[derive(Template)]
#[template(path = "compare.html")]
struct Page<'a> {
    /// The scene's name.
    title: String,
    /// The scene's file.
    scene: &'a str,
    size: String,
    aspect: String,
    contents: String,
    moment: f64,
    renderer: &'a str,
    software: bool,
    timer: &'a str,
    frames: usize,
    samples: u32,
    reference: String,
    reference_ms: String,
    reference_plain_ms: String,
    without_rmse: String,
    without_flip: String,
    techniques: Vec<Shown<'a>>,
    refused: &'a [Refusal],
    legend: String,
    version: &'a str,
}

/// A technique as the page shows it.
struct Shown<'a> {
    name: &'a str,
    summary: &'a str,
    picture: String,
    error: String,
    wrong_1px: usize,
    wrong_2px: usize,
    edge_rms: String,
    rmse: String,
    flip: String,
    ms: String,
    p95: String,
    plain: String,
    lights: Vec<ShownLight<'a>>,
    best: Best,
}

/// In which columns a technique is best or as good.
#[derive(Default)]
struct Best {
    wrong_1px: bool,
    wrong_2px: bool,
    edge_rms: bool,
    rmse: bool,
    flip: bool,
    ms: bool,
}

/// A light as the page shows it.
struct ShownLight<'a> {
    name: &'a str,
    wrong_1px: usize,
    wrong_2px: usize,
    edge_pixels: usize,
    edge_rms: String,
}

/// The page's text.
///
/// # Errors
/// Those of the encoder and the template.
pub(super) fn page(subject: &Subject, comparison: &Comparison, report: &Report) -> io::Result<String> {
    let size = subject.size;
    let picture = |pixels: &[[f32; 3]]| {
        let exposure = subject.scene.image.exposure;
        let picture = Picture { width: size.width, height: size.height, pixels, exposure };
        embedded(|to| write_picture(&picture, to))
    };
    let mut techniques = Vec::new();
    for (entry, row) in comparison.entries.iter().zip(&report.techniques) {
        let errors = error_map::picture(&entry.errors);
        techniques.push(Shown {
            name: &row.technique,
            summary: row.summary,
            picture: picture(&entry.pixels)?,
            error: embedded(|to| write_rgb8(size.width as usize, size.height as usize, &errors, to))?,
            wrong_1px: row.misclassified_1px,
            wrong_2px: row.misclassified_2px,
            edge_rms: rms(row.edge_rms),
            rmse: digits(row.rmse, 4),
            flip: digits(row.flip, 4),
            ms: digits(row.timing.median_ms, 2),
            p95: digits(row.timing.p95_ms, 2),
            plain: digits(row.timing.plain_ms, 2),
            lights: row.lights.iter().map(light).collect(),
            best: best(row, &report.techniques),
        });
    }
    let first = report.techniques.first();
    let page = Page {
        title: super::title(&report.scene),
        scene: &report.scene,
        size: format!("{}×{}", report.width, report.height),
        aspect: format!("{} / {}", report.width, report.height),
        contents: format!("{}, {}", count(report.lights.len(), "light"), count(report.objects, "object")),
        moment: report.time,
        renderer: &report.driver.renderer,
        software: report.driver.software,
        timer: first.map_or("", |row| row.timing.timer),
        frames: first.map_or(0, |row| row.timing.frames),
        samples: report.reference.samples,
        reference: picture(&comparison.truth)?,
        reference_ms: digits(report.reference.timing.median_ms, 2),
        reference_plain_ms: digits(report.reference.timing.plain_ms, 2),
        without_rmse: digits(report.without_shadows.rmse, 4),
        without_flip: digits(report.without_shadows.flip, 4),
        techniques,
        refused: &report.refused,
        legend: legend(),
        version: env!("CARGO_PKG_VERSION"),
    };
    page.render().map_err(io::Error::other)
}

fn light(row: &LightRow) -> ShownLight<'_> {
    ShownLight {
        name: &row.light,
        wrong_1px: row.misclassified_1px,
        wrong_2px: row.misclassified_2px,
        edge_pixels: row.edge_pixels,
        edge_rms: rms(row.edge_rms),
    }
}

fn rms(value: Option<f64>) -> String {
    value.map_or_else(|| "–".to_owned(), |value| digits(value, 4))
}

/// Nothing is best among one. Numbers that look the same are equally good.
fn best(row: &Row, all: &[Row]) -> Best {
    if all.len() < 2 {
        return Best::default();
    }
    let least = |of: &dyn Fn(&Row) -> f64, places: i32| {
        let rounded = |row: &Row| (of(row) * 10f64.powi(places)).round();
        all.iter().all(|other| !(rounded(other) < rounded(row)))
    };
    Best {
        wrong_1px: least(&|row| row.misclassified_1px as f64, 0),
        wrong_2px: least(&|row| row.misclassified_2px as f64, 0),
        edge_rms: row.edge_rms.is_some() && least(&|row| row.edge_rms.unwrap_or(f64::INFINITY), 4),
        rmse: least(&|row| row.rmse, 4),
        flip: least(&|row| row.flip, 4),
        ms: least(&|row| row.timing.median_ms, 2),
    }
}

/// A PNG as a `data:` address.
fn embedded(write: impl FnOnce(&mut Vec<u8>) -> io::Result<()>) -> io::Result<String> {
    let mut bytes = Vec::new();
    write(&mut bytes)?;
    Ok(format!("data:image/png;base64,{}", STANDARD.encode(bytes)))
}

/// The colours of errors from 0 to 1, as a gradient of CSS.
fn legend() -> String {
    let stops = (0..=16).map(|i| {
        let [r, g, b] = error_map::color(i as f32 / 16.0);
        format!("rgb({r} {g} {b})")
    });
    format!("linear-gradient(to right, {})", stops.collect::<Vec<_>>().join(", "))
}
