//! The ways to find shadows, by name.

use antumbra_scene::Scene;

/// A technique that exists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Technique {
    /// Exact closed forms, with OpenGL.
    Analytic,
    /// The ray tracer, on the CPU.
    Raytraced,
}

impl Technique {
    /// Every technique.
    pub(crate) const ALL: [Self; 2] = [Self::Analytic, Self::Raytraced];

    /// Its name on the command line.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Analytic => "analytic",
            Self::Raytraced => "raytraced",
        }
    }

    /// The technique of that name.
    pub(crate) fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|technique| technique.name() == name)
    }

    /// The names of all.
    pub(crate) fn names() -> Vec<&'static str> {
        Self::ALL.map(Self::name).to_vec()
    }

    /// Why it cannot do a scene, with the object and a technique that can; `None` where it can.
    pub(crate) fn objection(self, scene: &Scene) -> Option<String> {
        match self {
            Self::Analytic => {
                let technique = antumbra::Technique::default();
                antumbra_host::objection(scene, &scene.moment(0.0), &technique).map(|error| error.to_string())
            }
            Self::Raytraced => None,
        }
    }
}
