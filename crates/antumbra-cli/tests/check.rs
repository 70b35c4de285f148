//! `antumbra check`.

mod common;

use common::{Place, SCENE, assert_refused, assert_success, json, stderr, stdout};

#[test]
fn a_summary() {
    let place = Place::new();
    let output = place.run(["check", "scene.toml"]);
    assert_success(&output);
    let text = stdout(&output);
    for part in ["scene.toml: right", "48x32", "1 point, 1 directional", "2 objects", "1 rectangle, 1 sphere"]
    {
        assert!(text.contains(part), "`{part}` is in: {text}");
    }
    let techniques = text.lines().find(|line| line.starts_with("  techniques")).unwrap_or_default();
    assert!(
        techniques.contains("analytic") && techniques.ends_with(", raytraced"),
        "these can do it: {text}"
    );
}

#[test]
fn a_summary_in_json() {
    let place = Place::new();
    let torus = "shape = { type = \"torus\", major_radius = 0.7, minor_radius = 0.2 }";
    place.write("torus.toml", &SCENE.replace("shape = { type = \"sphere\", radius = 0.7 }", torus));
    let output = place.run(["check", "--json", "scene.toml", "torus.toml"]);
    assert_success(&output);
    let report = json(&output);
    let first = &report["scenes"][0];
    assert_eq!((&first["scene"], &first["valid"]), (&"scene.toml".into(), &true.into()), "the first file");
    assert_eq!(first["lights"][1]["kind"], "directional", "the second kind of light");
    assert_eq!(first["lights"][1]["count"], 1, "one of it");
    let able = |scene: &serde_json::Value, name: &str| {
        scene["techniques"].as_array().is_some_and(|names| names.iter().any(|able| able == name))
    };
    assert!(able(first, "analytic") && able(first, "raytraced"), "these can: {first}");
    let second = &report["scenes"][1];
    assert!(
        !able(second, "analytic") && able(second, "raytraced"),
        "a torus has no closed form here: {second}"
    );
    assert!(
        second["limits"][0].as_str().is_some_and(|why| why.contains("ball")),
        "names the object: {second}"
    );
}

#[test]
fn some_right_and_some_wrong() {
    let place = Place::new();
    place.write("a.toml", "ambient = 3");
    place.write("b.toml", "lights = 3");
    let one = place.run(["check", "scene.toml", "a.toml"]);
    assert_eq!(one.status.code(), Some(2), "one is wrong");
    assert!(stdout(&one).contains("scene.toml: right"), "the right one is told of: {}", stdout(&one));
    assert!(stderr(&one).starts_with("error: a.toml:1:"), "the wrong one is the error: {}", stderr(&one));
    assert_eq!(stderr(&one).lines().count(), 1, "one line");

    let two = place.run(["check", "a.toml", "scene.toml", "b.toml"]);
    assert_eq!(two.status.code(), Some(2), "two are wrong");
    assert!(
        stderr(&two).starts_with("error: 2 of 3 scenes are wrong, the first: a.toml:1:"),
        "{}",
        stderr(&two)
    );
    assert_eq!(stderr(&two).lines().count(), 1, "one line");
    let text = stdout(&two);
    assert!(
        text.contains("wrong: a.toml:1:") && text.contains("wrong: b.toml:1:"),
        "both are told of: {text}"
    );

    let machine = place.run(["check", "--json", "a.toml", "scene.toml"]);
    assert_eq!(machine.status.code(), Some(2), "one is wrong");
    let report = json(&machine);
    assert_eq!(report["scenes"][0]["valid"], false, "the first is wrong");
    assert_eq!(report["scenes"][1]["valid"], true, "the second is right");
    assert_refused(&place.run(["check", "nowhere.toml"]), "nowhere.toml");
}
