//! Models that other programs wrote: read, made meshes, drawn and traced.
//!
//! They are those of the Asset Importer Library, in `/usr/share/assimp/models` (`cargo xtask setup` installs
//! them) or the folder that `ANTUMBRA_MODELS` names.

mod common;

use std::path::PathBuf;
use std::sync::Arc;

use antumbra::math::TriangleMesh;
use antumbra::math::mesh::Silhouette;
use antumbra_host::{Api, RenderOptions, Stage, TestContext};
use antumbra_reference::Tracer;
use antumbra_scene::{Mesh, Scene, Shape};
use glam::DVec3;

/// The folder, or `None` where there is none, said aloud; where tests must not be skipped that is a failure.
fn folder() -> Option<PathBuf> {
    let folder = std::env::var_os("ANTUMBRA_MODELS").map_or("/usr/share/assimp/models".into(), PathBuf::from);
    if folder.join("glTF2").is_dir() {
        return Some(folder);
    }
    let missing = format!("there are no models in {}; `cargo xtask setup` installs them", folder.display());
    assert!(std::env::var_os("ANTUMBRA_REQUIRE_GL").is_none(), "{missing}");
    eprintln!("skipped: {missing}");
    None
}

const ENGINE: &str = "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb";

/// A model, the triangles its file has and how many of these have an area, and whether it is closed
/// once vertices at one place are one.
const MODELS: [(&str, usize, usize, bool); 13] = [
    ("OBJ/WusonOBJ.obj", 3732, 3732, false),
    ("OBJ/box.obj", 12, 12, true),
    ("OBJ/box_UTF16BE.obj", 12, 12, true),
    ("OBJ/spider.obj", 1368, 1312, false),
    ("OBJ/regr01.obj", 2710, 2706, false),
    // One polygon round a ring, with two corners twice where it is slit.
    ("OBJ/concave_polygon.obj", 64, 64, false),
    ("OBJ/empty_mat.obj", 256, 256, true),
    (ENGINE, 121_496, 110_336, false),
    ("glTF2/BoxTextured-glTF-Binary/BoxTextured.glb", 12, 12, true),
    ("glTF2/BoxTextured-glTF-Embedded/BoxTextured.gltf", 12, 12, true),
    ("glTF2/BoxTextured-glTF-techniqueWebGL/BoxTextured.gltf", 12, 12, true),
    ("glTF2/textureTransform/TextureTransformTest.gltf", 24, 24, false),
    ("glTF2/simple_skin/simple_skin.gltf", 8, 8, false),
];

/// Files that are no meshes, and what the error says.
const REFUSED: [(&str, &str); 8] = [
    ("OBJ/number_formats.obj", "position parse error"),
    ("OBJ/point_cloud.obj", "no triangle"),
    ("invalid/malformed.obj", "out of bounds"),
    ("glTF2/draco/2CylinderEngine.gltf", "KHR_draco_mesh_compression"),
    ("glTF2/IndexOutOfRange/IndexOutOfRange.gltf", "vertex 255"),
    ("glTF2/MissingBin/BoxTextured.gltf", "No such file"),
    ("glTF2/RecursiveNodes/RecursiveNodes.gltf", "in a cycle"),
    ("glTF2/wrongTypes/badArray.gltf", "malformed"),
];

/// A scene of one object.
fn scene(folder: &std::path::Path, model: &str) -> Result<Scene, String> {
    let text = format!(
        "camera.eye = [0, 2, 9]\n[[object]]\nname = 'm'\nshape = {{ type = 'mesh', path = '{model}' }}"
    );
    Scene::parse(&text, &folder.join("scene.toml")).map_err(|e| e.to_string())
}

fn mesh(scene: &Scene) -> &Arc<Mesh> {
    match &scene.objects[0].parts[0].shape {
        Shape::Mesh(mesh) => mesh,
        other => panic!("{other:?} is no mesh"),
    }
}

#[test]
fn models_are_read_and_are_meshes() {
    let Some(folder) = folder() else { return };
    for (model, in_file, with_area, closed) in MODELS {
        let scene = scene(&folder, model).expect(model);
        let mesh = mesh(&scene);
        assert_eq!(mesh.triangles.len(), with_area, "{model}: triangles of {in_file}");
        let made = TriangleMesh::new(mesh.positions.clone(), mesh.triangles.clone()).expect(model);
        assert_eq!(made.is_closed(), closed, "{model} is closed");
        assert!(made.positions().len() <= mesh.positions.len(), "{model}: welding adds nothing");
        // Each triangle has three sides, and none is lost where faces meet.
        let sides: usize = made.edges().iter().map(|edge| made.faces_of(edge).len()).sum();
        assert_eq!(sides, 3 * with_area, "{model}: sides");
        let bounds = made.bounding_sphere();
        let farthest = made.positions().iter().map(|p| p.distance(bounds.center)).fold(0.0, f64::max);
        assert!(farthest <= bounds.radius * (1.0 + 1e-12), "{model}: a corner at {farthest} of {bounds:?}");
        let (low, high) = scene.moment(0.0).primitives[0].bounds().expect("a mesh has bounds");
        assert!(bounds.radius <= 0.5 * low.distance(high) * (1.0 + 1e-9), "{model}: {bounds:?}");
    }
}

