//! How techniques scale with the number of things that cast shadows.

use super::text::SceneText;
use super::{Axis, Figure, Place, with_opengl};
use crate::args::{FigureName, Size};

/// 1 to 1000 spheres over a plane, under one point light.
pub(super) fn figure(size: Size) -> Figure {
    let place = |count: u32| {
        let about = format!("{count} of 1000 spheres over a plane, under one light");
        let mut text = SceneText::new(about, [0.0, 6.0, 10.0], [0.0, 0.5, 0.0], size);
        text.ring_of_lights(1);
        text.floor();
        text.spheres(count);
        Place {
            scene: format!("occluders-{count}"),
            label: count.to_string(),
            at: f64::from(count),
            toml: text.finish(),
            size,
        }
    };
    Figure {
        name: FigureName::Occluders,
        title: "One light, more and more spheres over a plane",
        axis: Axis::Number("spheres"),
        places: [1, 3, 10, 30, 100, 300, 1000].map(place).into(),
        techniques: with_opengl(),
    }
}
