//! The questions that the program asks: which file, and what becomes of changes.

use std::fs;

use antumbra_scene::Scene;

use crate::shadows;
use crate::viewer::{Desk, Viewer};

/// Whether a dialog of this kind is open.
fn asks(state: &serde_json::Value, kind: &str) -> bool {
    state["dialog"].as_str().is_some_and(|text| text.starts_with(kind))
}

/// Writes a path into the dialog that is open and presses Enter.
fn path(v: &mut Viewer<'_>, path: &std::path::Path) {
    v.control("TextInput", "Path", 0);
    v.enter("TextInput", "Path", path.to_str().expect("UTF-8"));
}

#[test]
fn files() {
    let Some(desk) = Desk::new() else { return };
    let ball = desk.write("ball.toml", shadows::BALL);
    desk.write("scene.toml", &crate::scene());
    let mut viewer = desk.view(&["scene.toml", "--fresh", "--size", "900x640"]);
    let v = &mut viewer;
    v.press_for("Ctrl+O", "a question", |state| asks(state, "open"));
    let shapes = v.state["objects"].clone();
    path(v, &desk.file("nothing.toml"));
    v.press_for("Escape", "none", |state| state["dialog"].is_null());
    assert_eq!(v.state["objects"], shapes, "what is written are no commands");
    assert_eq!(v.state["scene"], "scene.toml", "a file that is not there is not shown");
    v.press_for("Ctrl+O", "a question", |state| asks(state, "open"));
    path(v, &ball);
    v.wait("the other scene", |state| state["scene"] == "ball.toml" && state["dialog"].is_null());
    v.without_marks();
    shadows::see(v);

    v.press("N");
    let copy = desk.file("copy.toml");
    v.press_for("Ctrl+Shift+S", "a question", |state| asks(state, "saveas"));
    path(v, &copy);
    v.wait("saved", |state| state["scene"] == "copy.toml" && state["modified"] == false);
    let load = || Scene::load(&copy).expect("a scene");
    assert_eq!(load().lights[0].position, v.light(0), "with the light that was moved");
    assert_eq!(fs::read_to_string(&ball).expect("it is there"), shadows::BALL, "the first file stays");

    let saved = load();
    v.press_for("N", "changed", |state| state["modified"] == true);
    v.press_for("Ctrl+Shift+S", "a question", |state| asks(state, "saveas"));
    path(v, &ball);
    v.click("Button", "Keep it");
    v.press_for("Escape", "none", |state| state["dialog"].is_null());
    assert_eq!(fs::read_to_string(&ball).expect("it is there"), shadows::BALL, "it was kept");
    v.press_for("Ctrl+Shift+S", "a question", |state| asks(state, "saveas"));
    path(v, &ball);
    v.click("Button", "Replace");
    v.wait("saved", |state| state["scene"] == "ball.toml" && state["modified"] == false);
    let replaced = Scene::load(&ball).expect("a scene");
    assert_eq!(replaced.lights[0].position, v.light(0), "it was replaced");
    assert_eq!(load(), saved, "and no other");
}

#[test]
fn changes() {
    let Some(desk) = Desk::new() else { return };
    let ball = desk.write("ball.toml", shadows::BALL);
    let mut viewer = desk.view(&["ball.toml", "--fresh", "--size", "900x640"]);
    let v = &mut viewer;
    v.press_for("N", "changed", |state| state["modified"] == true);
    v.press_for("PageDown", "a question", |state| asks(state, "unsaved"));
    v.click("Button", "Cancel");
    v.wait("as before", |state| state["dialog"].is_null() && state["scene"] == "ball.toml");
    v.press_for("PageDown", "a question", |state| asks(state, "unsaved"));
    v.click("Button", "Don't save");
    v.wait("of the gallery", |state| state["scene"] == "primitives-light-above");
    assert_eq!(fs::read_to_string(&ball).expect("it is there"), shadows::BALL, "nothing was saved");

    v.press_for("Ctrl+O", "a question", |state| asks(state, "open"));
    path(v, &ball);
    v.wait("the file", |state| state["scene"] == "ball.toml");
    v.press_for("N", "changed", |state| state["modified"] == true);
    let wanted = v.light(0);
    v.press_for("Ctrl+Q", "a question", |state| asks(state, "unsaved"));
    v.click("Button", "Save");
    assert!(v.wait_for_end().success(), "it ends well");
    let saved = Scene::load(&ball).expect("a scene");
    assert_eq!(saved.lights[0].position, wanted, "it was saved before");
}
