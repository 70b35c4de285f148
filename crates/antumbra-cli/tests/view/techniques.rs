//! Every way to draw shadows, chosen in the panel, and the reference that refines beside the interface.

use std::time::Duration;

use serde_json::{Value, json};

use crate::shadows;
use crate::viewer::{Desk, Viewer};

/// What the composite technique has no closed form for.
const BOX: &str = r#"
[camera]
eye = [0.0, 6.0, 9.0]
[[light]]
name = "lamp"
type = "point"
position = [-1.0, 5.0, 1.0]
intensity = 90.0
[[object]]
name = "floor"
shape = { type = "plane" }
[[object]]
name = "crate"
shape = { type = "box", size = [1, 1, 1] }
translation = [0.0, 1.2, 0.0]
"#;

/// Whether the reference has so many rays a pixel and shows what is there now.
fn traced(state: &Value, rays: u64) -> bool {
    state["traced"][0].as_u64() >= Some(rays) && state["traced"][2] == false
}

fn choose(v: &mut Viewer<'_>, label: &str, way: &str) {
    v.pick(&[("ComboBox", label), ("Button", way)]);
}

#[test]
fn each_draws_the_shadow() {
    let Some(desk) = Desk::new() else { return };
    desk.write("ball.toml", shadows::BALL);
    desk.write("box.toml", BOX);
    let mut viewer = desk.view(&["ball.toml", "--fresh", "--size", "760x480"]);
    let v = &mut viewer;
    v.without_marks();
    let (dark, _) = shadows::probes(v, shadows::MARGIN);
    for way in ["none", "composite", "projected", "volume", "map", "raytraced", "analytic"] {
        choose(v, "technique", way);
        v.wait(way, |state| state["settings"]["ways"][0] == way);
        if way == "raytraced" {
            v.wait("some rays", |state| traced(state, 8));
        }
        assert_eq!(
            v.state["sides"][0]["objection"],
            Value::Null,
            "{way} has nothing against a ball over a floor"
        );
        if way == "none" {
            v.see("no shadow", |_, now| match dark.iter().filter(|p| now.light(**p) < 200).count() {
                0 => Ok(()),
                n => Err(format!("{n} points are dark")),
            });
        } else {
            if way == "composite" {
                painted(v, &dark);
            }
            // The papers' ellipse of a ball is another one than the exact.
            shadows::see_about(v, if way == "composite" { 0.35 } else { shadows::MARGIN });
        }
    }
    options(v);
    comparison(v);
}

/// The papers' shade is one grey; the physical one is less light.
fn painted(v: &mut Viewer<'_>, dark: &[[f64; 2]]) {
    v.see("one grey", |_, now| {
        let mut seen: Vec<u32> = dark.iter().map(|p| now.light(*p)).collect();
        seen.sort_unstable();
        let (low, high) = (seen[seen.len() / 10], seen[seen.len() - 1 - seen.len() / 10]);
        if high - low < 30 { Ok(()) } else { Err(format!("{low} to {high}")) }
    });
    v.pick(&[("ComboBox", "shade"), ("Button", "physical")]);
    v.wait("the shade", |state| state["settings"]["ways"][0] == "composite:shade=physical");
}

/// Options of a technique, and how lights with an area are drawn.
fn options(v: &mut Viewer<'_>) {
    v.pick(&[("ComboBox", "quality"), ("Button", "exact")]);
    v.wait("an option", |state| state["settings"]["ways"][0] == "analytic:quality=exact");
    shadows::see(v);
    choose(v, "area lights", "samples");
    v.wait("samples", |state| state["settings"]["ways"][0] == "analytic:quality=exact+samples:16");
    choose(v, "area lights", "its own way");
    v.wait("none", |state| state["settings"]["ways"][0] == "analytic:quality=exact");
}

fn comparison(v: &mut Viewer<'_>) {
    v.click("Button", "Error map");
    choose(v, "against", "none");
    v.wait("an error", |state| {
        state["settings"]["ways"][1] == "none" && state["error"][1].as_f64() > Some(0.2)
    });
    let (dark, lit) = shadows::probes(v, shadows::MARGIN);
    let (dark, lit) = (dark[0], lit[0]);
    v.see("the error is where the shadow is", |_, now| {
        let (inside, outside) = (now.light(dark), now.light(lit));
        if inside > outside + 60 { Ok(()) } else { Err(format!("{inside} inside, {outside} outside")) }
    });
    choose(v, "against", "raytraced");
    v.wait("the closed form is near the reference", |state| {
        traced(state, 16) && state["error"][0].as_f64().is_some_and(|rms| rms < 0.02)
    });
    v.click("Button", "Single");
    v.wait("one picture", |state| {
        state["settings"]["layout"] == "single" && state["sides"].as_array().map(Vec::len) == Some(1)
    });
}

#[test]
fn objections_are_shown() {
    let Some(desk) = Desk::new() else { return };
    desk.write("box.toml", BOX);
    let mut viewer = desk.view(&["box.toml", "--fresh", "--size", "760x480", "--technique", "volume"]);
    let v = &mut viewer;
    let before = v.shot();
    choose(v, "technique", "composite");
    v.wait("it says what it cannot do", |state| {
        state["sides"][0]["objection"].as_str().is_some_and(|text| text.contains("crate"))
    });
    let [x, y, w, h] = v.picture().map(|x| x as usize);
    v.see("the picture is dimmed", |_, now| match now.difference(&before, [x, y, w, h]) {
        n if n > w * h / 2 => Ok(()),
        n => Err(format!("{n} pixels changed")),
    });
    choose(v, "technique", "projected");
    v.wait("another has nothing against it", |state| state["sides"][0]["objection"].is_null());
}

#[test]
fn the_reference_does_not_stop_the_interface() {
    let Some(desk) = Desk::new() else { return };
    let mut viewer = desk.view(&["--fresh", "--size", "1000x700", "--technique", "analytic"]);
    let v = &mut viewer;
    while v.state["scene"] != "furnished-room" {
        let before = v.state["scene"].clone();
        v.press_for("PageUp", "the scene before", |state| state["scene"] != before);
    }
    v.click("Button", "Split");
    v.wait("the first rays", |state| state["traced"][0].as_u64() > Some(0));
    assert_eq!(v.state["settings"]["ways"][1], "raytraced", "the reference is right");
    let mut samples = 0;
    for _ in 0..4 {
        let before = v.light(0);
        v.press("V");
        let wanted = json!((before + antumbra::glam::DVec3::Y * 0.1).to_array());
        v.wait_within(Duration::from_secs(2), "the light moves", |state| {
            (state["lights"][0]["position"][1].as_f64().unwrap_or(0.0) - wanted[1].as_f64().unwrap_or(1.0))
                .abs()
                < 1e-9
        });
        samples = samples.max(v.state["traced"][0].as_u64().unwrap_or(0));
    }
    assert!(samples > 0, "rays were traced while it moved");
    v.wait("rays of what is there now", |state| {
        state["traced"][2] == false && state["traced"][0].as_u64() > Some(1)
    });
    let first = v.number("/traced/0");
    v.wait("more rays", |state| state["traced"][0].as_f64() > Some(first));
}
