//! Finding a file to open or a place to save to: a folder, what is in it, and the path that is being written.

use std::cmp::Ordering;
use std::io;
use std::path::{Component, Path, PathBuf};

use super::document::Source;

/// What the file is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// To be read.
    Open,
    /// To be written.
    Save,
}

/// A folder or a scene file of the folder that is shown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Entry {
    /// Its name in the folder.
    pub(crate) name: String,
    /// Where it is.
    pub(crate) path: PathBuf,
    /// Whether it is a folder, or leads to one.
    pub(crate) is_folder: bool,
}

/// What is to be done after the user has answered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Answer {
    /// Nothing yet.
    Ask,
    /// Read this file.
    Open(PathBuf),
    /// Write this file.
    Save(PathBuf),
}

/// The state of the dialog.
#[derive(Clone, Debug)]
pub(crate) struct Files {
    /// What the file is for.
    pub(crate) purpose: Purpose,
    /// The folder that is shown, absolute.
    pub(crate) folder: PathBuf,
    /// What is in it: folders first.
    pub(crate) entries: Vec<Entry>,
    /// The path as it is written; relative to the folder.
    pub(crate) text: String,
    /// Which entry was chosen last.
    pub(crate) chosen: Option<usize>,
    /// Whether that was by keys, so that it may be out of sight.
    pub(crate) moved: bool,
    /// What went wrong.
    pub(crate) error: Option<String>,
    /// A file that is there already, and would be replaced.
    pub(crate) replace: Option<PathBuf>,
    /// What a file is called as long as nobody says otherwise.
    suggestion: String,
    /// The file of the present scene, which "Save as" may write without asking.
    present: Option<PathBuf>,
}

/// The ending of scene files.
const ENDING: &str = "toml";

impl Files {
    /// Starts in the folder of the present scene, or else in the working directory.
    pub(crate) fn new(purpose: Purpose, source: &Source) -> Self {
        let present = match source {
            Source::File(path) => Some(path.clone()),
            Source::Gallery(_) => None,
        };
        let suggestion = match (purpose, source) {
            (Purpose::Open, _) => String::new(),
            (Purpose::Save, Source::File(_)) => source.name(),
            (Purpose::Save, Source::Gallery(name)) => format!("{}.{ENDING}", name.replace(['/', '\\'], "-")),
        };
        let start = present.as_deref().and_then(Path::parent).unwrap_or(Path::new("")).to_owned();
        let mut files = Self {
            purpose,
            folder: PathBuf::new(),
            entries: Vec::new(),
            text: suggestion.clone(),
            chosen: None,
            moved: false,
            error: None,
            replace: None,
            suggestion,
            present,
        };
        if !files.go(&start) {
            let error = files.error.take();
            files.go(Path::new(""));
            files.error = error;
        }
        files
    }

    /// Shows another folder; where that cannot be read, says so and stays.
    pub(crate) fn go(&mut self, folder: &Path) -> bool {
        let folder = settled(&self.folder.join(folder));
        self.replace = None;
        match list(&folder) {
            Ok(entries) => {
                self.folder = folder;
                self.entries = entries;
                self.chosen = None;
                self.error = None;
                true
            }
            Err(error) => {
                self.error = Some(format!("{} cannot be shown: {}", folder.display(), plain(&error)));
                if self.folder.as_os_str().is_empty() {
                    self.folder = folder;
                }
                false
            }
        }
    }

    /// Shows the folder that this one is in.
    pub(crate) fn go_up(&mut self) {
        if let Some(parent) = self.folder.parent().map(Path::to_owned) {
            self.go(&parent);
        }
    }

    /// Chooses an entry: a file's name is then the path that is written.
    pub(crate) fn choose(&mut self, index: usize) {
        let Some(entry) = self.entries.get(index) else { return };
        self.chosen = Some(index);
        self.error = None;
        self.replace = None;
        // To save into a folder one goes into it; the name of the file stays.
        if !(entry.is_folder && self.purpose == Purpose::Save) {
            self.text = entry.name.clone();
        }
    }

    /// Chooses the next entry, or the one before.
    pub(crate) fn step(&mut self, forward: bool) {
        let last = self.entries.len().saturating_sub(1);
        let index = match (self.chosen, forward) {
            (None, true) => 0,
            (None, false) => last,
            (Some(i), true) => (i + 1).min(last),
            (Some(i), false) => i.saturating_sub(1),
        };
        self.choose(index);
        self.moved = true;
    }

    /// Goes into an entry that is a folder, or takes it if it is a file.
    pub(crate) fn enter(&mut self, index: usize) -> Answer {
        let Some(entry) = self.entries.get(index).cloned() else { return Answer::Ask };
        if entry.is_folder {
            if self.go(&entry.path) && self.purpose == Purpose::Open {
                self.text.clear();
            }
            return Answer::Ask;
        }
        self.choose(index);
        self.take(entry.path)
    }

    /// The path was edited: what was said of the old one no longer holds.
    pub(crate) fn edited(&mut self) {
        self.chosen = None;
        self.error = None;
        self.replace = None;
    }

