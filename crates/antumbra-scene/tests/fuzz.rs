//! No input makes the reader of scene files panic, hang or return a scene that cannot be drawn.
//!
//! `ANTUMBRA_FUZZ_CASES` sets the number of inputs of each test; the default is for every day.
//! A million and more each:
//!
//! ```sh
//! ANTUMBRA_FUZZ_CASES=1000000 cargo test --release -p antumbra-scene --test fuzz -- --nocapture
//! ```

mod common;
#[path = "common/written.rs"]
mod written;

use std::path::Path;
use std::time::{Duration, Instant};

use antumbra_scene::Scene;
use proptest::prelude::*;
use proptest::sample::Index;
use proptest::test_runner::{Config, TestRunner};

/// No single input may take longer. They are a few kilobytes and take tens of microseconds; the rest
/// is room for a busy machine.
const LONGEST: Duration = Duration::from_secs(5);

/// Scene files to start from.
fn seeds() -> Vec<String> {
    let mut seeds = vec![common::EVERYTHING.to_owned()];
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut files: Vec<_> =
        std::fs::read_dir(folder).expect("the gallery").flatten().map(|e| e.path()).collect();
    files.sort();
    for file in files {
        if file.extension().is_some_and(|e| e == "toml") {
            seeds.push(std::fs::read_to_string(file).expect("a scene of the gallery"));
        }
    }
    seeds
}

/// Parses and checks; true if the bytes are a scene with something in it.
fn survives(bytes: &[u8]) -> bool {
    let start = Instant::now();
    let result = Scene::from_bytes(bytes, Path::new("no/such/folder/fuzz.toml"));
    match &result {
        Ok(scene) => {
            for time in [0.0, 1.3, -1e300, f64::NAN] {
                common::assert_sound(scene, time);
            }
            let _ = written::assert_written(scene, core::str::from_utf8(bytes).expect("a scene is text"));
        }
        Err(error) => {
            let line = error.to_string();
            assert!(!line.contains(['\n', '\r', '\u{1b}']), "{line:?} is more than one plain line");
            assert!(line.len() < 4000 && line.contains("; "), "{line:?} says too much or too little");
            let (row, column) = error.place().expect("an error in a file has a place");
            let rows = bytes.iter().filter(|b| **b == b'\n').count() + 1;
            assert!((1..=rows).contains(&row) && (1..=bytes.len() + 1).contains(&column), "{line}");
        }
    }
    assert!(start.elapsed() < LONGEST, "took {:?}", start.elapsed());
    result.is_ok_and(|scene| !(scene.lights.is_empty() && scene.objects.is_empty()))
}

