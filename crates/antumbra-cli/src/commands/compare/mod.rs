//! `antumbra compare`: every technique on one scene, held against the ray tracer.

mod canvas;
mod error_map;
mod measure;
mod page;
mod report;
mod sheet;

use std::io::Write;
use std::path::{Path, PathBuf};

use antumbra_scene::Scene;

use crate::args::{CompareArgs, Size};
use crate::commands::size;
use crate::console;
use crate::draw::OpenGl;
use crate::error::CliError;
use crate::output::plan::{check_directory, check_file};
use crate::output::staged::Staged;
use crate::report::{text, texts};
use crate::technique::Technique;
use measure::Comparison;
use report::{Refusal, Report};

/// The most pixels: every technique's picture and error are held at once, and the page embeds them all.
const MAX_PIXELS: u64 = 1 << 23;

/// What is written, in the directory.
const FILES: [&str; 3] = ["index.html", "contact-sheet.png", "compare.json"];

/// What is compared.
struct Subject<'a> {
    scene: &'a Scene,
    size: Size,
    time: f64,
    /// Rays a pixel of the reference.
    samples: u32,
    /// Frames that are timed.
    frames: u32,
}

/// Compares techniques on a scene.
///
/// # Errors
/// A scene that no technique but the reference can do, and whatever is wrong with scene, files or OpenGL.
pub(crate) fn run(arguments: &CompareArgs) -> Result<(), CliError> {
    let scene = Scene::load(&arguments.scene)?;
    let size = size(arguments.size, &scene)?;
    if size.pixels() > MAX_PIXELS {
        return Err(CliError::Usage(format!(
            "{}x{} is too large for a comparison; it has at most {MAX_PIXELS} pixels: give a smaller --size",
            size.width, size.height
        )));
    }
    let paths = FILES.map(|name| arguments.output.join(name));
    check_directory(&arguments.output)?;
    for path in &paths {
        check_file(path)?;
    }
    let asked = if arguments.techniques.is_empty() { Technique::all() } else { arguments.techniques.clone() };
    let asked = match arguments.soft {
        // The reference has a way of its own.
        Some(soft) => {
            asked.into_iter().map(|technique| technique.with_soft(soft).unwrap_or(technique)).collect()
        }
        None => asked,
    };
    let (able, refused) = choose(asked, &scene, arguments.time);
    if able.is_empty() {
        return Err(nothing_to_compare(&arguments.scene, &refused));
    }
    let mut gl = OpenGl::open().map_err(CliError::without_opengl)?;
    let driver = gl.driver();

    let subject = Subject {
        scene: &scene,
        size,
        time: arguments.time,
        samples: arguments.samples,
        frames: arguments.frames,
    };
    let comparison = measure::compare(&subject, &able, &mut gl)?;
    let report = Report::new(&text(&arguments.scene), &subject, driver, &comparison, refused, texts(&paths));
    write(&arguments.output, &paths, &subject, &comparison, &report)?;
    report.print(arguments.json)
}

/// The techniques that can do the scene, without the reference, which always takes part; and why others cannot.
fn choose(asked: Vec<Technique>, scene: &Scene, time: f64) -> (Vec<Technique>, Vec<Refusal>) {
    let mut able: Vec<Technique> = Vec::new();
    let mut refused = Vec::new();
    for technique in asked {
        if technique == Technique::Raytraced || able.contains(&technique) {
            continue;
        }
        match technique.objection(scene, time) {
            None => able.push(technique),
            Some(reason) => refused.push(Refusal { technique: technique.to_string(), reason }),
        }
    }
    (able, refused)
}

fn nothing_to_compare(scene: &Path, refused: &[Refusal]) -> CliError {
    let what = match refused {
        [] => "no technique to compare with the reference; name one besides raytraced".to_owned(),
        [only] => format!("{} cannot draw {}: {}", only.technique, scene.display(), only.reason),
        [first, ..] => format!(
            "none of {} techniques can draw {}; {}: {}",
            refused.len(),
            scene.display(),
            first.technique,
            first.reason
        ),
    };
    CliError::Usage(what)
}

fn write(
    directory: &Path,
    paths: &[PathBuf; 3],
    subject: &Subject,
    comparison: &Comparison,
    report: &Report,
) -> Result<(), CliError> {
    let mut staged = Staged::default();
    staged.directory(directory)?;
    let page = page::page(subject, comparison, report)
        .map_err(|error| CliError::output(&paths[0], format!("cannot make the page: {error}")))?;
    staged.file(&paths[0], |to| to.write_all(page.as_bytes()))?;
    staged.file(&paths[1], |to| sheet::write(subject, comparison, report, to))?;
    staged.file(&paths[2], |to| {
        serde_json::to_writer_pretty(&mut *to, report)?;
        to.write_all(b"\n")
    })?;
    staged.commit()
}

/// What people call a scene: the name of its file.
fn title(scene: &str) -> String {
    Path::new(scene).file_stem().map_or_else(|| scene.to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// A number with so many digits after the point, or a dash where it is none.
fn digits(value: f64, digits: usize) -> String {
    if value.is_finite() { format!("{value:.digits$}") } else { "–".to_owned() }
}

/// Prints lines.
fn lines(lines: impl IntoIterator<Item = String>) -> Result<(), CliError> {
    lines.into_iter().try_for_each(console::line)
}
