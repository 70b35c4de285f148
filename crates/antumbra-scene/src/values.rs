//! Reading single values: numbers within limits, vectors, directions, rotations, words.

use glam::{DQuat, DVec3};
use toml::de::DeValue;

use crate::SceneError;
use crate::limits::{MAX_COORDINATE, MAX_LENGTH, MAX_NAME_BYTES, MIN_LENGTH};
use crate::table::Field;
use crate::text::{any_of, nearest, quoted, shortened};
use crate::unit::{unit, unit_rotation};

/// Shortest vector and quaternion that still has a direction: far above the rounding of numbers a
/// person writes, and its square is a normal float64.
const MIN_NORM: f64 = 1e-6;

impl Field<'_> {
    /// A finite number, written as an integer or with a fraction.
    fn finite(&self, example: &str) -> Result<f64, SceneError> {
        let (number, written) = match self.value.get_ref() {
            DeValue::Integer(i) => {
                // Every integer that fits is exact or rounds as a literal with a fraction would.
                (i128::from_str_radix(i.as_str(), i.radix()).ok().map(|i| i as f64), i.as_str())
            }
            DeValue::Float(f) => (f.as_str().parse::<f64>().ok(), f.as_str()),
            _ => return Err(self.wrong_type("a number", example)),
        };
        number.filter(|n| n.is_finite()).ok_or_else(|| {
            self.error(
                format!("{} is {}, which is not a finite number", self.what, shortened(written)),
                format!("write {example}"),
            )
        })
    }

    /// A number from `low` to `high`.
    pub(crate) fn number(&self, low: f64, high: f64, example: &str) -> Result<f64, SceneError> {
        let number = self.finite(example)?;
        if (low..=high).contains(&number) {
            return Ok(number);
        }
        Err(self.error(
            format!(
                "{} is {}, which is not from {} to {}",
                self.what,
                plain(number),
                plain(low),
                plain(high)
            ),
            format!("write {example}"),
        ))
    }

    /// A length in metres, above zero.
    pub(crate) fn length(&self, example: &str) -> Result<f64, SceneError> {
        let number = self.finite(example)?;
        if number > 0.0 {
            return self.number(MIN_LENGTH, MAX_LENGTH, example);
        }
        Err(self.error(
            format!("{} is {}, but a length is above zero", self.what, plain(number)),
            format!("write {example}"),
        ))
    }

    /// A whole number from `low` to `high`.
    pub(crate) fn integer(&self, low: u32, high: u32, example: &str) -> Result<u32, SceneError> {
        let DeValue::Integer(i) = self.value.get_ref() else {
            return Err(self.wrong_type("a whole number", example));
        };
        let number = i128::from_str_radix(i.as_str(), i.radix()).ok();
        number.and_then(|n| u32::try_from(n).ok()).filter(|n| (low..=high).contains(n)).ok_or_else(|| {
            self.error(
                format!("{} is {}, which is not from {low} to {high}", self.what, shortened(i.as_str())),
                format!("write {example}"),
            )
        })
    }

    /// Exactly `N` finite numbers.
    fn numbers<const N: usize>(&self, low: f64, high: f64, example: &str) -> Result<[f64; N], SceneError> {
        let DeValue::Array(entries) = self.value.get_ref() else {
            return Err(self.wrong_type(&format!("an array of {N} numbers"), example));
        };
        if entries.len() != N {
            return Err(self.error(
                format!("{} must have {N} numbers, but has {}", self.what, entries.len()),
                format!("write {example}"),
            ));
        }
        let mut numbers = [0.0; N];
        for (number, field) in numbers.iter_mut().zip(self.array(example)?) {
            *number = field.number(low, high, example)?;
        }
        Ok(numbers)
    }

    /// Three numbers from `low` to `high` each.
    pub(crate) fn vector(&self, low: f64, high: f64, example: &str) -> Result<DVec3, SceneError> {
        self.numbers(low, high, example).map(DVec3::from_array)
    }

    /// A point, metres.
    pub(crate) fn point(&self, example: &str) -> Result<DVec3, SceneError> {
        self.vector(-MAX_COORDINATE, MAX_COORDINATE, example)
    }

    /// Three lengths, metres, above zero.
    pub(crate) fn lengths(&self, example: &str) -> Result<DVec3, SceneError> {
        self.numbers::<3>(-MAX_LENGTH, MAX_LENGTH, example)?;
        let mut lengths = DVec3::ZERO;
        for (i, field) in self.array(example)?.into_iter().enumerate().take(3) {
            lengths[i] = field.length(example)?;
        }
        Ok(lengths)
    }

    /// A direction of any length but zero; comes back as a unit vector, and as it is if it is one.
    pub(crate) fn direction(&self, example: &str) -> Result<DVec3, SceneError> {
        let vector = self.point(example)?;
        if vector.length() < MIN_NORM {
            return Err(self.error(
                format!("{} has no length, so it points nowhere", self.what),
                format!("write {example}"),
            ));
        }
        Ok(unit(vector))
    }

    /// A quaternion x y z w of any length but zero; comes back as a unit quaternion, and as it is if it
    /// is one.
    pub(crate) fn rotation(&self) -> Result<DQuat, SceneError> {
        let example = "a quaternion x y z w, such as [0.0, 0.0, 0.0, 1.0] for no rotation";
        let q = DQuat::from_array(self.numbers(-MAX_COORDINATE, MAX_COORDINATE, example)?);
        if q.length() < MIN_NORM {
            return Err(self
                .error(format!("{} is zero, which is no rotation", self.what), format!("write {example}")));
        }
        Ok(unit_rotation(q))
    }

    /// `true` or `false`.
    pub(crate) fn boolean(&self) -> Result<bool, SceneError> {
        self.value.get_ref().as_bool().ok_or_else(|| self.wrong_type("a boolean", "true or false"))
    }

    /// A string.
    pub(crate) fn string(&self, example: &str) -> Result<&str, SceneError> {
        self.value.get_ref().as_str().ok_or_else(|| self.wrong_type("a string", example))
    }

    /// One of a few words.
    pub(crate) fn word<'v>(&self, valid: &[&'v str]) -> Result<&'v str, SceneError> {
        let names: Vec<String> = valid.iter().map(|v| format!("\"{v}\"")).collect();
        let list = any_of(&names);
        let word = self.string(&list)?;
        valid.iter().copied().find(|v| *v == word).ok_or_else(|| {
            let instead = match nearest(word, valid) {
                Some(meant) => format!("did you mean \"{meant}\"? Write {list}"),
                None => format!("write {list}"),
            };
            self.error(format!("{} is {}, which is unknown", self.what, quoted(word)), instead)
        })
    }

    /// A name: some text on one line.
    pub(crate) fn name(&self) -> Result<&str, SceneError> {
        let example = "a short name, such as \"ball\"";
        let name = self.string(example)?;
        match wrong_in_name(name) {
            Some(wrong) => Err(self.error(format!("{} {wrong}", self.what), format!("write {example}"))),
            None => Ok(name),
        }
    }

    /// A name that is a file name on every usual system.
    pub(crate) fn file_name(&self) -> Result<&str, SceneError> {
        let name = self.name()?;
        match wrong_in_file_name(name) {
            Some(wrong) => Err(self.error(
                format!("{} {wrong}, but a light's name is used as a file name", self.what),
                "write a name of letters, digits, - and _, such as \"key\"",
            )),
            None => Ok(name),
        }
    }
}

