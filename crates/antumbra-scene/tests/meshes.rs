//! Meshes through the front door: a scene file that names them, and malformed ones.

use std::path::Path;

use antumbra_scene::{Mesh, Scene, SceneError, Shape};
use base64::Engine;
use glam::DVec3;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

/// Writes the files into a folder and loads a scene that has the first as a mesh.
fn load(folder: &Path, files: &[(&str, &[u8])]) -> Result<std::sync::Arc<Mesh>, SceneError> {
    for (name, bytes) in files {
        std::fs::write(folder.join(name), bytes).expect("a temporary file");
    }
    let text = format!(
        "camera.eye = [0, 2, 9]\n[[object]]\nname = 'm'\nshape = {{ type = 'mesh', path = '{}' }}",
        files[0].0
    );
    let scene = Scene::parse(&text, &folder.join("scene.toml"))?;
    assert!(scene.moment(0.0).primitives[0].bounds().is_some(), "a mesh has bounds");
    match &scene.objects[0].parts[0].shape {
        Shape::Mesh(mesh) => Ok(mesh.clone()),
        other => panic!("{other:?} is no mesh"),
    }
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// A triangle and its indices (u16), and a second set of positions, in one buffer.
fn buffer() -> Vec<u8> {
    let mut bytes: Vec<u8> =
        [0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].iter().flat_map(|f| f.to_le_bytes()).collect();
    bytes.extend([0u16, 1, 2, 2, 1, 0].iter().flat_map(|i| i.to_le_bytes()));
    bytes
}

/// A document with the triangle under two nodes; `edit` may spoil it.
fn document(uri: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
"nodes":[{{"translation":[10,0,0],"children":[1,2]}},{{"mesh":0,"scale":[2,2,2]}},{{"mesh":0,"rotation":[0,0,0.70710678,0.70710678]}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
{{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}}],
"bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":12}}],
"buffers":[{{"byteLength":48{uri}}}]}}"#
    )
}

