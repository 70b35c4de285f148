//! The scene that is being looked at and changed, where it came from, and what it was before.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use antumbra::Component;
use antumbra_scene::{Camera, Scene, SceneError};

/// How many steps can be undone.
const MOST_STEPS: usize = 200;

/// Where a scene came from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Source {
    /// A file, which "Save" writes to.
    File(PathBuf),
    /// The program itself.
    Gallery(String),
}

impl Source {
    /// What a title says of it.
    pub(crate) fn name(&self) -> String {
        match self {
            Self::File(path) => path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned(),
            Self::Gallery(name) => name.clone(),
        }
    }
}

/// What belongs to one step of undoing: edits of the same kind and thing, one right after another, are one.
pub(crate) type Stroke = (&'static str, usize);

/// What a step leads back or forth to.
type Step = (Arc<Scene>, Vec<Component>);

/// A scene and its history.
pub(crate) struct Document {
    scene: Arc<Scene>,
    source: Source,
    /// The file whose folder the paths of meshes are relative to.
    loaded_from: Option<PathBuf>,
    saved: Arc<Scene>,
    modified: bool,
    /// Components of lights that were moved: for each such light all but the central one, from its position. Scene files
    /// have no place for them.
    components: Vec<Component>,
    undo: Vec<Step>,
    redo: Vec<Step>,
    /// The step that further edits of its kind go into.
    open: Option<Stroke>,
}

impl Document {
    /// A scene that nothing was done to yet.
    pub(crate) fn new(scene: Scene, source: Source) -> Self {
        let scene = Arc::new(scene);
        let saved = scene.clone();
        let loaded_from = match &source {
            Source::File(path) => Some(path.clone()),
            Source::Gallery(_) => None,
        };
        Self {
            saved,
            scene,
            source,
            loaded_from,
            modified: false,
            components: Vec::new(),
            undo: Vec::new(),
            redo: Vec::new(),
            open: None,
        }
    }

    /// Reads a file.
    ///
    /// # Errors
    /// Those of the file.
    pub(crate) fn load(path: &Path) -> Result<Self, SceneError> {
        Ok(Self::new(Scene::load(path)?, Source::File(path.to_owned())))
    }

    /// The scene as it is now.
    pub(crate) fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    /// Where it came from, or was saved to.
    pub(crate) fn source(&self) -> &Source {
        &self.source
    }

    /// Whether there is something to save; where the camera is does not count.
    pub(crate) fn is_modified(&self) -> bool {
        self.modified
    }

    /// Compares with what was saved; the camera aside.
    fn compare(&mut self) {
        let (Scene { ambient, image, lights, objects, .. }, saved) = (&*self.scene, &*self.saved);
        self.modified = *ambient != saved.ambient
            || *image != saved.image
            || *lights != saved.lights
            || *objects != saved.objects;
    }

    /// The components that were moved.
    pub(crate) fn components(&self) -> &[Component] {
        &self.components
    }

    /// Changes the scene. A change that changes nothing leaves no step.
    pub(crate) fn edit(&mut self, stroke: Stroke, change: impl FnOnce(&mut Scene)) {
        self.edit_all(stroke, |scene, _| change(scene));
    }

    /// Changes the scene and the components.
    pub(crate) fn edit_all(&mut self, stroke: Stroke, change: impl FnOnce(&mut Scene, &mut Vec<Component>)) {
        let before = (self.scene.clone(), self.components.clone());
        change(Arc::make_mut(&mut self.scene), &mut self.components);
        if *before.0 == *self.scene && before.1 == self.components {
            self.scene = before.0;
            return;
        }
        if self.open != Some(stroke) {
            self.open = Some(stroke);
            self.undo.push(before);
            if self.undo.len() > MOST_STEPS {
                self.undo.remove(0);
            }
        }
        self.redo.clear();
        self.compare();
    }

    /// Ends a step: the next edit is one of its own, of whatever kind.
    pub(crate) fn end_stroke(&mut self) {
        self.open = None;
    }

    /// Moves the camera, which is no step.
    pub(crate) fn look(&mut self, camera: Camera) {
        if self.scene.camera != camera {
            Arc::make_mut(&mut self.scene).camera = camera;
        }
    }

    /// Whether there is a step to take back.
    pub(crate) fn can_undo(&self) -> bool {
        !self.undo.is_empty()
    }

    /// Whether a step that was taken back can be taken again.
    pub(crate) fn can_redo(&self) -> bool {
        !self.redo.is_empty()
    }

    /// Takes back a step; the camera stays.
    pub(crate) fn undo(&mut self) {
        if let Some(before) = self.undo.pop() {
            let after = self.go_to(before);
            self.redo.push(after);
        }
    }

    /// Takes the step again.
    pub(crate) fn redo(&mut self) {
        if let Some(after) = self.redo.pop() {
            let before = self.go_to(after);
            self.undo.push(before);
        }
    }

    /// Puts another state in place of the present one, which it returns.
    fn go_to(&mut self, step: Step) -> Step {
        let scene = std::mem::replace(&mut self.scene, step.0);
        let components = std::mem::replace(&mut self.components, step.1);
        self.look(scene.camera);
        self.open = None;
        self.compare();
        (scene, components)
    }

    /// Writes the scene to a file, which is where it comes from afterwards.
    ///
    /// # Errors
    /// Those of writing.
    pub(crate) fn save(&mut self, path: &Path) -> Result<(), SceneError> {
        self.scene.save(path, self.loaded_from.as_deref())?;
        self.source = Source::File(path.to_owned());
        self.saved = self.scene.clone();
        self.modified = false;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use antumbra_scene::limits;

    fn document() -> Document {
        let text = "[camera]\neye = [0, 3, 6]\n[[light]]\nname = \"a\"\ntype = \"point\"\nposition = [0, 5, 0]\nintensity = 9";
        let scene = Scene::parse(text, Path::new("test")).expect("a scene");
        Document::new(scene, Source::Gallery("test".into()))
    }

    #[test]
    fn strokes_are_steps() {
        let mut d = document();
        let x = |d: &Document| d.scene().lights[0].position.x;
        for _ in 0..3 {
            d.edit(("move", 0), |s| s.lights[0].position.x += 1.0);
        }
        d.end_stroke();
        d.edit(("move", 0), |s| s.lights[0].position.x += 10.0);
        assert!(d.is_modified(), "it was moved");
        d.undo();
        assert_eq!(x(&d), 3.0, "the second stroke is taken back");
        d.undo();
        assert_eq!(x(&d), 0.0, "the first one as a whole");
        assert!(!d.can_undo() && !d.is_modified(), "nothing is left of it");
        d.undo();
        d.redo();
        d.redo();
        d.redo();
        assert_eq!(x(&d), 13.0, "and again");
    }

    #[test]
    fn nothing_is_no_step_and_a_new_one_ends_redoing() {
        let mut d = document();
        d.edit(("move", 0), |_| {});
        assert!(!d.can_undo(), "nothing was done");
        d.edit(("move", 0), |s| s.lights[0].intensity = 1.0);
        d.undo();
        d.edit(("move", 0), |s| s.lights[0].intensity = limits::MAX_BRIGHTNESS);
        assert!(!d.can_redo(), "the old future is gone");
    }

    #[test]
    fn the_camera_stays() {
        let mut d = document();
        d.edit(("move", 0), |s| s.lights[0].intensity = 1.0);
        let camera = Camera { eye: antumbra::glam::DVec3::splat(7.0), ..d.scene().camera };
        d.look(camera);
        d.undo();
        assert_eq!(d.scene().camera, camera, "undoing does not move the eye");
        assert!(!d.is_modified(), "looking is not changing");
    }

    #[test]
    fn history_has_an_end() {
        let mut d = document();
        for i in 0..MOST_STEPS + 50 {
            d.edit(("move", i), |s| s.lights[0].position.x += 1.0);
        }
        for _ in 0..MOST_STEPS + 50 {
            d.undo();
        }
        assert_eq!(d.scene().lights[0].position.x, 50.0, "the oldest steps are forgotten");
    }
}
