//! The commands, one file each.

mod animate;
mod bench;
mod check;
mod compare;
mod demo;
mod info;
mod look;
mod render;
mod trace;
#[cfg(feature = "viewer")]
mod view;

use antumbra_scene::Scene;

use crate::args::{Cli, Command, DemoArgs, PictureArgs, Size};
use crate::draw::{Drawing, Driver, Request};
use crate::error::CliError;
use crate::output::Picture;
use crate::output::plan::Plan;
use crate::report::{self, Report};
use crate::technique::Technique;

/// The most visibility values that are held at a time, lights times pixels: 2 GB as 32-bit float.
const MAX_VISIBILITY: u64 = 1 << 29;

/// Does what the command line says.
///
/// # Errors
/// Whatever ends the command early.
pub(crate) fn run(cli: Cli) -> Result<(), CliError> {
    let Some(command) = cli.command else { return run_default() };
    match command {
        #[cfg(feature = "viewer")]
        Command::View(arguments) => view::run(&arguments),
        Command::Demo(arguments) => demo::run(&arguments),
        Command::Render(arguments) => render::run(&arguments),
        Command::Animate(arguments) => animate::run(&arguments),
        Command::Trace(arguments) => trace::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Bench(arguments) => bench::run(&arguments),
        Command::Info(arguments) => info::run(&arguments),
    }
}

/// The viewer where there is a display, else the gallery.
fn run_default() -> Result<(), CliError> {
    #[cfg(feature = "viewer")]
    if view::run_if_possible()? {
        return Ok(());
    }
    demo::run(&DemoArgs::default())
}

/// One scene to one picture, everything about it checked.
struct Job {
    scene: Scene,
    size: Size,
    plan: Plan,
}

impl Job {
    /// Reads the scene and checks size and files, before the long work.
    fn new(arguments: &PictureArgs) -> Result<Self, CliError> {
        let scene = Scene::load(&arguments.scene)?;
        let size = size(arguments.size, &scene)?;
        if arguments.visibility.is_some() && size.pixels() * scene.lights.len() as u64 > MAX_VISIBILITY {
            return Err(CliError::Usage(format!(
                "{} visibilities of {}x{} are too large; give a smaller --size",
                scene.lights.len(),
                size.width,
                size.height
            )));
        }
        let visibility = arguments.visibility.as_deref();
        let plan = Plan::new(&arguments.scene, &arguments.output, visibility, &scene.lights)?;
        Ok(Self { scene, size, plan })
    }

    fn request(&self, arguments: &PictureArgs) -> Request<'_> {
        Request {
            scene: &self.scene,
            size: self.size,
            time: arguments.time,
            visibility: arguments.visibility.is_some(),
            shadows: true,
        }
    }

    /// Writes the files and says what was done; `driver` is that of OpenGL, `None` for the CPU.
    fn finish(
        self,
        arguments: &PictureArgs,
        technique: &Technique,
        drawing: &Drawing,
        driver: Option<Driver>,
    ) -> Result<(), CliError> {
        let on_cpu = driver.is_none();
        Report {
            scene: report::text(&arguments.scene),
            technique: technique.to_string(),
            backend: if on_cpu { "cpu" } else { "gl" },
            width: self.size.width,
            height: self.size.height,
            time: arguments.time,
            msaa: (!on_cpu).then_some(drawing.samples),
            samples: on_cpu.then_some(drawing.samples),
            lights: self.scene.lights.len(),
            objects: self.scene.objects.len(),
            driver,
            milliseconds: drawing.milliseconds,
            files: self.write(drawing)?,
        }
        .print(arguments.json)
    }

    /// Writes the files; returns their names.
    fn write(self, drawing: &Drawing) -> Result<Vec<String>, CliError> {
        let picture = picture(&self.scene, self.size, drawing);
        Ok(report::texts(&self.plan.write(&picture, &drawing.visibility)?))
    }
}

/// The size asked for, or the scene's own.
fn size(asked: Option<Size>, scene: &Scene) -> Result<Size, CliError> {
    match asked {
        Some(size) => Ok(size),
        None => Size::new(scene.image.width, scene.image.height)
            .map_err(|what| CliError::Usage(format!("the scene's own size: {what}; use --size"))),
    }
}

fn picture<'a>(scene: &Scene, size: Size, drawing: &'a Drawing) -> Picture<'a> {
    Picture {
        width: size.width,
        height: size.height,
        pixels: &drawing.pixels,
        exposure: scene.image.exposure,
    }
}