fn embedded() -> String {
    let data = base64::engine::general_purpose::STANDARD.encode(buffer());
    document(&format!(r#","uri":"data:application/octet-stream;base64,{data}""#))
}

fn glb() -> Vec<u8> {
    let mut json = document("").into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let bin = buffer();
    let mut glb = b"glTF\x02\0\0\0".to_vec();
    glb.extend(((12 + 8 + json.len() + 8 + bin.len()) as u32).to_le_bytes());
    glb.extend((json.len() as u32).to_le_bytes());
    glb.extend(b"JSON");
    glb.extend(&json);
    glb.extend((bin.len() as u32).to_le_bytes());
    glb.extend(b"BIN\0");
    glb.extend(&bin);
    glb
}

#[test]
fn obj() {
    let mesh = load(folder().path(), &[("a b.OBJ", TETRAHEDRON.as_bytes())]).expect("a valid file");
    assert_eq!((mesh.positions.len(), mesh.triangles.len()), (4, 4), "a tetrahedron");
    assert_eq!(mesh.path, "a b.OBJ", "the path as the scene wrote it");
}

#[test]
fn gltf_transforms_and_buffers() {
    let folder = folder();
    let (json, external) = (embedded(), document(r#","uri":"the%20buffer.bin""#));
    let cases: [&[(&str, &[u8])]; 3] = [
        &[("a.gltf", json.as_bytes())],
        &[("b.gltf", external.as_bytes()), ("the buffer.bin", &buffer())],
        &[("c.glb", &glb())],
    ];
    for files in cases {
        let mesh = load(folder.path(), files).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!((mesh.positions.len(), mesh.triangles.len()), (6, 4), "two nodes, both sides each");
        // Node 1: twice as large, 10 to the right. Node 2: a quarter turn about Z, 10 to the right.
        // The quaternion has 8 digits, and float32.
        for (i, expected) in
            [(1, DVec3::new(12.0, 0.0, 0.0)), (4, DVec3::new(10.0, 1.0, 0.0)), (5, DVec3::new(9.0, 0.0, 0.0))]
        {
            let at = mesh.positions[i];
            assert!((at - expected).length() < 1e-7, "vertex {i} is at {at}, not {expected}");
        }
        assert_eq!(mesh.triangles[3], [5, 4, 3], "indices start at the node's first vertex");
    }
}

#[test]
fn one_file_is_read_once() {
    let folder = folder();
    std::fs::write(folder.path().join("t.obj"), TETRAHEDRON).expect("a temporary file");
    let object =
        |i: usize| format!("[[object]]\nname = '{i}'\nshape = {{ type = 'mesh', path = 't.obj' }}\n");
    let text = format!("camera.eye = [0, 2, 9]\n{}", (0..3).map(object).collect::<String>());
    let scene = Scene::parse(&text, &folder.path().join("s.toml")).expect("a valid scene");
    let meshes: Vec<_> = scene.objects.iter().map(|o| &o.parts[0].shape).collect();
    let (Shape::Mesh(a), Shape::Mesh(b)) = (meshes[0], meshes[2]) else { panic!("meshes") };
    assert!(std::sync::Arc::ptr_eq(a, b), "one mesh in memory");
}

#[test]
fn malformed_gltf() {
    let folder = folder();
    let good = embedded();
    for (from, to, fragment) in [
        ("\"count\":3", "\"count\":4", "is shorter than what is read"),
        ("\"count\":3", "\"count\":4000000000", "is too large"),
        ("\"count\":6", "\"count\":18446744073709551615", "is too large"),
        ("\"byteOffset\":36", "\"byteOffset\":18446744073709551615", "is shorter than what is read"),
        ("\"byteLength\":36", "\"byteLength\":35", "is shorter than what is read"),
        ("\"byteLength\":36", "\"byteLength\":36,\"byteStride\":252", "is shorter than what is read"),
        ("\"byteLength\":48", "\"byteLength\":49", "has only 48"),
        ("\"children\":[1,2]", "\"children\":[1,0]", "two parents or is in a cycle"),
        ("\"children\":[1,2]", "\"children\":[1,1]", "two parents or is in a cycle"),
        ("\"children\":[1,2]", "\"children\":[1,7]", "is malformed"),
        ("\"children\":[1,2]", "\"children\":[]", "no triangle"),
        ("\"nodes\":[0]", "\"nodes\":[9]", "is malformed"),
        ("\"scene\":0", "\"scene\":5", "is malformed"),
        ("5126", "5123", "wrong type"),
        (
            "\"mesh\":0,",
            "\"mesh\":0,\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"SCALE\":1}}},",
            "wrong type",
        ),
        ("5123", "5126", "wrong type"),
        ("5123", "9999", "is malformed"),
        ("\"VEC3\"", "\"MAT4\"", "wrong type"),
        ("\"indices\":1", "\"indices\":1,\"mode\":1", "no triangle"),
        ("\"indices\":1", "\"indices\":1,\"mode\":77", "is malformed"),
        ("\"POSITION\":0", "\"NORMAL\":0", "[\"POSITION\"]: Missing data; write"),
        ("\"POSITION\":0", "\"POSITION\":2", "an accessor that is not there"),
        ("\"scale\":[2,2,2]", "\"scale\":[2e9,2e9,2e9]", "beyond 1e6"),
        ("data:application/octet-stream;base64,", "data:application/octet-stream;base64,%", "is malformed"),
        ("data:application/octet-stream;base64,", "https://example.org/", "not beside it"),
        ("data:application/octet-stream;base64,", "/", "not beside it"),
        ("data:application/octet-stream;base64,", "no/such/", "refers to a file that cannot be read"),
        ("\"version\":\"2.0\"", "\"version\":\"2.0\"}}", "is malformed"),
    ] {
        assert!(good.contains(from), "{from} is in the document");
        let bad = good.replacen(from, to, 1);
        match load(folder.path(), &[("m.gltf", bad.as_bytes())]) {
            Ok(mesh) => panic!("{to} gives {mesh:?}"),
            Err(e) => {
                assert!(e.to_string().contains(fragment), "{to} says {e}");
                assert!(e.to_string().contains("scene.toml:4:33: the mesh \"m.gltf\" "), "{to} says {e}");
            }
        }
    }
    // Odd, and no reason to refuse: vertices that overlap in memory, a node that flattens its mesh to a point.
    for (from, to, triangles) in [
        ("\"byteLength\":36", "\"byteLength\":36,\"byteStride\":4", 4),
        ("\"scale\":[2,2,2]", "\"matrix\":[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0]", 2),
    ] {
        let odd = good.replacen(from, to, 1);
        let mesh = load(folder.path(), &[("m.gltf", odd.as_bytes())]).unwrap_or_else(|e| panic!("{to}: {e}"));
        assert_eq!(mesh.triangles.len(), triangles, "{to}");
    }
    let glb = glb();
    for length in 0..glb.len() {
        load(folder.path(), &[("m.glb", &glb[..length])]).expect_err("half a file");
    }
    for said in [0u32, 1, 11, 12, 13, u32::MAX] {
        let mut bad = glb.clone();
        bad[8..12].copy_from_slice(&said.to_le_bytes());
        let _whatever_it_is_it_does_not_panic = load(folder.path(), &[("m.glb", &bad)]);
    }
}

#[test]
fn sparse_accessors_strips_and_fans() {
    let folder = folder();
    let mut bytes = buffer();
    // One sparse change: vertex 1 moves to (5, 0, 0).
    bytes.extend([1u8, 0, 0, 0]);
    bytes.extend([5f32, 0.0, 0.0].iter().flat_map(|f| f.to_le_bytes()));
    let data = base64::engine::general_purpose::STANDARD.encode(&bytes);
    let sparse = r#""count":3,"sparse":{"count":1,"indices":{"bufferView":2,"byteOffset":0,"componentType":5121},"values":{"bufferView":3,"byteOffset":0}}"#;
    let text = document(&format!(r#","uri":"data:;base64,{data}""#))
        .replace("\"count\":3", sparse)
        .replace("\"byteLength\":48", "\"byteLength\":64")
        .replace("\"byteOffset\":36,\"byteLength\":12}", "\"byteOffset\":36,\"byteLength\":12},{\"buffer\":0,\"byteOffset\":48,\"byteLength\":1},{\"buffer\":0,\"byteOffset\":52,\"byteLength\":12}");
    let mesh = load(folder.path(), &[("s.gltf", text.as_bytes())]).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(mesh.positions[1], DVec3::new(20.0, 0.0, 0.0), "10 + 2 · 5");
    let at = bytes.len() - 16;
    bytes[at] = 9;
    let beyond = base64::engine::general_purpose::STANDARD.encode(&bytes);
    let beyond = text.replace(&data, &beyond);
    assert_ne!(beyond, text, "the index is another");
    load(folder.path(), &[("s.gltf", beyond.as_bytes())]).expect_err("element 9 of 3");
    // 0 1 2 2 1 0 as a strip: 012, 212, 221, 201 (every other one turned), of which two have an area. As a fan: 012, 022, 021, 010.
    for (mode, triangles) in [(5, [[0, 1, 2], [2, 0, 1]]), (6, [[0, 1, 2], [0, 2, 1]])] {
        let text = embedded().replace("\"indices\":1", &format!("\"indices\":1,\"mode\":{mode}"));
        let mesh = load(folder.path(), &[("f.gltf", text.as_bytes())]).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(mesh.triangles[..2], triangles, "mode {mode}");
    }
}

#[test]
fn a_mirrored_node_keeps_its_front() {
    let folder = folder();
    let normal = |text: &str| {
        let mesh = load(folder.path(), &[("m.gltf", text.as_bytes())]).unwrap_or_else(|e| panic!("{e}"));
        let [a, b, c] = mesh.triangles[0].map(|i| mesh.positions[i as usize]);
        (b - a).cross(c - a)
    };
    // The triangle lies in z = 0 and looks along +Z.
    assert_eq!(normal(&embedded()), DVec3::Z * 4.0, "as it is");
    assert_eq!(normal(&embedded().replace("[2,2,2]", "[2,2,-2]")), DVec3::NEG_Z * 4.0, "seen from behind");
    assert_eq!(normal(&embedded().replace("[2,2,2]", "[-2,2,2]")), DVec3::Z * 4.0, "seen from the front");
}

#[test]
fn required_extensions_are_refused_unless_they_change_no_triangle() {
    let folder = folder();
    let load = |name: &str| {
        let head = format!(r#"{{"extensionsUsed":["{name}"],"extensionsRequired":["{name}"],"asset""#);
        let text = embedded().replacen("{\"asset\"", &head, 1);
        load(folder.path(), &[("e.gltf", text.as_bytes())])
    };
    for name in ["KHR_materials_unlit", "KHR_texture_transform", "KHR_texture_basisu", "KHR_lights_punctual"]
    {
        load(name).unwrap_or_else(|e| panic!("{e}"));
    }
    for name in ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization2"] {
        let error = load(name).expect_err(name).to_string();
        assert!(error.contains(&format!("requires the extension \"{name}\"")), "{error}");
    }
}

#[test]
fn only_regular_files_are_read() {
    let folder = folder();
    std::fs::create_dir(folder.path().join("d.obj")).expect("a folder");
    let text = "camera.eye = [0, 2, 9]\n[[object]]\nname = 'm'\nshape = { type = 'mesh', path = 'd.obj' }";
    let error = Scene::parse(text, &folder.path().join("s.toml")).expect_err("a folder is no mesh");
    assert!(error.to_string().contains("not a regular file"), "{error}");
}

#[test]
fn a_long_path_keeps_the_file_s_name() {
    let deep = format!("{}meshes/", "a folder of some name/".repeat(9));
    let text = |file: &str| {
        format!(
            "camera.eye = [0, 2, 9]\n[[object]]\nname = 'm'\nshape = {{ type = 'mesh', path = '{deep}{file}' }}"
        )
    };
    for (file, fragment) in
        [("missing.obj", "cannot be read from "), ("missing.stl", "has the extension \"stl\"")]
    {
        let error = Scene::parse(&text(file), "s.toml".as_ref()).expect_err("no such file").to_string();
        assert!(error.contains(fragment) && error.contains(&format!("/meshes/{file}\" ")), "{error}");
        assert!(error.len() < 400, "and is not shown whole: {error}");
    }
    let error = Scene::parse(&text("missing.obj"), "s.toml".as_ref()).expect_err("no such file").to_string();
    assert_eq!(
        error.matches("/meshes/missing.obj").count(),
        2,
        "as it was written and as it was looked for: {error}"
    );
}

/// Mutated mesh files give a mesh or an error. `ANTUMBRA_FUZZ_CASES` sets how many, a hundred of it to
/// one input: each is written to a file first.
#[test]
fn mutated_meshes() {
    let folder = folder();
    let cases = std::env::var("ANTUMBRA_FUZZ_CASES").ok().and_then(|n| n.parse::<u32>().ok());
    let cases = cases.map_or(1_500, |n| n / 100);
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    let obj = format!("{TETRAHEDRON}vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3//1\ng x\nf -1 -2 -3 -4\n");
    let instanced = embedded().replacen(
        "\"mesh\":0",
        r#""mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0,"SCALE":0}}}"#,
        1,
    );
    let seeds = [
        ("m.obj", obj.into_bytes()),
        ("m.gltf", embedded().into_bytes()),
        ("m.gltf", instanced.into_bytes()),
        ("m.glb", glb()),
    ];
    let edit = (
        any::<prop::sample::Index>(),
        prop_oneof![any::<u8>(), prop::sample::select(b"0123456789-/., []{}\":e".as_slice())],
    );
    let inputs = (0..seeds.len(), proptest::collection::vec(edit, 1..5));
    let start = std::time::Instant::now();
    TestRunner::new(config)
        .run(&inputs, |(seed, edits)| {
            let (name, mut bytes) = seeds[seed].clone();
            for (at, byte) in edits {
                let at = at.index(bytes.len());
                bytes[at] = byte;
            }
            if let Err(e) = load(folder.path(), &[(name, &bytes)]) {
                prop_assert!(!e.to_string().contains('\n'), "{} is more than one line", e);
            }
            Ok(())
        })
        .unwrap_or_else(|e| panic!("{e}"));
    println!("mutated meshes: {cases} inputs in {:.1?}", start.elapsed());
}
