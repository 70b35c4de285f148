//! The scene as a whole: from the bytes of a file to a validated [`Scene`].

use std::collections::HashMap;
use std::io::Read;
use std::path::Path;

use glam::DVec3;
use toml::de::DeTable;
use toml_parser::lexer::TokenKind;

use crate::camera::MIN_UP_SINE;
use crate::error::{Source, not_utf8, unreadable};
use crate::limits::*;
use crate::mesh::Meshes;
use crate::table::{Field, Table};
use crate::text::quoted;
use crate::{Camera, Image, SceneError, parse_light, parse_object};
use crate::{Light, Object, Scene};

impl Scene {
    /// Reads a scene file, and the meshes it names.
    ///
    /// Total: any file gives a scene or an error, in time and memory in proportion to its size and to
    /// that of the meshes, within the [limits](crate::limits).
    ///
    /// # Errors
    /// If the file cannot be read or is not a valid scene; see [`SceneError`].
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        let mut bytes = Vec::new();
        std::fs::File::open(path)
            .and_then(|file| file.take(MAX_SCENE_BYTES as u64 + 1).read_to_end(&mut bytes))
            .map_err(|error| unreadable(path, &error))?;
        Self::from_bytes(&bytes, path)
    }

    /// As [`Scene::load`], of bytes that were read from `file`.
    ///
    /// # Errors
    /// If the bytes are not UTF-8 or not a valid scene.
    pub fn from_bytes(bytes: &[u8], file: &Path) -> Result<Self, SceneError> {
        match core::str::from_utf8(bytes) {
            Ok(text) => Self::parse(text, file),
            Err(error) => {
                let (good, bad) = bytes.split_at(error.valid_up_to());
                let good = core::str::from_utf8(good).unwrap_or_default();
                Err(not_utf8(file, good, bad.first().copied().unwrap_or_default()))
            }
        }
    }

    /// As [`Scene::load`], of text that was read from `file`: the path is for messages, and meshes are
    /// looked for beside it.
    ///
    /// # Errors
    /// If the text is not a valid scene.
    pub fn parse(text: &str, file: &Path) -> Result<Self, SceneError> {
        Self::parse_with(text, file, Meshes::beside(file))
    }

    /// As [`Scene::parse`], without reading meshes: each has its path and nothing else. For what depends
    /// on the text alone.
    pub(crate) fn parse_text(text: &str, file: &Path) -> Result<Self, SceneError> {
        Self::parse_with(text, file, Meshes::unread())
    }

    fn parse_with(text: &str, file: &Path, meshes: Meshes<'_>) -> Result<Self, SceneError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let source = Source { file, text };
        if text.len() > MAX_SCENE_BYTES {
            return Err(source.error(
                0,
                format!("the scene file has more than {MAX_SCENE_BYTES} bytes"),
                "split it into several scenes, or put geometry into a mesh file",
            ));
        }
        refuse_deep_keys(&source)?;
        let table = DeTable::parse(text).map_err(|error| {
            let at = error.span().map_or(0, |span| span.start);
            source.error(
                at,
                format!("not valid TOML: {}", error.message()),
                "see https://toml.io for the syntax",
            )
        })?;
        scene(&Table::root(&source, table.get_ref()), meshes)
    }
}

/// Keys with so many dots that the tables they make would overflow the stack when dropped. (Arrays
/// and inline tables need no such care: the parser stops at 80 levels.)
fn refuse_deep_keys(source: &Source<'_>) -> Result<(), SceneError> {
    let mut dots = 0;
    for token in toml_parser::Source::new(source.text).lex() {
        match token.kind() {
            TokenKind::Dot => dots += 1,
            // What a dotted key may hold beside its dots.
            TokenKind::Whitespace | TokenKind::Atom | TokenKind::LiteralString | TokenKind::BasicString => {}
            _ => dots = 0,
        }
        if dots > MAX_KEY_DOTS {
            return Err(source.error(
                token.span().start(),
                format!("a key with more than {MAX_KEY_DOTS} dots"),
                "write a key of the scene format, such as camera.eye",
            ));
        }
    }
    Ok(())
}

fn scene(root: &Table<'_>, meshes: Meshes<'_>) -> Result<Scene, SceneError> {
    root.allow(&["ambient", "camera", "image", "light", "object"], |key| match key {
        "lights" | "objects" => {
            let one = &key[..key.len() - 1];
            Some((
                format!("unknown key \"{key}\" in the scene"),
                format!("write [[{one}]] before each {one}"),
            ))
        }
        "eye" | "target" | "up" | "fov_y" => misplaced(key, "camera"),
        "width" | "height" | "background" | "exposure" => misplaced(key, "image"),
        _ => None,
    })?;
    let ambient = match root.get("ambient") {
        Some(field) => field.vector(0.0, MAX_BRIGHTNESS, "ambient = [0.05, 0.05, 0.05]")?,
        None => DVec3::ZERO,
    };
    let camera = camera(&root.require("camera", "[camera] and under it eye = [0.0, 6.0, 12.0]")?)?;
    let image = match root.get("image") {
        Some(field) => image(&field)?,
        None => Image::default(),
    };
    Ok(Scene { ambient, camera, image, lights: lights(root)?, objects: objects(root, meshes)? })
}

