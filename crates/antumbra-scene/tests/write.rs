//! Scenes that are written are read as they were.

#[expect(dead_code, reason = "written scenes are those of the other tests")]
mod common;
#[path = "common/random.rs"]
mod random;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use antumbra_scene::{LightKind, Mesh, Motion, Scene, Shape};
use glam::{DQuat, DVec3};

/// Every bit of a scene: numbers are shown with all their digits and the sign of zero.
fn bits(scene: &Scene) -> String {
    format!("{scene:?}")
}

fn files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let in_folder = |folder: &Path| std::fs::read_dir(folder).expect("a folder of scenes").flatten();
    let mut files: Vec<PathBuf> =
        in_folder(&folder).chain(in_folder(&folder.join("reference"))).map(|e| e.path()).collect();
    files.retain(|file| file.extension().is_some_and(|e| e == "toml"));
    files.sort();
    assert!(files.len() > 15, "the scenes of the project");
    files
}

#[test]
fn every_scene_of_the_project_comes_back() {
    for file in files() {
        let scene = Scene::load(&file).unwrap_or_else(|e| panic!("{e}"));
        let text = scene.to_toml();
        let again = Scene::parse(&text, &file).unwrap_or_else(|e| panic!("{e}\n{text}"));
        assert_eq!(bits(&again), bits(&scene), "{file:?} as\n{text}");
        assert_eq!(scene.validate(), Ok(()), "{file:?}");
        let original = std::fs::read_to_string(&file).expect("a file that was read before");
        assert_eq!(scene.update_toml(&original), original, "nothing has changed");
    }
}

#[test]
fn random_scenes_come_back() {
    let mut random = fastrand::Rng::with_seed(5);
    let mut scenes = 0;
    for _ in 0..4000 {
        let text = random::scene(&mut random);
        let Ok(scene) = Scene::parse(&text, Path::new("random.toml")) else { continue };
        scenes += 1;
        let written = scene.to_toml();
        let again = Scene::parse(&written, Path::new("written.toml"))
            .unwrap_or_else(|e| panic!("{e}\n{text}\nbecame\n{written}"));
        assert_eq!(bits(&again), bits(&scene), "{text}\nbecame\n{written}");
        assert_eq!(scene.validate(), Ok(()), "{text}");
        assert_eq!(scene.update_toml(&text), text, "nothing has changed");
    }
    assert!(scenes > 2000, "only {scenes} of the random files are scenes");
}

#[test]
fn the_text_is_as_a_person_would_write_it() {
    let scene = Scene::parse(common::EVERYTHING, "all.toml".as_ref()).expect("a scene");
    let text = scene.to_toml();
    for piece in [
        "ambient = [0.05, 0.06, 0.07]\n\n[camera]\neye = [0.0, 6.0, 12.0]\ntarget = [0.0, 1.0, 0.0]\nfov_y = 50.0\n\n[image]\n",
        "width = 320\nheight = 180\nexposure = 1.5\n\n[[light]]\nname = \"bulb\"\ntype = \"point\"\n",
        "motion = { type = \"orbit\", center = [0.0, 8.0, 0.0], axis = [0.0, 1.0, 0.0], period = 8.0 }\n\n[[light]]\nname = \"sun\"\n",
        "inner_angle = 15.0\nouter_angle = 25.0\nintensity = 300.0\n",
        "[[object]]\nname = \"floor\"\nshape = { type = \"plane\" }\ncasts_shadow = false\n\n[[object]]\n",
        "parts = [\n  { shape = { type = \"sphere\", radius = 0.6 }, translation = [0.0, 0.6, 0.0] },\n",
        "  { shape = { type = \"torus\", major_radius = 0.5, minor_radius = 0.1 } },\n]\n",
    ] {
        assert!(text.contains(piece), "no\n{piece}\nin\n{text}");
    }
    let least = Scene::parse("camera = { eye = [0, 2, 5] }", "least.toml".as_ref()).expect("a scene");
    assert_eq!(least.to_toml(), "[camera]\neye = [0.0, 2.0, 5.0]\n", "defaults are left out");
}