/// Runs `cases` inputs and says how many there were and how many were scenes; returns the share of those.
fn run<S: Strategy>(name: &str, cases: u32, strategy: S, test: impl Fn(S::Value) -> bool) -> f64 {
    let cases = std::env::var("ANTUMBRA_FUZZ_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(cases);
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    let (start, valid) = (Instant::now(), std::cell::Cell::new(0u32));
    TestRunner::new(config)
        .run(&strategy, |input| {
            valid.set(valid.get() + u32::from(test(input)));
            Ok(())
        })
        .unwrap_or_else(|e| panic!("{name}: {e}"));
    println!("{name}: {cases} inputs, {} of them scenes, in {:.1?}", valid.get(), start.elapsed());
    f64::from(valid.get()) / f64::from(cases.max(1))
}

#[test]
fn raw_bytes() {
    let noise = proptest::collection::vec(any::<u8>(), 0..300);
    let tomlish = proptest::collection::vec(
        prop_oneof![
            4 => prop::sample::select(br#"[]{}=.,"'#-+_ e019"#.as_slice()),
            1 => prop::sample::select(b"\n\t\r\\abx".as_slice()),
        ],
        0..300,
    );
    // Hardly any of them is a scene.
    let _ = run("raw bytes", 20_000, prop_oneof![noise, tomlish], |bytes| survives(&bytes));
}

/// One change to a file.
#[derive(Clone, Debug)]
enum Edit {
    Flip(Index, u8),
    Delete(Index, usize),
    Insert(Index, Vec<u8>),
    SwapTokens(Index, Index),
    ReplaceToken(Index, &'static str),
    RepeatLine(Index, Index),
    Truncate(Index),
}

fn edit() -> impl Strategy<Value = Edit> {
    let tokens = [
        "nan",
        "inf",
        "-inf",
        "0",
        "-0.0",
        "-1",
        "1e999",
        "1e300",
        "-1e300",
        "1e-300",
        "5e-324",
        "true",
        "\"\"",
        "[]",
        "{}",
        "\"point\"",
        "\"mesh\"",
        "\"plane\"",
        "[[object]]",
        "[[light]]",
        "[camera]",
        "99999999999999999999",
        "0x7fffffffffffffff",
        "1979-05-27",
        "position",
        "radius",
        "shape",
        "parts",
        "=",
        ",",
        "[",
        "]",
        "{",
        "}",
        "\n",
        "\"../../x\"",
        "'''",
        "\u{feff}",
        "\u{202e}",
        "\0",
    ];
    prop_oneof![
        (any::<Index>(), 0u8..8).prop_map(|(at, bit)| Edit::Flip(at, bit)),
        (any::<Index>(), 1usize..40).prop_map(|(at, n)| Edit::Delete(at, n)),
        (any::<Index>(), proptest::collection::vec(any::<u8>(), 1..6))
            .prop_map(|(at, b)| Edit::Insert(at, b)),
        (any::<Index>(), any::<Index>()).prop_map(|(a, b)| Edit::SwapTokens(a, b)),
        (any::<Index>(), prop::sample::select(tokens.to_vec())).prop_map(|(at, t)| Edit::ReplaceToken(at, t)),
        (any::<Index>(), any::<Index>()).prop_map(|(a, b)| Edit::RepeatLine(a, b)),
        any::<Index>().prop_map(Edit::Truncate),
    ]
}

/// The spans of the words, numbers and signs of a file.
fn tokens(bytes: &[u8]) -> Vec<(usize, usize)> {
    let wordy = |b: u8| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'.' | b'-' | b'+' | b'"');
    let mut spans = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let end = at + bytes[at..].iter().take_while(|b| wordy(**b)).count().max(1);
        if !bytes[at].is_ascii_whitespace() {
            spans.push((at, end));
        }
        at = end;
    }
    spans
}

fn apply(bytes: &mut Vec<u8>, edit: &Edit) {
    if bytes.is_empty() {
        return;
    }
    match edit {
        Edit::Flip(at, bit) => {
            let at = at.index(bytes.len());
            bytes[at] ^= 1 << bit;
        }
        Edit::Delete(at, n) => {
            let at = at.index(bytes.len());
            bytes.drain(at..(at + n).min(bytes.len()));
        }
        Edit::Insert(at, new) => {
            let at = at.index(bytes.len());
            bytes.splice(at..at, new.iter().copied());
        }
        Edit::Truncate(at) => bytes.truncate(at.index(bytes.len())),
        Edit::SwapTokens(..) | Edit::ReplaceToken(..) => {
            let spans = tokens(bytes);
            if spans.is_empty() {
                return;
            }
            match edit {
                Edit::SwapTokens(a, b) => {
                    let (a, b) = (spans[a.index(spans.len())], spans[b.index(spans.len())]);
                    let ((a0, a1), (b0, b1)) = if a < b { (a, b) } else { (b, a) };
                    if a1 <= b0 {
                        let swapped = [&bytes[b0..b1], &bytes[a1..b0], &bytes[a0..a1]].concat();
                        bytes.splice(a0..b1, swapped);
                    }
                }
                Edit::ReplaceToken(at, new) => {
                    let (from, to) = spans[at.index(spans.len())];
                    bytes.splice(from..to, new.bytes());
                }
                _ => {}
            }
        }
        Edit::RepeatLine(from, to) => {
            let mut lines: Vec<Vec<u8>> =
                bytes.split_inclusive(|b| *b == b'\n').map(<[u8]>::to_vec).collect();
            let line = lines[from.index(lines.len())].clone();
            let to = to.index(lines.len());
            lines.insert(to, line);
            *bytes = lines.concat();
        }
    }
}

#[test]
fn mutated_scenes() {
    let seeds = seeds();
    for seed in &seeds {
        assert!(survives(seed.as_bytes()), "a seed must be a scene");
        let scene = Scene::parse(seed, Path::new("no/such/folder/fuzz.toml")).expect("a scene");
        assert!(written::assert_written(&scene, seed), "and is one when it is changed");
    }
    let inputs = (any::<Index>(), proptest::collection::vec(edit(), 1..4));
    let scenes = run("mutated scenes", 15_000, inputs, |(seed, edits)| {
        let mut bytes = seeds[seed.index(seeds.len())].clone().into_bytes();
        edits.iter().for_each(|e| apply(&mut bytes, e));
        survives(&bytes)
    });
    assert!(scenes > 0.03, "some are scenes still: {scenes}");
}

/// A number as a file could write it: mostly sensible, sometimes anything.
fn number() -> impl Strategy<Value = String> {
    prop_oneof![
        12 => (-10.0f64..10.0).prop_map(|n| format!("{n:?}")),
        3 => (0.01f64..1.0).prop_map(|n| format!("{n:?}")),
        3 => (-3i64..20).prop_map(|n| n.to_string()),
        1 => any::<f64>().prop_map(|n| format!("{n:?}").to_lowercase()),
        1 => any::<i64>().prop_map(|n| n.to_string()),
        1 => prop::sample::select(vec!["nan", "inf", "-inf", "0", "-0.0", "1e6", "-1e6", "1e-6", "9e-7", "1e7", "1e308"]).prop_map(str::to_owned),
    ]
}

fn vector(n: usize) -> impl Strategy<Value = String> {
    let exact = proptest::collection::vec(number(), n);
    let any_length = proptest::collection::vec(number(), 0..5);
    prop_oneof![30 => exact, 1 => any_length].prop_map(|v| format!("[{}]", v.join(", ")))
}

/// Any value a key could get.
fn value(key: &'static str) -> BoxedStrategy<String> {
    let flag = prop::sample::select(vec!["true".to_owned(), "false".to_owned(), "1".to_owned()]);
    match key {
        "name" => "[a-zA-Z./]{0,3}".prop_map(|s| format!("{s:?}")).boxed(),
        "rotation" => vector(4).boxed(),
        "casts_shadow" | "receives_shadow" => flag.boxed(),
        "shape" => shape().boxed(),
        "parts" => proptest::collection::vec(
            (shape(), vector(3), vector(4))
                .prop_map(|(s, t, r)| format!("{{ shape = {s}, translation = {t}, rotation = {r} }}")),
            0..4,
        )
        .prop_map(|v| format!("[{}]", v.join(", ")))
        .boxed(),
        "motion" => motion().boxed(),
        "intensity" | "radius" | "width" | "height" | "inner_angle" | "outer_angle" | "fov_y"
        | "exposure" => number().boxed(),
        _ => vector(3).boxed(),
    }
}

fn motion() -> impl Strategy<Value = String> {
    let orbit = (vector(3), vector(3), number())
        .prop_map(|(c, a, p)| format!("{{ type = \"orbit\", center = {c}, axis = {a}, period = {p} }}"));
    let path = (proptest::collection::vec(vector(3), 1..5), number())
        .prop_map(|(v, p)| format!("{{ type = \"path\", points = [{}], period = {p} }}", v.join(", ")));
    prop_oneof![orbit, path]
}

fn shape() -> impl Strategy<Value = String> {
    let with = |kind: &'static str, keys: &'static [&'static str]| {
        proptest::collection::vec(number(), keys.len()).prop_map(move |values| {
            let keys: String = keys.iter().zip(values).map(|(k, v)| format!(", {k} = {v}")).collect();
            format!("{{ type = \"{kind}\"{keys} }}")
        })
    };
    prop_oneof![
        with("plane", &[]),
        with("rectangle", &["width", "depth"]),
        with("disc", &["radius"]),
        (vector(3), vector(3), vector(3))
            .prop_map(|(a, b, c)| format!("{{ type = \"triangle\", vertices = [{a}, {b}, {c}] }}")),
        with("sphere", &["radius"]),
        vector(3).prop_map(|v| format!("{{ type = \"ellipsoid\", radii = {v} }}")),
        with("cone", &["radius", "height"]),
        prop_oneof![
            with("cylinder", &["radius", "height"]),
            with("cylinder", &["radius", "height", "radius_top"])
        ],
        with("capsule", &["radius", "height"]),
        vector(3).prop_map(|v| format!("{{ type = \"box\", size = {v} }}")),
        with("torus", &["major_radius", "minor_radius"]),
        "[a-z./]{0,9}".prop_map(|p| format!("{{ type = \"mesh\", path = {p:?} }}")),
    ]
}

/// `key = value` lines: the given keys, each there with a chance of `often` in 20.
fn entries(keys: &'static [(&'static str, u32)]) -> impl Strategy<Value = String> {
    let lines: Vec<BoxedStrategy<String>> = keys
        .iter()
        .map(|(key, often)| {
            prop_oneof![
                *often => value(key).prop_map(move |v| format!("{key} = {v}\n")),
                20 - *often => Just(String::new()),
            ]
            .boxed()
        })
        .collect();
    lines.prop_map(|lines| lines.concat())
}

