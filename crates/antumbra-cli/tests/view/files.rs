//! Saving, and what is remembered from one start to the next.

use std::fs;

use antumbra::glam::DVec3;
use antumbra_scene::Scene;
use serde_json::json;

use crate::viewer::Desk;

#[test]
fn what_is_saved_is_what_was_loaded() {
    let Some(desk) = Desk::new() else { return };
    let path = desk.write("scene.toml", &crate::scene());
    let load = || Scene::load(&path).expect("a scene");
    let first = load();
    let mut viewer = desk.view(&["scene.toml", "--fresh", "--size", "640x480"]);
    let v = &mut viewer;
    let saved = |state: &serde_json::Value| {
        state["modified"] == false && state["message"].as_str().is_some_and(|text| text.starts_with("saved"))
    };
    v.press_for("Ctrl+S", "saved", saved);
    assert_eq!(load(), first, "nothing was changed");
    assert_eq!(fs::read_to_string(&path).expect("it is there"), crate::scene(), "not a letter");

    assert_eq!(desk.screen.title(v.window), "scene.toml – antumbra", "the title");
    v.press("N");
    v.press_for("N", "the light moves", |state| {
        (state["lights"][0]["position"][0].as_f64().unwrap_or(0.0) + 1.3).abs() < 1e-9
    });
    assert_eq!(desk.screen.title(v.window), "scene.toml* – antumbra", "changed");
    assert_eq!(load(), first, "not before it is saved");
    v.press_for("Ctrl+S", "saved", saved);
    let mut wanted = first.clone();
    wanted.lights[0].position = v.light(0);
    assert_eq!(load(), wanted, "what is seen is what is saved");
    let text = fs::read_to_string(&path).expect("it is there");
    for comment in ["# the one that moves", "# What shadows fall on."] {
        assert!(text.contains(comment), "{comment} survives: {text}");
    }
    while v.state["lights"][0]["position"][0] != -1.5 {
        let before = v.state["lights"][0].clone();
        v.press_for("Ctrl+Z", "a step back", |state| state["lights"][0] != before);
    }
    v.press_for("Ctrl+S", "saved", saved);
    assert_eq!(load(), first, "as it was");
    // Closing the window of a scene with changes asks.
    v.press_for("V", "changed", |state| state["modified"] == true);
    desk.screen.close(v.window);
    v.wait("a question", |state| state["dialog"].as_str().is_some_and(|text| text.starts_with("unsaved")));
    v.press_for("Escape", "none", |state| state["dialog"].is_null());
    v.press_for("Ctrl+Z", "not changed", |state| state["modified"] == false);
    desk.screen.close(v.window);
    assert!(v.wait_for_end().success(), "it ends well");
    assert_eq!(load(), first, "nothing was saved unasked");
}

#[test]
fn what_was_looked_at_is_remembered() {
    let Some(desk) = Desk::new() else { return };
    let mut viewer = desk.view(&["--size", "700x500"]);
    let v = &mut viewer;
    let default = v.state["settings"].clone();
    let first = v.state["scene"].clone();
    v.press_for("PageUp", "the scene before", |state| state["scene"] != first);
    let scene = v.state["scene"].clone();
    for _ in 0..3 {
        v.press("X");
    }
    v.press("E");
    v.press("]");
    v.press_for("F9", "no panel", |state| state["settings"]["panel"] == false);
    let eye = v.vector("/camera/eye");
    v.press("+");
    v.wait("faster", |state| state["speed"] == 2.0);
    let settings = v.state["settings"].clone();
    assert!(
        settings["layout"] == "split" && settings["ways"][0] != default["ways"][0],
        "they changed: {settings}"
    );
    v.press("Ctrl+Q");
    assert!(v.wait_for_end().success(), "it ends well");
    drop(viewer);

    let mut viewer = desk.view(&[]);
    let v = &mut viewer;
    assert_eq!(v.state["scene"], scene, "the scene");
    assert_eq!(v.state["settings"], settings, "the settings");
    assert_eq!((v.vector("/camera/eye"), v.number("/speed")), (eye, 2.0), "the camera and the clock");
    assert_eq!(v.state["window"], json!([700, 500]), "the window's size");
    v.pick(&[("Button", "View"), ("Button", "Reset settings")]);
    v.wait("the settings of the first start", |state| state["settings"] == default && state["speed"] == 1.0);
    v.press("Ctrl+Q");
    v.wait_for_end();
    drop(viewer);

    let mut viewer = desk.view(&["--fresh"]);
    let v = &mut viewer;
    assert_eq!(v.state["scene"], first, "--fresh begins at the beginning");
    assert_eq!(v.state["settings"], default, "with the settings of the first start");
    v.press("Ctrl+Q");
    v.wait_for_end();
    drop(viewer);

    // What makes no sense does not keep it from starting.
    fs::write(desk.file("config/antumbra/viewer.json"), "{ \"settings\": [1, 2").expect("it is there");
    let viewer = desk.view(&[]);
    assert_eq!(viewer.state["settings"], default, "nonsense is forgotten");
    assert!(viewer.vector("/camera/eye").distance(DVec3::ZERO) > 1.0, "and it looks at something");
}
