//! The file, the camera, the image, names and limits on numbers of things.

use std::path::Path;

use antumbra_scene::{Scene, limits};

use crate::check::{CAMERA, check, check_after_camera, error};

#[test]
fn syntax() {
    check(&[
        ("camera = {", 1, 11, &["not valid TOML", "toml.io"]),
        ("a = 1\na = 2\n", 2, 1, &["not valid TOML: duplicate key"]),
        ("[camera]\neye = [0, 6 12]\n", 2, 11, &["not valid TOML"]),
        ("[camera]\neye = \"\n", 2, 8, &["not valid TOML"]),
        ("a.b.c.d.e.f.g.h.i.j = 1", 1, 18, &["more than 8 dots", "camera.eye"]),
        (&format!("a = {}", "[".repeat(500)), 1, 85, &["not valid TOML"]),
        ("\u{feff}x = 1", 1, 1, &["unknown key \"x\""]),
    ]);
    let at = |bytes: &[u8]| Scene::from_bytes(bytes, Path::new("s.toml")).expect_err("no scene").to_string();
    assert!(
        at(b"# ab\n# \xff\n").starts_with("s.toml:2:3: the byte 0xFF is not UTF-8; "),
        "{}",
        at(b"# ab\n# \xff\n")
    );
    let long = "#".repeat(limits::MAX_SCENE_BYTES + 1);
    assert!(error(&long).1.contains("more than 2097152 bytes"), "a file may be too long");
}

#[test]
fn unreadable_files() {
    let error = Scene::load(Path::new("/no/such/scene.toml")).expect_err("no file");
    assert_eq!(error.place(), None, "{error} has no place");
    assert!(error.to_string().starts_with("/no/such/scene.toml: the scene file cannot be read"), "{error}");
    let error = Scene::load(Path::new("/")).expect_err("a folder");
    assert!(error.to_string().contains("cannot be read"), "{error}");
}

#[test]
fn the_scene() {
    check(&[
        ("", 1, 1, &["the scene lacks the key \"camera\"", "[camera]"]),
        ("ambient = [0, 0, 0]\n", 1, 1, &["lacks the key \"camera\""]),
        ("camera = 3", 1, 10, &["\"camera\" of the scene must be a table, but is an integer"]),
        (
            "ambiant = [0, 0, 0]\n",
            1,
            1,
            &["unknown key \"ambiant\"", "did you mean \"ambient\"?", "\"camera\", \"image\""],
        ),
        ("zzz = 1\naaa = 2\n", 1, 1, &["unknown key \"zzz\" in the scene", "the keys of the scene are"]),
        ("[[lights]]\n", 1, 3, &["unknown key \"lights\"", "write [[light]] before each light"]),
        ("eye = [1, 2, 3]", 1, 1, &["\"eye\" belongs to the camera", "put it under [camera]"]),
        ("width = 3", 1, 1, &["\"width\" belongs to the image", "[image]"]),
        (
            &format!("ambient = [0, -0.1, 0]\n{CAMERA}"),
            1,
            15,
            &["entry 2 of \"ambient\" of the scene is -0.1", "from 0 to 1e9"],
        ),
        (
            &format!("ambient = 0.1\n{CAMERA}"),
            1,
            11,
            &["an array of 3 numbers, but is a number", "[0.05, 0.05, 0.05]"],
        ),
        (&format!("ambient = [nan, 0, 0]\n{CAMERA}"), 1, 12, &["nan, which is not a finite number"]),
        (
            &format!("{CAMERA}[light]\nname = \"a\"\n"),
            3,
            1,
            &["\"light\" of the scene must be an array, but is a table", "double brackets"],
        ),
        (&format!("light = [3]\n{CAMERA}"), 1, 10, &["must be a table, but is an integer"]),
    ]);
}

#[test]
fn the_camera() {
    check(&[
        ("[camera]\n", 1, 1, &["the camera lacks the key \"eye\"", "eye = [0.0, 6.0, 12.0]"]),
        ("camera = { target = [0, 0, 0] }", 1, 10, &["the camera lacks the key \"eye\""]),
        ("camera.eye = [1, 2]", 1, 14, &["must have 3 numbers, but has 2"]),
        ("[camera]\neye = [1, 2, 3, 4]", 2, 7, &["must have 3 numbers, but has 4"]),
        (
            "[camera]\neye = [1, \"2\", 3]",
            2,
            11,
            &["entry 2 of \"eye\" of the camera must be a number, but is a string"],
        ),
        ("[camera]\neye = [1, inf, 3]", 2, 11, &["inf, which is not a finite number"]),
        ("[camera]\neye = [1, 1e999, 3]", 2, 11, &["not a finite number"]),
        ("[camera]\neye = [1, 1e7, 3]", 2, 11, &["is 1e7, which is not from -1e6 to 1e6"]),
        (
            "[camera]\neye = [1, 99999999999999999999999999999999999999999, 3]",
            2,
            11,
            &["which is not a finite number"],
        ),
        (
            "[camera]\neye = [1, 2, 3]\nfov = 30",
            3,
            1,
            &["unknown key \"fov\" in the camera", "\"eye\", \"target\", \"up\" and \"fov_y\""],
        ),
        ("[camera]\neye = [1, 2, 3]\nfov_y = 0", 3, 9, &["is 0, which is not from 0.01 to 179", "degrees"]),
        ("[camera]\neye = [1, 2, 3]\nfov_y = 180", 3, 9, &["is 180, which is not from 0.01 to 179"]),
        ("[camera]\neye = [1, 2, 3]\nfov_y = -nan", 3, 9, &["not a finite number"]),
        ("[camera]\neye = [0, 0, 0]", 2, 7, &["\"eye\" and \"target\" are the same point"]),
        ("[camera]\neye = [1, 2, 3]\ntarget = [1, 2, 3.0000001]", 3, 10, &["the same point"]),
        (
            "[camera]\neye = [0, 6, 0]",
            1,
            1,
            &["\"up\" is parallel to its line of sight", "up = [0.0, 0.0, -1.0]"],
        ),
        ("[camera]\neye = [3, 0, 0]\nup = [-2, 0, 0]", 3, 6, &["\"up\" is parallel"]),
        ("[camera]\neye = [3, 0, 0]\nup = [0, 0, 0]", 3, 6, &["\"up\" of the camera has no length"]),
        ("[camera]\neye = 1979-05-27", 2, 7, &["but is a date"]),
    ]);
}

