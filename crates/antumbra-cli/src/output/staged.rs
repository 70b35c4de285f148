//! Files that appear whole or not at all: each is written beside its destination under a temporary name, and all are
//! renamed at the end. A temporary one is removed whatever ends the program, but for a kill that no program can catch.

use std::fs::{self, File, Metadata};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{NamedTempFile, TempPath};

use crate::error::CliError;

/// What exists under a temporary name right now, for [`abandon`]. Whoever creates, renames or removes
/// such a thing holds the lock meanwhile, so that a signal falls between two steps and never within one.
static PENDING: Mutex<Pending> = Mutex::new(Pending { files: Vec::new(), directories: Vec::new() });

struct Pending {
    files: Vec<PathBuf>,
    directories: Vec<PathBuf>,
}

fn pending() -> MutexGuard<'static, Pending> {
    PENDING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes what has a temporary name, and ends the program.
pub(crate) fn abandon(code: i32) -> ! {
    // Held until the end, so that nothing new comes to be.
    let pending = pending();
    for file in &pending.files {
        let _ = fs::remove_file(file);
    }
    for directory in pending.directories.iter().rev() {
        let _ = fs::remove_dir(directory);
    }
    std::process::exit(code);
}

/// Whether a file can be made in a directory: makes one under a temporary name and removes it.
///
/// # Errors
/// What the file system says.
pub(crate) fn probe(directory: &Path) -> io::Result<()> {
    // Nothing is left to clean up: the lock keeps a signal out until the file is gone again.
    let _pending = pending();
    temporary(directory, None)?.close()
}

/// A file under a temporary name, with the permissions of the one that it will replace, or those of any new file.
fn temporary(directory: &Path, before: Option<&Metadata>) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".antumbra-").suffix(".tmp");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // What any other new file gets, less the umask; a temporary file's own default is for its owner alone.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let file = builder.tempfile_in(directory)?;
    #[cfg(unix)]
    if let Some(before) = before {
        file.as_file().set_permissions(before.permissions())?;
    }
    #[cfg(not(unix))]
    let _ = before;
    Ok(file)
}

/// The file that writing to `path` makes or replaces: a link is followed, also where nothing is yet.
///
/// # Errors
/// That there are too many links: they may lead in a circle.
pub(crate) fn target(path: &Path) -> io::Result<PathBuf> {
    let mut file = path.to_owned();
    // As many as Linux follows.
    for _ in 0..40 {
        match fs::read_link(&file) {
            Ok(to) => file = file.parent().unwrap_or(Path::new("")).join(to),
            // No link, or nothing.
            Err(_) => return Ok(file),
        }
    }
    Err(io::Error::other("too many links, one to the other; name a file"))
}

/// Files on their way. Dropped before [`Staged::commit`], it leaves nothing behind.
#[derive(Default)]
pub(crate) struct Staged {
    files: Vec<(TempPath, PathBuf)>,
    directories: Vec<PathBuf>,
}

impl Staged {
    /// Makes a directory if it is missing (its parent must exist).
    ///
    /// # Errors
    /// [`CliError::Output`] where it cannot be made.
    pub(crate) fn directory(&mut self, path: &Path) -> Result<(), CliError> {
        let mut pending = pending();
        match fs::create_dir(path) {
            Ok(()) => {
                self.directories.push(path.to_owned());
                pending.directories.push(path.to_owned());
                Ok(())
            }
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists && path.is_dir() => Ok(()),
            Err(error) => Err(CliError::output(path, format!("cannot make the directory: {error}"))),
        }
    }

    /// Writes one file under a temporary name, in the directory of the file that `path` is or is a link to.
    ///
    /// # Errors
    /// [`CliError::Output`] where it cannot be written; another [`CliError`] that `write` wrapped by
    /// [`io::Error::other`] comes back as it was.
    pub(crate) fn file(
        &mut self,
        path: &Path,
        write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>,
    ) -> Result<(), CliError> {
        let failed = |error: io::Error| {
            error
                .downcast::<CliError>()
                .unwrap_or_else(|error| CliError::output(path, format!("cannot write: {error}")))
        };
        let place = target(path).map_err(failed)?;
        let file = {
            let mut pending = pending();
            let before = fs::metadata(&place).ok();
            let file = temporary(parent(&place), before.as_ref()).map_err(failed)?;
            pending.files.push(file.path().to_owned());
            file
        };
        let (file, temporary) = file.into_parts();
        // From here on dropping `self` removes the file.
        self.files.push((temporary, place));
        let mut writer = BufWriter::new(&file);
        write(&mut writer).and_then(|()| writer.flush()).map_err(failed)?;
        drop(writer);
        // On disk before it takes its name: not even a crash leaves a partial file.
        file.sync_all().map_err(failed)
    }

