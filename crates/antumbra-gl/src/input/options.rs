//! Techniques' options as people and programs see them: by name.

use std::fmt;

/// An option of a technique, as a program shows it to people.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct OptionInfo {
    /// Its name in [`crate::Technique::set`] and in the technique's text.
    pub key: &'static str,
    /// What it does: plain sentences, on one line.
    pub help: &'static str,
    /// The value, as [`crate::Technique::set`] reads it. What a program has put into the field is here even if it is
    /// not allowed.
    pub value: String,
    /// The value of a new technique.
    pub default: String,
    /// What it can be set to.
    pub allowed: Allowed,
}

/// The values that an option takes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Allowed {
    /// A number, the ends included.
    Number {
        /// The least.
        low: f64,
        /// The largest, finite.
        high: f64,
        /// Whether it has no fraction.
        whole: bool,
    },
    /// `on` or `off`.
    Switch,
    /// One of these names.
    Choice(&'static [Choice]),
}

impl fmt::Display for Allowed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number { low, high, .. } => write!(f, "a number from {low} to {high}"),
            Self::Switch => f.write_str("on or off"),
            Self::Choice(choices) => choices
                .iter()
                .enumerate()
                .try_for_each(|(i, choice)| write!(f, "{}{}", if i == 0 { "" } else { " or " }, choice.name)),
        }
    }
}

/// A value that an option can be set to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Choice {
    /// As [`crate::Technique::set`] reads it.
    pub name: &'static str,
    /// What it means: plain sentences, on one line.
    pub help: &'static str,
}

impl Choice {
    pub(crate) const fn new(name: &'static str, help: &'static str) -> Self {
        Self { name, help }
    }
}

/// Why a technique or its options cannot be what a text or a program says; the message says what to write instead.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum OptionError {
    /// There is no such technique.
    NoTechnique {
        /// What was written.
        text: String,
        /// The names there are.
        names: &'static [&'static str],
    },
    /// The technique has no such option.
    NoOption {
        /// What was written.
        key: String,
        /// And for a value.
        value: String,
        /// The options there are.
        keys: Vec<&'static str>,
    },
    /// The option has no such value.
    NotAllowed {
        /// The option.
        key: &'static str,
        /// What was written, or set by a program.
        value: String,
        /// The values it has.
        allowed: Allowed,
    },
    /// One of these, of a technique that was written with its options.
    InTechnique {
        /// Its name.
        technique: &'static str,
        /// What is wrong.
        error: Box<OptionError>,
    },
    /// It is no way to draw lights with an area.
    NoSoft {
        /// What was written.
        text: String,
        /// The most points that a light may be.
        most: u32,
    },
}

impl fmt::Display for OptionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoTechnique { text, names } => {
                write!(f, "there is no technique `{text}`; the techniques are {}", names.join(", "))
            }
            Self::NoOption { key, value, keys } => {
                write!(f, "there is no option `{key}{}{value}`; ", if value.is_empty() { "" } else { "=" })?;
                match keys[..] {
                    [] => f.write_str("this technique has none"),
                    _ => write!(f, "the options are {}", keys.join(", ")),
                }
            }
            Self::NotAllowed { key, value, allowed } => {
                write!(f, "option `{key}` cannot be `{value}`; write {allowed}")
            }
            Self::InTechnique { technique, error } => write!(f, "technique {technique}: {error}"),
            Self::NoSoft { text, most } => write!(
                f,
                "`{text}` is no way to draw lights with an area; write native, samples:N or samples:N:row, \
                 N from 1 to {most}"
            ),
        }
    }
}

impl std::error::Error for OptionError {}
