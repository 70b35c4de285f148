//! Random scene files that use all of the format, written in many ways.

use fastrand::Rng;

/// Names that are hard to write: quotes, dots, other alphabets, what looks like TOML.
const NAMES: [&str; 14] = [
    "lamp",
    "a.b.c",
    "it's",
    "#1",
    "[x]",
    "a = 1",
    "ä ö",
    "灯",
    "🌲 tree",
    "'''",
    "x'y",
    "{}",
    "e\u{301}",
    "true",
];

/// A scene file. The same numbers give the same file; nearly all are scenes.
pub(crate) fn scene(random: &mut Rng) -> String {
    let mut text = String::from("# A random scene.\n");
    if random.bool() {
        text += &format!("ambient = {}\n", list(random, 3, share));
    }
    text += &format!("\n[camera] # the eye\neye = {}\n", list(random, 3, coordinate));
    text += &maybe(random, "target", |r| list(r, 3, coordinate));
    text += &maybe(random, "up", direction);
    text += &maybe(random, "fov_y", |r| angle(r, 0.01, 179.0));
    if random.bool() {
        text += "\n[image]\n";
        text += &maybe(random, "width", |r| r.u32(1..=16384).to_string());
        text += &maybe(random, "height", |r| r.u32(1..=16384).to_string());
        text += &maybe(random, "background", |r| list(r, 3, share));
        text += &maybe(random, "exposure", length);
    }
    for i in 0..random.usize(0..7) {
        text += &light(random, i);
    }
    for i in 0..random.usize(0..7) {
        text += &object(random, i);
    }
    text
}

fn light(random: &mut Rng, index: usize) -> String {
    let kind =
        random.choice(["point", "directional", "spot", "sphere", "disc", "rectangle"]).unwrap_or("point");
    let mut text =
        format!("\n# about light {index}\n[[light]]\nname = {}\ntype = \"{kind}\"\n", name(random, index));
    let mut add = |key: &str, value: String| text += &format!("{key} = {value}\n");
    if kind != "directional" {
        add("position", list(random, 3, coordinate));
        if random.bool() {
            add("motion", motion(random));
        }
    }
    if !matches!(kind, "point" | "sphere") {
        add("direction", direction(random));
    }
    match kind {
        "spot" => {
            let outer = random.f64() * 89.0 + 1.0;
            if random.bool() {
                add("inner_angle", angle(random, 0.0, outer.min(44.0)));
            }
            if random.bool() {
                add("outer_angle", format!("{outer:?}"));
            }
        }
        "sphere" | "disc" => add("radius", length(random)),
        "rectangle" => {
            add("right", direction(random));
            add("width", length(random));
            add("height", length(random));
        }
        _ => {}
    }
    if random.bool() {
        add("color", list(random, 3, share));
    }
    add("intensity", share(random));
    text
}

fn object(random: &mut Rng, index: usize) -> String {
    let mut text = format!("\n# about object {index}\n[[object]]\nname = {}\n", name(random, index));
    if random.bool() {
        text += &format!("shape = {} # its shape\n", shape(random));
    } else {
        text += "parts = [\n";
        for part in 0..random.usize(1..5) {
            text += &format!("  # part {part}\n  {{ shape = {}", shape(random));
            if random.bool() {
                text += &format!(", translation = {}", list(random, 3, coordinate));
            }
            if random.bool() {
                text += &format!(", rotation = {}", list(random, 4, coordinate));
            }
            text += " },\n";
        }
        text += "]\n";
    }
    text += &maybe(random, "translation", |r| list(r, 3, coordinate));
    text += &maybe(random, "rotation", |r| list(r, 4, coordinate));
    text += &maybe(random, "color", |r| list(r, 3, |r| format!("{:?}", r.f64())));
    text += &maybe(random, "casts_shadow", |r| r.bool().to_string());
    text += &maybe(random, "receives_shadow", |r| r.bool().to_string());
    text += &maybe(random, "motion", motion);
    text
}

