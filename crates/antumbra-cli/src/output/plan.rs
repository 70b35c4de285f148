//! Where the pictures go: checked before the long work, so that it is not in vain.

use std::collections::HashMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use antumbra_scene::Light;

use super::staged::{Staged, parent, probe, target};
use super::{Format, Picture, png};
use crate::error::CliError;

/// The longest light name that names a file, bytes: file systems allow 255 with the extension.
const MAX_NAME: usize = 200;

/// The files that one command writes.
pub(crate) struct Plan {
    /// The picture.
    picture: PathBuf,
    format: Format,
    /// The directory of the visibilities, and a file for each light.
    visibility: Option<(PathBuf, Vec<PathBuf>)>,
}

impl Plan {
    /// A picture of the scene file `scene` at `output`; where `visibility` names a directory, also a file in it for
    /// each of `lights`.
    ///
    /// # Errors
    /// [`CliError::Output`] with what is in the way: an extension of no known format, a directory in place of a file
    /// or the reverse, a missing or read-only directory, light names that cannot name files, two outputs at one path,
    /// an output in place of the scene.
    pub(crate) fn new(
        scene: &Path,
        output: &Path,
        visibility: Option<&Path>,
        lights: &[Light],
    ) -> Result<Self, CliError> {
        let format = match extension(output, ["png", "exr"])? {
            "exr" => Format::Exr,
            _ => Format::Png,
        };
        let picture = destination(scene, output)?;
        let Some(directory) = visibility else {
            return Ok(Self { picture, format, visibility: None });
        };

        check_directory(directory)?;
        if place(directory) == place(&picture) {
            return Err(CliError::output(directory, "is the picture too; name another directory"));
        }
        let mut files = Vec::with_capacity(lights.len());
        let mut seen: HashMap<PathBuf, &str> = HashMap::new();
        for light in lights {
            let file = directory.join(file_name(directory, &light.name)?);
            let written = place(&check_file(&file)?);
            if let Some(other) = seen.insert(folded(&written), &light.name) {
                let what = format!("lights `{other}` and `{}` would write one file; rename one", light.name);
                return Err(CliError::output(directory, what));
            }
            refuse_scene(scene, &file)?;
            if written == place(&picture) {
                let what = format!(
                    "is the picture and the visibility of light `{}`; name another picture or directory",
                    light.name
                );
                return Err(CliError::output(&file, what));
            }
            files.push(file);
        }
        Ok(Self { picture, format, visibility: Some((directory.to_owned(), files)) })
    }

    /// Writes everything, or leaves nothing new: `visibility` holds one picture for each light that [`Plan::new`] saw.
    /// Returns what was written.
    ///
    /// # Errors
    /// [`CliError::Output`] for the first file that cannot be written.
    pub(crate) fn write(self, picture: &Picture, visibility: &[Vec<u16>]) -> Result<Vec<PathBuf>, CliError> {
        let mut staged = Staged::default();
        staged.file(&self.picture, |to| picture.write(self.format, to))?;
        let mut written = vec![self.picture];
        if let Some((directory, files)) = self.visibility {
            staged.directory(&directory)?;
            for (file, levels) in files.iter().zip(visibility) {
                staged.file(file, |to| png::write_visibility(picture.width, picture.height, levels, to))?;
            }
            written.extend(files);
        }
        staged.commit()?;
        Ok(written)
    }
}

/// Checks that a directory can be written to; where it is missing, that it can be made.
///
/// # Errors
/// [`CliError::Output`] with what is in the way.
pub(crate) fn check_directory(directory: &Path) -> Result<(), CliError> {
    match fs::metadata(directory) {
        Ok(about) if about.is_dir() => probe_directory(directory),
        Ok(_) => Err(CliError::output(directory, "is not a directory; name a directory")),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            if directory.symlink_metadata().is_ok() {
                return Err(CliError::output(directory, "is a link to nothing; name a directory"));
            }
            probe_directory(parent(directory))
        }
        Err(error) => Err(CliError::output(directory, format!("cannot be used: {error}"))),
    }
}

