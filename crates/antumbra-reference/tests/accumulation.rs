//! Pictures made step by step are the pictures made at once, and stop when told to.

mod common;

use std::sync::atomic::{AtomicU64, Ordering};

use antumbra_reference::Tracer;
use antumbra_scene::{LightKind, Scene, Shape};
use common::{at, light, object, scene};
use glam::DVec3;

const GO_ON: &(dyn Fn() -> bool + Sync) = &|| true;
const SIZE: (u32, u32) = (48, 32);

/// A ball over a floor under a hard and a soft light, with background beside it.
fn ball_over_floor() -> Scene {
    scene(
        vec![
            light(LightKind::Point, DVec3::new(3.0, 5.0, 1.0), 40.0),
            light(LightKind::Sphere { radius: 0.8 }, DVec3::new(-3.0, 5.0, 1.0), 60.0),
        ],
        vec![
            object("floor", Shape::Rectangle { width: 6.0, depth: 6.0 }, at(DVec3::ZERO)),
            object("ball", Shape::Sphere { radius: 0.7 }, at(DVec3::Y)),
        ],
    )
}

#[test]
fn after_n_steps_the_mean_is_the_picture_of_n_samples() {
    let (width, height) = SIZE;
    let tracer = Tracer::new(&ball_over_floor(), 0.0);
    let mut sums = vec![DVec3::ZERO; (width * height) as usize];
    for sample in 0..16 {
        assert!(tracer.accumulate(width, height, sample, &mut sums, GO_ON), "nothing stops it");
        if sample == 0 {
            continue;
        }
        let count = sample + 1;
        let picture = tracer.render(width, height, count, &|_, _| {});
        for (sum, pixel) in sums.iter().zip(&picture) {
            let mean = (*sum / f64::from(count)).as_vec3();
            let error = (mean - glam::Vec3::from(*pixel)).abs().max_element();
            assert!(error <= 1e-6 * mean.max_element(), "{mean} is not {pixel:?} after {count}");
        }
    }
    let shades = sums.iter().filter(|sum| sum.max_element() > 0.0).count();
    assert!(shades > 500, "only {shades} pixels show anything");
}

/// Every row has got the ray or not, and most have not.
#[test]
fn stopped_pictures_have_whole_rows() {
    let (width, height) = SIZE;
    let tracer = Tracer::new(&ball_over_floor(), 0.0);
    let mut whole = vec![DVec3::ZERO; (width * height) as usize];
    assert!(tracer.accumulate(width, height, 3, &mut whole, GO_ON), "nothing stops it");

    let asked = AtomicU64::new(0);
    let mark = DVec3::splat(1e3);
    let mut sums = vec![mark; whole.len()];
    let stop = || asked.fetch_add(1, Ordering::Relaxed) < 10;
    assert!(!tracer.accumulate(width, height, 3, &mut sums, &stop), "stopped after ten rows");
    let mut rows = 0;
    for (row, expected) in sums.chunks(width as usize).zip(whole.chunks(width as usize)) {
        let skipped = row.iter().all(|&sum| sum == mark);
        let added = row.iter().zip(expected).all(|(&sum, &value)| sum == mark + value);
        assert!(skipped || added, "half a row");
        rows += usize::from(!skipped);
    }
    assert_eq!(rows, 10, "a row for each yes");
}

#[test]
fn empty_pictures_are_complete() {
    let tracer = Tracer::new(&ball_over_floor(), 0.0);
    for (width, height) in [(0, 5), (5, 0), (0, 0)] {
        assert!(tracer.accumulate(width, height, 0, &mut [], &|| false), "{width} by {height}");
    }
}

/// A tracer that was turned is one made for that camera.
#[test]
fn the_camera_can_be_changed() {
    let (width, height) = SIZE;
    let mut other = ball_over_floor();
    let mut tracer = Tracer::new(&other, 0.0);
    let before = tracer.render(width, height, 2, &|_, _| {});
    other.camera.eye += DVec3::new(1.0, 0.5, -0.5);
    tracer.set_camera(other.camera);
    let after = tracer.render(width, height, 2, &|_, _| {});
    assert_ne!(before, after, "another view");
    assert_eq!(after, Tracer::new(&other, 0.0).render(width, height, 2, &|_, _| {}));
}
