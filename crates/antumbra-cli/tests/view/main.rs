//! The viewer, worked with keys and mouse on a display of its own (Xvfb) and seen in pictures and in the state that it
//! prints.
//!
//! Where there is no Xvfb these tests say so and are skipped; under `cargo xtask test` that is a failure.
//! Ten thousand frames and a hundred scenes: `cargo test --release -p antumbra-cli --test view -- --ignored`.
#![cfg(all(feature = "viewer", target_os = "linux"))]

mod controls;
mod dialogs;
mod editing;
mod files;
mod keys;
mod mouse;
mod panel;
mod screen;
mod shadows;
mod techniques;
mod tour;
mod viewer;
mod window;

/// The scene of most tests: a ball and a post over a floor, and ten lights, of which the first has an area and the
/// second goes round.
pub(crate) fn scene() -> String {
    let mut text = String::from(
        r#"
ambient = [0.02, 0.02, 0.02]

[camera]
eye = [0.0, 5.0, 9.0]
target = [0.0, 0.5, 0.0]
fov_y = 40.0

[[light]]
name = "key" # the one that moves
type = "sphere"
radius = 0.3
position = [-1.5, 4.0, 1.0]
intensity = 60.0

[[light]]
name = "moon"
type = "point"
position = [2.0, 4.0, 0.0]
intensity = 20.0
motion = { type = "orbit", center = [0, 4, 0], axis = [0, 1, 0], period = 8 }
"#,
    );
    for i in 3..=10 {
        let x = f64::from(i) - 6.5;
        text += &format!(
            "\n[[light]]\nname = \"lamp {i}\"\ntype = \"point\"\nposition = [{x}, 3.0, -3.0]\nintensity = 1.0\n"
        );
    }
    text + r#"
# What shadows fall on.
[[object]]
name = "floor"
shape = { type = "plane" }
color = [0.7, 0.7, 0.7]
casts_shadow = false

[[object]]
name = "ball"
shape = { type = "sphere", radius = 0.6 }
translation = [0.0, 1.0, 0.0]
color = [0.8, 0.3, 0.2]
"#
}
