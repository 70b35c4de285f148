//! A file that a person wrote changes where the scene does, and nowhere else.

#[expect(dead_code, reason = "of what tests share only the scene is needed")]
mod common;
#[path = "common/random.rs"]
mod random;

use std::path::Path;

use antumbra_scene::{LightKind, Motion, Part, Pose, Scene, Shape};
use glam::DVec3;

const FILE: &str = r#"# A scene by hand.
# It has a lamp and a sun.

ambient = [0, 0.10, 0]   # a little green

[camera]  # where we stand
  eye = [0, 6, 12]
  up = [0, 2, 0]         # of any length
fov_y = 45

# The lamp over the table.
[[light]]
type = 'point'
name = 'lamp'            # its file's name
position = [4, 8.0, 0]
intensity = 1_20         # candela
motion = { type = "orbit", center = [0, 8, 0], axis = [0, 5, 0], period = 8 }  # slowly

# The sun.
[[light]]
name = "sun"
type = "directional"
direction = [1, -2, 0.5]
intensity = 3

# What it stands on.
[[object]]
name = "floor"
color = [0.8, 0.8, 0.8]  # the default, said aloud
[object.shape]
type = "plane"           # without end

# A tree of parts.
[[object]]
name = "tree"
rotation = [0, 1, 0, 1]
parts = [
  # the crown
  { shape = { type = "cone", radius = 0.50, height = 1 }, translation = [0, 1.5, 0] },
  # the trunk
  { shape = { type = "cylinder", radius = 0.1, height = 1 } }, # straight
]

[[object]]               # the ball
name = "ball"
shape.type = "sphere"
shape.radius = 1
# the end
"#;

