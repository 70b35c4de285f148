//! The lights in the panel.

use antumbra::glam::DVec3;
use antumbra_scene::{Light, LightKind, Scene};
use egui::{Color32, ComboBox, RichText, Ui};

use super::style::ACCENT;
use super::{Asked, Seen, fields};
use crate::model::edit;
use crate::model::pick::Item;
use crate::model::{Model, command::Command};

/// The kinds in the panel's words.
const KINDS: [&str; 6] = ["point", "sphere", "disc", "rectangle", "spot", "directional"];

/// The list, and the chosen light with all it has.
pub(crate) fn show(ui: &mut Ui, model: &mut Model, seen: &mut Seen) {
    let scene = model.scene().clone();
    super::list(ui, "lights", scene.lights.len(), |ui, i| {
        let light = &scene.lights[i];
        let [r, g, b] = (light.color / light.color.max_element().max(1e-9)).to_array();
        let swatch = egui::Rgba::from_rgb(r as f32, g as f32, b as f32);
        let (spot, _) = ui.allocate_exact_size(egui::vec2(12.0, 18.0), egui::Sense::hover());
        let ring = if i == model.light { ACCENT } else { Color32::BLACK };
        ui.painter().circle(spot.center(), 5.0, Color32::from(swatch), egui::Stroke::new(1.5, ring));
        let chosen = model.chosen == Some(Item::Light(i));
        if ui.selectable_label(chosen, format!("{}  {}", i + 1, light.name)).clicked() {
            seen.choose(Some(Item::Light(i)));
        }
        ui.label(RichText::new(light.kind.type_name()).weak());
    });
    let chosen = matches!(model.chosen, Some(Item::Light(_)));
    match super::add_or_remove(ui, "light", &KINDS, chosen) {
        Some(Asked::Add(kind)) => add(model, kind),
        Some(Asked::Remove) => model.apply(Command::Delete),
        None => {}
    }
    if let Some(Item::Light(i)) = model.chosen
        && let Some(light) = model.scene().lights.get(i).cloned()
    {
        ui.separator();
        ui.push_id(("light", i), |ui| editor(ui, model, i, light));
    }
}

fn add(model: &mut Model, kind: &str) {
    let scene = model.scene();
    let distance = scene.camera.eye.distance(scene.camera.target);
    let kind = self::kind(kind, DVec3::NEG_Y, 0.03 * distance.clamp(0.1, 1e3));
    let count = scene.lights.len();
    if count >= antumbra_scene::limits::MAX_LIGHTS {
        return model.complain(format!("a scene has at most {count} lights"));
    }
    model.choose_after(Item::Light(count), |scene| {
        edit::add_light(scene, kind, distance);
    });
}

fn editor(ui: &mut Ui, model: &mut Model, i: usize, mut light: Light) {
    let scene = model.scene().clone();
    let mut changed = fields::name(ui, "name", &mut light.name, |text| {
        let mut others = Scene::clone(&scene);
        others.lights.remove(i);
        Some(others.unique_light_name(text))
    });
    let name = light.kind.type_name();
    fields::row(ui, "type", |ui, label| {
        let combo = ComboBox::from_id_salt("type").selected_text(name).show_ui(ui, |ui| {
            for kind in KINDS {
                if ui.selectable_label(kind == name, kind).clicked() && kind != name {
                    convert(&mut light, kind, scene.camera.target);
                    changed = true;
                }
            }
        });
        combo.response.labelled_by(label);
    });
    changed |= fields::color(ui, "color", &mut light.color);
    let directional = matches!(light.kind, LightKind::Directional { .. });
    changed |=
        fields::brightness(ui, "intensity", &mut light.intensity, if directional { " lx" } else { " cd" });
    if !directional {
        changed |= fields::point(ui, "position", &mut light.position);
    }
    changed |= shape(ui, &mut light.kind);
    if !directional {
        changed |= super::moves(ui, &mut model.parked, ("light", &light.name), &mut light.motion, || {
            edit::some_motion(&scene, light.position)
        });
        if let Some(motion) = &mut light.motion {
            changed |= fields::motion(ui, motion, light.position, scene.camera.target);
        }
    }
    if changed {
        model.document.edit(("light", i), |s| s.lights[i] = light);
    }
}

