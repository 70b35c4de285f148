//! How long a frame takes with each technique, and the same frame without shadows.

use std::time::Instant;

use antumbra_host::{Buffers, ColorFormat, FrameTimer, HeadlessContext, HostError, Setting, Stage};
use antumbra_reference::Tracer;
use antumbra_scene::Scene;
use serde::Serialize;

use crate::args::Size;
use crate::error::CliError;
use crate::technique::Technique;

/// Frames before the ones that count: the first compile, allocate and fill caches.
const WARM_UP: u32 = 3;

/// A technique that has spent so long on one scene, milliseconds, and has given [`ENOUGH`] frames, is asked for no
/// more: what takes seconds a frame would take an hour else.
const PATIENCE: f64 = 4_000.0;
const ENOUGH: usize = 5;

/// What a frame costs.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Timing {
    /// Median of the frames with shadows, milliseconds.
    pub(crate) median_ms: f64,
    /// The time that 95 of 100 frames with shadows keep within, milliseconds.
    pub(crate) p95_ms: f64,
    /// Median of the same frame without shadows, milliseconds.
    pub(crate) plain_ms: f64,
    /// Which clock.
    pub(crate) timer: &'static str,
    /// How many frames of each were measured.
    pub(crate) frames: usize,
}

/// The techniques to be measured, each with a renderer of its own, so that none profits from another's.
pub(crate) struct Contest<'a> {
    // Declared before the context's owner goes: `'a` keeps it alive.
    runners: Vec<Runner>,
    timer: Option<FrameTimer>,
    _context: Option<&'a HeadlessContext>,
}

enum Runner {
    Gl(Box<Stage>),
    Cpu,
}

impl<'a> Contest<'a> {
    /// Sets up `techniques`; those that draw with OpenGL do it on `context`.
    ///
    /// # Errors
    /// [`CliError::OpenGl`] for what the driver cannot do.
    pub(crate) fn new(
        context: Option<&'a HeadlessContext>,
        techniques: &[Technique],
    ) -> Result<Self, CliError> {
        let runner = |technique: &Technique| match (technique, context) {
            (Technique::Gl(technique, soft), Some(context)) => {
                Ok(Runner::Gl(Box::new(stage(context, *technique, *soft).map_err(CliError::OpenGl)?)))
            }
            (Technique::Gl(..), None) => Err(CliError::Usage(format!("{technique} needs OpenGL"))),
            (Technique::Raytraced, _) => Ok(Runner::Cpu),
        };
        let runners = techniques.iter().map(runner).collect::<Result<_, _>>()?;
        let timer = context.map(|context| FrameTimer::new(context.gl(), &context.info())).transpose();
        Ok(Self { runners, timer: timer.map_err(CliError::OpenGl)?, _context: context })
    }

    /// Times `frames` frames of the scene at a moment with each technique that `takes_part`, and as many without
    /// shadows, after a few that do not count. The techniques take turns frame by frame, so that whatever else the
    /// machine does disturbs all alike. `told` hears of each round that is done.
    ///
    /// The result is in the order of the techniques, `None` for those that did not take part.
    ///
    /// # Errors
    /// [`CliError::OpenGl`] for what the driver or a technique cannot do.
    pub(crate) fn measure(
        &mut self,
        (scene, time): (&Scene, f64),
        size: Size,
        frames: u32,
        takes_part: &[bool],
        told: &mut dyn FnMut(u32),
    ) -> Result<Vec<Option<Timing>>, CliError> {
        let aspect = f64::from(size.width) / f64::from(size.height);
        let mut parties = self.runners.iter_mut().zip(takes_part).filter(|(_, takes_part)| **takes_part);
        // One for all: what is in it does not depend on who makes it.
        let setting = parties
            .find_map(|(runner, _)| if let Runner::Gl(stage) = runner { Some(stage) } else { None })
            .map(|stage| stage.setting(scene, time, aspect))
            .transpose()
            .map_err(CliError::OpenGl)?;
        let mut parties = self.runners.iter().zip(takes_part);
        let tracers = parties
            .any(|(runner, takes_part)| *takes_part && matches!(runner, Runner::Cpu))
            .then(|| [Tracer::new(&without_shadows(scene), time), Tracer::new(scene, time)]);
        let mut samples: Vec<Samples> = takes_part.iter().map(|_| Samples::default()).collect();
        for round in 0..frames + WARM_UP {
            let contestants = self.runners.iter_mut().zip(takes_part).zip(&mut samples);
            for ((runner, takes_part), samples) in contestants {
                if !takes_part || samples.had_enough(frames) {
                    continue;
                }
                let mut once = |shadows: bool| -> Result<f64, CliError> {
                    match (&mut *runner, &setting, &mut self.timer) {
                        (Runner::Gl(stage), Some(setting), Some(timer)) => {
                            timer.time(|| frame(stage, setting, size, shadows)).map_err(CliError::OpenGl)
                        }
                        _ => Ok(tracers
                            .as_ref()
                            .map_or(f64::NAN, |tracers| traced(&tracers[usize::from(shadows)], size))),
                    }
                };
                let pair = [once(false)?, once(true)?];
                // The CPU takes its time, and one frame warms its caches.
                let warm_up = if matches!(runner, Runner::Cpu) { 1 } else { WARM_UP };
                samples.add(pair, round >= warm_up);
            }
            told(round + 1);
        }
        let timer = self.timer.as_ref().map_or("wall time", FrameTimer::name);
        let results = self.runners.iter().zip(takes_part).zip(samples);
        Ok(results
            .map(|((runner, takes_part), samples)| {
                let timer = if matches!(runner, Runner::Cpu) { "wall time" } else { timer };
                takes_part.then(|| samples.timing(timer))
            })
            .collect())
    }

