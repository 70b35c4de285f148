//! `antumbra demo`: the gallery.

use std::path::Path;

use antumbra_host::HostError;
use antumbra_scene::Scene;

use crate::args::{Backend, DemoArgs, Size};
use crate::commands::picture;
use crate::console;
use crate::draw::{self, Drawing, OpenGl, Request};
use crate::error::{CliError, OneLine};
use crate::gallery::GALLERY;
use crate::output::Format;
use crate::output::plan::{check_directory, check_file};
use crate::output::staged::Staged;
use crate::progress::Progress;

/// Rays a pixel on the CPU: smooth edges and little noise in soft shadows, in seconds a picture.
const CPU_SAMPLES: u32 = 16;

/// Renders the gallery.
///
/// # Errors
/// Where the directory cannot be written to, or `--backend gl` is asked for and there is no OpenGL.
pub(crate) fn run(arguments: &DemoArgs) -> Result<(), CliError> {
    let directory = &arguments.output;
    check_directory(directory)?;
    for entry in GALLERY {
        check_file(&directory.join(file_name(entry.name)))?;
    }
    let mut gl = open(arguments.backend)?;
    let with = match &gl {
        Some(gl) => gl.driver().renderer,
        None => "the CPU".to_owned(),
    };

    let mut staged = Staged::default();
    staged.directory(directory)?;
    let progress = Progress::new("rendering", "scenes");
    progress.set(0, GALLERY.len() as u64);
    for (done, entry) in (1..).zip(GALLERY) {
        progress.message(entry.name);
        let scene = Scene::parse(entry.text, Path::new(&format!("{}.toml", entry.name)))?;
        let size = arguments.size.unwrap_or(Size { width: scene.image.width, height: scene.image.height });
        let drawing = draw_one(gl.as_mut(), &scene, size)?;
        staged.file(&directory.join(file_name(entry.name)), |to| {
            picture(&scene, size, &drawing).write(Format::Png, to)
        })?;
        progress.set(done, GALLERY.len() as u64);
    }
    drop(progress);
    staged.commit()?;
    console::line(format_args!(
        "{} pictures, drawn with {with}; look at {}",
        GALLERY.len(),
        OneLine(directory.join("*.png").display())
    ))
}

fn file_name(scene: &str) -> String {
    format!("{scene}.png")
}

/// OpenGL, or `None` to draw on the CPU: where that is asked for, or there is no OpenGL and it is not insisted on.
fn open(backend: Option<Backend>) -> Result<Option<OpenGl>, CliError> {
    if backend == Some(Backend::Cpu) {
        return Ok(None);
    }
    match OpenGl::open() {
        Ok(gl) => Ok(Some(gl)),
        Err(HostError::NoOpenGl(why)) if backend.is_none() => {
            console::note(format_args!(
                "there is no OpenGL here ({why}); drawing on the CPU instead, which takes longer"
            ));
            Ok(None)
        }
        Err(error) => Err(CliError::OpenGl(error)),
    }
}

/// Draws with OpenGL where there is one and the technique can do the scene, else on the CPU.
fn draw_one(gl: Option<&mut OpenGl>, scene: &Scene, size: Size) -> Result<Drawing, CliError> {
    let request = Request { scene, size, time: 0.0, visibility: false, shadows: true };
    if let Some(gl) = gl {
        return gl.draw(&request, (antumbra::Technique::default(), antumbra::Soft::Native), None);
    }
    Ok(draw::trace(&request, CPU_SAMPLES, &|_, _, _| ()))
}
