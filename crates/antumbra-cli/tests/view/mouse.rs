//! What the mouse does in the picture.

use antumbra::glam::{DVec2, DVec3};
use serde_json::json;

use crate::shadows;
use crate::viewer::{Desk, Viewer};

fn near(a: [f64; 2], b: [f64; 2], pixels: f64) -> bool {
    DVec2::from_array(a).distance(DVec2::from_array(b)) <= pixels
}

fn plus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

#[test]
fn looking() {
    let Some(desk) = Desk::new() else { return };
    desk.write("ball.toml", shadows::BALL);
    let mut viewer = desk.view(&["ball.toml", "--fresh", "--size", "900x600"]);
    let v = &mut viewer;
    v.without_marks();
    orbit(v);
    pan(v);
    zoom(v);
    v.press("Home");
    shadows::see(v);
    assert_eq!(v.state["modified"], false, "looking is not changing");
}

fn orbit(v: &mut Viewer<'_>) {
    let (eye, target) = (v.vector("/camera/eye"), v.vector("/camera/target"));
    let from = v.at(0.2, 0.8);
    v.drag(1, from, plus(from, [160.0, 0.0]));
    let turned = v.vector("/camera/eye");
    assert_eq!(v.vector("/camera/target"), target, "round the target");
    assert!(
        (turned.length() - eye.length()).abs() < 1e-9 && (turned.y - eye.y).abs() < 1e-9,
        "as far and as high: {turned}"
    );
    // The height of the picture is half a turn; what is dragged to the right turns to the right.
    let angle = std::f64::consts::PI * 160.0 / v.picture()[3];
    let wanted = antumbra::glam::DQuat::from_rotation_y(-angle) * eye;
    assert!(turned.distance(wanted) < 1e-3, "the eye is at {turned}, not at {wanted}");
    shadows::see(v);
    v.drag(1, from, plus(from, [0.0, 80.0]));
    let raised = v.vector("/camera/eye");
    assert!(raised.y > turned.y + 0.5 && (raised.length() - eye.length()).abs() < 1e-9, "up: {raised}");
    shadows::see(v);
    v.press_for("Home", "as the scene has it", |state| state["camera"]["eye"] == json!([0.0, 6.0, 9.0]));
}

fn pan(v: &mut Viewer<'_>) {
    for (button, modifier) in [(3, None), (2, None), (1, Some("Shift"))] {
        let (eye, target) = (v.vector("/camera/eye"), v.vector("/camera/target"));
        let seen = v.project(target);
        if let Some(modifier) = modifier {
            v.hold(modifier, true);
        }
        // Over the ball, which stays.
        let from = v.project(DVec3::new(0.0, 1.2, 0.0));
        v.drag(button, from, plus(from, [96.0, -48.0]));
        if let Some(modifier) = modifier {
            v.hold(modifier, false);
        }
        let now = v.project(target);
        assert!(near(now, plus(seen, [96.0, -48.0]), 1.0), "button {button}: {seen:?} went to {now:?}");
        let (moved, along) = (v.vector("/camera/eye") - eye, v.vector("/camera/target") - target);
        assert!(moved.distance(along) < 1e-9, "the direction stays");
        shadows::see(v);
        v.press_for("Home", "as the scene has it", |state| state["camera"]["eye"] == json!([0.0, 6.0, 9.0]));
    }
    assert_eq!(v.state["chosen"], json!(null), "nothing was chosen by it");
}

fn zoom(v: &mut Viewer<'_>) {
    let distance = |state: &serde_json::Value| {
        let x = |name: &str, i: usize| state["camera"][name][i].as_f64().unwrap_or(f64::NAN);
        DVec3::from_array([0, 1, 2].map(|i| x("eye", i) - x("target", i))).length()
    };
    let first = distance(&v.state);
    v.move_to(v.at(0.5, 0.5));
    v.wheel(2);
    v.wait("nearer", |state| distance(state) < 0.85 * first);
    v.still();
    let nearer = distance(&v.state);
    let direction = v.vector("/camera/eye").normalize();
    assert!(direction.distance(DVec3::new(0.0, 6.0, 9.0).normalize()) < 1e-9, "along the line of sight");
    v.wheel(-2);
    v.wait("farther", |state| (distance(state) - first).abs() < 0.01 * first);
    v.wheel(-1);
    v.wait("farther still", |state| distance(state) > 1.05 * first);
    assert!(nearer > 0.3 * first, "two clicks are no leap: {nearer} of {first}");
}

