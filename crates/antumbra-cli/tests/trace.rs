//! `antumbra trace`: the files hold what the ray tracer computes.

mod common;

use std::fs;
use std::path::Path;

use antumbra_reference::{Sampling, Tracer};
use antumbra_scene::Scene;
use common::{Place, Png, SCENE, assert_success, json, stdout};

const WIDTH: u32 = 48;
const HEIGHT: u32 = 32;
const SAMPLES: u32 = 4;
const EXPOSURE: f64 = 1.5;

fn truth() -> (Scene, Vec<[f32; 3]>) {
    let scene = Scene::parse(SCENE, Path::new("scene.toml")).expect("the scene is right");
    let pixels = Tracer::new(&scene, 0.0).render(WIDTH, HEIGHT, SAMPLES, &|_, _| ());
    (scene, pixels)
}

/// The level of a linear value by the sRGB standard, before rounding.
fn srgb(linear: f64) -> f64 {
    let linear = linear.clamp(0.0, 1.0);
    255.0 * if linear <= 0.0031308 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

#[test]
fn png_is_the_truth_in_srgb() {
    let place = Place::new();
    let output = place.run(["trace", "scene.toml", "-o", "a.png", "--samples", "4"]);
    assert_success(&output);
    assert!(stdout(&output).starts_with("a.png\n"), "says what was written: {}", stdout(&output));
    assert_eq!(place.entries(), ["a.png", "scene.toml"], "the picture alone");
    let png = Png::read(&place.file("a.png"));
    assert_eq!((png.width, png.height), (WIDTH, HEIGHT), "the scene's own size");
    let (_, truth) = truth();
    let mut levels = std::collections::BTreeSet::new();
    for (index, (pixel, truth)) in png.rgb().iter().zip(&truth).enumerate() {
        for channel in 0..3 {
            let level = srgb(f64::from(truth[channel]) * EXPOSURE);
            // Half a level is rounding; the rest is the exposure's product in float32.
            let difference = (f64::from(pixel[channel]) - level).abs();
            assert!(difference <= 0.501, "pixel {index}: {pixel:?}, truth {truth:?}");
            levels.insert(pixel[channel]);
        }
    }
    assert!(levels.len() > 20, "a picture and not a blank: {levels:?}");
}

#[test]
fn exr_is_the_truth_in_linear_float() {
    use exr::prelude::{ReadChannels, ReadLayers, read};
    let place = Place::new();
    assert_success(&place.run(["trace", "scene.toml", "-o", "a.EXR", "--samples", "4"]));
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_file(place.file("a.EXR"))
        .expect("an OpenEXR file");
    assert_eq!((image.layer_data.size.0, image.layer_data.size.1), (48, 32), "the scene's own size");
    let channels = &image.layer_data.channel_data.list;
    let names: Vec<String> = channels.iter().map(|channel| channel.name.to_string()).collect();
    assert_eq!(names, ["B", "G", "R"], "the three channels, in the format's alphabetical order");
    let (_, truth) = truth();
    for (channel, component) in channels.iter().zip([2, 1, 0]) {
        assert!(matches!(channel.sample_data, exr::prelude::FlatSamples::F32(_)), "32-bit float");
        for (index, (value, truth)) in channel.sample_data.values_as_f32().zip(&truth).enumerate() {
            assert_eq!(value, truth[component] * 1.5, "pixel {index}, channel {}", channel.name);
        }
    }
}

#[test]
fn visibility_is_grey_16_bit() {
    let place = Place::new();
    let arguments =
        ["trace", "scene.toml", "-o", "a.png", "--samples", "4", "--visibility", "masks", "--json"];
    let output = place.run(arguments);
    assert_success(&output);
    assert_eq!(
        place.entries(),
        ["a.png", "masks", "masks/key.png", "masks/sun.png", "scene.toml"],
        "the picture and a file for each light"
    );
    let (scene, _) = truth();
    let tracer = Tracer::new(&scene, 0.0);
    let seen = tracer.primitives_seen(WIDTH, HEIGHT);
    for (light, name) in ["key", "sun"].into_iter().enumerate() {
        let sampling = Sampling::Center { light_samples: SAMPLES };
        let truth = tracer.visibility(light, WIDTH, HEIGHT, sampling, &|_, _| ());
        let png = Png::read(&place.file(&format!("masks/{name}.png")));
        assert_eq!((png.width, png.height), (WIDTH, HEIGHT), "size of the picture");
        let grey = png.grey();
        let expected: Vec<u16> = truth.iter().map(|value| (value * 65535.0).round() as u16).collect();
        assert_eq!(grey, expected, "visibility of {name}");
        let background: Vec<u16> =
            grey.iter().zip(&seen).filter(|(_, seen)| seen.is_none()).map(|(level, _)| *level).collect();
        assert!(!background.is_empty(), "some background is seen");
        assert!(background.iter().all(|&level| level == 65535), "the background is lit");
        assert!(grey.contains(&0), "{name} leaves something dark");
    }

    let report = json(&output);
    assert_eq!(report["scene"], "scene.toml", "the scene");
    assert_eq!(report["technique"], "raytraced", "the technique");
    assert_eq!(report["backend"], "cpu", "the backend");
    assert_eq!((&report["width"], &report["height"]), (&48.into(), &32.into()), "the size");
    assert_eq!((&report["lights"], &report["objects"]), (&2.into(), &2.into()), "the scene's content");
    assert_eq!(report["samples"], 4, "the samples");
    assert!(report["msaa"].is_null() && report["driver"].is_null(), "no OpenGL");
    assert!(report["milliseconds"].as_f64().is_some_and(|time| time > 0.0), "the time");
    let files: Vec<&str> =
        report["files"].as_array().expect("a list").iter().filter_map(|f| f.as_str()).collect();
    let masks = Path::new("masks");
    let (key, sun) = (masks.join("key.png"), masks.join("sun.png"));
    assert_eq!(files, ["a.png", &key.to_string_lossy(), &sun.to_string_lossy()], "the files");
}

#[test]
fn size_and_time_are_obeyed() {
    let place = Place::new();
    let moving = SCENE.replace(
        "intensity = 30.0",
        "intensity = 30.0\nmotion = { type = \"orbit\", center = [0.0, 4.0, 0.0], axis = [0.0, 1.0, 0.0], period = 4.0 }",
    );
    place.write("moving.toml", &moving);
    for (time, file) in [("0", "zero.png"), ("1", "one.png"), ("-3", "before.png"), ("-4", "start.png")] {
        let arguments =
            ["trace", "moving.toml", "-o", file, "--samples", "1", "--size", "20x10", "--time", time];
        assert_success(&place.run(arguments));
        let png = Png::read(&place.file(file));
        assert_eq!((png.width, png.height), (20, 10), "the size asked for");
    }
    let read = |file: &str| Png::read(&place.file(file)).rgb();
    assert_ne!(read("zero.png"), read("one.png"), "the light has moved");
    let far = |a: &str, b: &str| {
        let pairs = read(a).into_iter().zip(read(b));
        // The light is in the same place but for rounding: at one ray a pixel an edge may fall to the other side.
        pairs.filter(|(a, b)| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 1)).count()
    };
    assert!(far("one.png", "before.png") <= 2, "a period earlier the light is in the same place");
    assert!(far("zero.png", "start.png") <= 2, "a period earlier the light is in the same place");
}