fn read(text: &str) -> Scene {
    Scene::parse(text, Path::new("hand.toml")).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// The file after a change, which says what it should.
#[track_caller]
fn changed(original: &str, change: impl FnOnce(&mut Scene)) -> String {
    let mut scene = read(original);
    change(&mut scene);
    let text = scene.update_toml(original);
    assert_eq!(format!("{:?}", read(&text)), format!("{scene:?}"), "{text}");
    text
}

/// The change gives the file with these pieces of it replaced, each once.
#[track_caller]
fn assert_only(change: impl FnOnce(&mut Scene), pieces: &[(&str, &str)]) {
    let mut expected = FILE.to_owned();
    for (old, new) in pieces {
        assert!(expected.contains(old), "no {old:?} in the file");
        expected = expected.replacen(old, new, 1);
    }
    let text = changed(FILE, change);
    assert_eq!(text, expected, "\n{text}\nshould be\n{expected}");
}

#[test]
fn values_change_in_their_place() {
    assert_only(|_| {}, &[]);
    assert_only(|s| s.ambient.y = 0.25, &[("0.10, 0]   #", "0.25, 0]   #")]);
    assert_only(|s| s.ambient.y = 0.125, &[("0.10, 0]   #", "0.125, 0]  #")]);
    assert_only(|s| s.camera.eye.z = 10.5, &[("[0, 6, 12]", "[0, 6, 10.5]")]);
    assert_only(|s| s.camera.up = DVec3::Z, &[("[0, 2, 0]         #", "[0, 0.0, 1.0]     #")]);
    assert_only(|s| s.camera.fov_y = f64::to_radians(30.0), &[("fov_y = 45", "fov_y = 30.0")]);
    assert_only(|s| s.lights[0].intensity = 60.0, &[("1_20         #", "60.0         #")]);
    assert_only(
        |s| s.lights[0].name = "it's".to_owned(),
        &[("'lamp'            #", "\"it's\"            #")],
    );
    assert_only(|s| s.objects[0].color = DVec3::splat(0.5), &[("[0.8, 0.8, 0.8]  #", "[0.5, 0.5, 0.5]  #")]);
    assert_only(
        |s| s.objects[2].parts[0].shape = Shape::Sphere { radius: 2.5 },
        &[("radius = 1\n#", "radius = 2.5\n#")],
    );
    let cone = Shape::Cone { radius: 0.5, height: 2.0 };
    assert_only(|s| s.objects[1].parts[0].shape = cone, &[("0.50, height = 1 }", "0.50, height = 2.0 }")]);
    let orbit = |period| Motion::Orbit { center: DVec3::Y * 8.0, axis: DVec3::Y, period };
    assert_only(|s| s.lights[0].motion = Some(orbit(-3.0)), &[("period = 8 }  #", "period = -3.0 } #")]);
}

#[test]
fn keys_come_and_go() {
    assert_only(
        |s| s.objects[1].pose.translation.x = 2.0,
        &[("# straight\n]\n", "# straight\n]\ntranslation = [2.0, 0.0, 0.0]\n")],
    );
    assert_only(
        |s| s.lights[0].motion = None,
        &[(
            "motion = { type = \"orbit\", center = [0, 8, 0], axis = [0, 5, 0], period = 8 }  # slowly\n",
            "",
        )],
    );
    assert_only(
        |s| s.objects[1].parts[1].pose.translation.y = 0.5,
        &[("height = 1 } }, #", "height = 1 }, translation = [0.0, 0.5, 0.0] }, #")],
    );
    assert_only(
        |s| s.objects[1].parts[0].pose = Pose { translation: DVec3::ZERO, ..s.objects[1].parts[0].pose },
        &[("translation = [0, 1.5, 0]", "translation = [0, 0.0, 0]")],
    );
    assert_only(|s| s.image.width = 320, &[("fov_y = 45\n", "fov_y = 45\n\n[image]\nwidth = 320\n")]);
    let frustum = Shape::Cylinder { radius: 0.1, height: 1.0, radius_top: 0.05 };
    assert_only(
        |s| s.objects[1].parts[1].shape = frustum,
        &[("radius = 0.1, height = 1 }", "radius = 0.1, height = 1, radius_top = 0.05 }")],
    );
    let spot =
        LightKind::Spot { direction: DVec3::NEG_Y, inner_angle: 0.0, outer_angle: f64::to_radians(30.0) };
    assert_only(
        |s| s.lights[0].kind = spot,
        &[
            ("type = 'point'", "type = \"spot\""),
            ("# slowly\n", "# slowly\ndirection = [0.0, -1.0, 0.0]\nouter_angle = 30.0\n"),
        ],
    );
}

#[test]
fn parts_come_and_go() {
    assert_only(
        |s| drop(s.objects[1].parts.remove(0)),
        &[(
            "  # the crown\n  { shape = { type = \"cone\", radius = 0.50, height = 1 }, translation = [0, 1.5, 0] },\n",
            "",
        )],
    );
    let ball = Part { shape: Shape::Sphere { radius: 0.25 }, pose: Pose::IDENTITY };
    assert_only(
        |s| s.objects[1].parts.push(ball.clone()),
        &[("# straight\n]", "# straight\n  { shape = { type = \"sphere\", radius = 0.25 } },\n]")],
    );
    assert_only(
        |s| s.objects[1].parts.insert(0, ball.clone()),
        &[("parts = [\n", "parts = [\n  { shape = { type = \"sphere\", radius = 0.25 } },\n")],
    );
    let two = [ball.clone(), ball.clone()];
    let new = "  { shape = { type = \"sphere\", radius = 0.25 } },\n";
    assert_only(
        |s| s.objects[1].parts.extend(two),
        &[("# straight\n]", &format!("# straight\n{new}{new}]"))],
    );
    let crown =
        &FILE[FILE.find("  # the crown").expect("a crown")..FILE.find("  # the trunk").expect("a trunk")];
    let trunk = &FILE
        [FILE.find("  # the trunk").expect("a trunk")..FILE.find("]\n\n[[object]]     ").expect("an end")];
    let swapped = format!("{trunk}{crown}");
    assert_only(|s| s.objects[1].parts.reverse(), &[(&format!("{crown}{trunk}"), &swapped)]);
    let text = changed(FILE, |s| s.objects[2].parts.push(ball));
    assert!(text.contains("[[object]]               # the ball\nname = \"ball\"\nparts = [\n"), "{text}");
    let short = "camera = { eye = [0, 2, 5] }\nobject = [{ name = 'o', parts = [{ shape = { type = 'disc', radius = 1 } }, # a disc\n{ shape = { type = 'plane' } }] }]";
    let text = changed(short, |s| s.objects[0].parts.reverse());
    assert!(text.contains("radius = 1 } } # a disc\n]"), "{text}");
    let text = changed(FILE, |s| s.objects[1].parts.truncate(1));
    assert!(text.contains("# the crown\n  { shape"), "{text}");
}

#[test]
fn lights_and_objects_come_and_go() {
    let lamp = &FILE[FILE.find("# The lamp").expect("a lamp")..FILE.find("# The sun.").expect("a sun")];
    let sun = &FILE[FILE.find("# The sun.").expect("a sun")..FILE.find("# What it").expect("a floor")];
    let tree = &FILE
        [FILE.find("# A tree").expect("a tree")..FILE.find("[[object]]               #").expect("a ball")];
    assert_only(|s| drop(s.lights.remove(0)), &[(lamp, "")]);
    assert_only(|s| drop(s.lights.remove(1)), &[(sun, "")]);
    assert_only(|s| drop(s.objects.remove(1)), &[(tree, "")]);
    assert_only(|s| s.lights.clear(), &[(lamp, ""), (sun, "")]);
    assert_only(
        |s| {
            let moon = antumbra_scene::Light { name: "moon".to_owned(), ..s.lights[1].clone() };
            s.lights.push(moon);
            s.lights[2].kind = LightKind::Directional { direction: DVec3::NEG_Y };
        },
        &[(
            "\n# What it stands on.",
            "\n[[light]]\nname = \"moon\"\ntype = \"directional\"\ndirection = [0.0, -1.0, 0.0]\nintensity = 3.0\n\n# What it stands on.",
        )],
    );
    // A new one in the middle, and one that was renamed and changed a little.
    let text = changed(FILE, |s| {
        let mut ball = s.objects[2].clone();
        ball.name = "second".to_owned();
        s.objects.insert(1, ball);
        s.lights[0].name = "lamp 2".to_owned();
        s.lights[0].intensity = 1.0;
    });
    let order = [
        "# The lamp",
        "name = \"lamp 2\"",
        "# its file's name",
        "# The sun",
        "# without end",
        "\"second\"",
        "# A tree",
        "# the ball",
        "# the end",
    ];
    let places: Vec<Option<usize>> = order.iter().map(|piece| text.find(piece)).collect();
    assert!(places.iter().all(Option::is_some) && places.is_sorted(), "{places:?} in\n{text}");
}

#[test]
fn what_is_moved_takes_its_comments_along() {
    let text = changed(FILE, |s| {
        s.objects.reverse();
        s.lights.swap(0, 1);
    });
    let order = [
        "# A scene by hand",
        "# where we stand",
        "# The sun",
        "\"sun\"",
        "# The lamp",
        "'lamp'",
        "# slowly",
        "# the ball",
        "\"ball\"",
        "# A tree",
        "# the crown",
        "# What it stands on",
        "\"floor\"",
        "# without end",
        "# the end",
    ];
    let places: Vec<Option<usize>> = order.iter().map(|piece| text.find(piece)).collect();
    assert!(places.iter().all(Option::is_some) && places.is_sorted(), "{places:?} in\n{text}");
}

#[test]
fn every_way_to_write_tables_can_be_changed() {
    for file in [
        // All in braces.
        "# it\nlight = [{ name = \"a\", type = \"point\", position = [0, 1, 0], intensity = 1 }] # one\ncamera = { eye = [0, 2, 5] } # here\nobject = [ { name = \"o\", shape = { type = \"plane\" } } ]\n",
        // All in dots.
        "# it\ncamera.eye = [0, 2, 5] # here\n[[light]] # one\nname = \"a\"\ntype = \"point\"\nposition = [0, 1, 0]\nintensity = 1\n[[object]]\nname = \"o\"\nshape.type = \"plane\"\n",
        // The camera last, parts as tables.
        "# it\n[[object]]\nname = \"o\"\n[[object.parts]]\n[object.parts.shape]\ntype = \"plane\"\n[[light]] # one\nname = \"a\"\ntype = \"point\"\nposition = [0, 1, 0]\nintensity = 1\n[camera] # here\neye = [0, 2, 5]\n",
        // Over several lines, and nothing listed.
        "# it\nlight = []\n[camera] # here\neye = [ # one\n  0,\n  2,\n  5, # metres\n]\n",
    ] {
        for file in [file.to_owned(), file.replace('\n', "\r\n"), format!("\u{feff}{file}")] {
            let text = changed(&file, |s| {
                s.camera.eye.y = 3.0;
                s.image.height = 100;
                s.ambient = DVec3::splat(0.5);
                let all = read(common::EVERYTHING);
                for light in &mut s.lights {
                    light.motion.clone_from(&all.lights[0].motion);
                }
                for object in &mut s.objects {
                    object.casts_shadow = false;
                    object.parts[0].pose.translation.y = -1.0;
                }
                s.lights.extend(all.lights);
                let end = s.objects.len();
                s.objects.extend(all.objects);
                s.objects.swap(0, end);
            });
            for comment in ["# it", "# here", "# one"] {
                assert!(text.contains(comment), "no {comment:?} in\n{text}");
            }
            assert_eq!(
                text.matches('\n').count() == text.matches("\r\n").count(),
                file.contains('\r'),
                "{text:?}"
            );
            assert_eq!(text.starts_with('\u{feff}'), file.starts_with('\u{feff}'), "{text:?}");
        }
    }
}

#[test]
fn what_cannot_be_read_is_written_anew_under_its_first_comment() {
    let scene = read(FILE);
    for broken in
        ["# Mine.\n# Really.\n\nambient = [", "# Mine.\n# Really.", "# Mine.\n# Really.\n[camera]\neye = 1\n"]
    {
        assert_eq!(scene.update_toml(broken), format!("# Mine.\n# Really.\n{}", scene.to_toml()), "{broken}");
    }
    assert_eq!(scene.update_toml(""), scene.to_toml(), "nothing to keep");
    assert_eq!(scene.update_toml("\0"), scene.to_toml(), "nothing to keep");
}

#[test]
fn random_changes_keep_what_they_do_not_touch() {
    let mut random = fastrand::Rng::with_seed(6);
    let (mut changes, mut comments) = (0, 0);
    for _ in 0..3000 {
        let (one, other) = (random::scene(&mut random), random::scene(&mut random));
        let (Ok(before), Ok(mut after)) =
            (Scene::parse(&one, Path::new("one.toml")), Scene::parse(&other, Path::new("other.toml")))
        else {
            continue;
        };
        // Whatever the two are, the one file becomes the other scene.
        let text = after.update_toml(&one);
        assert_eq!(format!("{:?}", read(&text)), format!("{after:?}"), "{one}\nbecame\n{text}");
        // Some of the one among the other, in any order: the comments come along.
        let kept = random.usize(..=before.objects.len());
        for object in &mut after.objects {
            object.name += " of the other";
        }
        after.objects.extend_from_slice(&before.objects[before.objects.len() - kept..]);
        random.shuffle(&mut after.objects);
        let text = after.update_toml(&one);
        assert_eq!(format!("{:?}", read(&text)), format!("{after:?}"), "{one}\nbecame\n{text}");
        for i in before.objects.len() - kept..before.objects.len() {
            let comment = format!("# about object {i}\n[[object]]\n");
            assert!(text.contains(&comment), "no {comment:?}:\n{one}\nbecame\n{text}");
            comments += 1;
        }
        assert!(text.starts_with("# A random scene.\n") && text.contains("[camera] # the eye\n"), "{text}");
        changes += 1;
    }
    assert!(changes > 1000 && comments > 2000, "{changes} changes with {comments} comments");
}
