//! How lights with an area are drawn.

use super::OptionError;
use std::fmt;
use std::str::FromStr;

/// How lights with an area cast shadows.
///
/// As text: `native`, `samples:16`, `samples:3:row`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Soft {
    /// In the technique's own way; techniques that have none refuse such lights.
    #[default]
    Native,
    /// As that many hard lights at points of the light, whose visibilities are averaged, each with the weight of
    /// what its point sends to the surface. The technique sees hard lights alone. The points are the same, in the
    /// light's own frame, wherever it is.
    Samples {
        /// Points of each light, from 1 to [`Soft::MOST`].
        count: u32,
        /// Where on the light they are.
        pattern: Pattern,
    },
}

/// Where the points of a light are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Pattern {
    /// Spread evenly, so that the average tends to the exact visibility: rectangles in a grid if the number is a
    /// square, else in a golden-ratio lattice; discs in a sunflower (H. Vogel, 1979); balls with
    /// points inside them, dense as 1 / sqrt(R² - r²), so that they look like a ball of even radiance from everywhere.
    #[default]
    Spread,
    /// In a row through the centre from rim to rim, as in the paper on soft shadows of 2017. Cheap and coarse: it
    /// does not tend to the exact visibility.
    Row,
}

impl Soft {
    /// The most points a light may have.
    pub const MOST: u32 = 4096;

    /// The points of a light in a spread pattern.
    pub fn samples(count: u32) -> Self {
        Self::Samples { count, pattern: Pattern::Spread }
    }
}

impl fmt::Display for Soft {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Native => f.write_str("native"),
            Self::Samples { count, pattern: Pattern::Spread } => write!(f, "samples:{count}"),
            Self::Samples { count, pattern: Pattern::Row } => write!(f, "samples:{count}:row"),
        }
    }
}

impl FromStr for Soft {
    type Err = OptionError;

    fn from_str(text: &str) -> Result<Self, OptionError> {
        let wrong = || OptionError::NoSoft { text: text.to_owned(), most: Self::MOST };
        if text == "native" {
            return Ok(Self::Native);
        }
        let rest = text.strip_prefix("samples:").ok_or_else(wrong)?;
        let (count, pattern) = match rest.strip_suffix(":row") {
            Some(count) => (count, Pattern::Row),
            None => (rest, Pattern::Spread),
        };
        let count = count.parse().ok().filter(|count| (1..=Self::MOST).contains(count)).ok_or_else(wrong)?;
        Ok(Self::Samples { count, pattern })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_and_back() {
        for text in ["native", "samples:1", "samples:16", "samples:3:row", "samples:4096"] {
            assert_eq!(text.parse::<Soft>().expect(text).to_string(), text, "the same text");
        }
        for text in
            ["", "soft", "samples", "samples:", "samples:0", "samples:4097", "samples:-1", "samples:4:disc"]
        {
            let error = text.parse::<Soft>().expect_err(text).to_string();
            assert!(error.contains("samples:N") && error.contains(text), "{error}");
        }
    }
}
