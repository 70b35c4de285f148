//! What can draw what a technique refuses.

use antumbra::{Allowed, Scenery, Soft, Technique};

/// What can draw a scene that a technique refuses. The ray tracer always can, beside these.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Ways {
    /// How lights with an area were to be drawn.
    pub soft: Soft,
    /// The techniques that can with that, each with the option that it takes, if any.
    pub able: Vec<Technique>,
    /// Points in place of lights with an area, with which more can.
    pub samples: Option<Soft>,
    /// The techniques that can with these points alone; none if the refused one is among them, which then is the way.
    pub sampled: Vec<Technique>,
}

impl Ways {
    /// The ways where `refused` cannot.
    pub(crate) fn of(refused: &Technique, soft: Soft, scenery: &Scenery<'_>) -> Self {
        let can = |technique: &Technique, soft| technique.refusal_with(soft, scenery).is_none();
        let (mut able, others): (Vec<_>, Vec<_>) = Technique::all().partition(|other| can(other, soft));
        able.extend(others.iter().filter_map(|other| with_one_option(*other, &|it| can(it, soft))));
        let samples = Soft::samples(16);
        let mut sampled = Vec::new();
        let itself = soft == Soft::Native && can(refused, samples);
        if soft == Soft::Native && !itself {
            sampled = others.into_iter().filter(|other| can(other, samples)).collect();
        }
        let samples = (itself || !sampled.is_empty()).then_some(samples);
        Self { soft, able, samples, sampled }
    }

    /// As options of a command line.
    pub(crate) fn as_options(&self) -> String {
        // The ray tracer has a way of its own for lights with an area.
        let traced = if self.soft == Soft::Native { "raytraced" } else { "raytraced without --soft" };
        self.text(traced, "--technique ", "--soft ")
    }

    /// For people who have no command line before them.
    pub(crate) fn in_words(&self) -> String {
        self.text("raytraced", "", "")
    }

    fn text(&self, traced: &str, technique: &str, soft: &str) -> String {
        let names =
            |techniques: &[Technique]| techniques.iter().map(Technique::to_string).collect::<Vec<_>>();
        let mut able = names(&self.able);
        able.push(traced.to_owned());
        let mut text = format!("{technique}{}", able.join(" or "));
        if let Some(samples) = self.samples {
            text += &format!(", or {soft}{samples}");
            if !self.sampled.is_empty() {
                text += &format!(" with {technique}{}", names(&self.sampled).join(" or "));
            }
        }
        text
    }
}

/// The technique with the first value of one of its options with which it can.
fn with_one_option(technique: Technique, can: &dyn Fn(&Technique) -> bool) -> Option<Technique> {
    technique.options().iter().find_map(|option| {
        let values: Vec<&str> = match option.allowed {
            Allowed::Choice(choices) => choices.iter().map(|choice| choice.name).collect(),
            Allowed::Switch => vec!["on", "off"],
            // No number makes a technique able.
            _ => Vec::new(),
        };
        values.into_iter().find_map(|value| {
            let mut changed = technique;
            changed.set(option.key, value).ok()?;
            can(&changed).then_some(changed)
        })
    })
}

#[cfg(test)]
mod tests {
    use antumbra_scene::Scene;

    use super::*;
    use crate::objection;

    /// A floor, a shape and a light.
    fn scene(shape: &str, light: &str) -> Scene {
        let text = format!(
            "camera.eye = [0, 2, 5]\n[[light]]\nname = 'lamp'\nposition = [0, 4, 0]\nintensity = 9\n{light}\n\
             [[object]]\nname = 'floor'\nshape = {{ type = 'plane' }}\n\
             [[object]]\nname = 'thing'\ntranslation = [0, 1, 0]\nshape = {shape}\n"
        );
        Scene::parse(&text, "s.toml".as_ref()).unwrap_or_else(|e| panic!("{e}"))
    }

    const TORUS: &str = "{ type = 'torus', major_radius = 0.5, minor_radius = 0.2 }";
    const BALL: &str = "{ type = 'sphere', radius = 0.5 }";
    const POINT: &str = "type = 'point'";
    const BULB: &str = "type = 'sphere'\nradius = 0.3";

    #[test]
    fn every_way_is_named() {
        for (shape, light, technique, soft, expected) in [
            (TORUS, POINT, "analytic", "native", "--technique projected or volume or map or raytraced"),
            (
                TORUS,
                BULB,
                "analytic",
                "native",
                "--technique map:filter=pcss or raytraced, or --soft samples:16 with --technique projected or volume or map",
            ),
            (
                TORUS,
                BULB,
                "analytic",
                "samples:4",
                "--technique projected or volume or map or raytraced without --soft",
            ),
            (
                TORUS,
                BULB,
                "volume",
                "native",
                "--technique map:filter=pcss or raytraced, or --soft samples:16",
            ),
            (
                BALL,
                BULB,
                "volume",
                "native",
                "--technique analytic or composite or map:filter=pcss or raytraced, or --soft samples:16",
            ),
        ] {
            let scene = scene(shape, light);
            let moment = scene.moment(0.0);
            let read = |text: &str| Technique::parse(text).unwrap_or_else(|e| panic!("{e}"));
            let soft: Soft = soft.parse().unwrap_or_else(|e| panic!("{e}"));
            let error = objection(&scene, &moment, &read(technique), soft).expect("it is refused");
            let text = error.to_string();
            assert!(text.ends_with(&format!("; use {expected}")), "{text}");
            assert!(!error.in_words().contains("--"), "{}", error.in_words());
            // What is named is not refused.
            let crate::HostError::Unsupported { ways, .. } = error else { panic!("{error}") };
            for able in &ways.able {
                assert!(objection(&scene, &moment, able, soft).is_none(), "{able}");
            }
            for able in &ways.sampled {
                assert!(objection(&scene, &moment, able, Soft::samples(16)).is_none(), "{able}");
            }
        }
    }
}
