//! What `render` and `trace` say when they are done.

use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::console;
use crate::draw::Driver;
use crate::error::{CliError, OneLine};

/// One rendered scene; with `--json` printed as it is.
#[derive(Debug, Serialize)]
pub(crate) struct Report {
    /// The scene file.
    pub(crate) scene: String,
    /// The technique, with the options that were set.
    pub(crate) technique: String,
    /// `gl` or `cpu`.
    pub(crate) backend: &'static str,
    /// Pixels across.
    pub(crate) width: u32,
    /// Pixels down.
    pub(crate) height: u32,
    /// The moment, seconds.
    pub(crate) time: f64,
    /// Samples a pixel of multisampling; `null` on the CPU.
    pub(crate) msaa: Option<u32>,
    /// Rays a pixel; `null` with OpenGL.
    pub(crate) samples: Option<u32>,
    /// How many lights the scene has.
    pub(crate) lights: usize,
    /// How many objects the scene has.
    pub(crate) objects: usize,
    /// The OpenGL driver; `null` on the CPU.
    pub(crate) driver: Option<Driver>,
    /// Time the drawing took, without reading the scene and writing files.
    pub(crate) milliseconds: f64,
    /// What was written, the picture first.
    pub(crate) files: Vec<String>,
}

impl Report {
    /// Prints the report, as one JSON object or as text.
    ///
    /// # Errors
    /// Those of standard output.
    pub(crate) fn print(&self, json: bool) -> Result<(), CliError> {
        if json {
            return console::json(self);
        }
        let with = match &self.driver {
            Some(driver) => driver.renderer.as_str(),
            None => "the CPU",
        };
        let (lights, objects) = (count(self.lights, "light"), count(self.objects, "object"));
        for file in &self.files {
            console::line(OneLine(file))?;
        }
        console::line(format_args!(
            "{}x{}, {lights}, {objects}: {:.1} ms, {} on {with}",
            self.width, self.height, self.milliseconds, self.technique
        ))
    }
}

/// Paths as text. What is not Unicode in them is replaced: JSON cannot hold it.
pub(crate) fn texts(paths: &[PathBuf]) -> Vec<String> {
    paths.iter().map(|path| text(path)).collect()
}

/// A path as text, as [`texts`].
pub(crate) fn text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}

/// A number with its noun, in the plural where it takes one.
pub(crate) fn count(number: usize, noun: &str) -> String {
    match (number, noun) {
        (1, noun) => format!("1 {noun}"),
        (number, noun) if noun.ends_with("box") => format!("{number} {noun}es"),
        (number, noun) if noun.ends_with("mesh") => format!("{number} {noun}es"),
        (number, noun) => format!("{number} {noun}s"),
    }
}
