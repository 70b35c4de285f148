//! A scene as the tables, lists and values of its file: what writing and comparing files go by.

use core::hash::{Hash, Hasher};

use glam::{DQuat, DVec3};

use crate::degrees::degrees;
use crate::unit::{perpendicular, unit, unit_rotation};
use crate::{Camera, Image, Light, LightKind, Motion, Object, Part, Pose, Scene, Shape};

/// A value of a scene file. Equal if files that hold them give the same scene to the bit.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Node {
    Number(Number),
    Integer(u32),
    Flag(bool),
    Text(String),
    List(Vec<Node>),
    Table(Vec<Entry>),
}

/// A key of a table, with its value.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Entry {
    pub(crate) key: &'static str,
    pub(crate) value: Node,
    /// Whether a file that leaves the key out says the same.
    pub(crate) default: bool,
}

/// A number that differs from another one if any bit does.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Number(pub(crate) f64);

impl PartialEq for Number {
    fn eq(&self, other: &Self) -> bool {
        self.0.to_bits() == other.0.to_bits()
    }
}

impl Eq for Number {}

impl Hash for Number {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.to_bits().hash(state);
    }
}

impl Node {
    /// The entries of a table; none of anything else.
    pub(crate) fn entries(&self) -> &[Entry] {
        match self {
            Self::Table(entries) => entries,
            _ => &[],
        }
    }

    /// The values of a list; none of anything else.
    pub(crate) fn values(&self) -> &[Node] {
        match self {
            Self::List(values) => values,
            _ => &[],
        }
    }

    /// What the table says of its name, if it has one.
    pub(crate) fn name(&self) -> Option<&str> {
        match self.entries().iter().find(|e| e.key == "name").map(|e| &e.value) {
            Some(Self::Text(name)) => Some(name),
            _ => None,
        }
    }
}

/// The file of a scene; every mesh path goes through `path`. Keys are in the format's order, those with
/// a default among them.
pub(crate) fn scene(scene: &Scene, path: &dyn Fn(&str) -> String) -> Node {
    let list = |nodes: Vec<Node>| (nodes.is_empty(), Node::List(nodes));
    let image = image(&scene.image);
    let (no_lights, lights) = list(scene.lights.iter().map(light).collect());
    let (no_objects, objects) = list(scene.objects.iter().map(|o| object(o, path)).collect());
    Node::Table(vec![
        optional("ambient", vector(scene.ambient), &vector(DVec3::ZERO)),
        required("camera", camera(&scene.camera)),
        Entry { default: image.entries().iter().all(|e| e.default), key: "image", value: image },
        Entry { key: "light", value: lights, default: no_lights },
        Entry { key: "object", value: objects, default: no_objects },
    ])
}

fn camera(camera: &Camera) -> Node {
    Node::Table(vec![
        required("eye", vector(camera.eye)),
        optional("target", vector(camera.target), &vector(DVec3::ZERO)),
        optional("up", vector(unit(camera.up)), &vector(DVec3::Y)),
        optional("fov_y", number(degrees(camera.fov_y)), &number(45.0)),
    ])
}

fn image(image: &Image) -> Node {
    let usual = Image::default();
    Node::Table(vec![
        optional("width", Node::Integer(image.width), &Node::Integer(usual.width)),
        optional("height", Node::Integer(image.height), &Node::Integer(usual.height)),
        optional("background", vector(image.background), &vector(usual.background)),
        optional("exposure", number(image.exposure), &number(usual.exposure)),
    ])
}

fn light(light: &Light) -> Node {
    let position = || required("position", vector(light.position));
    let toward = |direction: DVec3| required("direction", vector(unit(direction)));
    let length = |key: &'static str, length: f64| required(key, number(length));
    let own = match light.kind {
        LightKind::Point => vec![position()],
        LightKind::Directional { direction } => vec![toward(direction)],
        LightKind::Spot { direction, inner_angle, outer_angle } => {
            let inner = optional("inner_angle", number(degrees(inner_angle)), &number(0.0));
            let outer = optional("outer_angle", number(degrees(outer_angle)), &number(45.0));
            vec![position(), toward(direction), inner, outer]
        }
        LightKind::Sphere { radius } => vec![position(), length("radius", radius)],
        LightKind::Disc { direction, radius } => {
            vec![position(), toward(direction), length("radius", radius)]
        }
        LightKind::Rectangle { direction, right, width, height } => {
            let right = required("right", vector(perpendicular(right, unit(direction))));
            let (width, height) = (length("width", width), length("height", height));
            vec![position(), toward(direction), right, width, height]
        }
    };
    let mut entries =
        vec![required("name", text(&light.name)), required("type", text(light.kind.type_name()))];
    entries.extend(own);
    entries.push(optional("color", vector(light.color), &vector(DVec3::ONE)));
    entries.push(required("intensity", number(light.intensity)));
    if !matches!(light.kind, LightKind::Directional { .. }) {
        entries.extend(light.motion.as_ref().map(motion));
    }
    Node::Table(entries)
}

