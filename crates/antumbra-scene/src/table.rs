//! Reading TOML tables: which keys there are, with errors that say where.

use core::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::SceneError;
use crate::error::Source;
use crate::text::{all_of, nearest, quoted};

/// A table of the scene file. `what` names it in messages: "the camera", `light "key"`.
pub(crate) struct Table<'a> {
    pub(crate) source: &'a Source<'a>,
    pub(crate) what: String,
    entries: &'a DeTable<'a>,
    start: usize,
}

/// A value of the scene file, with the key it belongs to.
#[derive(Clone)]
pub(crate) struct Field<'a> {
    pub(crate) source: &'a Source<'a>,
    /// Names the value in messages: `"radius" of light "key"`.
    pub(crate) what: String,
    pub(crate) value: &'a Spanned<DeValue<'a>>,
}

impl<'a> Table<'a> {
    /// The whole file.
    pub(crate) fn root(source: &'a Source<'a>, entries: &'a DeTable<'a>) -> Self {
        Self { source, what: "the scene".to_owned(), entries, start: 0 }
    }

    /// The value of a key that may be missing.
    pub(crate) fn get(&self, key: &str) -> Option<Field<'a>> {
        let value = self.entries.get(key)?;
        Some(Field { source: self.source, what: format!("\"{key}\" of {}", self.what), value })
    }

    /// The value of a key that must be there. `example` says what to write.
    pub(crate) fn require(&self, key: &str, example: &str) -> Result<Field<'a>, SceneError> {
        self.get(key).ok_or_else(|| {
            self.error(format!("{} lacks the key \"{key}\"", self.what), format!("write {example}"))
        })
    }

    /// An error at the head of the table.
    pub(crate) fn error(&self, what: impl Into<String>, instead: impl Into<String>) -> SceneError {
        self.source.error(self.start, what, instead)
    }

    /// Refuses keys that are not among `valid`, the first in the file first. `elsewhere` may know
    /// what a key is good for: it returns the two halves of the message.
    pub(crate) fn allow(
        &self,
        valid: &[&str],
        elsewhere: impl Fn(&str) -> Option<(String, String)>,
    ) -> Result<(), SceneError> {
        let unknown = self
            .entries
            .keys()
            .filter(|key| !valid.contains(&key.get_ref().as_ref()))
            .min_by_key(|key| key.span().start);
        let Some(key) = unknown else { return Ok(()) };
        let (at, key) = (key.span().start, key.get_ref().as_ref());
        if let Some((what, instead)) = elsewhere(key) {
            return Err(self.source.error(at, what, instead));
        }
        let names: Vec<String> = valid.iter().map(|v| format!("\"{v}\"")).collect();
        let list = format!("the keys of {} are {}", self.what, all_of(&names));
        let instead = match nearest(key, valid) {
            Some(meant) => format!("did you mean \"{meant}\"? {list}"),
            None => list,
        };
        Err(self.source.error(at, format!("unknown key {} in {}", quoted(key), self.what), instead))
    }

    /// Where the key itself is written, for errors about the key and not its value.
    pub(crate) fn key_error(
        &self,
        key: &str,
        what: impl Into<String>,
        instead: impl Into<String>,
    ) -> SceneError {
        let at = self.entries.get_key_value(key).map_or(self.start, |(key, _)| key.span().start);
        self.source.error(at, what, instead)
    }
}

impl<'a> Field<'a> {
    /// Where the value is written.
    pub(crate) fn span(&self) -> Range<usize> {
        self.value.span()
    }

    /// An error at the value.
    pub(crate) fn error(&self, what: impl Into<String>, instead: impl Into<String>) -> SceneError {
        self.source.error(self.span().start, what, instead)
    }

    /// "… must be …, but is …", for a value of the wrong type.
    pub(crate) fn wrong_type(&self, expected: &str, example: &str) -> SceneError {
        let found = match self.value.get_ref() {
            DeValue::String(_) => "a string",
            DeValue::Integer(_) => "an integer",
            DeValue::Float(_) => "a number with a fraction",
            DeValue::Boolean(_) => "a boolean",
            DeValue::Datetime(_) => "a date",
            DeValue::Array(_) => "an array",
            DeValue::Table(_) => "a table",
        };
        self.error(format!("{} must be {expected}, but is {found}", self.what), format!("write {example}"))
    }

    /// The value as a table that messages call `what`.
    pub(crate) fn table(&self, what: impl Into<String>, example: &str) -> Result<Table<'a>, SceneError> {
        match self.value.get_ref() {
            DeValue::Table(entries) => {
                Ok(Table { source: self.source, what: what.into(), entries, start: self.span().start })
            }
            _ => Err(self.wrong_type("a table", example)),
        }
    }

    /// The values of an array.
    pub(crate) fn array(&self, example: &str) -> Result<Vec<Field<'a>>, SceneError> {
        match self.value.get_ref() {
            DeValue::Array(values) => Ok(values
                .iter()
                .enumerate()
                .map(|(i, value)| Field {
                    source: self.source,
                    what: format!("entry {} of {}", i + 1, self.what),
                    value,
                })
                .collect()),
            _ => Err(self.wrong_type("an array", example)),
        }
    }
}
