//! Shadow maps through a host, against the ray tracer: how many pixels are wrong, and what biases do about it.

mod common;

use antumbra::Technique;
use antumbra_host::{Api, RenderOptions, Stage, TestContext};
use antumbra_reference::{Sampling, Tracer};
use antumbra_scene::Scene;
use antumbra_testkit::metrics::{edge_band, misclassified, rms};
use antumbra_testkit::random_mesh_scene::{RandomMeshScene, random_mesh_scene};
use antumbra_testkit::random_scene::{RandomScene, random_scene};

/// Scenes; `ANTUMBRA_MAP_SCENES` sets another number.
const SCENES: u64 = 8;

fn scenes() -> u64 {
    std::env::var("ANTUMBRA_MAP_SCENES").map_or(SCENES, |n| n.parse().expect("a number of scenes"))
}

/// What is seen of one light, and the pixels within one and two pixels of an edge.
struct Truth {
    visibility: Vec<f32>,
    bands: [Vec<bool>; 2],
}

fn truths(scene: &Scene) -> Vec<Truth> {
    let (width, height) = (scene.image.width, scene.image.height);
    let tracer = Tracer::new(scene, 0.0);
    let ids = tracer.primitives_seen(width, height);
    let of = |light| {
        let visibility =
            tracer.visibility(light, width, height, Sampling::Center { light_samples: 1 }, &|_, _| {});
        let bands = [1, 2].map(|r| edge_band(&visibility, &ids, width as usize, height as usize, r));
        Truth { visibility, bands }
    };
    (0..scene.lights.len()).map(of).collect()
}

/// Pixels on the wrong side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Wrong {
    /// Outside the band of one pixel, and of two.
    outside: [usize; 2],
    /// Outside the band of two: dark where light arrives, and lit where none does.
    dark: usize,
    lit: usize,
    /// All pixels outside the band of two.
    all: usize,
}

fn draw(stage: &mut Stage, scene: &Scene, technique: &str) -> Vec<Vec<f32>> {
    let (width, height) = (scene.image.width, scene.image.height);
    let technique = Technique::parse(technique).expect("a technique");
    let options = RenderOptions {
        time: 0.0,
        width,
        height,
        msaa: 1,
        visibility: true,
        shadows: false,
        technique,
        soft: antumbra::Soft::Native,
    };
    stage.render(scene, &options).expect("the scene draws").visibility
}

fn add(wrong: &mut Wrong, drawn: &[Vec<f32>], truths: &[Truth]) {
    for (drawn, truth) in drawn.iter().zip(truths) {
        for (count, band) in wrong.outside.iter_mut().zip(&truth.bands) {
            *count += misclassified(drawn, &truth.visibility, band);
        }
        for i in (0..drawn.len()).filter(|&i| !truth.bands[1][i]) {
            wrong.all += 1;
            match (drawn[i] > 0.5, truth.visibility[i] > 0.5) {
                (false, true) => wrong.dark += 1,
                (true, false) => wrong.lit += 1,
                _ => {}
            }
        }
    }
}

fn wrong(stage: &mut Stage, scene: &Scene, technique: &str) -> Wrong {
    let mut wrong = Wrong::default();
    let drawn = draw(stage, scene, technique);
    add(&mut wrong, &drawn, &truths(scene));
    wrong
}

/// Every light of every scene with each technique.
fn tally<const N: usize>(scenes: impl Iterator<Item = Scene>, techniques: [&str; N]) -> Option<[Wrong; N]> {
    let context = TestContext::new(Api::Gl33)?;
    let mut stage = Stage::new(context.gl()).expect("a stage");
    let mut tally = [Wrong::default(); N];
    for scene in scenes {
        let truths = truths(&scene);
        for (wrong, technique) in tally.iter_mut().zip(techniques) {
            let drawn = draw(&mut stage, &scene, technique);
            add(wrong, &drawn, &truths);
        }
    }
    for (wrong, technique) in tally.iter().zip(techniques) {
        eprintln!("{technique}: {wrong:?}");
    }
    Some(tally)
}

/// Exact primitives, in every second scene with receivers that cast too.
fn primitives(seed: u64) -> Scene {
    let mut scene = random_scene(seed, &RandomScene { size: (480, 270), ..RandomScene::default() });
    scene.objects[..2].iter_mut().for_each(|o| o.casts_shadow = seed % 2 == 1);
    scene
}