/// A shadow volume closes if as many of its sides and caps run along every edge one way as the other.
#[test]
fn silhouettes_of_models_close() {
    let Some(folder) = folder() else { return };
    let mut out = Silhouette::default();
    for (model, ..) in MODELS {
        let scene = scene(&folder, model).expect(model);
        let mesh = mesh(&scene);
        let made = TriangleMesh::new(mesh.positions.clone(), mesh.triangles.clone()).expect(model);
        let bounds = made.bounding_sphere();
        for light in [
            (bounds.center + DVec3::new(0.9, 2.0, 0.7) * bounds.radius).extend(1.0),
            (bounds.center + DVec3::new(0.1, 0.05, -0.2) * bounds.radius).extend(1.0),
            DVec3::new(-0.3, 0.8, 0.5).extend(0.0),
        ] {
            made.silhouette(light, &mut out);
            assert!(!out.caps.is_empty(), "{model} has a shadow");
            let mut balance = std::collections::HashMap::new();
            let caps = out.caps.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
            // A side runs against its edge.
            for [a, b] in caps.chain(out.edges.iter().map(|&[a, b]| [b, a])) {
                *balance.entry([a.min(b), a.max(b)]).or_insert(0) += if a < b { 1 } else { -1 };
            }
            let open = balance.values().filter(|n| **n != 0).count();
            assert_eq!(open, 0, "{model} from {light}: edges that do not close");
        }
    }
}

#[test]
fn files_that_are_no_meshes_say_why() {
    let Some(folder) = folder() else { return };
    for (model, why) in REFUSED {
        let error = scene(&folder, model).expect_err(model);
        assert!(error.contains(why), "{model}: {error}");
        assert!(error.len() < 400 && error.lines().count() == 1, "{model}: {error}");
    }
}

/// An engine of a hundred thousand triangles, most of them smaller than a pixel.
#[test]
fn a_model_is_drawn_as_it_is_traced() {
    let Some(folder) = folder() else { return };
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let text = format!(
        r#"
        ambient = [0.1, 0.1, 0.1]
        camera = {{ eye = [-350.0, 420.0, 620.0], target = [0.0, 10.0, 0.0], fov_y = 40.0 }}
        image = {{ width = 480, height = 320 }}
        [[light]]
        name = "sun"
        type = "directional"
        direction = [0.5, -1.0, -0.6]
        intensity = 3.0
        [[object]]
        name = "floor"
        shape = {{ type = "plane" }}
        translation = [0.0, -140.0, 0.0]
        casts_shadow = false
        [[object]]
        name = "engine"
        shape = {{ type = "mesh", path = "{ENGINE}" }}
        color = [0.7, 0.5, 0.3]
        casts_shadow = false
        "#
    );
    let scene = Scene::parse(&text, &folder.join("scene.toml")).expect("a scene");
    let (width, height) = (scene.image.width, scene.image.height);
    let mut stage = Stage::new(context.gl()).expect("a stage");
    let options = RenderOptions {
        time: 0.0,
        width,
        height,
        msaa: 1,
        visibility: false,
        shadows: false,
        technique: antumbra::Technique::default(),
        soft: antumbra::Soft::Native,
    };
    let drawn = stage.render(&scene, &options).expect("a picture").image;
    let tracer = Tracer::new(&scene, 0.0);
    let traced = tracer.render(width, height, 1, &|_, _| {});
    let seen = tracer.primitives_seen(width, height);
    let engine = seen.iter().filter(|p| **p == Some(1)).count();
    assert!(engine * 6 > seen.len(), "{engine} pixels of {} see the engine", seen.len());
    // The two agree on the colour (float16 has three digits) of what is seen through a pixel's
    // centre, but for the centres that an edge passes within OpenGL's 1/256 of a pixel.
    let off = |i: &usize| (0..3).any(|c| !((drawn[*i][c] - traced[*i][c]).abs() <= 2e-3));
    let differ = (0..seen.len()).filter(off).count();
    assert!(differ * 50 < engine, "{differ} pixels of {engine} differ");
}