/// Checks that `path` is free, or a plain file that may be replaced, or a link to where that is so. Returns the file that
/// writing to it makes or replaces.
///
/// # Errors
/// [`CliError::Output`] with what is in the way.
pub(crate) fn check_file(path: &Path) -> Result<PathBuf, CliError> {
    let file = target(path).map_err(|error| CliError::output(path, format!("cannot be written: {error}")))?;
    if file != path
        && let Err(error) = probe_directory(parent(&file))
    {
        return Err(CliError::output(path, format!("is a link to {}; {error}", file.display())));
    }
    match file.symlink_metadata() {
        Ok(about) if about.is_dir() => Err(CliError::output(path, "is a directory; name a file")),
        Ok(about) if !about.is_file() => {
            Err(CliError::output(path, "is a device or the like; name a plain file"))
        }
        Ok(_) => Ok(file),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(file),
        Err(error) => Err(CliError::output(path, format!("cannot be written: {error}"))),
    }
}

/// The extension of `output`, in lower case: one of two.
///
/// # Errors
/// [`CliError::Output`] for any other, and for a directory.
pub(crate) fn extension(output: &Path, known: [&'static str; 2]) -> Result<&'static str, CliError> {
    let [first, second] = known;
    if output.is_dir() {
        return Err(CliError::output(
            output,
            format!("is a directory; name a file, such as picture.{first}"),
        ));
    }
    if output.as_os_str().as_encoded_bytes().last().is_some_and(|&byte| std::path::is_separator(byte.into()))
    {
        let what = format!("names a directory; name a file, such as picture.{first}");
        return Err(CliError::output(output, what));
    }
    let extension = output.extension().map(|extension| extension.to_ascii_lowercase());
    known.into_iter().find(|known| extension.as_ref().is_some_and(|it| it == known)).ok_or_else(|| {
        let what = format!("is in no format known here; end the name in .{first} or .{second}");
        CliError::output(output, what)
    })
}

/// The file that writing to `output` makes or replaces, for what is made of the scene file `scene`.
///
/// # Errors
/// [`CliError::Output`] with what is in the way, as [`Plan::new`].
pub(crate) fn destination(scene: &Path, output: &Path) -> Result<PathBuf, CliError> {
    let file = check_file(output)?;
    refuse_scene(scene, &file)?;
    probe_directory(parent(&file))?;
    Ok(file)
}

fn probe_directory(directory: &Path) -> Result<(), CliError> {
    match fs::metadata(directory) {
        Ok(about) if !about.is_dir() => {
            return Err(CliError::output(directory, "is not a directory; name a file in a directory"));
        }
        Ok(_) => {}
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            return Err(CliError::output(directory, "there is no such directory; make it first"));
        }
        Err(error) => return Err(CliError::output(directory, format!("cannot be used: {error}"))),
    }
    probe(directory).map_err(|error| {
        CliError::output(directory, format!("cannot write in this directory: {error}; choose another"))
    })
}

fn refuse_scene(scene: &Path, output: &Path) -> Result<(), CliError> {
    match (scene.canonicalize(), output.canonicalize()) {
        (Ok(scene), Ok(output)) if scene == output => {
            Err(CliError::output(&output, "is the scene file itself; name another file"))
        }
        _ => Ok(()),
    }
}

/// The file of a light in the directory of the visibilities.
fn file_name(directory: &Path, light: &str) -> Result<String, CliError> {
    let forbidden = |c: char| c.is_control() || std::path::is_separator(c) || matches!(c, '/' | '\\');
    if light.is_empty() || light == "." || light == ".." || light.contains(forbidden) {
        let what = format!("light `{light}` cannot name a file; rename it, with letters and digits");
        return Err(CliError::output(directory, what));
    }
    if light.len() > MAX_NAME {
        let start: String = light.chars().take(24).collect();
        let what = format!("the name of light `{start}...` is too long for a file; shorten it");
        return Err(CliError::output(directory, what));
    }
    Ok(format!("{light}.png"))
}

/// A path as the usual file system of the platform compares it.
fn folded(path: &Path) -> PathBuf {
    if cfg!(any(windows, target_os = "macos")) {
        path.to_string_lossy().to_lowercase().into()
    } else {
        path.to_owned()
    }
}

/// Where a path leads, for comparing two that are written differently. The last component need not exist.
fn place(path: &Path) -> PathBuf {
    let directory = parent(path);
    let directory = directory.canonicalize().unwrap_or_else(|_| directory.to_owned());
    match path.file_name() {
        Some(name) => directory.join(name),
        None => path.canonicalize().unwrap_or_else(|_| path.to_owned()),
    }
}