#[test]
fn the_image() {
    check_after_camera(
        "[image]\n",
        &[
            (
                "width = 0",
                1,
                9,
                &["\"width\" of the image is 0, which is not from 1 to 16384", "width = 960"],
            ),
            ("height = 16385", 1, 10, &["is 16385, which is not from 1 to 16384"]),
            ("height = -1", 1, 10, &["is -1, which is not from 1 to 16384"]),
            ("width = 960.0", 1, 9, &["must be a whole number, but is a number with a fraction"]),
            ("width = 0xffffffffffffffff", 1, 9, &["which is not from 1 to 16384"]),
            ("exposure = 0", 1, 12, &["is 0, which is not from 1e-9 to 1e9"]),
            ("exposure = true", 1, 12, &["must be a number, but is a boolean"]),
            ("background = [0, 0, -1]", 1, 21, &["entry 3 of \"background\" of the image is -1"]),
            ("size = [3, 4]", 1, 1, &["unknown key \"size\" in the image"]),
        ],
    );
}

#[test]
fn names() {
    let light = |name: &str| {
        format!("[[light]]\nname = {name}\ntype = \"point\"\nposition = [0, 1, 0]\nintensity = 1\n")
    };
    for (name, fragment) in [
        ("\"\"", "is empty"),
        ("\"  \"", "is empty"),
        ("\".\"", "means a folder"),
        ("\"..\"", "means a folder"),
        ("\"a/b\"", "holds the character /"),
        (r"'a\b'", "holds the character \\"),
        ("\"a:b\"", "holds the character :"),
        (r#""a\u0000b""#, "holds the control character"),
        (r#""a\nb""#, "holds the control character"),
        ("\"a.\"", "begins or ends"),
        ("\" a\"", "begins or ends"),
        (&format!("\"{}\"", "x".repeat(129)), "has 129 bytes, more than 128"),
        (&format!("\"{}\"", "ä".repeat(65)), "has 130 bytes, more than 128"),
        ("3", "must be a string, but is an integer"),
    ] {
        check(&[(&format!("{CAMERA}{}", light(name)), 4, 8, &[fragment])]);
    }
    check(&[
        (
            &format!("{CAMERA}{}{}", light("\"Key\""), light("\"kEY\"")),
            9,
            8,
            &["the light name \"kEY\" is used already, on line 4", "ignoring case"],
        ),
        (&format!("{CAMERA}[[light]]\n"), 3, 1, &["lacks the key \"name\"", "name = \"key\""]),
        (
            &format!("{CAMERA}[[object]]\nshape = {{ type = \"plane\" }}"),
            3,
            1,
            &["this object lacks the key \"name\""],
        ),
        (
            &format!(
                "{CAMERA}[[object]]\nname = \"a\"\nshape = {{ type = \"plane\" }}\n[[object]]\nname = \"a\"\n"
            ),
            7,
            8,
            &["the object name \"a\" is used already, on line 4"],
        ),
        (&format!("{CAMERA}[[object]]\nname = \"\"\n"), 4, 8, &["is empty"]),
    ]);
}

#[test]
fn too_many() {
    let light = |i| format!("[[light]]\nname=\"{i}\"\ntype=\"point\"\nposition=[0,1,0]\nintensity=1\n");
    let lights: String = (0..=limits::MAX_LIGHTS).map(light).collect();
    let line = 3 + 5 * limits::MAX_LIGHTS;
    check(&[(&format!("{CAMERA}{lights}"), line, 1, &["more than 4096 lights"])]);
    let object = |i| format!("[[object]]\nname=\"{i}\"\nshape.type=\"plane\"\n");
    let objects: String = (0..=limits::MAX_OBJECTS).map(object).collect();
    let line = 3 + 3 * limits::MAX_OBJECTS;
    check(&[(&format!("{CAMERA}{objects}"), line, 1, &["more than 16384 objects"])]);
    let parts = "{shape={type=\"plane\"}},".repeat(limits::MAX_PARTS + 1);
    check(&[(
        &format!("{CAMERA}[[object]]\nname=\"a\"\nparts=[{parts}]"),
        5,
        7,
        &["more than 65536 parts in all objects"],
    )]);
    let points = "[0,1,0],".repeat(limits::MAX_PATH_POINTS + 1);
    check(&[(
        &format!(
            "{CAMERA}[[object]]\nname=\"a\"\nshape.type=\"plane\"\nmotion={{type=\"path\",period=1,points=[{points}]}}"
        ),
        6,
        37,
        &["has 4097 points"],
    )]);
}
