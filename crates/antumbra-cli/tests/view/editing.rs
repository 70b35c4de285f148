//! Editing that is left half done: nothing that was written is lost, nothing that was only looked at changes.

use std::time::Duration;

use antumbra::glam::DVec3;
use serde_json::json;

use crate::controls::middle;
use crate::viewer::Desk;

const SCENE: &str = r#"
[camera]
eye = [0.0, 5.0, 9.0]
target = [0.0, 0.5, 0.0]

[[light]]
name = "spot"
type = "spot"
position = [-1.23456789, 4.0, 1.234e-5]
direction = [0.3, -1.0, -0.2]
inner_angle = 39.999
outer_angle = 40.0
intensity = 60.0

[[light]]
name = "point"
type = "point"
position = [2.0, 4.0, 0.0]
intensity = 20.0

[[object]]
name = "floor"
shape = { type = "plane" }

[[object]]
name = "ball"
shape = { type = "sphere", radius = 0.6 }
translation = [0.0, 1.0, 0.0]
"#;

#[test]
fn left_half_done() {
    let Some(desk) = Desk::new() else { return };
    desk.write("scene.toml", SCENE);
    let mut viewer = desk.view(&["scene.toml", "--fresh", "--size", "1000x900"]);
    let v = &mut viewer;
    // Looking at numbers, one after another, changes none of them.
    v.click("Button", "1  spot");
    v.wait("chosen", |state| state["chosen"] == json!({ "light": 0 }));
    v.click("SpinButton", "position x");
    for _ in 0..12 {
        v.press("Tab");
    }
    v.click("Button", "2  point");
    v.wait("the other", |state| state["chosen"] == json!({ "light": 1 }));
    assert_eq!(v.state["modified"], false, "nothing was written");
    assert_eq!(v.light(0), DVec3::new(-1.234_567_89, 4.0, 1.234e-5), "to the last digit");
    // What was written is taken when something else is chosen.
    v.click("SpinButton", "position y");
    v.press("Ctrl+A");
    v.write("5.5");
    v.click("Button", "1  spot");
    v.wait("the other", |state| state["chosen"] == json!({ "light": 0 }));
    v.wait("the number", |state| state["lights"][1]["position"][1] == 5.5);
    v.click("TextInput", "name");
    v.press("Ctrl+A");
    v.write("stage");
    v.click("Button", "ball");
    v.wait("the name", |state| state["lights"][0]["name"] == "stage");
    v.wait("the ball", |state| state["chosen"] == json!({ "object": 1 }));
    // What is no number is no change.
    let before = v.state["objects"].clone();
    v.enter("SpinButton", "position x", "nan");
    v.enter("SpinButton", "position y", "");
    v.press("Escape");
    // A state from after that.
    v.lines_within(Duration::from_millis(500));
    assert_eq!(v.state["objects"], before, "it is where it was");
}

#[test]
fn what_is_held_is_deleted() {
    let Some(desk) = Desk::new() else { return };
    desk.write("scene.toml", SCENE);
    let mut viewer = desk.view(&["scene.toml", "--fresh", "--size", "900x640"]);
    let v = &mut viewer;
    let ball = v.project(DVec3::Y);
    v.move_to(ball);
    v.button(1, true);
    for step in 1..=3 {
        v.move_to([ball[0] + 12.0 * f64::from(step), ball[1]]);
    }
    v.wait("held", |state| state["chosen"] == json!({ "object": 1 }));
    v.press_for("Delete", "gone", |state| state["objects"].as_array().map(Vec::len) == Some(1));
    let eye = v.vector("/camera/eye");
    for step in 1..=4 {
        v.move_to([ball[0] - 20.0 * f64::from(step), ball[1] + 10.0]);
    }
    v.button(1, false);
    assert_eq!(v.vector("/camera/eye"), eye, "the hand is empty until it lets go");
    v.press_for("Ctrl+Z", "back", |state| state["objects"].as_array().map(Vec::len) == Some(2));
    let control = v.control("Button", "ball", 0);
    v.click_at(middle(&control));
    v.wait("it can be chosen", |state| state["chosen"] == json!({ "object": 1 }));
}
