//! Options of techniques: a field of a struct for programs, a row of a table for people.

use crate::input::{Allowed, Choice, OptionError, OptionInfo};

/// A technique's options: the rows of their table, in the order of the struct.
pub(crate) trait Options: Copy + Default + PartialEq + 'static {
    const FIELDS: &'static [Field<Self>];

    /// Sets one option from text.
    fn set(&mut self, key: &str, text: &str) -> Result<(), OptionError> {
        match Self::FIELDS.iter().find(|field| field.key == key) {
            Some(field) => field.read(self, text),
            None => Err(OptionError::NoOption {
                key: key.to_owned(),
                value: text.to_owned(),
                keys: Self::FIELDS.iter().map(|field| field.key).collect(),
            }),
        }
    }

    /// The options that differ from the defaults: key and value.
    fn changed(&self) -> Vec<(&'static str, String)> {
        let changed = self.list().into_iter().filter(|option| option.value != option.default);
        changed.map(|option| (option.key, option.value)).collect()
    }

    /// All of them.
    fn list(&self) -> Vec<OptionInfo> {
        let new = Self::default();
        let info = |field: &Field<Self>| OptionInfo {
            key: field.key,
            help: field.help,
            value: field.write(self),
            default: field.write(&new),
            allowed: field.allowed(),
        };
        Self::FIELDS.iter().map(info).collect()
    }

    /// What is wrong with the values, for options that a program has set.
    fn fault(&self) -> Option<OptionError> {
        Self::FIELDS.iter().find(|field| !field.is_allowed(self)).map(|field| field.error(field.write(self)))
    }
}

/// One option: its name, what it does, and how it is read and written.
pub(crate) struct Field<O> {
    key: &'static str,
    /// Plain sentences, on one line.
    help: &'static str,
    value: Value<O>,
}

/// A type of option, where it is in the struct, and what it may be.
enum Value<O> {
    Whole {
        get: fn(&O) -> u32,
        set: fn(&mut O, u32),
        low: u32,
        high: u32,
    },
    Number {
        get: fn(&O) -> f32,
        set: fn(&mut O, f32),
        low: f32,
        high: f32,
    },
    Switch {
        get: fn(&O) -> bool,
        set: fn(&mut O, bool),
    },
    /// By its place among the choices.
    Choice {
        get: fn(&O) -> usize,
        set: fn(&mut O, usize),
        choices: &'static [Choice],
    },
}

impl<O> Field<O> {
    /// A whole number, the ends included.
    pub(crate) const fn whole(
        key: &'static str,
        help: &'static str,
        (low, high): (u32, u32),
        get: fn(&O) -> u32,
        set: fn(&mut O, u32),
    ) -> Self {
        Self { key, help, value: Value::Whole { get, set, low, high } }
    }

    /// A number, the ends included.
    pub(crate) const fn number(
        key: &'static str,
        help: &'static str,
        (low, high): (f32, f32),
        get: fn(&O) -> f32,
        set: fn(&mut O, f32),
    ) -> Self {
        Self { key, help, value: Value::Number { get, set, low, high } }
    }

    /// On or off.
    pub(crate) const fn switch(
        key: &'static str,
        help: &'static str,
        get: fn(&O) -> bool,
        set: fn(&mut O, bool),
    ) -> Self {
        Self { key, help, value: Value::Switch { get, set } }
    }

    /// One of several, by its place among the `choices`.
    pub(crate) const fn choice(
        key: &'static str,
        help: &'static str,
        choices: &'static [Choice],
        get: fn(&O) -> usize,
        set: fn(&mut O, usize),
    ) -> Self {
        Self { key, help, value: Value::Choice { get, set, choices } }
    }

    /// Text that reads as the value.
    fn write(&self, options: &O) -> String {
        match self.value {
            Value::Whole { get, .. } => get(options).to_string(),
            Value::Number { get, .. } => get(options).to_string(),
            Value::Switch { get, .. } => if get(options) { "on" } else { "off" }.to_owned(),
            Value::Choice { get, choices, .. } => choices[get(options)].name.to_owned(),
        }
    }

    /// Sets the value that `text` says.
    fn read(&self, options: &mut O, text: &str) -> Result<(), OptionError> {
        let wrong = || self.error(text.to_owned());
        match self.value {
            Value::Whole { set, low, high, .. } => {
                let number = text.parse().ok().filter(|number| (low..=high).contains(number));
                set(options, number.ok_or_else(wrong)?);
            }
            Value::Number { set, low, high, .. } => {
                // Never of a float that is not a number.
                let number = text.parse().ok().filter(|number| (low..=high).contains(number));
                set(options, number.ok_or_else(wrong)?);
            }
            Value::Switch { set, .. } => {
                let on = ["off", "on"].iter().position(|name| *name == text).ok_or_else(wrong)?;
                set(options, on == 1);
            }
            Value::Choice { set, choices, .. } => {
                let place = choices.iter().position(|choice| choice.name == text);
                set(options, place.ok_or_else(wrong)?);
            }
        }
        Ok(())
    }

    /// Whether the value is one that it may have.
    fn is_allowed(&self, options: &O) -> bool {
        match self.value {
            Value::Whole { get, low, high, .. } => (low..=high).contains(&get(options)),
            Value::Number { get, low, high, .. } => (low..=high).contains(&get(options)),
            Value::Switch { .. } | Value::Choice { .. } => true,
        }
    }

    fn allowed(&self) -> Allowed {
        match self.value {
            Value::Whole { low, high, .. } => {
                Allowed::Number { low: low.into(), high: high.into(), whole: true }
            }
            Value::Number { low, high, .. } => {
                Allowed::Number { low: low.into(), high: high.into(), whole: false }
            }
            Value::Switch { .. } => Allowed::Switch,
            Value::Choice { choices, .. } => Allowed::Choice(choices),
        }
    }

    fn error(&self, value: String) -> OptionError {
        OptionError::NotAllowed { key: self.key, value, allowed: self.allowed() }
    }
}
