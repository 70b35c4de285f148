//! Scene files on the disk: whole or not at all, and with their meshes.

#[expect(dead_code, reason = "of what tests share only the scene is needed")]
mod common;

use std::fs;
use std::path::Path;

use antumbra_scene::{Scene, Shape};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

const FILE: &str = "# Mine.\ncamera = { eye = [0, 2, 5] } # here\n\n[[object]]\nname = \"mesh\"\nshape = { type = \"mesh\", path = \"parts/tri.obj\" } # from a file\n";

fn write(path: &Path, text: &str) {
    fs::create_dir_all(path.parent().expect("a folder")).expect("a folder can be made");
    fs::write(path, text).expect("a file can be written");
}

fn load(path: &Path) -> Scene {
    Scene::load(path).unwrap_or_else(|e| panic!("{e}"))
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).expect("a file can be read")
}

/// The names of what is in a folder.
fn listed(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder").flatten();
    let mut names: Vec<String> = entries.map(|e| e.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// The path and the triangles of the first object's mesh.
fn mesh(scene: &Scene) -> (String, usize) {
    match &scene.objects[0].parts[0].shape {
        Shape::Mesh(mesh) => (mesh.path.clone(), mesh.triangles.len()),
        other => panic!("{other:?} is no mesh"),
    }
}

/// A scene with a mesh in a folder of its own.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    write(&folder.path().join("one/scene.toml"), FILE);
    write(&folder.path().join("one/parts/tri.obj"), TRIANGLE);
    folder
}

#[test]
fn a_saved_scene_is_loaded_as_it_was() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("all.toml");
    let mut scene = Scene::parse(common::EVERYTHING, &file).expect("a scene");
    scene.save(&file, None).expect("a new file");
    assert_eq!(load(&file), scene, "what was saved");
    assert_eq!(read(&file), scene.to_toml(), "a new file is tidy");
    fs::write(&file, common::EVERYTHING).expect("a file can be written");
    scene.lights[0].intensity = 7.5;
    for _ in 0..2 {
        scene.save(&file, Some(&file)).expect("a file that is there");
        assert_eq!(load(&file), scene, "what was saved");
        assert_eq!(
            read(&file),
            common::EVERYTHING.replacen("intensity = 120", "intensity = 7.5", 1),
            "one change"
        );
    }
    assert_eq!(listed(folder.path()), ["all.toml"], "nothing else is left behind");
}

#[test]
fn meshes_are_found_from_another_folder() {
    let folder = folder();
    let one = folder.path().join("one/scene.toml");
    let mut scene = load(&one);
    scene.objects[0].pose.translation.y = 1.0;
    for (to, path) in [
        ("one/copy.toml", "parts/tri.obj"),
        ("one/../one/copy.toml", "parts/tri.obj"),
        ("copy.toml", "one/parts/tri.obj"),
        ("one/parts/copy.toml", "tri.obj"),
        ("two/deep/copy.toml", "../../one/parts/tri.obj"),
    ] {
        let to = folder.path().join(to);
        fs::create_dir_all(to.parent().expect("a folder")).expect("a folder can be made");
        scene.save(&to, Some(&one)).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(mesh(&load(&to)), (path.to_owned(), 1), "{to:?}");
        let text = read(&to);
        assert!(text.starts_with("# Mine.\ncamera = { eye = [0, 2, 5] } # here\n"), "{text}");
        assert!(text.contains("# from a file\ntranslation = [0.0, 1.0, 0.0]\n"), "{text}");
    }
    // An absolute path leads to the same file from everywhere.
    let absolute = folder.path().join("one/parts/tri.obj").to_string_lossy().into_owned();
    write(&one, &FILE.replace("\"parts/tri.obj\"", &format!("'{absolute}'")));
    let to = folder.path().join("two/copy.toml");
    load(&one).save(&to, Some(&one)).expect("another folder");
    assert_eq!(mesh(&load(&to)), (absolute, 1), "an absolute path stays");
}

