//! `antumbra bench`: rows, charts and scenes.

mod common;

use std::collections::BTreeSet;
use std::fs;

use antumbra_scene::Scene;
use common::{Place, assert_refused, assert_success, json, opengl, stdout};
use serde_json::Value;

#[test]
fn every_figure() {
    let place = Place::new();
    if !opengl(&place) {
        return;
    }
    // `resolution` draws 2048 pixels across whatever the size: 16 to 1 keeps it quick.
    let arguments = ["bench", "-o", "out", "--frames", "2", "--size", "64x4", "--json"];
    let output = place.run(arguments);
    assert_success(&output);
    let report = json(&output);
    let file = fs::read_to_string(place.file("out/bench.json")).expect("written");
    assert_eq!(serde_json::from_str::<Value>(&file).expect("JSON"), report, "the file is what was printed");

    let rows = report["rows"].as_array().expect("a list");
    let refused = report["refused"].as_array().expect("a list");
    let gl = antumbra::Technique::NAMES.len();
    // 5 primitives with the ray tracer beside, 7 numbers of lights and occluders, 4 of pixels; 4 primitives under an
    // area light with two techniques, and two more with 6 numbers of points.
    assert_eq!(rows.len() + refused.len(), 5 * (gl + 1) + 18 * gl + 4 * 14, "each technique on each scene");
    for technique in antumbra::Technique::NAMES {
        let measured = rows.iter().filter(|row| row["technique"] == *technique).count();
        assert!(measured >= 4, "{technique} is measured {measured} times");
    }
    for row in rows {
        let number = |key: &str| row[key].as_f64().unwrap_or_else(|| panic!("{key} is a number in {row}"));
        assert!(0.0 < number("median_ms") && number("median_ms") <= number("p95_ms"), "{row}");
        assert!(number("plain_ms") > 0.0, "{row}");
        assert_eq!(row["soft"].is_null(), row["figure"] != "soft", "the other lights are hard: {row}");
        assert!(row["figure"] == "soft" || row["penumbra_rmse"].is_null(), "no penumbra: {row}");
        let timer = row["timer"].as_str().expect("a clock");
        assert_eq!(timer == "wall time", row["technique"] == "raytraced", "the clock is named: {row}");
        assert_eq!(row["frames"], 2, "as many frames as asked for: {row}");
    }
    let column = |key: &str, figure: &str| -> Vec<u64> {
        let of = rows.iter().filter(|row| row["figure"] == figure && row["technique"] == "analytic");
        of.map(|row| row[key].as_u64().expect("a number")).collect()
    };
    assert_eq!(column("lights", "lights"), [1, 2, 4, 8, 16, 32, 64], "the axis");
    assert_eq!(column("occluders", "occluders"), [1, 3, 10, 30, 100, 300, 1000], "the axis");
    assert_eq!(column("occluders", "primitives"), [1, 1, 1, 1, 7], "a primitive, and several");
    assert_eq!(column("width", "resolution"), [256, 512, 1024, 2048], "the axis");
    assert_eq!(column("height", "resolution"), [16, 32, 64, 128], "in proportion");

    let csv = fs::read_to_string(place.file("out/bench.csv")).expect("written");
    assert_eq!(csv.lines().count(), rows.len() + 1, "a line for each row, and the head");
    assert_eq!(
        csv.lines().next(),
        Some(
            "figure,technique,soft,components,scene,lights,occluders,width,height,median_ms,p95_ms,plain_ms,timer,\
             frames,penumbra_rmse"
        ),
        "the head"
    );
    for figure in ["primitives", "lights", "occluders", "resolution", "soft", "soft-error"] {
        let chart = fs::read_to_string(place.file(&format!("out/{figure}.svg"))).expect("written");
        assert!(chart.starts_with("<svg") && chart.contains("analytic"), "{figure} is a chart");
    }
    let scenes: BTreeSet<&str> = rows.iter().filter_map(|row| row["scene"].as_str()).collect();
    assert_eq!(scenes.len(), 27, "every scene is measured");
    for scene in scenes {
        let path = place.file(&format!("out/scenes/{scene}.toml"));
        let scene = Scene::load(&path).unwrap_or_else(|error| panic!("{error}"));
        assert!(!scene.lights.is_empty(), "a scene to be opened");
    }
    let files: Vec<&str> =
        report["files"].as_array().expect("a list").iter().filter_map(Value::as_str).collect();
    assert_eq!(files.len(), 2 + 6 + 27, "table, rows, charts and scenes: {files:?}");
    assert!(files.iter().all(|file| place.file(file).is_file()), "all are there: {files:?}");
}

