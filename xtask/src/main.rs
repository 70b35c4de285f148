//! What people and continuous integration both run: `cargo xtask ci`, and its parts.
#![forbid(unsafe_code)]

mod crates;
mod options;
mod run;
mod setup;
mod steps;

use std::process::ExitCode;

const HELP: &str = "\
What people and continuous integration both run.

Usage: cargo xtask <COMMAND>

Commands:
  setup            Look for what the tests need (software OpenGL through EGL, Xvfb, glslangValidator); install
                   what is missing on Debian and its kin as root or with sudo, else say what to install
  test [ARGS]      setup, then every test in the workspace; ARGS go to `cargo test`, such as `-p antumbra-scene`
                   or `-- name_of_a_test`
  ci               What continuous integration runs: formatting, lints, documentation, each crate by itself, the
                   library for the web, packages, the library's tests with debug assertions, test
  fuzz [--cases N] The tests that feed random input to the readers of scene and mesh files, N scenes to
                   each test (default 1000000, minutes) and a fiftieth of that of meshes
  soak [--cases N] [--rounds N]
                   What takes an hour or more: fuzz, the tests that are ignored because they take minutes, and
                   every test N times (default 3)
  help             This text

Tests draw with the software renderer of Mesa (llvmpipe), so that they give the same everywhere and need no display;
those of the viewer bring one of their own (Xvfb).
To run them on this machine's own driver instead, set ANTUMBRA_HARDWARE=1. Under `cargo xtask test` a missing OpenGL
or Xvfb is a failure; under a bare `cargo test` those tests say that they were skipped.
";

/// Inputs for each fuzz test: minutes on two cores.
const CASES: (&str, u32) = ("--cases", 1_000_000);

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (command, rest) = match arguments.split_first() {
        Some((command, rest)) => (command.as_str(), rest),
        None => ("help", &[][..]),
    };
    let outcome = match (command, rest) {
        ("setup", []) => setup::run(),
        ("test", rest) => steps::test(rest),
        ("ci", []) => steps::ci(),
        ("fuzz", rest) => options::numbers("fuzz", [CASES], rest).and_then(|[cases]| steps::fuzz(cases)),
        ("soak", rest) => options::numbers("soak", [CASES, ("--rounds", 3)], rest)
            .and_then(|[cases, rounds]| steps::soak(cases, rounds)),
        ("help" | "--help" | "-h", _) => {
            print!("{HELP}");
            Ok(())
        }
        (command @ ("setup" | "ci"), [extra, ..]) => Err(format!("`{command}` takes no argument `{extra}`")),
        (unknown, _) => Err(format!("there is no command `{unknown}`; see `cargo xtask help`")),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(what) => {
            eprintln!("error: {what}");
            ExitCode::FAILURE
        }
    }
}
