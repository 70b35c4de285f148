//! Every key of the program's own table, and what it changes.

use antumbra::glam::DVec3;
use serde_json::{Value, json};

use crate::screen::Screen;
use crate::viewer::{Desk, Viewer};

/// Metres that a key moves things by.
const STEP: f64 = 0.1;

/// One run of the program in which every key is pressed. A key that is in the program's table and not here fails the
/// test.
#[test]
fn every_key() {
    let Some(desk) = Desk::new() else { return };
    let path = desk.write("scene.toml", &crate::scene());
    let mut viewer = desk.view(&["scene.toml", "--fresh", "--size", "800x560"]);
    let v = &mut viewer;
    camera(v);
    light(v);
    objects(v);
    time(v);
    window(v, &desk.screen);
    comparison(v);
    components(v);
    scene(v);
    picture(v, &desk);
    assert!(path.exists(), "the file is still there");
    let keys = v.keys.as_array().expect("a list").clone();
    assert!(keys.len() > 50, "the program has its keys: {keys:?}");
    v.press("Ctrl+Q");
    assert!(v.wait_for_end().success(), "it ends well");
    let name = |key: &Value| key[1].as_str().unwrap_or_default().to_owned();
    let forgotten: Vec<String> = keys.iter().map(name).filter(|key| !v.pressed.contains(key)).collect();
    assert_eq!(forgotten, Vec::<String>::new(), "keys that no test presses");
}

/// Presses a key that moves a point of the state by a step, and checks that the picture changes.
fn moves(v: &mut Viewer<'_>, key: &str, pointer: &str, by: DVec3) {
    let before = (v.vector(pointer), v.shot());
    let wanted = before.0 + by * STEP;
    let near = |state: &Value| {
        let x = |i: usize| state.pointer(pointer).and_then(|p| p[i].as_f64()).unwrap_or(f64::NAN);
        (DVec3::new(x(0), x(1), x(2)) - wanted).length() < 1e-9
    };
    v.press_for(key, &format!("{pointer} by {by}"), near);
    let [x, y, w, h] = v.picture().map(|x| x as usize);
    v.see(&format!("{key} moves {pointer}"), |_, now| match now.difference(&before.1, [x, y, w, h]) {
        0..50 => Err("the same as before".into()),
        _ => Ok(()),
    });
}

fn camera(v: &mut Viewer<'_>) {
    let first = v.state["camera"].clone();
    let axes = [
        ("Y", DVec3::Y),
        ("A", -DVec3::Y),
        ("X", DVec3::X),
        ("S", -DVec3::X),
        ("C", DVec3::Z),
        ("D", -DVec3::Z),
    ];
    for (key, by) in axes {
        let target = v.vector("/camera/target");
        moves(v, key, "/camera/eye", by);
        assert_eq!(v.vector("/camera/target"), target, "{key} moves the eye alone");
    }
    v.press("X");
    let changed = |state: &Value| state["camera"] != first;
    v.wait("another camera", changed);
    v.press_for("F", "another camera", |state| {
        (state["camera"]["target"][1].as_f64().unwrap_or(0.0) - 1.0).abs() < 1e-6
    });
    let [left, top, w, h] = v.picture();
    for point in [DVec3::Y * 0.4, DVec3::Y * 1.6, DVec3::new(0.6, 1.0, 0.0), DVec3::new(-0.6, 1.0, 0.0)] {
        let [x, y] = v.project(point);
        assert!(
            x > left && x < left + w && y > top && y < top + h,
            "F brings {point} into view, it is at {x}, {y}"
        );
    }
    v.press_for("Home", "the camera of the file", |state| state["camera"] == first);
    assert_eq!(v.state["modified"], false, "looking is not changing");
}

fn light(v: &mut Viewer<'_>) {
    let axes = [
        ("V", DVec3::Y),
        ("B", -DVec3::Y),
        ("N", DVec3::X),
        ("M", -DVec3::X),
        (",", DVec3::Z),
        (".", -DVec3::Z),
    ];
    for (key, by) in axes {
        moves(v, key, "/lights/0/position", by);
    }
    v.press_for("H", "the second light", |state| {
        state["light"] == 1 && state["chosen"] == json!({ "light": 1 })
    });
    moves(v, "V", "/lights/1/position", DVec3::Y);
    v.press_for("G", "the first light", |state| state["light"] == 0);
    for number in (1..=10).rev() {
        let key = (number % 10).to_string();
        v.press_for(&key, "the light of that number", |state| state["light"] == number - 1);
        assert_eq!(v.state["chosen"], json!({ "light": number - 1 }), "it is chosen");
    }
}

