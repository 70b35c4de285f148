//! Where things are at a time: motions of positions, and the scene at one moment.

use glam::{DQuat, DVec3};

use crate::{Light, LightKind, Moment, Motion, Pose, Primitive, Scene};

impl Motion {
    /// The position at `time` seconds of something that is at `rest` when nothing moves it.
    ///
    /// Periodic for any finite time, negative ones too; a time that is not finite counts as 0. An
    /// orbit with a positive period turns counter-clockwise seen from the tip of its axis, and is at
    /// `rest` at time 0. A path is at its first point at time 0, whatever `rest` is.
    pub fn position(&self, rest: DVec3, time: f64) -> DVec3 {
        match self {
            Self::Orbit { center, axis, period } => {
                let turn = turns(time, *period);
                if turn == 0.0 {
                    return rest;
                }
                let rotation = DQuat::from_axis_angle(*axis, turn * core::f64::consts::TAU);
                *center + rotation * (rest - *center)
            }
            Self::Path { points, period } => {
                let sides = points.len();
                if sides == 0 {
                    return rest;
                }
                let at = turns(time, *period) * sides as f64;
                let side = (at as usize).min(sides - 1);
                points[side].lerp(points[(side + 1) % sides], at - side as f64)
            }
        }
    }

    /// The same motion of something that is moved `by` so many metres: the axis of an orbit, or every
    /// point of a path, is moved.
    pub fn translated(&self, by: DVec3) -> Self {
        match self {
            Self::Orbit { center, axis, period } => {
                Self::Orbit { center: *center + by, axis: *axis, period: *period }
            }
            Self::Path { points, period } => {
                Self::Path { points: points.iter().map(|p| *p + by).collect(), period: *period }
            }
        }
    }
}

/// Which part of a period `time` falls on, in [0, 1]. A negative period runs backwards; 0 for a
/// period of zero and for anything that is not finite.
fn turns(time: f64, period: f64) -> f64 {
    let length = period.abs();
    if !time.is_finite() || !length.is_finite() || length == 0.0 {
        return 0.0;
    }
    let part = time.rem_euclid(length) / length;
    if period < 0.0 && part > 0.0 { 1.0 - part } else { part }
}

impl Scene {
    /// The scene at `time` seconds: every light and every part of every object, in the world.
    ///
    /// Defined for every time; one that is not finite counts as 0.
    pub fn moment(&self, time: f64) -> Moment {
        let at = |motion: &Option<Motion>, rest| motion.as_ref().map_or(rest, |m| m.position(rest, time));
        let lights = self
            .lights
            .iter()
            .map(|light| {
                let position = match light.kind {
                    LightKind::Directional { .. } => light.position,
                    _ => at(&light.motion, light.position),
                };
                Light { position, motion: None, name: light.name.clone(), ..*light }
            })
            .collect();
        let mut primitives = Vec::with_capacity(self.objects.iter().map(|o| o.parts.len()).sum());
        for (object, o) in self.objects.iter().enumerate() {
            let pose = Pose { translation: at(&o.motion, o.pose.translation), ..o.pose };
            primitives.extend(o.parts.iter().enumerate().map(|(part, p)| Primitive {
                object,
                part,
                shape: p.shape.clone(),
                pose: pose.then(&p.pose),
                color: o.color,
                casts_shadow: o.casts_shadow,
                receives_shadow: o.receives_shadow,
            }));
        }
        Moment { lights, primitives }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding of one rotation of a vector of length 10 is some 4e-15; ten times that.
    const CLOSE: f64 = 4e-14;

    fn orbit(period: f64) -> Motion {
        Motion::Orbit { center: DVec3::new(1.0, 2.0, 3.0), axis: DVec3::Y, period }
    }

    fn square() -> Motion {
        let points = vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];
        Motion::Path { points, period: 8.0 }
    }

    #[track_caller]
    fn assert_close(a: DVec3, b: DVec3) {
        assert!((a - b).length() <= CLOSE, "{a} is not {b}");
    }

    #[test]
    fn an_orbit_turns_about_its_axis() {
        let rest = DVec3::new(3.0, 5.0, 3.0);
        let m = orbit(8.0);
        assert_eq!(m.position(rest, 0.0), rest, "at rest at time 0");
        assert_close(m.position(rest, 2.0), DVec3::new(1.0, 5.0, 1.0));
        assert_close(m.position(rest, 4.0), DVec3::new(-1.0, 5.0, 3.0));
        assert_close(m.position(rest, 6.0), DVec3::new(1.0, 5.0, 5.0));
        assert_eq!(m.position(rest, 8.0), rest, "a whole turn is no turn");
        assert_eq!(m.position(rest, -16.0), rest, "two turns back neither");
        assert_close(m.position(rest, -2.0), m.position(rest, 6.0));
        assert_close(orbit(-8.0).position(rest, 2.0), m.position(rest, -2.0));
    }

    #[test]
    fn a_path_takes_the_same_time_for_each_side() {
        let m = square();
        for (time, x, y) in [
            (0.0, 0.0, 0.0),
            (1.0, 0.5, 0.0),
            (2.0, 1.0, 0.0),
            (3.0, 1.0, 0.5),
            (5.0, 0.5, 1.0),
            (7.0, 0.0, 0.5),
            (8.0, 0.0, 0.0),
            (9.0, 0.5, 0.0),
            (-1.0, 0.0, 0.5),
        ] {
            assert_close(m.position(DVec3::splat(99.0), time), DVec3::new(x, y, 0.0));
        }
    }

    #[test]
    fn every_time_has_a_position() {
        let rest = DVec3::new(3.0, 5.0, 3.0);
        let times = [1e308, -1e308, 1e-308, -1e-308, f64::MIN_POSITIVE, -5e-324, 1e17, f64::MAX, f64::MIN];
        for m in [orbit(8.0), orbit(-1e-6), orbit(1e9), square()] {
            for t in times {
                let p = m.position(rest, t);
                assert!(p.is_finite() && p.length() < 20.0, "{m:?} at {t} is at {p}");
            }
            for t in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                assert_eq!(m.position(rest, t), m.position(rest, 0.0), "{t} counts as 0");
            }
        }
    }

    #[test]
    fn a_translated_motion_is_the_same_elsewhere() {
        let (rest, by) = (DVec3::new(3.0, 5.0, 3.0), DVec3::new(-1.0, 0.5, 7.0));
        for m in [orbit(8.0), orbit(-3.0), square()] {
            for time in [0.0, 0.7, 3.1, -2.0] {
                assert_close(m.translated(by).position(rest + by, time), m.position(rest, time) + by);
            }
        }
    }

    #[test]
    fn motions_without_a_period_or_points_stay() {
        let rest = DVec3::X;
        assert_eq!(orbit(0.0).position(rest, 3.0), rest, "no period, no turn");
        assert_eq!(orbit(f64::NAN).position(rest, 3.0), rest, "no period, no turn");
        let empty = Motion::Path { points: vec![], period: 1.0 };
        assert_eq!(empty.position(rest, 0.3), rest, "no points, no path");
    }
}
