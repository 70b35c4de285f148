//! `antumbra compare`: the files, the numbers, and what is refused.

mod common;

use std::fs;

use common::{Place, Png, SCENE, assert_refused, assert_success, json, opengl, stdout};
use serde_json::Value;

/// Small and quick: three frames, four rays a pixel.
const QUICK: [&str; 6] = ["--size", "96x64", "--frames", "3", "--samples", "4"];

fn compare<'a>(extra: &[&'a str]) -> Vec<&'a str> {
    [&["compare", "scene.toml", "--techniques", "analytic"], QUICK.as_slice(), extra].concat()
}

/// The report without what depends on the machine's mood.
fn without_times(mut report: Value) -> Value {
    let strip = |value: &mut Value| {
        if let Some(object) = value.as_object_mut() {
            for key in ["median_ms", "p95_ms", "plain_ms", "frames"] {
                assert!(object.remove(key).is_some_and(|time| time.is_number()), "{key} is a number");
            }
        }
    };
    strip(&mut report["reference"]);
    report["techniques"].as_array_mut().expect("a list").iter_mut().for_each(strip);
    report
}

#[test]
fn files_and_numbers() {
    let place = Place::new();
    if !opengl(&place) {
        return;
    }
    let output = place.run(compare(&["-o", "out", "--json"]));
    assert_success(&output);
    assert_eq!(
        place.entries(),
        ["out", "out/compare.json", "out/contact-sheet.png", "out/index.html", "scene.toml"],
        "three files and nothing else"
    );
    let report = json(&output);
    let file = fs::read_to_string(place.file("out/compare.json")).expect("written");
    assert_eq!(serde_json::from_str::<Value>(&file).expect("JSON"), report, "the file is what was printed");
    assert_eq!((&report["width"], &report["height"]), (&96.into(), &64.into()), "the size asked for");
    assert_eq!(report["lights"], serde_json::json!(["key", "sun"]), "the lights");
    assert_eq!(report["reference"]["technique"], "raytraced", "the reference");
    assert_eq!(report["reference"]["samples"], 4, "its samples");
    assert_eq!(report["reference"]["timer"], "wall time", "the clock of the CPU");

    let rows = report["techniques"].as_array().expect("a list");
    assert_eq!(rows.len(), 1, "the technique asked for");
    let row = &rows[0];
    assert_eq!(row["technique"], "analytic", "its name");
    assert_eq!((&row["misclassified_1px"], &row["misclassified_2px"]), (&0.into(), &0.into()), "it is exact");
    assert!(row["edge_pixels"].as_u64().is_some_and(|edges| edges > 100), "there are edges: {row}");
    let number = |value: &Value| value.as_f64().unwrap_or_else(|| panic!("a number: {value}"));
    // 0.010 is what exact coverage leaves; 0.03 adds corners and 8-bit masks, as in the tests of the host.
    assert!((1e-6..0.03).contains(&number(&row["edge_rms"])), "smooth edges: {row}");
    let without = &report["without_shadows"];
    for key in ["rmse", "flip"] {
        assert!(number(&row[key]) > 0.0, "{key}: four samples are not four rays");
        assert!(number(&row[key]) < 0.5 * number(&without[key]), "{key}: {row}, without shadows {without}");
    }
    assert!(number(&row["median_ms"]) > 0.0 && number(&row["median_ms"]) <= number(&row["p95_ms"]), "{row}");
    assert!(number(&row["plain_ms"]) > 0.0, "{row}");
    let lights = row["lights"].as_array().expect("a list");
    assert_eq!(lights.len(), 2, "a row for each light");
    let sum: u64 = lights.iter().filter_map(|light| light["edge_pixels"].as_u64()).sum();
    assert_eq!(Some(sum), row["edge_pixels"].as_u64(), "the sum over the lights");

    let sheet = Png::read(&place.file("out/contact-sheet.png"));
    // Two cells of 340 pixels with gaps of 24; 96x64 is shown three times as large.
    assert_eq!((sheet.width, sheet.height), (24 + 2 * 364, 84 + 76 + 2 * 192 + 12 + 24), "two cells");
    let pixels = sheet.rgb();
    assert!(pixels.iter().any(|pixel| *pixel != pixels[0]), "no blank");

    // The same again, over what is there: the same but for the times.
    let again = place.run(compare(&["-o", "out", "--json"]));
    assert_success(&again);
    assert_eq!(without_times(json(&again)), without_times(report), "the numbers are the same every time");
}