/// What Fig. 7 of the 2017 paper on soft shadows varies, and what each way is worth.
#[test]
fn soft_shadows_have_an_error() {
    let place = Place::new();
    if !opengl(&place) {
        return;
    }
    let output =
        place.run(["bench", "--figure", "soft", "-o", "out", "--frames", "1", "--size", "96x96", "--json"]);
    assert_success(&output);
    let report = json(&output);
    let rows = report["rows"].as_array().expect("a list");
    assert_eq!(rows.len(), 4 * 14, "no technique refuses: {}", report["refused"]);
    for scene in ["soft-circle", "soft-triangle", "soft-sphere", "soft-cone"] {
        let of = |technique: &str| {
            let row = rows.iter().find(|row| row["scene"] == scene && row["technique"] == technique);
            row.unwrap_or_else(|| panic!("{technique} is measured on {scene}"))
        };
        let error = |technique: &str| of(technique)["penumbra_rmse"].as_f64().expect("there is a penumbra");
        for (count, sampled, painted) in [
            (1, "analytic+samples:1", "composite:components=1"),
            (3, "analytic+samples:3", "composite"),
            (64, "analytic+samples:64", "composite:components=64"),
        ] {
            assert_eq!(of(sampled)["components"], count, "points of the light");
            assert_eq!(of(painted)["components"], count, "points of the light");
        }
        assert!(of("analytic")["components"].is_null(), "the light as it is");
        // The bound of the closed forms against the ray tracer, and what black and white alone leave of a smooth edge. At 512
        // pixels across it is .0011 to .0013.
        assert!(error("analytic") < 0.0025, "{scene}: {}", error("analytic"));
        let (one, many) = (error("analytic+samples:1"), error("analytic+samples:64"));
        assert!(one > 0.15 && many < 0.25 * one, "{scene}: more points come nearer: {one} to {many}");
        assert!(error("composite:components=1") > 0.15, "{scene}: one component casts a hard shadow");
    }
    let csv = fs::read_to_string(place.file("out/bench.csv")).expect("written");
    let mut table = csv::Reader::from_reader(csv.as_bytes());
    let last = table.headers().expect("a head").iter().position(|head| head == "penumbra_rmse");
    for record in table.records() {
        let record = record.expect("a row");
        let cell = last.and_then(|at| record.get(at)).expect("a column");
        assert!(cell.parse::<f64>().is_ok_and(|error| error > 0.0), "a number in each row: {cell}");
    }
    for chart in ["soft", "soft-error"] {
        let chart = fs::read_to_string(place.file(&format!("out/{chart}.svg"))).expect("written");
        for text in ["circle", "cone", "analytic+samples:N", "map:filter=pcss"] {
            assert!(chart.contains(text), "{text} is in the chart");
        }
    }
}

#[test]
fn one_figure_on_the_cpu_alone() {
    let place = Place::new();
    // No OpenGL is asked for, so none needs to be there.
    let output = place
        .command([
            "bench",
            "--figure",
            "primitives",
            "--techniques",
            "raytraced,raytraced",
            "--size",
            "32x32",
            "--frames",
            "2",
        ])
        .env("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent")
        .env("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json")
        .output()
        .expect("the program starts");
    assert_success(&output);
    let text = stdout(&output);
    assert!(text.contains("antumbra-bench") && text.contains("primitives-fir-tree"), "{text}");
    assert_eq!(text.matches("raytraced").count(), 5, "once for each place: {text}");
    let report: Value =
        serde_json::from_str(&fs::read_to_string(place.file("antumbra-bench/bench.json")).expect("written"))
            .expect("JSON");
    assert!(report["driver"].is_null(), "no OpenGL was opened");
    assert!(!place.file("antumbra-bench/lights.svg").exists(), "the figure asked for alone");
}

#[test]
fn refusals() {
    let place = Place::new();
    place.write("file", "");
    fs::create_dir_all(place.file("taken/lights.svg")).expect("writable");
    fs::create_dir_all(place.file("full")).expect("writable");
    place.write("full/scenes", "");
    let before = place.entries();
    let cases: &[(&[&str], &str)] = &[
        (&["--figure", "shadows"], "primitives, lights, occluders, resolution, soft"),
        (&["--frames", "0"], "from 1 to 1000"),
        (&["--frames", "1001"], "from 1 to 1000"),
        (&["--size", "0x4"], "at least 1x1"),
        (&["--techniques", "magic"], "there is no technique `magic`"),
        (&["-o", "file"], "is not a directory"),
        (&["-o", "a/b"], "there is no such directory"),
        (&["-o", "taken"], "is a directory; name a file"),
        (&["-o", "full"], "is not a directory"),
    ];
    for (arguments, text) in cases {
        eprintln!("antumbra bench {}", arguments.join(" "));
        assert_refused(&place.run([&["bench"], *arguments].concat()), text);
        assert_eq!(place.entries(), before, "nothing is written");
    }
    let output = place
        .command(["bench"])
        .env("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent")
        .env("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json")
        .output()
        .expect("the program starts");
    assert_refused(&output, "no OpenGL");
    assert_eq!(place.entries(), before, "nothing is written");
}
