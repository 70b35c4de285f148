//! The house's order: what the modules of every crate import from each other.
//!
//! The rooms of `antumbra-gl` import downwards alone. In every crate, modules that lie side by side do not import each
//! other in a circle: what two of them share is in a third. Paths are followed through `pub use` to where a thing is
//! defined. Tests may import anything.

mod imports;

use imports::{Crate, Module};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Each imports those before it alone.
const ROOMS: [&str; 6] = ["input", "screen", "gl", "masks", "technique", "renderer"];

/// Every crate of the workspace with modules.
const CRATES: [&str; 10] = [
    "crates/antumbra-math",
    "crates/antumbra-gl",
    "crates/antumbra",
    "crates/antumbra-scene",
    "crates/antumbra-reference",
    "crates/antumbra-host",
    "crates/antumbra-testkit",
    "crates/antumbra-cli",
    "apps/viewer",
    "xtask",
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace")
}

#[test]
fn rooms_import_downwards() {
    let house = Crate::read(&root().join("crates/antumbra-gl/src"));
    let height = |room: &str| ROOMS.iter().position(|r| *r == room);
    let mut imports = 0;
    let mut upwards = Vec::new();
    for import in house.imports() {
        let ([from, ..], [to, ..]) = (&import.from[..], &import.to[..]) else { continue };
        let (Some(here), Some(there)) = (height(from), height(to)) else {
            panic!("{}: {from} or {to} is in no room", import.file);
        };
        imports += 1;
        if there > here {
            upwards.push(format!("{}: {from} imports {}", import.file, import.to.join("::")));
        }
    }
    assert!(upwards.is_empty(), "upwards:\n{}", upwards.join("\n"));
    assert!(imports > 200, "{imports} imports were read");
}

/// What calls OpenGL is in its room and those above.
#[test]
fn what_a_host_says_and_the_screen_are_without_opengl() {
    for room in &ROOMS[..2] {
        let folder = root().join("crates/antumbra-gl/src").join(room);
        for (file, text) in imports::sources(&folder) {
            assert!(!text.contains("HasContext"), "{file} calls OpenGL");
        }
    }
}

#[test]
fn no_crate_has_a_circle_of_modules() {
    let mut circles = Vec::new();
    for name in CRATES {
        let read = Crate::read(&root().join(name).join("src"));
        assert!(!read.modules.is_empty(), "{name} has modules");
        let edges = between_siblings(&read);
        for (parent, edges) in &edges {
            if let Some(circle) = circle(edges) {
                let at = if parent.is_empty() { "src".to_owned() } else { parent.join("::") };
                circles.push(format!("{name}, {at}: {}", circle.join(" -> ")));
            }
        }
    }
    assert!(circles.is_empty(), "circles:\n{}", circles.join("\n"));
}

type Edges = BTreeMap<String, BTreeSet<String>>;

/// Of each module, the imports between its children and all that is in them.
fn between_siblings(read: &Crate) -> BTreeMap<Module, Edges> {
    let mut all: BTreeMap<Module, Edges> = BTreeMap::new();
    for import in read.imports() {
        let common = import.from.iter().zip(&import.to).take_while(|(a, b)| a == b).count();
        if let (Some(from), Some(to)) = (import.from.get(common), import.to.get(common)) {
            let edges = all.entry(import.from[..common].to_vec()).or_default();
            edges.entry(from.clone()).or_default().insert(to.clone());
        }
    }
    all
}

/// A way from a node back to itself.
fn circle(edges: &Edges) -> Option<Vec<String>> {
    fn walk(edges: &Edges, path: &mut Vec<String>, done: &mut BTreeSet<String>) -> Option<Vec<String>> {
        let here = path.last().expect("a path").clone();
        for next in edges.get(&here).into_iter().flatten() {
            if let Some(start) = path.iter().position(|node| node == next) {
                return Some(path[start..].iter().chain([next]).cloned().collect());
            }
            if !done.contains(next) {
                path.push(next.clone());
                if let Some(found) = walk(edges, path, done) {
                    return Some(found);
                }
                path.pop();
            }
        }
        done.insert(here);
        None
    }
    let mut done = BTreeSet::new();
    edges.keys().find_map(|start| walk(edges, &mut vec![start.clone()], &mut done))
}

/// The search itself: it finds a circle, and none where there is none.
#[test]
fn circles_are_found() {
    let edges = |list: &[(&str, &str)]| {
        let mut edges = Edges::new();
        list.iter().for_each(|(a, b)| {
            edges.entry((*a).to_owned()).or_default().insert((*b).to_owned());
        });
        edges
    };
    assert_eq!(circle(&edges(&[("a", "b"), ("b", "c"), ("a", "c")])), None, "a diamond");
    let found = circle(&edges(&[("a", "b"), ("b", "c"), ("c", "b")])).expect("a circle");
    assert_eq!(found, ["b", "c", "b"], "without the way to it");
}
