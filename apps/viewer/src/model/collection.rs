//! Lights that are drawn as a collection of components, which keys move one by one.

use antumbra::glam::DVec3;
use antumbra::{Component, components};
use antumbra_scene::Light;

use super::pick::Item;
use super::{Model, Side, edit};

impl Model {
    /// `G` and `H`: a component where the chosen light is a collection of them, else a light.
    pub(super) fn choose_side(&mut self, side: Side, light: usize) {
        if self.side_components().is_empty() {
            self.choose_light(light);
        } else {
            self.component = Some(side);
            self.chosen = Some(Item::Light(self.light));
        }
    }

    /// Where the components of the chosen light are, but for the central one; empty unless it is a collection.
    pub(super) fn side_components(&self) -> Vec<DVec3> {
        let own: Vec<DVec3> =
            self.document.components().iter().filter(|c| c.light == self.light).map(|c| c.offset).collect();
        let (Some(count), Some(light)) = (self.settings.components(), self.scene().lights.get(self.light))
        else {
            return Vec::new();
        };
        if !own.is_empty() && antumbra_host::light(light).area != antumbra::Area::None {
            return own;
        }
        let mut offsets = Vec::new();
        components(&antumbra_host::light(light).area, count, |offset| offsets.push(offset));
        offsets.drain(..offsets.len().min(1));
        offsets
    }

    /// The component that is chosen, by its place among the side components, and where they are.
    pub(super) fn chosen_component(&self) -> Option<(usize, Vec<DVec3>)> {
        let offsets = self.side_components();
        let by_x = |a: &usize, b: &usize| offsets[*a].x.total_cmp(&offsets[*b].x);
        let index = match self.component? {
            Side::Left => (0..offsets.len()).min_by(by_x)?,
            Side::Right => (0..offsets.len()).max_by(by_x)?,
        };
        Some((index, offsets))
    }

    /// Where the components of lights are that are drawn as collections: for marks in the picture.
    pub(crate) fn component_positions(&self, light: &Light) -> Vec<DVec3> {
        self.side_components().into_iter().map(|offset| light.position + offset).collect()
    }

    /// Moves the chosen light, or its chosen component.
    pub(crate) fn move_light(&mut self, by: DVec3) {
        let light = self.light;
        if let Some((index, mut offsets)) = self.chosen_component() {
            offsets[index] = edit::within(offsets[index] + by);
            self.document.edit_all(("move component", light), |_, components| {
                components.retain(|c| c.light != light);
                components.extend(offsets.into_iter().map(|offset| Component::new(light, offset)));
            });
        } else if light < self.scene().lights.len() {
            self.document.edit(("move light", light), |s| edit::move_light(&mut s.lights[light], by));
        } else {
            self.complain("the scene has no light; add one in the panel");
        }
    }
}
