//! What a user may get wrong: each is code 2 and one line that says what to do, and nothing is written.

mod common;

use std::fs;

use common::{Place, SCENE, assert_refused, stderr, stdout};

#[test]
fn wrong_command_lines() {
    let cases: &[(&[&str], &str)] = &[
        (&["paint"], "unrecognized subcommand 'paint'"),
        (&["rendr", "scene.toml"], "'render'"),
        (&["--bogus"], "'--bogus'"),
        (&["render"], "SCENE"),
        (&["render", "scene.toml"], "--output"),
        (&["render", "scene.toml", "-o"], "--output"),
        (&["render", "scene.toml", "-o", ""], "--output"),
        (&["render", "scene.toml", "-o", "a.png", "-o", "b.png"], "cannot be used multiple times"),
        (&["render", "scene.toml", "extra.toml", "-o", "a.png"], "extra.toml"),
        (&["render", "scene.toml", "-o", "a.png", "--sizes", "4x4"], "'--size'"),
        (&["render", "scene.toml", "-o", "a.png", "--size", "0x10"], "at least 1x1"),
        (&["render", "scene.toml", "-o", "a.png", "--size", "10"], "such as 960x540"),
        (&["render", "scene.toml", "-o", "a.png", "--size", "-4x4"], "--size"),
        (&["render", "scene.toml", "-o", "a.png", "--size", "16385x1"], "at most 16384"),
        (&["render", "scene.toml", "-o", "a.png", "--size", "16384x16384"], "at most 33554432"),
        (&["render", "scene.toml", "-o", "a.png", "--size", "99999999999999999999x1"], "at most 16384"),
        (&["render", "scene.toml", "-o", "a.png", "--time", "nan"], "finite number of seconds"),
        (&["render", "scene.toml", "-o", "a.png", "--time", "-inf"], "finite number of seconds"),
        (&["render", "scene.toml", "-o", "a.png", "--time", "soon"], "finite number of seconds"),
        (&["render", "scene.toml", "-o", "a.png", "--msaa", "0"], "2, 4, 8"),
        (&["render", "scene.toml", "-o", "a.png", "--msaa", "3"], "2, 4, 8"),
        (&["render", "scene.toml", "-o", "a.png", "--msaa", "4096"], "2, 4, 8"),
        (&["render", "scene.toml", "-o", "a.png", "--technique", "magic"], "the techniques are analytic"),
        (&["render", "scene.toml", "-o", "a.png", "--technique", ""], "and raytraced"),
        (&["render", "scene.toml", "-o", "a.png", "--technique", "analytic:size=3"], "no option `size=3`"),
        (&["render", "scene.toml", "-o", "a.png", "--technique", "raytraced:size=3"], "has no options"),
        (&["render", "scene.toml", "-o", "a.png", "--shade", "pretty"], "pretty"),
        (&["render", "scene.toml", "-o", "a.png", "--shade", "paper"], "no option `shade=paper`"),
        (
            &["render", "scene.toml", "-o", "a.png", "--technique", "map", "--quality", "exact"],
            "no option `quality=exact`",
        ),
        (
            &["render", "scene.toml", "-o", "a.png", "--shade", "physical", "--backend", "cpu"],
            "has no options",
        ),
        (&["render", "scene.toml", "-o", "a.png", "--backend", "vulkan"], "vulkan"),
        (&["render", "scene.toml", "-o", "a.png", "--backend", "cpu", "--technique", "analytic"], "OpenGL"),
        (&["render", "scene.toml", "-o", "a.png", "--backend", "gl", "--technique", "raytraced"], "CPU"),
        (&["trace", "scene.toml", "-o", "a.png", "--samples", "0"], "from 1 to 65536"),
        (&["trace", "scene.toml", "-o", "a.png", "--samples", "-1"], "--samples"),
        (&["trace", "scene.toml", "-o", "a.png", "--samples", "1e3"], "from 1 to 65536"),
        (&["trace", "scene.toml", "-o", "a.png", "--samples", "99999999999"], "from 1 to 65536"),
        (&["trace", "scene.toml", "-o", "a.png", "--msaa", "4"], "'--msaa'"),
        (&["check"], "SCENE"),
        (&["info", "now"], "now"),
        (&["demo", "--size", "0x0"], "at least 1x1"),
        (&["render", "a\nb\u{1b}.toml", "c\nd", "-o", "a.png"], "unexpected argument"),
    ];
    let place = Place::new();
    for (arguments, text) in cases {
        eprintln!("antumbra {}", arguments.join(" "));
        assert_refused(&place.run(*arguments), text);
        assert_eq!(place.entries(), ["scene.toml"], "nothing is written");
    }
}