    /// Gives every file its name; what had one of the names before is replaced. No signal comes between two of them.
    ///
    /// # Errors
    /// [`CliError::Output`] for the first that fails. Those that did not exist before are removed again; those that
    /// were replaced until then, each as a whole, stay.
    pub(crate) fn commit(mut self) -> Result<(), CliError> {
        let mut pending = pending();
        let mut made: Vec<PathBuf> = Vec::new();
        for (temporary, path) in std::mem::take(&mut self.files) {
            let existed = path.symlink_metadata().is_ok();
            let name = temporary.to_path_buf();
            if let Err(error) = temporary.persist(&path) {
                for file in &made {
                    let _ = fs::remove_file(file);
                }
                let what = format!("cannot write: {}", error.error);
                drop(error);
                drop(pending);
                return Err(CliError::Output { path, what });
            }
            pending.files.retain(|file| *file != name);
            if !existed {
                made.push(path);
            }
        }
        let kept = std::mem::take(&mut self.directories);
        pending.directories.retain(|directory| !kept.contains(directory));
        Ok(())
    }
}

impl Drop for Staged {
    fn drop(&mut self) {
        if self.files.is_empty() && self.directories.is_empty() {
            return;
        }
        let mut pending = pending();
        for (temporary, _) in self.files.drain(..) {
            let name = temporary.to_path_buf();
            let _ = temporary.close();
            pending.files.retain(|file| *file != name);
        }
        for directory in self.directories.drain(..).rev() {
            let _ = fs::remove_dir(&directory);
            pending.directories.retain(|other| *other != directory);
        }
    }
}

/// The directory that a file is in; `.` for a bare name.
pub(crate) fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entries(directory: &Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(directory)
            .expect("the directory is there")
            .map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn all_files_appear_at_commit() {
        let home = tempfile::tempdir().expect("a temporary directory");
        let masks = home.path().join("masks");
        let mut staged = Staged::default();
        staged.directory(&masks).expect("its parent exists");
        staged.file(&home.path().join("a.png"), |to| to.write_all(b"a")).expect("writable");
        staged.file(&masks.join("b.png"), |to| to.write_all(b"b")).expect("writable");
        assert!(!home.path().join("a.png").exists(), "not before the commit");
        staged.commit().expect("nothing is in the way");
        assert_eq!(entries(home.path()), ["a.png", "masks"], "the files and no temporary one");
        assert_eq!(entries(&masks), ["b.png"], "the file and no temporary one");
        assert_eq!(fs::read(home.path().join("a.png")).expect("readable"), b"a", "what was written");
    }

    #[test]
    fn nothing_stays_when_one_write_fails() {
        let home = tempfile::tempdir().expect("a temporary directory");
        let mut staged = Staged::default();
        staged.directory(&home.path().join("masks")).expect("its parent exists");
        staged.file(&home.path().join("a.png"), |to| to.write_all(b"a")).expect("writable");
        let full = staged.file(&home.path().join("masks/b.png"), |to| {
            to.write_all(b"half")?;
            Err(io::Error::other("the disk is full"))
        });
        assert!(full.is_err(), "the writer's error is passed on");
        drop(staged);
        assert!(entries(home.path()).is_empty(), "neither files nor the directory stay");
    }

    #[test]
    fn nothing_new_stays_when_one_name_cannot_be_taken() {
        let home = tempfile::tempdir().expect("a temporary directory");
        let blocked = home.path().join("b.png");
        let mut staged = Staged::default();
        staged.directory(&home.path().join("masks")).expect("its parent exists");
        staged.file(&home.path().join("a.png"), |to| to.write_all(b"a")).expect("writable");
        staged.file(&blocked, |to| to.write_all(b"b")).expect("writable");
        staged.file(&home.path().join("masks/c.png"), |to| to.write_all(b"c")).expect("writable");
        fs::create_dir(&blocked).expect("a directory takes the name");
        assert!(staged.commit().is_err(), "a file cannot replace a directory");
        assert_eq!(entries(home.path()), ["b.png"], "only what was in the way");
    }

    #[cfg(unix)]
    #[test]
    fn files_have_ordinary_permissions() {
        use std::os::unix::fs::PermissionsExt;
        let home = tempfile::tempdir().expect("a temporary directory");
        let plain = home.path().join("plain");
        fs::write(&plain, b"").expect("writable");
        let path = home.path().join("a.png");
        let mut staged = Staged::default();
        staged.file(&path, |to| to.write_all(b"a")).expect("writable");
        staged.commit().expect("nothing is in the way");
        let mode = |path: &Path| fs::metadata(path).expect("it exists").permissions().mode();
        assert_eq!(mode(&path), mode(&plain), "as any other new file");
    }
}
