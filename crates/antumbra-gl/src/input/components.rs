//! Lights with an area as collections of point lights, as the paper on soft shadows of 2017 has them.

use super::{Area, Light, Vector};
use antumbra_math::Light as Place;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// A side component that has been put somewhere by hand, for the technique `composite` with `shade=paper`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Component {
    /// The light it belongs to: its index in [`crate::Frame::lights`]. Of lights without area, and of lights that are not
    /// there, components are not looked at.
    pub light: usize,
    /// Where it is, from the light's position, metres, world space. One that is not finite is off. At 0 it is the central component, whose shadow
    /// it adds nothing to.
    pub offset: DVec3,
}

impl Component {
    /// A component of the frame's light `light`, so far from its position.
    pub fn new(light: usize, offset: impl Into<Vector>) -> Self {
        Self { light, offset: offset.into().glam() }
    }
}

/// Calls `each` with the offsets of `count` components from the position of a light with this area: the centre, then
/// the others, evenly on its rim. Of three those are in a row. A ball's rim is its horizontal great circle, a
/// rectangle's the ellipse in it. None for a light without area.
pub fn components(area: &Area, count: u32, mut each: impl FnMut(DVec3)) {
    let Some([right, up]) = area.half_axes() else { return };
    if count > 0 {
        each(DVec3::ZERO);
    }
    for k in 1..count {
        let turn = DVec2::from_angle(TAU * f64::from(k - 1) / f64::from(count - 1));
        each(right * turn.x + up * turn.y);
    }
}

/// Appends the point lights that a light is a collection of, the central one first: itself alone if it has no area.
/// Of `placed`, the components that have been put somewhere, those with the light's `index` take the place of those on
/// the rim.
pub(crate) fn push_components(
    lights: &mut Vec<Light>,
    light: &Light,
    (placed, index): (&[Component], usize),
    count: u32,
) {
    let Place::Point { position } = light.place else { return lights.push(*light) };
    let mut push = |offset: DVec3| {
        let place = Place::Point { position: position + offset };
        lights.push(Light { place, area: Area::None, ..*light });
    };
    let mut own = placed.iter().filter(|component| component.light == index).peekable();
    if light.area == Area::None {
        push(DVec3::ZERO);
    } else if own.peek().is_some() {
        push(DVec3::ZERO);
        own.for_each(|component| push(component.offset));
    } else {
        components(&light.area, count, push);
    }
}
