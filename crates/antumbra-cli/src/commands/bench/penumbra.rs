//! How far techniques are off inside penumbrae.

use antumbra_host::{RenderOptions, Stage};
use antumbra_reference::Tracer;
use antumbra_scene::Scene;
use antumbra_testkit::penumbra::Penumbra;

use super::figures::Place;
use super::report::Report;
use crate::error::CliError;
use crate::technique::Technique;

/// Writes the error of the visibility of a place's first light into the rows of what draws with OpenGL. What paints is
/// measured by its masks: the average over the same points of the light.
///
/// # Errors
/// Those of the scene and of the driver.
pub(super) fn measure(
    stage: &mut Stage,
    place: &Place,
    techniques: &[Technique],
    report: &mut Report,
) -> Result<(), CliError> {
    let scene = Scene::parse(&place.toml, format!("{}.toml", place.scene).as_ref())?;
    let (width, height) = (place.size.width, place.size.height);
    let truth = Penumbra::new(&scene, &Tracer::new(&scene, 0.0), 0, width, height);
    for technique in techniques {
        let Technique::Gl(gl, soft) = *technique else { continue };
        let name = technique.to_string();
        let mut rows = report.rows.iter_mut();
        let Some(row) = rows.find(|row| row.scene == place.scene && row.technique == name) else { continue };
        let options = RenderOptions {
            time: 0.0,
            width,
            height,
            msaa: 1,
            visibility: true,
            shadows: false,
            technique: gl,
            soft,
        };
        let drawn = stage.render(&scene, &options).map_err(CliError::OpenGl)?;
        row.penumbra_rmse = drawn.visibility.first().and_then(|visibility| truth.rmse(visibility));
    }
    Ok(())
}
