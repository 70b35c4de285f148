//! The scenes that come with the project.

#[expect(dead_code, reason = "the gallery needs no scene of its own")]
mod common;

use std::path::{Path, PathBuf};

use antumbra_scene::{Scene, Shape};

fn scenes(folder: &str) -> Vec<(PathBuf, Scene)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(folder);
    let mut files: Vec<_> =
        std::fs::read_dir(folder).expect("a folder of scenes").flatten().map(|e| e.path()).collect();
    files.retain(|file| file.extension().is_some_and(|e| e == "toml"));
    files.sort();
    files
        .into_iter()
        .map(|file| (file.clone(), Scene::load(&file).unwrap_or_else(|e| panic!("{e}"))))
        .collect()
}

#[test]
fn every_scene_is_sound_at_any_time() {
    for folder in ["", "reference"] {
        for (file, scene) in scenes(folder) {
            assert!(!scene.lights.is_empty() && !scene.objects.is_empty(), "{file:?} shows something");
            for time in [0.0, 1.7, 100.0, -3.3] {
                common::assert_sound(&scene, time);
            }
        }
    }
}

#[test]
fn the_gallery_needs_only_what_the_analytic_technique_draws() {
    let gallery = scenes("");
    assert!(gallery.len() >= 8, "a gallery of eight scenes or more");
    for (file, scene) in gallery {
        for object in &scene.objects {
            for part in &object.parts {
                match part.shape {
                    Shape::Plane
                    | Shape::Rectangle { .. }
                    | Shape::Disc { .. }
                    | Shape::Triangle { .. }
                    | Shape::Sphere { .. }
                    | Shape::Cone { .. } => {}
                    _ => panic!("{file:?}: the shape of {:?} belongs into scenes/reference", object.name),
                }
            }
        }
    }
}
