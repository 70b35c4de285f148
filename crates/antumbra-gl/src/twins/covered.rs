//! That no function of maths in the shaders is without a twin.
//!
//! A function is maths if it reads nothing but what it is given: no texture, uniform, input of its stage or `BLOCKER_DATA`,
//! and calls none that does. It needs a twin of its name in Rust, without `antumbra_`: a function, or for `type_method` that
//! method, for `type_of` that type's `new`. And a test has to call it on a GPU, by itself or through another that calls it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// What only a stage's own functions may name.
const NOT_MATHS: [&str; 4] = ["texelFetch", "textureSize", "BLOCKER_DATA", "gl_"];

fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path()) {
        if entry.is_dir() {
            found.extend(files(&entry, ending));
        } else if entry.to_string_lossy().ends_with(ending) {
            found.push(entry);
        }
    }
    found
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).expect("a source")
}

fn is_name(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

/// The names in a text, each with what follows it.
fn names(text: &str) -> impl Iterator<Item = (&str, &str)> {
    let mut rest = text;
    std::iter::from_fn(move || {
        let start = rest.find(is_name)?;
        let end = start + rest[start..].find(|c| !is_name(c)).unwrap_or(rest.len() - start);
        let name = &rest[start..end];
        rest = &rest[end..];
        Some((name, rest))
    })
}

/// The names that are called.
fn calls(text: &str) -> BTreeSet<String> {
    names(text).filter(|(_, rest)| rest.starts_with('(')).map(|(name, _)| name.to_owned()).collect()
}

/// Without comments.
fn code(text: &str) -> String {
    text.lines().map(|line| line.split("//").next().unwrap_or(line)).collect::<Vec<_>>().join("\n")
}

/// The functions of a shader: name and body. They begin at a line's start and end with a brace there.
fn functions(text: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let heads = line.starts_with(|c: char| c.is_ascii_alphabetic()) && line.contains('(');
        let Some((head, _)) = line.split_once('(').filter(|_| heads && !line.starts_with("layout")) else {
            continue;
        };
        let mut words = head.split_whitespace();
        let (Some(_), Some(name), None) = (words.next(), words.next(), words.next()) else { continue };
        let mut body = line.to_owned();
        if !line.ends_with('}') {
            for line in lines.by_ref().take_while(|line| *line != "}") {
                body.push('\n');
                body.push_str(line);
            }
        }
        found.push((name.to_owned(), body));
    }
    found
}

/// The functions of maths; and of each function of the shaders, which of them it calls.
fn shaders() -> (BTreeSet<String>, BTreeMap<String, BTreeSet<String>>) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/shaders");
    let mut bodies: BTreeMap<String, String> = BTreeMap::new();
    let mut shaders = 0;
    for file in files(&folder, ".glsl") {
        shaders += 1;
        for (name, body) in functions(&code(&read(&file))) {
            // Several of a name, by what is defined: one that is no maths makes none of them maths.
            bodies.entry(name).or_default().push_str(&body);
        }
    }
    assert!(shaders > 30 && bodies.len() > 90, "{shaders} shaders, {} functions", bodies.len());
    let reads = |body: &str| {
        let outside = |name: &str| name.starts_with("u_") || name.starts_with("v_") || name.starts_with("o_");
        names(body).any(|(name, _)| outside(name)) || NOT_MATHS.iter().any(|word| body.contains(word))
    };
    let mut stages: BTreeSet<String> = bodies
        .iter()
        .filter(|(name, body)| *name == "main" || reads(body))
        .map(|(name, _)| name.clone())
        .collect();
    loop {
        let more: Vec<String> = bodies
            .iter()
            .filter(|(name, body)| {
                !stages.contains(*name) && calls(body).iter().any(|call| stages.contains(call))
            })
            .map(|(name, _)| name.clone())
            .collect();
        if more.is_empty() {
            break;
        }
        stages.extend(more);
    }
    let pure: BTreeSet<String> = bodies.keys().filter(|name| !stages.contains(*name)).cloned().collect();
    let called = |body: &String| calls(body).into_iter().filter(|call| bodies.contains_key(call)).collect();
    (pure, bodies.iter().map(|(name, body)| (name.clone(), called(body))).collect())
}

