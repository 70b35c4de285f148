//! Changing lists of a scene file: which entry is which, and putting them in order.

use core::hash::Hash;
use std::collections::{BTreeSet, HashMap};

use toml_edit::{Array, ArrayOfTables, Decor, Item, Table, Value};

use super::{prefix, replace, update_entries, update_value};
use crate::tree::{Entry, Node};
use crate::write::{table, value};

/// How many keys of a light or object may differ beside its name for it to count as the one that was
/// there.
const MOST_CHANGES: usize = 2;

/// Makes an array that says `old` say `new`.
pub(crate) fn update_array(array: &mut Array, old: &[Node], new: &[Node]) {
    let scalar = |node: &Node| !matches!(node, Node::List(_) | Node::Table(_));
    if new.iter().any(scalar) && array.len() == new.len() {
        return array.iter_mut().zip(new).for_each(|(value, node)| replace(value, node));
    }
    let layout = Layout::of(array);
    let mut values: Vec<Option<Value>> = core::mem::take(array).into_iter().map(Some).collect();
    let mut updated = Array::new();
    // Which comment ends the line that the next entry comes after: that of the bracket to begin with.
    let mut line = 0;
    for (node, from) in new.iter().zip(origins(old, new)) {
        let kept = from.and_then(|from| Some((from, values.get_mut(from)?.take()?)));
        let (mut entry, before, next_line) = match kept {
            Some((from, mut entry)) => {
                update_value(&mut entry, &old[from], node);
                (entry, layout.before[from].as_str(), from + 1)
            }
            None => (value(node), layout.indent.as_str(), usize::MAX),
        };
        let before = match (before.trim().is_empty() && !before.contains('\n'), updated.is_empty()) {
            (true, true) => layout.before.first().map(String::as_str).unwrap_or_default(),
            (true, false) => " ",
            _ => before,
        };
        entry.decor_mut().set_prefix(layout.after_comment(line, before));
        updated.push_formatted(entry);
        line = next_line;
    }
    updated.set_trailing(layout.after_comment(line, &layout.end));
    updated.set_trailing_comma(layout.comma);
    *updated.decor_mut() = layout.around;
    *array = updated;
}

/// How an array is laid out.
struct Layout {
    around: Decor,
    /// The comments that end the lines of the bracket and of each entry.
    comments: Vec<String>,
    /// What is between these comments and each entry.
    before: Vec<String>,
    /// What is before the bracket at the end.
    end: String,
    /// What is before a new entry.
    indent: String,
    comma: bool,
}

impl Layout {
    fn of(array: &Array) -> Self {
        let mut comments = Vec::with_capacity(array.len() + 1);
        let mut split = |text: &str| {
            let (comment, rest) = match text.find('\n') {
                Some(end) if text.trim_start_matches([' ', '\t']).starts_with('#') => text.split_at(end),
                _ => ("", text),
            };
            comments.push(comment.to_owned());
            rest.to_owned()
        };
        let before: Vec<String> = array.iter().map(|value| split(prefix(value.decor()))).collect();
        let end = split(array.trailing().as_str().unwrap_or_default());
        let last = before.last().map(String::as_str).unwrap_or_default();
        let indent = last.rfind('\n').map(|at| last[at..].to_owned()).unwrap_or_default();
        let (around, comma) = (array.decor().clone(), array.trailing_comma());
        Self { around, comments, before, end, indent, comma }
    }

    /// Text after the comment that ends a line, which a new entry has not.
    fn after_comment(&self, line: usize, text: &str) -> String {
        let comment = self.comments.get(line).map(String::as_str).unwrap_or_default();
        let end = if comment.is_empty() || text.starts_with('\n') { "" } else { "\n" };
        format!("{comment}{end}{text}")
    }
}

