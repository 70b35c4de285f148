//! The controls of panel and menus, by their names.

use serde_json::{Value, json};

use crate::shadows;
use crate::viewer::{Desk, Viewer};

const FIELD: &str = "SpinButton";

fn count(state: &Value, what: &str) -> usize {
    state[what].as_array().map_or(0, Vec::len)
}

/// Writes a number into a field, and waits until the state has it at a place.
fn set(v: &mut Viewer<'_>, label: &str, text: &str, pointer: &str) {
    v.enter(FIELD, label, text);
    let wanted: f64 = text.parse().expect("a number");
    v.wait(&format!("{label} is {text}"), |state| {
        state.pointer(pointer).and_then(Value::as_f64).is_some_and(|x| (x - wanted).abs() < 1e-6)
    });
}

/// Ticks a box, and waits until the state says so.
fn tick(v: &mut Viewer<'_>, label: &str, pointer: &str, on: bool) {
    v.click("CheckBox", label);
    v.wait(&format!("{label} is {on}"), |state| state.pointer(pointer) == Some(&json!(on)));
}

/// How much of the picture is another than before.
fn differs(v: &mut Viewer<'_>, what: &str, before: &crate::screen::Shot, least: usize) {
    let [x, y, w, h] = v.picture().map(|x| x as usize);
    v.see(what, |_, now| match now.difference(before, [x, y, w, h]) {
        n if n >= least => Ok(()),
        n => Err(format!("{n} pixels are others")),
    });
}

#[test]
fn lights_and_objects() {
    let Some(desk) = Desk::new() else { return };
    desk.write("ball.toml", shadows::BALL);
    let mut viewer = desk.view(&["ball.toml", "--fresh", "--size", "1000x900"]);
    let v = &mut viewer;
    v.without_marks();
    lights(v);
    objects(v);
    for _ in 0..60 {
        v.press("Ctrl+Z");
    }
    v.wait("as it was", |state| state["modified"] == false && count(state, "objects") == 2);
    shadows::see(v);
}

fn lights(v: &mut Viewer<'_>) {
    v.click("Button", "1  lamp");
    v.wait("chosen", |state| state["chosen"] == json!({ "light": 0 }));
    set(v, "position x", "-1.4", "/lights/0/position/0");
    set(v, "position y", "3.8", "/lights/0/position/1");
    set(v, "position z", "0.25", "/lights/0/position/2");
    shadows::see(v);
    let before = v.shot();
    set(v, "intensity", "12", "/lights/0/intensity");
    differs(v, "less light", &before, 10_000);
    set(v, "intensity", "30", "/lights/0/intensity");
    v.enter("TextInput", "name", "sun");
    v.wait("its name", |state| state["lights"][0]["name"] == "sun");
    for kind in ["spot", "disc", "rectangle", "sphere", "directional", "point"] {
        v.pick(&[("ComboBox", "type"), ("Button", kind)]);
        let fields: &[&str] = match kind {
            "spot" => &["inner angle", "outer angle", "direction x", "direction y", "direction z"],
            "disc" => &["radius", "direction x"],
            "rectangle" => &["width", "height", "right x"],
            "sphere" => &["radius"],
            "directional" => &["direction y"],
            _ => &["position x"],
        };
        for field in fields {
            v.control(FIELD, field, 0);
        }
    }
    v.click("CheckBox", "moves");
    v.control("ComboBox", "motion", 0);
    set(v, "period", "3", "/period");
}

fn objects(v: &mut Viewer<'_>) {
    v.click("Button", "ball");
    v.wait("chosen", |state| state["chosen"] == json!({ "object": 1 }));
}
