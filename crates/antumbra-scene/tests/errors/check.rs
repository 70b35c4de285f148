//! Comparing errors with what they must say.

use std::path::Path;

use antumbra_scene::Scene;

/// A file without mistakes to put one into.
pub(crate) const CAMERA: &str = "[camera]\neye = [0, 6, 12]\n";

/// The error of a text; its line and column, and all of it.
pub(crate) fn error(text: &str) -> ((usize, usize), String) {
    match Scene::parse(text, Path::new("scene.toml")) {
        Ok(scene) => panic!("{text}\nis a scene: {scene:?}"),
        Err(error) => (error.place().expect("an error in the text has a place"), error.to_string()),
    }
}

/// Each case: text, line, column, fragments of the message in order.
pub(crate) fn check(cases: &[(&str, usize, usize, &[&str])]) {
    for (text, line, column, fragments) in cases {
        let (place, message) = error(text);
        assert_eq!(place, (*line, *column), "{text}\nsays {message}");
        let prefix = format!("scene.toml:{line}:{column}: ");
        let mut rest =
            message.strip_prefix(&prefix).unwrap_or_else(|| panic!("{message} begins with {prefix}"));
        for fragment in *fragments {
            let at =
                rest.find(fragment).unwrap_or_else(|| panic!("{text}\nsays {message}\nwithout {fragment:?}"));
            rest = &rest[at + fragment.len()..];
        }
        assert!(message.contains("; "), "{message} says what to write instead");
    }
}

/// Cases whose text is one object's or light's lines after the camera: the line counts from there.
pub(crate) fn check_after_camera(head: &str, cases: &[(&str, usize, usize, &[&str])]) {
    for (text, line, column, fragments) in cases {
        check(&[(&format!("{CAMERA}{head}{text}"), line + 2 + head.lines().count(), *column, fragments)]);
    }
}
