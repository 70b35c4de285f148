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
    // Some more times than there were steps.
    for _ in 0..120 {
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
    for (label, text) in [("period", "3"), ("center y", "3"), ("axis x", "0.5")] {
        write(v, label, text);
    }
    let rest = v.light(0);
    v.press_for("Space", "it moves", |state| state["time"].as_f64() > Some(0.3));
    v.press_for("Space", "it stands", |state| state["playing"] == false);
    assert!(v.light(0).distance(rest) > 0.01, "it was moved from {rest}");
    v.press_for("R", "the start", |state| state["time"] == 0.0);
    v.pick(&[("ComboBox", "motion"), ("Button", "path")]);
    v.click("Button", "add a point");
    write(v, "point 3 z", "2");
    v.click("Button", "remove point 2");
    gone(v, "point 3 z");
    v.click("CheckBox", "moves");
    gone(v, "motion");
    v.click("ColorWell", "color");
    v.press("Escape");

    for (i, kind) in (1..).zip(["point", "sphere", "disc", "rectangle", "spot", "directional"]) {
        v.pick(&[("Button", "Add light"), ("Button", kind)]);
        v.wait("one more", |state| {
            count(state, "lights") == i + 1 && state["chosen"] == json!({ "light": i })
        });
    }
    for i in (1..=6).rev() {
        v.click("Button", "Remove light");
        v.wait("one less", |state| count(state, "lights") == i);
        v.press(&i.to_string());
        v.wait("chosen", |state| state["chosen"] == json!({ "light": i - 1 }));
    }
}

/// Writes a number into a field that the state says nothing of, and waits until the field has it.
fn write(v: &mut Viewer<'_>, label: &str, text: &str) {
    v.enter(FIELD, label, text);
    v.wait(&format!("{label} is {text}"), |state| {
        let mut all = state["controls"].as_array().map(Vec::as_slice).unwrap_or_default().iter();
        all.any(|c| {
            c["label"] == label
                && c["role"] == FIELD
                && c["value"].as_str().is_some_and(|x| x.starts_with(text))
        })
    });
}

/// Waits until there is no control of a name.
fn gone(v: &mut Viewer<'_>, label: &str) {
    v.wait(&format!("no {label}"), |state| {
        state["controls"].as_array().is_some_and(|all| all.iter().all(|c| c["label"] != label))
    });
}

fn objects(v: &mut Viewer<'_>) {
    v.click("Button", "ball");
    v.wait("chosen", |state| state["chosen"] == json!({ "object": 1 }));
    set(v, "position x", "-0.2", "/objects/1/position/0");
    set(v, "position y", "1.1", "/objects/1/position/1");
    set(v, "position z", "0.3", "/objects/1/position/2");
    shadows::see(v);
    let before = v.shot();
    write(v, "radius", "0.9");
    differs(v, "a larger ball", &before, 500);
    write(v, "radius", "0.5");
    shadows::see(v);
    for about in ["rotation about y", "rotation about x", "rotation about z"] {
        write(v, about, "15");
    }
    shadows::see(v);
    let before = v.shot();
    v.click("CheckBox", "casts shadow");
    differs(v, "no shadow", &before, 500);
    v.click("CheckBox", "casts shadow");
    shadows::see(v);
    v.click("Button", "floor");
    v.wait("chosen", |state| state["chosen"] == json!({ "object": 0 }));
    v.click("CheckBox", "receives shadow");
    differs(v, "no shadow on the floor", &before, 500);
    v.click("CheckBox", "receives shadow");
    shadows::see(v);
    v.enter("TextInput", "name", "ground");
    v.wait("its name", |state| state["objects"][0]["name"] == "ground");

    let shapes = [
        ("plane", ""),
        ("rectangle", "depth"),
        ("disc", "radius"),
        ("triangle", "corner 2 x"),
        ("sphere", "radius"),
        ("ellipsoid", "radii y"),
        ("cone", "height"),
        ("cylinder", "radius top"),
        ("capsule", "height"),
        ("box", "size z"),
        ("torus", "tube"),
    ];
    for (i, (kind, field)) in (2..).zip(shapes) {
        v.pick(&[("Button", "Add object"), ("Button", kind)]);
        v.wait("one more", |state| {
            count(state, "objects") == i + 1 && state["objects"][i]["shapes"] == json!([kind])
        });
        if !field.is_empty() {
            write(v, field, "0.25");
        }
    }
    v.click("Button", "Remove object");
    v.wait("one less", |state| count(state, "objects") == 12);
}

