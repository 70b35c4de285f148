//! The gallery: scenes that are part of the program, so that an installed one needs no files.

/// A scene of the gallery.
pub(crate) struct Entry {
    /// Name of the scene and of its picture, without extension.
    pub(crate) name: &'static str,
    /// The scene file.
    pub(crate) text: &'static str,
}

macro_rules! gallery {
    ($($name:literal),* $(,)?) => {
        &[$(Entry {
            name: $name,
            text: include_str!(concat!("../../../scenes/", $name, ".toml")),
        }),*]
    };
}

/// Every scene in `scenes/`, in the order that `antumbra demo` renders them. A new scene is added here; a test tells
/// when one is missing.
pub(crate) const GALLERY: &[Entry] = gallery![
    "primitives-light-above",
    "primitives-light-aside",
    "sphere-two-lights",
    "cone-two-lights",
    "soft-from-three-lights",
    "balls-on-the-floor",
    "through-the-plane",
    "coloured-lights",
    "shadows-on-objects",
    "sun-and-spotlights",
    "mobile",
    "winter-evening",
    "many-lights",
    "two-area-lights",
    "furnished-room",
    "staircase",
];

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::path::Path;

    use antumbra_scene::{Scene, Shape};

    use super::*;
    use crate::technique::Technique;

    #[test]
    fn every_scene_is_listed() {
        let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
        let files: BTreeSet<String> = std::fs::read_dir(directory)
            .expect("scenes/ is part of the repository")
            .map(|entry| entry.expect("readable").path())
            .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
            .map(|path| path.file_stem().expect("has a name").to_string_lossy().into_owned())
            .collect();
        let listed: BTreeSet<String> = GALLERY.iter().map(|entry| entry.name.to_owned()).collect();
        assert_eq!(listed.len(), GALLERY.len(), "no scene twice");
        assert_eq!(listed, files, "GALLERY lists what is in scenes/");
        assert!(GALLERY.len() >= 6, "a gallery of six scenes or more");
    }

    #[test]
    fn every_scene_can_be_drawn_anywhere() {
        for entry in GALLERY {
            let scene = Scene::parse(entry.text, Path::new(entry.name))
                .unwrap_or_else(|error| panic!("{}: {error}", entry.name));
            let shapes = scene.objects.iter().flat_map(|object| &object.parts).map(|part| &part.shape);
            let meshes = shapes.filter(|shape| matches!(shape, Shape::Mesh(_))).count();
            assert_eq!(meshes, 0, "{} reads no mesh: an installed program has none", entry.name);
            let technique = Technique::from(antumbra::Technique::default());
            assert_eq!(technique.objection(&scene, 0.0), None, "{} is drawn with OpenGL", entry.name);
        }
    }
}
