//! The time of the scene's motions.

use serde::{Deserialize, Serialize};

/// Seconds of the scene, running or not.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Clock {
    /// Seconds since the motions' start.
    pub(crate) time: f64,
    /// Whether it runs.
    pub(crate) playing: bool,
    /// Seconds of the scene in a second; negative runs backwards.
    pub(crate) speed: f64,
}

impl Default for Clock {
    fn default() -> Self {
        Self { time: 0.0, playing: false, speed: 1.0 }
    }
}

/// The most that passes between two frames, seconds: after a pause of the machine things go on where they were.
const LONGEST_STEP: f64 = 0.25;

/// The slowest and the fastest that time runs but for standing still, either way.
const SPEEDS: (f64, f64) = (1.0 / 64.0, 16.0);

/// The latest time, either way: as long as the longest period of a motion.
const LATEST: f64 = antumbra_scene::limits::MAX_PERIOD;

impl Clock {
    /// Makes time run faster or slower by a factor; from standing still it starts slowly.
    pub(crate) fn scale_speed(&mut self, factor: f64) {
        let (least, most) = SPEEDS;
        let size = (self.speed.abs() * factor).clamp(least, most);
        self.speed = if self.speed < 0.0 { -size } else { size };
    }

    /// The same clock with what makes no sense put right.
    pub(crate) fn sane(self) -> Self {
        let within = |x: f64, most: f64, usual: f64| if x.is_finite() { x.clamp(-most, most) } else { usual };
        Self { time: within(self.time, LATEST, 0.0), speed: within(self.speed, SPEEDS.1, 1.0), ..self }
    }

    /// Lets `elapsed` seconds pass.
    pub(crate) fn advance(&mut self, elapsed: f64) {
        if self.playing {
            self.time += elapsed.clamp(0.0, LONGEST_STEP) * self.speed;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_passes_while_playing() {
        let mut clock = Clock { speed: -2.0, ..Clock::default() };
        clock.advance(0.1);
        assert_eq!(clock.time, 0.0, "it stands still at first");
        clock.playing = true;
        clock.advance(0.1);
        assert_eq!(clock.time, -0.2, "twice as fast, backwards");
        clock.advance(1000.0);
        assert_eq!(clock.time, -0.2 - 2.0 * LONGEST_STEP, "no jump after a long frame");
    }

    #[test]
    fn speeds_have_ends() {
        let mut clock = Clock { speed: 0.0, ..Clock::default() };
        clock.scale_speed(2.0);
        assert_eq!(clock.speed, SPEEDS.0, "it starts");
        for _ in 0..100 {
            clock.scale_speed(2.0);
        }
        assert_eq!(clock.speed, SPEEDS.1, "and has an end");
        let odd = Clock { time: 1e300, speed: f64::NAN, playing: true }.sane();
        assert_eq!((odd.time, odd.speed), (LATEST, 1.0), "put right");
    }
}