    /// Takes what is chosen or written.
    pub(crate) fn submit(&mut self) -> Answer {
        self.replace = None;
        // A name that is no text is known by its entry alone.
        if let Some((index, entry)) = self.chosen.and_then(|i| Some((i, self.entries.get(i)?)))
            && (entry.is_folder || entry.name == self.text)
        {
            return self.enter(index);
        }
        let text = self.text.trim();
        if text.is_empty() {
            self.error = Some("write a path or choose a file".into());
            return Answer::Ask;
        }
        let path = complete(&self.folder, std::env::home_dir().as_deref(), text);
        if path.is_dir() {
            if self.go(&path) {
                self.text = self.suggestion.clone();
            }
            return Answer::Ask;
        }
        if text.ends_with(std::path::is_separator) {
            self.error = Some(format!("there is no folder {}", path.display()));
            return Answer::Ask;
        }
        self.take(path)
    }

    /// Replaces the file that was asked for.
    pub(crate) fn replace(&mut self) -> Answer {
        self.replace.take().map_or(Answer::Ask, Answer::Save)
    }

    fn take(&mut self, path: PathBuf) -> Answer {
        self.error = None;
        match self.purpose {
            Purpose::Open => {
                let ended = with_ending(&path);
                Answer::Open(if !path.exists() && ended.exists() { ended } else { path })
            }
            Purpose::Save => {
                let path = with_ending(&path);
                if path.is_dir() {
                    self.error = Some(format!("{} is a folder", path.display()));
                    return Answer::Ask;
                }
                if let Some(folder) = path.parent().filter(|folder| !folder.is_dir()) {
                    self.error = Some(format!("there is no folder {}", folder.display()));
                    return Answer::Ask;
                }
                let own = self.present.as_deref().is_some_and(|present| settled(present) == settled(&path));
                if path.exists() && !own {
                    self.replace = Some(path);
                    return Answer::Ask;
                }
                Answer::Save(path)
            }
        }
    }
}

/// What somebody wrote as a path: `~` is the home, and what is not absolute is in the folder.
fn complete(folder: &Path, home: Option<&Path>, text: &str) -> PathBuf {
    let path = Path::new(text);
    match (home, path.strip_prefix("~")) {
        (Some(home), Ok(rest)) if rest.as_os_str().is_empty() => home.to_owned(),
        (Some(home), Ok(rest)) => home.join(rest),
        _ => folder.join(path),
    }
}

/// With the ending of scene files, if it has none.
fn with_ending(path: &Path) -> PathBuf {
    if path.extension().is_some() { path.to_owned() } else { path.with_extension(ENDING) }
}

/// Absolute and without detours, as far as it exists.
fn settled(path: &Path) -> PathBuf {
    let path = std::path::absolute(if path.as_os_str().is_empty() { Path::new(".") } else { path })
        .unwrap_or_else(|_| path.to_owned());
    // On Windows canonical paths are not what people write.
    if cfg!(windows) || !path.components().any(|part| part == Component::ParentDir) && !path.is_symlink() {
        return path;
    }
    path.canonicalize().unwrap_or(path)
}

/// Folders and scene files of a folder that are not hidden: folders first, each by name.
fn list(folder: &Path) -> io::Result<Vec<Entry>> {
    let mut entries = Vec::new();
    for entry in folder.read_dir()? {
        let entry = entry?;
        let path = entry.path();
        let name = entry.file_name().to_string_lossy().into_owned();
        if name.starts_with('.') {
            continue;
        }
        let kind = entry.file_type()?;
        let is_folder = if kind.is_symlink() { path.is_dir() } else { kind.is_dir() };
        if is_folder || path.extension().is_some_and(|e| e.eq_ignore_ascii_case(ENDING)) {
            entries.push(Entry { name, path, is_folder });
        }
    }
    entries.sort_by(order);
    Ok(entries)
}

fn order(a: &Entry, b: &Entry) -> Ordering {
    let lower = |entry: &Entry| entry.name.to_lowercase();
    b.is_folder.cmp(&a.is_folder).then_with(|| lower(a).cmp(&lower(b))).then_with(|| a.name.cmp(&b.name))
}

