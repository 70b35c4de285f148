//! Running the program, and looking at what it wrote.
#![allow(dead_code, reason = "each test file uses a part of this")]

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

/// A scene of one ball over a floor, seen from above at an angle: 48 by 32 pixels, two hard lights, some background.
pub(crate) const SCENE: &str = r#"
ambient = [0.1, 0.1, 0.1]

[camera]
eye = [0.0, 3.0, 6.0]
target = [0.0, 0.5, 0.0]
fov_y = 50.0

[image]
width = 48
height = 32
background = [0.25, 0.5, 1.0]
exposure = 1.5

[[light]]
name = "key"
type = "point"
position = [2.0, 4.0, 1.0]
intensity = 30.0

[[light]]
name = "sun"
type = "directional"
direction = [1.0, -2.0, -0.5]
intensity = 0.8
color = [1.0, 0.5, 0.25]

[[object]]
name = "floor"
shape = { type = "rectangle", width = 6.0, depth = 4.0 }
color = [0.6, 0.6, 0.6]

[[object]]
name = "ball"
shape = { type = "sphere", radius = 0.7 }
translation = [0.0, 0.9, 0.0]
color = [0.9, 0.3, 0.2]
"#;

/// A directory of its own, with the scene in `scene.toml`; removed at the end.
pub(crate) struct Place {
    directory: TempDir,
}

impl Place {
    pub(crate) fn new() -> Self {
        let place = Self { directory: tempfile::tempdir().expect("a temporary directory") };
        place.write("scene.toml", SCENE);
        place
    }

    pub(crate) fn path(&self) -> &Path {
        self.directory.path()
    }

    pub(crate) fn file(&self, name: &str) -> PathBuf {
        self.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, text: &str) {
        fs::write(self.file(name), text).expect("a temporary directory is writable");
    }

    /// The program, to be run in this directory; where there is no display, so that no test opens a window on one.
    pub(crate) fn command<S: AsRef<OsStr>>(&self, arguments: impl IntoIterator<Item = S>) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_antumbra"));
        command.args(arguments).current_dir(self.path());
        command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET");
        command
    }

    pub(crate) fn run<S: AsRef<OsStr>>(&self, arguments: impl IntoIterator<Item = S>) -> Output {
        self.command(arguments).output().expect("the program starts")
    }

    /// Every file and directory below, relative, in order.
    pub(crate) fn entries(&self) -> Vec<String> {
        let mut found = Vec::new();
        collect(self.path(), self.path(), &mut found);
        found.sort();
        found
    }
}

fn collect(root: &Path, directory: &Path, found: &mut Vec<String>) {
    for entry in fs::read_dir(directory).expect("the directory is there") {
        let path = entry.expect("readable").path();
        found.push(path.strip_prefix(root).expect("below the root").to_string_lossy().into_owned());
        if path.is_dir() && !path.is_symlink() {
            collect(root, &path, found);
        }
    }
}

pub(crate) fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("the program writes UTF-8")
}

pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("the program writes UTF-8")
}

/// The program did what it was asked, and said nothing on standard error.
pub(crate) fn assert_success(output: &Output) {
    assert_eq!(output.status.code(), Some(0), "exit code; standard error: {}", stderr(output));
    assert_eq!(stderr(output), "", "nothing on standard error");
}

/// The program refused: code 2, one `error:` line that contains `text`, nothing else.
pub(crate) fn assert_refused(output: &Output, text: &str) {
    let errors = stderr(output);
    assert_eq!(output.status.code(), Some(2), "exit code; standard error: {errors}");
    assert_eq!(errors.lines().count(), 1, "one line: {errors}");
    assert!(errors.starts_with("error: ") && errors.ends_with('\n'), "an error line: {errors}");
    assert!(errors.contains(text), "`{text}` is in: {errors}");
    assert_eq!(stdout(output), "", "nothing on standard output");
}

/// Standard output as one JSON value.
pub(crate) fn json(output: &Output) -> serde_json::Value {
    serde_json::from_str(&stdout(output)).expect("standard output is one JSON value")
}

/// A decoded PNG.
pub(crate) struct Png {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) color: png::ColorType,
    pub(crate) depth: png::BitDepth,
    /// As in the file: 16-bit samples are two bytes, the high one first.
    pub(crate) bytes: Vec<u8>,
}

impl Png {
    pub(crate) fn read(path: &Path) -> Self {
        let file = std::io::BufReader::new(fs::File::open(path).expect("the picture was written"));
        let mut reader = png::Decoder::new(file).read_info().expect("a PNG");
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size in memory")];
        let info = reader.next_frame(&mut bytes).expect("a whole PNG");
        bytes.truncate(info.buffer_size());
        Self { width: info.width, height: info.height, color: info.color_type, depth: info.bit_depth, bytes }
    }

    /// The samples of a 16-bit grey picture.
    pub(crate) fn grey(&self) -> Vec<u16> {
        assert_eq!(self.color, png::ColorType::Grayscale, "grey");
        assert_eq!(self.depth, png::BitDepth::Sixteen, "16-bit");
        self.bytes.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect()
    }

    /// The pixels of an 8-bit colour picture.
    pub(crate) fn rgb(&self) -> Vec<[u8; 3]> {
        assert_eq!(self.color, png::ColorType::Rgb, "colour");
        assert_eq!(self.depth, png::BitDepth::Eight, "8-bit");
        self.bytes.chunks_exact(3).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect()
    }
}

/// Whether there is OpenGL to test with. Where there is none the test says so and is skipped, unless
/// `ANTUMBRA_REQUIRE_GL=1`, as `cargo xtask test` sets it: then it fails.
pub(crate) fn opengl(place: &Place) -> bool {
    let info = json(&place.run(["info", "--json"]));
    if info["opengl"] == true {
        return true;
    }
    assert!(
        std::env::var_os("ANTUMBRA_REQUIRE_GL").is_none_or(|value| value != "1"),
        "ANTUMBRA_REQUIRE_GL=1 and there is no OpenGL: {info}"
    );
    eprintln!("SKIPPED: there is no OpenGL here; `cargo xtask setup` installs one");
    false
}
