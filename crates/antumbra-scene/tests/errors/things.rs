//! Lights, objects, parts, shapes and motions.

use crate::check::{CAMERA, check, check_after_camera};

#[test]
fn lights() {
    check(&[
        (
            &format!("{CAMERA}[[light]]\nname = \"key\"\n"),
            3,
            1,
            &["light \"key\" lacks the key \"type\"", "type = \"point\""],
        ),
        (
            &format!("{CAMERA}[[light]]\nname = \"key\"\ntype = \"point\"\nintensity = 1\n"),
            3,
            1,
            &["light \"key\" lacks the key \"position\"", "position = ["],
        ),
        (
            &format!("{CAMERA}[[light]]\nname = \"key\"\ntype = \"point\"\nposition = [0, 1, 0]\n"),
            3,
            1,
            &["light \"key\" lacks the key \"intensity\"", "candela"],
        ),
        (
            &format!("{CAMERA}[[light]]\nname = \"key\"\ntype = \"directional\"\ndirection = [0, -1, 0]\n"),
            3,
            1,
            &["lacks the key \"intensity\"", "lux"],
        ),
    ]);
    check_after_camera(
        "[[light]]\nname = \"key\"\n",
        &[
            (
                "type = \"area\"",
                1,
                8,
                &[
                    "\"type\" of light \"key\" is \"area\", which is unknown",
                    "\"point\", \"directional\", \"spot\", \"sphere\", \"disc\" or \"rectangle\"",
                ],
            ),
            ("type = \"Point\"", 1, 8, &["did you mean \"point\"?"]),
            ("type = 1", 1, 8, &["must be a string"]),
        ],
    );
    check_after_camera(
        "[[light]]\nname = \"key\"\ntype = \"point\"\nintensity = 1\nposition = [0, 1, 0]\n",
        &[
            (
                "radius = 0.5",
                1,
                1,
                &["\"radius\" is no key of a point light", "type = \"sphere\" or \"disc\""],
            ),
            (
                "direction = [0, 1, 0]",
                1,
                1,
                &[
                    "\"direction\" is no key of a point light",
                    "\"directional\", \"spot\", \"disc\" or \"rectangle\"",
                ],
            ),
            (
                "colour = [1, 1, 1]",
                1,
                1,
                &["unknown key \"colour\" in light \"key\"", "did you mean \"color\"?"],
            ),
            (
                "color = [1, -1, 1]",
                1,
                13,
                &["entry 2 of \"color\" of light \"key\" is -1, which is not from 0 to 1000"],
            ),
            ("color = \"red\"", 1, 9, &["but is a string"]),
            ("translation = [0, 1, 0]", 1, 1, &["unknown key \"translation\""]),
        ],
    );
    check_after_camera(
        "[[light]]\nname = \"key\"\ntype = \"point\"\nposition = [0, 1, 0]\n",
        &[
            ("intensity = -1", 1, 13, &["is -1, which is not from 0 to 1e9"]),
            ("intensity = 1e10", 1, 13, &["is 1e10, which is not from 0 to 1e9"]),
            ("intensity = nan", 1, 13, &["not a finite number"]),
            ("intensity = [1]", 1, 13, &["must be a number, but is an array"]),
        ],
    );
    check_after_camera(
        "[[light]]\nname = \"sun\"\ntype = \"directional\"\nintensity = 1\n",
        &[
            ("direction = [0, 0, 0]", 1, 13, &["\"direction\" of light \"sun\" has no length"]),
            ("direction = [0, 1e-7, 0]", 1, 13, &["has no length"]),
            (
                "position = [0, 1, 0]",
                1,
                1,
                &["\"position\" is no key of a directional light", "infinitely far away"],
            ),
            ("motion = { type = \"orbit\" }", 1, 1, &["\"motion\" is no key of a directional light"]),
        ],
    );
}

