//! How techniques scale with the number of pixels.

use super::text::SceneText;
use super::{Axis, Figure, Place, with_opengl};
use crate::args::{FigureName, MAX_SIDE, Size};

const SPHERES: u32 = 8;
const LIGHTS: u32 = 4;

/// 8 spheres over a plane, under 4 point lights, 256 to 2048 pixels across; as high as `size` is in proportion.
pub(super) fn figure(size: Size) -> Figure {
    let place = |width: u32| {
        let in_proportion = f64::from(width) * f64::from(size.height) / f64::from(size.width.max(1));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
        let height = in_proportion.round().clamp(1.0, f64::from(MAX_SIDE)) as u32;
        let size = Size { width, height };
        let about = format!("{SPHERES} spheres over a plane, under {LIGHTS} lights");
        let mut text = SceneText::new(about, [0.0, 6.0, 10.0], [0.0, 0.5, 0.0], size);
        text.ring_of_lights(LIGHTS);
        text.floor();
        text.spheres(SPHERES);
        Place {
            scene: format!("resolution-{width}"),
            label: width.to_string(),
            at: f64::from(width),
            toml: text.finish(),
            size,
        }
    };
    Figure {
        name: FigureName::Resolution,
        title: "8 spheres over a plane, 4 lights, more and more pixels",
        axis: Axis::Number("pixels across"),
        places: [256, 512, 1024, 2048].map(place).into(),
        techniques: with_opengl(),
    }
}