/// Makes `[[key]]` tables that say `old` say `new`.
pub(crate) fn update_tables(tables: &mut ArrayOfTables, old: &[Node], new: &[Node]) {
    let mut there: Vec<Option<Table>> = core::mem::take(tables).into_iter().map(Some).collect();
    let origins = origins(old, new);
    let kept: Vec<usize> = origins.iter().flatten().copied().collect();
    let mut positions: Vec<Option<isize>> =
        kept.iter().map(|from| there.get(*from).and_then(|t| t.as_ref()?.position())).collect();
    let moved = !kept.is_sorted();
    positions.sort_unstable();
    let mut positions = positions.into_iter().peekable();
    for (node, from) in new.iter().zip(origins) {
        let mut entry = match from.and_then(|from| Some((there.get_mut(from)?.take()?, &old[from]))) {
            Some((mut entry, was)) => {
                update_entries(&mut entry, was.entries(), node.entries());
                let position = positions.next().flatten();
                if moved {
                    move_to(&mut entry, position);
                    if prefix(entry.decor()).is_empty() {
                        entry.decor_mut().set_prefix("\n");
                    }
                }
                entry
            }
            None => table(node.entries()),
        };
        // A new table follows the one before it, and the first one precedes the next.
        if from.is_none() && tables.is_empty() {
            entry.set_position(positions.peek().copied().flatten());
        }
        tables.push(entry);
    }
}

/// Puts a table at a position of the file, and the tables inside it right after.
fn move_to(table: &mut Table, position: Option<isize>) {
    table.set_position(position);
    for (_, item) in table.iter_mut() {
        match item {
            Item::Table(inner) => move_to(inner, None),
            Item::ArrayOfTables(inner) => inner.iter_mut().for_each(|t| move_to(t, None)),
            _ => {}
        }
    }
}

/// For each new entry the old one that it was, if it was one. None is used twice.
fn origins(old: &[Node], new: &[Node]) -> Vec<Option<usize>> {
    if old.iter().chain(new).all(|node| node.name().is_some()) {
        named_origins(old, new)
    } else {
        sequence_origins(old, new)
    }
}

/// By name; then, of what was renamed, by all the rest; then by the place in the list, if nearly all of
/// the rest is the same.
fn named_origins(old: &[Node], new: &[Node]) -> Vec<Option<usize>> {
    let mut gone: HashMap<&str, usize> =
        old.iter().enumerate().filter_map(|(i, node)| Some((node.name()?, i))).collect();
    let mut origins: Vec<Option<usize>> =
        new.iter().map(|node| node.name().and_then(|name| gone.remove(name))).collect();
    let mut gone: BTreeSet<usize> = gone.into_values().collect();
    let mut alike = Places::new(gone.iter().map(|i| (*i, nameless(&old[*i]))));
    for (origin, node) in origins.iter_mut().zip(new).filter(|(origin, _)| origin.is_none()) {
        *origin = alike.take(&nameless(node), 0);
        if let Some(i) = origin {
            gone.remove(i);
        }
    }
    if old.len() == new.len() {
        for (i, origin) in origins.iter_mut().enumerate().filter(|(_, origin)| origin.is_none()) {
            let near = changes(&old[i], &new[i]) <= MOST_CHANGES;
            *origin = (near && gone.remove(&i)).then_some(i);
        }
    }
    origins
}

/// What a table says beside the name.
fn nameless(node: &Node) -> Vec<&Entry> {
    node.entries().iter().filter(|entry| entry.key != "name").collect()
}

/// How many keys beside the name differ.
fn changes(old: &Node, new: &Node) -> usize {
    let (old, new) = (nameless(old), nameless(new));
    let same = new.iter().filter(|n| old.iter().any(|o| o.key == n.key && o.value == n.value)).count();
    old.len().max(new.len()) - same
}

/// Where there are things that are the same.
struct Places<T>(HashMap<T, BTreeSet<usize>>);