fn structured() -> impl Strategy<Value = String> {
    let camera = entries(&[("eye", 19), ("target", 10), ("up", 10), ("fov_y", 10)]);
    let kinds = prop_oneof![
        Just("point").prop_flat_map(|k| entries(&[
            ("name", 19),
            ("position", 19),
            ("intensity", 19),
            ("motion", 8),
            ("color", 8)
        ])
        .prop_map(move |e| (k, e))),
        Just("directional").prop_flat_map(
            |k| entries(&[("name", 19), ("direction", 19), ("intensity", 19)]).prop_map(move |e| (k, e))
        ),
        Just("spot").prop_flat_map(|k| entries(&[
            ("name", 19),
            ("position", 19),
            ("direction", 19),
            ("intensity", 19),
            ("inner_angle", 4),
            ("outer_angle", 4)
        ])
        .prop_map(move |e| (k, e))),
        Just("sphere").prop_flat_map(|k| entries(&[
            ("name", 19),
            ("position", 19),
            ("radius", 19),
            ("intensity", 19)
        ])
        .prop_map(move |e| (k, e))),
        Just("disc").prop_flat_map(|k| entries(&[
            ("name", 19),
            ("position", 19),
            ("direction", 19),
            ("radius", 19),
            ("intensity", 19)
        ])
        .prop_map(move |e| (k, e))),
        Just("rectangle").prop_flat_map(|k| entries(&[
            ("name", 19),
            ("position", 19),
            ("direction", 19),
            ("right", 19),
            ("width", 19),
            ("height", 19),
            ("intensity", 19)
        ])
        .prop_map(move |e| (k, e))),
    ]
    .prop_map(|(kind, e)| format!("[[light]]\ntype = \"{kind}\"\n{e}"));
    let object = prop_oneof![
        entries(&[
            ("name", 19),
            ("shape", 19),
            ("translation", 8),
            ("rotation", 8),
            ("color", 2),
            ("casts_shadow", 2),
            ("motion", 5)
        ]),
        entries(&[("name", 19), ("parts", 19), ("translation", 8), ("rotation", 8), ("receives_shadow", 2)]),
    ]
    .prop_map(|e| format!("[[object]]\n{e}"));
    let items = proptest::collection::vec(prop_oneof![kinds, object], 0..3);
    (camera, items).prop_map(|(camera, items)| format!("[camera]\n{camera}{}", items.concat()))
}