fn objects(v: &mut Viewer<'_>) {
    for (key, shape) in [("K", "disc"), ("T", "triangle"), ("U", "cone"), ("L", "sphere")] {
        let before = v.shot();
        v.press_for(key, shape, |state| state["objects"][1]["shapes"] == json!([shape]));
        let [x, y, w, h] = v.picture().map(|x| x as usize);
        v.see(shape, |_, now| match now.difference(&before, [x, y, w, h]) {
            0..200 => Err("the same as before".into()),
            _ => Ok(()),
        });
    }
}

fn time(v: &mut Viewer<'_>) {
    let before = v.light(1);
    v.press_for("Space", "time runs", |state| state["playing"] == true && state["time"].as_f64() > Some(0.3));
    assert_ne!(v.light(1), before, "the light goes round");
    v.press_for("Space", "time stands", |state| state["playing"] == false);
    v.still();
    let stopped = v.number("/time");
    v.press_for("+", "twice as fast", |state| state["speed"] == 2.0);
    assert_eq!(v.number("/time"), stopped, "time stands still");
    v.press_for("\u{2212}", "as fast as before", |state| state["speed"] == 1.0);
    v.press_for("R", "the start", |state| state["time"] == 0.0);
    assert!(v.light(1).distance(before) < 1e-12, "the light is where it was");
}

fn window(v: &mut Viewer<'_>, screen: &Screen) {
    for key in ["F1", "?"] {
        v.press_for(key, "the help", |state| state["dialog"] == "help");
        v.press_for(key, "no help", |state| state["dialog"] == Value::Null);
    }
    let width = v.picture()[2];
    v.press_for("F9", "no panel", |state| state["picture"][2].as_f64() > Some(width + 200.0));
    v.press_for("F9", "the panel", |state| state["picture"][2] == width);
    v.press_for("F11", "the whole screen", |state| state["fullscreen"] == true);
    screen.wait_for_fullscreen(true);
    v.press_for("F11", "a window", |state| state["fullscreen"] == false);
    screen.wait_for_fullscreen(false);
    v.press_for("2", "a light is chosen", |state| state["chosen"] == json!({ "light": 1 }));
    v.press_for("Escape", "nothing is chosen", |state| state["chosen"] == Value::Null);
}

fn comparison(v: &mut Viewer<'_>) {
    let first = v.state["settings"]["ways"].clone();
    v.press_for("W", "changed sides", |state| state["settings"]["ways"] == json!([first[1], first[0]]));
    v.press_for("W", "and back", |state| state["settings"]["ways"] == first);
    let mut ways = vec![first[0].clone()];
    loop {
        let before = v.state["settings"]["ways"][0].clone();
        v.press_for("]", "the next way", |state| state["settings"]["ways"][0] != before);
        if v.state["settings"]["ways"][0] == first[0] {
            break;
        }
        ways.push(v.state["settings"]["ways"][0].clone());
        assert!(ways.len() < 20, "they go round: {ways:?}");
    }
    for name in ["analytic", "composite", "projected", "volume", "map", "raytraced", "none"] {
        assert!(ways.contains(&json!(name)), "{name} is among {ways:?}");
    }
    for way in ways.iter().rev() {
        v.press_for("[", "the way before", |state| state["settings"]["ways"][0] == *way);
    }
    for layout in ["split", "difference", "single"] {
        v.press_for("E", layout, |state| state["settings"]["layout"] == layout);
    }
    v.press_for("P", "frame times", |state| state["settings"]["timing"] == true);
    v.press_for("P", "none", |state| state["settings"]["timing"] == false);
}

