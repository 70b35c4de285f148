//! Standard output that goes away or fills up, and interrupts.
#![cfg(unix)]

mod common;

use std::fs;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use common::{Place, assert_refused, stderr};

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

#[test]
fn an_interrupt_leaves_nothing() {
    let place = Place::new();
    let mut child = place
        .command(["demo", "-o", "pictures", "--backend", "cpu", "--size", "1280x720"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    // Wait for the first picture to lie there under its temporary name.
    let start = Instant::now();
    loop {
        let waiting = fs::read_dir(place.file("pictures")).is_ok_and(|mut entries| entries.next().is_some());
        if waiting {
            break;
        }
        assert!(child.try_wait().expect("a child").is_none(), "still at work");
        assert!(start.elapsed() < Duration::from_secs(120), "the first picture takes seconds");
        std::thread::sleep(Duration::from_millis(5));
    }
    let killed =
        Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill is there");
    assert!(killed.success(), "the signal was sent");
    let status = child.wait().expect("a child");
    assert_eq!(status.code(), Some(130), "the code of an interrupt");
    assert_eq!(place.entries(), ["scene.toml"], "neither pictures nor temporary files nor the directory");
}
