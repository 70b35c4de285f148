//! The state as JSON, for programs that drive or watch this one (`--json`).

use antumbra_scene::LightKind;
use serde_json::{Value, json};

use crate::model::command;
use crate::model::pick::Item;
use crate::model::{Model, Side as Component};
use crate::ui::Seen;

/// The keys and what they do, printed once at the start.
pub(crate) fn keys() -> Value {
    let keys: Vec<Value> = command::GROUPS
        .iter()
        .flat_map(|group| group.bindings.iter().map(|b| json!([group.title, b.text(), b.help])))
        .collect();
    json!({ "keys": keys })
}

/// What pointer and keyboard were when the frame was made.
pub(crate) fn input(input: &egui::InputState) -> Value {
    let pointer = input.pointer.latest_pos().map(|at| (at * input.pixels_per_point).to_vec2());
    json!({
        "pointer": pointer.map(|at| [at.x, at.y]),
        "primary": input.pointer.primary_down(),
        "secondary": input.pointer.secondary_down(),
        "middle": input.pointer.middle_down(),
        "shift": input.modifiers.shift,
        "ctrl": input.modifiers.command,
        "focused": input.focused,
    })
}

/// The state of the program.
pub(crate) fn state(model: &Model, seen: &Seen, rect: [i32; 4], window: [u32; 2], scale: f32) -> Value {
    let scene = model.scene();
    let moment = scene.moment(model.clock.time);
    let lights: Vec<Value> = moment
        .lights
        .iter()
        .map(|light| {
            let direction = match light.kind {
                LightKind::Directional { direction }
                | LightKind::Spot { direction, .. }
                | LightKind::Disc { direction, .. }
                | LightKind::Rectangle { direction, .. } => Some(direction.to_array()),
                LightKind::Point | LightKind::Sphere { .. } => None,
            };
            json!({
                "name": light.name,
                "position": light.position.to_array(),
                "direction": direction,
                "intensity": light.intensity,
                "color": light.color.to_array(),
            })
        })
        .collect();
    let objects: Vec<Value> = scene
        .objects
        .iter()
        .enumerate()
        .map(|(i, object)| {
            let here =
                moment.primitives.iter().find(|p| p.object == i).map(|p| p.pose.translation.to_array());
            let shapes: Vec<&str> = object.parts.iter().map(|part| part.shape.type_name()).collect();
            json!({ "name": object.name, "position": here, "shapes": shapes })
        })
        .collect();
    let chosen = model.chosen.map(|item| match item {
        Item::Light(i) => json!({ "light": i }),
        Item::Object(i) => json!({ "object": i }),
    });
    let component = model.component.map(|side| match side {
        Component::Left => "left",
        Component::Right => "right",
    });
    let camera = scene.camera;
    let sides: Vec<Value> = seen
        .sides
        .iter()
        .take(model.settings.shown().len())
        .map(|side| {
            json!({
                "objection": side.objection,
                "stats": side.stats.map(|s| json!({
                    "pairs": s.pairs,
                    "drawn_pairs": s.drawn_pairs,
                    "polygons": s.polygons,
                    "tiles": s.tiles,
                    "touched_tiles": s.touched_tiles,
                })),
            })
        })
        .collect();
    let timing: Vec<Value> = model
        .timing
        .tracks()
        .iter()
        .filter_map(|track| {
            let [plain, shadows] = track.medians()?;
            let way = track.way.to_string();
            Some(
                json!({ "way": way, "plain_ms": plain, "shadows_ms": shadows, "frames": track.frames.len() }),
            )
        })
        .collect();
    json!({
        "scene": model.document.source().name(),
        "modified": model.document.is_modified(),
        "playing": model.clock.playing,
        "time": model.clock.time,
        "speed": model.clock.speed,
        "light": model.light,
        "component": component,
        "components": model.document.components().iter().map(|c| json!([c.light, c.offset.to_array()])).collect::<Vec<_>>(),
        "chosen": chosen,
        "lights": lights,
        "objects": objects,
        "camera": {
            "eye": camera.eye.to_array(),
            "target": camera.target.to_array(),
            "up": camera.up.to_array(),
            "fov_y": camera.fov_y,
        },
        "settings": serde_json::to_value(&model.settings).unwrap_or_default(),
        "sides": sides,
        "dialog": model.dialog.as_ref().map(|d| format!("{d:?}").to_lowercase()),
        "message": model.message.as_ref().map(|m| m.text.clone()),
        "picture": rect,
        "window": window,
        "scale": scale,
        "still": seen.still,
        "traced": seen.traced.map(|(samples, target, stale)| json!([samples, target, stale])),
        "error": seen.error,
        "lesson": {
            "lines": seen.lesson.strokes.len(),
            "facts": seen.lesson.facts.iter().map(|f| json!({ "title": f.title, "lines": f.lines })).collect::<Vec<_>>(),
            "notes": seen.lesson.notes,
            "map": seen.map.as_ref().map(|map| json!({ "caption": map.caption, "size": map.size })),
        },
        "timing": timing,
        "measuring": model.timing.measuring().map(|(way, ..)| way.to_string()),
        "controls": seen.controls,
    })
}
