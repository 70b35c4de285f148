//! The ways to find shadows: those of the library, which draw with OpenGL, and the ray tracer.

use std::fmt;

use antumbra::Soft;
use antumbra_scene::Scene;

/// The name of the ray tracer.
const RAYTRACED: &str = "raytraced";

/// A technique with its options.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Technique {
    /// One of the library's, with OpenGL, and how it draws lights with an area.
    Gl(antumbra::Technique, Soft),
    /// The ray tracer, on the CPU.
    Raytraced,
}

impl Technique {
    /// Every technique, with the options it has by default; the ray tracer last.
    pub(crate) fn all() -> Vec<Self> {
        antumbra::Technique::all().map(Self::from).chain([Self::Raytraced]).collect()
    }

    /// A name, then options as `:key=value`, then `+` and how lights with an area are drawn, if not in the technique's
    /// own way.
    ///
    /// # Errors
    /// What is wrong with it, and which names there are.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        if let Some((technique, soft)) = text.split_once('+') {
            return Self::parse(technique)?
                .with_soft(soft.parse::<Soft>().map_err(|error| error.to_string())?);
        }
        match text.split(':').next() {
            Some(RAYTRACED) if text == RAYTRACED => Ok(Self::Raytraced),
            Some(RAYTRACED) => Err(format!("technique {RAYTRACED} has no options; write {RAYTRACED} alone")),
            Some(name) if !antumbra::Technique::NAMES.contains(&name) => Err(format!(
                "there is no technique `{name}`; the techniques are {} and {RAYTRACED}",
                antumbra::Technique::NAMES.join(", ")
            )),
            _ => antumbra::Technique::parse(text).map(Self::from).map_err(|error| error.to_string()),
        }
    }

    /// What `--help` says of them in one line.
    pub(crate) fn help() -> String {
        format!(
            "How shadows are found: {} or {RAYTRACED}, with options",
            antumbra::Technique::NAMES.join(", ")
        )
    }

    /// What `--help` says of them, a line each.
    pub(crate) fn long_help() -> String {
        let all = Self::all();
        let wide = all.iter().map(|technique| technique.name().len()).max().unwrap_or(0);
        let lines =
            all.iter().map(|technique| format!("  {:wide$}  {}", technique.name(), technique.summary()));
        format!("{}\n\n{}", Self::help(), lines.collect::<Vec<_>>().join("\n"))
    }

    /// The same technique with one of its options set.
    ///
    /// # Errors
    /// That it has no such option.
    pub(crate) fn with_option(mut self, key: &str, value: &str) -> Result<Self, String> {
        match &mut self {
            Self::Gl(technique, _) => {
                technique.set(key, value).map_err(|what| format!("technique {}: {what}", technique.name()))?
            }
            Self::Raytraced => return Err(format!("technique {RAYTRACED} has no options")),
        }
        Ok(self)
    }

    /// The same technique with lights with an area drawn so.
    ///
    /// # Errors
    /// That the ray tracer has a way of its own.
    pub(crate) fn with_soft(self, soft: Soft) -> Result<Self, String> {
        match self {
            Self::Gl(technique, _) => Ok(Self::Gl(technique, soft)),
            Self::Raytraced => Err(format!(
                "technique {RAYTRACED} samples lights anew for every ray; give it --msaa N or --samples N"
            )),
        }
    }

    /// How it draws lights with an area, for tables.
    pub(crate) fn soft(&self) -> String {
        match self {
            Self::Gl(antumbra::Technique::Analytic(_), Soft::Native) => "closed-form".into(),
            Self::Gl(_, soft) => soft.to_string(),
            Self::Raytraced => "rays".into(),
        }
    }

    /// How many points stand for a light with an area; `None` where it is drawn as the area that it is.
    pub(crate) fn components(&self) -> Option<u32> {
        match self {
            Self::Gl(_, Soft::Samples { count, .. }) => Some(*count),
            Self::Gl(technique, _) => technique.components(),
            Self::Raytraced => None,
        }
    }

    /// What it is called whatever the number of such points.
    pub(crate) fn family(&self) -> String {
        match *self {
            Self::Gl(antumbra::Technique::Composite(mut options), Soft::Native) => {
                options.components = antumbra::technique::composite::Options::default().components;
                antumbra::Technique::Composite(options).to_string()
            }
            Self::Gl(technique, soft @ Soft::Samples { count, .. }) => {
                format!("{technique}+{}", soft.to_string().replacen(&count.to_string(), "N", 1))
            }
            technique => technique.to_string(),
        }
    }

    /// Its name, without options.
    pub(crate) fn name(&self) -> &'static str {
        match self {
            Self::Gl(technique, _) => technique.name(),
            Self::Raytraced => RAYTRACED,
        }
    }

    /// What it does, in one sentence.
    pub(crate) fn summary(&self) -> &'static str {
        match self {
            Self::Gl(technique, _) => technique.about().summary,
            Self::Raytraced => "the reference: every ray traced on the CPU in double precision",
        }
    }

    /// Why it cannot do a scene at a moment, with the object and a technique that can; `None` where it can.
    pub(crate) fn objection(&self, scene: &Scene, time: f64) -> Option<String> {
        match self {
            Self::Gl(technique, soft) => {
                antumbra_host::objection(scene, &scene.moment(time), technique, *soft)
                    .map(|error| error.to_string())
            }
            Self::Raytraced => None,
        }
    }
}

impl From<antumbra::Technique> for Technique {
    fn from(technique: antumbra::Technique) -> Self {
        Self::Gl(technique, Soft::Native)
    }
}

impl fmt::Display for Technique {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Gl(technique, Soft::Native) => technique.fmt(f),
            Self::Gl(technique, soft) => write!(f, "{technique}+{soft}"),
            Self::Raytraced => f.write_str(RAYTRACED),
        }
    }
}
