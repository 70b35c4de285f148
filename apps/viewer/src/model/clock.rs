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

impl Clock {
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
}
