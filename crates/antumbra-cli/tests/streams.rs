//! Standard output that goes away or fills up, and interrupts.
#![cfg(unix)]

mod common;

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
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

/// Interrupts the program once there is a temporary file in a directory of its place.
fn interrupted(place: &Place, arguments: &[&str], directory: &str) {
    let mut child = place
        .command(arguments)
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
    let killed =
        Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill is there");
    assert!(killed.success(), "the signal was sent");
    let status = child.wait().expect("a child");
    assert_eq!(status.code(), Some(130), "the code of an interrupt");
    assert_eq!(place.entries(), ["scene.toml"], "neither files nor temporary ones nor a directory");
}

#[test]
fn an_interrupt_leaves_nothing() {
    let place = Place::new();
    interrupted(&place, &["demo", "-o", "pictures", "--backend", "cpu", "--size", "1280x720"], "pictures");
    let motion = "motion = { type = \"path\", points = [[0, 1, 0], [1, 1, 0]], period = 50 }";
    place.write("scene.toml", &format!("{SCENE}{motion}\n"));
    let animate = ["animate", "scene.toml", "-o", "a.apng", "--technique", "raytraced", "--size", "640x480"];
    interrupted(&place, &animate, ".");
}
