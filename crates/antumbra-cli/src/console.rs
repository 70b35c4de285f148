//! Standard output and standard error, neither of which may make the program panic.

use std::fmt::Display;
use std::io::{self, Write};
use std::process::ExitCode;

use crate::error::{CliError, OneLine};

/// Writes one line on standard output.
///
/// # Errors
/// [`CliError::BrokenPipe`] where the reader went away, [`CliError::Stdout`] for a full disk and the like.
pub(crate) fn line(text: impl Display) -> Result<(), CliError> {
    write_out(&format!("{text}\n"))
}

/// Writes one JSON object on standard output.
///
/// # Errors
/// As [`line`].
pub(crate) fn json(value: &impl serde::Serialize) -> Result<(), CliError> {
    let text = serde_json::to_string_pretty(value).map_err(|error| CliError::Stdout(error.into()))?;
    line(text)
}

fn write_out(text: &str) -> Result<(), CliError> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes()).and_then(|()| out.flush()).map_err(|error| match error.kind() {
        io::ErrorKind::BrokenPipe => CliError::BrokenPipe,
        _ => CliError::Stdout(error),
    })
}

/// Says something on standard error that is no error.
pub(crate) fn note(text: impl Display) {
    // Nobody reads standard error where it is closed: nothing is lost.
    let _ = writeln!(io::stderr(), "note: {}", OneLine(text));
}

/// Ends the program: prints the one `error:` line, or the help that was asked for.
pub(crate) fn fail(error: &CliError) -> ExitCode {
    match error {
        CliError::BrokenPipe => ExitCode::SUCCESS,
        CliError::Help(text) => match write_out(text) {
            Ok(()) | Err(CliError::BrokenPipe) => ExitCode::SUCCESS,
            Err(error) => complain(&error),
        },
        error => complain(error),
    }
}

fn complain(error: &CliError) -> ExitCode {
    let _ = writeln!(io::stderr(), "error: {}", OneLine(error));
    ExitCode::from(2)
}
