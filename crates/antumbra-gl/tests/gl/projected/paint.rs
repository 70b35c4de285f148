//! Painted shadows, with the stencil and without.

use super::{object, over_floor, point, renderer};
use crate::context::in_each_api;
use crate::lights::overlay;
use crate::shot::Shot;
use crate::world::World;
use antumbra_gl::Encoding;

/// How often each value is in a picture that was white.
fn values(picture: &[[u8; 4]]) -> Vec<(u8, usize)> {
    let mut counts = [0; 256];
    picture.iter().for_each(|texel| counts[usize::from(texel[1])] += 1);
    (0..=255).map(|value| (value, counts[usize::from(value)])).filter(|(_, n)| *n > 0).collect()
}

/// Half of white, and half of that, in 8 bits, each time rounded either way.
const HALF: [u8; 2] = [127, 128];
const QUARTER: [u8; 2] = [63, 64];

/// Paint is blended once a light with the stencil, and once a triangle without it: a ball's front and back make a
/// quarter of half.
#[test]
fn paint_is_blended_twice_without_the_stencil_alone() {
    in_each_api(|gl| {
        let balls = object("type = \"sphere\", radius = 0.4", [-0.9, 1.0, 0.0])
            + &object("type = \"rectangle\", width = 0.8, depth = 0.8", [0.9, 1.2, 0.0])
                .replace("\"o\"", "\"sheet\"");
        let world = over_floor(&point([0.0, 5.0, 1.0]), &balls);
        let shot = Shot::new(gl, &world);
        let frame = shot.frame().receivers(&world.receivers[..1]);
        let gamma = Encoding::Gamma(2.2);
        let once = values(&overlay(gl, &mut renderer(gl, "projected:shade=paper"), &frame, gamma));
        assert!(once.len() == 2 && HALF.contains(&once[0].0) && once[1].0 == 255, "half and whole: {once:?}");
        let off = "projected:shade=paper:stencil=off";
        let twice = values(&overlay(gl, &mut renderer(gl, off), &frame, gamma));
        let count = |of: &[(u8, usize)], what: [u8; 2]| -> usize {
            of.iter().filter(|(v, _)| what.contains(v)).map(|(_, n)| n).sum()
        };
        assert!(count(&twice, QUARTER) > 100, "the ball's front and back: {twice:?}");
        assert!(count(&twice, HALF) > 100, "the sheet has one side: {twice:?}");
        let shadow = once[0].1;
        let all: usize = twice.iter().filter(|(v, _)| *v < 255).map(|(_, n)| n).sum();
        assert_eq!(all, shadow, "the same pixels");
        // Linear pixels are displayed as their root: half of what is displayed is 0.5^2.2 of them.
        let linear =
            values(&overlay(gl, &mut renderer(gl, "projected:shade=paper"), &frame, Encoding::Linear));
        let expected = (0.5f32.powf(2.2) * 255.0).round() as u8;
        assert!(linear.len() == 2 && linear[0].0.abs_diff(expected) <= 1, "{linear:?}, not {expected}");
    });
}

/// Two lights darken twice where both are blocked; six lights take two rounds.
#[test]
fn paint_is_blended_once_for_each_light() {
    in_each_api(|gl| {
        let ball = object("type = \"sphere\", radius = 0.4", [0.0, 1.0, 0.0]);
        let world = over_floor(&point([0.0, 5.0, 1.0]), &ball);
        let shot = Shot::new(gl, &world);
        for count in [2, 6] {
            let lights = vec![world.lights[0]; count];
            let frame = shot.frame().lights(&lights);
            let mut renderer = renderer(gl, "projected:shade=paper");
            let found = values(&overlay(gl, &mut renderer, &frame, Encoding::Gamma(2.2)));
            let expected = 255.0 * 0.5f64.powi(count as i32);
            // Each rounding to 8 bits is off by half a step, which the next ones halve.
            let off = (f64::from(found[0].0) - expected).abs();
            assert!(found.len() == 2 && off <= 1.0, "{count} lights: {found:?}, not {expected}");
        }
    });
}

/// Without the stencil a shadow goes on over the edge of its receiver, into the void and onto what is behind.
#[test]
fn shadows_overrun_their_receivers_without_the_stencil() {
    in_each_api(|gl| {
        let camera = "camera = { eye = [1.0, 3.5, 7.0], target = [0.0, 0.6, 0.0] }\n";
        let table = object("type = \"rectangle\", width = 1.6, depth = 1.2", [0.0, 0.0, 0.0])
            .replace("\"o\"", "\"table\"");
        let ball = object("type = \"sphere\", radius = 0.5", [0.7, 1.5, 0.0]);
        let world = World::parse(&[camera, &point([0.9, 4.5, -0.5]), &table, &ball].concat());
        let shot = Shot::new(gl, &world);
        let painted = |technique: &str| -> Vec<bool> {
            let picture = overlay(gl, &mut renderer(gl, technique), &shot.frame(), Encoding::Linear);
            picture.iter().map(|texel| texel[0] < 255).collect()
        };
        let [on, off] = ["projected:shade=paper", "projected:shade=paper:stencil=off"].map(painted);
        let seen = |i: &usize, what: Option<u32>| shot.seen[*i].map(|s| s.primitive) == what;
        let count = |of: &[bool], what| (0..of.len()).filter(|i| of[*i] && seen(i, what)).count();
        assert!(count(&on, Some(0)) > 50, "a shadow on the table: {}", count(&on, Some(0)));
        assert_eq!(count(&on, Some(0)), count(&off, Some(0)), "the same shadow on the table");
        assert_eq!(count(&on, None) + count(&on, Some(1)), 0, "and nowhere else");
        assert!(count(&off, None) > 50, "in the void");
        assert_eq!(count(&off, Some(1)), 0, "but not over what is in front");
    });
}