#[test]
fn render_on_the_cpu_is_the_same() {
    let place = Place::new();
    let report =
        place.run(["render", "scene.toml", "-o", "a.png", "--backend", "cpu", "--msaa", "4", "--json"]);
    assert_success(&report);
    assert_eq!(json(&report)["technique"], "raytraced", "the CPU draws with the ray tracer");
    assert_success(&place.run([
        "render",
        "scene.toml",
        "-o",
        "b.png",
        "--technique",
        "raytraced",
        "--msaa",
        "4",
    ]));
    assert_success(&place.run(["trace", "scene.toml", "-o", "c.png", "--samples", "4"]));
    let read = |name: &str| fs::read(place.file(name)).expect("the picture was written");
    assert_eq!(read("a.png"), read("b.png"), "--backend cpu and --technique raytraced are one");
    assert_eq!(read("a.png"), read("c.png"), "and so is trace");
}

#[test]
fn files_are_replaced_and_links_followed() {
    let place = Place::new();
    place.write("a.png", "old");
    assert_success(&place.run(["trace", "scene.toml", "-o", "a.png", "--samples", "1"]));
    let png = Png::read(&place.file("a.png"));
    assert_eq!(png.width, WIDTH, "the old file is gone");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("a.png", place.file("link.png")).expect("writable");
        assert_success(&place.run([
            "trace",
            "scene.toml",
            "-o",
            "link.png",
            "--samples",
            "1",
            "--size",
            "8x8",
        ]));
        assert!(place.file("link.png").is_symlink(), "still a link");
        assert_eq!(Png::read(&place.file("a.png")).width, 8, "its target was replaced");
    }
}

