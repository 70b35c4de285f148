//! OpenGL against the ray tracer, which shares no visibility code with it.

mod common;

use antumbra::{Soft, Technique};
use antumbra_host::{Api, RenderOptions, Stage, TestContext};
use antumbra_reference::Tracer;
use antumbra_scene::Scene;
use antumbra_testkit::metrics;
use antumbra_testkit::random_scene::{RandomScene, random_scene};

/// Scenes; `ANTUMBRA_SCENES` sets another number.
const SCENES: u64 = 40;

/// No pixel on the wrong side outside a pixel's width of the true edges; on the edges, the
/// antialiased visibility within 0.03 (RMS over all scenes) of the sampled area of the pixel: the
/// bound of the exact half-plane coverage, 0.010, plus corners, grazing receivers and 8-bit masks.
#[test]
fn random_scenes_are_classified_right() {
    let scenes = std::env::var("ANTUMBRA_SCENES").map_or(SCENES, |n| n.parse().expect("a number of scenes"));
    classify(Api::Gl33, 0..scenes, 0.0105);
}

/// The same with OpenGL ES 3.0, on scenes of its own.
#[test]
fn random_scenes_are_classified_right_by_opengl_es() {
    classify(Api::Gles30, 1000..1008, 0.0145);
}

/// What a comparison of all lights of a scene finds.
#[derive(Default)]
struct Found {
    /// Pixels on the wrong side outside the band.
    wrong: usize,
    /// Sum of squared differences on edge pixels.
    squares: f64,
    /// Edge pixels.
    edges: usize,
    /// Pixels outside the band: dark, and lit.
    dark: usize,
    lit: usize,
}

fn compare(stage: &mut Stage, scene: &Scene, name: &str) -> Found {
    let (width, height) = (scene.image.width, scene.image.height);
    let technique = Technique::default();
    let options = RenderOptions {
        time: 0.0,
        width,
        height,
        msaa: 1,
        visibility: true,
        shadows: true,
        technique,
        soft: Soft::Native,
    };
    let drawn = stage.render(scene, &options).expect("the scene draws");
    let tracer = Tracer::new(scene, 0.0);
    let mut found = Found::default();
    for (i, test) in drawn.visibility.iter().enumerate() {
        let truth = common::truth(scene, &tracer, i, width, height);
        let wrong = metrics::misclassified(test, &truth.visibility, &truth.band);
        let rms = metrics::rms(test, &truth.visibility, &truth.edge);
        let edges = truth.edge.iter().filter(|e| **e).count();
        if wrong > 0 || rms > 0.05 {
            let kind = &scene.lights[i].kind;
            eprintln!("{name} light {i} ({kind:?}): {wrong} wrong, {edges} edge pixels, rms {rms:.4}");
        }
        found.wrong += wrong;
        found.squares += rms * rms * edges as f64;
        found.edges += edges;
        let judged = || truth.visibility.iter().zip(&truth.band).filter(|(_, band)| !**band).map(|(v, _)| *v);
        found.dark += judged().filter(|v| *v < 0.5).count();
        found.lit += judged().filter(|v| *v >= 0.5).count();
    }
    found
}

/// With shapes that `analytic` draws in closed form.
#[test]
fn awkward_views_are_classified_right() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    let mut all = Found::default();
    for (name, scene) in common::awkward::awkward_views(&[], "") {
        let Found { wrong, dark, lit, .. } = compare(&mut stage, &scene, &name);
        if wrong > 0 {
            eprintln!("{name}: {wrong} pixels are wrong");
        }
        (all.wrong, all.dark, all.lit) = (all.wrong + wrong, all.dark + dark, all.lit + lit);
    }
    assert_eq!(all.wrong, 0, "pixels on the wrong side outside the band");
    assert!(
        all.dark > 10_000 && all.lit > 10_000,
        "there is much to judge: {} dark, {} lit",
        all.dark,
        all.lit
    );
}

/// `most`: root mean square error on edge pixels. A pixel that an edge cuts twice, at tips and between shadows, is known in
/// part.
fn classify(api: Api, seeds: std::ops::Range<u64>, most: f64) {
    let Some(context) = TestContext::new(api) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    let scenes = seeds.end - seeds.start;
    let (mut wrong, mut squares, mut edges, mut lights) = (0, 0.0, 0, 0);
    for seed in seeds {
        let mut scene = random_scene(seed, &RandomScene::default());
        // The receivers take light from each other in every other scene.
        scene.objects[..2].iter_mut().for_each(|o| o.casts_shadow = seed % 2 == 1);
        lights += scene.lights.len();
        let found = compare(&mut stage, &scene, &format!("scene {seed}"));
        wrong += found.wrong;
        squares += found.squares;
        edges += found.edges;
    }
    let rms = (squares / edges as f64).sqrt();
    eprintln!(
        "{api:?}: {scenes} scenes, {lights} lights: {wrong} pixels wrong, rms {rms:.4} on {edges} edge pixels"
    );
    assert!(edges > 1000, "there are edges to look at");
    assert_eq!(wrong, 0, "pixels on the wrong side outside the band");
    assert!(rms <= most, "rms {rms} on edge pixels");
}

/// Gallery scenes and random ones: the picture in linear light within 2/255 of the traced one, pixel
/// by pixel, on 99.94 % of the pixels away from every edge of shadow, object or light cone. Beyond
/// half floats (relative 5e-4) there is no reason for a difference; the rest are pixels whose centre
/// a float32 ray puts on the other side of a crease.
#[test]
fn pictures_are_the_traced_ones() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    let gallery = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let files =
        ["balls-on-the-floor", "coloured-lights", "many-lights", "shadows-on-objects", "sun-and-spotlights"];
    let mut scenes: Vec<_> = files
        .iter()
        .map(|name| Scene::load(&gallery.join(name).with_extension("toml")).expect("a gallery scene"))
        .collect();
    scenes.extend((100..110).map(|seed| random_scene(seed, &RandomScene::default())));
    for (n, scene) in scenes.iter().enumerate() {
        let (width, height) = (480, 270);
        let technique = Technique::default();
        let options = RenderOptions {
            time: 0.5,
            width,
            height,
            msaa: 1,
            visibility: false,
            shadows: true,
            technique,
            soft: Soft::Native,
        };
        let drawn = stage.render(scene, &options).expect("the scene draws");
        let tracer = Tracer::new(scene, 0.5);
        let traced = tracer.render(width, height, 1, &|_, _| {});
        let mut band = vec![false; traced.len()];
        for light in 0..scene.lights.len() {
            let edges = common::band(&tracer, light, width, height);
            band.iter_mut().zip(edges).for_each(|(band, edge)| *band |= edge);
        }
        let differs = |(a, b): (&[f32; 3], &[f32; 3])| (0..3).any(|c| !((a[c] - b[c]).abs() <= 2.0 / 255.0));
        let compared = band.iter().filter(|b| !**b).count();
        let off = (0..band.len()).filter(|&i| !band[i] && differs((&drawn.image[i], &traced[i]))).count();
        eprintln!("scene {n}: {off} of {compared} pixels differ by more than 2/255");
        assert!(compared > band.len() / 10, "scene {n} is more than edges");
        assert!(off * 10_000 <= compared * 6, "scene {n}: {off} of {compared} pixels differ");
    }
}
