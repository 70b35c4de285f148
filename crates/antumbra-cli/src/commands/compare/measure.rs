//! The pictures and the numbers of a comparison.

use antumbra_reference::Tracer;
use antumbra_testkit::flip::{PIXELS_PER_DEGREE, flip, mean};
use antumbra_testkit::metrics;
use antumbra_testkit::truth::Truth;

use super::Subject;
use crate::draw::{Drawing, OpenGl, Request, trace};
use crate::error::CliError;
use crate::progress::Progress;
use crate::technique::Technique;
use crate::timing::{Contest, Timing};

/// A picture as pixels in linear light.
pub(super) type Pixels = Vec<[f32; 3]>;

/// Everything that was drawn and measured.
pub(super) struct Comparison {
    /// The reference's picture.
    pub(super) truth: Pixels,
    /// What the reference takes, one ray a pixel.
    pub(super) traced: Timing,
    /// How far a picture without any shadow is off: what the other numbers are to be seen against.
    pub(super) without: PictureError,
    /// Names of the lights.
    pub(super) lights: Vec<String>,
    /// The techniques.
    pub(super) entries: Vec<Entry>,
}

/// One technique.
pub(super) struct Entry {
    /// Which.
    pub(super) technique: Technique,
    /// Its picture.
    pub(super) pixels: Pixels,
    /// The largest error of any light's visibility, for each pixel.
    pub(super) errors: Vec<f32>,
    /// How far its picture is off.
    pub(super) picture: PictureError,
    /// How far each light's visibility is off.
    pub(super) lights: Vec<VisibilityError>,
    /// What a frame takes.
    pub(super) timing: Timing,
}

/// How far a picture is from the reference's.
#[derive(Clone, Copy, Debug)]
pub(super) struct PictureError {
    /// Root of the mean squared difference in linear light after exposure, clamped to what a screen shows, over all
    /// pixels and channels.
    pub(super) rmse: f64,
    /// Mean ꟻLIP.
    pub(super) flip: f64,
}

/// How far one light's visibility is from the reference's.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct VisibilityError {
    /// Pixels lit instead of dark or the reverse, more than one pixel from any edge.
    pub(super) wrong_1px: usize,
    /// The same, more than two pixels from any edge.
    pub(super) wrong_2px: usize,
    /// Pixels that are partly lit in truth.
    pub(super) edge_pixels: usize,
    /// Root of the mean squared difference on those.
    pub(super) edge_rms: f64,
}

/// Draws and measures.
///
/// # Errors
/// What the driver or a technique cannot do.
pub(super) fn compare(
    subject: &Subject,
    techniques: &[Technique],
    gl: &mut OpenGl,
) -> Result<Comparison, CliError> {
    let Subject { scene, size, time, .. } = *subject;
    let request = Request { scene, size, time, visibility: false, shadows: false };
    let progress = Progress::new("reference", "rows");
    progress.message("picture");
    let truth = trace(&request, subject.samples, &|_, done, total| progress.set(done, total)).pixels;
    drop(progress);
    let truths = trace_visibilities(subject);

    let progress = Progress::new("drawing", "techniques");
    progress.set(0, techniques.len() as u64);
    let mut drawings = Vec::new();
    let mut without = PictureError { rmse: f64::NAN, flip: f64::NAN };
    for (done, technique) in (1..).zip(techniques) {
        let Technique::Gl(spec, soft) = technique else { continue };
        progress.message(&technique.to_string());
        if done == 1 {
            // Without shadows all techniques are one.
            without = picture_error(subject, &gl.draw(&request, (*spec, *soft), None)?.pixels, &truth);
        }
        let drawing =
            gl.draw(&Request { visibility: true, shadows: true, ..request }, (*spec, *soft), None)?;
        drawings.push((technique, drawing));
        progress.set(done, techniques.len() as u64);
    }
    drop(progress);

    let (traced, timings) = time_all(subject, techniques, gl)?;
    let entries = drawings
        .into_iter()
        .zip(timings)
        .map(|((technique, drawing), timing)| judge(subject, *technique, drawing, &truth, &truths, timing))
        .collect();
    let lights = scene.lights.iter().map(|light| light.name.clone()).collect();
    Ok(Comparison { truth, traced, without, lights, entries })
}

