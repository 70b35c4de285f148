//! How techniques scale with the number of lights.

use super::text::SceneText;
use super::{Axis, Figure, Place, with_opengl};
use crate::args::{FigureName, Size};

const SPHERES: u32 = 8;

/// 8 spheres over a plane, under 1 to 64 point lights.
pub(super) fn figure(size: Size) -> Figure {
    let place = |count: u32| {
        let about = format!("{SPHERES} spheres over a plane, lit by {count} of 64 lights");
        let mut text = SceneText::new(about, [0.0, 6.0, 10.0], [0.0, 0.5, 0.0], size);
        text.ring_of_lights(count);
        text.floor();
        text.spheres(SPHERES);
        Place {
            scene: format!("lights-{count}"),
            label: count.to_string(),
            at: f64::from(count),
            toml: text.finish(),
            size,
        }
    };
    Figure {
        name: FigureName::Lights,
        title: "8 spheres over a plane, more and more lights",
        axis: Axis::Number("point lights"),
        places: [1, 2, 4, 8, 16, 32, 64].map(place).into(),
        techniques: with_opengl(),
    }
}