/// What only lights of its kind have.
fn shape(ui: &mut Ui, kind: &mut LightKind) -> bool {
    match kind {
        LightKind::Point => false,
        LightKind::Directional { direction } => fields::direction(ui, "direction", direction),
        LightKind::Spot { direction, inner_angle, outer_angle } => {
            let mut changed = fields::direction(ui, "direction", direction);
            let outer = outer_angle.to_degrees();
            changed |= fields::angle(ui, "inner angle", inner_angle, (0.0, (outer - 0.01).max(0.0)));
            let inner = inner_angle.to_degrees();
            changed |= fields::angle(ui, "outer angle", outer_angle, (inner + 0.01, 90.0));
            changed
        }
        LightKind::Sphere { radius } => fields::length(ui, "radius", radius),
        LightKind::Disc { direction, radius } => {
            fields::direction(ui, "direction", direction) | fields::length(ui, "radius", radius)
        }
        LightKind::Rectangle { direction, right, width, height } => {
            let turned =
                fields::direction(ui, "direction", direction) | fields::direction(ui, "right", right);
            if turned {
                *right = across(*direction, *right);
            }
            turned | fields::length(ui, "width", width) | fields::length(ui, "height", height)
        }
    }
}

/// The unit vector across a direction that is nearest to another.
fn across(direction: DVec3, right: DVec3) -> DVec3 {
    let flat = right - direction * direction.dot(right);
    let right = flat.try_normalize().filter(|_| flat.length() > 1e-6);
    right.unwrap_or_else(|| direction.any_orthonormal_vector())
}

/// A kind by its name, shining along a direction, with the size of a radius.
fn kind(name: &str, direction: DVec3, radius: f64) -> LightKind {
    match name {
        "directional" => LightKind::Directional { direction },
        "spot" => LightKind::Spot { direction, inner_angle: 0.35, outer_angle: 0.6 },
        "sphere" => LightKind::Sphere { radius },
        "disc" => LightKind::Disc { direction, radius },
        "rectangle" => {
            let right = across(direction, DVec3::X);
            LightKind::Rectangle { direction, right, width: 2.0 * radius, height: 2.0 * radius }
        }
        _ => LightKind::Point,
    }
}

/// Makes a light one of another kind that shines where it shone, about as bright and as large.
fn convert(light: &mut Light, name: &str, target: DVec3) {
    let towards = (target - light.position).try_normalize().unwrap_or(DVec3::NEG_Y);
    let (direction, radius) = match light.kind {
        LightKind::Point => (towards, 0.3),
        LightKind::Directional { direction } | LightKind::Spot { direction, .. } => (direction, 0.3),
        LightKind::Sphere { radius } => (towards, radius),
        LightKind::Disc { direction, radius } => (direction, radius),
        LightKind::Rectangle { direction, width, height, .. } => (direction, 0.25 * (width + height)),
    };
    let was_sun = matches!(light.kind, LightKind::Directional { .. });
    light.kind = kind(name, direction, radius);
    let is_sun = matches!(light.kind, LightKind::Directional { .. });
    let limit = antumbra_scene::limits::MAX_BRIGHTNESS;
    if is_sun {
        let distance = light.position.distance(target).max(1.0);
        light.intensity /= distance * distance;
        light.position = DVec3::ZERO;
        light.motion = None;
    } else if was_sun {
        light.position = edit::within(target - direction * 8.0);
        light.intensity = (light.intensity * 64.0).min(limit);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_becomes_every_other_and_stays_a_scene() {
        let text = "[camera]\neye = [0, 3, 6]\n[[light]]\nname = \"a\"\ntype = \"point\"\nposition = [1, 5, 2]\nintensity = 9";
        let scene = Scene::parse(text, "test".as_ref()).expect("a scene");
        for from in KINDS {
            for to in KINDS {
                let mut scene = scene.clone();
                convert(&mut scene.lights[0], from, DVec3::ZERO);
                convert(&mut scene.lights[0], to, DVec3::ZERO);
                assert_eq!(scene.lights[0].kind.type_name(), to, "it is what was asked for");
                scene.validate().unwrap_or_else(|error| panic!("{from} to {to}: {error}"));
            }
        }
    }
}
