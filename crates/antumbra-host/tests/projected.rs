//! The technique `projected` against the ray tracer, on the pixels of its receivers: nothing falls on others.

mod common;

use antumbra::{Soft, Technique};
use antumbra_host::{Api, RenderOptions, Stage, TestContext};
use antumbra_reference::{Ray, Sampling, Tracer};
use antumbra_scene::{LightKind, Scene, Shape};
use antumbra_testkit::metrics::{edge_band, misclassified};
use antumbra_testkit::random_mesh_scene::{RandomMeshScene, random_mesh_scene};
use antumbra_testkit::random_scene::{RandomScene, random_scene};
use std::path::Path;

/// Scenes of each kind; `ANTUMBRA_SCENES` sets another number.
const SCENES: u64 = 20;

/// Pixels on either side of an edge that are not judged. Edges are not antialiased, so half a pixel is the pixel grid's;
/// the rest is what a tessellated circle and float32 matrices are off where a shadow is long.
const BAND: usize = 2;

fn projected() -> Technique {
    Technique::parse("projected").expect("the technique's name")
}

/// What a comparison finds.
#[derive(Debug, Default)]
struct Found {
    /// Pixels on the wrong side outside the band.
    wrong: usize,
    /// Receivers' pixels outside the band: dark, and lit.
    dark: usize,
    lit: usize,
    lights: usize,
}

impl Found {
    fn add(&mut self, other: &Self) {
        self.wrong += other.wrong;
        self.dark += other.dark;
        self.lit += other.lit;
        self.lights += other.lights;
    }
}

/// Points a side of the grid that looks for an edge inside a pixel.
const GRID: u32 = 16;

/// Whether an edge of a light's shadow runs through a pixel.
fn has_edge(scene: &Scene, tracer: &Tracer, light: usize, [x, y]: [u32; 2]) -> bool {
    let (width, height) = (scene.image.width, scene.image.height);
    let is_lit = |point: &u32| {
        let at = |pixel: u32, k: u32| f64::from(pixel) + (f64::from(k) + 0.5) / f64::from(GRID);
        let (origin, direction) = scene.camera.ray(at(x, point % GRID), at(y, point / GRID), width, height);
        let surface = tracer.surface(&Ray::new(origin, direction));
        surface.is_some_and(|surface| tracer.visibility_at(light, &surface, 1, 0) > 0.5)
    };
    let lit = (0..GRID * GRID).filter(is_lit).count() as u32;
    !(lit == 0 || lit == GRID * GRID)
}

/// Nothing falls on what is no receiver, where the light would arrive at all.
fn assert_nothing_elsewhere(
    scene: &Scene,
    tracer: &Tracer,
    light: usize,
    test: &[f32],
    receives: &dyn Fn(usize) -> bool,
) {
    let (width, height) = (scene.image.width, scene.image.height);
    let seen = |x: u32, y: u32| {
        let (origin, direction) = scene.camera.ray(f64::from(x) + 0.5, f64::from(y) + 0.5, width, height);
        tracer.surface(&Ray::new(origin, direction))
    };
    for (i, _) in test.iter().enumerate().filter(|(i, value)| !receives(*i) && !(**value > 0.5)) {
        let (x, y) = (i as u32 % width, i as u32 / width);
        let Some(surface) = seen(x, y) else { continue };
        let to_light = match tracer.lights()[light].kind {
            LightKind::Directional { direction } => -direction,
            _ => tracer.lights()[light].position - surface.point,
        };
        // Where the surface turns away from the light nothing arrives, and at its creases a pixel's neighbour may.
        let faces = surface.normal.dot(to_light.normalize_or_zero()) > 0.1;
        let goes_on = [(-1, 0), (1, 0), (0, -1), (0, 1)].into_iter().all(|(dx, dy)| {
            let next = x.checked_add_signed(dx).zip(y.checked_add_signed(dy)).and_then(|(x, y)| seen(x, y));
            next.is_some_and(|n| n.primitive == surface.primitive && n.normal.dot(surface.normal) > 0.9)
        });
        let arrives = tracer.unoccluded_irradiance(light, &surface, 1, 0) > 0.0;
        assert!(
            !(faces && goes_on && arrives),
            "light {light}: a shadow at {x} {y}, where nothing receives one"
        );
    }
}

fn compare(stage: &mut Stage, scene: &Scene, name: &str) -> Found {
    let (width, height) = (scene.image.width, scene.image.height);
    let technique = projected();
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
    let drawn = stage.render(scene, &options).unwrap_or_else(|error| panic!("{name}: {error}"));
    let moment = scene.moment(0.0);
    let receives = |id: Option<u32>| {
        id.map(|id| &moment.primitives[id as usize]).is_some_and(|primitive| {
            primitive.receives_shadow && matches!(primitive.shape, Shape::Plane | Shape::Rectangle { .. })
        })
    };
    let tracer = Tracer::new(scene, 0.0);
    let ids = tracer.primitives_seen(width, height);
    let mut found = Found::default();
    for (light, test) in drawn.visibility.iter().enumerate() {
        let centers = Sampling::Center { light_samples: 1 };
        let truth = tracer.visibility(light, width, height, centers, &|_, _| {});
        let mut band = edge_band(&truth, &ids, width as usize, height as usize, BAND);
        band.iter_mut().zip(&ids).for_each(|(skip, &id)| *skip |= !receives(id));
        // Threads of light or shadow narrower than a pixel have edges that centres do not tell.
        for i in (0..band.len()).filter(|&i| (test[i] > 0.5) != (truth[i] > 0.5)) {
            band[i] = band[i] || has_edge(scene, &tracer, light, [i as u32 % width, i as u32 / width]);
        }
        assert_nothing_elsewhere(scene, &tracer, light, test, &|pixel| receives(ids[pixel]));
        let wrong = misclassified(test, &truth, &band);
        if wrong > 0 {
            eprintln!("{name}, light {light} ({:?}): {wrong} pixels wrong", scene.lights[light].kind);
        }
        let judged = || truth.iter().zip(&band).filter(|(_, skip)| !**skip).map(|(v, _)| *v);
        found.add(&Found {
            wrong,
            dark: judged().filter(|v| *v < 0.5).count(),
            lit: judged().filter(|v| *v >= 0.5).count(),
            lights: 1,
        });
    }
    found
}