    /// How many rounds [`Contest::measure`] has.
    pub(crate) fn rounds(frames: u32) -> u32 {
        frames + WARM_UP
    }
}

#[derive(Default)]
struct Samples {
    plain: Vec<f64>,
    shadowed: Vec<f64>,
    spent: f64,
}

impl Samples {
    fn add(&mut self, [plain, shadowed]: [f64; 2], counts: bool) {
        self.spent += plain + shadowed;
        if counts {
            self.plain.push(plain);
            self.shadowed.push(shadowed);
        }
    }

    fn had_enough(&self, frames: u32) -> bool {
        let measured = self.shadowed.len();
        measured >= frames as usize || self.spent > PATIENCE && measured >= ENOUGH
    }

    fn timing(mut self, timer: &'static str) -> Timing {
        Timing {
            plain_ms: percentile(&mut self.plain, 50),
            median_ms: percentile(&mut self.shadowed, 50),
            p95_ms: percentile(&mut self.shadowed, 95),
            timer,
            frames: self.shadowed.len(),
        }
    }
}

/// The smallest of the values that `percent` of 100 of them do not exceed (nearest rank); not a number for no values.
fn percentile(values: &mut [f64], percent: usize) -> f64 {
    values.sort_by(f64::total_cmp);
    let rank = (values.len() * percent).div_ceil(100).max(1);
    values.get(rank - 1).copied().unwrap_or(f64::NAN)
}

fn stage(
    context: &HeadlessContext,
    technique: antumbra::Technique,
    soft: antumbra::Soft,
) -> Result<Stage, HostError> {
    let mut stage = Stage::new(context.gl())?;
    stage.set_technique(technique)?;
    stage.set_soft(soft);
    Ok(stage)
}

/// One frame: colour and depth alone without shadows, as a host draws that has none.
fn frame(stage: &mut Stage, setting: &Setting, size: Size, shadows: bool) -> Result<(), HostError> {
    let buffers = if shadows { Buffers::All } else { Buffers::Color };
    stage.draw(setting, size.width, size.height, 1, ColorFormat::Rgba8, buffers)?;
    if shadows { stage.add_shadows(setting) } else { Ok(()) }
}

/// Milliseconds for a whole picture, one ray a pixel.
fn traced(tracer: &Tracer, size: Size) -> f64 {
    let start = Instant::now();
    std::hint::black_box(tracer.render(size.width, size.height, 1, &|_, _| ()));
    start.elapsed().as_secs_f64() * 1e3
}

/// The scene where nothing casts a shadow.
fn without_shadows(scene: &Scene) -> Scene {
    let mut plain = scene.clone();
    plain.objects.iter_mut().for_each(|object| object.casts_shadow = false);
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_of_the_nearest_rank() {
        let mut ten: Vec<f64> = (1..=10).rev().map(f64::from).collect();
        assert_eq!(percentile(&mut ten, 50), 5.0, "the fifth of ten");
        assert_eq!(percentile(&mut ten, 95), 10.0, "9.5 of ten is the tenth");
        let mut hundred: Vec<f64> = (1..=100).map(f64::from).collect();
        assert_eq!(percentile(&mut hundred, 95), 95.0, "the 95th of a hundred");
        assert_eq!(percentile(&mut [3.0], 50), 3.0, "one value");
        assert!(percentile(&mut [], 50).is_nan(), "no values");
    }

    #[test]
    fn a_slow_technique_is_asked_for_no_more() {
        let mut samples = Samples::default();
        for _ in 0..4 {
            samples.add([1_000.0, 1_000.0], true);
            assert!(!samples.had_enough(30), "too few frames, however long they take");
        }
        samples.add([1_000.0, 1_000.0], true);
        assert!(samples.had_enough(30), "five frames in ten seconds");
        let mut samples = Samples::default();
        (0..100).for_each(|_| samples.add([1.0, 2.0], true));
        assert!(!samples.had_enough(101), "a fast one gives all its frames");
        assert!(samples.had_enough(100), "and no more");
        let timing = samples.timing("clock");
        assert_eq!((timing.plain_ms, timing.median_ms, timing.frames), (1.0, 2.0, 100), "medians of each");
    }

    #[test]
    fn the_tracer_alone_needs_no_opengl() {
        let text = "[camera]\neye = [0, 2, 4]\n[[light]]\nname = \"a\"\ntype = \"point\"\nposition = [0, 4, 0]\n\
                    intensity = 1\n[[object]]\nname = \"floor\"\nshape = { type = \"plane\" }\n";
        let scene = Scene::parse(text, "a.toml".as_ref()).expect("the scene is right");
        let size = Size { width: 16, height: 8 };
        let mut contest =
            Contest::new(None, &[Technique::Raytraced, Technique::Raytraced]).expect("on the CPU");
        let mut rounds = Vec::new();
        let timings = contest
            .measure((&scene, 0.0), size, 4, &[true, false], &mut |round| rounds.push(round))
            .expect("tracing never fails");
        assert_eq!(rounds, [1, 2, 3, 4, 5, 6, 7], "four rounds and the warm-up");
        let timing = timings[0].as_ref().expect("took part");
        assert!(timing.median_ms > 0.0 && timing.median_ms <= timing.p95_ms, "{timing:?}");
        assert!(timing.plain_ms > 0.0, "{timing:?}");
        assert_eq!(timing.timer, "wall time", "the clock is named");
        assert!(timings[1].is_none(), "did not take part");
        let technique = Technique::from(antumbra::Technique::default());
        assert!(Contest::new(None, &[technique]).is_err(), "OpenGL is not there");
    }
}
