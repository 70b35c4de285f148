//! How long frames take: what was measured of each way, and measuring all of them one after the other.

use std::collections::VecDeque;

use antumbra::{Soft, Technique};

use super::clock::Clock;
use super::settings::{Antialiasing, Layout, Settings};
use super::way::Way;

/// How many frames of a way are kept.
pub(crate) const MOST_FRAMES: usize = 120;
/// How many ways are kept.
const MOST_TRACKS: usize = 12;
/// How many frames of each way are measured although nothing moves.
pub(crate) const ENOUGH: usize = 20;
/// How many frames of a way are not counted at first: they compile and allocate.
const WARM_UP: usize = 2;

/// The measured frames of a way.
#[derive(Clone, Debug)]
pub(crate) struct Track {
    /// Which way.
    pub(crate) way: Way,
    /// Milliseconds of the frame without shadows and with them, the newest last.
    pub(crate) frames: VecDeque<[f64; 2]>,
    /// Frames that are yet to be ignored.
    warming: usize,
    /// When the last one was measured, in frames.
    last: u64,
}

impl Track {
    /// The median of the frame without shadows and of the frame with them, milliseconds; `None` without frames.
    pub(crate) fn medians(&self) -> Option<[f64; 2]> {
        let side = |i: usize| median(self.frames.iter().map(|frame| frame[i]).collect());
        Some([side(0)?, side(1)?])
    }
}

/// The middle one; of an even number the mean of the middle two.
fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let half = values.len() / 2;
    match values.len() {
        0 => None,
        n if n % 2 == 1 => Some(values[half]),
        _ => Some(0.5 * (values[half - 1] + values[half])),
    }
}

/// What was measured is comparable as long as nothing of this changes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Conditions {
    size: [i32; 2],
    lights: usize,
    objects: usize,
    antialiasing: Antialiasing,
}

/// Every technique in turn.
#[derive(Clone, Debug)]
struct Measuring {
    /// The ways, each once.
    ways: Vec<Way>,
    /// Which of them is measured now.
    now: usize,
    /// What was looked at before.
    before: (Layout, [Way; 2]),
    /// Whether time ran before.
    playing: bool,
}

/// What was measured, and what is to be.
#[derive(Clone, Debug, Default)]
pub(crate) struct Timing {
    tracks: Vec<Track>,
    conditions: Option<Conditions>,
    measuring: Option<Measuring>,
    count: u64,
}

/// What became of one side of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Measured {
    /// How it came by its shadows.
    pub(crate) way: Way,
    /// Whether the way cannot show the scene.
    pub(crate) objects: bool,
    /// Milliseconds of the frame without shadows and with them, if it was drawn anew and measured.
    pub(crate) milliseconds: Option<[f64; 2]>,
}

impl Timing {
    /// The ways that were measured, in the order in which they came.
    pub(crate) fn tracks(&self) -> &[Track] {
        &self.tracks
    }

    /// Forgets what was measured.
    pub(crate) fn clear(&mut self) {
        self.tracks.clear();
    }

    /// The way that is measured now, its number from 1, and how many there are.
    pub(crate) fn measuring(&self) -> Option<(Way, usize, usize)> {
        let measuring = self.measuring.as_ref()?;
        Some((*measuring.ways.get(measuring.now)?, measuring.now + 1, measuring.ways.len()))
    }

    /// Whether a frame is to be drawn anew although nothing in it changed, to measure it.
    pub(crate) fn wants_frame(&self, settings: &Settings, refused: [bool; 2]) -> bool {
        settings.timing
            && settings.shown().iter().zip(refused).any(|(way, refused)| {
                let known = self.tracks.iter().find(|track| track.way == *way);
                *way != Way::Raytraced && !refused && known.is_none_or(|track| track.frames.len() < ENOUGH)
            })
    }

    /// Takes note of a frame, and goes on to the next technique where this one was measured enough.
    pub(crate) fn note(&mut self, frame: Frame<'_>, settings: &mut Settings, clock: &mut Clock) {
        if !settings.timing {
            return self.stop(settings, clock);
        }
        let Frame { size, lights, objects, sides } = frame;
        let conditions = Conditions { size, lights, objects, antialiasing: settings.antialiasing };
        if self.conditions != Some(conditions) {
            self.conditions = Some(conditions);
            self.clear();
        }
        for (i, side) in sides.iter().enumerate() {
            let twice = sides[..i].iter().any(|other| other.way == side.way);
            if let Some(milliseconds) = side.milliseconds.filter(|_| !twice && !side.objects) {
                self.push(side.way, milliseconds);
            }
        }
        let Some((way, ..)) = self.measuring() else { return };
        if settings.layout != Layout::Single || settings.ways[0] != way {
            // Somebody chose something else meanwhile.
            return self.stop(settings, clock);
        }
        let Some(side) = sides.iter().find(|side| side.way == way) else { return };
        let enough = self.tracks.iter().any(|track| track.way == way && track.frames.len() >= ENOUGH);
        if side.objects || enough {
            self.next(settings, clock);
        }
    }