/// An error of the system without its number.
fn plain(error: &io::Error) -> String {
    let text = error.to_string().to_lowercase();
    text.split(" (os error").next().unwrap_or_default().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder() -> tempfile::TempDir {
        let folder = tempfile::tempdir().expect("a folder");
        for name in ["b.toml", "A.TOML", "c.txt", ".hidden.toml"] {
            std::fs::write(folder.path().join(name), "x").expect("written");
        }
        for name in ["zoo", ".git", "Attic"] {
            std::fs::create_dir(folder.path().join(name)).expect("made");
        }
        folder
    }

    fn files(purpose: Purpose, folder: &Path) -> Files {
        Files::new(purpose, &Source::File(folder.join("b.toml")))
    }

    #[test]
    fn folders_first_then_scenes() {
        let folder = folder();
        let files = files(Purpose::Open, folder.path());
        let names: Vec<&str> = files.entries.iter().map(|entry| entry.name.as_str()).collect();
        assert_eq!(names, ["Attic", "zoo", "A.TOML", "b.toml"], "nothing hidden, nothing else");
        assert_eq!(files.folder, folder.path(), "in the scene's folder");
    }

    #[test]
    fn paths_as_people_write_them() {
        let at = |text| complete(Path::new("/here"), Some(Path::new("/home/me")), text);
        assert_eq!(at("a.toml"), Path::new("/here/a.toml"), "in the folder");
        assert_eq!(at("../a"), Path::new("/here/../a"), "beside it");
        assert_eq!(at("/x/a"), Path::new("/x/a"), "anywhere");
        assert_eq!(at("~/a"), Path::new("/home/me/a"), "at home");
        assert_eq!(at("~"), Path::new("/home/me"), "home itself");
        assert_eq!(at("~a"), Path::new("/here/~a"), "a name with a tilde");
    }

    #[test]
    fn opening() {
        let folder = folder();
        let mut files = files(Purpose::Open, folder.path());
        assert_eq!(files.submit(), Answer::Ask, "nothing was written");
        assert!(files.error.is_some(), "which it says");
        files.text = "b".into();
        files.edited();
        assert_eq!(files.submit(), Answer::Open(folder.path().join("b.toml")), "without the ending");
        files.step(true);
        assert_eq!((files.chosen, files.text.as_str()), (Some(0), "Attic"), "the first of the list");
        assert_eq!(files.submit(), Answer::Ask, "a folder");
        assert_eq!((&files.folder, files.text.as_str()), (&folder.path().join("Attic"), ""), "is gone into");
        assert!(files.entries.is_empty(), "there is nothing");
        files.step(false);
        files.go_up();
        assert_eq!(files.folder, folder.path(), "and back");
        files.text = "../".into();
        files.submit();
        assert_eq!(Some(files.folder.as_path()), folder.path().parent(), "without detours");
    }

    #[test]
    fn what_cannot_be_shown() {
        let folder = folder();
        let mut files = files(Purpose::Open, folder.path());
        assert!(!files.go(Path::new("nowhere")), "it is not there");
        assert!(files.error.as_ref().is_some_and(|e| e.contains("nowhere")), "{:?}", files.error);
        assert_eq!((files.folder.as_path(), files.entries.len()), (folder.path(), 4), "it stays");
        files.text = "nowhere/".into();
        files.edited();
        assert_eq!(files.submit(), Answer::Ask, "no file ends so");
        assert!(files.error.is_some(), "which it says");
        let gone = Files::new(Purpose::Open, &Source::File("/nowhere/at/all/x.toml".into()));
        assert!(gone.error.is_some() && gone.folder.is_absolute(), "begins where it can: {gone:?}");
    }

    #[test]
    fn saving() {
        let folder = folder();
        let mut files = files(Purpose::Save, folder.path());
        assert_eq!(files.text, "b.toml", "the scene's own name");
        assert_eq!(
            files.submit(),
            Answer::Save(folder.path().join("b.toml")),
            "its own file is not asked for"
        );
        files.text = "new.v2".into();
        assert_eq!(files.submit(), Answer::Save(folder.path().join("new.v2")), "an ending of one's own");
        files.text = "new".into();
        assert_eq!(files.submit(), Answer::Save(folder.path().join("new.toml")), "or else that of scenes");
        files.text = "A.TOML".into();
        assert_eq!(files.submit(), Answer::Ask, "another one");
        assert_eq!(files.replace, Some(folder.path().join("A.TOML")), "is asked for");
        files.edited();
        assert_eq!(files.replace, None, "no longer when something else is written");
        assert_eq!(files.replace(), Answer::Ask, "nothing is replaced unasked");
        assert_eq!(files.submit(), Answer::Ask, "asked again");
        assert_eq!(files.submit(), Answer::Ask, "for as long as nobody answers");
        assert_eq!(files.replace(), Answer::Save(folder.path().join("A.TOML")), "and told to");
        files.text = "nowhere/new".into();
        files.edited();
        assert_eq!(files.submit(), Answer::Ask, "where there is no folder");
        assert!(files.error.as_ref().is_some_and(|e| e.contains("nowhere")), "it says so: {:?}", files.error);
        files.text = "../".into();
        files.submit();
        assert_eq!(files.text, "b.toml", "in another folder the name is suggested again");
        files.go(folder.path());
        files.text = "A.TOML".into();
        files.choose(1);
        assert_eq!(files.text, "A.TOML", "a folder does not change the name");
        assert_eq!(files.submit(), Answer::Ask, "but is gone into");
        assert_eq!(files.folder, folder.path().join("zoo"), "with the name kept");
        assert_eq!(files.submit(), Answer::Save(folder.path().join("zoo/A.TOML")), "where there is none");
    }

    #[test]
    fn a_scene_of_the_gallery_has_a_name() {
        let files = Files::new(Purpose::Save, &Source::Gallery("papers/one".into()));
        assert_eq!(files.text, "papers-one.toml", "that a file can have");
        assert_eq!(Some(files.folder), std::env::current_dir().ok(), "where the program was started");
    }
}
