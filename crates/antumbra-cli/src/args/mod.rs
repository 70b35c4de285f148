//! The command line: what may be written, and what is said when something else was.

mod figure;
mod values;

use std::ffi::OsString;
use std::path::PathBuf;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, Subcommand, ValueEnum};

pub(crate) use figure::FigureName;
pub(crate) use values::{FPS, MAX_ANIMATION_FRAMES, MAX_SIDE, Size};
use values::{
    parse_animation_frames, parse_duration, parse_fps, parse_frames, parse_msaa, parse_samples, parse_size,
    parse_time,
};

use antumbra::Soft;

use crate::error::CliError;
use crate::technique::Technique;

/// Exact shadows: renders scene files with OpenGL, and traces their ground truth on the CPU.
#[derive(Debug, Parser)]
#[command(
    name = "antumbra",
    version,
    about = "Exact shadows: renders scene files with OpenGL, and traces their ground truth on the CPU.",
    long_about = "Exact shadows: renders scene files with OpenGL, and traces their ground truth on the CPU.\n\n\
        Without a command it opens the viewer, like `antumbra view`, or where there is no window system renders the \
        gallery, like `antumbra demo`.",
    after_help = "Examples:\n  \
        antumbra                                           the viewer; without a display, the gallery as PNG\n  \
        antumbra view scene.toml                           look at a scene, change it, compare techniques\n  \
        antumbra render scene.toml -o picture.png          one scene with OpenGL\n  \
        antumbra trace scene.toml -o truth.exr             the same, ray traced on the CPU\n  \
        antumbra animate scene.toml -o loop.apng           one round of all that moves\n  \
        antumbra check scene.toml                          is the scene file right, what is in it\n  \
        antumbra compare scene.toml                        every technique beside the truth, as a page\n  \
        antumbra bench                                     how long every technique takes, as charts\n  \
        antumbra info                                      the OpenGL driver\n\n\
        Exit code: 0, or 2 with one line `error: ...`; 128 and the number of a signal that ended it.\n\
        Every file that is asked for appears as a whole or not at all. An error, Ctrl-C or termination leaves no \
        temporary one; a kill that no program can catch may leave one, `.antumbra-*.tmp`.",
    args_conflicts_with_subcommands = true
)]
pub(crate) struct Cli {
    /// What to do; the viewer, or the gallery where there is no display, when left out.
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Look at a scene in a window, change it, and compare techniques side by side
    #[cfg(feature = "viewer")]
    #[command(after_help = "Examples:\n  \
        antumbra view\n  \
        antumbra view scene.toml\n  \
        antumbra view scene.toml --technique map:filter=none --size 1600x900\n\n\
        F1 in the window shows the keys. With --json each change of the state is a line on standard output:\n\
        camera, lights, objects, settings, and where each control is.")]
    View(ViewArgs),
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
        antumbra render scene.toml -o picture.png --technique NAME:key=value\n  \
        antumbra render scene.toml -o picture.png --backend cpu")]
    Render(RenderArgs),
    /// Render one round of a scene's motions, as an animated PNG
    #[command(after_help = "Examples:\n  \
        antumbra animate scene.toml -o loop.apng\n  \
        antumbra animate scene.toml -o loop.apng --size 480x270 --fps 30\n  \
        antumbra animate scene.toml -o loop.png --frames 48    a whole round in 48 frames\n  \
        antumbra animate scene.toml -o part.apng --from 2.5 --duration 3\n  \
        antumbra animate scene.toml -o truth.apng --technique raytraced --size 240x135\n\n\
        Web browsers play the file; what knows no animation shows its first frame.")]
    Animate(AnimateArgs),
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
    /// Hold every technique against the ray traced truth on one scene: a page, a contact sheet, numbers
    #[command(after_help = "Examples:\n  \
        antumbra compare scene.toml\n  \
        antumbra compare scene.toml -o comparison --size 640x360 --time 1.5\n  \
        antumbra compare scene.toml --techniques analytic,map:size=512,map:size=2048 --json\n\n\
        Writes DIR/index.html (open it in a browser), DIR/contact-sheet.png and DIR/compare.json.")]
    Compare(CompareArgs),
    /// Measure how long every technique takes: charts, tables and the scenes measured
    #[command(after_help = "Examples:\n  \
        antumbra bench\n  \
        antumbra bench --figure lights --frames 60 -o measured\n  \
        antumbra bench --figure primitives --techniques analytic,raytraced --size 256x256 --json\n\n\
        Writes DIR/bench.json, DIR/bench.csv, a chart DIR/FIGURE.svg for each figure (of `soft` also\n\
        DIR/soft-error.svg: error inside the penumbra over time), and every scene measured as DIR/scenes/*.toml.")]
    Bench(BenchArgs),
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

/// What a shadow looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Shade {
    /// Painted with the papers' grey
    Paper,
    /// Without the light's contribution
    Physical,
}

impl Shade {
    /// The value of the option `shade` of a technique.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Physical => "physical",
        }
    }
}

/// How the shadows of several occluders under one light with an area are put together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Quality {
    /// As the product of what each leaves
    Fast,
    /// As the union of what they hide
    Exact,
}

impl Quality {
    /// The value of the option `quality` of a technique.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Fast => "fast",
            Self::Exact => "exact",
        }
    }
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

/// Arguments of `antumbra view`.
#[cfg(feature = "viewer")]
#[derive(Debug, Default, clap::Args)]
pub(crate) struct ViewArgs {
    /// The scene file; without one, what was looked at last, or else one of the gallery
    #[arg(value_name = "SCENE")]
    pub(crate) scene: Option<PathBuf>,
    /// How shadows are found at first: a technique with options, as for `antumbra render`
    #[arg(long, value_name = "NAME[:key=value..]", value_parser = Technique::parse)]
    pub(crate) technique: Option<Technique>,
    /// Size of the window
    #[arg(long, value_name = "WxH", value_parser = parse_size, allow_hyphen_values = true)]
    pub(crate) size: Option<Size>,
    /// Begin as at the first start: forget settings, scene and window size
    #[arg(long)]
    pub(crate) fresh: bool,
    /// Print the keys, then the state whenever it changes, each as a line of JSON on standard output
    #[arg(long)]
    pub(crate) json: bool,
}

/// How shadows are found and what they look like: what pictures and animations have in common.
#[derive(Debug, clap::Args)]
pub(crate) struct LookArgs {
    #[arg(long, value_name = "NAME[:key=value..]", value_parser = Technique::parse,
        help = Technique::help(), long_help = Technique::long_help())]
    pub(crate) technique: Option<Technique>,
    /// What a shadow looks like, for the techniques with an option `shade`: painted as the papers do, or without the
    /// light's contribution
    #[arg(long, value_enum, value_name = "paper|physical", hide_possible_values = true)]
    pub(crate) shade: Option<Shade>,
    /// How several occluders under one light with an area are put together, for the techniques with an option `quality`:
    /// by the product of what each leaves, or by the union of what they hide, at several times the cost
    #[arg(long, value_enum, value_name = "fast|exact", hide_possible_values = true)]
    pub(crate) quality: Option<Quality>,
    /// How lights with an area are drawn: in the technique's own way, or as N hard lights whose shadows are averaged
    /// (N:row for a row of them)
    #[arg(long, value_name = "native|samples:N")]
    pub(crate) soft: Option<Soft>,
    /// Samples a pixel of multisampling: 1, 2, 4, 8, ...; with the CPU, rays a pixel
    #[arg(long, value_name = "N", value_parser = parse_msaa, allow_hyphen_values = true)]
    pub(crate) msaa: Option<u32>,
}

/// Arguments of `antumbra render`.
#[derive(Debug, clap::Args)]
pub(crate) struct RenderArgs {
    /// Scene, moment, size and files.
    #[command(flatten)]
    pub(crate) picture: PictureArgs,
    /// How.
    #[command(flatten)]
    pub(crate) look: LookArgs,
    /// What draws: gl (OpenGL) or cpu (the ray tracer)
    #[arg(long, value_enum, value_name = "gl|cpu", hide_possible_values = true)]
    pub(crate) backend: Option<Backend>,
}

/// Arguments of `antumbra animate`.
#[derive(Debug, clap::Args)]
pub(crate) struct AnimateArgs {
    /// The scene file
    #[arg(value_name = "SCENE")]
    pub(crate) scene: PathBuf,
    /// The animation: .apng or .png, both animated PNG (8-bit sRGB)
    #[arg(short, long, value_name = "OUT.apng")]
    pub(crate) output: PathBuf,
    /// How many frames: as many as --fps makes of the duration when left out; without --fps they are spread over the
    /// duration
    #[arg(long, value_name = "N", value_parser = parse_animation_frames, allow_hyphen_values = true)]
    pub(crate) frames: Option<u32>,
    /// Frames a second; 20 when left out
    #[arg(long, value_name = "F", value_parser = parse_fps, allow_hyphen_values = true)]
    pub(crate) fps: Option<f64>,
    /// The moment of the first frame, seconds
    #[arg(long, value_name = "SECONDS", value_parser = parse_time, default_value = "0", allow_hyphen_values = true)]
    pub(crate) from: f64,
    /// How long it is; when left out, until all motions repeat, or the longest one if that takes over a minute
    #[arg(long, value_name = "SECONDS", value_parser = parse_duration, allow_hyphen_values = true)]
    pub(crate) duration: Option<f64>,
    /// Size in pixels instead of the scene's own
    #[arg(long, value_name = "WxH", value_parser = parse_size, allow_hyphen_values = true)]
    pub(crate) size: Option<Size>,
    /// How.
    #[command(flatten)]
    pub(crate) look: LookArgs,
    /// Print one JSON object on standard output instead of text
    #[arg(long)]
    pub(crate) json: bool,
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

/// Arguments of `antumbra compare`.
#[derive(Debug, clap::Args)]
pub(crate) struct CompareArgs {
    /// The scene file
    #[arg(value_name = "SCENE")]
    pub(crate) scene: PathBuf,
    /// Directory for the page, the sheet and the numbers; made if missing
    #[arg(short, long, value_name = "DIR", default_value = "antumbra-compare")]
    pub(crate) output: PathBuf,
    /// The techniques, with options, instead of all of them (`antumbra render --help` lists them)
    #[arg(long, value_name = "A,B:key=value,..", value_delimiter = ',', value_parser = Technique::parse)]
    pub(crate) techniques: Vec<Technique>,
    /// How lights with an area are drawn, with all techniques: in their own way, or as N hard lights whose shadows are
    /// averaged; for one technique alone write NAME+samples:N
    #[arg(long, value_name = "native|samples:N")]
    pub(crate) soft: Option<Soft>,
    /// Size in pixels instead of the scene's own
    #[arg(long, value_name = "WxH", value_parser = parse_size, allow_hyphen_values = true)]
    pub(crate) size: Option<Size>,
    /// The moment of moving lights and objects, seconds
    #[arg(long, value_name = "SECONDS", value_parser = parse_time, default_value = "0", allow_hyphen_values = true)]
    pub(crate) time: f64,
    /// Rays a pixel of the reference picture
    #[arg(long, value_name = "N", value_parser = parse_samples, allow_hyphen_values = true, default_value = "64")]
    pub(crate) samples: u32,
    /// Frames that each technique is timed with
    #[arg(long, value_name = "N", value_parser = parse_frames, allow_hyphen_values = true, default_value = "20")]
    pub(crate) frames: u32,
    /// Print the JSON object on standard output instead of text
    #[arg(long)]
    pub(crate) json: bool,
}

/// Arguments of `antumbra bench`.
#[derive(Debug, clap::Args)]
pub(crate) struct BenchArgs {
    /// One figure instead of all
    #[arg(long, value_enum, value_name = "NAME")]
    pub(crate) figure: Option<FigureName>,
    /// Directory for charts, tables and scenes; made if missing
    #[arg(short, long, value_name = "DIR", default_value = "antumbra-bench")]
    pub(crate) output: PathBuf,
    /// The techniques, with options, instead of each figure's own (`antumbra render --help` lists them)
    #[arg(long, value_name = "A,B:key=value,..", value_delimiter = ',', value_parser = Technique::parse)]
    pub(crate) techniques: Vec<Technique>,
    /// Frames measured in each place of a figure, with and without shadows
    #[arg(long, value_name = "N", value_parser = parse_frames, allow_hyphen_values = true, default_value = "30")]
    pub(crate) frames: u32,
    /// Size of the frames in pixels; of `resolution`, the shape alone
    #[arg(long, value_name = "WxH", value_parser = parse_size, allow_hyphen_values = true, default_value = "512x512")]
    pub(crate) size: Size,
    /// Print the JSON object on standard output instead of text
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
}
