//! `antumbra animate`: what is in the file, that it moves as the scene does, and what is refused.

mod common;

use std::fs::{self, File};
use std::io::BufReader;
use std::path::Path;

use common::{Place, Png, SCENE, assert_refused, assert_success, json, opengl, stderr, stdout};

/// An orbit, to be appended to [`SCENE`], whose last object is the ball.
fn orbit(period: f64) -> String {
    format!(
        "motion = {{ type = \"orbit\", center = [1.0, 0.9, 0.0], axis = [0.0, 1.0, 0.0], period = {period} }}\n"
    )
}

/// A directory with a scene whose ball goes round in 2 seconds.
fn place() -> Place {
    let place = Place::new();
    place.write("moving.toml", &format!("{SCENE}{}", orbit(2.0)));
    place
}

/// A decoded animation.
struct Animation {
    /// How often it is played; 0 for ever.
    plays: u32,
    /// Seconds.
    delays: Vec<f64>,
    /// Of the part of the picture in each frame.
    pixels: Vec<usize>,
    /// Whole pictures.
    frames: Vec<Vec<[u8; 3]>>,
}

fn read(path: &Path) -> Animation {
    let file = BufReader::new(File::open(path).expect("the animation was written"));
    let mut reader = png::Decoder::new(file).read_info().expect("a PNG");
    let (width, height) = (reader.info().width as usize, reader.info().height as usize);
    let control = *reader.info().animation_control().expect("an animation");
    let mut canvas = vec![[0; 3]; width * height];
    let mut found =
        Animation { plays: control.num_plays, delays: Vec::new(), pixels: Vec::new(), frames: Vec::new() };
    for _ in 0..control.num_frames {
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size in memory")];
        reader.next_frame(&mut bytes).expect("a whole frame");
        let part = *reader.info().frame_control().expect("where it goes");
        assert_eq!(
            (part.dispose_op, part.blend_op),
            (png::DisposeOp::None, png::BlendOp::Source),
            "it stays"
        );
        let (w, h) = (part.width as usize, part.height as usize);
        for (y, row) in bytes.chunks_exact(3 * w).take(h).enumerate() {
            for (x, pixel) in row.chunks_exact(3).enumerate() {
                let at = (y + part.y_offset as usize) * width + x + part.x_offset as usize;
                canvas[at] = [pixel[0], pixel[1], pixel[2]];
            }
        }
        found.delays.push(f64::from(part.delay_num) / f64::from(part.delay_den));
        found.pixels.push(w * h);
        found.frames.push(canvas.clone());
    }
    found
}

/// Every frame is the picture that the other commands make of its moment.
fn frames_are_pictures(extra: &[&str], picture: &[&str]) {
    let place = place();
    let arguments =
        ["animate", "moving.toml", "-o", "a.apng", "--fps", "4", "--from", "0.25", "--size", "96x64"];
    let output = place.run([&arguments, extra, &["--json"]].concat());
    assert_success(&output);
    let report = json(&output);
    assert_eq!(report["frames"], 8, "two seconds at four a second: {report}");
    assert_eq!(report["fps"], 4.0, "as asked for: {report}");
    assert_eq!(report["duration"], 2.0, "the ball's round: {report}");
    assert_eq!(report["seamless"], true, "a whole round: {report}");
    assert_eq!(report["files"], serde_json::json!(["a.apng"]), "what was written: {report}");
    let length = fs::metadata(place.file("a.apng")).expect("it is there").len();
    assert_eq!(report["bytes"], length, "how much: {report}");
    assert_eq!(place.entries(), ["a.apng", "moving.toml", "scene.toml"], "nothing else");

    let animation = read(&place.file("a.apng"));
    assert_eq!(animation.plays, 0, "for ever");
    assert_eq!(animation.delays, [0.25; 8], "a quarter of a second each");
    assert_eq!(animation.frames.len(), 8, "all frames");
    for (frame, time) in [(0, "0.25"), (1, "0.5"), (5, "1.5"), (7, "2.0")] {
        let arguments = ["moving.toml", "-o", "a.png", "--time", time, "--size", "96x64"];
        assert_success(&place.run([picture, &arguments].concat()));
        let picture = Png::read(&place.file("a.png")).rgb();
        assert!(animation.frames[frame] == picture, "frame {frame} is the picture at {time} s");
    }
    for pair in animation.frames.windows(2) {
        let moved = pair[0].iter().zip(&pair[1]).filter(|(a, b)| a != b).count();
        assert!(moved > 100, "{moved} pixels moved");
    }
    assert_eq!(animation.pixels[0], 96 * 64, "the first frame is whole");
    assert!(animation.pixels[1..].iter().all(|pixels| *pixels < 96 * 64), "the others are what changed");
    // What knows no animation shows the first frame.
    assert!(Png::read(&place.file("a.apng")).rgb() == animation.frames[0], "a PNG like any other");
}

