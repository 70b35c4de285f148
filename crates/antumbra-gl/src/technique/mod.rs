//! The techniques: each in a room of its own, and the one list of them.

pub mod analytic;
mod casters;
pub mod composite;
pub mod map;
mod method;
mod options;
mod polygons;
pub mod projected;
mod soft;
pub mod volume;

use crate::gl::{Caps, Needs, ProgramSet, ProgramSource, Variant};
use crate::input::{Error, OptionError, OptionInfo, Part, Reason, Refusal, Scenery};
use method::{Behavior, Make};
pub(crate) use method::{Method, Pass};
use options::Options as _;
use std::fmt;
use std::str::FromStr;

/// The one list of techniques: a line each, and nothing else to add.
macro_rules! techniques {
    ($($(#[$meta:meta])* $name:ident = $module:ident, $text:literal;)*) => {
        /// A way to find shadows, with its options. As text: the name, then `:key=value` for each option that
        /// is not the default, as in `map:size=1024:filter=pcf`.
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[non_exhaustive]
        pub enum Technique { $($(#[$meta])* $name($module::Options),)* }

        impl Technique {
            /// The names of all techniques.
            pub const NAMES: &[&str] = &[$($text),*];

            /// Every technique with its default options.
            pub fn all() -> impl Iterator<Item = Self> {
                [$(Self::$name($module::Options::default())),*].into_iter()
            }

            $(
                $(#[$meta])*
                ///
                /// Its options with their defaults, to change one by one: any of them is a `Technique`.
                pub fn $module() -> $module::Options {
                    $module::Options::default()
                }
            )*

            /// The technique's name.
            pub fn name(&self) -> &'static str {
                match self { $(Self::$name(_) => $text,)* }
            }

            /// What it is, for people.
            pub fn about(&self) -> &'static About {
                match self { $(Self::$name(_) => &$module::ABOUT,)* }
            }

            /// What it cannot do of what it is asked to; `None` if it can do all of it. Needs no OpenGL.
            pub fn refusal(&self, scenery: &Scenery<'_>) -> Option<Refusal> {
                match self {
                    $(Self::$name(options) => match options.fault() {
                        Some(fault) => Some(Refusal::new(Part::Options, Reason::Option(fault))),
                        None => $module::refusal(options, scenery),
                    },)*
                }
            }

            /// Sets one option from text, one of [`Self::options`].
            ///
            /// # Errors
            /// What is wrong with the key or the value, and what to write instead.
            pub fn set(&mut self, key: &str, value: &str) -> Result<(), OptionError> {
                match self { $(Self::$name(options) => options.set(key, value),)* }
            }

            /// Its options, each with its value and what it can be set to: enough to build a menu for any technique.
            pub fn options(&self) -> Vec<OptionInfo> {
                match self { $(Self::$name(options) => options.list(),)* }
            }

            fn changed(&self) -> Vec<(&'static str, String)> {
                match self { $(Self::$name(options) => options.changed(),)* }
            }

            fn behavior(&self) -> &dyn Behavior {
                match self { $(Self::$name(options) => options,)* }
            }

            /// What it compiles.
            pub(crate) fn programs(&self) -> &'static [ProgramSource] {
                match self { $(Self::$name(_) => $module::PROGRAMS,)* }
            }
        }

        $(
            impl From<$module::Options> for Technique {
                fn from(options: $module::Options) -> Self {
                    Self::$name(options)
                }
            }
        )*

        /// The OpenGL objects of the techniques that were chosen.
        #[derive(Default)]
        pub(crate) struct Methods { $($module: Option<Loaded<$module::State>>,)* }

        impl Methods {
            /// Makes a technique's objects, unless it was done, and gives it its options.
            ///
            /// # Safety
            /// A [`crate::gl::StateGuard`] is alive.
            pub(crate) unsafe fn choose(
                &mut self,
                technique: &Technique,
                gl: &glow::Context,
                caps: &Caps,
            ) -> Result<(), Error> {
                match technique {
                    $(Technique::$name(options) => match &mut self.$module {
                        Some(loaded) => loaded.method.set_options(*options),
                        slot => {
                            // SAFETY: the caller's.
                            let method = unsafe { $module::State::make(gl, caps, *options)? };
                            *slot = Some(Loaded { method, programs: ProgramSet::default() });
                        }
                    },)*
                }
                Ok(())
            }

            /// The objects of a technique that was chosen.
            fn of(&mut self, technique: &Technique) -> (&mut dyn Method, &mut ProgramSet) {
                match technique {
                    $(Technique::$name(_) => {
                        let loaded = self.$module.as_mut().expect("choose has made it");
                        (&mut loaded.method, &mut loaded.programs)
                    })*
                }
            }

            /// # Safety
            /// The context is current, and the objects are not used afterwards.
            pub(crate) unsafe fn delete(&mut self, gl: &glow::Context) {
                $(if let Some(mut loaded) = self.$module.take() {
                    // SAFETY: the caller's.
                    unsafe {
                        loaded.method.delete(gl);
                        loaded.programs.delete(gl);
                    }
                })*
            }
        }
    };
}

techniques! {
    /// Exact closed forms, on any surface.
    Analytic = analytic, "analytic";
    /// The closed forms of the composite method (2013, 2017) on one plane, as published.
    Composite = composite, "composite";
    /// Triangles flattened onto planes and rectangles, with a stencil buffer.
    Projected = projected, "projected";
    /// Stencil shadow volumes.
    Volume = volume, "volume";
    /// Shadow maps, on any surface.
    Map = map, "map";
}

/// A technique's OpenGL objects.
struct Loaded<M> {
    method: M,
    programs: ProgramSet,
}

impl Methods {
    /// Compiles what a technique needs for such surfaces, unless it was done.
    pub(crate) fn warm_up(
        &mut self,
        technique: &Technique,
        gl: &glow::Context,
        caps: &Caps,
        variant: Variant,
        needs: Needs,
    ) -> Result<(), Error> {
        self.of(technique).1.ensure(gl, caps, technique.programs(), variant, needs)
    }

    /// A technique's method, and the pass it draws: `drawing` with the technique's programs.
    pub(crate) fn begin<'a>(
        &'a mut self,
        technique: &Technique,
        drawing: crate::gl::Drawing<'a>,
    ) -> (&'a mut dyn Method, Pass<'a>) {
        let (method, programs) = self.of(technique);
        let programs = programs.of(Variant::of(&drawing.frame.surface));
        (method, Pass::new(drawing, programs))
    }
}

impl Technique {
    /// Whether [`crate::Renderer::overlay`] paints shadows over the host's pixels, where others take light away.
    pub fn paints(&self) -> bool {
        self.behavior().paints()
    }

    /// How many point lights stand for a light with an area in the technique's own soft shadows; `None` if it draws the
    /// area as it is, or refuses it.
    pub fn components(&self) -> Option<u32> {
        self.behavior().components()
    }

    /// Whether [`crate::Renderer::depth_map`] has maps to show.
    pub fn has_maps(&self) -> bool {
        self.behavior().has_maps()
    }

    /// Whether it looks at several occluders of an area light at once.
    pub(crate) fn is_exact(&self) -> bool {
        self.behavior().is_exact()
    }

    /// The technique that `text` says: a name from [`Self::NAMES`], then `:key=value` for options.
    ///
    /// # Errors
    /// What is wrong, and what to write instead.
    pub fn parse(text: &str) -> Result<Self, OptionError> {
        let mut words = text.split(':');
        let name = words.next().unwrap_or_default();
        let none = || OptionError::NoTechnique { text: name.to_owned(), names: Self::NAMES };
        let mut technique = Self::all().find(|technique| technique.name() == name).ok_or_else(none)?;
        for word in words {
            let (key, value) = word.split_once('=').unwrap_or((word, ""));
            technique.set(key, value).map_err(|error| OptionError::InTechnique {
                technique: technique.name(),
                error: Box::new(error),
            })?;
        }
        Ok(technique)
    }
}

impl Default for Technique {
    fn default() -> Self {
        Self::Analytic(analytic::Options::default())
    }
}

impl fmt::Display for Technique {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())?;
        self.changed().iter().try_for_each(|(key, value)| write!(f, ":{key}={value}"))
    }
}

impl FromStr for Technique {
    type Err = OptionError;

    fn from_str(text: &str) -> Result<Self, OptionError> {
        Self::parse(text)
    }
}

/// What a technique is, in short.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct About {
    /// One sentence.
    pub summary: &'static str,
    /// What casts shadows.
    pub casts_from: &'static str,
    /// What shadows fall on.
    pub falls_on: &'static str,
}

#[cfg(test)]
mod tests;
