//! Options of techniques: fields of a struct for programs, `key=value` for people.

use std::fmt::Display;
use std::ops::RangeInclusive;

/// A technique's options, by key.
pub(crate) trait Options: Default {
    /// Sets one option from text.
    ///
    /// # Errors
    /// What is wrong, and what to write instead.
    fn set(&mut self, key: &str, text: &str) -> Result<(), String>;

    /// The options that differ from the defaults: key and value.
    fn changed(&self) -> Vec<(String, String)>;

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
}

macro_rules! number_option {
    ($($type:ty),*) => {$(
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
        }
    )*};
}
number_option!(u32, f32);

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
}

/// The message for a value that is not allowed.
pub(crate) fn not_allowed<T: OptionValue>(key: &str, text: impl Display, allowed: &T::Allowed) -> String {
    format!("option `{key}` cannot be `{text}`; write {}", T::expected(allowed))
}

/// Declares an enum whose values have names on the command line.
macro_rules! choices {
    ($(#[$meta:meta])* pub enum $name:ident { $($(#[$value_meta:meta])* $value:ident = $text:literal,)* }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name { $($(#[$value_meta])* $value,)* }

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
        }
    };
}

/// Declares the struct `Options` of a technique: each field with its default and what is allowed, a range for
/// numbers and `()` for the rest. The key of `field_name` is `field-name`.
macro_rules! options {
    ($(#[$meta:meta])* pub struct Options {
        $($(#[$field_meta:meta])* pub $field:ident: $type:ty = $default:expr, $allowed:expr;)*
    }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[non_exhaustive]
        pub struct Options { $($(#[$field_meta])* pub $field: $type,)* }

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
