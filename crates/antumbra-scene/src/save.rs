//! Writing scene files.

use std::cell::Cell;
use std::fs::{File, Metadata};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use crate::error::unsaved;
use crate::limits::MAX_SCENE_BYTES;
use crate::tree::{self, Node};
use crate::update::updated;
use crate::write::text;
use crate::{Scene, SceneError};

impl Scene {
    /// Writes the scene to the file at `path`. Reading it again gives the same scene.
    ///
    /// `loaded_from` is the file that the scene was read from, if it was read from one. What a person
    /// wrote there is kept as [`Scene::update_toml`] keeps it, also in a copy at another path; without
    /// it, what is at `path`, and mesh paths are written as they are. Relative mesh paths of a scene that goes to another folder are written so
    /// that they lead to the same files. The scene in memory keeps its mesh paths, which are still
    /// relative to `loaded_from`: either give that again next time, or load what was written.
    ///
    /// The file is there as a whole or not at all: it is written beside its place and then put there. A
    /// symbolic link stays one, and the permissions of a file that is replaced are kept.
    ///
    /// # Errors
    /// If the scene is not one that a file can hold (see [`Scene::validate`]), or the file cannot be
    /// written. What was at `path` before is then unchanged.
    pub fn save(&self, path: &Path, loaded_from: Option<&Path>) -> Result<(), SceneError> {
        let lost = Cell::new(false);
        let new = tree::scene(self, &|mesh| {
            mesh_path(mesh, loaded_from, path).unwrap_or_else(|| {
                lost.set(true);
                mesh.to_owned()
            })
        });
        if lost.get() {
            let what = "the path to one of its meshes is not UTF-8";
            return Err(unsaved(path, what, "save it to the folder that it was loaded from"));
        }
        let text = match loaded_from.and_then(readable).or_else(|| readable(path)) {
            Some(original) => updated(&new, &original),
            None => text(&new),
        };
        let text = if text.len() > MAX_SCENE_BYTES { self::text(&new) } else { text };
        check(&new, &text, path)?;
        write(path, &text).map_err(|error| unsaved(path, error, "choose a file that can be written"))
    }
}

/// Refuses text that would not be read as the scene it is of.
fn check(scene: &Node, text: &str, path: &Path) -> Result<(), SceneError> {
    match Scene::parse_text(text, path) {
        Err(error) => Err(unsaved(path, error.what(), error.instead())),
        Ok(read) if tree::scene(&read, &str::to_owned) == *scene => Ok(()),
        Ok(_) => Err(unsaved(path, "it is none that a file can hold", "undo the last change")),
    }
}

/// What a file says, if it is the text of a scene.
fn readable(path: &Path) -> Option<String> {
    let file = File::open(path).ok().filter(|f| f.metadata().is_ok_and(|about| about.is_file()))?;
    let mut text = String::new();
    file.take(MAX_SCENE_BYTES as u64 + 1).read_to_string(&mut text).ok()?;
    Scene::parse_text(&text, path).is_ok().then_some(text)
}

/// The path of a mesh, as a scene file at `from` gives it, for a scene file at `to`; `None` if it is not
/// UTF-8.
fn mesh_path(mesh: &str, from: Option<&Path>, to: &Path) -> Option<String> {
    let Some(from) = from.map(folder) else { return Some(mesh.to_owned()) };
    let to = folder(to);
    if Path::new(mesh).is_absolute() || resolved(&from) == resolved(&to) {
        return Some(mesh.to_owned());
    }
    // Links are followed up to the folder and not beyond: a mesh's own name says what format it has.
    let file = from.join(mesh);
    let target = match (file.parent(), file.file_name()) {
        (Some(parent), Some(name)) => resolved(parent).join(name),
        _ => file,
    };
    let relative = pathdiff::diff_paths(&target, resolved(&to)).unwrap_or(target);
    if relative.is_absolute() {
        return relative.to_str().map(str::to_owned);
    }
    // With the slashes that every system reads.
    let steps: Option<Vec<&str>> = relative.iter().map(|step| step.to_str()).collect();
    steps.map(|steps| steps.join("/"))
}

/// Where a file is.
fn folder(file: &Path) -> PathBuf {
    match file.parent() {
        Some(parent) if parent != Path::new("") => parent.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// A folder's one name, or as near as can be if there is no such folder.
fn resolved(folder: &Path) -> PathBuf {
    let folder = if folder == Path::new("") { Path::new(".") } else { folder };
    std::fs::canonicalize(folder)
        .or_else(|_| std::path::absolute(folder))
        .unwrap_or_else(|_| folder.to_owned())
}

/// Puts a file with this text at `path`, in one step.
fn write(path: &Path, text: &str) -> std::io::Result<()> {
    let before = match std::fs::metadata(path) {
        Ok(about) if !about.is_file() => return Err(std::io::Error::other("it is not a regular file")),
        Ok(about) => Some(about),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => None,
        Err(error) => return Err(error),
    };
    // Through a link to what it stands for.
    let place = if before.is_some() { std::fs::canonicalize(path)? } else { path.to_owned() };
    if before.as_ref().is_some_and(|about| about.permissions().readonly()) {
        return Err(std::io::ErrorKind::PermissionDenied.into());
    }
    let mut file = create_in(&folder(&place), before.as_ref())?;
    file.write_all(text.as_bytes())?;
    file.as_file().sync_all()?;
    file.persist(&place).map_err(|error| error.error)?;
    Ok(())
}

/// A file of its own in a folder, which others may read as they may the one before or any new one.
fn create_in(folder: &Path, before: Option<&Metadata>) -> std::io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".scene-").suffix(".toml.new");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    let file = builder.tempfile_in(folder)?;
    if let Some(before) = before {
        file.as_file().set_permissions(before.permissions())?;
    }
    Ok(file)
}
