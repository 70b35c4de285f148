//! What is looked at and how: remembered from one start to the next.

use antumbra::Soft;
use serde::{Deserialize, Serialize};

use super::way::Way;

/// What the picture holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Layout {
    /// One way alone.
    #[default]
    Single,
    /// The first way left of a divider, the second right of it.
    Split,
    /// Where the first differs from the second, and how much.
    Difference,
}

impl Layout {
    /// All of them.
    pub(crate) const ALL: [Self; 3] = [Self::Single, Self::Split, Self::Difference];

    /// Its name on a button.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Single => "Single",
            Self::Split => "Split",
            Self::Difference => "Error map",
        }
    }
}

/// What is drawn over the picture to teach.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Teaching {
    /// Edges of umbra, penumbra and antumbra on flat receivers.
    pub(crate) outlines: bool,
    /// Rays from the light along the occluder to the shadow's edge.
    pub(crate) rays: bool,
    /// Kind and numbers of the conics.
    pub(crate) conics: bool,
    /// Sides of the shadow volumes.
    pub(crate) volumes: bool,
    /// The map seen from the chosen light.
    pub(crate) map: bool,
    /// Of the chosen light alone.
    pub(crate) chosen_light: bool,
}

impl Default for Teaching {
    fn default() -> Self {
        Self { outlines: false, rays: false, conics: false, volumes: false, map: false, chosen_light: true }
    }
}

/// Samples a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Antialiasing {
    /// Few while things move, more once they stand still, as the driver is fast.
    #[default]
    Auto,
    /// Always so many, as far as the driver has them.
    #[serde(untagged)]
    Samples(u32),
}

/// All of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Settings {
    /// What the picture holds.
    pub(crate) layout: Layout,
    /// The first way, and the one it is compared with.
    pub(crate) ways: [Way; 2],
    /// Where the divider is, as a part of the picture's width.
    pub(crate) divider: f32,
    /// The error that has the brightest colour of the error map.
    pub(crate) error_scale: f32,
    /// What is drawn over the picture.
    pub(crate) teaching: Teaching,
    /// Marks of lights, and round what is chosen.
    pub(crate) marks: bool,
    /// The panel at the side.
    pub(crate) panel: bool,
    /// The plot of frame times.
    pub(crate) timing: bool,
    /// Whether frames wait for the screen.
    pub(crate) vsync: bool,
    /// Samples a pixel.
    pub(crate) antialiasing: Antialiasing,
    /// Whether a little noise takes the bands out of dark gradients.
    pub(crate) dither: bool,
    /// Size of the interface, times what the screen asks for.
    pub(crate) zoom: f32,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            layout: Layout::Single,
            ways: [Way::default(), Way::Raytraced],
            divider: 0.5,
            error_scale: 0.1,
            teaching: Teaching::default(),
            marks: true,
            panel: true,
            timing: false,
            vsync: true,
            antialiasing: Antialiasing::Auto,
            dither: true,
            zoom: 1.0,
        }
    }
}

/// Limits of [`Settings::error_scale`].
pub(crate) const ERROR_SCALES: std::ops::RangeInclusive<f32> = 0.001..=1.0;
/// Limits of [`Settings::divider`].
pub(crate) const DIVIDERS: std::ops::RangeInclusive<f32> = 0.02..=0.98;
/// Limits of [`Settings::zoom`].
pub(crate) const ZOOMS: std::ops::RangeInclusive<f32> = 0.5..=3.0;

impl Settings {
    /// What was remembered, with what makes no sense put right.
    pub(crate) fn sane(mut self) -> Self {
        let put = |value: &mut f32, range: &std::ops::RangeInclusive<f32>, default: f32| {
            *value = if value.is_finite() { value.clamp(*range.start(), *range.end()) } else { default };
        };
        let default = Self::default();
        put(&mut self.divider, &DIVIDERS, default.divider);
        put(&mut self.error_scale, &ERROR_SCALES, default.error_scale);
        put(&mut self.zoom, &ZOOMS, default.zoom);
        self
    }

    /// The ways that the picture needs.
    pub(crate) fn shown(&self) -> &[Way] {
        match self.layout {
            Layout::Single => &self.ways[..1],
            Layout::Split | Layout::Difference => &self.ways,
        }
    }

    /// Whether the first way draws lights with an area as a collection of components.
    pub(crate) fn components(&self) -> Option<u32> {
        match self.ways[0] {
            Way::Technique(technique, Soft::Native) => technique.components(),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn remembered_and_read_again() {
        let settings = Settings {
            layout: Layout::Split,
            ways: ["map:filter=none".parse().expect("a way"), Way::None],
            antialiasing: Antialiasing::Samples(4),
            ..Settings::default()
        };
        let text = serde_json::to_string(&settings).expect("it can be written");
        assert_eq!(serde_json::from_str::<Settings>(&text).expect("and read"), settings, "{text}");
        let old: Settings =
            serde_json::from_str(r#"{"divider": 7, "unknown": 1}"#).expect("of another version");
        assert_eq!(old.sane().divider, *DIVIDERS.end(), "put right");
    }
}
