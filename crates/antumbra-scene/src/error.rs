//! The one error of this crate: what is wrong with a scene file, where, and what to write instead.

use std::path::{Path, PathBuf};

use crate::text::{one_line, quoted};

/// Why a scene could not be read or saved.
///
/// Displays as one line, `file:line:column: what is wrong; what to write instead`. Lines and columns
/// count from 1, columns in characters. A file that cannot be read at all, or not be written, has neither.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{}: {what}; {instead}", one_line(&file.to_string_lossy()), Place(*place))]
pub struct SceneError {
    file: PathBuf,
    place: Option<(usize, usize)>,
    what: String,
    instead: String,
}

impl SceneError {
    /// The scene file.
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// Line and column, from 1; `None` if the file could not be read or written.
    pub fn place(&self) -> Option<(usize, usize)> {
        self.place
    }

    /// What is wrong.
    pub fn what(&self) -> &str {
        &self.what
    }

    /// What to write, or do, instead.
    pub fn instead(&self) -> &str {
        &self.instead
    }
}

/// `:line:column`, or nothing.
struct Place(Option<(usize, usize)>);

impl core::fmt::Display for Place {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.0.map_or(Ok(()), |(line, column)| write!(f, ":{line}:{column}"))
    }
}

/// A scene file while it is being parsed: makes errors out of byte positions.
pub(crate) struct Source<'a> {
    pub(crate) file: &'a Path,
    pub(crate) text: &'a str,
}

impl Source<'_> {
    /// The error at byte `at`.
    pub(crate) fn error(&self, at: usize, what: impl Into<String>, instead: impl Into<String>) -> SceneError {
        SceneError {
            file: self.file.to_owned(),
            place: Some(line_and_column(self.text, at)),
            what: one_line(&what.into()),
            instead: one_line(&instead.into()),
        }
    }

    /// The line, from 1, that byte `at` is on.
    pub(crate) fn line(&self, at: usize) -> usize {
        line_and_column(self.text, at).0
    }
}

/// The error of a file that cannot be read.
pub(crate) fn unreadable(file: &Path, error: &std::io::Error) -> SceneError {
    SceneError {
        file: file.to_owned(),
        place: None,
        what: format!("the scene file cannot be read: {}", one_line(&error.to_string())),
        instead: "give the path of a scene file (TOML)".to_owned(),
    }
}

/// The error of a scene that cannot be saved.
pub(crate) fn unsaved(file: &Path, why: impl core::fmt::Display, instead: impl Into<String>) -> SceneError {
    SceneError {
        file: file.to_owned(),
        place: None,
        what: format!("the scene cannot be saved: {}", one_line(&why.to_string())),
        instead: one_line(&instead.into()),
    }
}

/// The error of a file that is not text, with what precedes the first bad byte.
pub(crate) fn not_utf8(file: &Path, good: &str, bad: u8) -> SceneError {
    Source { file, text: good }.error(
        good.len(),
        format!("the byte 0x{bad:02X} is not UTF-8"),
        format!("save the file as UTF-8, for example with {} written out", quoted("ä")),
    )
}

/// Line and column, from 1, of byte `at`; past the end counts as the end.
fn line_and_column(text: &str, at: usize) -> (usize, usize) {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    let before = &text[..at];
    let line_start = before.rfind('\n').map_or(0, |i| i + 1);
    let line = before.bytes().filter(|b| *b == b'\n').count() + 1;
    (line, before[line_start..].chars().count() + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_characters_from_one() {
        let text = "ab\nüöx\n";
        for (at, place) in [
            (0, (1, 1)),
            (2, (1, 3)),
            (3, (2, 1)),
            (4, (2, 1)),
            (5, (2, 2)),
            (7, (2, 3)),
            (9, (3, 1)),
            (99, (3, 1)),
        ] {
            assert_eq!(line_and_column(text, at), place, "byte {at}");
        }
    }

    #[test]
    fn an_error_is_one_line() {
        let source = Source { file: Path::new("a\nb.toml"), text: "x = 1\ny" };
        let error = source.error(6, "bad\tthing \u{1b}[31m", "write\nthis");
        assert_eq!(
            error.to_string(),
            r"a\nb.toml:2:1: bad\tthing \u{1b}[31m; write\nthis",
            "control characters are escaped"
        );
        assert_eq!(error.place(), Some((2, 1)), "the place is also there as numbers");
    }
}