#[test]
fn frames_drawn_with_opengl() {
    if !opengl(&Place::new()) {
        return;
    }
    frames_are_pictures(&[], &["render"]);
    frames_are_pictures(
        &["--technique", "map", "--msaa", "1"],
        &["render", "--technique", "map", "--msaa", "1"],
    );
}

#[test]
fn frames_traced_on_the_cpu() {
    frames_are_pictures(&["--technique", "raytraced", "--msaa", "2"], &["trace", "--samples", "2"]);
}

#[test]
fn numbers_of_frames() {
    let place = place();
    let scene = fs::read_to_string(place.file("moving.toml")).expect("it was written");
    let lamp = "[[object]]\nname = \"moon\"\nshape = { type = \"sphere\", radius = 0.2 }\n";
    place.write("both.toml", &format!("{scene}{lamp}{}", orbit(-3.0)));
    place.write("uneven.toml", &format!("{scene}{lamp}{}", orbit(141.0)));
    let run = |scene: &str, extra: &[&str]| {
        let fast = ["--technique", "raytraced", "--msaa", "1", "--size", "12x8", "--json"];
        let output = place.run([&["animate", scene, "-o", "a.png"], extra, &fast].concat());
        assert_eq!(output.status.code(), Some(0), "{scene} {extra:?}: {}", stderr(&output));
        let animation = read(&place.file("a.png"));
        assert_eq!(json(&output)["frames"], animation.frames.len(), "{scene} {extra:?}");
        (animation.frames.len(), animation.delays[0], json(&output)["seamless"] == true, stderr(&output))
    };
    let quiet = String::new;
    assert_eq!(run("moving.toml", &[]), (40, 0.05, true, quiet()), "a round at 20 a second");
    assert_eq!(run("both.toml", &["--fps", "2"]), (12, 0.5, true, quiet()), "2 and 3 seconds are 6");
    assert_eq!(run("moving.toml", &["--frames", "5"]), (5, 0.4, true, quiet()), "a round in five frames");
    assert_eq!(run("moving.toml", &["--frames", "1"]), (1, 2.0, true, quiet()), "one is enough");
    assert_eq!(
        run("moving.toml", &["--frames", "3", "--fps", "10"]),
        (3, 0.1, false, quiet()),
        "a part of a round"
    );
    assert_eq!(
        run("moving.toml", &["--duration", "1.5", "--fps", "4"]),
        (6, 0.25, false, quiet()),
        "a part of a round"
    );
    let (frames, delay, seamless, note) = run("uneven.toml", &["--frames", "3"]);
    assert_eq!((frames, delay, seamless), (3, 47.0, false), "the longest, where all take too long");
    assert!(note.starts_with("note: ") && note.contains("--duration 282"), "says so: {note}");
    assert_eq!(note.lines().count(), 1, "in one line: {note}");

    let text =
        place.run(["animate", "moving.toml", "-o", "a.png", "--frames", "2", "--technique", "raytraced"]);
    assert_success(&text);
    assert!(stdout(&text).contains("2 frames of 48x32, 2.000 s"), "in words: {}", stdout(&text));
}