/// What a map cannot tell is within some texels of an edge. So wrong pixels get fewer as texels get smaller, and at
/// 2048, where a texel is a fraction of these pictures' pixels, hardly one in a million is left outside the band: in
/// shadows narrower than a texel, and where a receiver meets its caster.
#[test]
fn wrong_pixels_fall_as_the_map_grows() {
    let techniques = ["map:size=128", "map:size=512", "map:size=1024", "map:size=2048"];
    let Some(tally) = tally((0..scenes()).map(primitives), techniques) else { return };
    let [tiny, small, middle, large] = tally;
    assert!(tiny.outside[0] > 300, "at 128 texels stairs are seen: {tiny:?}");
    assert!(small.outside[0] * 4 < tiny.outside[0], "{small:?} after {tiny:?}");
    assert!(middle.outside[0] <= small.outside[0], "{middle:?} after {small:?}");
    assert!(large.outside[0] <= middle.outside[0], "{large:?} after {middle:?}");
    assert!(large.outside[1] * 1_000_000 <= large.all, "{large:?}");
}

/// Meshes that shadow themselves, boxes, tori and the rest, on walls that cast too. What is left is a facet here and there
/// that the light grazes at less than two degrees, beyond the steepest receiver that is followed.
#[test]
fn meshes_are_right_without_acne() {
    let options = RandomMeshScene { casters_receive: true, size: (480, 270), ..RandomMeshScene::default() };
    let meshes = (0..scenes()).map(|seed| random_mesh_scene(seed, &options));
    let techniques = ["map:size=512", "map", "map:constant-bias=0:slope-bias=0:normal-offset=0"];
    let Some([small, large, unbiased]) = tally(meshes, techniques) else { return };
    assert!(large.outside[1] <= small.outside[1], "{large:?} after {small:?}");
    assert!(unbiased.dark > 100 * large.dark.max(1), "without bias there is acne: {unbiased:?}");
    assert!(large.outside[1] * 20_000 <= large.all, "{large:?}");
}

/// A table and a wall that cast, things that stand on them, a lamp aside and a low sun.
fn still_life() -> Scene {
    let text = r#"
        camera = { eye = [0.5, 2.4, 5.0], target = [0.0, 0.5, 0.0] }
        image = { width = 480, height = 270 }
        [[light]]
        name = "lamp"
        type = "point"
        position = [-2.0, 3.0, 1.5]
        intensity = 40.0
        [[light]]
        name = "sun"
        type = "directional"
        direction = [-0.8, -0.25, -0.3]
        intensity = 2.0
        [[light]]
        name = "spot"
        type = "spot"
        position = [1.0, 4.0, 2.0]
        direction = [-0.2, -1.0, -0.5]
        inner_angle = 20.0
        outer_angle = 35.0
        intensity = 60.0
        [[object]]
        name = "table"
        shape = { type = "rectangle", width = 8.0, depth = 6.0 }
        [[object]]
        name = "wall"
        shape = { type = "rectangle", width = 8.0, depth = 4.0 }
        translation = [0.0, 2.0, -2.0]
        rotation = [0.7071068, 0.0, 0.0, 0.7071068]
        [[object]]
        name = "ball"
        shape = { type = "sphere", radius = 0.5 }
        translation = [-0.9, 0.5, 0.3]
        [[object]]
        name = "cone"
        shape = { type = "cone", radius = 0.4, height = 1.2 }
        translation = [0.9, 0.6, 0.2]
        [[object]]
        name = "card"
        shape = { type = "rectangle", width = 0.8, depth = 1.0 }
        translation = [0.0, 0.5, -0.8]
        rotation = [0.7071068, 0.0, 0.0, 0.7071068]
    "#;
    Scene::parse(text, "still-life.toml".as_ref()).expect("the scene is right")
}

/// Without bias a surface shadows itself in stripes; with the defaults it does not; with a huge bias objects come off
/// their shadows.
#[test]
fn biases_trade_acne_against_gaps() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    let scene = still_life();
    for size in [512, 2048] {
        let mut of = |options: &str| {
            let wrong = wrong(&mut stage, &scene, &format!("map:size={size}{options}"));
            eprintln!("size={size}{options}: {wrong:?}");
            wrong
        };
        let none = of(":constant-bias=0:slope-bias=0:normal-offset=0");
        assert!(none.dark * 20 > none.all, "acne darkens a twentieth of everything: {none:?}");
        let defaults = of("");
        assert!(defaults.dark + defaults.lit <= 4, "the defaults leave neither acne nor gaps: {defaults:?}");
        let slope = of(":constant-bias=0:normal-offset=0");
        assert!(slope.dark > 100, "the receiver's plane alone is undecided about itself: {slope:?}");
        let far = size / 4;
        let huge = of(&format!(":constant-bias={far}"));
        assert!(huge.lit > 500 && huge.dark <= 4, "gaps where things stand: {huge:?}");
        let moved = of(&format!(":normal-offset={far}"));
        assert!(moved.lit > 500, "shadows move: {moved:?}");
    }
}