/// The words of a type's name, as functions have them.
fn snake(name: &str) -> String {
    let mut words = String::new();
    for c in name.chars() {
        if c.is_ascii_uppercase() && !words.is_empty() {
            words.push('_');
        }
        words.push(c.to_ascii_lowercase());
    }
    words
}

/// The names of what Rust computes: functions, and methods after their types.
fn rust() -> BTreeSet<String> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = BTreeSet::new();
    for folder in [here.join("src"), here.join("../antumbra-math/src")] {
        for file in files(&folder, ".rs") {
            let mut of = String::new();
            for line in code(&read(&file)).lines() {
                if line.starts_with("impl") {
                    // What the implementation is of: the last name that begins with a capital before a bracket or brace.
                    let head = line.rsplit(" for ").next().unwrap_or(line);
                    let head = head.strip_prefix("impl").map_or(head, |rest| match rest.strip_prefix('<') {
                        Some(rest) => rest.split_once("> ").map_or(rest, |(_, rest)| rest),
                        None => rest,
                    });
                    of = names(head).map(|(name, _)| snake(name)).next().unwrap_or_default();
                } else if line == "}" {
                    of.clear();
                }
                let Some((_, rest)) = line.split_once("fn ") else { continue };
                let Some((name, _)) = names(rest).next() else { continue };
                found.insert(name.to_owned());
                if !of.is_empty() {
                    found.insert(format!("{of}_{name}"));
                    if name == "new" {
                        found.insert(format!("{of}_of"));
                    }
                }
            }
        }
    }
    found
}

/// What the tests beside this one write of shaders: their string literals.
fn shaders_of_tests() -> String {
    let here = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/twins");
    let texts =
        files(&here, ".rs").into_iter().filter(|file| !file.ends_with("covered.rs")).map(|file| read(&file));
    // Literals are every other piece between quotation marks, once those that are escaped are away.
    texts
        .flat_map(|text| {
            text.replace("\\\"", "").split('"').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>()
        })
        .collect()
}

#[test]
fn every_function_of_maths_has_a_twin_that_is_compared() {
    let ((maths, calls_of), rust) = (shaders(), rust());
    let twin = |name: &str| name.strip_prefix("antumbra_").unwrap_or(name).to_owned();
    let without: Vec<&String> = maths.iter().filter(|name| !rust.contains(&twin(name))).collect();
    assert!(without.is_empty(), "no twin in Rust of {without:?}");
    let written = calls(&shaders_of_tests());
    let mut compared: BTreeSet<&String> = calls_of.keys().filter(|name| written.contains(*name)).collect();
    loop {
        let before = compared.len();
        compared.extend(compared.clone().iter().flat_map(|name| &calls_of[*name]));
        if compared.len() == before {
            break;
        }
    }
    let missing: Vec<&String> = maths.iter().filter(|name| !compared.contains(name)).collect();
    let by_themselves = maths.iter().filter(|name| written.contains(*name)).count();
    eprintln!("{} functions of maths, {by_themselves} compared by themselves", maths.len());
    assert!(missing.is_empty(), "no test compares {missing:?}");
    assert!(maths.len() > 50, "they are found: {maths:?}");
}

/// The reading itself.
#[test]
fn what_is_maths_is_told() {
    let text = "uniform float u_x;\nfloat a(float x) {\n    return b(x);\n}\nfloat c() { return u_x; }\nvoid main() {\n}\n";
    let found = functions(text);
    assert_eq!(found.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), ["a", "c", "main"]);
    assert!(calls(&found[0].1).contains("b"), "calls are seen: {:?}", found[0]);
    assert_eq!(snake("PolygonBlocker"), "polygon_blocker");
    let (maths, _) = shaders();
    assert!(maths.contains("half_plane_coverage") && maths.contains("join"), "what reads nothing");
    assert!(!maths.contains("surface_point") && !maths.contains("ball_hidden"), "what reads textures");
}
