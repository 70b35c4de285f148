//! When the frames of an animation are, and after how long a scene's motions repeat.

use antumbra_scene::{LightKind, Motion, Scene};

use crate::args::{FPS, MAX_ANIMATION_FRAMES};
use crate::report::count;

/// Frames a second where nothing else is asked for.
const DEFAULT_FPS: f64 = 20.0;

/// The longest time to wait, where no duration is asked for, until all motions repeat, seconds.
const PATIENCE: f64 = 60.0;

/// How far from its start, in rounds, a motion may be that counts as repeating.
const CLOSE: f64 = 1e-6;

/// What the command line says of the time.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Wanted {
    /// Frames in all.
    pub(crate) frames: Option<u32>,
    /// Frames a second.
    pub(crate) fps: Option<f64>,
    /// Seconds.
    pub(crate) duration: Option<f64>,
}

/// Moments at equal distances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Timeline {
    /// How many, at least 1.
    pub(crate) frames: u32,
    /// From the first to the end of the last, seconds.
    pub(crate) duration: f64,
    /// Whether every motion is then where it began.
    pub(crate) repeats: bool,
}

impl Timeline {
    /// The frames for a scene.
    ///
    /// # Errors
    /// That nothing moves, and numbers that contradict each other or come to too many frames, too few or too fast
    /// ones; each with what to do.
    pub(crate) fn new(scene: &Scene, wanted: Wanted) -> Result<Self, String> {
        let periods = periods(scene);
        let Some(longest) = periods.iter().copied().reduce(f64::max) else {
            return Err(
                "nothing in the scene moves; give a light or an object a `motion`, or use `antumbra \
                        render` for a picture"
                    .into(),
            );
        };
        let Wanted { frames, fps, duration } = wanted;
        let duration = match (frames, fps, duration) {
            (Some(_), Some(_), Some(_)) => {
                return Err(
                    "--frames, --fps and --duration are too many; give two, and the third follows".into()
                );
            }
            (Some(frames), Some(fps), None) => f64::from(frames) / fps,
            (.., Some(duration)) => duration,
            (.., None) => common(&periods, PATIENCE).unwrap_or(longest),
        };
        let frames = match frames {
            Some(frames) => frames,
            None => whole(duration, fps.unwrap_or(DEFAULT_FPS))?,
        };
        let fps = f64::from(frames) / duration;
        // What was asked for is within; rounding to whole frames may lead a little out.
        if !(fps > FPS.start() * 0.5 && fps < FPS.end() * 1.5) {
            return Err(format!(
                "{} in {duration} s: {fps} frames a second, which is not from {} to {}; give another --frames or \
                 --duration",
                count(frames as usize, "frame"),
                FPS.start(),
                FPS.end()
            ));
        }
        Ok(Self { frames, duration, repeats: repeats(&periods, duration) })
    }

    /// How long each frame is shown, seconds.
    pub(crate) fn delay(&self) -> f64 {
        self.duration / f64::from(self.frames)
    }

    /// The moment of a frame after the first, seconds.
    pub(crate) fn after(&self, frame: u32) -> f64 {
        self.duration * f64::from(frame) / f64::from(self.frames)
    }
}

/// The number of frames in a duration.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "in range, as checked before")]
fn whole(duration: f64, fps: f64) -> Result<u32, String> {
    let frames = (duration * fps).round();
    if frames > f64::from(MAX_ANIMATION_FRAMES) {
        return Err(format!(
            "{duration} s at {fps} frames a second are too many frames, more than {MAX_ANIMATION_FRAMES}; give a \
             smaller --duration, --fps or --frames"
        ));
    }
    if frames < 2.0 {
        return Err(format!(
            "{duration} s at {fps} frames a second are less than two frames; give a larger --duration or --fps, or \
             --frames"
        ));
    }
    Ok(frames as u32)
}

/// The seconds that each moving thing takes for a round.
fn periods(scene: &Scene) -> Vec<f64> {
    let lights = scene.lights.iter().filter(|light| !matches!(light.kind, LightKind::Directional { .. }));
    let motions = lights.map(|light| &light.motion).chain(scene.objects.iter().map(|object| &object.motion));
    motions
        .flatten()
        .map(|motion| match motion {
            Motion::Orbit { period, .. } | Motion::Path { period, .. } => period.abs(),
        })
        .filter(|period| *period > 0.0 && period.is_finite())
        .collect()
}

