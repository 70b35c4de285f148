//! The figures: what is varied, and the scenes for it. A new one is a file with its places, and a line in the list.

mod lights;
mod occluders;
mod primitives;
mod resolution;
mod soft;
mod text;

use crate::args::{FigureName, Size};
use crate::technique::Technique;

/// A figure of the benchmark.
pub(super) struct Figure {
    /// Names its chart.
    pub(super) name: FigureName,
    /// What it shows.
    pub(super) title: &'static str,
    /// What is varied.
    pub(super) axis: Axis,
    /// The scenes, in the order of the axis.
    pub(super) places: Vec<Place>,
    /// What takes part where no techniques are named.
    pub(super) techniques: Vec<Technique>,
}

/// What a figure varies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axis {
    /// Kinds of things, side by side.
    Kinds,
    /// A number, on a logarithmic axis, and what it counts.
    Number(&'static str),
}

/// What a chart shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shown {
    /// Time over the figure's axis.
    TimeOverAxis,
    /// Time over the number of points that stand for a light, for each place.
    TimeOverComponents,
    /// Error inside the penumbra over time, for each place.
    ErrorOverTime,
}

/// One place on the axis of a figure.
#[derive(Debug)]
pub(super) struct Place {
    /// Names the scene and its file.
    pub(super) scene: String,
    /// What stands below it on the axis.
    pub(super) label: String,
    /// Where on the axis: the number, or which kind.
    pub(super) at: f64,
    /// The scene file.
    pub(super) toml: String,
    /// Pixels of the frame.
    pub(super) size: Size,
}

impl FigureName {
    /// The name on the command line.
    pub(super) fn text(self) -> &'static str {
        match self {
            Self::Primitives => "primitives",
            Self::Lights => "lights",
            Self::Occluders => "occluders",
            Self::Resolution => "resolution",
            Self::Soft => "soft",
        }
    }

    /// The figure, with frames of a size.
    pub(super) fn figure(self, size: Size) -> Figure {
        match self {
            Self::Primitives => primitives::figure(size),
            Self::Lights => lights::figure(size),
            Self::Occluders => occluders::figure(size),
            Self::Resolution => resolution::figure(size),
            Self::Soft => soft::figure(size),
        }
    }
}

impl Figure {
    /// Its charts: what each shows, and the name of its file.
    pub(super) fn charts(&self) -> Vec<(Shown, String)> {
        let name = self.name.text();
        let own = format!("{name}.svg");
        match self.name {
            FigureName::Soft => {
                vec![(Shown::TimeOverComponents, own), (Shown::ErrorOverTime, format!("{name}-error.svg"))]
            }
            _ => vec![(Shown::TimeOverAxis, own)],
        }
    }

    /// Whether the error inside the penumbra is measured too.
    pub(super) fn has_error(&self) -> bool {
        self.charts().iter().any(|(shown, _)| *shown == Shown::ErrorOverTime)
    }
}

/// All techniques but the ray tracer: it takes seconds for many lights.
fn with_opengl() -> Vec<Technique> {
    Technique::all().into_iter().filter(|technique| *technique != Technique::Raytraced).collect()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use antumbra_scene::Scene;
    use clap::ValueEnum;

    use super::*;

    #[test]
    fn every_scene_is_right_and_has_what_the_axis_says() {
        let mut names = BTreeSet::new();
        for name in FigureName::value_variants() {
            let figure = name.figure(Size { width: 512, height: 512 });
            assert!(figure.places.len() >= 4, "{name:?} has an axis");
            assert!(figure.places.is_sorted_by(|a, b| a.at < b.at), "{name:?} has its places in order");
            for place in &figure.places {
                assert!(names.insert(place.scene.clone()), "{} names one scene", place.scene);
                let scene =
                    Scene::parse(&place.toml, place.scene.as_ref()).unwrap_or_else(|error| panic!("{error}"));
                let occluders = scene.objects.iter().filter(|object| object.casts_shadow).count();
                let varied = match name {
                    FigureName::Primitives | FigureName::Soft => None,
                    FigureName::Lights => Some(scene.lights.len()),
                    FigureName::Occluders => Some(occluders),
                    FigureName::Resolution => Some(place.size.width as usize),
                };
                assert!(varied.is_none_or(|varied| varied as f64 == place.at), "{}: {varied:?}", place.scene);
                let analytic = Technique::from(antumbra::Technique::default());
                assert_eq!(analytic.objection(&scene, 0.0), None, "{} is drawn", place.scene);
            }
        }
    }

    #[test]
    fn resolution_keeps_the_shape() {
        let heights = |width, height| -> Vec<u32> {
            let places = FigureName::Resolution.figure(Size { width, height }).places;
            assert!(
                places.iter().all(|place| Size::new(place.size.width, place.size.height).is_ok()),
                "allowed"
            );
            places.iter().map(|place| place.size.height).collect()
        };
        assert_eq!(heights(512, 512), [256, 512, 1024, 2048], "squares");
        assert_eq!(heights(300, 100), [85, 171, 341, 683], "a third, rounded");
        assert_eq!(heights(1, 16_384), [16_384; 4], "no higher than pictures may be");
        assert_eq!(heights(16_384, 1), [1; 4], "no lower than a pixel");
    }
}
