//! Options of techniques: fields of a struct for programs, `key=value` for people.

use std::fmt::Display;
use std::ops::RangeInclusive;

/// An option of a technique, as a program shows it to people.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct OptionInfo {
    /// Its name in [`crate::Technique::set`] and in the technique's text.
    pub key: String,
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
    /// The value `name`, described by the lines of its documentation put together.
    pub(crate) const fn new(name: &'static str, doc: &'static str) -> Self {
        Self { name, help: doc.trim_ascii() }
    }
}

/// A technique's options, by key.
pub(crate) trait Options: Default {
    /// Sets one option from text.
    ///
    /// # Errors
    /// What is wrong, and what to write instead.
    fn set(&mut self, key: &str, text: &str) -> Result<(), String>;

    /// The options that differ from the defaults: key and value.
    fn changed(&self) -> Vec<(String, String)>;

    /// All of them, in the order of the struct.
    fn list(&self) -> Vec<OptionInfo>;

    /// What is wrong with the values, for options that a program has set.
    fn fault(&self) -> Option<String>;
}

/// A type of option.
pub(crate) trait OptionValue: Copy + PartialEq {
    /// What values are allowed.
    type Allowed;

    /// The value that `text` says, allowed or not.
    fn read(text: &str) -> Option<Self>;

    /// Text that reads as this value.
    fn write(&self) -> String;

    /// Whether it is one of the allowed values.
    fn is_allowed(&self, allowed: &Self::Allowed) -> bool;

    /// The allowed values, for people.
    fn expected(allowed: &Self::Allowed) -> String;

    /// The allowed values, for programs.
    fn listed(allowed: &Self::Allowed) -> Allowed;
}

macro_rules! number_option {
    ($($type:ty, $whole:literal;)*) => {$(
        impl OptionValue for $type {
            type Allowed = RangeInclusive<$type>;

            fn read(text: &str) -> Option<Self> {
                text.parse().ok()
            }

            fn write(&self) -> String {
                self.to_string()
            }

            fn is_allowed(&self, allowed: &Self::Allowed) -> bool {
                allowed.contains(self) // false for a float that is not a number
            }

            fn expected(allowed: &Self::Allowed) -> String {
                format!("a number from {} to {}", allowed.start(), allowed.end())
            }

            fn listed(allowed: &Self::Allowed) -> Allowed {
                let (low, high) = (f64::from(*allowed.start()), f64::from(*allowed.end()));
                Allowed::Number { low, high, whole: $whole }
            }
        }
    )*};
}
number_option! {
    u32, true;
    f32, false;
}

impl OptionValue for bool {
    type Allowed = ();

    fn read(text: &str) -> Option<Self> {
        match text {
            "on" => Some(true),
            "off" => Some(false),
            _ => None,
        }
    }

    fn write(&self) -> String {
        if *self { "on".into() } else { "off".into() }
    }

    fn is_allowed(&self, (): &()) -> bool {
        true
    }

    fn expected((): &()) -> String {
        "on or off".into()
    }

    fn listed((): &()) -> Allowed {
        Allowed::Switch
    }
}

/// The message for a value that is not allowed.
pub(crate) fn not_allowed<T: OptionValue>(key: &str, text: impl Display, allowed: &T::Allowed) -> String {
    format!("option `{key}` cannot be `{text}`; write {}", T::expected(allowed))
}

/// Declares an enum whose values have names on the command line, or gives names to the values of one that exists. The
/// values' documentation is what people are shown.
macro_rules! choices {
    ($(#[$meta:meta])* pub enum $name:ident { $($(#[doc = $doc:literal])* $value:ident = $text:literal,)* }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name { $($(#[doc = $doc])* $value,)* }

        choices! { impl $name { $($(#[doc = $doc])* $value = $text,)* } }
    };
    (impl $name:ident { $($(#[doc = $doc:literal])* $value:ident = $text:literal,)* }) => {
        impl $crate::technique::options::OptionValue for $name {
            type Allowed = ();

            fn read(text: &str) -> Option<Self> {
                match text {
                    $($text => Some(Self::$value),)*
                    _ => None,
                }
            }

            fn write(&self) -> String {
                match self {
                    $(Self::$value => $text.into(),)*
                }
            }

            fn is_allowed(&self, (): &()) -> bool {
                true
            }

            fn expected((): &()) -> String {
                [$($text),*].join(" or ")
            }

            fn listed((): &()) -> $crate::technique::options::Allowed {
                use $crate::technique::options::{Allowed, Choice};
                const CHOICES: &[Choice] = &[$(Choice::new($text, concat!($($doc),*))),*];
                Allowed::Choice(CHOICES)
            }
        }
    };
}

/// Declares the struct `Options` of a technique: each field with its default and what is allowed, a range for
/// numbers and `()` for the rest. The key of `field_name` is `field-name`, and its documentation is what people are
/// shown: plain sentences without links.
macro_rules! options {
    ($(#[$meta:meta])* pub struct Options {
        $($(#[doc = $doc:literal])* pub $field:ident: $type:ty = $default:expr, $allowed:expr;)*
    }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[non_exhaustive]
        pub struct Options { $($(#[doc = $doc])* pub $field: $type,)* }

        impl Default for Options {
            fn default() -> Self {
                Self { $($field: $default,)* }
            }
        }

        impl $crate::technique::options::Options for Options {
            fn set(&mut self, key: &str, text: &str) -> Result<(), String> {
                $(
                    if key == stringify!($field).replace('_', "-") {
                        use $crate::technique::options::{OptionValue, not_allowed};
                        let value = <$type as OptionValue>::read(text).filter(|v| v.is_allowed(&$allowed));
                        self.$field = value.ok_or_else(|| not_allowed::<$type>(key, text, &$allowed))?;
                        return Ok(());
                    }
                )*
                let keys: &[&str] = &[$(stringify!($field)),*];
                Err($crate::technique::options::unknown(key, text, keys))
            }

            fn changed(&self) -> Vec<(String, String)> {
                #[allow(unused_mut, reason = "a technique may have no options")]
                let mut changed = Vec::new();
                $(
                    if self.$field != $default {
                        let key = stringify!($field).replace('_', "-");
                        changed.push((key, $crate::technique::options::OptionValue::write(&self.$field)));
                    }
                )*
                changed
            }

            fn list(&self) -> Vec<$crate::technique::options::OptionInfo> {
                use $crate::technique::options::{OptionInfo, OptionValue};
                vec![$(OptionInfo {
                    key: stringify!($field).replace('_', "-"),
                    help: concat!($($doc),*).trim_ascii(),
                    value: self.$field.write(),
                    default: <$type as OptionValue>::write(&$default),
                    allowed: <$type as OptionValue>::listed(&$allowed),
                }),*]
            }

            fn fault(&self) -> Option<String> {
                $({
                    use $crate::technique::options::{OptionValue, not_allowed};
                    if !self.$field.is_allowed(&$allowed) {
                        let key = stringify!($field).replace('_', "-");
                        return Some(not_allowed::<$type>(&key, self.$field.write(), &$allowed));
                    }
                })*
                None
            }
        }
    };
}

pub(crate) use choices;
pub(crate) use options;

/// The message for a key that a technique does not have.
pub(crate) fn unknown(key: &str, text: &str, fields: &[&str]) -> String {
    let written = if text.is_empty() { key.to_owned() } else { format!("{key}={text}") };
    if fields.is_empty() {
        return format!("there is no option `{written}`; this technique has none");
    }
    let keys: Vec<String> = fields.iter().map(|field| field.replace('_', "-")).collect();
    format!("there is no option `{written}`; the options are {}", keys.join(", "))
}
