//! The example `window`, which the README begins with: a program that draws to a window of its own.

use antumbra_host::TestDisplay;
use std::path::Path;
use std::process::Command;

struct Picture {
    width: usize,
    pixels: Vec<u8>,
}

fn read(path: &Path) -> Picture {
    let file = std::io::BufReader::new(std::fs::File::open(path).expect("the example writes it"));
    let mut reader = png::Decoder::new(file).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut pixels).expect("a picture");
    assert_eq!(info.color_type, png::ColorType::Rgba, "four channels");
    Picture { width: info.width as usize, pixels }
}

/// Next to this test's program.
fn example() -> std::path::PathBuf {
    let here = std::env::current_exe().expect("this test");
    here.parent().and_then(Path::parent).expect("the target folder").join("examples/window")
}

/// Shadows fall on the floor beside the balls, and change nothing else.
#[test]
fn a_window_has_its_shadows() {
    let Some(display) = TestDisplay::start([1024, 768]) else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let output = Command::new(example())
        .arg(folder.path())
        .env("DISPLAY", display.name())
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .expect("the example is built with its tests");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let [before, after] = ["before.png", "after.png"].map(|name| read(&folder.path().join(name)));
    assert_eq!(before.pixels.len(), after.pixels.len(), "of one size");
    let row = before.width * 4;
    let sky = 100 * row;
    assert_eq!(before.pixels[..sky], after.pixels[..sky], "nothing falls on the sky");
    let pairs = || before.pixels.iter().zip(&after.pixels);
    let brighter = pairs().filter(|(before, after)| after > before).count();
    let darker = pairs().filter(|(before, after)| before.saturating_sub(**after) > 20).count();
    assert_eq!(brighter, 0, "shadows darken");
    assert!(darker > 30_000 && darker < before.pixels.len() / 4, "{darker} bytes are darker");
    // Between the large ball and the floor neither light arrives: the ambient light's grey.
    let at = |picture: &Picture, x: usize, y: usize| picture.pixels[y * row + x * 4];
    assert!(at(&before, 405, 287) > 150, "lit without shadows: {}", at(&before, 405, 287));
    let grey = 255.0 * (0.3f32 * 0.8 / std::f32::consts::PI).powf(1.0 / 2.2);
    assert!((f32::from(at(&after, 405, 287)) - grey).abs() < 2.0, "{} is not {grey}", at(&after, 405, 287));
}

/// What the README shows is what is built.
#[test]
fn the_readme_shows_the_example() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let [readme, example] = ["../../README.md", "examples/window/shadows.rs"]
        .map(|path| std::fs::read_to_string(here.join(path)).expect("a file of the project"));
    let shown = example.replace("pub(crate) ", "pub ");
    assert!(
        readme.contains(&format!("```rust,ignore\n{shown}```")),
        "the README shows examples/window/shadows.rs"
    );
}