    fn push(&mut self, way: Way, milliseconds: [f64; 2]) {
        if !milliseconds.iter().all(|ms| ms.is_finite()) {
            return;
        }
        self.count += 1;
        let place = self.tracks.iter().position(|track| track.way == way).unwrap_or_else(|| {
            // While an option is dragged its values come and go.
            let passing = |track: &Track| track.way.name() == way.name() && track.frames.len() < ENOUGH;
            self.tracks.retain(|track| !passing(track));
            if self.tracks.len() >= MOST_TRACKS
                && let Some(oldest) = (0..self.tracks.len()).min_by_key(|&i| self.tracks[i].last)
            {
                self.tracks.remove(oldest);
            }
            self.tracks.push(Track { way, frames: VecDeque::new(), warming: WARM_UP, last: 0 });
            self.tracks.len() - 1
        });
        let track = &mut self.tracks[place];
        track.last = self.count;
        if track.warming > 0 {
            track.warming -= 1;
            return;
        }
        if track.frames.len() >= MOST_FRAMES {
            track.frames.pop_front();
        }
        track.frames.push_back(milliseconds);
    }

    /// Begins to measure every technique, with the options of those that are looked at.
    pub(crate) fn start(&mut self, settings: &mut Settings, clock: &mut Clock) {
        let soft = match settings.ways[0] {
            Way::Technique(_, soft) => soft,
            Way::Raytraced | Way::None => Soft::Native,
        };
        let ways: Vec<Way> = Technique::all()
            .map(|technique| {
                let own = settings.ways.iter().find(|way| way.name() == technique.name());
                own.copied().unwrap_or(Way::Technique(technique, soft))
            })
            .collect();
        let Some(&first) = ways.first() else { return };
        self.clear();
        let before = (settings.layout, settings.ways);
        self.measuring = Some(Measuring { ways, now: 0, before, playing: clock.playing });
        settings.layout = Layout::Single;
        settings.ways[0] = first;
        // All of them are measured at one moment.
        clock.playing = false;
    }

    fn next(&mut self, settings: &mut Settings, clock: &mut Clock) {
        let Some(measuring) = &mut self.measuring else { return };
        measuring.now += 1;
        match measuring.ways.get(measuring.now) {
            Some(way) => settings.ways[0] = *way,
            None => self.stop(settings, clock),
        }
    }

    /// Ends measuring: what was looked at before is looked at again, but for what was chosen meanwhile.
    pub(crate) fn stop(&mut self, settings: &mut Settings, clock: &mut Clock) {
        let now = self.measuring().map(|(way, ..)| way);
        let Some(measuring) = self.measuring.take() else { return };
        let (layout, ways) = measuring.before;
        if settings.layout == Layout::Single {
            settings.layout = layout;
        }
        let chosen = settings.ways[1] == ways[1] && now.is_some_and(|way| way != settings.ways[0]);
        settings.ways = if chosen { [settings.ways[0], ways[1]] } else { ways };
        clock.playing |= measuring.playing;
    }
}

