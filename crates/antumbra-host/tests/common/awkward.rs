//! Cameras and lights in awkward places.

use antumbra_scene::Scene;

/// A place for the eye: its name, where it is, where it looks.
pub(crate) type Eye = (&'static str, [f64; 3], [f64; 3]);

const EYES: [Eye; 7] = [
    ("far target", [0.0, 1.5, 3.0], [0.0, -1000.0, -5000.0]),
    ("near target", [0.0, 1.5, 3.0], [0.0, 1.4998, 2.999]),
    ("at the ball", [0.0, 0.9, 0.701], [0.0, 0.5, -100.0]),
    ("at the floor", [0.0, 1e-3, 4.0], [0.0, 0.4, 0.0]),
    ("in the floor", [0.0, 0.0, 4.0], [0.0, 0.4, 0.0]),
    ("below the floor", [0.0, -2.0, 4.0], [0.0, 0.0, 0.0]),
    ("along the floor", [0.0, 0.05, 60.0], [0.0, 0.0, 0.0]),
];

/// A ball and a cone over a floor that casts or does not, and a ball below it, under lights above the floor, in its
/// plane and below it; seen from places close to them, in the floor's plane and beneath it, and from `more` places,
/// with `objects` (TOML) added.
pub(crate) fn awkward_views(more: &[Eye], objects: &str) -> Vec<(String, Scene)> {
    let scene = |(name, eye, target): &Eye, casts: bool| {
        let text = format!(
            r#"
            camera = {{ eye = {eye:?}, target = {target:?} }}
            image = {{ width = 320, height = 180 }}
            [[light]]
            name = "above"
            type = "point"
            position = [1.5, 4.0, 1.0]
            intensity = 1.0
            [[light]]
            name = "level"
            type = "point"
            position = [3.0, 0.0, 2.0]
            intensity = 1.0
            [[light]]
            name = "below"
            type = "directional"
            direction = [0.3, 1.0, 0.1]
            intensity = 1.0
            [[object]]
            name = "floor"
            shape = {{ type = "plane" }}
            casts_shadow = {casts}
            [[object]]
            name = "ball"
            shape = {{ type = "sphere", radius = 0.7 }}
            translation = [0.0, 0.9, 0.0]
            [[object]]
            name = "cone"
            shape = {{ type = "cone", radius = 0.5, height = 1.0 }}
            translation = [-1.2, 0.5, 0.3]
            [[object]]
            name = "low"
            shape = {{ type = "sphere", radius = 0.4 }}
            translation = [0.3, -0.9, 0.2]
            {objects}
            "#
        );
        let name = format!("{name}, floor casts: {casts}");
        let scene = Scene::parse(&text, name.as_ref()).expect("the scene is right");
        (name, scene)
    };
    EYES.iter().chain(more).flat_map(|eye| [true, false].map(|casts| scene(eye, casts))).collect()
}