/// A wider filter smooths edges: nearer to the pixel's true area than stairs are, here where texels are about as large as
/// pixels. The figures are those of docs/theory/map.md.
#[test]
fn filters_smooth_stairs() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    let scene = still_life();
    let (width, height) = (scene.image.width, scene.image.height);
    let tracer = Tracer::new(&scene, 0.0);
    let truths: Vec<_> =
        (0..scene.lights.len()).map(|light| common::truth(&scene, &tracer, light, width, height)).collect();
    let edges: usize = truths.iter().map(|t| t.edge.iter().filter(|edge| **edge).count()).sum();
    assert!(edges > 1000, "{edges} pixels with an edge");
    let mut error = |technique: &str| {
        let drawn = draw(&mut stage, &scene, technique);
        let squares: f64 =
            drawn.iter().zip(&truths).map(|(d, t)| rms(d, &t.visibility, &t.edge).powi(2)).sum();
        let error = (squares / truths.len() as f64).sqrt();
        eprintln!("{technique}: rms {error:.4} on edge pixels");
        error
    };
    let [none, bilinear, pcf] = ["map:filter=none", "map:radius=0.5", "map"].map(&mut error);
    assert!(bilinear < none && pcf < none, "filtered {bilinear} and {pcf}, not {none}");
    assert!(pcf < bilinear, "wider than bilinear: {pcf}, not {bilinear}");
    for (found, published) in [(none, 0.24), (bilinear, 0.2), (pcf, 0.145)] {
        assert!(found <= published, "{found}, not {published}");
    }
}

/// PCSS knows one mean blocker: near the truth where there is one, and not far off where there are several. Over the
/// pixels that are partly lit, the error is a fraction of the penumbra's own spread, which is 0.29 for an even ramp.
#[test]
fn penumbrae_are_near_the_traced_ones() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    for (name, light) in [
        ("ball", "type = \"sphere\"\nradius = 0.4"),
        ("disc", "type = \"disc\"\nradius = 0.4\ndirection = [0.5, -0.8, -0.3]"),
        (
            "rectangle",
            "type = \"rectangle\"\ndirection = [0.6, -0.8, 0.0]\nright = [0.0, 0.0, 1.0]\nwidth = 1.2\nheight = 0.3",
        ),
    ] {
        let text = format!(
            r#"
            camera = {{ eye = [0.5, 3.2, 6.5], target = [0.0, 0.6, 0.0] }}
            image = {{ width = 240, height = 135 }}
            [[light]]
            name = "lamp"
            {light}
            position = [-2.5, 4.5, 2.0]
            intensity = 70.0
            [[object]]
            name = "floor"
            shape = {{ type = "rectangle", width = 10.0, depth = 10.0 }}
            [[object]]
            name = "ball"
            shape = {{ type = "sphere", radius = 0.6 }}
            translation = [-1.2, 0.6, 0.3]
            [[object]]
            name = "cone"
            shape = {{ type = "cone", radius = 0.6, height = 1.8 }}
            translation = [1.2, 0.9, 0.2]
            [[object]]
            name = "disc"
            shape = {{ type = "disc", radius = 0.5 }}
            translation = [0.1, 1.7, 0.6]
            rotation = [0.3, 0.0, 0.2, 0.93]
            "#
        );
        let scene = Scene::parse(&text, "soft.toml".as_ref()).expect("the scene is right");
        let tracer = Tracer::new(&scene, 0.0);
        let truth = tracer.visibility(0, 240, 135, Sampling::Center { light_samples: 64 }, &|_, _| {});
        let drawn = &draw(&mut stage, &scene, "map:filter=pcss")[0];
        let penumbra: Vec<bool> = truth.iter().map(|v| *v > 0.02 && *v < 0.98).collect();
        let error = rms(drawn, &truth, &penumbra);
        let count = penumbra.iter().filter(|p| **p).count();
        eprintln!("{name}: rms {error:.3} over {count} pixels of penumbra");
        assert!(count > 500, "{name}: {count} pixels of penumbra");
        assert!(error < 0.07, "{name}: {error}");
    }
}
