//! `antumbra render`: one scene, one picture.

use crate::args::{Backend, RenderArgs};
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
/// A technique that the backend has not, and whatever is wrong with scene, files or OpenGL.
pub(crate) fn run(arguments: &RenderArgs) -> Result<(), CliError> {
    match technique(arguments)? {
        Technique::Analytic => with_opengl(arguments),
        Technique::Raytraced => trace::draw(&arguments.picture, arguments.msaa.unwrap_or(CPU_SAMPLES)),
    }
}

/// The technique, which the backend decides where it is not named, and the reverse.
fn technique(arguments: &RenderArgs) -> Result<Technique, CliError> {
    match (arguments.technique, arguments.backend) {
        (Some(Technique::Analytic), Some(Backend::Cpu)) => Err(CliError::Usage(
            "technique `analytic` draws with OpenGL; leave out --backend cpu, or use --technique raytraced"
                .to_owned(),
        )),
        (Some(Technique::Raytraced), Some(Backend::Gl)) => Err(CliError::Usage(
            "technique `raytraced` draws on the CPU; leave out --backend gl, or use --technique analytic"
                .to_owned(),
        )),
        (Some(technique), _) => Ok(technique),
        (None, Some(Backend::Cpu)) => Ok(Technique::Raytraced),
        (None, Some(Backend::Gl) | None) => Ok(Technique::Analytic),
    }
}

fn with_opengl(arguments: &RenderArgs) -> Result<(), CliError> {
    let job = Job::new(&arguments.picture)?;
    let progress = Progress::new("rendering", "scenes");
    progress.set(0, 1);
    let mut gl = OpenGl::open().map_err(CliError::OpenGl)?;
    let driver = gl.driver();
    let drawing = gl.draw(&job.request(&arguments.picture), arguments.msaa)?;
    progress.set(1, 1);
    drop(progress);
    job.finish(&arguments.picture, Technique::Analytic, &drawing, Some(driver))
}
