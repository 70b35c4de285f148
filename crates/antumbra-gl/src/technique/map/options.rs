//! What can be chosen of `map`.

use crate::input::Choice;
use crate::technique::options::{self, Field};

/// How a map is looked up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Filter {
    /// The nearest texel: in or out, with stairs.
    None,
    /// Percentage-closer filtering: the mean of the answers of a square of texels.
    #[default]
    Pcf,
    /// Percentage-closer soft shadows: the same, as wide as the penumbra of the light's area is estimated to be.
    /// Lights without an area are filtered as with `pcf`.
    Pcss,
}

impl Filter {
    const ALL: [Self; 3] = [Self::None, Self::Pcf, Self::Pcss];
    /// In the same order.
    const CHOICES: &[Choice] = &[
        Choice::new("none", "The nearest texel: in or out, with stairs."),
        Choice::new("pcf", "Percentage-closer filtering: the mean of the answers of a square of texels."),
        Choice::new(
            "pcss",
            "Percentage-closer soft shadows: the same, as wide as the penumbra of the light's area is estimated to be. \
             Lights without an area are filtered as with `pcf`.",
        ),
    ];
}

/// Options of the technique `map`. Lengths are in texels, so that they shrink as the map grows.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// Texels of a side of a map; of each of the faces in use for a point light. Four bytes each. 16 to 8192.
    pub size: u32,
    /// How the map is looked up.
    pub filter: Filter,
    /// Half the side of the square of texels that `pcf` takes the mean of; an eighth of the map at most. 0.5 to 8.
    /// Larger: smoother edges, less detail. 0.5 is a bilinear filter, 1.5 the usual 3 by 3 of those.
    pub radius: f32,
    /// How much nearer to the light a point is taken to be. 0 to 1000. Larger: less acne on curved receivers, and a gap
    /// between an object and its shadow.
    pub constant_bias: f32,
    /// The share of the receiver's slope, from its normal, that the comparison follows from texel to texel:
    /// 1 its own plane, 0 a plane that faces the light. Less: acne where light grazes.
    pub slope_bias: f32,
    /// How far a point is moved off its surface, less the more it faces the light. 0 to 1000. Larger: less acne where
    /// normals do not tell the slope, and shadows move.
    pub normal_offset: f32,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            size: 2048,
            filter: Filter::Pcf,
            radius: 1.5,
            constant_bias: 0.1,
            slope_bias: 1.0,
            normal_offset: 0.25,
        }
    }
}

impl Options {
    /// The same with another [`Self::size`].
    pub fn size(self, size: u32) -> Self {
        Self { size, ..self }
    }

    /// The same with another [`Self::filter`].
    pub fn filter(self, filter: Filter) -> Self {
        Self { filter, ..self }
    }

    /// The same with another [`Self::radius`].
    pub fn radius(self, radius: f32) -> Self {
        Self { radius, ..self }
    }

    /// The same with another [`Self::constant_bias`].
    pub fn constant_bias(self, constant_bias: f32) -> Self {
        Self { constant_bias, ..self }
    }

    /// The same with another [`Self::slope_bias`].
    pub fn slope_bias(self, slope_bias: f32) -> Self {
        Self { slope_bias, ..self }
    }

    /// The same with another [`Self::normal_offset`].
    pub fn normal_offset(self, normal_offset: f32) -> Self {
        Self { normal_offset, ..self }
    }
}

impl options::Options for Options {
    const FIELDS: &'static [Field<Self>] = &[
        Field::whole(
            "size",
            "Texels of a side of a map; of each of the faces in use for a point light. Four bytes each.",
            (16, 8192),
            |o| o.size,
            |o, size| o.size = size,
        ),
        Field::choice(
            "filter",
            "How the map is looked up.",
            Filter::CHOICES,
            |o| o.filter as usize,
            |o, place| o.filter = Filter::ALL[place],
        ),
        Field::number(
            "radius",
            "Half the side of the square of texels that `pcf` takes the mean of; an eighth of the map at most. Larger: \
             smoother edges, less detail. 0.5 is a bilinear filter, 1.5 the usual 3 by 3 of those.",
            (0.5, 8.0),
            |o| o.radius,
            |o, radius| o.radius = radius,
        ),
        Field::number(
            "constant-bias",
            "How much nearer to the light a point is taken to be. Larger: less acne on curved receivers, and a gap \
             between an object and its shadow.",
            (0.0, 1000.0),
            |o| o.constant_bias,
            |o, bias| o.constant_bias = bias,
        ),
        Field::number(
            "slope-bias",
            "The share of the receiver's slope, from its normal, that the comparison follows from texel to texel: 1 its \
             own plane, 0 a plane that faces the light. Less: acne where light grazes.",
            (0.0, 1.0),
            |o| o.slope_bias,
            |o, bias| o.slope_bias = bias,
        ),
        Field::number(
            "normal-offset",
            "How far a point is moved off its surface, less the more it faces the light. Larger: less acne where normals \
             do not tell the slope, and shadows move.",
            (0.0, 1000.0),
            |o| o.normal_offset,
            |o, offset| o.normal_offset = offset,
        ),
    ];
}
