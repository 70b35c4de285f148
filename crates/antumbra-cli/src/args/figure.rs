//! The figures of `antumbra bench`, by name.

use clap::ValueEnum;

/// A figure, by its name on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum FigureName {
    /// One circle, triangle, sphere, cone or complex object: Fig. 7 of the 2017 paper
    Primitives,
    /// 1 to 64 lights
    Lights,
    /// 1 to 1000 occluders
    Occluders,
    /// 256 to 2048 pixels across
    Resolution,
    /// Soft shadows of a ball light made of 1 to 64 points, and without: Fig. 7 of the 2017 paper on soft shadows
    Soft,
}