fn misplaced(key: &str, table: &str) -> Option<(String, String)> {
    Some((format!("\"{key}\" belongs to the {table}"), format!("put it under [{table}]")))
}

fn camera(field: &Field<'_>) -> Result<Camera, SceneError> {
    let table = field.table("the camera", "[camera] on a line of its own and its keys below")?;
    table.allow(&["eye", "target", "up", "fov_y"], |_| None)?;
    let eye = table.require("eye", "eye = [0.0, 6.0, 12.0]")?.point("eye = [0.0, 6.0, 12.0]")?;
    let target = table.get("target").map(|f| f.point("target = [0.0, 0.0, 0.0]")).transpose()?;
    let target = target.unwrap_or(DVec3::ZERO);
    let up = table.get("up").map(|f| f.direction("up = [0.0, 1.0, 0.0]")).transpose()?.unwrap_or(DVec3::Y);
    if eye.distance(target) < MIN_LENGTH {
        let at = if table.get("target").is_some() { "target" } else { "eye" };
        let field = table.require(at, "")?;
        return Err(field.error(
            "the camera's \"eye\" and \"target\" are the same point, so it looks nowhere",
            "move one of them",
        ));
    }
    if (target - eye).normalize().cross(up).length() < MIN_UP_SINE {
        let (what, instead) = (
            "the camera's \"up\" is parallel to its line of sight",
            "write an up that points elsewhere, such as up = [0.0, 0.0, -1.0] for a camera that looks down",
        );
        return Err(table.get("up").map_or_else(|| table.error(what, instead), |f| f.error(what, instead)));
    }
    let (low, high) = FOV_Y_DEGREES;
    let fov_y = table.get("fov_y").map(|f| f.number(low, high, "fov_y = 45.0 (degrees)")).transpose()?;
    Ok(Camera { eye, target, up, fov_y: fov_y.unwrap_or(45.0).to_radians() })
}

fn image(field: &Field<'_>) -> Result<Image, SceneError> {
    let table = field.table("the image", "[image] on a line of its own and its keys below")?;
    table.allow(&["width", "height", "background", "exposure"], |_| None)?;
    let mut image = Image::default();
    if let Some(field) = table.get("width") {
        image.width = field.integer(1, MAX_IMAGE_SIDE, "width = 960")?;
    }
    if let Some(field) = table.get("height") {
        image.height = field.integer(1, MAX_IMAGE_SIDE, "height = 540")?;
    }
    if let Some(field) = table.get("background") {
        image.background = field.vector(0.0, MAX_BRIGHTNESS, "background = [0.02, 0.02, 0.03]")?;
    }
    if let Some(field) = table.get("exposure") {
        image.exposure = field.number(1.0 / MAX_BRIGHTNESS, MAX_BRIGHTNESS, "exposure = 1.0")?;
    }
    Ok(image)
}

/// The tables of `[[key]]`, of which there may be none.
fn tables<'a>(root: &Table<'a>, key: &str, limit: usize) -> Result<Vec<Table<'a>>, SceneError> {
    let Some(field) = root.get(key) else { return Ok(Vec::new()) };
    let example = format!("[[{key}]], in double brackets, before each {key}");
    let entries = field.array(&example)?;
    if let Some(extra) = entries.get(limit) {
        return Err(extra.error(format!("more than {limit} {key}s"), "leave some out"));
    }
    entries.iter().map(|entry| entry.table(format!("this {key}"), &example)).collect()
}

fn lights(root: &Table<'_>) -> Result<Vec<Light>, SceneError> {
    let mut seen = HashMap::new();
    let mut lights = Vec::new();
    for table in tables(root, "light", MAX_LIGHTS)? {
        let name = table.require("name", "name = \"key\"")?;
        // File systems that ignore case would overwrite one light's file with another's.
        unique(&mut seen, &name, name.file_name()?.to_ascii_lowercase(), "light", ", ignoring case")?;
        lights.push(parse_light::light(table)?);
    }
    Ok(lights)
}

fn objects(root: &Table<'_>, mut meshes: Meshes<'_>) -> Result<Vec<Object>, SceneError> {
    let mut seen = HashMap::new();
    let mut objects = Vec::new();
    let mut parts = 0;
    for table in tables(root, "object", MAX_OBJECTS)? {
        let name = table.require("name", "name = \"ball\"")?;
        unique(&mut seen, &name, name.name()?.to_owned(), "object", "")?;
        objects.push(parse_object::object(table, &mut parts, &mut meshes)?);
    }
    Ok(objects)
}

/// Refuses a name that an earlier light or object has.
fn unique(
    seen: &mut HashMap<String, usize>,
    field: &Field<'_>,
    name: String,
    kind: &str,
    how: &str,
) -> Result<(), SceneError> {
    let at = field.span().start;
    match seen.get(&name) {
        Some(first) => Err(field.error(
            format!(
                "the {kind} name {} is used already, on line {}",
                quoted(field.name()?),
                field.source.line(*first)
            ),
            format!("give each {kind} a name of its own{how}"),
        )),
        None => {
            seen.insert(name, at);
            Ok(())
        }
    }
}
