//! Names for new lights and objects.

use crate::Scene;
use crate::limits::MAX_NAME_BYTES;
use crate::values::NOT_IN_FILE_NAMES;

impl Scene {
    /// A name for a new light that no light has yet, upper and lower case ignored, and that is allowed:
    /// `wanted` if it is one, otherwise as near as can be. Characters that file names have not become
    /// `-`, and a number at the end tells names apart: "lamp", "lamp 2", "lamp 3".
    pub fn unique_light_name(&self, wanted: &str) -> String {
        let allowed = |c: char| !c.is_control() && !NOT_IN_FILE_NAMES.contains(c);
        let wanted: String = wanted.chars().map(|c| if allowed(c) { c } else { '-' }).collect();
        // Neither a dot nor a space may be at the end, which cutting a long name could bring there.
        let wanted = wanted.trim_start_matches(' ');
        unique(wanted, "light", &[' ', '.'], |name| {
            self.lights.iter().any(|light| light.name.eq_ignore_ascii_case(name))
        })
    }

    /// A name for a new object that no object has yet and that is allowed, made as that of a light. An
    /// object may have the name of a light, and characters that file names have not.
    pub fn unique_object_name(&self, wanted: &str) -> String {
        let wanted: String = wanted.chars().map(|c| if c.is_control() { '-' } else { c }).collect();
        unique(&wanted, "object", &[], |name| self.objects.iter().any(|object| object.name == name))
    }
}

/// `wanted`, or `otherwise` if there is nothing to it, with a number if it is taken; not longer than
/// names may be, and without `not_last` at the end.
fn unique(wanted: &str, otherwise: &str, not_last: &[char], taken: impl Fn(&str) -> bool) -> String {
    let cut = |name: &str, most: usize| {
        let name = &name[..name.floor_char_boundary(most)];
        name.trim_end_matches(not_last).to_owned()
    };
    let mut whole = cut(wanted, MAX_NAME_BYTES);
    if whole.trim().is_empty() {
        whole = otherwise.to_owned();
    }
    if !taken(&whole) {
        return whole;
    }
    let (base, first) = numbered(&whole).unwrap_or((&whole, 2));
    (first..u64::MAX)
        .map(|number| {
            let number = format!(" {number}");
            cut(base, MAX_NAME_BYTES - number.len()) + &number
        })
        .find(|name| !taken(name))
        .unwrap_or(whole)
}

/// "lamp 3" as "lamp" and the number that comes next.
fn numbered(name: &str) -> Option<(&str, u64)> {
    let (base, number) = name.rsplit_once(' ')?;
    let digits = number.bytes().all(|b| b.is_ascii_digit()) && !number.starts_with('0');
    let next = number.parse::<u32>().ok().filter(|_| digits)?;
    (!base.trim().is_empty()).then_some((base, u64::from(next) + 1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Light, Object};

    fn scene() -> Scene {
        let text = r#"
            camera = { eye = [0, 2, 5] }
            [[light]]
            name = "Lamp"
            type = "point"
            position = [0, 3, 0]
            intensity = 1
            [[object]]
            name = "ball"
            shape = { type = "plane" }
            [[object]]
            name = "ball 2"
            shape = { type = "plane" }
        "#;
        Scene::parse(text, "names.toml".as_ref()).expect("a scene")
    }

    #[test]
    fn free_names_are_kept_and_others_are_numbered() {
        let scene = scene();
        for (wanted, light, object) in [
            ("sun", "sun", "sun"),
            ("lamp", "lamp 2", "lamp"),
            ("LAMP", "LAMP 2", "LAMP"),
            ("ball", "ball", "ball 3"),
            ("ball 2", "ball 2", "ball 3"),
            ("Ball", "Ball", "Ball"),
            ("a/b:c", "a-b-c", "a/b:c"),
            (" x. ", "x", " x. "),
            ("", "light", "object"),
            ("..", "light", ".."),
            ("a\nb", "a-b", "a-b"),
            ("  ", "light", "object"),
        ] {
            assert_eq!(scene.unique_light_name(wanted), light, "a light, {wanted:?}");
            assert_eq!(scene.unique_object_name(wanted), object, "an object, {wanted:?}");
        }
    }

    #[test]
    fn every_name_that_is_given_is_allowed() {
        let mut scene = scene();
        let long = "ä".repeat(100);
        let odd = ["lamp", "LAMP 2", "con. . .", "\u{7f}", "7", " 7", "x 18446744073709551615", "x 01", "🌲"];
        for wanted in odd.into_iter().chain([long.as_str(); 12]).chain(["ball 4294967295"; 3]) {
            let light = Light { name: scene.unique_light_name(wanted), ..scene.lights[0].clone() };
            let object = Object { name: scene.unique_object_name(wanted), ..scene.objects[0].clone() };
            scene.lights.push(light);
            scene.objects.push(object);
            assert_eq!(scene.validate(), Ok(()), "names made of {wanted:?}");
        }
    }
}
