//! `antumbra render`: one scene, one picture.

use crate::args::RenderArgs;
use crate::commands::look::technique;
use crate::commands::{Job, trace};
use crate::draw::OpenGl;
use crate::error::CliError;
use crate::progress::Progress;
use crate::technique::Technique;

/// Rays a pixel on the CPU where `--msaa` does not say.
const CPU_SAMPLES: u32 = 64;

/// Renders a scene.
///
/// # Errors
/// A technique that the backend has not, an option that the technique has not, and whatever is wrong with scene, files
/// or OpenGL.
pub(crate) fn run(arguments: &RenderArgs) -> Result<(), CliError> {
    match technique(&arguments.look, arguments.backend)? {
        Technique::Gl(technique, soft) => with_opengl(arguments, technique, soft),
        Technique::Raytraced => trace::draw(&arguments.picture, arguments.look.msaa.unwrap_or(CPU_SAMPLES)),
    }
}

fn with_opengl(
    arguments: &RenderArgs,
    technique: antumbra::Technique,
    soft: antumbra::Soft,
) -> Result<(), CliError> {
    let job = Job::new(&arguments.picture)?;
    let progress = Progress::new("rendering", "scenes");
    progress.set(0, 1);
    let mut gl = OpenGl::open().map_err(CliError::OpenGl)?;
    let driver = gl.driver();
    let drawing = gl.draw(&job.request(&arguments.picture), (technique, soft), arguments.look.msaa)?;
    progress.set(1, 1);
    drop(progress);
    job.finish(&arguments.picture, &Technique::Gl(technique, soft), &drawing, Some(driver))
}
