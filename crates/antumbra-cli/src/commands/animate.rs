//! `antumbra animate`: one round of a scene's motions, as an animated PNG.

use std::fs;
use std::io::{self, Write};

use antumbra_host::HostError;
use antumbra_scene::Scene;
use serde::Serialize;

use crate::args::{AnimateArgs, Size};
use crate::commands::look::technique;
use crate::commands::{picture, size};
use crate::console;
use crate::draw::{self, Drawing, Driver, OpenGl, Request};
use crate::error::{CliError, OneLine};
use crate::output::apng::Animation;
use crate::output::plan::{destination, extension};
use crate::output::png;
use crate::output::staged::Staged;
use crate::progress::Progress;
use crate::report;
use crate::technique::Technique;
use crate::timeline::{Timeline, Wanted, repeats_after};

/// Rays a pixel on the CPU where `--msaa` does not say: smooth edges and little noise, in seconds a frame.
const CPU_SAMPLES: u32 = 16;

/// What was animated; with `--json` printed as it is.
#[derive(Debug, Serialize)]
struct Report {
    scene: String,
    technique: String,
    backend: &'static str,
    width: u32,
    height: u32,
    frames: u32,
    fps: f64,
    from: f64,
    duration: f64,
    /// Whether every motion is back where it began at the end.
    seamless: bool,
    /// As in the report of `render`.
    msaa: Option<u32>,
    samples: Option<u32>,
    lights: usize,
    objects: usize,
    driver: Option<Driver>,
    /// Time the drawing took, all frames together, without encoding.
    milliseconds: f64,
    bytes: u64,
    files: Vec<String>,
}

/// Animates a scene.
///
/// # Errors
/// A scene where nothing moves, frames out of range, and whatever is wrong with scene, file, technique or OpenGL.
pub(crate) fn run(arguments: &AnimateArgs) -> Result<(), CliError> {
    let technique = technique(&arguments.look, None)?;
    extension(&arguments.output, ["apng", "png"])?;
    let scene = Scene::load(&arguments.scene)?;
    let size = size(arguments.size, &scene)?;
    let AnimateArgs { frames, fps, duration, from, .. } = *arguments;
    let timeline = Timeline::new(&scene, Wanted { frames, fps, duration }).map_err(CliError::Usage)?;
    let file = destination(&arguments.scene, &arguments.output)?;
    if !timeline.repeats && duration.is_none() && (frames.is_none() || fps.is_none()) {
        let longer = match repeats_after(&scene) {
            Some(seconds) => format!("give --duration {seconds} for a round of all"),
            None => "they take long until they do, or never do".into(),
        };
        console::note(format_args!(
            "the motions do not all repeat after {} s, the longest period; {longer}",
            timeline.duration
        ));
    }

    let mut artist = Artist::new(technique, arguments.look.msaa)?;
    let mut staged = Staged::default();
    let progress = Progress::new("animating", "frames");
    progress.set(0, timeline.frames.into());
    let mut milliseconds = 0.0;
    let mut samples = 0;
    staged.file(&file, |to| {
        let mut animation = Animation::new(to.by_ref(), size, timeline.frames, timeline.delay())?;
        for frame in 0..timeline.frames {
            let time = from + timeline.after(frame);
            let drawing = artist.draw(&scene, size, time).map_err(io::Error::other)?;
            milliseconds += drawing.milliseconds;
            samples = drawing.samples;
            animation.frame(png::levels(&picture(&scene, size, &drawing)))?;
            progress.set(u64::from(frame) + 1, timeline.frames.into());
        }
        animation.finish()
    })?;
    drop(progress);
    staged.commit()?;
    let driver = artist.driver();
    let on_cpu = driver.is_none();
    Report {
        scene: report::text(&arguments.scene),
        technique: technique.to_string(),
        backend: if on_cpu { "cpu" } else { "gl" },
        width: size.width,
        height: size.height,
        frames: timeline.frames,
        fps: f64::from(timeline.frames) / timeline.duration,
        from,
        duration: timeline.duration,
        seamless: timeline.repeats,
        msaa: (!on_cpu).then_some(samples),
        samples: on_cpu.then_some(samples),
        lights: scene.lights.len(),
        objects: scene.objects.len(),
        driver,
        milliseconds,
        bytes: fs::metadata(&file).map_or(0, |about| about.len()),
        files: report::texts(&[file]),
    }
    .print(arguments.json)
}

/// Who draws the frames, ready for all of them.
enum Artist {
    Gl(Box<OpenGl>, antumbra::Technique, antumbra::Soft, Option<u32>),
    Cpu(u32),
}

impl Artist {
    fn new(technique: Technique, msaa: Option<u32>) -> Result<Self, CliError> {
        Ok(match technique {
            Technique::Gl(technique, soft) => {
                let gl = OpenGl::open().map_err(|error| match error {
                    HostError::NoOpenGl(why) => CliError::Usage(format!(
                        "no OpenGL: {why}; or draw on the CPU with --technique raytraced"
                    )),
                    error => CliError::OpenGl(error),
                })?;
                Self::Gl(Box::new(gl), technique, soft, msaa)
            }
            Technique::Raytraced => Self::Cpu(msaa.unwrap_or(CPU_SAMPLES)),
        })
    }

    fn draw(&mut self, scene: &Scene, size: Size, time: f64) -> Result<Drawing, CliError> {
        let request = Request { scene, size, time, visibility: false, shadows: true };
        match self {
            Self::Gl(gl, technique, soft, msaa) => gl.draw(&request, (*technique, *soft), *msaa),
            Self::Cpu(samples) => Ok(draw::trace(&request, *samples, &|_, _, _| ())),
        }
    }

    fn driver(&self) -> Option<Driver> {
        match self {
            Self::Gl(gl, ..) => Some(gl.driver()),
            Self::Cpu(_) => None,
        }
    }
}

impl Report {
    fn print(&self, json: bool) -> Result<(), CliError> {
        if json {
            return console::json(self);
        }
        let with = self.driver.as_ref().map_or("the CPU", |driver| driver.renderer.as_str());
        for file in &self.files {
            console::line(OneLine(file))?;
        }
        #[expect(clippy::cast_precision_loss, reason = "a size to be read by people")]
        let megabytes = self.bytes as f64 * 1e-6;
        console::line(format_args!(
            "{} of {}x{}, {:.3} s, {megabytes:.2} MB: {:.1} ms a frame, {} on {with}",
            report::count(self.frames as usize, "frame"),
            self.width,
            self.height,
            self.duration,
            self.milliseconds / f64::from(self.frames.max(1)),
            self.technique
        ))
    }
}
