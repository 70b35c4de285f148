//! The imports of a crate, read from its sources.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// A module's path from the crate's root.
pub(crate) type Module = Vec<String>;

/// One path in a file that names something of the same crate.
pub(crate) struct Import {
    pub(crate) file: String,
    pub(crate) from: Module,
    /// The module that defines what is named.
    pub(crate) to: Module,
}

/// A crate's modules and what they name.
pub(crate) struct Crate {
    pub(crate) modules: BTreeSet<Module>,
    /// Of each module what `pub use` gives out under a name: a path from the root.
    given_out: BTreeMap<(Module, String), Module>,
    /// File, module and a path from the root.
    named: Vec<(String, Module, Module)>,
}

impl Crate {
    /// Reads all modules below a `src` folder, tests left out.
    pub(crate) fn read(src: &Path) -> Self {
        let files: Vec<(Module, String, String)> = sources(src)
            .into_iter()
            .filter_map(|(file, text)| Some((module(src, &file)?, file, text)))
            .collect();
        let modules = files.iter().map(|(module, ..)| module.clone()).collect();
        let mut read = Self { modules, given_out: BTreeMap::new(), named: Vec::new() };
        for (module, file, text) in &files {
            for (is_public, path, name) in uses(text) {
                let Some(path) = read.rooted(module, &path) else { continue };
                if is_public {
                    read.given_out.insert((module.clone(), name), path.clone());
                }
                read.named.push((file.clone(), module.clone(), path));
            }
            for path in paths(text) {
                if let Some(path) = read.rooted(module, &path) {
                    read.named.push((file.clone(), module.clone(), path));
                }
            }
        }
        read
    }

    /// Everything that is named across modules.
    pub(crate) fn imports(&self) -> impl Iterator<Item = Import> {
        self.named.iter().filter_map(|(file, from, path)| {
            let to = self.definition(path, 0);
            (to != *from).then(|| Import { file: file.clone(), from: from.clone(), to })
        })
    }

    /// The module that defines what a path from the root names.
    fn definition(&self, path: &[String], depth: usize) -> Module {
        let known = (0..=path.len()).rev().find(|&n| self.modules.contains(&path[..n]));
        let (module, rest) = path.split_at(known.unwrap_or(0));
        match rest.first().and_then(|name| self.given_out.get(&(module.to_vec(), name.clone()))) {
            Some(to) if depth < 8 && to != path => {
                let path: Module = to.iter().chain(&rest[1..]).cloned().collect();
                self.definition(&path, depth + 1)
            }
            _ => module.to_vec(),
        }
    }

    /// A path as it stands in a module's file from the crate's root; `None` for paths into other crates.
    fn rooted(&self, module: &[String], path: &[String]) -> Option<Module> {
        let mut at = module.to_vec();
        let mut rest = path;
        match rest.first()?.as_str() {
            "crate" => (at, rest) = (Vec::new(), &rest[1..]),
            "self" => rest = &rest[1..],
            "super" => {
                while rest.first().is_some_and(|word| word == "super") {
                    at.pop()?;
                    rest = &rest[1..];
                }
            }
            // A child, or another crate.
            child => {
                at.push(child.to_owned());
                if !self.modules.contains(&at) {
                    return None;
                }
                rest = &rest[1..];
            }
        }
        at.extend_from_slice(rest);
        Some(at)
    }
}

/// The Rust files below a folder but those of tests, with their texts: without comments, string literals, and modules of
/// tests.
pub(crate) fn sources(folder: &Path) -> Vec<(String, String)> {
    let mut files = Vec::new();
    let mut folders: Vec<PathBuf> = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder").flatten() {
            let path = entry.path();
            let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default().to_owned();
            if path.is_dir() {
                folders.push(path);
            } else if name.ends_with(".rs") && name != "main.rs" {
                let text = std::fs::read_to_string(&path).expect("a source");
                files.push((path.display().to_string(), code(&text)));
            }
        }
    }
    let tests: Vec<PathBuf> = files.iter().flat_map(|(file, code)| modules_of_tests(file, code)).collect();
    files.retain(|(file, _)| {
        let module = Path::new(file).with_extension("");
        !tests.iter().any(|tests| module.starts_with(tests))
    });
    files.sort();
    files.into_iter().map(|(file, code)| (file, without_tests(&code))).collect()
}

/// The modules of tests that a file declares and that have files of their own: their paths without an ending.
fn modules_of_tests(file: &str, code: &str) -> Vec<PathBuf> {
    let path = Path::new(file);
    let folder = match path.file_stem().and_then(|stem| stem.to_str()) {
        Some("lib" | "mod") => path.with_file_name(""),
        _ => path.with_extension(""),
    };
    let declared = code.split("#[cfg(test)]").skip(1).filter_map(|rest| {
        let (declaration, _) = rest.split_once(';')?;
        let (before, name) = declaration.rsplit_once("mod ")?;
        let is_mod = before.trim().is_empty() || before.trim().starts_with("pub");
        (is_mod && !name.contains('{')).then(|| folder.join(name.trim()))
    });
    declared.collect()
}

