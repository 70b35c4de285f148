//! Changing the text of a scene file where the scene has changed, and nowhere else.

mod list;

use std::path::Path;

use toml_edit::{Decor, DocumentMut, InlineTable, Item, RawString, Table, TableLike, Value};

use crate::Scene;
use crate::tree::{self, Entry, Node, as_parts};
use crate::write::{section, text, value};
use list::{update_array, update_tables};

impl Scene {
    /// The text of a scene file that a person wrote, changed only where it says something else than this
    /// scene: comments, order, spacing and the spelling of what stays the same are kept.
    ///
    /// Lights and objects are known by their names; one that was renamed is known by the rest. Those
    /// that are gone go with the comments right above them, new ones are added in their place in the
    /// list. Where `original` is no scene file, or written in a way that cannot be changed piece by
    /// piece, the answer is [`Scene::to_toml`] under the comment that the original begins with. Either
    /// way reading the answer gives what reading `to_toml` does. Meshes are compared by path.
    pub fn update_toml(&self, original: &str) -> String {
        updated(&tree::scene(self, &str::to_owned), original)
    }
}

/// As [`Scene::update_toml`], of a scene as its file says it.
pub(crate) fn updated(new: &Node, original: &str) -> String {
    let (head, body) = split_head(original);
    if let Ok(old) = read(original) {
        if old == *new {
            return original.to_owned();
        }
        let changed = body.parse().map(|document| change(document, &old, new));
        if let Ok(changed) = changed {
            // The library ends the lines it writes with a line feed alone.
            let lines = if original.contains("\r\n") {
                changed.replace("\r\n", "\n").replace('\n', "\r\n")
            } else {
                changed
            };
            let whole = format!("{head}{lines}");
            if read(&whole).as_ref() == Ok(new) {
                return whole;
            }
        }
    }
    let end = if head.is_empty() || head.ends_with('\n') { "" } else { "\n" };
    format!("{head}{end}{}", text(new))
}

fn read(text: &str) -> Result<Node, crate::SceneError> {
    Scene::parse_text(text, Path::new("")).map(|scene| tree::scene(&scene, &str::to_owned))
}

/// The comment that a file begins with, and the rest. The comment is about the file, whatever comes
/// after it.
fn split_head(text: &str) -> (&str, &str) {
    let mark = text.len() - text.trim_start_matches('\u{feff}').len();
    let comment: usize =
        text[mark..].split_inclusive('\n').take_while(|line| line.starts_with('#')).map(str::len).sum();
    text.split_at(mark + comment)
}

fn change(mut document: DocumentMut, old: &Node, new: &Node) -> String {
    let unsaid = |e: &Entry| document.get(e.key).is_none_or(is_empty_array) && !e.default;
    let (added, said): (Vec<Entry>, Vec<Entry>) = new.entries().iter().cloned().partition(unsaid);
    update_entries(document.as_table_mut(), old.entries(), &said);
    let has_keys = document
        .iter()
        .any(|(_, item)| item.is_value() || item.as_table().is_some_and(toml_edit::Table::is_dotted));
    for entry in added {
        let mut item = section(&entry.value);
        match &mut item {
            // Keys come before the first header, with a blank line between.
            Item::Value(value) if !has_keys => value.decor_mut().set_suffix("\n"),
            _ => {
                let place = place(&document, entry.key);
                set_position(&mut item, place);
            }
        }
        document.remove(entry.key);
        document.insert(entry.key, item);
    }
    document.to_string()
}

fn is_empty_array(item: &Item) -> bool {
    item.as_array().is_some_and(toml_edit::Array::is_empty)
}

/// The position of the table that a new section of the file comes right after.
fn place(document: &DocumentMut, key: &str) -> isize {
    let position = |key: &str| document.get(key).and_then(Item::as_table).and_then(Table::position);
    let before = position("camera").unwrap_or(0);
    match key {
        "image" => before,
        "light" => before.max(position("image").unwrap_or(0)),
        _ => isize::MAX,
    }
}

fn set_position(item: &mut Item, position: isize) {
    match item {
        Item::Table(table) => table.set_position(Some(position)),
        Item::ArrayOfTables(tables) => tables.iter_mut().for_each(|t| t.set_position(Some(position))),
        _ => {}
    }
}