/// A frame that was drawn.
pub(crate) struct Frame<'a> {
    /// Its size, pixels.
    pub(crate) size: [i32; 2],
    /// How many lights the scene has.
    pub(crate) lights: usize,
    /// How many objects.
    pub(crate) objects: usize,
    /// Its sides.
    pub(crate) sides: &'a [Measured],
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Bench {
        timing: Timing,
        settings: Settings,
        clock: Clock,
        size: [i32; 2],
    }

    impl Bench {
        fn new() -> Self {
            let settings = Settings { timing: true, ..Settings::default() };
            Self { timing: Timing::default(), settings, clock: Clock::default(), size: [640, 480] }
        }

        /// A frame of the ways that are shown; `map` objects.
        fn frame(&mut self, milliseconds: [f64; 2]) {
            let measure = |way: &Way| Measured {
                way: *way,
                objects: way.name() == "map",
                milliseconds: Some(milliseconds),
            };
            let sides: Vec<Measured> = self.settings.shown().iter().map(measure).collect();
            let frame = Frame { size: self.size, lights: 1, objects: 2, sides: &sides };
            self.timing.note(frame, &mut self.settings, &mut self.clock);
        }

        fn start(&mut self) {
            self.timing.start(&mut self.settings, &mut self.clock);
        }
    }

    #[test]
    fn medians_are_in_the_middle() {
        assert_eq!(median(vec![]), None, "of nothing");
        assert_eq!(median(vec![3.0, 1.0, 100.0]), Some(3.0), "of three");
        assert_eq!(median(vec![4.0, 1.0, 100.0, 2.0]), Some(3.0), "of four");
    }

    #[test]
    fn frames_are_kept_up_to_a_number() {
        let mut bench = Bench::new();
        for i in 0..WARM_UP + MOST_FRAMES + 30 {
            bench.frame([1.0, i as f64]);
        }
        let [track] = bench.timing.tracks() else { panic!("one way was shown") };
        assert_eq!(track.frames.len(), MOST_FRAMES, "no more");
        assert_eq!(track.frames.front(), Some(&[1.0, 32.0]), "the oldest are forgotten");
        assert_eq!(track.medians(), Some([1.0, 91.5]), "of those that are left");
        bench.size = [641, 480];
        bench.settings.timing = false;
        bench.frame([1.0, 2.0]);
        assert_eq!(bench.timing.tracks()[0].frames.len(), MOST_FRAMES, "while nobody looks nothing changes");
        bench.settings.timing = true;
        bench.frame([1.0, 2.0]);
        assert!(bench.timing.tracks()[0].frames.is_empty(), "another size is another measurement");
    }

    #[test]
    fn ways_are_kept_up_to_a_number() {
        let mut bench = Bench::new();
        for size in 0..3 * MOST_TRACKS {
            bench.settings.ways[0] = format!("volume+samples:{}", size + 1).parse().expect("a way");
            bench.frame([1.0, 2.0]);
        }
        assert_eq!(bench.timing.tracks().len(), 1, "a value that was passed is not kept");
        for size in 0..3 * MOST_TRACKS {
            bench.settings.ways[0] = format!("volume+samples:{}", size + 1).parse().expect("a way");
            (0..WARM_UP + ENOUGH).for_each(|_| bench.frame([1.0, 2.0]));
        }
        assert_eq!(bench.timing.tracks().len(), MOST_TRACKS, "nor is anything without end");
    }

    #[test]
    fn still_pictures_are_measured_enough() {
        let mut bench = Bench::new();
        let mut forced = 0;
        while bench.timing.wants_frame(&bench.settings, [false; 2]) {
            bench.frame([1.0, 2.0]);
            forced += 1;
            assert!(forced < 1000, "it ends");
        }
        assert_eq!(forced, WARM_UP + ENOUGH, "and not before");
        bench.settings.ways[0] = "map".parse().expect("a way");
        assert!(bench.timing.wants_frame(&bench.settings, [false; 2]), "another way");
        assert!(!bench.timing.wants_frame(&bench.settings, [true; 2]), "that cannot be");
        bench.settings.ways[0] = Way::Raytraced;
        assert!(!bench.timing.wants_frame(&bench.settings, [false; 2]), "rays take another time");
        bench.settings = Settings::default();
        assert!(!bench.timing.wants_frame(&bench.settings, [false; 2]), "nobody asks");
    }

    #[test]
    fn all_are_measured_and_all_is_as_before() {
        let mut bench = Bench::new();
        bench.settings.layout = Layout::Split;
        bench.settings.ways = ["volume+samples:4", "none"].map(|way| way.parse().expect("a way"));
        bench.clock.playing = true;
        let before = bench.settings.clone();
        bench.start();
        let mut frames = 0;
        while bench.timing.measuring().is_some() {
            assert!(!bench.clock.playing, "time stands still");
            assert_eq!(bench.settings.shown().len(), 1, "one at a time");
            bench.frame([1.0, 2.0]);
            frames += 1;
            assert!(frames < 1000, "it ends");
        }
        let names: Vec<&str> = bench.timing.tracks().iter().map(|track| track.way.name()).collect();
        let all: Vec<&str> = Technique::all().map(|t| t.name()).filter(|name| *name != "map").collect();
        assert_eq!(names, all, "all but the one that objects");
        assert!(bench.timing.tracks().iter().any(|t| t.way == before.ways[0]), "with its own options");
        assert!(bench.timing.tracks().iter().all(|t| t.frames.len() == ENOUGH), "enough of each");
        assert_eq!(bench.settings, before, "as before");
        assert!(bench.clock.playing, "and time runs");
    }

    #[test]
    fn measuring_stops_when_told() {
        let mut bench = Bench::new();
        let before = bench.settings.clone();
        bench.start();
        (0..30).for_each(|_| bench.frame([1.0, 2.0]));
        bench.timing.stop(&mut bench.settings, &mut bench.clock);
        assert_eq!(bench.settings, before, "as before");
        assert!(
            bench.timing.measuring().is_none() && !bench.timing.tracks().is_empty(),
            "what was measured is kept"
        );
        bench.start();
        let chosen: Way = "volume+samples:9".parse().expect("a way");
        bench.settings.ways[0] = chosen;
        bench.frame([1.0, 2.0]);
        assert!(bench.timing.measuring().is_none(), "somebody chose something else");
        assert_eq!(bench.settings.ways, [chosen, before.ways[1]], "which stays");
    }
}