#[test]
fn what_cannot_be_animated() {
    let place = place();
    place.write("long.toml", &format!("{SCENE}{}", orbit(1e6)));
    place.write("short.toml", &format!("{SCENE}{}", orbit(0.01)));
    let torus = "shape = { type = \"torus\", major_radius = 0.7, minor_radius = 0.2 }";
    let ball = "shape = { type = \"sphere\", radius = 0.7 }";
    place.write("torus.toml", &format!("{}{}", SCENE.replace(ball, torus), orbit(2.0)));
    fs::create_dir(place.file("folder.png")).expect("writable");
    let before = place.entries();
    let mut cases: Vec<(&[&str], &str)> = vec![
        (&["scene.toml", "-o", "a.apng"], "nothing in the scene moves"),
        (&["missing.toml", "-o", "a.apng"], "missing.toml"),
        (&["moving.toml"], "--output"),
        (&["moving.toml", "-o", "a.gif"], "end the name in .apng or .png"),
        (&["moving.toml", "-o", "a.exr"], "end the name in .apng or .png"),
        (&["moving.toml", "-o", "a"], "end the name in .apng or .png"),
        (&["moving.toml", "-o", "folder.png"], "is a directory; name a file, such as picture.apng"),
        (&["moving.toml", "-o", "missing/a.png"], "there is no such directory; make it first"),
        (&["long.toml", "-o", "a.png"], "too many frames"),
        (&["short.toml", "-o", "a.png"], "less than two frames"),
        (&["long.toml", "-o", "a.png", "--frames", "2"], "a second"),
        (&["moving.toml", "-o", "a.png", "--frames", "0"], "from 1 to 10000"),
        (&["moving.toml", "-o", "a.png", "--frames", "-3"], "from 1 to 10000"),
        (&["moving.toml", "-o", "a.png", "--frames", "10001"], "from 1 to 10000"),
        (&["moving.toml", "-o", "a.png", "--fps", "0"], "frames a second, from 0.001 to 100"),
        (&["moving.toml", "-o", "a.png", "--fps", "nan"], "frames a second, from 0.001 to 100"),
        (&["moving.toml", "-o", "a.png", "--duration", "0"], "from 1e-3 to 1e9"),
        (&["moving.toml", "-o", "a.png", "--duration", "-1"], "from 1e-3 to 1e9"),
        (&["moving.toml", "-o", "a.png", "--duration", "inf"], "from 1e-3 to 1e9"),
        (&["moving.toml", "-o", "a.png", "--from", "nan"], "finite number of seconds"),
        (
            &["moving.toml", "-o", "a.png", "--frames", "2", "--fps", "1", "--duration", "2"],
            "give two, and the third follows",
        ),
        (&["moving.toml", "-o", "a.png", "--size", "0x1"], "at least 1x1"),
        (&["moving.toml", "-o", "a.png", "--technique", "magic"], "the techniques are analytic"),
        (&["moving.toml", "-o", "a.png", "--shade", "paper"], "no option `shade=paper`"),
        (&["moving.toml", "-o", "a.png", "--technique", "raytraced", "--soft", "samples:4"], "--msaa N"),
        (&["moving.toml", "-o", "a.png", "--time", "1"], "'--time'"),
    ];
    if opengl(&place) {
        cases.push((&["torus.toml", "-o", "a.png"], "object \"ball\""));
    }
    for (arguments, text) in cases {
        eprintln!("antumbra animate {}", arguments.join(" "));
        assert_refused(&place.run([&["animate"], arguments].concat()), text);
        assert_eq!(place.entries(), before, "nothing is written");
    }
    let output = place
        .command(["animate", "moving.toml", "-o", "a.png"])
        .env("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent")
        .env("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json")
        .output()
        .expect("the program starts");
    assert_refused(&output, "--technique raytraced");
    assert_eq!(place.entries(), before, "nothing is written");
}
