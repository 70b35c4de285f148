//! Standard output that goes away or fills up, and signals.
#![cfg(unix)]

mod common;

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use common::{Place, SCENE, assert_refused, stderr};

#[test]
fn a_reader_that_went_away_is_no_error() {
    let place = Place::new();
    for arguments in [
        ["--help"].as_slice(),
        &["check", "scene.toml"],
        &["info"],
        &["trace", "scene.toml", "-o", "a.png", "--samples", "1", "--json"],
    ] {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let output = place.command(arguments).stdout(writer).output().expect("the program starts");
        assert_eq!(output.status.code(), Some(0), "{arguments:?} ends quietly: {}", stderr(&output));
        assert_eq!(stderr(&output), "", "{arguments:?} says nothing");
    }
    assert!(place.file("a.png").is_file(), "the picture was written all the same");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_an_error() {
    let place = Place::new();
    for arguments in [["--help"].as_slice(), &["check", "scene.toml"], &["info", "--json"]] {
        let full = fs::File::options().write(true).open("/dev/full").expect("Linux has /dev/full");
        let output = place.command(arguments).stdout(full).output().expect("the program starts");
        assert_refused(&output, "standard output: ");
    }
}

#[test]
fn a_closed_standard_error_is_no_panic() {
    let place = Place::new();
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    let status = place.command(["bogus"]).stderr(writer).status().expect("the program starts");
    assert_eq!(status.code(), Some(2), "code 2 although nobody reads why");
}

/// The program, with a temporary file in a directory of its place.
fn at_work(place: &Place, mut command: Command, directory: &str) -> Child {
    let mut child = command
        .current_dir(place.path())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    let start = Instant::now();
    let temporary =
        |name: &std::ffi::OsStr| Path::new(name).extension().is_some_and(|extension| extension == "tmp");
    while !fs::read_dir(place.file(directory))
        .is_ok_and(|entries| entries.flatten().any(|entry| temporary(&entry.file_name())))
    {
        assert!(child.try_wait().expect("a child").is_none(), "still at work");
        assert!(start.elapsed() < Duration::from_secs(120), "the first picture takes seconds");
        std::thread::sleep(Duration::from_millis(5));
    }
    child
}

fn send(child: &Child, signal: &str) {
    let killed =
        Command::new("kill").args([signal, &child.id().to_string()]).status().expect("kill is there");
    assert!(killed.success(), "the signal was sent");
}

/// The program ends with a code and leaves nothing behind.
fn assert_ended(place: &Place, mut child: Child, code: i32) {
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().expect("a child") {
            break status;
        }
        if start.elapsed() > Duration::from_secs(60) {
            let _ = child.kill();
            panic!("it does not end");
        }
        std::thread::sleep(Duration::from_millis(5));
    };
    assert_eq!(status.code(), Some(code), "the code of the signal");
    assert_eq!(place.entries(), ["scene.toml"], "neither files nor temporary ones nor a directory");
}

/// A place whose scene moves, and what animates it for minutes.
fn long_work() -> (Place, Vec<&'static str>) {
    let place = Place::new();
    let motion = "motion = { type = \"path\", points = [[0, 1, 0], [1, 1, 0]], period = 50 }";
    place.write("scene.toml", &format!("{SCENE}{motion}\n"));
    let size = ["--size", "640x480", "--msaa", "16"];
    let animate = ["animate", "scene.toml", "-o", "a.apng", "--technique", "raytraced"];
    (place, [animate.as_slice(), &size].concat())
}

/// Whether whoever runs the tests has them ignore that the terminal hangs up, which children inherit.
fn hangup_is_ignored() -> bool {
    let about = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = about.lines().find_map(|line| line.strip_prefix("SigIgn:")).unwrap_or("1");
    u64::from_str_radix(mask.trim(), 16).is_ok_and(|mask| mask & 1 != 0)
}

#[test]
fn an_interrupt_leaves_nothing() {
    let place = Place::new();
    let demo = ["demo", "-o", "pictures", "--backend", "cpu", "--size", "1280x720"];
    let child = at_work(&place, place.command(demo), "pictures");
    send(&child, "-INT");
    assert_ended(&place, child, 130);
}

#[test]
fn no_signal_that_ends_the_program_leaves_anything() {
    for (signal, code) in [("-INT", 130), ("-TERM", 143), ("-HUP", 129)] {
        if signal == "-HUP" && hangup_is_ignored() {
            continue;
        }
        let (place, animate) = long_work();
        let child = at_work(&place, place.command(animate), ".");
        send(&child, signal);
        assert_ended(&place, child, code);
    }
}

#[test]
fn what_is_to_outlive_its_terminal_does() {
    let (place, animate) = long_work();
    let mut command = Command::new("nohup");
    command.arg(env!("CARGO_BIN_EXE_antumbra")).args(animate);
    let mut child = at_work(&place, command, ".");
    send(&child, "-HUP");
    std::thread::sleep(Duration::from_millis(500));
    assert!(child.try_wait().expect("a child").is_none(), "still at work");
    send(&child, "-TERM");
    assert_ended(&place, child, 143);
}
