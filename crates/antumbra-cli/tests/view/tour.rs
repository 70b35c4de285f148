//! Pictures of the viewer for its page, and how fast its techniques are on the gallery. Run by hand:
//!
//! `cargo test --release -p antumbra-cli --test view -- --ignored tour::tour` writes `docs/images/viewer*.png`,
//! `cargo test --release -p antumbra-cli --test view -- --ignored --nocapture tour::rates` prints the frame times.

use std::fs::File;
use std::io::BufWriter;
use std::path::PathBuf;
use std::time::Duration;

use antumbra::glam::DVec3;

use crate::screen::Shot;
use crate::viewer::{Desk, Viewer};

/// How long measuring may take.
const HOURS: Duration = Duration::from_secs(3600);

/// Size of the window.
const SIZE: &str = "760x460";

fn image(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/images").join(name)
}

/// An animated PNG of shots, each with how long it stays, in hundredths of a second.
fn write(name: &str, shots: &[(Shot, u16)]) {
    let file = BufWriter::new(File::create(image(name)).expect("the folder of images is there"));
    let [width, height] = shots[0].0.size.map(|side| u32::try_from(side).expect("a window's size"));
    let mut encoder = png::Encoder::new(file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    if shots.len() > 1 {
        encoder.set_animated(shots.len() as u32, 0).expect("there are frames");
    }
    let mut writer = encoder.write_header().expect("written");
    for (shot, stays) in shots {
        if shots.len() > 1 {
            writer.set_frame_delay(*stays, 100).expect("a delay");
        }
        writer.write_image_data(shot.rgb.as_flattened()).expect("written");
    }
    writer.finish().expect("written");
}

/// Starts the viewer without dithering, which makes pictures many times as large.
fn start<'a>(desk: &'a Desk, arguments: &[&str]) -> Viewer<'a> {
    let folder = desk.file("config/antumbra");
    std::fs::create_dir_all(folder).expect("a temporary folder");
    desk.write("config/antumbra/viewer.json", r#"{ "settings": { "dither": false } }"#);
    desk.view(arguments)
}

/// What the window shows once it has nothing more to say: numbers and legends come a frame after the picture.
fn settled(v: &mut Viewer<'_>) -> Shot {
    while v.lines_within(Duration::from_millis(400)) > 0 {}
    v.shot()
}

/// Drags from one point of the window to another and takes a shot at each step.
fn drag(v: &mut Viewer<'_>, from: [f64; 2], to: [f64; 2], steps: u32, shots: &mut Vec<(Shot, u16)>) {
    v.move_to(from);
    v.button(1, true);
    for step in 1..=steps {
        let part = f64::from(step) / f64::from(steps);
        v.move_to([0, 1].map(|i| from[i] + (to[i] - from[i]) * part));
        shots.push((v.shot(), 12));
    }
    v.button(1, false);
}

