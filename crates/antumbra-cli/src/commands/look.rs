//! The technique that the options of a command name.

use crate::args::{Backend, LookArgs, Quality, Shade};
use crate::error::CliError;
use crate::technique::Technique;

/// The technique, which the backend decides where it is not named, and the reverse.
///
/// # Errors
/// A technique that the backend has not, or an option that the technique has not.
pub(crate) fn technique(arguments: &LookArgs, backend: Option<Backend>) -> Result<Technique, CliError> {
    let technique = match (&arguments.technique, backend) {
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