#[test]
fn choosing_and_moving() {
    let Some(desk) = Desk::new() else { return };
    desk.write("ball.toml", shadows::BALL);
    let mut viewer = desk.view(&["ball.toml", "--fresh", "--size", "900x600"]);
    let v = &mut viewer;
    let ball = |v: &Viewer<'_>| v.project(v.vector("/objects/1/position"));
    let lamp = |v: &Viewer<'_>| v.project(v.light(0));
    let plain = v.shot();
    v.click_at(ball(v));
    v.wait("the ball", |state| state["chosen"] == json!({ "object": 1 }));
    let [x, y] = ball(v).map(|x| x as usize);
    v.see("a box round what is chosen", |_, now| match now.difference(&plain, [x - 60, y - 60, 120, 120]) {
        0..50 => Err("as before".into()),
        _ => Ok(()),
    });
    v.click_at(lamp(v));
    v.wait("the light", |state| state["chosen"] == json!({ "light": 0 }));
    v.click_at(v.at(0.1, 0.9));
    v.wait("the floor", |state| state["chosen"] == json!({ "object": 0 }));
    v.press_for("Escape", "nothing", |state| state["chosen"].is_null());

    v.without_marks();
    let first = (v.light(0), v.vector("/objects/1/position"));
    level(v, "/lights/0/position", [70.0, 30.0]);
    level(v, "/objects/1/position", [-80.0, 20.0]);
    upright(v, "/lights/0/position", -40.0);
    upright(v, "/objects/1/position", -30.0);
    assert_eq!(v.state["modified"], true, "things were moved");
    for _ in 0..3 {
        v.press("Ctrl+Z");
    }
    v.wait("three drags undone", |state| state["objects"][1]["position"] == json!(first.1.to_array()));
    assert_ne!(v.light(0), first.0, "the first is not yet");
    v.press_for("Ctrl+Z", "all undone", |state| state["modified"] == false);
    assert_eq!(v.light(0), first.0, "each drag was one step");
    shadows::see(v);
}

/// Drags a thing level: it stays under the pointer and at its height.
fn level(v: &mut Viewer<'_>, pointer: &str, by: [f64; 2]) {
    let before = v.vector(pointer);
    let from = v.project(before);
    v.drag(1, from, plus(from, by));
    let after = v.vector(pointer);
    assert!(
        after.y == before.y && after.distance(before) > 0.3,
        "{pointer} went level from {before} to {after}"
    );
    // The point of the ball that is held is on its surface: nearer, so that its centre moves a little farther.
    let seen = v.project(after);
    assert!(near(seen, plus(from, by), 8.0), "{pointer} stays under the pointer: it is at {seen:?}");
    shadows::see(v);
}

/// Drags a thing with Ctrl: up and down alone.
fn upright(v: &mut Viewer<'_>, pointer: &str, by: f64) {
    let before = v.vector(pointer);
    let from = v.project(before);
    v.hold("Ctrl", true);
    v.drag(1, from, plus(from, [0.0, by]));
    v.hold("Ctrl", false);
    let after = v.vector(pointer);
    assert!(
        after.x == before.x && after.z == before.z,
        "{pointer} keeps its place on the floor: {before} to {after}"
    );
    assert!((after.y - before.y) * by < -1.0, "{pointer} goes up with the pointer: {before} to {after}");
    shadows::see(v);
}

#[test]
fn the_divider() {
    let Some(desk) = Desk::new() else { return };
    desk.write("ball.toml", shadows::BALL);
    let mut viewer = desk.view(&["ball.toml", "--fresh", "--size", "900x600"]);
    let v = &mut viewer;
    v.without_marks();
    v.click("Button", "Split");
    v.pick(&[("ComboBox", "right"), ("Button", "none")]);
    v.wait("shadows left, none right", |state| state["settings"]["ways"] == json!(["analytic", "none"]));
    assert_eq!(v.number("/settings/divider"), 0.5, "in the middle at first");
    let (dark, _) = shadows::probes(v, shadows::MARGIN);
    let mut from = v.at(0.5, 0.3);
    for part in [0.9, 0.15] {
        let to = v.at(part, 0.3);
        v.drag(1, from, to);
        v.wait("the divider", |state| {
            (state["settings"]["divider"].as_f64().unwrap_or(0.0) - part).abs() < 0.005
        });
        v.see("shadows left of the divider alone", |_, now| {
            let lit = dark.iter().filter(|p| now.light(**p) > 250).count();
            match (lit, part > 0.5) {
                (0, true) => Ok(()),
                (n, false) if n == dark.len() => Ok(()),
                _ => Err(format!("{lit} of {} are lit with the divider at {part}", dark.len())),
            }
        });
        from = to;
    }
    let camera = v.state["camera"].clone();
    assert_eq!(camera["eye"], json!([0.0, 6.0, 9.0]), "the camera stays");
}
