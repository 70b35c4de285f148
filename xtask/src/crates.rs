//! The crates of the workspace, read from its folders.

use std::fs;
use std::path::Path;

/// One crate of the workspace.
#[derive(Debug)]
pub(crate) struct Crate {
    /// Its name.
    pub(crate) name: String,
    /// Whether it has features to choose.
    pub(crate) has_features: bool,
    /// Whether it goes to a registry.
    pub(crate) is_published: bool,
}

/// The crates of the workspace in `root`, by name.
///
/// # Errors
/// The manifest that cannot be read, or has no name.
pub(crate) fn all(root: &Path) -> Result<Vec<Crate>, String> {
    let mut manifests = Vec::new();
    for folder in ["crates", "apps"] {
        let folder = root.join(folder);
        let entries = fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        manifests.extend(entries.flatten().map(|entry| entry.path().join("Cargo.toml")));
    }
    let mut crates = manifests.iter().map(|manifest| read(manifest)).collect::<Result<Vec<_>, _>>()?;
    crates.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(crates)
}

fn read(manifest: &Path) -> Result<Crate, String> {
    let text = fs::read_to_string(manifest).map_err(|error| format!("{}: {error}", manifest.display()))?;
    let name = text
        .lines()
        .find_map(|line| line.strip_prefix("name = "))
        .ok_or_else(|| format!("{}: no line `name = ..`", manifest.display()))?;
    Ok(Crate {
        name: name.trim_matches('"').to_owned(),
        has_features: text.lines().any(|line| line == "[features]"),
        is_published: !text.lines().any(|line| line == "publish = false"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn this_workspace() {
        let crates = all(&Path::new(env!("CARGO_MANIFEST_DIR")).join("..")).expect("it can be read");
        let names: Vec<_> = crates.iter().map(|each| each.name.as_str()).collect();
        for name in ["antumbra", "antumbra-gl", "antumbra-viewer"] {
            assert!(names.contains(&name), "{name} in {names:?}");
        }
        let program = crates.iter().find(|each| each.name == "antumbra-cli").expect("the program is there");
        assert!(program.has_features && program.is_published, "{program:?}");
    }

    #[test]
    fn what_cannot_be_read_is_named() {
        let empty = std::env::temp_dir().join("no-workspace-is-here");
        let error = all(&empty).expect_err("there is none");
        assert!(error.contains("no-workspace-is-here"), "{error}");
    }
}
