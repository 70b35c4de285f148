//! What glTF files say in more than one way: versions, integers for positions, instances.

use std::fmt::Write;

use antumbra_scene::{Scene, Shape};
use base64::Engine;
use glam::DVec3;

/// A glTF file with one triangle, out of parts.
struct File {
    bytes: Vec<u8>,
    views: Vec<String>,
    accessors: Vec<String>,
    nodes: String,
    /// Between the braces, before all else.
    head: String,
}

/// Of the types of components.
const I8: u32 = 5120;
const U8: u32 = 5121;
const I16: u32 = 5122;
const U16: u32 = 5123;
const F32: u32 = 5126;

/// Bytes of numbers as a file has them.
fn floats(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|n| n.to_le_bytes()).collect()
}

impl File {
    /// The triangle's positions are the first accessor; a node has its mesh.
    fn new(positions: &[u8], component: u32, more: &str) -> Self {
        let nodes = r#"{"mesh":0}"#.to_owned();
        let (bytes, views, accessors) = (Vec::new(), Vec::new(), Vec::new());
        let mut file = Self { bytes, views, accessors, nodes, head: String::new() };
        file.add(positions, component, 3, "VEC3", more);
        file
    }

    /// The triangle with the corners 0, X and Y.
    fn plain() -> Self {
        Self::new(&floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]), F32, "")
    }

    /// An accessor of `count` elements, which lie one after the other; returns its index.
    fn add(&mut self, bytes: &[u8], component: u32, count: usize, kind: &str, more: &str) -> usize {
        let (at, length) = (self.bytes.len(), bytes.len());
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let (view, stride) = (self.views.len(), length / count);
        let stride = if component == F32 { String::new() } else { format!(r#","byteStride":{stride}"#) };
        self.views.push(format!(r#"{{"buffer":0,"byteOffset":{at},"byteLength":{length}{stride}}}"#));
        self.accessors.push(format!(
            r#"{{"bufferView":{view},"componentType":{component},"count":{count},"type":"{kind}"{more}}}"#
        ));
        self.accessors.len() - 1
    }

    /// The node with instances by these attributes, moved by 10 along X, and a child without.
    fn instanced(&mut self, attributes: &str) {
        self.nodes.clear();
        let _ = write!(
            self.nodes,
            r#"{{"mesh":0,"translation":[10,0,0],"children":[1],"extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{{{attributes}}}}}}}}},{{"mesh":0,"translation":[0,0,7]}}"#
        );
    }

    fn text(&self) -> String {
        let data = base64::engine::general_purpose::STANDARD.encode(&self.bytes);
        format!(
            r#"{{{}"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],"accessors":[{}],"bufferViews":[{}],
"buffers":[{{"byteLength":{},"uri":"data:;base64,{data}"}}]}}"#,
            self.head,
            self.nodes,
            self.accessors.join(","),
            self.views.join(","),
            self.bytes.len()
        )
    }

    fn corners(&self) -> Result<Vec<[DVec3; 3]>, String> {
        corners("m.gltf", self.text().as_bytes())
    }
}

/// The corners of the triangles in a mesh file, or what is wrong with it.
fn corners(name: &str, bytes: &[u8]) -> Result<Vec<[DVec3; 3]>, String> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join(name), bytes).expect("a temporary file");
    let shape = format!("{{ type = 'mesh', path = '{name}' }}");
    let text = format!("camera.eye = [0, 2, 9]\n[[object]]\nname = 'm'\nshape = {shape}");
    let scene = Scene::parse(&text, &folder.path().join("scene.toml")).map_err(|error| error.to_string())?;
    match &scene.objects[0].parts[0].shape {
        Shape::Mesh(mesh) => {
            Ok(mesh.triangles.iter().map(|t| t.map(|i| mesh.positions[i as usize])).collect())
        }
        other => panic!("{other:?} is no mesh"),
    }
}

/// `corners` are those of triangles like 0, X, Y at these places, each by its corner, its first and its second side.
fn assert_placed(corners: &[[DVec3; 3]], places: &[[DVec3; 3]]) {
    assert_eq!(corners.len(), places.len(), "triangles: {corners:?}");
    for (corners, [at, x, y]) in corners.iter().zip(places) {
        for (is, expected) in corners.iter().zip([*at, *at + *x, *at + *y]) {
            // float32, and integers of 15 bits for rotations.
            assert!((*is - expected).length() < 1e-4, "{corners:?} is not {at} {x} {y}");
        }
    }
}

