//! The steps of continuous integration, each a run of cargo.

use std::ffi::OsString;
use std::process::Command;
use std::time::Instant;

use crate::setup;

/// Inputs for each fuzz test where `--cases` does not say: minutes on two cores.
const FUZZ_CASES: u32 = 1_000_000;

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
    // The release profile throughout: what the lints need checked of the dependencies is shared by the documentation.
    cargo(&["clippy", "--locked", "--release", "--workspace", "--all-targets", "--", "-D", "warnings"], &[])?;
    cargo(&["doc", "--locked", "--release", "--workspace", "--no-deps"], &[("RUSTDOCFLAGS", "-D warnings")])?;
    cargo(&["test", "--locked", "--release", "--workspace"], &test_environment())
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

/// Reads `--cases N`.
///
/// # Errors
/// What to write instead.
pub(crate) fn cases(arguments: &[String]) -> Result<u32, String> {
    let number = match arguments {
        [] => return Ok(FUZZ_CASES),
        [option, number] if option == "--cases" => Some(number.as_str()),
        [option] => option.strip_prefix("--cases="),
        _ => None,
    };
    number
        .and_then(|number| number.parse().ok())
        .filter(|&number| number > 0)
        .ok_or_else(|| "`fuzz` takes `--cases N`, N a whole number from 1 to 4294967295".to_owned())
}

/// OpenGL must be there, and is the software renderer, which gives the same on every machine.
fn test_environment() -> Vec<(&'static str, &'static str)> {
    let mut variables = vec![("ANTUMBRA_REQUIRE_GL", "1")];
    if std::env::var_os("ANTUMBRA_HARDWARE").is_none() {
        variables.push(("LIBGL_ALWAYS_SOFTWARE", "1"));
    }
    variables
}

fn cargo(arguments: &[&str], environment: &[(&str, &str)]) -> Result<(), String> {
    let variables: String = environment.iter().map(|(name, value)| format!("{name}='{value}' ")).collect();
    let line = format!("{variables}cargo {}", arguments.join(" "));
    println!("\n$ {line}");
    let start = Instant::now();
    let program = std::env::var_os("CARGO").unwrap_or_else(|| OsString::from("cargo"));
    let status = Command::new(program)
        .args(arguments)
        .envs(environment.iter().copied())
        .status()
        .map_err(|error| format!("cargo did not start: {error}"))?;
    if !status.success() {
        return Err(format!("`{line}` failed"));
    }
    println!("  took {:.0} s", start.elapsed().as_secs_f64());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fuzz_cases() {
        let read = |words: &[&str]| cases(&words.iter().map(|word| (*word).to_owned()).collect::<Vec<_>>());
        assert_eq!(read(&[]), Ok(FUZZ_CASES), "the default");
        assert_eq!(read(&["--cases", "5"]), Ok(5), "two words");
        assert_eq!(read(&["--cases=5"]), Ok(5), "one word");
        for wrong in [&["--cases"][..], &["--cases", "0"], &["--cases", "-1"], &["5"], &["--cases", "5", "6"]]
        {
            assert!(read(wrong).is_err(), "{wrong:?} is wrong");
        }
    }
}
