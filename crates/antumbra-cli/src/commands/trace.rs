//! `antumbra trace`: one scene, ray traced on the CPU.

use crate::args::{PictureArgs, TraceArgs};
use crate::commands::Job;
use crate::draw;
use crate::error::CliError;
use crate::progress::Progress;
use crate::technique::Technique;

/// Traces a scene.
///
/// # Errors
/// Whatever is wrong with scene or files.
pub(crate) fn run(arguments: &TraceArgs) -> Result<(), CliError> {
    draw(&arguments.picture, arguments.samples)
}

/// Traces a scene with `samples` rays a pixel: `antumbra trace`, and `antumbra render --backend cpu`.
///
/// # Errors
/// As [`run`].
pub(crate) fn draw(arguments: &PictureArgs, samples: u32) -> Result<(), CliError> {
    let job = Job::new(arguments)?;
    let progress = Progress::new("tracing", "rows");
    let drawing = draw::trace(&job.request(arguments), samples, &|what, done, total| {
        progress.set(done, total);
        if done == 0 || done == total {
            progress.message(what);
        }
    });
    drop(progress);
    job.finish(arguments, &Technique::Raytraced, &drawing, None)
}
