//! `volume`, in every way of counting.

use crate::classify::{Classified, classify};
use crate::common::awkward::awkward_views;
use antumbra::Technique;
use antumbra_host::{Api, Stage, TestContext};
use antumbra_scene::Scene;
use antumbra_testkit::random_mesh_scene::{RandomMeshScene, random_mesh_scene};
use antumbra_testkit::random_scene::{RandomScene, random_scene};

/// Pixels to either side of an edge where a technique without antialiasing, or with facets for curves, may differ.
const BAND: usize = 2;

/// Scenes of each kind; `ANTUMBRA_SCENES` sets another number.
fn scenes() -> u64 {
    std::env::var("ANTUMBRA_SCENES").map_or(20, |n| n.parse().expect("a number of scenes"))
}

fn countings() -> Vec<Technique> {
    ["volume", "volume:counting=depth-pass", "volume:counting=depth-fail"]
        .map(|text| Technique::parse(text).expect("a technique"))
        .to_vec()
}

/// Draws scenes in all ways; none may be wrong anywhere.
fn assert_right(api: Api, scenes: impl IntoIterator<Item = (String, Scene)>) {
    let Some(context) = TestContext::new(api) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    let techniques = countings();
    let mut all = vec![Classified::default(); techniques.len()];
    for (name, scene) in scenes {
        let found = classify(&mut stage, &scene, &name, &techniques, BAND);
        all.iter_mut().zip(found).for_each(|(all, found)| *all += found);
    }
    for (found, technique) in all.iter().zip(&techniques) {
        eprintln!("{api:?}, {technique}: {found:?}");
        assert!(found.dark > 1000 && found.lit > 1000, "{technique}: there are shadows and light to look at");
        assert_eq!(found.wrong, 0, "{technique}: pixels on the wrong side outside the band");
    }
}

/// Meshes, open and closed, and flat shapes, that shadow each other and themselves.
#[test]
fn meshes_are_classified_right() {
    let options = RandomMeshScene::default();
    assert_right(
        Api::Gl33,
        (0..scenes()).map(|seed| (format!("mesh scene {seed}"), random_mesh_scene(seed, &options))),
    );
}

#[test]
fn meshes_are_classified_right_by_opengl_es() {
    let options = RandomMeshScene::default();
    assert_right(
        Api::Gles30,
        (1000..1004).map(|seed| (format!("mesh scene {seed}"), random_mesh_scene(seed, &options))),
    );
}

/// Shapes, of which the ray tracer has the exact surface and the volume facets.
#[test]
fn shapes_are_classified_right() {
    let options = RandomScene { size: (480, 270), ..RandomScene::default() };
    let scene = |seed| {
        let mut scene = random_scene(seed, &options);
        // The receivers take light from each other in every other scene.
        scene.objects[..2].iter_mut().for_each(|o| o.casts_shadow = seed % 2 == 1);
        (format!("scene {seed}"), scene)
    };
    assert_right(Api::Gl33, (0..scenes()).map(scene));
}

/// Eyes and lights in awkward places, with exact shapes and with meshes: eyes in shadow, close to a ball or the
/// floor, in the floor's plane and below it; lights in the floor's plane and below it, and behind what casts.
#[test]
fn awkward_views_are_classified_right() {
    let eyes = [
        ("in the ball's shadow", [-0.5, 0.1, -0.3], [-3.0, 0.0, -4.0]),
        ("in the box's shadow", [1.0, 0.15, 0.55], [-1.0, 0.3, -2.0]),
    ];
    let tilted = r#"
        [[object]]
        name = "box"
        shape = { type = "box", size = [0.6, 0.5, 0.4] }
        translation = [1.1, 0.7, 0.6]
        rotation = [0.1, 0.3, 0.2, 0.9273618]
    "#;
    assert_right(Api::Gl33, awkward_views(&eyes, tilted));
}
