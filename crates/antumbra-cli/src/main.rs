//! `antumbra`, the command-line program: renders and animates scene files with exact shadows, traces their ground truth, checks
//! them and tells what the machine's OpenGL can do. It is built on the public interfaces of the other crates alone.
//!
//! Exit code 0, or 2 with exactly one line on standard error that begins with `error:`; 128 and the number of a signal that ended
//! the program.
#![forbid(unsafe_code)]

mod args;
mod commands;
mod console;
mod draw;
mod error;
mod gallery;
mod output;
mod progress;
mod report;
mod technique;
mod timeline;
mod timing;

use std::process::ExitCode;

fn main() -> ExitCode {
    output::signals::clean_up_on_signals();
    let outcome = args::parse(std::env::args_os()).and_then(commands::run);
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => console::fail(&error),
    }
}