/// Traces quickly to a file.
#[cfg(unix)]
fn traced(place: &Place, output: &str) -> std::process::Output {
    place.run(["trace", "scene.toml", "-o", output, "--samples", "1", "--size", "8x8"])
}

#[cfg(unix)]
#[test]
fn permissions_are_kept() {
    use std::os::unix::fs::PermissionsExt;
    let place = Place::new();
    let mode =
        |name: &str| fs::metadata(place.file(name)).expect("it is there").permissions().mode() & 0o7777;
    // Made as any other program makes it.
    place.write("usual", "");
    assert_success(&traced(&place, "new.png"));
    assert_eq!(mode("new.png"), mode("usual"), "a new file is as any other");
    std::os::unix::fs::symlink("link-to.png", place.file("link.png")).expect("writable");
    for wanted in [0o600, 0o644, 0o666, 0o750] {
        for (name, file) in [("a.png", "a.png"), ("link.png", "link-to.png")] {
            place.write(file, "old");
            fs::set_permissions(place.file(file), fs::Permissions::from_mode(wanted)).expect("its own file");
            assert_success(&traced(&place, name));
            assert_eq!(Png::read(&place.file(file)).width, 8, "it was replaced");
            assert_eq!(mode(file), wanted, "{wanted:o} is kept");
        }
    }
}

#[cfg(unix)]
#[test]
fn links_are_followed_wherever_they_lead() {
    use std::os::unix::fs::symlink;
    let place = Place::new();
    fs::create_dir(place.file("there")).expect("writable");
    fs::create_dir(place.file("masks")).expect("writable");
    let links = [
        ("first.png", "there/second.png"),
        ("there/second.png", "new.png"),
        ("masks/sun.png", "../there/sun.png"),
        ("lost.png", "nowhere/new.png"),
        ("a.png", "b.png"),
        ("b.png", "a.png"),
        ("dir.png", "there"),
    ];
    for (link, to) in links {
        symlink(to, place.file(link)).expect("writable");
    }
    let before = place.entries();
    for (output, text) in [
        (
            "lost.png",
            "lost.png: is a link to nowhere/new.png; nowhere: there is no such directory; make it first",
        ),
        ("a.png", "too many links"),
        ("dir.png", "is a directory; name a file"),
    ] {
        common::assert_refused(&traced(&place, output), text);
        assert_eq!(place.entries(), before, "nothing is written");
    }
    let arguments = ["trace", "scene.toml", "-o", "first.png", "--samples", "1", "--visibility", "masks"];
    for _new_and_replaced in 0..2 {
        assert_success(&place.run(arguments));
        for file in ["there/new.png", "there/sun.png", "masks/key.png"] {
            assert!(!place.file(file).is_symlink(), "{file}");
            assert_eq!(Png::read(&place.file(file)).width, WIDTH, "{file}");
        }
    }
    for (link, to) in links {
        assert_eq!(fs::read_link(place.file(link)).expect("still a link"), Path::new(to), "{link}");
    }
    assert_eq!(place.entries().len(), before.len() + 3, "and no temporary file");
    // Two lights in one file.
    fs::remove_file(place.file("masks/key.png")).expect("writable");
    symlink("sun.png", place.file("masks/key.png")).expect("writable");
    common::assert_refused(&place.run(arguments), "would write one file");
}