#[test]
fn the_page_is_whole_and_needs_nothing_else() {
    let place = Place::new();
    if !opengl(&place) {
        return;
    }
    // A name that is markup must not become any.
    fs::rename(place.file("scene.toml"), place.file("<b>&.toml")).expect("writable");
    let output = place
        .run([&["compare", "<b>&.toml", "-o", "out", "--techniques", "analytic"], QUICK.as_slice()].concat());
    assert_success(&output);
    let page = fs::read_to_string(place.file("out/index.html")).expect("written");
    assert!(page.starts_with("<!DOCTYPE html>") && page.trim_end().ends_with("</html>"), "a page");
    assert!(!page.contains("<b>") && page.contains("&#60;b&#62;"), "the scene's name is text");
    for loaded in ["http:", "https:", "src=\"/", "@import", "<link"] {
        assert!(!page.contains(loaded), "`{loaded}` would load something");
    }
    // The reference, the picture and the error.
    assert_eq!(page.matches("data:image/png;base64,iVBOR").count(), 3, "three pictures");
    for tag in ["table", "figure", "section", "dl", "main", "details"] {
        let (open, close) =
            (page.matches(&format!("<{tag}")).count(), page.matches(&format!("</{tag}>")).count());
        assert!(open > 0 && open == close, "<{tag}> is closed: {open} and {close}");
    }
    for part in [
        "lang=\"en\"",
        "prefers-color-scheme: dark",
        "type=\"range\"",
        "alt=\"",
        "aria-label=\"",
        "name=\"viewport\"",
    ] {
        assert!(page.contains(part), "`{part}` is in the page");
    }
}

#[test]
fn text_and_what_was_refused() {
    let place = Place::new();
    if !opengl(&place) {
        return;
    }
    let text = stdout(&place.run(compare(&["-o", "out"])));
    for part in [
        "out/index.html",
        "96x64, 2 lights, 2 objects",
        "edge RMS",
        "analytic",
        "without shadows",
        "raytraced",
    ] {
        assert!(text.contains(part), "`{part}` is in: {text}");
    }
    // All that there are: each is drawn or says why not.
    let all = place.run([&["compare", "scene.toml", "-o", "out", "--json"], QUICK.as_slice()].concat());
    assert_success(&all);
    let report = json(&all);
    let drawn = report["techniques"].as_array().expect("a list").iter().map(|row| &row["technique"]);
    let refused = report["refused"].as_array().expect("a list").iter().map(|row| &row["technique"]);
    let mut names: Vec<&str> = drawn.chain(refused).filter_map(Value::as_str).collect();
    names.sort_unstable();
    let mut expected = antumbra::Technique::NAMES.to_vec();
    expected.sort_unstable();
    assert_eq!(names, expected, "every technique of the library");
    assert!(report["techniques"].as_array().is_some_and(|drawn| drawn.len() >= 4), "most can: {report}");
    for refusal in report["refused"].as_array().expect("a list") {
        assert!(refusal["reason"].as_str().is_some_and(|reason| reason.contains("raytraced")), "{refusal}");
    }
}

#[test]
fn refusals() {
    let place = Place::new();
    let torus = "shape = { type = \"torus\", major_radius = 0.7, minor_radius = 0.2 }";
    place.write("torus.toml", &SCENE.replace("shape = { type = \"sphere\", radius = 0.7 }", torus));
    place.write("file", "");
    fs::create_dir_all(place.file("taken/index.html")).expect("writable");
    let before = place.entries();
    let cases: &[(&[&str], &str)] = &[
        (&["missing.toml"], "missing.toml"),
        (&["scene.toml", "--techniques", "magic"], "there is no technique `magic`"),
        (&["scene.toml", "--techniques", "analytic,"], "there is no technique ``"),
        (&["scene.toml", "--techniques", "analytic:size=3"], "there is no option `size=3`"),
        (&["scene.toml", "--techniques", "raytraced:size=3"], "raytraced has no options"),
        (&["scene.toml", "--techniques", "raytraced"], "name one besides raytraced"),
        (&["torus.toml", "--techniques", "analytic"], "object \"ball\""),
        (&["scene.toml", "--size", "4096x4096"], "too large for a comparison"),
        (&["scene.toml", "--frames", "0"], "from 1 to 1000"),
        (&["scene.toml", "--samples", "0"], "from 1 to 65536"),
        (&["scene.toml", "-o", "file"], "is not a directory"),
        (&["scene.toml", "-o", "a/b"], "there is no such directory"),
        (&["scene.toml", "-o", "taken"], "is a directory; name a file"),
    ];
    for (arguments, text) in cases {
        eprintln!("antumbra compare {}", arguments.join(" "));
        assert_refused(&place.run([&["compare"], *arguments].concat()), text);
        assert_eq!(place.entries(), before, "nothing is written");
    }
    let output = place
        .command(["compare", "scene.toml"])
        .env("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent")
        .env("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json")
        .output()
        .expect("the program starts");
    assert_refused(&output, "no OpenGL");
    assert_eq!(place.entries(), before, "nothing is written");
}
