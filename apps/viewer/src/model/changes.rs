//! Moving, adding and taking away what the scene holds.

use antumbra::glam::DVec3;
use antumbra_scene::{Scene, limits};

use super::pick::Item;
use super::{Model, edit};

impl Model {
    /// Moves what is held by the pointer.
    pub(crate) fn move_item(&mut self, item: Item, by: DVec3) {
        // What was held may be gone.
        match item {
            Item::Light(i) => self.document.edit(("move light", i), |s| {
                if let Some(light) = s.lights.get_mut(i) {
                    edit::move_light(light, by);
                }
            }),
            Item::Object(i) => self.document.edit(("move object", i), |s| {
                if let Some(object) = s.objects.get_mut(i) {
                    edit::move_object(object, by);
                }
            }),
        }
    }

    pub(super) fn delete(&mut self) {
        match self.chosen.take() {
            Some(Item::Light(i)) if i < self.scene().lights.len() => {
                self.document.edit_all(("delete", i), |s, components| {
                    s.lights.remove(i);
                    components.retain(|c| c.light != i);
                    components.iter_mut().filter(|c| c.light > i).for_each(|c| c.light -= 1);
                });
                self.component = None;
            }
            Some(Item::Object(i)) if i < self.scene().objects.len() => {
                self.document.edit(("delete", i), |s| drop(s.objects.remove(i)));
            }
            _ => self.complain("nothing is chosen"),
        }
        self.document.end_stroke();
        self.stay_inside();
    }

    pub(super) fn duplicate(&mut self) {
        let scene = self.scene();
        let step = DVec3::new(0.3, 0.0, 0.3);
        match self.chosen {
            Some(Item::Light(i)) if i < scene.lights.len() => {
                if scene.lights.len() >= limits::MAX_LIGHTS {
                    return self.complain(format!("a scene has at most {} lights", limits::MAX_LIGHTS));
                }
                let mut light = scene.lights[i].clone();
                light.name = scene.unique_light_name(&light.name);
                edit::move_light(&mut light, step);
                self.choose_after(Item::Light(scene.lights.len()), |s| s.lights.push(light));
            }
            Some(Item::Object(i)) if i < scene.objects.len() => {
                if !edit::has_room(scene, scene.objects[i].parts.len()) {
                    return self.complain(edit::NO_ROOM);
                }
                let mut object = scene.objects[i].clone();
                object.name = scene.unique_object_name(&object.name);
                edit::move_object(&mut object, step);
                self.choose_after(Item::Object(scene.objects.len()), |s| s.objects.push(object));
            }
            _ => self.complain("nothing is chosen"),
        }
    }

    /// Adds something and chooses it.
    pub(crate) fn choose_after(&mut self, item: Item, add: impl FnOnce(&mut Scene)) {
        self.document.end_stroke();
        self.document.edit(("add", 0), add);
        self.document.end_stroke();
        self.choose(Some(item));
    }

    pub(super) fn undo(&mut self) {
        if !self.document.can_undo() {
            return self.say("nothing to undo");
        }
        self.document.undo();
        self.stay_inside();
    }

    pub(super) fn redo(&mut self) {
        if !self.document.can_redo() {
            return self.say("nothing to redo");
        }
        self.document.redo();
        self.stay_inside();
    }

    /// After lights or objects have come or gone.
    pub(super) fn stay_inside(&mut self) {
        let (lights, objects) = (self.scene().lights.len(), self.scene().objects.len());
        self.light = self.light.min(lights.saturating_sub(1));
        self.chosen = self.chosen.filter(|item| match *item {
            Item::Light(i) => i < lights,
            Item::Object(i) => i < objects,
        });
    }
}
