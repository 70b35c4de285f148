//! The command line: what may be written, and what is said when something else was.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, Subcommand, ValueEnum};

use crate::error::CliError;
use crate::technique::Technique;

/// The longest side of a picture, pixels: what OpenGL drivers allow for a texture, and the reference likewise.
pub(crate) const MAX_SIDE: u32 = 16_384;

/// The most pixels of a picture: 8K (7680x4320) fits, and takes some 8 GB as 4 samples a pixel with OpenGL.
pub(crate) const MAX_PIXELS: u64 = 1 << 25;

/// The most samples a pixel of the ray tracer; beyond it a 24-bit mantissa no longer gains.
const MAX_SAMPLES: u32 = 65_536;

/// The most samples of multisampling that may be asked for; drivers usually have 4 to 16.
const MAX_MSAA: u32 = 64;

/// Exact shadows: renders scene files with OpenGL, and traces their ground truth on the CPU.
#[derive(Debug, Parser)]
#[command(
    name = "antumbra",
    version,
    about = "Exact shadows: renders scene files with OpenGL, and traces their ground truth on the CPU.",
    long_about = "Exact shadows: renders scene files with OpenGL, and traces their ground truth on the CPU.\n\n\
        Without a command it renders the gallery, like `antumbra demo`.",
    after_help = "Examples:\n  \
        antumbra                                           the gallery, as PNG, in antumbra-demo/\n  \
        antumbra render scene.toml -o picture.png          one scene with OpenGL\n  \
        antumbra trace scene.toml -o truth.exr             the same, ray traced on the CPU\n  \
        antumbra check scene.toml                          is the scene file right, what is in it\n  \
        antumbra info                                      the OpenGL driver\n\n\
        Exit code: 0, or 2 with one line `error: ...`. No partial file is ever left behind.",
    args_conflicts_with_subcommands = true
)]
pub(crate) struct Cli {
    /// What to do; the gallery when left out.
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Render the gallery: scenes that come with the program
    #[command(after_help = "Examples:\n  \
        antumbra demo\n  \
        antumbra demo -o pictures --size 480x270\n  \
        antumbra demo --backend cpu                        ray traced, needs no OpenGL")]
    Demo(DemoArgs),
    /// Render a scene, with OpenGL unless told otherwise
    #[command(after_help = "Examples:\n  \
        antumbra render scene.toml -o picture.png\n  \
        antumbra render scene.toml -o picture.exr --size 1920x1080 --msaa 8\n  \
        antumbra render scene.toml -o picture.png --time 2.5 --visibility masks --json\n  \
        antumbra render scene.toml -o picture.png --backend cpu")]
    Render(RenderArgs),
    /// Ray trace a scene on the CPU: the ground truth
    #[command(after_help = "Examples:\n  \
        antumbra trace scene.toml -o truth.png\n  \
        antumbra trace scene.toml -o truth.exr --samples 1024 --visibility masks")]
    Trace(TraceArgs),
    /// Say whether scene files are right, and what is in them
    #[command(after_help = "Examples:\n  \
        antumbra check scene.toml\n  \
        antumbra check scenes/*.toml --json")]
    Check(CheckArgs),
    /// Say which OpenGL driver there is and what it can do
    #[command(after_help = "Examples:\n  \
        antumbra info\n  \
        antumbra info --json")]
    Info(InfoArgs),
}

/// What draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Backend {
    /// OpenGL
    Gl,
    /// The ray tracer on the CPU
    Cpu,
}

/// Arguments of `antumbra demo`.
#[derive(Debug, clap::Args)]
pub(crate) struct DemoArgs {
    /// Directory for the pictures; made if missing
    #[arg(short, long, value_name = "DIR", default_value = "antumbra-demo")]
    pub(crate) output: PathBuf,
    /// Size in pixels instead of each scene's own
    #[arg(long, value_name = "WxH", value_parser = parse_size, allow_hyphen_values = true)]
    pub(crate) size: Option<Size>,
    /// What draws: OpenGL where there is one, else the CPU
    #[arg(long, value_enum, value_name = "gl|cpu", hide_possible_values = true)]
    pub(crate) backend: Option<Backend>,
}

impl Default for DemoArgs {
    fn default() -> Self {
        Self { output: PathBuf::from("antumbra-demo"), size: None, backend: None }
    }
}

/// Which scene, which moment, how large, and where it goes: what rendering and tracing have in common.
#[derive(Debug, clap::Args)]
pub(crate) struct PictureArgs {
    /// The scene file
    #[arg(value_name = "SCENE")]
    pub(crate) scene: PathBuf,
    /// The picture: .png (8-bit sRGB) or .exr (linear 32-bit float)
    #[arg(short, long, value_name = "OUT.png|OUT.exr")]
    pub(crate) output: PathBuf,
    /// Size in pixels instead of the scene's own
    #[arg(long, value_name = "WxH", value_parser = parse_size, allow_hyphen_values = true)]
    pub(crate) size: Option<Size>,
    /// The moment of moving lights and objects, seconds
    #[arg(long, value_name = "SECONDS", value_parser = parse_time, default_value = "0", allow_hyphen_values = true)]
    pub(crate) time: f64,
    /// Also write the visibility of each light, DIR/<light name>.png, 16-bit grey
    ///
    /// Visibility of the surface seen through each pixel's centre: 65535 is lit, 0 dark, background 65535.
    #[arg(long, value_name = "DIR")]
    pub(crate) visibility: Option<PathBuf>,
    /// Print one JSON object on standard output instead of text
    #[arg(long)]
    pub(crate) json: bool,
}

/// Arguments of `antumbra render`.
#[derive(Debug, clap::Args)]
pub(crate) struct RenderArgs {
    /// Scene, moment, size and files.
    #[command(flatten)]
    pub(crate) picture: PictureArgs,
    /// How shadows are found: analytic (OpenGL) or raytraced (CPU)
    #[arg(long, value_name = "NAME", value_parser = parse_technique)]
    pub(crate) technique: Option<Technique>,
    /// Samples a pixel of multisampling: 1, 2, 4, 8, ...; with the CPU, rays a pixel
    #[arg(long, value_name = "N", value_parser = parse_msaa, allow_hyphen_values = true)]
    pub(crate) msaa: Option<u32>,
    /// What draws: gl (OpenGL) or cpu (the ray tracer)
    #[arg(long, value_enum, value_name = "gl|cpu", hide_possible_values = true)]
    pub(crate) backend: Option<Backend>,
}

/// Arguments of `antumbra trace`.
#[derive(Debug, clap::Args)]
pub(crate) struct TraceArgs {
    /// Scene, moment, size and files.
    #[command(flatten)]
    pub(crate) picture: PictureArgs,
    /// Rays a pixel, each with a sample of every area light
    #[arg(long, value_name = "N", value_parser = parse_samples, allow_hyphen_values = true, default_value = "64")]
    pub(crate) samples: u32,
}

/// Arguments of `antumbra check`.
#[derive(Debug, clap::Args)]
pub(crate) struct CheckArgs {
    /// The scene files
    #[arg(value_name = "SCENE", required = true)]
    pub(crate) scenes: Vec<PathBuf>,
    /// Print one JSON object on standard output instead of text
    #[arg(long)]
    pub(crate) json: bool,
}

/// Arguments of `antumbra info`.
#[derive(Debug, clap::Args)]
pub(crate) struct InfoArgs {
    /// Print one JSON object on standard output instead of text
    #[arg(long)]
    pub(crate) json: bool,
}

/// Width and height of a picture, pixels; each in 1 to [`MAX_SIDE`], together at most [`MAX_PIXELS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    /// Pixels across.
    pub(crate) width: u32,
    /// Pixels down.
    pub(crate) height: u32,
}

impl Size {
    /// A size within the limits.
    ///
    /// # Errors
    /// What is wrong and what to do instead.
    pub(crate) fn new(width: u32, height: u32) -> Result<Self, String> {
        if width == 0 || height == 0 {
            return Err(format!("a picture of {width}x{height} has no pixels; give at least 1x1"));
        }
        if width > MAX_SIDE || height > MAX_SIDE {
            return Err(format!("{width}x{height} is too large; a side has at most {MAX_SIDE} pixels"));
        }
        if u64::from(width) * u64::from(height) > MAX_PIXELS {
            return Err(format!("{width}x{height} is too large; a picture has at most {MAX_PIXELS} pixels"));
        }
        Ok(Self { width, height })
    }

    /// Pixels in all.
    pub(crate) fn pixels(self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }
}

fn parse_size(text: &str) -> Result<Size, String> {
    let wrong = || "not a size; write width x height in pixels, such as 960x540".to_owned();
    let digits = |side: &str| -> Result<u32, String> {
        if side.is_empty() || !side.bytes().all(|byte| byte.is_ascii_digit()) {
            return Err(wrong());
        }
        // Digits alone, so the only failure left is a number beyond u32, which is too large in any case.
        Ok(side.parse().unwrap_or(u32::MAX))
    };
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(wrong)?;
    let (width, height) = (digits(width)?, digits(height)?);
    if width == u32::MAX || height == u32::MAX {
        return Err(format!("too large; a side has at most {MAX_SIDE} pixels"));
    }
    Size::new(width, height)
}

fn parse_time(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(time) if time.is_finite() => Ok(time),
        _ => Err("not a moment; give a finite number of seconds, such as 2.5".to_owned()),
    }
}

fn parse_samples(text: &str) -> Result<u32, String> {
    match text.parse::<u32>() {
        Ok(samples) if (1..=MAX_SAMPLES).contains(&samples) => Ok(samples),
        _ => Err(format!("not a number of samples; give a whole number from 1 to {MAX_SAMPLES}")),
    }
}

fn parse_msaa(text: &str) -> Result<u32, String> {
    match text.parse::<u32>() {
        Ok(samples) if samples.is_power_of_two() && samples <= MAX_MSAA => Ok(samples),
        _ => {
            Err("not a number of samples; give 1 (off), 2, 4, 8 or another power of two that the driver has"
                .to_owned())
        }
    }
}

fn parse_technique(text: &str) -> Result<Technique, String> {
    Technique::from_name(text)
        .ok_or_else(|| format!("no such technique; there are {}", Technique::names().join(" and ")))
}

/// Reads the command line.
///
/// # Errors
/// [`CliError::Usage`] for a wrong command line, in one sentence; [`CliError::Help`] carries the text that `--help`
/// or `--version` asked for.
pub(crate) fn parse(arguments: impl IntoIterator<Item = OsString>) -> Result<Cli, CliError> {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    Cli::try_parse_from(&arguments).map_err(|error| match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => CliError::Help(error.render().to_string()),
        _ => {
            let command = Cli::command();
            let named = arguments.get(1).and_then(|word| command.find_subcommand(word));
            CliError::Usage(describe(&error, named.map(clap::Command::get_name)))
        }
    })
}

/// One sentence from clap's paragraphs: what is wrong, the nearest thing that exists, and where to read more about
/// `command`.
fn describe(error: &clap::Error, command: Option<&str>) -> String {
    let text = error.render().to_string();
    let text = text.split("\n\nUsage:").next().unwrap_or_default();
    let text = text.split("\n\nFor more information").next().unwrap_or_default();
    let text = text.strip_prefix("error: ").unwrap_or(text);
    let mut sentence = String::new();
    for line in text.lines().map(str::trim).filter(|line| !line.is_empty()) {
        let (separator, line) = match line.strip_prefix("tip: ") {
            // The escape hatch `-- --word` is no help to someone who mistyped an option.
            Some(tip) if tip.contains("' as a value, use '") => continue,
            Some(tip) => ("; ", tip),
            None if sentence.is_empty() => ("", line),
            None => (" ", line),
        };
        sentence.push_str(separator);
        sentence.push_str(line);
    }
    if !sentence.contains(';') {
        sentence.push_str("; try `antumbra ");
        if let Some(command) = command {
            sentence.push_str(command);
            sentence.push(' ');
        }
        sentence.push_str("--help`");
    }
    sentence
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_definition_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn sizes() {
        assert_eq!(parse_size("960x540"), Ok(Size { width: 960, height: 540 }), "the plain case");
        assert_eq!(parse_size("1X1"), Ok(Size { width: 1, height: 1 }), "a capital X, the smallest");
        assert_eq!(parse_size("16384x2048"), Ok(Size { width: 16_384, height: 2_048 }), "the largest");
        for wrong in ["", "x", "10", "10x", "x10", "0x10", "10x0", "-1x10", "1.5x2", "16385x1", "8192x4097"] {
            assert!(parse_size(wrong).is_err(), "{wrong} is no size");
        }
        for wrong in ["99999999999x1", "1x4294967295", "+1x1", "1x1x1", "１x１", "1 x 1"] {
            assert!(parse_size(wrong).is_err(), "{wrong} is no size");
        }
    }

    #[test]
    fn times_are_finite() {
        assert_eq!(parse_time("-2.5"), Ok(-2.5), "time may run backwards");
        for wrong in ["nan", "inf", "-inf", "1e999", "", "1s"] {
            assert!(parse_time(wrong).is_err(), "{wrong} is no moment");
        }
    }

    #[test]
    fn multisampling_is_a_power_of_two() {
        for samples in [1, 2, 4, 8, 16, 32, 64] {
            assert_eq!(parse_msaa(&samples.to_string()), Ok(samples), "{samples} is a power of two");
        }
        for wrong in ["0", "3", "128", "-4", "4.0", ""] {
            assert!(parse_msaa(wrong).is_err(), "{wrong} is none");
        }
    }
}
