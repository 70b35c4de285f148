//! What a technique cannot do of what it is asked to.

use super::{Area, Light, OptionError, Soft};
use std::fmt;

/// What a technique cannot do.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Refusal {
    /// What it is about.
    pub part: Part,
    /// Why.
    pub reason: Reason,
}

/// A part of a [`crate::Scenery`], by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
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

/// Why a technique cannot do something. As text it is the second half of a sentence that begins with the technique's
/// name: "has no closed form for meshes".
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Reason {
    /// An option has a value that it cannot have.
    Option(OptionError),
    /// There are no shadows of lights with an area.
    Area,
    /// There are none unless the option `filter` is `pcss`.
    AreaWithoutPcss,
    /// A light cannot be this many points.
    SampleCount(u32),
    /// What is painted has no average over points.
    PaintedSamples,
    /// There is no closed form for the shape.
    NoFormForShape,
    /// There is no closed form for meshes.
    NoFormForMeshes,
    /// The papers have no equations for meshes.
    NoEquationsForMeshes,
    /// The papers have no equations for the shape as it stands.
    NoEquations(antumbra_math::composite::Refusal),
    /// One plane or rectangle must receive shadows, and none does.
    NoReceiver,
    /// One plane or rectangle must receive shadows, and several do.
    SeveralReceivers,
    /// The receiver has no extent.
    FlatReceiver,
    /// Only shadows of point lights can be painted.
    PaintedPointsAlone,
    /// Planes or rectangles must receive shadows, and none does.
    NoReceivers,
    /// Lights are taken away with the stencil alone.
    PhysicalWithoutStencil,
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Option(error) => return error.fmt(f),
            Self::NoEquations(why) => return write!(f, "has no equations for this: {why}"),
            Self::SampleCount(count) => {
                return write!(f, "takes 1 to {} samples of a light, not {count}", Soft::MOST);
            }
            Self::Area => "has no shadows of lights with an area",
            Self::AreaWithoutPcss => "has no shadows of lights with an area unless its option filter is pcss",
            Self::PaintedSamples => {
                "paints shadows, of which there is no average; take shade=physical, or soft=native"
            }
            Self::NoFormForShape => "has no closed form for this shape",
            Self::NoFormForMeshes => "has no closed form for meshes",
            Self::NoEquationsForMeshes => "has no equations for meshes",
            Self::NoReceiver => "needs one plane or rectangle that receives shadows",
            Self::SeveralReceivers => "draws on one plane or rectangle, and several receive shadows",
            Self::FlatReceiver => "draws on a plane or rectangle of some extent, and the receiver has none",
            Self::PaintedPointsAlone => {
                "paints the shadows of point lights alone (it casts any light's with shade=physical)"
            }
            Self::NoReceivers => "casts on planes and rectangles alone, and has none to fall on",
            Self::PhysicalWithoutStencil => {
                "needs the stencil to take a light away; add shade=paper to do without"
            }
        })
    }
}

impl Refusal {
    pub(crate) fn new(part: Part, reason: Reason) -> Self {
        Self { part, reason }
    }

    /// The first light with an area, for techniques that have hard shadows alone.
    pub(crate) fn of_areas(lights: &[Light]) -> Option<Self> {
        let light = lights.iter().position(|light| light.area != Area::None)?;
        Some(Self::new(Part::Light(light), Reason::Area))
    }
}
