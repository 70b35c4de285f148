//! The techniques: each in a file of its own, and the one list of them.

pub mod analytic;
mod casters;
pub mod composite;
pub mod map;
mod options;
pub mod projected;
pub mod volume;

use crate::frame::Frame;
use crate::resources::Target;
use crate::results::Counts;
use crate::scenery::{Light, Scenery};
use crate::shader::{Program, ProgramSource};
use crate::surface::set_surface;
use crate::tiles::TileGrid;
use crate::view::View;
use crate::{Caps, Encoding, Error};
use options::Options as _;
pub use options::{Allowed, Choice, OptionInfo};
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
                        Some(reason) => Some(Refusal { part: Part::Options, reason }),
                        None => $module::refusal(options, scenery),
                    },)*
                }
            }

            /// Sets one option from text, one of [`Self::options`].
            ///
            /// # Errors
            /// What is wrong with the key or the value, and what to write instead.
            pub fn set(&mut self, key: &str, value: &str) -> Result<(), String> {
                match self { $(Self::$name(options) => options.set(key, value),)* }
            }

            /// Its options, each with its value and what it can be set to: enough to build a menu for any technique.
            pub fn options(&self) -> Vec<OptionInfo> {
                match self { $(Self::$name(options) => options.list(),)* }
            }

            fn changed(&self) -> Vec<(String, String)> {
                match self { $(Self::$name(options) => options.changed(),)* }
            }

            fn behavior(&self) -> &dyn Behavior {
                match self { $(Self::$name(options) => options,)* }
            }

            /// Its place in [`Self::NAMES`].
            pub(crate) fn index(&self) -> usize {
                Self::NAMES.iter().position(|name| *name == self.name()).unwrap_or(0)
            }

            /// What it compiles.
            pub(crate) fn programs(&self) -> &'static [ProgramSource] {
                match self { $(Self::$name(_) => $module::PROGRAMS,)* }
            }

            /// Makes the OpenGL objects that do not depend on the frame.
            ///
            /// # Safety
            /// A [`crate::state::StateGuard`] is alive.
            pub(crate) unsafe fn make(
                &self,
                gl: &glow::Context,
                caps: &Caps,
            ) -> Result<Box<dyn Method>, Error> {
                match self {
                    // SAFETY: the caller's.
                    $(Self::$name(_) => unsafe { Ok(Box::new($module::State::new(gl, caps)?)) },)*
                }
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
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut words = text.split(':');
        let name = words.next().unwrap_or_default();
        let mut technique = Self::all().find(|technique| technique.name() == name).ok_or_else(|| {
            format!("there is no technique `{name}`; the techniques are {}", Self::NAMES.join(", "))
        })?;
        for word in words {
            let (key, value) = word.split_once('=').unwrap_or((word, ""));
            technique.set(key, value).map_err(|error| format!("technique {name}: {error}"))?;
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
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::parse(text)
    }
}

/// What a technique is, in short.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct About {
    /// One sentence.
    pub summary: &'static str,
    /// What casts shadows.
    pub casts_from: &'static str,
    /// What shadows fall on.
    pub falls_on: &'static str,
}

/// What a technique cannot do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// What it is about.
    pub part: Part,
    /// Why, as the second half of a sentence that begins with the technique's name: "cannot cast from meshes".
    pub reason: String,
}

/// A part of a [`Scenery`], by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// One of the lights.
    Light(usize),
    /// One of the occluders.
    Occluder(usize),
    /// One of the meshes.
    Mesh(usize),
    /// The receivers.
    Receivers,
    /// The technique's own options.
    Options,
}

impl Refusal {
    /// The first light with an area, for techniques that have hard shadows alone.
    pub(crate) fn of_areas(lights: &[Light]) -> Option<Self> {
        let light = lights.iter().position(|light| light.area != crate::Area::None)?;
        Some(Self { part: Part::Light(light), reason: "has no shadows of lights with an area".into() })
    }
}

/// One frame, as the methods see it.
pub(crate) struct Pass<'a> {
    pub(crate) gl: &'a glow::Context,
    pub(crate) caps: &'a Caps,
    pub(crate) frame: &'a Frame<'a>,
    pub(crate) view: &'a View,
    /// The technique with its options.
    pub(crate) technique: &'a Technique,
    /// The technique's programs for the frame's surface, in the order of its list.
    pub(crate) programs: &'a [Option<Program>],
}