#[test]
fn spots_and_area_lights() {
    check_after_camera(
        "[[light]]\nname = \"s\"\ntype = \"spot\"\nintensity = 1\nposition = [0, 1, 0]\ndirection = [0, -1, 0]\n",
        &[
            (
                "inner_angle = 30\nouter_angle = 20",
                1,
                15,
                &[
                    "\"inner_angle\" of light \"s\" is 30, which is not below its \"outer_angle\" of 20",
                    "half-angles in degrees",
                ],
            ),
            ("outer_angle = 30\ninner_angle = 30", 2, 15, &["is 30, which is not below"]),
            ("inner_angle = 45", 1, 15, &["which is not below its \"outer_angle\" of 45"]),
            ("outer_angle = 91", 1, 15, &["is 91, which is not from 0.01 to 90"]),
            ("outer_angle = 0", 1, 15, &["is 0, which is not from 0.01 to 90"]),
            ("inner_angle = -1", 1, 15, &["is -1, which is not from 0 to 90"]),
            ("angle = 30", 1, 1, &["unknown key \"angle\""]),
        ],
    );
    for (kind, extra) in [("sphere", ""), ("disc", "direction = [0, -1, 0]\n")] {
        let head = format!(
            "[[light]]\nname = \"s\"\ntype = \"{kind}\"\nintensity = 1\nposition = [0, 1, 0]\n{extra}"
        );
        check_after_camera(
            &head,
            &[
                ("radius = 0", 1, 10, &["\"radius\" of light \"s\" is 0, but a length is above zero"]),
                ("radius = -2.5", 1, 10, &["is -2.5, but a length is above zero"]),
                ("radius = 1e-7", 1, 10, &["is 1e-7, which is not from 1e-6 to 1e6"]),
                ("radius = 2e6", 1, 10, &["is 2e6, which is not from 1e-6 to 1e6"]),
                ("radius = 1\nwidth = 2", 2, 1, &["\"width\" is no key of a", "type = \"rectangle\""]),
            ],
        );
        check(&[(&format!("{CAMERA}{head}"), 3, 1, &["lacks the key \"radius\"", "radius = 0.5"])]);
    }
    let head = "[[light]]\nname = \"w\"\ntype = \"rectangle\"\nintensity = 1\nposition = [0, 1, 0]\ndirection = [0, -1, 0]\n";
    check_after_camera(
        head,
        &[
            (
                "right = [0, 2, 0]\nwidth = 1\nheight = 1",
                1,
                9,
                &["\"right\" of light \"w\" is parallel to its \"direction\""],
            ),
            ("right = [0, 0, 0]\nwidth = 1\nheight = 1", 1, 9, &["has no length"]),
            ("right = [1, 0, 0]\nwidth = 0\nheight = 1", 2, 9, &["a length is above zero"]),
            ("right = [1, 0, 0]\nwidth = 1\nheight = inf", 3, 10, &["not a finite number"]),
        ],
    );
    check(&[
        (&format!("{CAMERA}{head}"), 3, 1, &["lacks the key \"right\""]),
        (&format!("{CAMERA}{head}right = [1, 0, 0]\nheight = 1\n"), 3, 1, &["lacks the key \"width\""]),
        (&format!("{CAMERA}{head}right = [1, 0, 0]\nwidth = 1\n"), 3, 1, &["lacks the key \"height\""]),
    ]);
}

#[test]
fn objects_and_parts() {
    check(&[(
        &format!("{CAMERA}[[object]]\nname = \"o\"\n"),
        3,
        1,
        &["object \"o\" has neither \"shape\" nor \"parts\""],
    )]);
    let part = "{ shape = { type = \"sphere\", radius = 1 } }";
    check_after_camera(
        "[[object]]\nname = \"o\"\n",
        &[
            (
                &format!("shape = {{ type = \"plane\" }}\nparts = [{part}]"),
                2,
                1,
                &["has both \"shape\" and \"parts\""],
            ),
            ("parts = []", 1, 9, &["\"parts\" of object \"o\" is empty"]),
            ("parts = 3", 1, 9, &["must be an array"]),
            ("parts = [3]", 1, 10, &["must be a table"]),
            ("parts = [{ }]", 1, 10, &["part 1 of object \"o\" lacks the key \"shape\""]),
            (
                &format!("parts = [{part}, {{ shape = {{ type = \"plane\" }}, color = [1, 1, 1] }}]"),
                1,
                85,
                &["\"color\" is no key of a part", "in the object"],
            ),
            (
                &format!("parts = [{part}, {{ shap = 3 }}]"),
                1,
                57,
                &["unknown key \"shap\" in part 2 of object \"o\"", "did you mean \"shape\"?"],
            ),
            ("shape = \"sphere\"", 1, 9, &["must be a table, but is a string", "shape = { type = "]),
            ("shape = { radius = 1 }", 1, 9, &["lacks the key \"type\""]),
            ("radius = 1", 1, 1, &["\"radius\" is no key of object \"o\", but one of its shape"]),
            ("position = [0, 1, 0]", 1, 1, &["unknown key \"position\"", "translation = "]),
            ("cast_shadow = true", 1, 1, &["did you mean \"casts_shadow\"?"]),
        ],
    );
    check_after_camera(
        "[[object]]\nname = \"o\"\nshape = { type = \"plane\" }\n",
        &[
            (
                "rotation = [0, 0, 0, 0]",
                1,
                12,
                &["\"rotation\" of object \"o\" is zero", "[0.0, 0.0, 0.0, 1.0]"],
            ),
            ("rotation = [0, 0, 1e-7, 0]", 1, 12, &["is zero"]),
            ("rotation = [0, 0, 1]", 1, 12, &["must have 4 numbers, but has 3"]),
            ("rotation = [0, 0, nan, 1]", 1, 19, &["not a finite number"]),
            ("color = [1.2, 0, 0]", 1, 10, &["is 1.2, which is not from 0 to 1", "albedo"]),
            ("casts_shadow = 1", 1, 16, &["must be a boolean, but is an integer", "true or false"]),
            ("receives_shadow = \"yes\"", 1, 19, &["must be a boolean, but is a string"]),
            ("translation = [0, -1e7, 0]", 1, 19, &["is -1e7, which is not from -1e6 to 1e6"]),
        ],
    );
}