#[test]
fn a_mesh_that_is_gone_does_not_stop_saving() {
    let folder = folder();
    let (one, to) = (folder.path().join("one/scene.toml"), folder.path().join("copy.toml"));
    let scene = load(&one);
    fs::remove_dir_all(folder.path().join("one/parts")).expect("the mesh is there");
    scene.save(&to, Some(&one)).expect("another folder");
    assert!(read(&to).contains("one/parts/tri.obj"), "{}", read(&to));
}

#[test]
fn a_file_is_replaced_and_not_written_into() {
    let folder = folder();
    let (one, before) = (folder.path().join("one/scene.toml"), folder.path().join("before.toml"));
    // Another name of the file that is there: who reads it meanwhile sees all of it.
    fs::hard_link(&one, &before).expect("a link");
    let mut scene = load(&one);
    scene.camera.fov_y = 0.5;
    scene.save(&one, Some(&one)).expect("the file itself");
    assert_eq!(read(&before), FILE, "the old file is whole");
    assert_eq!(load(&one), scene, "and the new one is in its place");
}

#[cfg(unix)]
#[test]
fn links_and_permissions_stay() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = folder();
    let one = folder.path().join("one/scene.toml");
    let link = folder.path().join("link.toml");
    // A mesh whose file has another name than the link to it.
    symlink(folder.path().join("one/parts/tri.obj"), folder.path().join("one/parts/link.obj"))
        .expect("a link");
    write(&one, &FILE.replace("tri.obj", "link.obj"));
    symlink(&one, &link).expect("a link");
    fs::set_permissions(&one, fs::Permissions::from_mode(0o640)).expect("permissions");
    let mut scene = load(&one);
    scene.camera.fov_y = 0.5;
    scene.save(&link, Some(&one)).expect("through a link");
    assert!(fs::symlink_metadata(&link).expect("a link").is_symlink(), "the link is still one");
    assert_eq!(fs::metadata(&one).expect("a file").permissions().mode() & 0o777, 0o640, "permissions stay");
    assert_eq!(mesh(&load(&link)).0, "one/parts/link.obj", "meshes are found beside the link");
    let new = folder.path().join("new.toml");
    scene.save(&new, Some(&one)).expect("a new file");
    fs::write(folder.path().join("usual"), "").expect("a file");
    let mode = |file: &Path| fs::metadata(file).expect("a file").permissions().mode() & 0o777;
    assert_eq!(mode(&new), mode(&folder.path().join("usual")), "a new file is as any other");
}

#[test]
fn what_cannot_be_saved_leaves_everything_as_it_was() {
    let folder = folder();
    let one = folder.path().join("one/scene.toml");
    let good = load(&one);
    let mut bad = good.clone();
    bad.objects[0].name.clear();
    let check = |scene: &Scene, path: &Path, told: &str| {
        let error = scene.save(path, Some(&one)).expect_err(told);
        assert_eq!((error.file(), error.place()), (path, None), "{error}");
        let error = error.to_string();
        assert!(error.contains("cannot be saved") && error.contains(told) && error.contains("; "), "{error}");
        assert!(!error.contains('\n'), "{error}");
    };
    check(&bad, &one, "is empty");
    check(&good, folder.path(), "");
    check(&good, &folder.path().join("none/scene.toml"), "");
    check(&good, &folder.path().join("one/scene.toml/x.toml"), "");
    check(&good, Path::new(""), "");
    let mut read_only = fs::metadata(&one).expect("a file").permissions();
    read_only.set_readonly(true);
    fs::set_permissions(&one, read_only).expect("permissions");
    check(&good, &one, "");
    assert_eq!(read(&one), FILE, "the file is as it was");
    assert_eq!(listed(folder.path()), ["one"], "nothing is left behind");
    assert_eq!(listed(&folder.path().join("one")), ["parts", "scene.toml"], "nothing is left behind");
}
