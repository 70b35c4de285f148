//! Writing whatever was read.

use std::path::Path;

use antumbra_scene::Scene;

/// What was read can be written, to the bit, and changed where it stands. Whether it was changed: not where the change would
/// make it no scene.
pub(crate) fn assert_written(scene: &Scene, text: &str) -> bool {
    let file = Path::new("no/such/folder/fuzz.toml");
    let written = scene.to_toml();
    let again = Scene::parse(&written, file).unwrap_or_else(|e| panic!("{e}\n{text}\nbecame\n{written}"));
    assert_eq!(format!("{again:?}"), format!("{scene:?}"), "{text}\nbecame\n{written}");
    assert_eq!(scene.update_toml(text), text, "nothing has changed");
    let mut changed = scene.clone();
    changed.camera.eye.x += 1.0;
    changed.image.width = 1 + changed.image.width % 100;
    for light in &mut changed.lights {
        light.name += "~";
        light.color.y *= 0.5;
    }
    changed.lights.reverse();
    for object in &mut changed.objects {
        object.casts_shadow ^= true;
        object.pose.translation.z *= 0.5;
        object.parts.rotate_left(1);
    }
    changed.objects.pop();
    let is_scene = changed.validate().is_ok();
    if is_scene {
        let updated = changed.update_toml(text);
        let again = Scene::parse(&updated, file).unwrap_or_else(|e| panic!("{e}\n{text}\nbecame\n{updated}"));
        assert_eq!(format!("{again:?}"), format!("{changed:?}"), "{text}\nbecame\n{updated}");
    }
    is_scene
}
