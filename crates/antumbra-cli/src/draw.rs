//! Drawing a scene, with OpenGL or on the CPU: what rendering, tracing and the gallery share.

use std::time::Instant;

use antumbra_host::{Api, ContextInfo, HeadlessContext, HostError, RenderOptions, Stage};
use antumbra_reference::{Sampling, Tracer};
use antumbra_scene::Scene;
use serde::Serialize;

use crate::args::Size;
use crate::error::CliError;
use crate::output::png::visibility_level;

/// Multisampling where none is asked for: smooth edges at little cost, and every OpenGL 3.3 driver has it.
const DEFAULT_MSAA: u32 = 4;

/// What to draw.
pub(crate) struct Request<'a> {
    /// The scene.
    pub(crate) scene: &'a Scene,
    /// Size of the picture.
    pub(crate) size: Size,
    /// The moment, seconds.
    pub(crate) time: f64,
    /// Whether the visibility of each light is wanted too.
    pub(crate) visibility: bool,
    /// Whether the picture has shadows, where OpenGL draws it.
    pub(crate) shadows: bool,
}

/// What was drawn.
pub(crate) struct Drawing {
    /// Linear radiance without exposure, rows top to bottom.
    pub(crate) pixels: Vec<[f32; 3]>,
    /// Levels of each light's visibility, rows top to bottom; empty where it was not asked for.
    pub(crate) visibility: Vec<Vec<u16>>,
    /// Time it took, without reading the scene and writing files.
    pub(crate) milliseconds: f64,
    /// Samples a pixel.
    pub(crate) samples: u32,
}

/// The driver in use.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Driver {
    /// Who made it.
    pub(crate) vendor: String,
    /// The device, as the driver names it.
    pub(crate) renderer: String,
    /// The version of OpenGL, and usually of the driver.
    pub(crate) version: String,
    /// Whether the CPU does the work.
    pub(crate) software: bool,
}

impl From<&ContextInfo> for Driver {
    fn from(info: &ContextInfo) -> Self {
        Self {
            vendor: info.vendor.clone(),
            renderer: info.renderer.clone(),
            version: info.version.clone(),
            software: info.software,
        }
    }
}

/// OpenGL without a window, and the renderer on it.
pub(crate) struct OpenGl {
    // Declared first, so dropped first: it deletes its objects while there still is a context.
    stage: Stage,
    context: HeadlessContext,
}

impl OpenGl {
    /// Opens OpenGL 3.3, or OpenGL ES 3.0 where a driver has only that.
    ///
    /// # Errors
    /// [`HostError::NoOpenGl`] where there is none.
    pub(crate) fn open() -> Result<Self, HostError> {
        let context = open_context()?;
        let stage = Stage::new(context.gl())?;
        Ok(Self { stage, context })
    }

    /// The driver.
    pub(crate) fn driver(&self) -> Driver {
        Driver::from(&self.context.info())
    }

    /// The context.
    pub(crate) fn context(&self) -> &HeadlessContext {
        &self.context
    }

    /// Draws a scene with `technique` and `msaa` samples a pixel (4, or what the driver has, where it is `None`).
    ///
    /// # Errors
    /// [`CliError::Usage`] where the driver has fewer samples than asked for; [`CliError::OpenGl`] for what the
    /// technique or the driver cannot do.
    pub(crate) fn draw(
        &mut self,
        request: &Request,
        (technique, soft): (antumbra::Technique, antumbra::Soft),
        msaa: Option<u32>,
    ) -> Result<Drawing, CliError> {
        let most = self.stage.shadows().caps().max_samples.max(1);
        let msaa = msaa.unwrap_or(DEFAULT_MSAA.min(most));
        if msaa > most {
            return Err(CliError::Usage(format!(
                "--msaa {msaa} is more than this driver has; give at most {most}"
            )));
        }
        let options = RenderOptions {
            time: request.time,
            width: request.size.width,
            height: request.size.height,
            msaa,
            visibility: request.visibility,
            shadows: request.shadows,
            technique,
            soft,
        };
        let start = Instant::now();
        let rendered = self.stage.render(request.scene, &options).map_err(CliError::OpenGl)?;
        let milliseconds = start.elapsed().as_secs_f64() * 1e3;
        let visibility = rendered.visibility.iter().map(|values| levels(values)).collect();
        Ok(Drawing { pixels: rendered.image, visibility, milliseconds, samples: msaa })
    }
}

/// A context of OpenGL 3.3, or of OpenGL ES 3.0 where a driver has only that.
///
/// # Errors
/// [`HostError::NoOpenGl`] where there is neither.
pub(crate) fn open_context() -> Result<HeadlessContext, HostError> {
    HeadlessContext::new(Api::Gl33).or_else(|error| HeadlessContext::new(Api::Gles30).map_err(|_| error))
}

/// Traces a scene on the CPU with `samples` rays a pixel. `progress` is told what is being done, and how much of it.
pub(crate) fn trace(request: &Request, samples: u32, progress: &(dyn Fn(&str, u64, u64) + Sync)) -> Drawing {
    let Size { width, height } = request.size;
    let start = Instant::now();
    let tracer = Tracer::new(request.scene, request.time);
    let pixels = tracer.render(width, height, samples, &|done, total| progress("picture", done, total));
    let mut visibility = Vec::new();
    if request.visibility {
        for (index, light) in request.scene.lights.iter().enumerate() {
            let sampling = Sampling::Center { light_samples: samples };
            let told = |done, total| progress(&light.name, done, total);
            visibility.push(levels(&tracer.visibility(index, width, height, sampling, &told)));
        }
    }
    Drawing { pixels, visibility, milliseconds: start.elapsed().as_secs_f64() * 1e3, samples }
}

fn levels(visibility: &[f32]) -> Vec<u16> {
    visibility.iter().map(|&value| visibility_level(value)).collect()
}