fn shape(random: &mut Rng) -> String {
    let kinds: [(&str, &[&str]); 7] = [
        ("plane", &[]),
        ("rectangle", &["width", "depth"]),
        ("disc", &["radius"]),
        ("sphere", &["radius"]),
        ("cone", &["radius", "height"]),
        ("cylinder", &["radius", "height", "radius_top"]),
        ("capsule", &["radius", "height"]),
    ];
    match random.usize(0..12) {
        7 => format!("{{ type = \"ellipsoid\", radii = {} }}", list(random, 3, length)),
        8 => format!("{{ type = \"box\", size = {} }}", list(random, 3, length)),
        9 => {
            let corners = [0, 1, 2].map(|_| list(random, 3, coordinate)).join(", ");
            format!("{{ type = \"triangle\", vertices = [{corners}] }}")
        }
        10 => format!("{{ type = \"torus\", major_radius = 2e3, minor_radius = {:?} }}", 0.1 + random.f64()),
        11 => "{ type = \"cylinder\", radius = 2, height = 1.50 }".to_owned(),
        simple => {
            let (kind, keys) = kinds[simple];
            let keys: String = keys.iter().map(|key| format!(", {key} = {}", length(random))).collect();
            format!("{{ type = \"{kind}\"{keys} }}")
        }
    }
}

fn motion(random: &mut Rng) -> String {
    let period = format!("{:?}", 1e-3 + random.f64() * 10f64.powi(random.i32(-2..9)));
    if random.bool() {
        let (center, sign) = (list(random, 3, coordinate), if random.bool() { "-" } else { "" });
        let axis = direction(random);
        format!("{{ type = \"orbit\", center = {center}, axis = {axis}, period = {sign}{period} }}")
    } else {
        let points: Vec<String> = (0..random.usize(2..12)).map(|_| list(random, 3, coordinate)).collect();
        format!("{{ type = \"path\", points = [{}], period = {period} }}", points.join(", "))
    }
}

fn name(random: &mut Rng, index: usize) -> String {
    let name = format!("{} {index}", random.choice(NAMES).unwrap_or_default());
    if name.contains('\'') { format!("\"{name}\"") } else { format!("'{name}'") }
}

fn maybe(random: &mut Rng, key: &str, value: impl Fn(&mut Rng) -> String) -> String {
    if random.bool() { format!("{key} = {}\n", value(random)) } else { String::new() }
}

fn list(random: &mut Rng, count: usize, number: impl Fn(&mut Rng) -> String) -> String {
    let numbers: Vec<String> = (0..count).map(|_| number(random)).collect();
    format!("[{}]", numbers.join(", "))
}

fn angle(random: &mut Rng, low: f64, high: f64) -> String {
    let angle = low + (high - low) * random.f64();
    // Some as people write them.
    if random.bool() { format!("{:.1}", angle.max(0.1)) } else { format!("{angle:?}") }
}

/// From 1e-6 to 1e6.
fn length(random: &mut Rng) -> String {
    let length = 10f64.powf(random.f64() * 11.9 - 5.95);
    match random.u8(0..4) {
        0 => "1e-6".to_owned(),
        1 => random.u32(1..1000).to_string(),
        _ => format!("{length:e}"),
    }
}

/// From 0 to 1000.
fn share(random: &mut Rng) -> String {
    match random.u8(0..6) {
        0 => "0".to_owned(),
        1 => "-0.0".to_owned(),
        2 => "5e-324".to_owned(),
        3 => "1_000.0".to_owned(),
        _ => format!("{:?}", random.f64()),
    }
}

/// Within 1e6, of any size.
fn coordinate(random: &mut Rng) -> String {
    match random.u8(0..12) {
        0 => "-0.0".to_owned(),
        1 => "0x10".to_owned(),
        2 => "1e6".to_owned(),
        3 => "+1.50".to_owned(),
        4 => format!("{:e}", (random.f64() - 0.5) * 10f64.powi(random.i32(-320..6))),
        5 => random.i32(-20..20).to_string(),
        _ => format!("{:?}", (random.f64() - 0.5) * 20.0),
    }
}

/// Any length but zero.
fn direction(random: &mut Rng) -> String {
    match random.u8(0..4) {
        0 => "[0, -1, 0]".to_owned(),
        1 => format!("[1, {:e}, 0.0]", random.f64() * 1e-5),
        _ => list(random, 3, |r| format!("{:?}", (r.f64() - 0.5) * 10f64.powi(r.i32(-3..6)))),
    }
}
