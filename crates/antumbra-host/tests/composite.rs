//! The composite method through a host: against the ray tracer where it is exact, and what it says of scenes it
//! cannot draw.

mod common;

use antumbra::{Soft, Technique};
use antumbra_host::{Api, RenderOptions, Stage, TestContext, objection};
use antumbra_reference::Tracer;
use antumbra_scene::Scene;
use antumbra_testkit::metrics;
use std::path::Path;

/// Scenes; `ANTUMBRA_COMPOSITE_SCENES` sets another number.
const SCENES: u64 = 12;

fn options(technique: &str, msaa: u32) -> RenderOptions {
    let technique = Technique::parse(technique).expect("a technique");
    let (width, height) = (320, 180);
    RenderOptions {
        time: 0.0,
        width,
        height,
        msaa,
        visibility: true,
        shadows: true,
        technique,
        soft: Soft::Native,
    }
}

/// Discs that lie level and triangles in any pose over a floor, under all hard lights.
fn exact_scene(seed: u64) -> Scene {
    let mut random = fastrand::Rng::with_seed(seed);
    let mut within = |low: f64, high: f64| low + random.f64() * (high - low);
    let mut text = String::from(
        r#"
        camera = { eye = [0.3, 4.0, 7.0], target = [0.0, 0.3, 0.0] }
        [[object]]
        name = "floor"
        shape = { type = "plane" }
        casts_shadow = false
        "#,
    );
    for i in 0..4 {
        let (x, y, z) = (within(-2.5, 2.5), within(0.4, 2.0), within(-2.0, 2.0));
        let radius = within(0.1, 0.7);
        text += &format!(
            "[[object]]\nname = \"disc {i}\"\nshape = {{ type = \"disc\", radius = {radius} }}\n\
             translation = [{x}, {y}, {z}]\n"
        );
        let mut corner = || [within(-0.7, 0.7), within(0.1, 1.2), within(-0.7, 0.7)];
        let corners = [corner(), corner(), corner()];
        let (x, z) = (within(-2.5, 2.5), within(-2.0, 2.0));
        text += &format!(
            "[[object]]\nname = \"triangle {i}\"\nshape = {{ type = \"triangle\", vertices = {corners:?} }}\n\
             translation = [{x}, 0.0, {z}]\n"
        );
    }
    let (x, y, z) = (within(-4.0, 4.0), within(2.5, 8.0), within(-4.0, 4.0));
    let (dx, dz) = (within(-0.8, 0.8), within(-0.8, 0.8));
    text += &format!(
        r#"
        [[light]]
        name = "point"
        type = "point"
        position = [{x}, {y}, {z}]
        intensity = 50.0
        [[light]]
        name = "sun"
        type = "directional"
        direction = [{dx}, -1.0, {dz}]
        intensity = 2.0
        [[light]]
        name = "spot"
        type = "spot"
        position = [{z}, {y}, {x}]
        direction = [{dx}, -1.0, {dz}]
        outer_angle = 50.0
        intensity = 50.0
        "#
    );
    Scene::parse(&text, "exact.toml".as_ref()).expect("the scene is right")
}

/// Where the method is exact it has no pixel on the wrong side outside the band, as the ray tracer sees the
/// floor, which alone receives; and its edges are antialiased as well as the exact technique's.
#[test]
fn discs_and_triangles_are_the_traced_ones() {
    let scenes = std::env::var("ANTUMBRA_COMPOSITE_SCENES").map_or(SCENES, |n| n.parse().expect("a number"));
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    let (mut wrong, mut squares, mut edges) = (0, 0.0, 0);
    for seed in 0..scenes {
        let scene = exact_scene(seed);
        let options = options("composite:shade=physical", 1);
        let drawn = stage.render(&scene, &options).expect("the scene draws");
        let tracer = Tracer::new(&scene, 0.0);
        let seen = tracer.primitives_seen(options.width, options.height);
        for (i, test) in drawn.visibility.iter().enumerate() {
            let truth = common::truth(&scene, &tracer, i, options.width, options.height);
            let is_floor = |pixel: usize| seen[pixel] == Some(0);
            let band: Vec<bool> =
                truth.band.iter().enumerate().map(|(i, band)| *band || !is_floor(i)).collect();
            let edge: Vec<bool> =
                truth.edge.iter().enumerate().map(|(i, edge)| *edge && is_floor(i)).collect();
            wrong += metrics::misclassified(test, &truth.visibility, &band);
            let rms = metrics::rms(test, &truth.visibility, &edge);
            let count = edge.iter().filter(|e| **e).count();
            squares += rms * rms * count as f64;
            edges += count;
        }
    }
    let rms = (squares / edges as f64).sqrt();
    eprintln!("{scenes} scenes: {wrong} pixels wrong, rms {rms:.4} on {edges} edge pixels");
    assert!(edges > 1000, "there are edges to look at");
    assert_eq!(wrong, 0, "pixels on the wrong side outside the band");
    assert!(rms <= 0.016, "rms {rms} on edge pixels");
}

