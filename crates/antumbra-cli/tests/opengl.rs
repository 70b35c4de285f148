//! What draws with OpenGL, and what happens where there is none.

mod common;

use std::process::Output;

use common::{Place, Png, SCENE, assert_refused, assert_success, json, opengl, stderr, stdout};

/// The program where EGL knows no driver: as on a machine without OpenGL.
fn without_opengl(place: &Place, arguments: &[&str]) -> Output {
    place
        .command(arguments)
        .env("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent")
        .env("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json")
        .output()
        .expect("the program starts")
}

fn pictures(place: &Place, directory: &str) -> Vec<String> {
    let prefix = format!("{directory}/");
    place.entries().iter().filter_map(|entry| entry.strip_prefix(&prefix)).map(str::to_owned).collect()
}

#[test]
fn info() {
    let place = Place::new();
    let output = place.run(["info"]);
    assert_success(&output);
    assert!(stdout(&output).contains("OpenGL"), "says something of OpenGL: {}", stdout(&output));
    if opengl(&place) {
        let info = json(&place.run(["info", "--json"]));
        assert!(
            info["driver"]["version"].as_str().is_some_and(|version| !version.is_empty()),
            "a version: {info}"
        );
        assert!(info["driver"]["software"].is_boolean(), "software or hardware: {info}");
        assert!(
            info["max_msaa"].as_u64().is_some_and(|samples| samples >= 4),
            "OpenGL 3.3 has 4 samples: {info}"
        );
    }
}

#[test]
fn render() {
    let place = Place::new();
    if !opengl(&place) {
        return;
    }
    let arguments = [
        "render",
        "scene.toml",
        "-o",
        "gl.png",
        "--msaa",
        "4",
        "--visibility",
        "masks",
        "--size",
        "144x96",
        "--json",
    ];
    let output = place.run(arguments);
    assert_success(&output);
    let report = json(&output);
    assert_eq!(report["technique"], "analytic", "the technique");
    assert_eq!(report["backend"], "gl", "the backend");
    assert_eq!(report["msaa"], 4, "the samples");
    assert!(report["driver"]["renderer"].is_string(), "the driver");

    assert_success(&place.run([
        "trace",
        "scene.toml",
        "-o",
        "truth.png",
        "--visibility",
        "truth",
        "--size",
        "144x96",
    ]));
    let fine = [
        "trace",
        "scene.toml",
        "-o",
        "fine.png",
        "--visibility",
        "fine",
        "--size",
        "1152x768",
        "--samples",
        "1",
    ];
    assert_success(&place.run(fine));
    for light in ["key", "sun"] {
        let gl = Png::read(&place.file(&format!("masks/{light}.png")));
        assert_eq!((gl.width, gl.height), (144, 96), "the size asked for");
        let gl = gl.grey();
        let truth = Png::read(&place.file(&format!("truth/{light}.png"))).grey();
        let edges = edges(&Png::read(&place.file(&format!("fine/{light}.png"))).grey());
        for index in (0..truth.len()).filter(|&index| !edges[index]) {
            assert_eq!(gl[index], truth[index], "visibility of {light}, pixel {index}, away from edges");
        }
        let away: Vec<u16> =
            (0..truth.len()).filter(|&index| !edges[index]).map(|index| truth[index]).collect();
        assert!(away.len() > 10_000, "most of the picture is away from edges: {}", away.len());
        assert!(away.contains(&0), "some of it is in shadow");
    }
    let picture = Png::read(&place.file("gl.png"));
    assert_eq!((picture.width, picture.height), (144, 96), "the size asked for");
    let (picture, truth) = (picture.rgb(), Png::read(&place.file("truth.png")).rgb());
    let sum: u64 =
        picture.iter().flatten().zip(truth.iter().flatten()).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    // Edge pixels differ, by 4 samples against 64; the mean over the picture stays within one level.
    assert!(
        sum < 144 * 96 * 3,
        "the picture is the truth's, mean difference {}",
        sum as f64 / (144.0 * 96.0 * 3.0)
    );
}

/// The pixels of a 144x96 picture within a pixel of an edge, from the same picture with 8x8 times the pixels: of those
/// in the pixel and its eight neighbours some differ.
fn edges(fine: &[u16]) -> Vec<bool> {
    let around = |at: usize, limit: usize| (8 * at).saturating_sub(8)..(8 * at + 16).min(limit);
    let differs = |x: usize, y: usize| {
        let mut levels = around(y, 768).flat_map(|v| around(x, 1152).map(move |u| fine[v * 1152 + u]));
        let first = levels.next();
        levels.any(|level| Some(level) != first)
    };
    (0..144 * 96).map(|index| differs(index % 144, index / 144)).collect()
}

#[test]
fn what_the_driver_or_the_technique_cannot_do() {
    let place = Place::new();
    if !opengl(&place) {
        return;
    }
    let most = json(&place.run(["info", "--json"]))["max_msaa"].as_u64().expect("a number");
    if most < 64 {
        let arguments = ["render", "scene.toml", "-o", "a.png", "--msaa", "64", "--visibility", "masks"];
        assert_refused(&place.run(arguments), &format!("give at most {most}"));
    }
    let torus = "shape = { type = \"torus\", major_radius = 0.7, minor_radius = 0.2 }";
    place.write("scene.toml", &SCENE.replace("shape = { type = \"sphere\", radius = 0.7 }", torus));
    let refused = place.run(["render", "scene.toml", "-o", "a.png", "--visibility", "masks"]);
    assert_refused(&refused, "ball");
    assert!(stderr(&refused).contains("raytraced"), "names a technique that can: {}", stderr(&refused));
    assert_eq!(place.entries(), ["scene.toml"], "nothing is written");
}