/// Characters that some system allows in no file name.
pub(crate) const NOT_IN_FILE_NAMES: &str = r#"/\<>:"|?*"#;

/// What is wrong with the name of a light or an object.
fn wrong_in_name(name: &str) -> Option<String> {
    if name.trim().is_empty() {
        Some("is empty".to_owned())
    } else if name.len() > MAX_NAME_BYTES {
        Some(format!("has {} bytes, more than {MAX_NAME_BYTES}", name.len()))
    } else {
        name.chars().find(|c| c.is_control()).map(|c| format!("holds the control character {c:?}"))
    }
}

/// What else is wrong with a name that is a file name.
fn wrong_in_file_name(name: &str) -> Option<String> {
    if name == "." || name == ".." {
        Some("means a folder".to_owned())
    } else if name.ends_with('.') || name.starts_with(' ') || name.ends_with(' ') {
        Some("begins or ends with a dot or space".to_owned())
    } else {
        name.chars().find(|c| NOT_IN_FILE_NAMES.contains(*c)).map(|c| format!("holds the character {c}"))
    }
}

/// A number for people: short, with an exponent where it would be long.
pub(crate) fn plain(number: f64) -> String {
    let size = number.abs();
    if size != 0.0 && !(1e-4..1e5).contains(&size) { format!("{number:e}") } else { format!("{number}") }
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn numbers_are_short() {
        for (number, text) in [
            (0.0, "0"),
            (-1.5, "-1.5"),
            (16384.0, "16384"),
            (1e9, "1e9"),
            (1e-6, "1e-6"),
            (1e300, "1e300"),
            (-2.5e-8, "-2.5e-8"),
        ] {
            assert_eq!(plain(number), text, "{number:?}");
        }
    }
}