fn gallery(name: &str) -> Scene {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    Scene::load(&scenes.join(name).with_extension("toml")).expect("a gallery scene")
}

/// The papers' own set-ups are drawn as published, with and without samples: what is painted is one grey a
/// part, of all channels alike.
#[test]
fn the_papers_scenes_are_painted() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    let most = stage.shadows().caps().max_samples.min(4);
    for name in ["primitives-light-above", "primitives-light-aside", "sphere-two-lights", "cone-two-lights"] {
        let scene = gallery(name);
        for msaa in [1, most] {
            let plain = RenderOptions { shadows: false, ..options("composite", msaa) };
            let plain = stage.render(&scene, &plain).expect("it draws").image;
            let drawn = stage.render(&scene, &options("composite", msaa)).expect("it draws");
            let changed: Vec<[f32; 3]> =
                drawn.image.iter().zip(&plain).filter(|(a, b)| a != b).map(|(a, _)| *a).collect();
            let gray = |c: &[f32; 3]| (c[0] - c[1]).abs() < 1e-4 && (c[1] - c[2]).abs() < 1e-4;
            let grays = changed.iter().filter(|c| gray(c)).count();
            eprintln!("{name}, {msaa} samples: {} pixels painted, {grays} wholly", changed.len());
            assert!(changed.len() > 500, "{name}: {} pixels are painted", changed.len());
            // All but edges, which keep some of the floor's colour; the shadows are small here.
            assert!(grays * 3 > changed.len() * 2, "{name}: {grays} of {} are grey", changed.len());
        }
    }
}

/// Objects that the papers have no equations for are named, with a technique that can.
#[test]
fn scenes_it_cannot_draw_are_refused_by_name() {
    let says = |scene: &Scene| {
        let paper = Technique::parse("composite").expect("it exists");
        objection(scene, &scene.moment(0.0), &paper, Soft::Native).map(|error| error.to_string())
    };
    for (name, object, why) in [
        ("winter-evening", "light \"moon\"", "point lights alone"),
        ("shadows-on-objects", "the scene", "several receive"),
        ("sun-and-spotlights", "light \"sun\"", "point lights alone"),
    ] {
        let says = says(&gallery(name)).unwrap_or_default();
        for part in [object, why, "composite", "--technique analytic"] {
            assert!(says.contains(part), "{name}: {part} is not in: {says}");
        }
    }
    for (shape, why) in [
        ("{ type = \"disc\", radius = 0.3 }, rotation = [0.1, 0.0, 0.0, 0.995]", "not parallel"),
        ("{ type = \"cone\", radius = 0.3, height = 0.5 }, rotation = [0.1, 0.0, 0.0, 0.995]", "axis"),
        ("{ type = \"sphere\", radius = 1.5 }", "passes through"),
        ("{ type = \"box\", size = [0.1, 0.1, 0.1] }", "meshes, and this box"),
    ] {
        let text = format!(
            r#"
            object = [
                {{ name = "floor", shape = {{ type = "plane" }} }},
                {{ name = "thing", translation = [0.0, 1.0, 0.0], shape = {shape} }},
            ]
            camera = {{ eye = [0.0, 4.0, 7.0] }}
            [[light]]
            name = "lamp"
            type = "point"
            position = [0.0, 5.0, 0.0]
            intensity = 1.0
            "#
        );
        let scene = Scene::parse(&text, "thing.toml".as_ref()).expect("the scene is right");
        let says = says(&scene).unwrap_or_default();
        assert!(says.contains("object \"thing\"") && says.contains(why), "{shape}: {says}");
    }
    assert_eq!(says(&gallery("soft-from-three-lights")), None, "the papers' own");
}