#[test]
fn shapes() {
    let head = "[[object]]\nname = \"o\"\n";
    for (shape, column, fragments) in [
        (
            "{ type = \"ball\" }",
            18,
            &["is \"ball\", which is unknown", "\"plane\", \"rectangle\", \"disc\"", "or \"mesh\""][..],
        ),
        ("{ type = \"spere\", radius = 1 }", 18, &["did you mean \"sphere\"?"]),
        ("{ type = \"sphere\" }", 9, &["lacks the key \"radius\"", "radius = 0.5"]),
        (
            "{ type = \"sphere\", radius = 0 }",
            37,
            &["\"radius\" of \"shape\" of object \"o\" is 0, but a length is above zero"],
        ),
        ("{ type = \"sphere\", radius = \"1\" }", 37, &["must be a number, but is a string"]),
        (
            "{ type = \"sphere\", radius = 1, height = 2 }",
            40,
            &[
                "\"height\" is no key of a sphere",
                "\"height\" belongs to the type \"cone\", \"cylinder\" or \"capsule\"",
            ],
        ),
        ("{ type = \"sphere\", radus = 1 }", 28, &["unknown key \"radus\"", "did you mean \"radius\"?"]),
        (
            "{ type = \"sphere\", radius = 1, translation = [0, 0, 0] }",
            40,
            &["\"translation\" is no key of a sphere", "beside \"shape\""],
        ),
        (
            "{ type = \"plane\", width = 1 }",
            27,
            &["\"width\" is no key of a plane", "a plane has no keys but \"type\"", "\"rectangle\""],
        ),
        ("{ type = \"rectangle\", width = 1 }", 9, &["lacks the key \"depth\""]),
        ("{ type = \"rectangle\", width = 1, depth = -1 }", 50, &["a length is above zero"]),
        ("{ type = \"disc\", radius = inf }", 35, &["not a finite number"]),
        ("{ type = \"triangle\" }", 9, &["lacks the key \"vertices\""]),
        (
            "{ type = \"triangle\", vertices = [[0, 0, 0], [1, 0, 0]] }",
            41,
            &["has 2 entries, but a triangle has 3"],
        ),
        (
            "{ type = \"triangle\", vertices = [[0, 0, 0], [1, 0, 0], [0, 0]] }",
            64,
            &["must have 3 numbers, but has 2"],
        ),
        ("{ type = \"triangle\", vertices = [[0, 0, 0], [1, 1, 1], [3, 3, 3]] }", 41, &["lie on one line"]),
        ("{ type = \"triangle\", vertices = [[1, 2, 3], [1, 2, 3], [3, 3, 3]] }", 41, &["lie on one line"]),
        ("{ type = \"triangle\", vertices = [[1, 2, 3], [1, 2, 3], [1, 2, 3]] }", 41, &["are one point"]),
        (
            "{ type = \"ellipsoid\", radii = [1, 0, 1] }",
            43,
            &["entry 2 of \"radii\"", "a length is above zero"],
        ),
        ("{ type = \"ellipsoid\", radius = 1 }", 31, &["\"radius\" is no key of an ellipsoid"]),
        ("{ type = \"ellipsoid\" }", 9, &["lacks the key \"radii\""]),
        ("{ type = \"cone\", radius = 1 }", 9, &["lacks the key \"height\""]),
        ("{ type = \"cone\", radius = 1, height = 0.0 }", 47, &["a length is above zero"]),
        (
            "{ type = \"cylinder\", radius = 1, height = 1, radius_top = 0 }",
            67,
            &["a length is above zero", "\"cone\""],
        ),
        ("{ type = \"capsule\", radius = 1, height = 0 }", 50, &["a length is above zero", "\"sphere\""]),
        ("{ type = \"box\", size = [1, 2, -3] }", 39, &["entry 3 of \"size\"", "a length is above zero"]),
        ("{ type = \"box\", size = 1 }", 32, &["an array of 3 numbers"]),
        ("{ type = \"torus\", major_radius = 1 }", 9, &["lacks the key \"minor_radius\""]),
        (
            "{ type = \"torus\", major_radius = 1, minor_radius = 1.5 }",
            60,
            &["is 1.5, which is above its \"major_radius\" of 1"],
        ),
        ("{ type = \"mesh\" }", 9, &["lacks the key \"path\"", ".obj, .gltf or .glb"]),
        ("{ type = \"mesh\", path = \"a.stl\" }", 33, &["the mesh \"a.stl\" has the extension \"stl\""]),
        ("{ type = \"mesh\", path = \"\" }", 33, &["has the extension \"\""]),
        (
            "{ type = \"mesh\", path = \"no such.obj\" }",
            33,
            &["the mesh \"no such.obj\" cannot be read", "relative to the scene file"],
        ),
        ("{ type = \"mesh\", path = 3 }", 33, &["must be a string"]),
    ] {
        check_after_camera(head, &[(&format!("shape = {shape}"), 1, column, fragments)]);
    }
}

