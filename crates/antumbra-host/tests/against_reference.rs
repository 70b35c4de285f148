//! OpenGL against the ray tracer, which shares no visibility code with it.

mod common;

use antumbra_host::{Api, RenderOptions, Stage};
use antumbra_reference::Tracer;
use antumbra_testkit::metrics;
use antumbra_testkit::random_scene::{RandomScene, random_scene};

/// Scenes; `ANTUMBRA_SCENES` sets another number.
const SCENES: u64 = 40;

/// No pixel on the wrong side outside a pixel's width of the true edges; on the edges, the
/// antialiased visibility within 0.03 (RMS over all scenes) of the sampled area of the pixel: the
/// bound of the exact half-plane coverage, 0.010, plus corners, grazing receivers and 8-bit masks.
#[test]
fn random_scenes_are_classified_right() {
    let Some(context) = common::context(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    let scenes = std::env::var("ANTUMBRA_SCENES").map_or(SCENES, |n| n.parse().expect("a number of scenes"));
    let (mut wrong, mut squares, mut edges, mut lights) = (0, 0.0, 0, 0);
    for seed in 0..scenes {
        let mut scene = random_scene(seed, &RandomScene::default());
        // The receivers take light from each other in every other scene.
        scene.objects[..2].iter_mut().for_each(|o| o.casts_shadow = seed % 2 == 1);
        let (width, height) = (scene.image.width, scene.image.height);
        let options = RenderOptions { time: 0.0, width, height, msaa: 1, visibility: true, shadows: true };
        let drawn = stage.render(&scene, &options).expect("the scene draws");
        let tracer = Tracer::new(&scene, 0.0);
        for (i, test) in drawn.visibility.iter().enumerate() {
            let truth = common::truth(&scene, &tracer, i, width, height);
            let missed = metrics::misclassified(test, &truth.visibility, &truth.band);
            let rms = metrics::rms(test, &truth.visibility, &truth.edge);
            let count = truth.edge.iter().filter(|e| **e).count();
            if missed > 0 || rms > 0.05 {
                eprintln!(
                    "scene {seed} light {i} ({:?}): {missed} wrong, {count} edge pixels, rms {rms:.4}",
                    scene.lights[i].kind
                );
            }
            wrong += missed;
            squares += rms * rms * count as f64;
            edges += count;
            lights += 1;
        }
    }
    let rms = (squares / edges as f64).sqrt();
    eprintln!("{scenes} scenes, {lights} lights: {wrong} pixels wrong, rms {rms:.4} on {edges} edge pixels");
    assert!(edges > 1000, "there are edges to look at");
    assert_eq!(wrong, 0, "pixels on the wrong side outside the band");
    assert!(rms <= 0.03, "rms {rms} on edge pixels");
}