#[test]
#[ignore = "writes the pictures of docs/viewer.md"]
fn tour() {
    let Some(desk) = Desk::new() else { return };
    let mut v = start(&desk, &["--size", SIZE]);
    let mut shots = vec![(v.shot(), 100)];
    // A ball is dragged, and its shadows follow.
    let ball = v.vector("/objects/1/position");
    let (here, aside) = (v.project(ball), v.project(ball + DVec3::new(-1.5, 0.0, 1.0)));
    drag(&mut v, here, aside, 6, &mut shots);
    drag(&mut v, aside, here, 4, &mut shots);
    // Against a shadow map of few texels.
    v.press("Escape");
    v.press_for("E", "split", |state| state["settings"]["layout"] == "split");
    v.pick(&[("ComboBox", "right"), ("Button", "map")]);
    v.wait("map", |state| state["settings"]["ways"][1].as_str().is_some_and(|way| way.starts_with("map")));
    shots.push((v.shot(), 60));
    let [middle, left, right] = [0.5, 0.15, 0.85].map(|x| v.at(x, 0.3));
    drag(&mut v, middle, left, 3, &mut shots);
    drag(&mut v, left, right, 5, &mut shots);
    shots.push((v.shot(), 60));
    v.press_for("E", "error map", |state| state["settings"]["layout"] == "difference");
    shots.push((settled(&mut v), 160));
    write("viewer-error-map.png", &[(settled(&mut v), 0)]);
    drop(v);
    // What a soft shadow is made of.
    let scene = desk.write("ball.toml", BALL);
    let mut v = start(&desk, &["--size", SIZE, &scene.to_string_lossy()]);
    shots.push((v.shot(), 80));
    for (label, stays) in [("outlines", 80), ("tangent rays", 120)] {
        v.click("CheckBox", label);
        shots.push((settled(&mut v), stays));
    }
    write("viewer-outlines.png", &[(settled(&mut v), 0)]);
    for key in ["M", "M", "M", "M", "B", "B", "B", "B"] {
        let before = v.light(0).to_array();
        v.press_for(key, "moved", |state| state["lights"][0]["position"] != serde_json::json!(before));
        shots.push((v.shot(), 12));
    }
    shots.push((v.shot(), 100));
    write("viewer.png", &shots);
    drop(v);
    for (name, technique, labels) in [
        ("viewer-volume.png", "volume", &["shadow volumes"][..]),
        ("viewer-map.png", "map", &["map from the light"]),
        ("viewer-conics.png", "analytic", &["outlines", "conics"]),
    ] {
        let mut v = start(&desk, &["--size", "1280x800", "--technique", technique]);
        for label in labels {
            v.click("CheckBox", label);
        }
        write(name, &[(settled(&mut v), 0)]);
    }
    let mut v = start(&desk, &["--size", "1280x800"]);
    v.press_for("P", "frame times", |state| state["settings"]["timing"] == true);
    v.click("Button", "Measure all");
    v.wait("it measures", |state| !state["measuring"].is_null());
    v.wait("all are measured", |state| state["measuring"].is_null());
    write("viewer-times.png", &[(settled(&mut v), 0)]);
    v.press_for("F1", "the help", |state| state["dialog"] == "help");
    write("viewer-keys.png", &[(settled(&mut v), 0)]);
}

const BALL: &str = r#"
ambient = [0.05, 0.05, 0.06]

[camera]
eye = [0.0, 4.2, 9.0]
target = [0.0, 1.4, 0.0]
fov_y = 42.0

[[light]]
name = "lamp"
type = "sphere"
radius = 0.7
position = [1.6, 4.2, 0.4]
intensity = 70.0

[[object]]
name = "floor"
shape = { type = "plane" }
color = [0.75, 0.72, 0.68]

[[object]]
name = "ball"
shape = { type = "sphere", radius = 0.6 }
translation = [0.0, 1.8, 0.0]
color = [0.85, 0.35, 0.22]
"#;

#[test]
#[ignore = "measures for minutes"]
fn rates() {
    let Some(desk) = Desk::new() else { return };
    let mut v = desk.view(&["--fresh", "--size", "960x540"]);
    v.press_for("F9", "no panel", |state| state["settings"]["panel"] == false);
    let first = v.state["scene"].clone();
    loop {
        if v.state["settings"]["timing"] == false {
            v.press_for("P", "frame times", |state| state["settings"]["timing"] == true);
        }
        v.click("Button", "Measure all");
        v.wait("it measures", |state| !state["measuring"].is_null());
        v.wait_within(HOURS, "all are measured", |state| state["measuring"].is_null());
        let times = v.state["timing"].as_array().cloned().unwrap_or_default();
        let each = times.iter().map(|time| {
            let ms = |key: &str| time[key].as_f64().unwrap_or(f64::NAN);
            let (plain, shadows) = (ms("plain_ms"), ms("shadows_ms"));
            format!("{} {:.1}/s ({:.2})", time["way"].as_str().unwrap_or("?"), 1e3 / shadows, shadows / plain)
        });
        println!("{}: {}", v.state["scene"], each.collect::<Vec<_>>().join(", "));
        let here = v.state["scene"].clone();
        v.press_for("PageDown", "the next", |state| state["scene"] != here);
        if v.state["scene"] == first {
            return;
        }
    }
}