/// The module that a file is.
fn module(src: &Path, file: &str) -> Option<Module> {
    let path = Path::new(file).strip_prefix(src).ok()?.with_extension("");
    let mut module: Module = path.iter().filter_map(|part| part.to_str()).map(str::to_owned).collect();
    if module.last().is_some_and(|last| last == "mod" || last == "lib") {
        module.pop();
    }
    Some(module)
}

/// Without comments and the insides of string literals.
fn code(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let skipped = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("r#\"") {
            rest.find("\"#").map_or(rest.len(), |end| end + 2)
        } else if c == '"' {
            let mut end = 1;
            let bytes = rest.as_bytes();
            while end < bytes.len() && bytes[end] != b'"' {
                end += if bytes[end] == b'\\' { 2 } else { 1 };
            }
            (end + 1).min(rest.len())
        } else if rest.starts_with("'\"'") || rest.starts_with("'{'") || rest.starts_with("'}'") {
            3
        } else {
            code.push(c);
            rest = &rest[c.len_utf8()..];
            continue;
        };
        code.push(' ');
        rest = &rest[skipped..];
    }
    code
}

/// Without `#[cfg(test)] mod .. { .. }`.
fn without_tests(code: &str) -> String {
    let mut kept = String::new();
    let mut rest = code;
    while let Some(start) = rest.find("#[cfg(test)]") {
        kept.push_str(&rest[..start]);
        rest = &rest[start + "#[cfg(test)]".len()..];
        let end = rest.find([';', '{']).unwrap_or(rest.len());
        rest = if rest[end..].starts_with('{') { &rest[end + block(&rest[end..])..] } else { &rest[end..] };
    }
    kept + rest
}

/// The length of a block that the text begins with.
fn block(text: &str) -> usize {
    let mut depth = 0;
    for (i, c) in text.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return i + 1;
        }
    }
    text.len()
}

/// The `use` declarations: whether the name is given out, the path, and the name.
fn uses(code: &str) -> Vec<(bool, Module, String)> {
    let mut found = Vec::new();
    let words = |text: &str| text.split("::").map(|w| w.trim().to_owned()).collect::<Module>();
    for statement in code.split(';') {
        let Some(at) = statement.find("use ").filter(|&at| is_declaration(statement, at)) else { continue };
        let is_public = statement[..at].trim_end().ends_with("pub")
            || statement[..at].trim_end().ends_with(')') && statement[..at].contains("pub(");
        for tree in expand(statement[at + 4..].trim()) {
            let (path, name) = match tree.split_once(" as ") {
                Some((path, name)) => (words(path), name.trim().to_owned()),
                None => {
                    let mut path = words(&tree);
                    if path.last().is_some_and(|last| last == "self") {
                        path.pop();
                    }
                    let name = path.last().cloned().unwrap_or_default();
                    (path, name)
                }
            };
            found.push((is_public, path, name));
        }
    }
    found
}

fn is_declaration(statement: &str, at: usize) -> bool {
    let before = statement[..at].trim_end();
    before.is_empty() || before.ends_with(['}', ']', ')', '{']) || before.ends_with("pub")
}

/// `a::{b, c::{d, e}}` as `a::b`, `a::c::d`, `a::c::e`.
fn expand(tree: &str) -> Vec<String> {
    let Some(open) = tree.find('{') else { return vec![tree.to_owned()] };
    let prefix = &tree[..open];
    let inside = &tree[open + 1..open + block(&tree[open..]) - 1];
    let mut parts = Vec::new();
    let (mut depth, mut start) = (0, 0);
    for (i, c) in inside.char_indices().chain([(inside.len(), ',')]) {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(inside[start..i].trim());
                start = i + 1;
            }
            _ => {}
        }
    }
    parts.into_iter().filter(|p| !p.is_empty()).flat_map(|p| expand(&format!("{prefix}{p}"))).collect()
}

/// Paths in the code that begin with `crate` or `super`.
fn paths(code: &str) -> Vec<Module> {
    let mut found = Vec::new();
    let mut rest = code;
    while let Some(at) = ["crate::", "super::"].iter().filter_map(|word| rest.find(word)).min() {
        let before = rest[..at].chars().next_back();
        let end = rest[at..]
            .find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'))
            .unwrap_or(rest.len() - at);
        let path = rest[at..at + end].trim_end_matches(':');
        if !before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == '$' || c == ':') {
            found.push(path.split("::").map(str::to_owned).collect());
        }
        rest = &rest[at + end.max(1)..];
    }
    found
}