/// With the papers' technique G and H choose the ends of the row that a light with an area is.
fn components(v: &mut Viewer<'_>) {
    v.press_for("1", "the light with an area", |state| state["light"] == 0);
    while v.state["settings"]["ways"][0] != "composite" {
        let before = v.state["settings"]["ways"][0].clone();
        v.press_for("]", "the next way", |state| state["settings"]["ways"][0] != before);
    }
    let light = v.light(0);
    for (key, side) in [("G", "left"), ("H", "right")] {
        v.press_for(key, side, |state| state["component"] == side);
        let count = |state: &Value| {
            let components = state["components"].as_array().map(Vec::as_slice).unwrap_or_default();
            components.iter().filter(|c| c[1][1] == STEP).count()
        };
        let before = count(&v.state);
        v.press_for("V", "the component goes up", |state| count(state) == before + 1);
        assert_eq!(v.light(0), light, "and not the light");
    }
    while v.state["settings"]["ways"][0] != "analytic" {
        let before = v.state["settings"]["ways"][0].clone();
        v.press_for("[", "the way before", |state| state["settings"]["ways"][0] != before);
    }
    v.press_for("1", "the light itself", |state| state["component"] == Value::Null);
}

fn scene(v: &mut Viewer<'_>) {
    v.press_for("Ctrl+S", "saved", |state| state["modified"] == false);
    let (first, lights) = (v.light(0), v.state["lights"].as_array().map_or(0, Vec::len));
    v.press_for("V", "changed", |state| state["modified"] == true);
    let moved = v.light(0);
    v.press_for("Ctrl+Z", "undone", |state| state["modified"] == false);
    assert_eq!(v.light(0), first, "it is where it was");
    for redo in ["Ctrl+Shift+Z", "Ctrl+Y"] {
        v.press_for(redo, "done again", |state| state["modified"] == true);
        assert_eq!(v.light(0), moved, "{redo}: it is where it was moved to");
        v.press_for("Ctrl+Z", "undone", |state| state["modified"] == false);
    }
    let count = |state: &Value| state["lights"].as_array().map_or(0, Vec::len);
    v.press_for("Ctrl+D", "one more", |state| count(state) == lights + 1);
    assert_eq!(v.state["chosen"], json!({ "light": lights }), "the new one is chosen");
    assert!(v.light(lights).distance(first + DVec3::new(0.3, 0.0, 0.3)) < 1e-9, "a little aside");
    v.press_for("Delete", "as many as before", |state| count(state) == lights);
    v.press_for("Ctrl+Z", "one more again", |state| count(state) == lights + 1);
    v.press_for("Ctrl+Z", "none was added", |state| count(state) == lights && state["modified"] == false);
    for (key, dialog) in [("Ctrl+O", "open"), ("Ctrl+Shift+S", "saveas")] {
        v.press_for(key, dialog, |state| {
            state["dialog"].as_str().is_some_and(|text| text.starts_with(dialog))
        });
        v.press_for("Escape", "no dialog", |state| state["dialog"] == Value::Null);
    }
    let own = v.state["scene"].clone();
    v.press_for("PageDown", "the gallery", |state| state["scene"] != own);
    let first = v.state["scene"].clone();
    v.press_for("PageDown", "the next", |state| state["scene"] != first);
    v.press_for("PageUp", "the one before", |state| state["scene"] == first);
}

/// F12 writes what the picture shows.
fn picture(v: &mut Viewer<'_>, desk: &Desk) {
    let before = v.shot();
    v.press_for("F12", "saved", |state| {
        state["message"].as_str().is_some_and(|text| text.contains("antumbra-001.png"))
    });
    let file = std::fs::File::open(desk.file("antumbra-001.png")).expect("it was written");
    let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().expect("a PNG");
    let mut bytes = vec![0; reader.output_buffer_size().expect("a size in memory")];
    let info = reader.next_frame(&mut bytes).expect("a whole PNG");
    let [x, y, w, h] = v.picture().map(|x| x as usize);
    assert_eq!([info.width as usize, info.height as usize], [w, h], "as large as the picture");
    let pixels = bytes.chunks_exact(3).enumerate();
    let wrong = pixels.filter(|(i, rgb)| {
        let seen = before.pixel(x + i % w, y + i / w);
        (0..3).any(|c| seen[c].abs_diff(rgb[c]) > 8)
    });
    // Names and marks are written over the picture in the window.
    let wrong = wrong.count();
    assert!(wrong * 50 < w * h, "{wrong} pixels of {} are others than in the window", w * h);
}