#[test]
fn motions() {
    let head = "[[object]]\nname = \"o\"\nshape = { type = \"plane\" }\n";
    for (motion, column, fragments) in [
        ("3", 10, &["\"motion\" of object \"o\" must be a table", "motion = { type = \"orbit\""][..]),
        ("{ }", 10, &["lacks the key \"type\""]),
        ("{ type = \"spin\" }", 19, &["is \"spin\", which is unknown", "\"orbit\" or \"path\""]),
        ("{ type = \"orbit\", axis = [0, 1, 0], period = 1 }", 10, &["lacks the key \"center\""]),
        ("{ type = \"orbit\", center = [0, 1, 0], period = 1 }", 10, &["lacks the key \"axis\""]),
        ("{ type = \"orbit\", center = [0, 1, 0], axis = [0, 1, 0] }", 10, &["lacks the key \"period\""]),
        ("{ type = \"orbit\", center = [0, 1, 0], axis = [0, 0, 0], period = 1 }", 55, &["has no length"]),
        (
            "{ type = \"orbit\", center = [0, 1, 0], axis = [0, 1, 0], period = 0 }",
            75,
            &["is 0, which is below 0.001 in size", "negative"],
        ),
        (
            "{ type = \"orbit\", center = [0, 1, 0], axis = [0, 1, 0], period = 1e10 }",
            75,
            &["is 1e10, which is not from -1e9 to 1e9"],
        ),
        ("{ type = \"orbit\", points = [] }", 28, &["\"points\" is no key of an orbit", "type = \"path\""]),
        ("{ type = \"path\", period = 1 }", 10, &["lacks the key \"points\""]),
        (
            "{ type = \"path\", points = [[0, 0, 0]], period = 1 }",
            36,
            &["has 1 points, but a path has from 2"],
        ),
        ("{ type = \"path\", points = [[0, 0, 0], [0, 1]], period = 1 }", 48, &["must have 3 numbers"]),
        (
            "{ type = \"path\", points = [[0, 0, 0], [0, 1, 0]], period = -1 }",
            69,
            &["is -1, which is below 0.001"],
        ),
        ("{ type = \"path\", points = [[0, 0, 0], [0, 1, 0]] }", 10, &["lacks the key \"period\""]),
        ("{ type = \"path\", axis = [0, 1, 0] }", 27, &["\"axis\" is no key of a path", "type = \"orbit\""]),
    ] {
        check_after_camera(head, &[(&format!("motion = {motion}"), 1, column, fragments)]);
    }
}
