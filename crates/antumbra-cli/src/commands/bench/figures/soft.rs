//! Fig. 7 of "Applying the Real Time Shadowing Method for Creating Soft Shadows in OpenGL" (2017): the time of a frame
//! with one primitive, over the number of points that its light is a collection of. Beside the paper's method the exact
//! hard shadow from as many points, and what needs no points at all: the closed form, and a filtered shadow map.

use antumbra::technique::{composite, map};
use antumbra::{Soft, Technique as Gl};

use super::primitives::KINDS;
use super::text::SceneText;
use super::{Axis, Figure, Place};
use crate::args::{FigureName, Size};
use crate::technique::Technique;

const COMPONENTS: [u32; 6] = [1, 3, 5, 9, 16, 64];

/// The paper's four primitives over a plane, under a ball.
pub(super) fn figure(size: Size) -> Figure {
    let place = |(i, (name, body)): (usize, &(&str, &str))| {
        let about = format!("A {name} over a plane, under a ball that shines");
        let mut text = SceneText::new(about, [0.0, 4.5, 7.5], [0.3, 1.0, 0.0], size);
        text.ball_light("light", [-4.0, 7.0, 1.5], 0.7, 180.0);
        text.floor();
        text.object(name, [0.3, 0.45, 0.25], body);
        Place {
            scene: format!("soft-{name}"),
            label: (*name).to_owned(),
            at: i as f64,
            toml: text.finish(),
            size,
        }
    };
    Figure {
        name: FigureName::Soft,
        title: "One object over a plane, one ball light",
        axis: Axis::Kinds,
        places: KINDS[..4].iter().enumerate().map(place).collect(),
        techniques: techniques(),
    }
}

fn techniques() -> Vec<Technique> {
    let mut pcss = map::Options::default();
    pcss.filter = map::Filter::Pcss;
    let without = [Gl::default(), Gl::Map(pcss)].map(Technique::from);
    let painted = COMPONENTS.map(|components| {
        let mut options = composite::Options::default();
        options.components = components;
        Technique::from(Gl::Composite(options))
    });
    let sampled = COMPONENTS.map(|count| Technique::Gl(Gl::default(), Soft::samples(count)));
    without.into_iter().chain(painted).chain(sampled).collect()
}