#[test]
fn techniques_with_options() {
    let place = Place::new();
    if !opengl(&place) {
        return;
    }
    let scene =
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/primitives-light-above.toml");
    place.write("above.toml", &std::fs::read_to_string(scene).expect("a gallery scene"));
    let render = |file: &str, extra: &[&str]| {
        let arguments = ["render", "above.toml", "-o", file, "--size", "96x54", "--json"];
        let output = place.run([arguments.as_slice(), extra].concat());
        assert_success(&output);
        let technique = json(&output)["technique"].as_str().expect("a name").to_owned();
        (technique, Png::read(&place.file(file)).rgb())
    };
    let (name, painted) = render("a.png", &["--technique", "composite"]);
    assert_eq!(name, "composite", "its default shade goes without saying");
    assert_eq!(
        render("b.png", &["--technique", "composite", "--shade", "paper"]).1,
        painted,
        "which is the paper's"
    );
    let (name, physical) = render("c.png", &["--technique", "composite:shade=paper", "--shade", "physical"]);
    assert_eq!(name, "composite:shade=physical", "--shade has the last word");
    assert_ne!(painted, physical, "the shades differ");
    assert_eq!(
        render("d.png", &["--technique", "composite:shade=physical"]).1,
        physical,
        "the same as an option"
    );
}

#[test]
fn demo() {
    let place = Place::new();
    if !opengl(&place) {
        return;
    }
    let output = place.run(["demo", "-o", "pictures", "--size", "160x90"]);
    assert_success(&output);
    assert!(stdout(&output).contains("pictures"), "says where to look: {}", stdout(&output));
    let pictures = pictures(&place, "pictures");
    assert!(pictures.len() >= 6, "at least six pictures: {pictures:?}");
    for picture in &pictures {
        let png = Png::read(&place.file(&format!("pictures/{picture}")));
        assert_eq!((png.width, png.height), (160, 90), "{picture} has the size asked for");
        let pixels = png.rgb();
        assert!(pixels.iter().any(|pixel| *pixel != pixels[0]), "{picture} is no blank");
    }
    // Again, into the directory that is there now, and without naming the command.
    assert_success(&place.run(["demo", "-o", "pictures", "--size", "16x9"]));
    assert_eq!(Png::read(&place.file(&format!("pictures/{}", pictures[0]))).width, 16, "replaced");
}

#[test]
fn without_any_opengl() {
    let place = Place::new();
    let output = without_opengl(&place, &["info"]);
    assert_success(&output);
    assert!(stdout(&output).contains("none: "), "a plain statement: {}", stdout(&output));
    assert_eq!(json(&without_opengl(&place, &["info", "--json"]))["opengl"], false, "in JSON too");

    assert_refused(&without_opengl(&place, &["render", "scene.toml", "-o", "a.png"]), "--backend cpu");
    assert_refused(&without_opengl(&place, &["demo", "--backend", "gl"]), "--backend cpu");
    assert_eq!(place.entries(), ["scene.toml"], "nothing is written");

    let output = without_opengl(&place, &["demo", "-o", "pictures", "--size", "80x45"]);
    assert_eq!(output.status.code(), Some(0), "the CPU draws: {}", stderr(&output));
    assert!(stderr(&output).starts_with("note: there is no OpenGL here"), "says so: {}", stderr(&output));
    assert!(stdout(&output).contains("drawn with the CPU"), "says what drew: {}", stdout(&output));
    assert!(pictures(&place, "pictures").len() >= 6, "at least six pictures");
}

/// What the program says to use instead does draw.
#[test]
fn every_way_that_is_named_draws() {
    let place = Place::new();
    if !opengl(&place) {
        return;
    }
    let torus = SCENE
        .replace(
            "type = \"sphere\", radius = 0.7",
            "type = \"torus\", major_radius = 0.6, minor_radius = 0.2",
        )
        .replace("type = \"point\"", "type = \"sphere\"\nradius = 0.3");
    assert!(torus.contains("torus") && torus.contains("radius = 0.3"), "a mesh and a light with an area");
    place.write("torus.toml", &torus);
    let render = |more: &[&str]| {
        place.run([&["render", "torus.toml", "-o", "a.png", "--size", "16x12"], more].concat())
    };
    let mut named = 0;
    for refused in
        [&[][..], &["--soft", "samples:2"], &["--technique", "volume"], &["--technique", "composite"]]
    {
        let output = render(refused);
        assert_refused(&output, "; use --technique ");
        let errors = stderr(&output);
        let ways = errors.trim().rsplit("; use ").next().expect("what to use");
        let (able, sampled) = ways.split_once(", or --soft ").unwrap_or((ways, ""));
        let mut all: Vec<Vec<&str>> = Vec::new();
        for technique in able.strip_prefix("--technique ").expect("a technique").split(" or ") {
            let more: &[&str] = if technique.ends_with(" without --soft") { &[] } else { refused };
            let more = more.iter().copied().filter(|word| *word == "--soft" || word.starts_with("samples"));
            let technique = technique.split(' ').next().expect("a name");
            all.push(["--technique", technique].into_iter().chain(more).collect());
        }
        if let Some((soft, techniques)) = sampled.split_once(" with --technique ") {
            all.extend(techniques.split(" or ").map(|name| vec!["--technique", name, "--soft", soft]));
        } else if !sampled.is_empty() {
            all.push([refused, &["--soft", sampled]].concat());
        }
        for way in all {
            eprintln!("{refused:?}: {way:?}");
            assert_success(&render(&way));
            named += 1;
        }
    }
    assert!(named >= 12, "{named} ways are named");
}
