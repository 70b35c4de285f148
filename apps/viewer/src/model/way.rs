//! What a side of the picture shows.

use std::fmt;
use std::str::FromStr;

use antumbra::{OptionError, Soft, Technique};
use serde::{Deserialize, Serialize};

/// How a picture comes by its shadows. As text: a technique as on the command line, `raytraced` or `none`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub(crate) enum Way {
    /// One of the library's techniques, and how it draws lights with an area.
    Technique(Technique, Soft),
    /// The reference, ray traced in the background.
    Raytraced,
    /// Not at all.
    None,
}

const RAYTRACED: &str = "raytraced";
const NONE: &str = "none";

impl Way {
    /// All of them, with default options.
    pub(crate) fn all() -> impl Iterator<Item = Self> {
        Technique::all().map(Self::from).chain([Self::Raytraced, Self::None])
    }

    /// Its name, without options.
    pub(crate) fn name(&self) -> &'static str {
        match self {
            Self::Technique(technique, _) => technique.name(),
            Self::Raytraced => RAYTRACED,
            Self::None => NONE,
        }
    }

    /// What it does, in one sentence.
    pub(crate) fn summary(&self) -> &'static str {
        match self {
            Self::Technique(technique, _) => technique.about().summary,
            Self::Raytraced => {
                "the reference: every ray traced on the CPU in double precision, refined as you look"
            }
            Self::None => "the scene as the host draws it, without shadows",
        }
    }

    /// The next one of [`Self::all`], or the one before, with default options but the same way of drawing areas.
    pub(crate) fn neighbour(&self, forward: bool) -> Self {
        let all: Vec<Self> = Self::all().collect();
        let here = all.iter().position(|way| way.name() == self.name()).unwrap_or(0);
        let step = if forward { 1 } else { all.len() - 1 };
        match (all[(here + step) % all.len()], self) {
            (Self::Technique(technique, _), Self::Technique(_, soft)) => Self::Technique(technique, *soft),
            (way, _) => way,
        }
    }
}

impl Default for Way {
    fn default() -> Self {
        Technique::default().into()
    }
}

impl From<Technique> for Way {
    fn from(technique: Technique) -> Self {
        Self::Technique(technique, Soft::Native)
    }
}

impl fmt::Display for Way {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Technique(technique, Soft::Native) => technique.fmt(f),
            Self::Technique(technique, soft) => write!(f, "{technique}+{soft}"),
            Self::Raytraced | Self::None => f.write_str(self.name()),
        }
    }
}

impl FromStr for Way {
    type Err = OptionError;

    fn from_str(text: &str) -> Result<Self, OptionError> {
        match text {
            RAYTRACED => Ok(Self::Raytraced),
            NONE => Ok(Self::None),
            _ => match text.split_once('+') {
                Some((technique, soft)) => Ok(Self::Technique(technique.parse()?, soft.parse()?)),
                None => Ok(Technique::parse(text)?.into()),
            },
        }
    }
}

impl From<Way> for String {
    fn from(way: Way) -> Self {
        way.to_string()
    }
}

impl TryFrom<String> for Way {
    type Error = OptionError;

    fn try_from(text: String) -> Result<Self, OptionError> {
        text.parse()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_and_back() {
        for text in ["analytic", "none", "raytraced", "map:size=512+samples:16", "analytic:quality=exact"] {
            let way: Way = text.parse().unwrap_or_else(|error| panic!("{text}: {error}"));
            assert_eq!(way.to_string(), text, "what was read is what is written");
        }
        assert!("maps".parse::<Way>().is_err(), "there is no such technique");
    }

    #[test]
    fn neighbours_go_round() {
        let mut way = Way::default();
        let count = Way::all().count();
        for _ in 0..count {
            let next = way.neighbour(true);
            assert_ne!(next.name(), way.name(), "it changes");
            assert_eq!(next.neighbour(false).name(), way.name(), "and back");
            way = next;
        }
        assert_eq!(way.name(), Way::default().name(), "all {count} of them were there");
    }
}
