//! What can go wrong, always as one line that says what to do instead.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use antumbra_host::HostError;
use antumbra_scene::SceneError;

/// Everything that ends the program early.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CliError {
    /// `--help` or `--version`: no error at all, the text to print.
    #[error("{0}")]
    Help(String),
    /// The command line is wrong.
    #[error("{0}")]
    Usage(String),
    /// A scene file is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// OpenGL is missing, or cannot do what was asked.
    #[error("{0}{hint}", hint = opengl_hint(.0))]
    OpenGl(HostError),
    /// A file cannot be written where it was asked for.
    #[error("{}: {what}", path.display())]
    Output {
        /// The file or directory as the user wrote it.
        path: PathBuf,
        /// What is wrong with it and what to do.
        what: String,
    },
    /// Standard output does not take what is written to it.
    #[error("standard output: {0}")]
    Stdout(io::Error),
    /// The reader of standard output went away: the program ends quietly.
    #[error("standard output: closed by its reader")]
    BrokenPipe,
}

fn opengl_hint(error: &HostError) -> &'static str {
    match error {
        HostError::NoOpenGl(_) => "; or draw on the CPU with --backend cpu",
        _ => "",
    }
}

impl CliError {
    /// What ends a command that can do nothing without OpenGL.
    pub(crate) fn without_opengl(error: HostError) -> Self {
        match error {
            HostError::NoOpenGl(why) => {
                Self::Usage(format!("no OpenGL: {why}; `antumbra info` says how to get one"))
            }
            error => Self::OpenGl(error),
        }
    }

    /// A file that cannot be written.
    pub(crate) fn output(path: &Path, what: impl Into<String>) -> Self {
        Self::Output { path: path.to_owned(), what: what.into() }
    }
}

/// Text on one line: control characters, which a file name may hold, are written as escapes.
pub(crate) struct OneLine<T>(pub(crate) T);

impl<T: fmt::Display> fmt::Display for OneLine<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for character in self.0.to_string().chars() {
            if character.is_control() || matches!(character, '\u{2028}' | '\u{2029}') {
                write!(f, "{}", character.escape_default())?;
            } else {
                write!(f, "{character}")?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_line_stays_one_line() {
        let text = OneLine("a\nb\r\u{1b}[31m\u{2028}é ü").to_string();
        assert_eq!(text, "a\\nb\\r\\u{1b}[31m\\u{2028}é ü", "control characters become escapes, others stay");
    }
}