impl<T: Eq + Hash> Places<T> {
    fn new(things: impl Iterator<Item = (usize, T)>) -> Self {
        let mut places: HashMap<T, BTreeSet<usize>> = HashMap::new();
        for (i, thing) in things {
            places.entry(thing).or_default().insert(i);
        }
        Self(places)
    }

    /// The first place of such a thing from `next` on, or else the first one, which is then no longer
    /// there.
    fn take(&mut self, thing: &T, next: usize) -> Option<usize> {
        let places = self.0.get_mut(thing)?;
        let place = places.range(next..).next().or_else(|| places.first()).copied()?;
        places.remove(&place);
        Some(place)
    }
}

/// Of entries without names: the same ones at both ends, and between them as [`middle_origins`].
fn sequence_origins(old: &[Node], new: &[Node]) -> Vec<Option<usize>> {
    let start = old.iter().zip(new).take_while(|(o, n)| o == n).count();
    let both = old[start..].iter().rev().zip(new[start..].iter().rev());
    let end = both.take_while(|(o, n)| o == n).count();
    let (old_end, new_end) = (old.len() - end, new.len() - end);
    let middle = middle_origins(&old[start..old_end], &new[start..new_end]);
    let middle = middle.into_iter().map(|from| from.map(|i| start + i));
    (0..start).map(Some).chain(middle).chain((old_end..old.len()).map(Some)).collect()
}

/// The same ones where they were, after the one before, or anywhere; then, if nothing was moved, those
/// between in order, which were changed.
fn middle_origins(old: &[Node], new: &[Node]) -> Vec<Option<usize>> {
    let kept = |i: usize| old.len() == new.len() && old[i] == new[i];
    let mut origins: Vec<Option<usize>> = (0..new.len()).map(|i| kept(i).then_some(i)).collect();
    let mut places = Places::new(old.iter().enumerate().filter(|(i, _)| !kept(*i)));
    let mut next = 0;
    for (origin, node) in origins.iter_mut().zip(new) {
        *origin = origin.or_else(|| places.take(&node, next));
        next = origin.map_or(next, |i| i + 1);
    }
    if origins.iter().flatten().is_sorted() {
        fill(&mut origins, old.len());
    }
    origins
}

/// Gives what has no origin between two that have one the old entries between these, in order.
fn fill(origins: &mut [Option<usize>], old: usize) {
    // The old entries before the next one that has an origin end here.
    let mut ends = vec![old; origins.len()];
    for j in (1..origins.len()).rev() {
        ends[j - 1] = origins[j].unwrap_or(ends[j]);
    }
    let mut next = 0;
    for (origin, end) in origins.iter_mut().zip(ends) {
        if origin.is_none() && next < end {
            *origin = Some(next);
        }
        next = origin.map_or(next, |i| i + 1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn letters(text: &str) -> Vec<Node> {
        text.chars().map(|c| Node::Text(c.to_string())).collect()
    }

    #[test]
    fn entries_are_found_again() {
        for (old, new, origins) in [
            ("abc", "abc", "012"),
            ("abc", "bc", "12"),
            ("abc", "ac", "02"),
            ("abc", "ab", "01"),
            ("abc", "axc", "012"),
            ("abc", "axbc", "0-12"),
            ("abc", "abcx", "012-"),
            ("abc", "xabc", "-012"),
            ("abc", "acx", "02-"),
            ("abc", "cba", "210"),
            ("abcd", "acbd", "0213"),
            ("aaab", "axay", "0123"),
            ("abcdef", "axcf", "0125"),
            ("abc", "xy", "01"),
            ("ab", "xyz", "01-"),
            ("abc", "", ""),
            ("", "ab", "--"),
        ] {
            let found: String = super::origins(&letters(old), &letters(new))
                .into_iter()
                .map(|from| from.map_or("-".to_owned(), |i| i.to_string()))
                .collect();
            assert_eq!(found, origins, "{old} to {new}");
        }
    }
}
