//! The steps of continuous integration and of the long checks, each a run of cargo.

use std::path::Path;

use crate::crates::Crate;
use crate::run::cargo;
use crate::{crates, setup};

/// The crates that make up the library: what a host builds in, and what its truth is.
const LIBRARY: [&str; 5] =
    ["antumbra", "antumbra-gl", "antumbra-math", "antumbra-reference", "antumbra-scene"];

/// Runs every test in the workspace; `arguments` go to `cargo test`.
///
/// # Errors
/// What is missing, or that a test failed.
pub(crate) fn test(arguments: &[String]) -> Result<(), String> {
    setup::run()?;
    let mut words = vec!["test", "--release"];
    // `-p` and the like choose packages; without one, all are meant and not the program alone.
    let chosen =
        |word: &&String| matches!(word.as_str(), "-p" | "--package" | "--workspace" | "--manifest-path");
    if arguments.iter().take_while(|word| *word != "--").find(chosen).is_none() {
        words.push("--workspace");
    }
    words.extend(arguments.iter().map(String::as_str));
    cargo(&words, &test_environment())
}

/// Runs what continuous integration runs, the quick steps first.
///
/// # Errors
/// The first step that failed.
pub(crate) fn ci() -> Result<(), String> {
    setup::run()?;
    cargo(&["fmt", "--all", "--check"], &[])?;
    // The release profile throughout: what the lints need checked of the dependencies is shared by the documentation
    // and by the crates alone.
    cargo(&["clippy", "--locked", "--release", "--workspace", "--all-targets", "--", "-D", "warnings"], &[])?;
    cargo(&["doc", "--locked", "--release", "--workspace", "--no-deps"], &[("RUSTDOCFLAGS", "-D warnings")])?;
    let crates = crates::all(Path::new("."))?;
    for words in alone(&crates) {
        cargo(&words, &[])?;
    }
    web()?;
    cargo(&package(&crates), &[])?;
    cargo(&checked(), &test_environment())?;
    cargo(&["test", "--locked", "--release", "--workspace"], &test_environment())
}

/// Each crate by itself, with each set of its features: in the workspace, features that one crate forgot to ask for
/// come from another.
fn alone(crates: &[Crate]) -> Vec<Vec<&str>> {
    let check = |name, features: &'static [&str]| {
        let mut words = vec!["check", "--locked", "--release", "--quiet", "--package", name];
        words.extend(features);
        words
    };
    let mut steps = Vec::new();
    for each in crates {
        steps.push(check(each.name.as_str(), &[]));
        if each.has_features {
            steps.push(check(each.name.as_str(), &["--no-default-features"]));
            steps.push(check(each.name.as_str(), &["--all-features"]));
        }
    }
    steps
}

/// The library compiles for the web.
fn web() -> Result<(), String> {
    if let Err(why) = setup::target(setup::WEB) {
        println!("\nNOT CHECKED: whether the library compiles for the web: {why}");
        return Ok(());
    }
    cargo(&["check", "--locked", "--release", "--package", "antumbra", "--target", setup::WEB], &[])
}

/// Whether what is published can be: manifests that are complete, files that are there. The crates were built above.
fn package(crates: &[Crate]) -> Vec<&str> {
    let mut words = vec!["package", "--locked", "--no-verify", "--allow-dirty", "--quiet"];
    for each in crates.iter().filter(|each| each.is_published) {
        words.extend(["--package", &each.name]);
    }
    words
}

/// The library's own tests once more, where an overflow and a broken invariant are a panic. What draws in the integration
/// tests takes minutes and is left to the release build, and so are the shaders, in which nothing of it shows.
fn checked() -> Vec<&'static str> {
    let mut words = vec!["test", "--locked", "--profile", "checked", "--lib"];
    for name in LIBRARY {
        words.extend(["--package", name]);
    }
    words.extend(["--", "--skip", "program_tests"]);
    words
}

/// Runs what takes longer than continuous integration may: random input to the readers, the tests that are ignored
/// because they take minutes, and then every test, time and again.
///
/// # Errors
/// The first step that failed.
pub(crate) fn soak(cases: u32, rounds: u32) -> Result<(), String> {
    setup::run()?;
    fuzz(cases)?;
    // All that is ignored, but for the viewer's tour: it makes pictures and measures, and checks nothing.
    let ignored = ["--", "--ignored", "--nocapture", "--skip", "tour::"];
    let words = ["test", "--locked", "--release", "--workspace"];
    cargo(&[&words[..], &ignored].concat(), &test_environment())?;
    for round in 1..=rounds {
        println!("\nround {round} of {rounds}");
        cargo(&words, &test_environment())?;
    }
    Ok(())
}

/// Runs the tests that feed random input to the readers of scene and mesh files. A mesh is a file on disk and takes
/// fifty times as long as a scene in memory, so there are fewer of them.
///
/// # Errors
/// That one failed.
pub(crate) fn fuzz(cases: u32) -> Result<(), String> {
    for (test, cases) in [("fuzz", cases), ("meshes", cases.div_ceil(50))] {
        cargo(
            &["test", "--release", "--package", "antumbra-scene", "--test", test, "--", "--nocapture"],
            &[("ANTUMBRA_FUZZ_CASES", &cases.to_string())],
        )?;
    }
    Ok(())
}

/// OpenGL must be there, and is the software renderer, which gives the same on every machine.
fn test_environment() -> Vec<(&'static str, &'static str)> {
    let mut variables = vec![("ANTUMBRA_REQUIRE_GL", "1")];
    if std::env::var_os("ANTUMBRA_HARDWARE").is_none() {
        variables.push(("LIBGL_ALWAYS_SOFTWARE", "1"));
    }
    variables
}

#[cfg(test)]
mod tests {
    use super::*;

    fn workspace() -> Vec<Crate> {
        crates::all(&Path::new(env!("CARGO_MANIFEST_DIR")).join("..")).expect("the workspace is here")
    }

    #[test]
    fn every_crate_is_checked_alone_and_what_has_features_with_and_without() {
        let crates = workspace();
        let steps = alone(&crates);
        let of = |name: &str| -> Vec<_> { steps.iter().filter(|words| words.contains(&name)).collect() };
        assert!(LIBRARY.iter().all(|name| of(name).len() == 1), "the library's crates, once each");
        let program = of("antumbra-cli");
        assert_eq!(program.len(), 3, "the program has a feature");
        assert!(
            program.iter().any(|words| words.contains(&"--no-default-features")),
            "and is checked without"
        );
        assert!(steps.iter().all(|words| words.contains(&"--locked")), "with the versions that are tested");
    }

    #[test]
    fn what_is_published_is_packaged() {
        let crates = workspace();
        let words = package(&crates);
        assert!(LIBRARY.iter().all(|name| words.contains(name)), "the library: {words:?}");
        assert!(!words.contains(&"xtask"), "this program is not published");
    }

    #[test]
    fn the_library_is_tested_where_overflows_panic() {
        let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("../Cargo.toml");
        let manifest = std::fs::read_to_string(manifest).expect("the workspace has a manifest");
        let (_, profile) = manifest.split_once("[profile.checked]").expect("the profile is there");
        for setting in ["debug-assertions = true", "overflow-checks = true"] {
            assert!(profile.contains(setting), "{setting}");
        }
        assert!(
            checked().windows(2).any(|pair| pair == ["--profile", "checked"]),
            "and is what the step builds"
        );
    }
}
