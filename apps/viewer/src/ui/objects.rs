//! The objects in the panel.

use antumbra::glam::DVec3;
use antumbra_scene::{Object, Part, Pose, Scene, Shape};
use egui::{RichText, Ui};

use super::{Asked, Seen, fields};
use crate::model::edit;
use crate::model::pick::Item;
use crate::model::{Model, command::Command};

/// The shapes that can be added; meshes come with scene files.
const SHAPES: [&str; 11] = [
    "plane",
    "rectangle",
    "disc",
    "triangle",
    "sphere",
    "ellipsoid",
    "cone",
    "cylinder",
    "capsule",
    "box",
    "torus",
];

/// The list, and the chosen object with all it has.
pub(crate) fn show(ui: &mut Ui, model: &mut Model, seen: &mut Seen) {
    let scene = model.scene().clone();
    super::list(ui, "objects", scene.objects.len(), |ui, i| {
        let object = &scene.objects[i];
        let chosen = model.chosen == Some(Item::Object(i));
        if ui.selectable_label(chosen, &object.name).clicked() {
            seen.choose(Some(Item::Object(i)));
        }
        ui.label(RichText::new(kind_name(object)).weak());
    });
    let chosen = matches!(model.chosen, Some(Item::Object(_)));
    match super::add_or_remove(ui, "object", &SHAPES, chosen) {
        Some(Asked::Add(kind)) => add(model, kind),
        Some(Asked::Remove) => model.apply(Command::Delete),
        None => {}
    }
    if let Some(Item::Object(i)) = model.chosen
        && let Some(object) = model.scene().objects.get(i).cloned()
    {
        ui.separator();
        ui.push_id(("object", i), |ui| editor(ui, model, i, object));
    }
}

fn add(model: &mut Model, kind: &str) {
    let count = model.scene().objects.len();
    if !edit::has_room(model.scene(), 1) {
        return model.complain(edit::NO_ROOM);
    }
    model.choose_after(Item::Object(count), |scene| {
        edit::add_object(scene, kind, shape(kind));
    });
}

fn editor(ui: &mut Ui, model: &mut Model, i: usize, mut object: Object) {
    let scene = model.scene().clone();
    let mut changed = fields::name(ui, "name", &mut object.name, |text| {
        let mut others = Scene::clone(&scene);
        others.objects.remove(i);
        Some(others.unique_object_name(text))
    });
    changed |= fields::color(ui, "color", &mut object.color);
    changed |= pose(ui, &mut object.pose);
    ui.horizontal(|ui| {
        changed |= fields::tick(ui, "casts shadow", &mut object.casts_shadow);
        changed |= fields::tick(ui, "receives shadow", &mut object.receives_shadow);
    });
    let several = object.parts.len() > 1;
    for (k, part) in object.parts.iter_mut().enumerate() {
        ui.push_id(k, |ui| {
            if several {
                egui::CollapsingHeader::new(format!("part {}: {}", k + 1, part.shape.type_name())).show(
                    ui,
                    |ui| {
                        changed |= sizes(ui, part);
                        changed |= pose(ui, &mut part.pose);
                    },
                );
            } else {
                changed |= sizes(ui, part);
            }
        });
    }
    changed |= super::moves(ui, &mut model.parked, ("object", &object.name), &mut object.motion, || {
        edit::some_motion(&scene, object.pose.translation + DVec3::X)
    });
    if let Some(motion) = &mut object.motion {
        changed |= fields::motion(ui, motion, object.pose.translation, scene.camera.target);
    }
    if changed {
        model.document.edit(("object", i), |s| s.objects[i] = object);
    }
}

fn pose(ui: &mut Ui, pose: &mut Pose) -> bool {
    fields::point(ui, "position", &mut pose.translation)
        | fields::rotation(ui, "rotation", &mut pose.rotation)
}

/// The sizes of a shape.
fn sizes(ui: &mut Ui, part: &mut Part) -> bool {
    match &mut part.shape {
        Shape::Plane => false,
        Shape::Rectangle { width, depth } => {
            fields::length(ui, "width", width) | fields::length(ui, "depth", depth)
        }
        Shape::Disc { radius } | Shape::Sphere { radius } => fields::length(ui, "radius", radius),
        Shape::Triangle { vertices } => {
            let before = *vertices;
            let mut changed = false;
            for (i, vertex) in vertices.iter_mut().enumerate() {
                changed |= fields::point(ui, &format!("corner {}", i + 1), vertex);
            }
            let [a, b, c] = *vertices;
            // Corners on one line make no triangle.
            let area = (b - a).cross(c - a).length();
            let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
            if changed && area <= 1e-6 * longest * longest {
                *vertices = before;
                return false;
            }
            changed
        }
        Shape::Ellipsoid { radii } => fields::lengths(ui, "radii", radii),
        Shape::Cone { radius, height } | Shape::Capsule { radius, height } => {
            fields::length(ui, "radius", radius) | fields::length(ui, "height", height)
        }
        Shape::Cylinder { radius, height, radius_top } => {
            fields::length(ui, "radius", radius)
                | fields::length(ui, "height", height)
                | fields::length(ui, "radius top", radius_top)
        }
        Shape::Box { size } => fields::lengths(ui, "size", size),
        Shape::Torus { major_radius, minor_radius } => {
            let changed = fields::length(ui, "ring", major_radius) | fields::length(ui, "tube", minor_radius);
            *minor_radius = minor_radius.min(*major_radius);
            changed
        }
        Shape::Mesh(mesh) => {
            ui.label(format!("{}: {} triangles", mesh.path, mesh.triangles.len()));
            false
        }
    }
}

fn kind_name(object: &Object) -> &'static str {
    match object.parts.as_slice() {
        [part] => part.shape.type_name(),
        _ => "composite",
    }
}

/// A shape by its name, a metre or so in size.
fn shape(name: &str) -> Shape {
    match name {
        "plane" => Shape::Plane,
        "rectangle" => Shape::Rectangle { width: 1.5, depth: 1.0 },
        "disc" => Shape::Disc { radius: 0.6 },
        "triangle" => Shape::Triangle {
            vertices: [DVec3::new(-0.6, 0.0, 0.4), DVec3::new(0.6, 0.0, 0.4), DVec3::new(0.0, 0.0, -0.6)],
        },
        "ellipsoid" => Shape::Ellipsoid { radii: DVec3::new(0.7, 0.4, 0.5) },
        "cone" => Shape::Cone { radius: 0.5, height: 1.0 },
        "cylinder" => Shape::Cylinder { radius: 0.4, height: 1.0, radius_top: 0.4 },
        "capsule" => Shape::Capsule { radius: 0.3, height: 0.7 },
        "box" => Shape::Box { size: DVec3::splat(0.8) },
        "torus" => Shape::Torus { major_radius: 0.5, minor_radius: 0.15 },
        _ => Shape::Sphere { radius: 0.5 },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shape_can_be_added() {
        let mut scene = Scene::parse("[camera]\neye = [0, 3, 6]", "test".as_ref()).expect("a scene");
        for name in SHAPES {
            assert_eq!(shape(name).type_name(), name, "it is what was asked for");
            edit::add_object(&mut scene, name, shape(name)).expect("room");
        }
        scene.validate().expect("a scene that can be saved");
    }
}