/// Whether everything is where it was after `duration`.
fn repeats(periods: &[f64], duration: f64) -> bool {
    periods.iter().all(|period| {
        let rounds = duration / period;
        (rounds - rounds.round()).abs() <= CLOSE
    })
}

/// The shortest time, up to `most`, after which all periods are over: their least common multiple.
fn common(periods: &[f64], most: f64) -> Option<f64> {
    let longest = periods.iter().copied().reduce(f64::max)?;
    let times = (1..=MAX_ANIMATION_FRAMES).map(|rounds| f64::from(rounds) * longest);
    times.take_while(|time| *time <= most).find(|time| repeats(periods, *time))
}

/// After how long all motions of a scene repeat, if that is within the longest animation at the usual rate.
pub(crate) fn repeats_after(scene: &Scene) -> Option<f64> {
    common(&periods(scene), f64::from(MAX_ANIMATION_FRAMES) / DEFAULT_FPS)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(periods: &[f64]) -> Scene {
        let mut text = String::from("[camera]\neye = [0, 2, 4]\n");
        for (i, period) in periods.iter().enumerate() {
            text += &format!(
                "[[object]]\nname = \"o{i}\"\nshape = {{ type = \"sphere\", radius = 1 }}\nmotion = {{ type = \"orbit\", \
                 center = [1, 0, 0], axis = [0, 1, 0], period = {period} }}\n"
            );
        }
        Scene::parse(&text, "a.toml".as_ref()).expect("the scene is right")
    }

    fn line(periods: &[f64], wanted: Wanted) -> Timeline {
        Timeline::new(&scene(periods), wanted).expect("frames")
    }

    #[test]
    fn a_round_is_the_least_common_multiple() {
        for (periods, expected) in [
            (&[8.0][..], 8.0),
            (&[8.0, 4.0, -2.0], 8.0),
            (&[4.0, 6.0], 12.0),
            (&[0.3, 0.2, 0.7], 4.2),
            (&[1e-1, 25.0], 25.0),
            // Together after 140 s, which is too long to wait for; the longest has its round.
            (&[20.0, 14.0], 20.0),
            (&[90.0], 90.0),
        ] {
            let line = line(periods, Wanted::default());
            assert!((line.duration - expected).abs() < 1e-9, "{periods:?}: {line:?}");
            assert_eq!(line.repeats, periods != [20.0, 14.0], "{periods:?}: {line:?}");
            assert_eq!(f64::from(line.frames), (20.0 * expected).round(), "{periods:?}: {line:?}");
        }
        assert_eq!(repeats_after(&scene(&[20.0, 14.0])), Some(140.0), "it can be said all the same");
        assert_eq!(repeats_after(&scene(&[1.0, std::f64::consts::SQRT_2])), None, "never, or not soon");
    }

    #[test]
    fn frames_rate_and_duration_follow_from_each_other() {
        let all = |frames, fps, duration| Wanted { frames, fps, duration };
        let line = |wanted| line(&[8.0], wanted);
        assert_eq!(line(all(Some(16), None, None)).delay(), 0.5, "spread over the round");
        assert_eq!(line(all(None, Some(10.0), None)).frames, 80, "a round at that rate");
        assert_eq!(line(all(None, Some(10.0), Some(2.0))).frames, 20, "a part of it");
        let part = line(all(Some(10), Some(10.0), None));
        assert_eq!((part.duration, part.repeats), (1.0, false), "frames at that rate");
        assert_eq!(line(all(Some(10), None, Some(16.0))).after(5), 8.0, "half-way");
    }

    #[test]
    fn what_cannot_be_is_said() {
        let says = |periods: &[f64], frames, fps, duration| {
            Timeline::new(&scene(periods), Wanted { frames, fps, duration }).expect_err("refused")
        };
        assert!(says(&[], None, None, None).contains("nothing in the scene moves"), "nothing moves");
        assert!(says(&[8.0], Some(1), Some(1.0), Some(1.0)).contains("give two"), "contradicts itself");
        assert!(says(&[1e9], None, None, None).contains("too many frames"), "thirty years");
        assert!(says(&[1e-3], None, None, None).contains("less than two frames"), "a flicker");
        assert!(says(&[8.0], Some(10_000), None, None).contains("a second"), "faster than anything plays");
        assert!(says(&[8.0], Some(1), None, Some(1e9)).contains("a second"), "slower");
        assert!(says(&[8.0], None, None, Some(1e-3)).contains("less than two"), "too short");
    }
}
