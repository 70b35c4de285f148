//! Fig. 7 of "Real-Time Shadows in OpenGL Caused by the Presence of Multiple Light Sources" (2017): the time of a frame
//! with one primitive, or one object made of several, for the paper's method, projected shadows and ray tracing; and
//! for whatever other techniques there are, beside them.

use super::text::SceneText;
use super::{Axis, Figure, Place};
use crate::args::{FigureName, Size};
use crate::technique::Technique;

/// What is drawn: its name, and shape and pose in the scene file.
pub(super) const KINDS: [(&str, &str); 5] = [
    ("circle", "shape = { type = \"disc\", radius = 1.0 }\ntranslation = [0.0, 1.4, 0.0]"),
    (
        "triangle",
        "shape = { type = \"triangle\", vertices = [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [0.0, 2.0, 0.0]] }\n\
         translation = [0.0, 0.5, 0.0]",
    ),
    ("sphere", "shape = { type = \"sphere\", radius = 1.0 }\ntranslation = [0.0, 1.5, 0.0]"),
    ("cone", "shape = { type = \"cone\", radius = 1.0, height = 2.0 }\ntranslation = [0.0, 1.5, 0.0]"),
    ("fir tree", FIR_TREE),
];

/// Seven primitives, as the paper builds complex objects: six cones above one another, and a ball on top.
const FIR_TREE: &str = r#"parts = [
  { shape = { type = "cone", radius = 1.10, height = 0.9 }, translation = [0.0, 0.65, 0.0] },
  { shape = { type = "cone", radius = 0.95, height = 0.9 }, translation = [0.0, 1.05, 0.0] },
  { shape = { type = "cone", radius = 0.80, height = 0.8 }, translation = [0.0, 1.45, 0.0] },
  { shape = { type = "cone", radius = 0.65, height = 0.8 }, translation = [0.0, 1.80, 0.0] },
  { shape = { type = "cone", radius = 0.50, height = 0.7 }, translation = [0.0, 2.15, 0.0] },
  { shape = { type = "cone", radius = 0.35, height = 0.6 }, translation = [0.0, 2.50, 0.0] },
  { shape = { type = "sphere", radius = 0.12 }, translation = [0.0, 2.86, 0.0] },
]"#;

/// The paper's four primitives and a complex object, over a plane under one point light aside.
pub(super) fn figure(size: Size) -> Figure {
    let place = |(i, (name, body)): (usize, &(&str, &str))| {
        let about = format!("A {name} over a plane, under one light");
        let mut text = SceneText::new(about, [0.0, 4.5, 7.5], [0.3, 1.0, 0.0], size);
        text.light("light", [-4.0, 7.0, 1.5], 180.0);
        text.floor();
        text.object(name, [0.3, 0.45, 0.25], body);
        Place {
            scene: format!("primitives-{}", name.replace(' ', "-")),
            label: (*name).to_owned(),
            at: i as f64,
            toml: text.finish(),
            size,
        }
    };
    Figure {
        name: FigureName::Primitives,
        title: "One object over a plane, one light",
        axis: Axis::Kinds,
        places: KINDS.iter().enumerate().map(place).collect(),
        techniques: Technique::all(),
    }
}