/// Compares scenes, and sees to it that there is something to judge.
fn classify(what: &str, api: Api, scenes: impl Iterator<Item = (String, Scene)>) {
    let Some(context) = TestContext::new(api) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    let mut all = Found::default();
    for (name, scene) in scenes {
        all.add(&compare(&mut stage, &scene, &name));
    }
    eprintln!("{what}, {api:?}: {all:?}");
    assert!(all.dark > 1000 && all.lit > 1000, "{what}: there is shadow and light to judge");
    assert_eq!(all.wrong, 0, "{what}: pixels on the wrong side outside the band");
}

fn count() -> u64 {
    std::env::var("ANTUMBRA_SCENES").map_or(SCENES, |n| n.parse().expect("a number of scenes"))
}

/// Meshes, closed and open, tessellated solids and flat shapes.
#[test]
fn random_meshes_are_classified_right() {
    let scene = |seed| (format!("meshes {seed}"), random_mesh_scene(seed, &RandomMeshScene::default()));
    classify("meshes", Api::Gl33, (0..count()).map(scene));
    classify("meshes", Api::Gles30, (1000..1000 + count() / 5).map(scene));
}

/// Spheres, cones, discs and triangles; in every other scene the receivers cast too.
#[test]
fn random_shapes_are_classified_right() {
    let scene = |seed| {
        let mut scene = random_scene(seed, &RandomScene { size: (480, 270), ..RandomScene::default() });
        scene.objects[..2].iter_mut().for_each(|o| o.casts_shadow = seed % 2 == 1);
        (format!("shapes {seed}"), scene)
    };
    classify("shapes", Api::Gl33, (0..count()).map(scene));
    classify("shapes", Api::Gles30, (1000..1000 + count() / 5).map(scene));
}

/// Gallery scenes: floors and walls, balls through the floor, a room where the seats of chairs receive, stairs.
#[test]
fn gallery_scenes_are_classified_right() {
    let gallery = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let names = ["balls-on-the-floor", "shadows-on-objects", "sun-and-spotlights", "through-the-plane"];
    let rooms = ["furnished-room", "staircase"];
    let scenes = names.into_iter().chain(rooms).map(|name| {
        let mut scene = Scene::load(&gallery.join(name).with_extension("toml")).expect("a gallery scene");
        (scene.image.width, scene.image.height) = (480, 270);
        (name.to_owned(), scene)
    });
    classify("the gallery", Api::Gl33, scenes);
}

/// Eyes far from the target, close to the floor, in its plane and below it; a light in the floor's plane, one just over
/// it and a sun below.
#[test]
fn awkward_views_are_classified_right() {
    let cameras = [
        ("far target", [0.0, 1.5, 3.0], [0.0, -1000.0, -5000.0]),
        ("at the floor", [0.0, 1e-3, 4.0], [0.0, 0.4, 0.0]),
        ("in the floor", [0.0, 0.0, 4.0], [0.0, 0.4, 0.0]),
        ("below the floor", [0.0, -2.0, 4.0], [0.0, 0.0, 0.0]),
        ("along the floor", [0.0, 0.05, 60.0], [0.0, 0.0, 0.0]),
        ("straight down", [0.0, 4.0, 0.001], [0.0, 0.0, 0.0]),
    ];
    let scenes = cameras.into_iter().map(|(name, eye, target)| {
        let text = format!(
            r#"
            camera = {{ eye = {eye:?}, target = {target:?} }}
            image = {{ width = 320, height = 180 }}
            light = [
              {{ name = "above", type = "point", position = [1.5, 4.0, 1.0], intensity = 1.0 }},
              {{ name = "level", type = "point", position = [3.0, 0.0, 2.0], intensity = 1.0 }},
              {{ name = "low", type = "point", position = [3.0, 0.3, 2.0], intensity = 1.0 }},
              {{ name = "below", type = "directional", direction = [0.3, 1.0, 0.1], intensity = 1.0 }},
            ]
            object = [
              {{ name = "floor", shape = {{ type = "plane" }} }},
              {{ name = "wall", shape = {{ type = "rectangle", width = 4.0, depth = 3.0 }},
                 translation = [0.0, 0.5, -2.0], rotation = [0.7071068, 0.0, 0.0, 0.7071068] }},
              {{ name = "ball", shape = {{ type = "sphere", radius = 0.7 }}, translation = [0.0, 0.9, 0.0] }},
              {{ name = "cone", shape = {{ type = "cone", radius = 0.5, height = 1.0 }}, translation = [-1.2, 0.5, 0.3] }},
              {{ name = "low", shape = {{ type = "sphere", radius = 0.4 }}, translation = [0.3, -0.9, 0.2] }},
            ]
            "#
        );
        (name.to_owned(), Scene::parse(&text, name.as_ref()).expect("the scene is right"))
    });
    classify("awkward views", Api::Gl33, scenes);
}