#[test]
fn arguments_that_are_not_unicode() {
    #[cfg(unix)]
    {
        use std::ffi::OsStr;
        use std::os::unix::ffi::OsStrExt;
        let place = Place::new();
        let odd = OsStr::from_bytes(b"sc\xffene.toml");
        assert_refused(&place.run([OsStr::new("check"), odd]), "sc");
        assert_refused(&place.run([OsStr::new("render"), OsStr::new("--size"), odd]), "error: ");
        assert_refused(&place.run([odd]), "error: ");
    }
}

#[test]
fn wrong_outputs() {
    let place = Place::new();
    fs::create_dir(place.file("folder")).expect("writable");
    fs::create_dir(place.file("folder.png")).expect("writable");
    fs::create_dir_all(place.file("taken/key.png")).expect("writable");
    place.write("file", "");
    place.write("scene.png", SCENE);
    let before = place.entries();
    let long = format!("{}.png", "a".repeat(300));
    let cases: &[(&[&str], &str)] = &[
        (&["scene.toml", "-o", "a"], "end the name in .png or .exr"),
        (&["scene.toml", "-o", "a.jpg"], "end the name in .png or .exr"),
        (&["scene.toml", "-o", "-"], "end the name in .png or .exr"),
        (&["scene.toml", "-o", ".png"], "end the name in .png or .exr"),
        (&["scene.toml", "-o", "a.png.toml"], "end the name in .png or .exr"),
        (&["scene.toml", "-o", "folder"], "is a directory; name a file"),
        (&["scene.toml", "-o", "folder.png"], "is a directory; name a file"),
        (&["scene.toml", "-o", "."], "is a directory; name a file"),
        (&["scene.toml", "-o", "new.png/"], "names a directory; name a file"),
        (&["scene.toml", "-o", "missing/a.png"], "missing: there is no such directory; make it first"),
        (&["scene.toml", "-o", "file/a.png"], "cannot be written"),
        (&["scene.toml", "-o", &long], "cannot be written"),
        (&["scene.png", "-o", "scene.png"], "is the scene file itself"),
        (&["scene.toml", "-o", "a.png", "--visibility", "file"], "is not a directory"),
        (&["scene.toml", "-o", "a.png", "--visibility", "a/b"], "there is no such directory; make it first"),
        (&["scene.toml", "-o", "a.png", "--visibility", "taken"], "is a directory; name a file"),
        (&["scene.toml", "-o", "key.png", "--visibility", "."], "light `key`"),
        (&["scene.toml", "-o", "folder/../sun.png", "--visibility", "folder/.."], "light `sun`"),
        (&["scene.toml", "-o", "a.png", "--visibility", "a.png"], "is the picture too"),
    ];
    for command in ["trace", "render"] {
        for (arguments, text) in cases {
            eprintln!("antumbra {command} {}", arguments.join(" "));
            let arguments = [&[command], *arguments].concat();
            assert_refused(&place.run(arguments), text);
            assert_eq!(place.entries(), before, "nothing is written");
        }
    }
    for (arguments, text) in [
        (["demo", "-o", "file"], "is not a directory"),
        (["demo", "-o", "a/b"], "there is no such directory"),
    ] {
        assert_refused(&place.run(arguments), text);
        assert_eq!(place.entries(), before, "nothing is written");
    }
    assert_eq!(fs::read_to_string(place.file("scene.png")).ok().as_deref(), Some(SCENE), "not touched");
}