impl Pass<'_> {
    /// A program of the technique's list.
    pub(crate) fn program(&self, index: usize) -> &Program {
        self.programs[index].as_ref().expect("compiled for the frame's lights")
    }

    /// Uses a program of the technique's list and gives it the host's surface: `offset` leads from the pixels of
    /// the target that is drawn to to the surface's texels. Takes units 0 to 2; 3 and 4 are the technique's.
    ///
    /// # Safety
    /// A [`crate::state::StateGuard`] is alive.
    pub(crate) unsafe fn use_program(&self, index: usize, offset: [i32; 2]) -> &Program {
        let program = self.program(index);
        // SAFETY: the caller's.
        unsafe { set_surface(self.gl, program, self.view, &self.frame.surface, offset) };
        program
    }

    /// The offset for targets of the viewport's size, such as masks.
    pub(crate) fn mask_offset(&self) -> [i32; 2] {
        [self.view.viewport[0], self.view.viewport[1]]
    }
}

/// Up to [`crate::BATCH_LIGHTS`] lights whose visibility is drawn at once.
pub(crate) struct Batch<'a> {
    pub(crate) lights: &'a [Light],
    /// The channels they go to: two targets of four, cleared to 1, as large as the viewport.
    pub(crate) masks: [&'a Target; 2],
    /// Where the masks may differ from 1: the method touches these tiles, and no others are looked at.
    pub(crate) tiles: &'a mut TileGrid,
}

/// What a technique with its options does out of the ordinary: its `Options` answer.
pub(crate) trait Behavior {
    /// See [`Technique::paints`]; if so, [`Method::painter`] has a painter.
    fn paints(&self) -> bool {
        false
    }

    /// See [`Technique::components`].
    fn components(&self) -> Option<u32> {
        None
    }

    /// Whether [`Method::draw_map`] has maps to draw.
    fn has_maps(&self) -> bool {
        false
    }

    /// Whether it looks at several occluders of an area light at once, with the programs of [`LightKind::ExactBall`] and
    /// [`LightKind::ExactFlat`].
    ///
    /// [`LightKind::ExactBall`]: crate::shader::LightKind::ExactBall
    /// [`LightKind::ExactFlat`]: crate::shader::LightKind::ExactFlat
    fn is_exact(&self) -> bool {
        false
    }
}

/// How a technique draws. One object serves frame after frame.
pub(crate) trait Method {
    /// Prepares a frame that the technique does not refuse.
    ///
    /// # Safety
    /// A [`crate::state::StateGuard`] is alive, and the frame was checked.
    unsafe fn begin(&mut self, pass: &Pass<'_>) -> Result<(), Error>;

    /// Draws the visibility of some of the frame's lights. State that the guard does not keep (see
    /// [`crate::state::RasterGuard`]) is left as it was found.
    ///
    /// # Safety
    /// As for [`Self::begin`], which was called for this frame.
    unsafe fn draw_visibility(&mut self, pass: &Pass<'_>, batch: &mut Batch<'_>) -> Result<(), Error>;

    /// For techniques that paint shadows over the host's pixels instead of taking light from them.
    fn painter(&mut self, _pass: &Pass<'_>) -> Option<&mut dyn Painter> {
        None
    }

    /// For techniques with shadow maps: draws the map of a light as [`Self::draw_visibility`] does, which may draw
    /// another over it. `None` if nothing in sight is in the light's shadow.
    ///
    /// # Safety
    /// As for [`Self::draw_visibility`].
    unsafe fn draw_map(&mut self, _pass: &Pass<'_>, _light: &Light) -> Result<Option<map::DepthMap>, Error> {
        Ok(None)
    }

    /// What was done since [`Self::begin`].
    fn counts(&self) -> Counts;

    /// Deletes the OpenGL objects.
    ///
    /// # Safety
    /// The context is current, and the object is not used afterwards.
    unsafe fn delete(&mut self, gl: &glow::Context);
}

/// Paints shadows over the host's pixels.
pub(crate) trait Painter {
    /// Paints the shadows of all lights, and touches the tiles it may paint in, none of which is touched.
    ///
    /// # Safety
    /// As for [`Method::draw_visibility`]; the host's framebuffer is bound for drawing, with its first colour
    /// buffer alone, and the viewport set.
    unsafe fn paint(
        &mut self,
        pass: &Pass<'_>,
        encoding: Encoding,
        tiles: &mut TileGrid,
    ) -> Result<(), Error>;
}

#[cfg(test)]
mod tests;