#[test]
fn teaching_and_settings() {
    let Some(desk) = Desk::new() else { return };
    desk.write("ball.toml", shadows::BALL);
    let mut viewer = desk.view(&["ball.toml", "--fresh", "--size", "1000x900"]);
    let v = &mut viewer;
    v.without_marks();
    let plain = v.shot();
    for (label, name) in [
        ("outlines", "outlines"),
        ("tangent rays", "rays"),
        ("shadow volumes", "volumes"),
        ("map from the light", "map"),
    ] {
        let pointer = format!("/settings/teaching/{name}");
        tick(v, label, &pointer, true);
        differs(v, label, &plain, 30);
        tick(v, label, &pointer, false);
        let [x, y, w, h] = v.picture().map(|x| x as usize);
        v.see("as before", |_, now| match now.difference(&plain, [x, y, w, h]) {
            0 => Ok(()),
            n => Err(format!("{n} pixels are others")),
        });
    }
    tick(v, "conics", "/settings/teaching/conics", true);
    v.wait("an ellipse and its numbers", |state| {
        state["lesson"]["facts"].to_string().to_lowercase().contains("ellipse")
    });
    tick(v, "conics", "/settings/teaching/conics", false);
    tick(v, "of the chosen light alone", "/settings/teaching/chosen_light", false);

    v.click("DisclosureTriangle", "Teaching");
    gone(v, "outlines");
    v.click("DisclosureTriangle", "Settings");
    tick(v, "marks", "/settings/marks", true);
    differs(v, "marks", &plain, 30);
    tick(v, "wait for the screen (vsync)", "/settings/vsync", false);
    v.pick(&[("ComboBox", "antialiasing"), ("Button", "4")]);
    v.wait("samples", |state| state["settings"]["antialiasing"] == 4);
    v.enter(FIELD, "size of the interface", "1.25");
    v.wait("a larger interface", |state| state["scale"] == 1.25);
    v.click("Button", "Reset settings");
    v.wait("all as at first", |state| {
        let settings = &state["settings"];
        state["scale"] == 1.0 && settings["vsync"] == true && settings["antialiasing"] == "auto"
    });
}

#[test]
fn menus() {
    let Some(desk) = Desk::new() else { return };
    desk.write("ball.toml", shadows::BALL);
    let mut viewer = desk.view(&["ball.toml", "--fresh", "--size", "900x600"]);
    let v = &mut viewer;
    let item = |state: &Value, menu: &str| {
        let all = state["controls"].as_array().map(Vec::as_slice).unwrap_or_default();
        let found = all.iter().filter_map(|c| c["label"].as_str()).find(|label| label.starts_with(menu));
        found.map(str::to_owned)
    };
    // The names of entries end with their keys.
    let pick = |v: &mut Viewer<'_>, menu: &str, entry: &str| {
        v.click("Button", menu);
        v.wait(&format!("{menu}, {entry}"), |state| item(state, entry).is_some());
        let label = item(&v.state, entry).unwrap_or_default();
        v.click("Button", &label);
    };
    v.press_for("1", "a light", |state| state["chosen"] == json!({ "light": 0 }));
    pick(v, "Edit", "Duplicate");
    v.wait("two lights", |state| count(state, "lights") == 2);
    pick(v, "Edit", "Undo");
    v.wait("one light", |state| count(state, "lights") == 1);
    pick(v, "Edit", "Redo");
    v.wait("two lights", |state| count(state, "lights") == 2);
    v.press_for("2", "the new one", |state| state["chosen"] == json!({ "light": 1 }));
    pick(v, "Edit", "Delete");
    v.wait("one light", |state| count(state, "lights") == 1);
    pick(v, "File", "Save picture");
    v.wait("a picture", |state| {
        state["message"].as_str().is_some_and(|text| text.contains("antumbra-001.png"))
    });
    assert!(desk.file("antumbra-001.png").exists(), "it was written");
    pick(v, "File", "Save as");
    v.wait("a question", |state| state["dialog"].as_str().is_some_and(|text| text.starts_with("saveas")));
    v.press_for("Escape", "none", |state| state["dialog"].is_null());
    let own = v.state["camera"].clone();
    pick(v, "View", "Everything in view");
    v.wait("another camera", |state| state["camera"] != own);
    pick(v, "View", "Camera of the scene");
    v.wait("the camera of the file", |state| state["camera"] == own);
    pick(v, "View", "Frame times");
    v.wait("a plot", |state| state["settings"]["timing"] == true);
    pick(v, "View", "Panel");
    v.wait("no panel", |state| state["settings"]["panel"] == false);
    pick(v, "View", "Whole screen");
    v.wait("the whole screen", |state| state["fullscreen"] == true);
    pick(v, "View", "Reset settings");
    v.wait("as at first", |state| state["settings"]["panel"] == true && state["settings"]["timing"] == false);
    v.click("Button", "Help");
    v.wait("the help", |state| state["dialog"] == "help");
    v.press_for("Escape", "none", |state| state["dialog"].is_null());
    v.click("Button", "Play");
    v.wait("it plays", |state| state["playing"] == true);
    v.click("Button", "Pause");
    v.wait("it stands", |state| state["playing"] == false);
    set(v, "time", "2.5", "/time");
    set(v, "speed", "-3", "/speed");
    v.click("Button", "Rewind");
    v.wait("the start", |state| state["time"] == 0.0);
    pick(v, "File", "Save");
    v.wait("saved", |state| state["modified"] == false);
    v.click("Button", "File");
    v.pick(&[("Button", "Gallery"), ("Button", "staircase")]);
    v.wait("of the gallery", |state| state["scene"] == "staircase");
    pick(v, "File", "Quit");
    assert!(v.wait_for_end().success(), "it ends well");
}