#[test]
fn structured_values() {
    let scenes = run("structured values", 10_000, structured(), |text| survives(text.as_bytes()));
    assert!(scenes > 0.01, "some are scenes: {scenes}");
}

#[test]
fn hostile_sizes() {
    use antumbra_scene::limits::MAX_SCENE_BYTES as MOST;
    let repeat = |piece: &str| piece.repeat(MOST / piece.len());
    for (name, text) in [
        ("brackets", repeat("[")),
        ("braces", repeat("a={")),
        ("nested arrays", format!("a = {}", repeat("[")[..MOST - 4].to_owned())),
        ("closed arrays", format!("a = {}{}", "[".repeat(MOST / 2 - 2), "]".repeat(MOST / 2 - 2))),
        ("dotted key", format!("{}a = 1", repeat("a.")[..MOST - 6].to_owned())),
        ("dotted header", format!("[{}a]", repeat("a.")[..MOST - 4].to_owned())),
        ("spaced dots", format!("{}a = 1", repeat("a . ")[..MOST - 8].to_owned())),
        ("quoted dots", format!("{}a = 1", repeat("\"a\".")[..MOST - 8].to_owned())),
        ("dots in braces", format!("a = {}", repeat("{a.a.a.a.a.a.a.a=")[..MOST - 17].to_owned())),
        (
            "many keys",
            (0..MOST / 14).map(|i| format!("k{i} = {i}\n")).collect::<String>()[..MOST - 40].to_owned(),
        ),
        ("same key", repeat("a = 1\n")),
        ("many tables", repeat("[[light]]\n")),
        ("many objects", repeat("[[object]]\nname=\"a\"\n")),
        ("headers", repeat("[a.b.c.d.e.f.g.h]\n")),
        ("array", format!("ambient = [{}]", repeat("1,")[..MOST - 14].to_owned())),
        ("string", format!("ambient = \"{}\"", "x".repeat(MOST - 13))),
        ("long name", format!("[camera]\neye=[1,1,1]\n[[light]]\nname=\"{}\"", "x".repeat(MOST - 60))),
        ("long key", format!("{} = 1", "x".repeat(MOST - 4))),
        ("digits", format!("ambient = {}", "9".repeat(MOST - 10))),
        ("fraction", format!("ambient = [0.{}, 1, 1]", "9".repeat(MOST - 30))),
        ("newlines", "\n".repeat(MOST)),
        ("comments", repeat("#\n")),
        ("quotes", repeat("\"")),
        ("too long", "#".repeat(MOST + 1)),
    ] {
        let start = Instant::now();
        let result = Scene::from_bytes(text.as_bytes(), Path::new("fuzz.toml"));
        let error = result.expect_err(name).to_string();
        assert!(error.len() < 2000, "{name}: an error of {} bytes", error.len());
        // 2 MiB take well under a second each; the rest is room for a busy machine.
        assert!(start.elapsed() < Duration::from_secs(20), "{name} took {:?}", start.elapsed());
    }
}
