//! `antumbra info`: the OpenGL driver.

use antumbra::{Caps, Tier};
use antumbra_host::HostError;
use serde::Serialize;

use crate::args::InfoArgs;
use crate::console;
use crate::draw::{Driver, open_context};
use crate::error::{CliError, OneLine};

/// What is known of OpenGL on this machine; with `--json` printed as it is.
#[derive(Debug, Serialize)]
struct Info {
    /// Version of this program.
    antumbra: &'static str,
    /// Whether there is an OpenGL that will do.
    opengl: bool,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    /// The driver.
    #[serde(skip_serializing_if = "Option::is_none")]
    driver: Option<Driver>,
    /// What antumbra can do with it.
    #[serde(skip_serializing_if = "Option::is_none")]
    tier: Option<&'static str>,
    /// The tier in words, for text.
    #[serde(skip)]
    tier_in_words: &'static str,
    /// Version of the shading language.
    #[serde(skip_serializing_if = "Option::is_none")]
    shading_language: Option<String>,
    /// The most samples a pixel.
    #[serde(skip_serializing_if = "Option::is_none")]
    max_msaa: Option<u32>,
}

/// Says what OpenGL there is.
///
/// # Errors
/// A driver that is there and fails; no OpenGL at all is an answer, not an error.
pub(crate) fn run(arguments: &InfoArgs) -> Result<(), CliError> {
    let info = gather()?;
    if arguments.json {
        return console::json(&info);
    }
    console::line(format_args!("antumbra          {}", info.antumbra))?;
    let Some(driver) = info.driver else {
        let why = info.reason.unwrap_or_default();
        console::line(format_args!("OpenGL            none: {}", OneLine(why)))?;
        return console::line(
            "On Debian or Ubuntu `apt-get install libegl1 libgl1-mesa-dri` brings a software OpenGL. \
            Without one, `antumbra render --backend cpu` and `antumbra trace` draw on the CPU.",
        );
    };
    let kind = if driver.software { "software: the CPU draws" } else { "hardware" };
    console::line(format_args!("OpenGL            {}", OneLine(&driver.version)))?;
    console::line(format_args!("shading language  {}", OneLine(info.shading_language.unwrap_or_default())))?;
    console::line(format_args!("renderer          {} ({kind})", OneLine(&driver.renderer)))?;
    console::line(format_args!("vendor            {}", OneLine(&driver.vendor)))?;
    let tier = info.tier.unwrap_or("none");
    console::line(format_args!("tier              {tier} ({})", info.tier_in_words))?;
    console::line(format_args!("samples a pixel   {} at most", info.max_msaa.unwrap_or(1)))
}

/// The name of a tier, and what it can do.
fn tier(tier: Tier) -> (&'static str, &'static str) {
    match tier {
        Tier::Es3 => ("es3", "OpenGL ES 3.0: masks, and overlays of a few lights"),
        Tier::Es3Half => {
            ("es3-half", "OpenGL ES 3.0 with 16-bit floats: masks, and overlays of a few lights")
        }
        Tier::Es3Float => ("es3-float", "OpenGL ES 3.0 with floats that blend: masks and overlays"),
        Tier::Core33 => ("core33", "OpenGL 3.3: masks and overlays"),
        Tier::Core33Samples => {
            ("core33-samples", "OpenGL 3.3 with sample shading: masks and overlays, multisampled")
        }
        _ => ("other", "a tier that this program does not know"),
    }
}

fn gather() -> Result<Info, CliError> {
    let mut info = Info {
        antumbra: env!("CARGO_PKG_VERSION"),
        opengl: false,
        reason: None,
        driver: None,
        tier: None,
        tier_in_words: "too old for shadows",
        shading_language: None,
        max_msaa: None,
    };
    match open_context() {
        Ok(context) => {
            let found = context.info();
            info.opengl = true;
            info.driver = Some(Driver::from(&found));
            if let Ok(caps) = Caps::query(context.gl()) {
                info.max_msaa = Some(caps.max_samples);
                let (name, words) = tier(caps.tier);
                info.tier = Some(name);
                info.tier_in_words = words;
            }
            info.shading_language = Some(found.shading_language);
        }
        Err(HostError::NoOpenGl(why)) => info.reason = Some(why.to_string()),
        Err(error) => return Err(CliError::OpenGl(error)),
    }
    Ok(info)
}
