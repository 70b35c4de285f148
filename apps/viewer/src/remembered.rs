//! What the program remembers from one start to the next, in a small file where the system keeps such.

use std::io::Write;
use std::path::{Path, PathBuf};

use antumbra::glam::DVec3;
use antumbra_scene::Camera;
use etcetera::BaseStrategy;
use serde::{Deserialize, Serialize};

use crate::model::Model;
use crate::model::camera;
use crate::model::clock::Clock;
use crate::model::document::Source;
use crate::model::settings::Settings;

/// All of it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(crate) struct Remembered {
    /// What was looked at, and how.
    pub(crate) settings: Settings,
    /// The scene's file, if it had one.
    file: Option<PathBuf>,
    /// Its name in the gallery, if it came from there.
    gallery: Option<String>,
    /// Where the eye was.
    camera: Option<Eye>,
    /// The scene's time.
    clock: Clock,
    /// Size of the window in points, and whether it filled the screen.
    pub(crate) size: Option<[u32; 2]>,
    /// See `size`.
    pub(crate) maximized: bool,
}

/// A camera.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Eye {
    eye: [f64; 3],
    target: [f64; 3],
    up: [f64; 3],
    /// Radians.
    fov_y: f64,
}

/// Where it is kept; `None` where the system says no place.
fn path() -> Option<PathBuf> {
    Some(etcetera::choose_base_strategy().ok()?.config_dir().join("antumbra").join("viewer.json"))
}

impl Remembered {
    /// What was remembered; the defaults if there is nothing, or nothing that can be read.
    pub(crate) fn load() -> Self {
        path().and_then(|path| Self::read(&path)).unwrap_or_default()
    }

    fn read(path: &Path) -> Option<Self> {
        let text = std::fs::read_to_string(path).ok()?;
        serde_json::from_str(&text).inspect_err(|error| log::warn!("{}: {error}", path.display())).ok()
    }

    /// Keeps it for the next start. What cannot be written is forgotten.
    pub(crate) fn store(&self) {
        let Some(path) = path() else { return };
        if let Err(error) = self.write(&path) {
            log::warn!("{}: {error}", path.display());
        }
    }

    fn write(&self, path: &Path) -> std::io::Result<()> {
        let folder = path.parent().unwrap_or(Path::new("."));
        std::fs::create_dir_all(folder)?;
        let mut file = tempfile::NamedTempFile::new_in(folder)?;
        serde_json::to_writer_pretty(&mut file, self)?;
        file.write_all(b"\n")?;
        file.persist(path)?;
        Ok(())
    }

    /// What there is to remember of a model.
    pub(crate) fn of(model: &Model, size: Option<[u32; 2]>, maximized: bool) -> Self {
        let (file, gallery) = match model.document.source() {
            Source::File(path) => (Some(std::path::absolute(path).unwrap_or_else(|_| path.clone())), None),
            Source::Gallery(name) => (None, Some(name.clone())),
        };
        let Camera { eye, target, up, fov_y } = model.scene().camera;
        let camera = Eye { eye: eye.to_array(), target: target.to_array(), up: up.to_array(), fov_y };
        let camera = Some(camera);
        Self { settings: model.settings.clone(), file, gallery, camera, clock: model.clock, size, maximized }
    }

    /// Leaves the scene's time out, for comparing.
    pub(crate) fn forget_time(&mut self) {
        self.clock.time = 0.0;
    }

    /// The scene that was looked at.
    pub(crate) fn source(&self) -> Option<Source> {
        self.file.clone().map(Source::File).or_else(|| self.gallery.clone().map(Source::Gallery))
    }

    /// Puts eye and time back where they were.
    pub(crate) fn restore(&self, model: &mut Model) {
        if let Some(Eye { eye, target, up, fov_y }) = self.camera {
            let [eye, target, up] = [eye, target, up].map(DVec3::from_array);
            let old = model.scene().camera;
            let fov_y = if (0.001..3.13).contains(&fov_y) { fov_y } else { old.fov_y };
            model.document.look(camera::sane(&old, Camera { eye, target, up, fov_y }));
        }
        model.clock = self.clock.sane();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::GalleryScene;

    const SCENE: &str = "[camera]\neye = [0, 3, 6]";

    fn model() -> Model {
        let entry = GalleryScene { name: "a", text: SCENE };
        Model::new(entry.document().expect("a scene"), Settings::default(), vec![entry])
    }

    #[test]
    fn written_and_read() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("deep").join("viewer.json");
        let mut model = model();
        model.clock.time = 2.5;
        model.document.look(Camera { eye: DVec3::new(1.0, 2.0, 3.0), ..model.scene().camera });
        let remembered = Remembered::of(&model, Some([900, 600]), true);
        remembered.write(&path).expect("written");
        let read = Remembered::read(&path).expect("read");
        assert_eq!(read, remembered, "the same");
        let mut other = self::model();
        read.restore(&mut other);
        assert_eq!(other.scene().camera, model.scene().camera, "the eye is where it was");
        assert_eq!(other.clock.time, 2.5, "and the time");
        assert_eq!(read.source(), Some(Source::Gallery("a".into())), "of the same scene");
    }

    #[test]
    fn nonsense_is_forgotten() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("viewer.json");
        std::fs::write(&path, "{ \"settings\": 3 }").expect("written");
        assert_eq!(Remembered::read(&path), None, "not what it is");
        let bad = Remembered {
            camera: Some(Eye { eye: [0.0; 3], target: [0.0; 3], up: [0.0; 3], fov_y: 1.0 }),
            ..Remembered::default()
        };
        let mut model = model();
        let before = model.scene().camera;
        bad.restore(&mut model);
        assert_eq!(model.scene().camera, before, "a camera that sees nothing is not taken");
    }
}