fn trace_visibilities(subject: &Subject) -> Vec<Truth> {
    let Subject { scene, size, time, .. } = *subject;
    let tracer = Tracer::new(scene, time);
    let progress = Progress::new("reference", "lights");
    progress.set(0, scene.lights.len() as u64);
    let one = |(index, light): (usize, &antumbra_scene::Light)| {
        progress.message(&light.name);
        let truth = Truth::new(scene, &tracer, index, size.width, size.height);
        progress.set(index as u64 + 1, scene.lights.len() as u64);
        truth
    };
    scene.lights.iter().enumerate().map(one).collect()
}

fn time_all(
    subject: &Subject,
    techniques: &[Technique],
    gl: &OpenGl,
) -> Result<(Timing, Vec<Timing>), CliError> {
    let all: Vec<Technique> = techniques.iter().copied().chain([Technique::Raytraced]).collect();
    let progress = Progress::new("timing", "rounds");
    let mut contest = Contest::new(Some(gl.context()), &all)?;
    let rounds = u64::from(Contest::rounds(subject.frames));
    let timings = contest.measure(
        (subject.scene, subject.time),
        subject.size,
        subject.frames,
        &vec![true; all.len()],
        &mut |round| progress.set(u64::from(round), rounds),
    )?;
    let mut timings: Vec<Timing> = timings.into_iter().flatten().collect();
    // One for each, the tracer's last.
    match timings.pop() {
        Some(traced) => Ok((traced, timings)),
        None => Err(CliError::Usage("nothing was timed".to_owned())),
    }
}

fn judge(
    subject: &Subject,
    technique: Technique,
    drawing: Drawing,
    truth: &[[f32; 3]],
    truths: &[Truth],
    timing: Timing,
) -> Entry {
    let mut errors = vec![0f32; truth.len()];
    let mut lights = Vec::new();
    for (levels, truth) in drawing.visibility.iter().zip(truths) {
        let test: Vec<f32> = levels.iter().map(|level| f32::from(*level) / 65_535.0).collect();
        lights.push(visibility_error(&test, truth));
        for (error, (test, truth)) in errors.iter_mut().zip(test.iter().zip(&truth.visibility)) {
            *error = error.max((test - truth).abs());
        }
    }
    let picture = picture_error(subject, &drawing.pixels, truth);
    Entry { technique, pixels: drawing.pixels, errors, picture, lights, timing }
}

fn visibility_error(test: &[f32], truth: &Truth) -> VisibilityError {
    VisibilityError {
        wrong_1px: metrics::misclassified(test, &truth.visibility, &truth.band(1)),
        wrong_2px: metrics::misclassified(test, &truth.visibility, &truth.band(2)),
        edge_pixels: truth.edge.iter().filter(|edge| **edge).count(),
        edge_rms: metrics::rms(test, &truth.visibility, &truth.edge),
    }
}

fn picture_error(subject: &Subject, test: &[[f32; 3]], truth: &[[f32; 3]]) -> PictureError {
    #[expect(clippy::cast_possible_truncation, reason = "pictures are 32-bit")]
    let exposure = subject.scene.image.exposure as f32;
    let shown = |pixels: &[[f32; 3]]| -> Pixels {
        pixels.iter().map(|pixel| pixel.map(|c| (c * exposure).clamp(0.0, 1.0))).collect()
    };
    let (test, truth) = (shown(test), shown(truth));
    let (width, height) = (subject.size.width as usize, subject.size.height as usize);
    PictureError {
        rmse: metrics::rmse(test.as_flattened(), truth.as_flattened()),
        flip: mean(&flip(&test, &truth, width, height, PIXELS_PER_DEGREE)),
    }
}