#[cfg(target_os = "linux")]
#[test]
fn directories_that_take_no_files_and_devices() {
    let place = Place::new();
    // /proc takes no files, not even from root.
    for arguments in [
        ["trace", "scene.toml", "-o", "/proc/a.png", "--samples", "1"].as_slice(),
        &["trace", "scene.toml", "-o", "a.png", "--visibility", "/proc"],
        &["trace", "scene.toml", "-o", "a.png", "--visibility", "/proc/new"],
        &["demo", "-o", "/proc"],
    ] {
        assert_refused(&place.run(arguments), "/proc: cannot write in this directory");
    }
    std::os::unix::fs::symlink("/dev/null", place.file("null.png")).expect("writable");
    assert_refused(&place.run(["trace", "scene.toml", "-o", "null.png"]), "is a device or the like");
    assert_eq!(place.entries(), ["null.png", "scene.toml"], "nothing is written");
}

#[test]
fn wrong_scenes() {
    let place = Place::new();
    place.write("broken.toml", "ambient = [0.1, 0.1\n");
    place.write("unknown.toml", &SCENE.replace("fov_y", "fov"));
    let before = place.entries();
    for (scene, text) in [
        ("missing.toml", "missing.toml"),
        (".", "error: ."),
        ("broken.toml", "broken.toml:"),
        ("unknown.toml", "unknown.toml:7:1"),
    ] {
        for command in ["trace", "render"] {
            assert_refused(&place.run([command, scene, "-o", "a.png"]), text);
        }
        assert_refused(&place.run(["check", scene]), text);
        assert_eq!(place.entries(), before, "nothing is written");
    }
}

#[test]
fn light_names_that_cannot_name_files() {
    let place = Place::new();
    for name in ["..", "../key", "a/b", ""] {
        // The scene format or the output may be what refuses it; either way it is one line and nothing is written.
        place.write("scene.toml", &SCENE.replace("\"key\"", &format!("{name:?}")));
        let arguments = ["trace", "scene.toml", "-o", "a.png", "--visibility", "masks", "--samples", "1"];
        assert_refused(&place.run(arguments), "name");
        assert_eq!(place.entries(), ["scene.toml"], "nothing is written");
    }
}

#[test]
fn too_many_visibilities() {
    let place = Place::new();
    let light = "[[light]]\nname = \"NAME\"\ntype = \"point\"\nposition = [0.0, 9.0, 0.0]\nintensity = 1.0\n";
    let lights: String = (0..20).map(|index| light.replace("NAME", &index.to_string())).collect();
    place.write("scene.toml", &format!("{SCENE}\n{lights}"));
    let arguments = ["trace", "scene.toml", "-o", "a.png", "--visibility", "masks", "--size", "8192x4096"];
    assert_refused(&place.run(arguments), "give a smaller --size");
    assert_eq!(place.entries(), ["scene.toml"], "nothing is written");
}

#[test]
fn help_and_version_are_no_errors() {
    let place = Place::new();
    for command in ["demo", "render", "animate", "trace", "check", "compare", "bench", "info"] {
        let help = place.run([command, "--help"]);
        assert_eq!(help.status.code(), Some(0), "help is no error");
        let text = stdout(&help);
        assert!(
            text.contains("Examples:") && text.contains(&format!("antumbra {command}")),
            "examples: {text}"
        );
        assert_eq!(stderr(&help), "", "nothing on standard error");
    }
    let render = stdout(&place.run(["render", "--help"]));
    for name in antumbra::Technique::NAMES.iter().chain(&["raytraced"]) {
        assert!(
            render.lines().any(|line| line.trim().starts_with(&format!("{name} "))),
            "{name} is listed: {render}"
        );
    }
    let help = stdout(&place.run(["--help"]));
    assert!(help.contains("Examples:") && help.contains("Exit code"), "the general help: {help}");
    let version = stdout(&place.run(["--version"]));
    assert_eq!(version, format!("antumbra {}\n", env!("CARGO_PKG_VERSION")), "name and version");
}