#[test]
fn version_one_is_named() {
    let one =
        r#"{"asset":{"version":"1.0"},"meshes":{"m":{"primitives":[]}},"nodes":{"n":{"meshes":["m"]}}}"#;
    let unnamed = one.replace(r#""asset":{"version":"1.0"},"#, "");
    let binary = b"glTF\x01\0\0\0\x20\0\0\0\x0c\0\0\0\0\0\0\0{\"asset\":{}} ".to_vec();
    let marked = format!("\u{feff}{one}");
    for (name, bytes) in [
        ("a.gltf", one.as_bytes()),
        ("b.gltf", unnamed.as_bytes()),
        ("c.glb", &binary),
        ("d.gltf", marked.as_bytes()),
    ] {
        let error = corners(name, bytes).expect_err(name);
        let expected = "is glTF 1.0, and only 2.0 is read; convert it to 2.0";
        assert!(error.contains(expected), "{name}: {error}");
    }
    for broken in ["{\"meshes\":7}", "{\"asset\":{\"version\":\"2.0\"},\"meshes\":{}}", "{"] {
        let error = corners("e.gltf", broken.as_bytes()).expect_err(broken);
        assert!(error.contains("is malformed"), "{broken}: {error}");
    }
}

#[test]
fn a_byte_order_mark_is_passed_over() {
    let marked = format!("\u{feff}{}", File::plain().text());
    let corners = corners("m.gltf", marked.as_bytes()).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(corners, [[DVec3::ZERO, DVec3::X, DVec3::Y]]);
}

#[test]
fn positions_need_no_bounds() {
    let bounds = r#","min":[0,0,0],"max":[1,1,0]"#;
    for more in ["", bounds, r#","min":[0],"max":"much""#] {
        let mut file = File::plain();
        file.accessors[0] = file.accessors[0].replacen('}', &format!("{more}}}"), 1);
        assert_eq!(file.corners().unwrap_or_else(|e| panic!("{more}: {e}")).len(), 1, "{more}");
    }
}

#[test]
fn positions_may_be_integers() {
    // Corners 0, X and -Y times the greatest of the type, or as near to it as the type has.
    let i16s: Vec<u8> =
        [0, 0, 0, 0, i16::MAX, 0, 0, 0, 0, i16::MIN, 0, 0].iter().flat_map(|n| n.to_le_bytes()).collect();
    let u16s: Vec<u8> =
        [0, 0, 0, 0, u16::MAX, 0, 0, 0, 0, 1, 0, 0].iter().flat_map(|n| n.to_le_bytes()).collect();
    let i8s = [0, 0, 0, 0, 127, 0, 0, 0, 0, 128, 0, 0];
    let u8s = [0, 0, 0, 0, 255, 0, 0, 0, 0, 1, 0, 0];
    for (component, bytes, x, y, greatest) in [
        (I8, &i8s[..], 127.0, -128.0, 127.0),
        (U8, &u8s, 255.0, 1.0, 255.0),
        (I16, &i16s, 32767.0, -32768.0, 32767.0),
        (U16, &u16s, 65535.0, 1.0, 65535.0),
    ] {
        for normalized in [false, true] {
            let mut file = File::new(bytes, component, &format!(r#","normalized":{normalized}"#));
            let error = file.corners().expect_err("integers without the extension");
            assert!(error.contains("wrong type"), "{error}");
            let scale = if normalized { greatest } else { 1.0 };
            // The least of a signed type is as far as its greatest.
            let expected = [
                DVec3::ZERO,
                DVec3::X * x / scale,
                DVec3::Y * f64::max(y / scale, if normalized { -1.0 } else { y }),
            ];
            for list in ["Required", "Used"] {
                file.head = format!(r#""extensions{list}":["KHR_mesh_quantization"],"#);
                assert_eq!(file.corners(), Ok(vec![expected]), "{component}, normalized: {normalized}");
            }
        }
    }
}

#[test]
fn instances_are_copies() {
    let mut file = File::plain();
    let translation = file.add(&floats(&[0.0, 1.0, 0.0, 0.0, 2.0, 0.0]), F32, 2, "VEC3", "");
    let scale = file.add(&floats(&[3.0, 3.0, 3.0, 1.0, 1.0, -1.0]), F32, 2, "VEC3", "");
    // Not turned, and a quarter about Z: as floats, and as integers.
    let half = core::f32::consts::FRAC_1_SQRT_2;
    let turns = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, half, half];
    let shorts: Vec<u8> = turns.iter().flat_map(|t| ((t * 32767.0).round() as i16).to_le_bytes()).collect();
    let bytes: Vec<u8> = turns.iter().map(|t| (t * 127.0).round() as i8 as u8).collect();
    let rotations = [
        file.add(&floats(&turns), F32, 2, "VEC4", ""),
        file.add(&shorts, I16, 2, "VEC4", r#","normalized":true"#),
        file.add(&bytes, I8, 2, "VEC4", r#","normalized":true"#),
    ];
    let (x, y) = (DVec3::X, DVec3::Y);
    let node = x * 10.0;
    let child = [node + DVec3::Z * 7.0, x, y];
    file.instanced(&format!(r#""TRANSLATION":{translation}"#));
    assert_placed(&file.corners().expect("translations"), &[[node + y, x, y], [node + y * 2.0, x, y], child]);
    for rotation in rotations {
        file.instanced(&format!(r#""ROTATION":{rotation},"_ID":0"#));
        assert_placed(&file.corners().expect("rotations"), &[[node, x, y], [node, y, -x], child]);
    }
    file.instanced(&format!(r#""TRANSLATION":{translation},"ROTATION":{},"SCALE":{scale}"#, rotations[0]));
    // The second is mirrored, so its corners come in the other order.
    let all = [[node + y, x * 3.0, y * 3.0], [node + y * 2.0, -x, y], child];
    assert_placed(&file.corners().expect("all"), &all);
    file.head =
        r#""extensionsUsed":["EXT_mesh_gpu_instancing"],"extensionsRequired":["EXT_mesh_gpu_instancing"],"#
            .into();
    assert_placed(&file.corners().expect("required"), &all);
    for none in [r#""_ID":0"#, ""] {
        file.instanced(none);
        assert_placed(&file.corners().expect("no place"), &[[node, x, y], child]);
    }
}

#[test]
fn impossible_instances_are_errors() {
    let mut file = File::plain();
    let two = file.add(&floats(&[0.0; 6]), F32, 2, "VEC3", "");
    let three = file.add(&floats(&[1.0; 9]), F32, 3, "VEC3", "");
    let far = file.add(&floats(&[f32::MAX, f32::NAN, 0.0]), F32, 1, "VEC3", "");
    let shorts = file.add(&[0; 24], I16, 3, "VEC4", "");
    let many = file.accessors.len();
    for count in [10_000_000u64, 4_000_000_000, u64::MAX] {
        // Zeros where nothing is replaced.
        let sparse = r#""sparse":{"count":0,"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}}"#;
        file.accessors.push(format!(r#"{{"componentType":{F32},"count":{count},"type":"VEC3",{sparse}}}"#));
    }
    for (attributes, fragment) in [
        (format!(r#""TRANSLATION":{two},"SCALE":{three}"#), "attributes of different number"),
        (format!(r#""TRANSLATION":{shorts}"#), "wrong type"),
        (format!(r#""ROTATION":{three}"#), "wrong type"),
        (format!(r#""TRANSLATION":{far}"#), "not finite"),
        (format!(r#""TRANSLATION":{many}"#), "too large"),
        (format!(r#""SCALE":{}"#, many + 1), "too large"),
        (format!(r#""TRANSLATION":{}"#, many + 2), "too large"),
        (r#""TRANSLATION":99"#.into(), "there is no accessor 99"),
        (r#""TRANSLATION":"0""#.into(), "no accessor"),
        (r#""TRANSLATION":-1"#.into(), "no accessor"),
    ] {
        file.instanced(&attributes);
        let error = file.corners().expect_err(&attributes);
        assert!(error.contains(fragment), "{attributes}: {error}");
    }
}