fn object(object: &Object, path: &dyn Fn(&str) -> String) -> Node {
    let what = match object.parts.as_slice() {
        [one] if pose(&one.pose).iter().all(|e| e.default) => required("shape", shape(&one.shape, path)),
        parts => required("parts", Node::List(parts.iter().map(|p| part(p, path)).collect())),
    };
    let mut entries = vec![required("name", text(&object.name)), what];
    entries.extend(pose(&object.pose));
    entries.push(optional("color", vector(object.color), &vector(DVec3::splat(0.8))));
    entries.push(optional("casts_shadow", Node::Flag(object.casts_shadow), &Node::Flag(true)));
    entries.push(optional("receives_shadow", Node::Flag(object.receives_shadow), &Node::Flag(true)));
    entries.extend(object.motion.as_ref().map(motion));
    Node::Table(entries)
}

fn part(part: &Part, path: &dyn Fn(&str) -> String) -> Node {
    let mut entries = vec![required("shape", shape(&part.shape, path))];
    entries.extend(pose(&part.pose));
    Node::Table(entries)
}

/// The object's entries with its one shape as a list of one part, which says the same.
pub(crate) fn as_parts(entries: &[Entry]) -> Vec<Entry> {
    let in_list = |entry: &Entry| match entry.key {
        "shape" => {
            let mut part = vec![entry.clone()];
            part.extend(pose(&Pose::IDENTITY));
            required("parts", Node::List(vec![Node::Table(part)]))
        }
        _ => entry.clone(),
    };
    entries.iter().map(in_list).collect()
}

fn pose(pose: &Pose) -> [Entry; 2] {
    let quaternion = |q: DQuat| numbers(&unit_rotation(q).to_array());
    [
        optional("translation", vector(pose.translation), &vector(DVec3::ZERO)),
        optional("rotation", quaternion(pose.rotation), &quaternion(DQuat::IDENTITY)),
    ]
}

fn shape(shape: &Shape, path: &dyn Fn(&str) -> String) -> Node {
    let lengths = |list: &[(&'static str, f64)]| -> Vec<Entry> {
        list.iter().map(|(key, length)| required(key, number(*length))).collect()
    };
    let own = match shape {
        Shape::Plane => Vec::new(),
        Shape::Rectangle { width, depth } => lengths(&[("width", *width), ("depth", *depth)]),
        Shape::Disc { radius } => lengths(&[("radius", *radius)]),
        Shape::Triangle { vertices } => vec![required("vertices", vectors(vertices))],
        Shape::Sphere { radius } => lengths(&[("radius", *radius)]),
        Shape::Ellipsoid { radii } => vec![required("radii", vector(*radii))],
        Shape::Cone { radius, height } => lengths(&[("radius", *radius), ("height", *height)]),
        Shape::Cylinder { radius, height, radius_top } => {
            let mut own = lengths(&[("radius", *radius), ("height", *height)]);
            own.push(optional("radius_top", number(*radius_top), &number(*radius)));
            own
        }
        Shape::Capsule { radius, height } => lengths(&[("radius", *radius), ("height", *height)]),
        Shape::Box { size } => vec![required("size", vector(*size))],
        Shape::Torus { major_radius, minor_radius } => {
            lengths(&[("major_radius", *major_radius), ("minor_radius", *minor_radius)])
        }
        Shape::Mesh(mesh) => vec![required("path", text(&path(&mesh.path)))],
    };
    let mut entries = vec![required("type", text(shape.type_name()))];
    entries.extend(own);
    Node::Table(entries)
}

fn motion(motion: &Motion) -> Entry {
    let (kind, own, seconds) = match motion {
        Motion::Orbit { center, axis, period } => {
            let own = vec![required("center", vector(*center)), required("axis", vector(unit(*axis)))];
            ("orbit", own, period)
        }
        Motion::Path { points, period } => ("path", vec![required("points", vectors(points))], period),
    };
    let mut entries = vec![required("type", text(kind))];
    entries.extend(own);
    entries.push(required("period", number(*seconds)));
    required("motion", Node::Table(entries))
}

fn required(key: &'static str, value: Node) -> Entry {
    Entry { key, value, default: false }
}

fn optional(key: &'static str, value: Node, usual: &Node) -> Entry {
    Entry { default: value == *usual, key, value }
}

fn text(text: &str) -> Node {
    Node::Text(text.to_owned())
}

fn number(number: f64) -> Node {
    Node::Number(Number(number))
}

fn numbers(list: &[f64]) -> Node {
    Node::List(list.iter().copied().map(number).collect())
}

fn vector(v: DVec3) -> Node {
    numbers(&v.to_array())
}

fn vectors(list: &[DVec3]) -> Node {
    Node::List(list.iter().copied().map(vector).collect())
}