/// Makes an item that says `old` say `new`.
pub(crate) fn update_item(item: &mut Item, old: &Node, new: &Node) {
    match (item, new) {
        (Item::Value(value), _) => {
            let before = width(value);
            update_value(value, old, new);
            keep_column(value, before);
        }
        (Item::Table(table), Node::Table(entries)) => update_entries(table, old.entries(), entries),
        (Item::ArrayOfTables(tables), Node::List(nodes)) => update_tables(tables, old.values(), nodes),
        (item, _) => *item = Item::Value(value(new)),
    }
}

/// Makes a value that says `old` say `new`.
pub(crate) fn update_value(there: &mut Value, old: &Node, new: &Node) {
    if old == new {
        return;
    }
    match (&mut *there, old, new) {
        (Value::InlineTable(table), Node::Table(old), Node::Table(new)) => {
            let keys = table.len();
            update_entries(table, old, new);
            if table.len() != keys || old.iter().map(|e| e.key).ne(new.iter().map(|e| e.key)) {
                tidy(table);
            }
        }
        (Value::Array(array), Node::List(old), Node::List(new)) => update_array(array, old, new),
        _ => replace(there, new),
    }
}

/// How long a value on one line is, without what is around it; `None` of one on several lines.
fn width(value: &Value) -> Option<usize> {
    let bare = value.clone().decorated("", "").to_string();
    (!bare.contains('\n')).then(|| bare.chars().count())
}

/// Puts the comment after a value that was so long back into its column.
fn keep_column(value: &mut Value, before: Option<usize>) {
    let (Some(before), Some(now)) = (before, width(value)) else { return };
    let suffix = value.decor().suffix().and_then(RawString::as_str).unwrap_or_default();
    let comment = suffix.trim_start_matches(' ');
    if comment.starts_with('#') && before != now {
        let spaces = (suffix.len() - comment.len() + before).saturating_sub(now).max(1);
        let suffix = format!("{}{comment}", " ".repeat(spaces));
        value.decor_mut().set_suffix(suffix);
    }
}

/// Makes a value say `new` unless it does so in its own way, and leaves what is around it.
pub(crate) fn replace(there: &mut Value, new: &Node) {
    let same = match (&*there, new) {
        (Value::Float(f), Node::Number(n)) => f.value().to_bits() == n.0.to_bits(),
        (Value::Integer(i), Node::Number(n)) => (*i.value() as f64).to_bits() == n.0.to_bits(),
        _ => false,
    };
    if !same {
        let around = there.decor().clone();
        *there = value(new);
        *there.decor_mut() = around;
    }
}

/// Makes a table that says `old` say `new`.
pub(crate) fn update_entries(table: &mut dyn TableLike, old: &[Entry], new: &[Entry]) {
    // One shape may have been written as one part.
    if table.contains_key("parts") {
        return update_keys(table, &as_parts(old), &as_parts(new));
    }
    update_keys(table, old, new);
}

fn update_keys(table: &mut dyn TableLike, old: &[Entry], new: &[Entry]) {
    for gone in old.iter().filter(|o| new.iter().all(|n| n.key != o.key)) {
        table.remove(gone.key);
    }
    for entry in new {
        let before = old.iter().find(|o| o.key == entry.key).map(|o| &o.value);
        match (table.get_mut(entry.key), before) {
            (Some(_), Some(before)) if *before == entry.value => {}
            (Some(item), Some(before)) => update_item(item, before, &entry.value),
            (Some(_), None) => {}
            (None, _) if entry.default => {}
            (None, _) => {
                table.insert(entry.key, Item::Value(value(&entry.value)));
            }
        }
    }
}

/// Spaces within the braces as usual, where keys came or went.
fn tidy(table: &mut InlineTable) {
    let last = table.len().saturating_sub(1);
    for (i, (mut key, value)) in table.iter_mut().enumerate() {
        if is_blank(key.leaf_decor().prefix()) {
            key.leaf_decor_mut().set_prefix(" ");
        }
        if is_blank(value.decor().suffix()) {
            value.decor_mut().set_suffix(if i == last { " " } else { "" });
        }
    }
}

/// Whether there is nothing but spaces; nothing said counts, because it means the usual ones.
fn is_blank(text: Option<&RawString>) -> bool {
    text.and_then(RawString::as_str).unwrap_or_default().bytes().all(|b| matches!(b, b' ' | b'\t'))
}

/// The text before a value.
pub(crate) fn prefix(decor: &Decor) -> &str {
    decor.prefix().and_then(RawString::as_str).unwrap_or_default()
}
