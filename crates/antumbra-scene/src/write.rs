//! Scenes as text: the format as a person would write it.

use std::path::Path;

use toml_edit::{Array, ArrayOfTables, DocumentMut, Formatted, InlineTable, Item, Table, Value};

use crate::tree::{self, Entry, Node};
use crate::{Scene, SceneError};

/// Lists of more points than this have a line for each.
const POINTS_ON_A_LINE: usize = 6;

impl Scene {
    /// The scene as the text of a scene file: keys in the format's order, defaults left out.
    ///
    /// Reading the text gives the same scene to the last bit, if reading some text can give it at all
    /// (see [`Scene::validate`]) and the text has no more than
    /// [`MAX_SCENE_BYTES`](crate::limits::MAX_SCENE_BYTES). Of others it is the nearest that the format
    /// can say: directions and rotations get the length 1, an angle becomes the nearest that some number
    /// of degrees gives, and a directional light has neither position nor motion. Mesh paths are written
    /// as they are.
    pub fn to_toml(&self) -> String {
        text(&tree::scene(self, &str::to_owned))
    }

    /// Whether the scene, made or changed in memory, is one that a file can hold: within the format's
    /// [limits](crate::limits), with the names that lights and objects may have, and so on.
    ///
    /// Takes about as long as writing and reading the scene's file. Triangles of meshes are taken as
    /// they are; only their paths are looked at, and whether there are files is not.
    ///
    /// # Errors
    /// What is wrong and what it should be, as one line without a place.
    pub fn validate(&self) -> Result<(), String> {
        let saying = |error: SceneError| format!("{}; {}", error.what(), error.instead());
        Self::parse_text(&self.to_toml(), Path::new("")).map(drop).map_err(saying)
    }
}

/// The text of a scene file.
pub(crate) fn text(scene: &Node) -> String {
    let mut document = DocumentMut::new();
    for entry in scene.entries().iter().filter(|e| !e.default) {
        document.insert(entry.key, section(&entry.value));
    }
    document.to_string()
}

/// A value of the file as a whole: under a header of its own if it is a table or a list of tables.
pub(crate) fn section(node: &Node) -> Item {
    match node {
        Node::Table(entries) => Item::Table(table(entries)),
        Node::List(nodes) if nodes.iter().all(|n| matches!(n, Node::Table(_))) => {
            let mut tables = ArrayOfTables::new();
            for node in nodes {
                tables.push(table(node.entries()));
            }
            Item::ArrayOfTables(tables)
        }
        _ => Item::Value(value(node)),
    }
}

/// A table under a header, without what is the default.
pub(crate) fn table(entries: &[Entry]) -> Table {
    let mut table = Table::new();
    for entry in entries.iter().filter(|e| !e.default) {
        table.insert(entry.key, Item::Value(value(&entry.value)));
    }
    table
}

/// A value after `=`.
pub(crate) fn value(node: &Node) -> Value {
    match node {
        Node::Number(n) => number(n.0),
        Node::Integer(i) => i64::from(*i).into(),
        Node::Flag(flag) => (*flag).into(),
        Node::Text(text) => text.as_str().into(),
        Node::List(nodes) => list(nodes).into(),
        Node::Table(entries) => {
            let mut table = InlineTable::new();
            for entry in entries.iter().filter(|e| !e.default) {
                table.insert(entry.key, value(&entry.value));
            }
            table.into()
        }
    }
}

fn list(nodes: &[Node]) -> Array {
    let mut array: Array = nodes.iter().map(value).collect();
    let lines = match nodes.first() {
        Some(Node::Table(_)) => true,
        Some(Node::List(_)) => nodes.len() > POINTS_ON_A_LINE,
        _ => false,
    };
    if lines {
        for value in array.iter_mut() {
            value.decor_mut().set_prefix("\n  ");
        }
        array.set_trailing("\n");
        array.set_trailing_comma(true);
    }
    array
}

/// A number with the fewest digits that tell it from all others, with an exponent where it would be
/// long.
fn number(number: f64) -> Value {
    let size = number.abs();
    let short = if size == 0.0 || (1e-4..1e7).contains(&size) {
        format!("{number:?}")
    } else {
        format!("{number:e}")
    };
    // What is not finite has its own words.
    short.parse().unwrap_or_else(|_| Value::Float(Formatted::new(number)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_have_a_fraction_or_an_exponent() {
        for (n, text) in [
            (0.0, "0.0"),
            (-0.0, "-0.0"),
            (1.0, "1.0"),
            (-2.5, "-2.5"),
            (0.1, "0.1"),
            (0.0001, "0.0001"),
            (1e-6, "1e-6"),
            (100000.0, "100000.0"),
            (1e9, "1e9"),
            (123456789.0, "1.23456789e8"),
            (5e-324, "5e-324"),
            (1.0 / 3.0, "0.3333333333333333"),
            (f64::INFINITY, "inf"),
            (f64::NEG_INFINITY, "-inf"),
            (f64::NAN, "nan"),
        ] {
            assert_eq!(number(n).to_string(), text, "{n:?}");
        }
    }
}
