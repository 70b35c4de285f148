//! `antumbra render`: one scene, one picture.

use crate::args::{Backend, Quality, RenderArgs, Shade};
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
    match technique(arguments)? {
        Technique::Gl(technique, soft) => with_opengl(arguments, technique, soft),
        Technique::Raytraced => trace::draw(&arguments.picture, arguments.msaa.unwrap_or(CPU_SAMPLES)),
    }
}

/// The technique, which the backend decides where it is not named, and the reverse.
fn technique(arguments: &RenderArgs) -> Result<Technique, CliError> {
    let technique = match (&arguments.technique, arguments.backend) {
        (Some(technique @ Technique::Gl(..)), Some(Backend::Cpu)) => {
            return Err(CliError::Usage(format!(
                "technique `{}` draws with OpenGL; leave out --backend cpu, or use --technique raytraced",
                technique.name()
            )));
        }
        (Some(Technique::Raytraced), Some(Backend::Gl)) => {
            return Err(CliError::Usage(format!(
                "technique `raytraced` draws on the CPU; leave out --backend gl, or use --technique {}",
                antumbra::Technique::default().name()
            )));
        }
        (Some(technique), _) => *technique,
        (None, Some(Backend::Cpu)) => Technique::Raytraced,
        (None, Some(Backend::Gl) | None) => antumbra::Technique::default().into(),
    };
    let technique = match arguments.soft {
        Some(soft) => {
            technique.with_soft(soft).map_err(|what| CliError::Usage(format!("--soft {soft}: {what}")))?
        }
        None => technique,
    };
    let named =
        [("shade", arguments.shade.map(Shade::name)), ("quality", arguments.quality.map(Quality::name))];
    named.into_iter().filter_map(|(key, value)| Some((key, value?))).try_fold(
        technique,
        |technique, (key, value)| {
            technique
                .with_option(key, value)
                .map_err(|what| CliError::Usage(format!("--{key} {value}: {what}")))
        },
    )
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
    let drawing = gl.draw(&job.request(&arguments.picture), (technique, soft), arguments.msaa)?;
    progress.set(1, 1);
    drop(progress);
    job.finish(&arguments.picture, &Technique::Gl(technique, soft), &drawing, Some(driver))
}