#[test]
fn what_no_file_can_say_becomes_the_nearest_it_can() {
    let mut scene = Scene::parse(common::EVERYTHING, "all.toml".as_ref()).expect("a scene");
    scene.camera.fov_y = 0.700_000_000_000_000_1;
    scene.camera.up = DVec3::new(0.0, 3.0, 0.1);
    scene.lights[0].motion =
        Some(Motion::Orbit { center: DVec3::ONE, axis: DVec3::new(3.0, 0.0, 4.0), period: 2.0 });
    scene.lights[1].kind = LightKind::Directional { direction: DVec3::NEG_Y * 7.0 };
    scene.lights[1].position = DVec3::ONE;
    scene.objects[0].pose.rotation = DQuat::from_xyzw(1.0, 2.0, 3.0, 4.0);
    assert_eq!(scene.validate(), Ok(()), "directions of any length are fine");
    let again = Scene::parse(&scene.to_toml(), "all.toml".as_ref()).expect("a scene");
    assert!((again.camera.fov_y - 0.7).abs() < 1e-15, "{}", again.camera.fov_y);
    assert_eq!(
        again.lights[1].kind,
        LightKind::Directional { direction: DVec3::NEG_Y },
        "the same direction"
    );
    assert_eq!(again.to_toml(), scene.to_toml(), "and it stays");
    assert_eq!(again.update_toml(&scene.to_toml()), scene.to_toml(), "and it stays");
    assert_eq!(scene.update_toml(&again.to_toml()), again.to_toml(), "and it is no change");
}

#[test]
fn what_no_file_may_say_is_told() {
    let good = Scene::parse(common::EVERYTHING, "all.toml".as_ref()).expect("a scene");
    let check = |change: &dyn Fn(&mut Scene), told: &str| {
        let mut scene = good.clone();
        change(&mut scene);
        let error = scene.validate().expect_err(told);
        assert!(error.contains(told) && error.contains("; ") && !error.contains('\n'), "{error}");
        let text = scene.to_toml();
        assert!(Scene::parse(&text, "all.toml".as_ref()).is_err(), "and reading refuses it:\n{text}");
        assert_eq!(scene.update_toml(&text), text, "which is all there is to it");
    };
    check(&|s| s.camera.eye = s.camera.target, "looks nowhere");
    check(&|s| s.camera.fov_y = 4.0, "fov_y");
    check(&|s| s.image.width = 0, "width");
    check(&|s| s.ambient.x = f64::NAN, "ambient");
    check(&|s| s.lights[0].intensity = f64::INFINITY, "intensity");
    check(&|s| s.lights[0].name = "a/b".to_owned(), "the character /");
    check(&|s| s.lights[0].name = "SUN".to_owned(), "ignoring case");
    check(&|s| s.objects[0].name = String::new(), "is empty");
    check(&|s| s.objects[0].name = "wall".to_owned(), "used already");
    check(&|s| s.objects[0].parts.clear(), "is empty");
    check(&|s| s.objects[0].pose.rotation = DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0), "no rotation");
    check(&|s| s.lights[1].kind = LightKind::Directional { direction: DVec3::NAN }, "direction");
    check(&|s| s.lights[0].motion = Some(Motion::Path { points: vec![], period: 1.0 }), "0 points");
    check(&|s| s.objects[0].parts[0].shape = Shape::Sphere { radius: -1.0 }, "above zero");
    let mesh = Arc::new(Mesh { path: "a.stl".to_owned(), positions: vec![], triangles: vec![] });
    check(&|s| s.objects[0].parts[0].shape = Shape::Mesh(Arc::clone(&mesh)), "stl");
}

#[test]
fn any_text_may_be_a_mesh_path() {
    let mut scene = Scene::parse(common::EVERYTHING, "all.toml".as_ref()).expect("a scene");
    for path in [
        "a \"b\".obj",
        "it's.glb",
        "'''\"\"\".gltf",
        "a\\b.obj",
        "a\nb\r\n.obj",
        "\u{7f}\u{1}.obj",
        "ü 灯.GLB",
    ] {
        let mesh = Mesh { path: path.to_owned(), positions: vec![], triangles: vec![] };
        scene.objects[0].parts[0].shape = Shape::Mesh(Arc::new(mesh));
        assert_eq!(scene.validate(), Ok(()), "{path:?}");
        let text = scene.to_toml();
        assert_eq!(scene.update_toml(&text), text, "{path:?} is read as it was written");
        let before = common::EVERYTHING;
        assert_eq!(scene.update_toml(&scene.update_toml(before)), scene.update_toml(before), "{path:?}");
        let crlf = before.replace('\n', "\r\n");
        assert!(scene.update_toml(&crlf).contains("name = \"wall\""), "{path:?}");
    }
}
