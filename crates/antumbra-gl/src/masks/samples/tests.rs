//! Points of lights, and their weights.

use super::*;
use crate::input::Soft;
use crate::twins::samples::sample_weight;
use glam::Vec3;

const SPHERE: Area = Area::Sphere { radius: 0.7 };

fn disc() -> Area {
    Area::Disc { direction: DVec3::new(0.6, -0.8, 0.0), radius: 0.7 }
}

fn rectangle() -> Area {
    Area::Rectangle {
        direction: DVec3::NEG_Y,
        half_right: DVec3::new(0.4, 0.0, 0.3),
        half_up: DVec3::new(-0.6, 0.0, 0.8),
    }
}

fn points(area: &Area, count: u32, pattern: Pattern) -> Vec<DVec3> {
    let mut points = Vec::new();
    light_points(area, count, pattern, |p| points.push(p));
    points
}

#[test]
fn points_lie_on_the_light_and_are_as_many_as_asked_for() {
    for area in [SPHERE, disc(), rectangle()] {
        for pattern in [Pattern::Spread, Pattern::Row] {
            for count in [1, 2, 3, 4, 5, 16, 17, 64, 1000, Soft::MOST] {
                let points = points(&area, count, pattern);
                assert_eq!(points.len(), count as usize, "{area:?}, {pattern:?}");
                for p in points {
                    let inside = match area {
                        Area::None => false,
                        Area::Sphere { radius } => p.length() <= radius * 1.000_001,
                        Area::Disc { direction, radius } => {
                            p.length() <= radius * 1.000_001 && p.dot(direction).abs() < 1e-9
                        }
                        Area::Rectangle { direction, half_right, half_up } => {
                            let along = |h: DVec3| p.dot(h).abs() <= h.length_squared() * 1.000_001;
                            along(half_right) && along(half_up) && p.dot(direction).abs() < 1e-9
                        }
                    };
                    assert!(inside, "{p} is on {area:?}, {pattern:?} of {count}");
                }
            }
        }
    }
    assert!(points(&Area::None, 5, Pattern::Spread).is_empty(), "a light without area has none");
    assert!(points(&SPHERE, 0, Pattern::Spread).is_empty(), "none of none");
}

/// The 4 x 4 of the module of 2002, and the row of three of the paper of 2017.
#[test]
fn the_published_patterns() {
    let area = Area::Rectangle { direction: DVec3::NEG_Y, half_right: DVec3::X, half_up: DVec3::Z };
    for (k, p) in points(&area, 16, Pattern::Spread).iter().enumerate() {
        let at = |i: usize| -0.75 + 0.5 * i as f64;
        assert!(p.abs_diff_eq(DVec3::new(at(k % 4), 0.0, at(k / 4)), 1e-12), "{k}: {p}");
    }
    let row = points(&Area::Sphere { radius: 2.0 }, 3, Pattern::Row);
    assert_eq!(row, [DVec3::X * -2.0, DVec3::ZERO, DVec3::X * 2.0], "rim, centre, rim");
}

/// To a hundredth: the most that these patterns of 1024 points are off by in a half-plane.
#[test]
fn any_part_of_a_light_has_its_share_of_the_points() {
    let n = 1024;
    for area in [SPHERE, disc()] {
        let points = points(&area, n, Pattern::Spread);
        // Seen along any direction in its plane half of a round light lies to one side of a line through the centre,
        // and 0.195501 of it beyond half the radius.
        for i in 0..16 {
            let turn = DVec2::from_angle(0.2 + i as f64);
            let normal = match area {
                Area::Disc { direction, .. } => {
                    direction.any_orthonormal_vector() * turn.x
                        + direction.cross(direction.any_orthonormal_vector()) * turn.y
                }
                _ => DVec3::new(turn.x * 0.8, 0.6 - 0.1 * i as f64, turn.y * 0.8).normalize(),
            };
            for (beyond, share) in [(0.0, 0.5), (0.35, 0.195_501)] {
                let some = points.iter().filter(|p| p.dot(normal) > beyond).count();
                let found = some as f64 / f64::from(n);
                assert!(
                    (found - share).abs() < 0.01,
                    "{area:?} beyond {beyond} of {normal}: {found}, not {share}"
                );
            }
        }
    }
}

/// What a ball sends is known in closed form (the light wholly above the horizon: that of a point at its centre).
#[test]
fn the_points_of_a_ball_send_what_the_ball_does() {
    let (center, normal) = (Vec3::new(0.3, 1.5, -0.4), Vec3::Y);
    let emitted: f32 = {
        let points = points(&SPHERE, 4096, Pattern::Spread);
        let weights = points
            .iter()
            .map(|p| sample_weight(center + p.as_vec3(), center, glam::Vec4::ZERO, Vec3::ZERO, normal));
        weights.sum::<f32>() / 4096.0
    };
    let exact = normal.dot(center.normalize());
    assert!((emitted - exact).abs() < 2e-3, "{emitted} for {exact}");
}

#[test]
fn weights_by_hand() {
    let weight = |point: [f32; 3], emitter: glam::Vec4, normal: Vec3| {
        sample_weight(point.into(), Vec3::Y * 2.0, emitter, Vec3::ZERO, normal)
    };
    let (down, up) = (glam::Vec4::new(0.0, -1.0, 0.0, 1.0), glam::Vec4::new(0.0, 1.0, 0.0, 1.0));
    assert_eq!(weight([0.0, 2.0, 0.0], down, Vec3::Y), 1.0, "straight above");
    // 45 degrees: cosines of 1/sqrt 2, at a distance of sqrt 2 times as much.
    assert!((weight([2.0, 2.0, 0.0], down, Vec3::Y) - 0.25).abs() < 1e-6, "cosine, cosine and falloff");
    let ball = weight([2.0, 2.0, 0.0], glam::Vec4::ZERO, Vec3::Y);
    assert!((ball - 0.5 / 2f32.sqrt()).abs() < 1e-6, "no cosine at the light");
    assert_eq!(weight([0.0, -2.0, 0.0], glam::Vec4::ZERO, Vec3::Y), 0.0, "below the horizon");
    assert_eq!(weight([0.0, 2.0, 0.0], up, Vec3::Y), 0.0, "behind the light");
    assert!(weight([0.0; 3], down, Vec3::Y).is_finite(), "on the point itself");
}
