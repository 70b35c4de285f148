//! What keys and menus do to the model.

use antumbra::glam::DVec3;

use super::*;
use command::PaperShape;

const TWO_LIGHTS: &str = r#"
[camera]
eye = [0, 6, 10]
[[light]]
name = "left"
type = "sphere"
radius = 0.5
position = [-2, 4, 0]
intensity = 30
[[light]]
name = "right"
type = "point"
position = [2, 4, 0]
intensity = 30
motion = { type = "orbit", center = [0, 4, 0], axis = [0, 1, 0], period = 8 }
[[object]]
name = "floor"
shape = { type = "plane" }
[[object]]
name = "ball"
shape = { type = "sphere", radius = 0.5 }
translation = [0, 0.5, 0]
"#;

fn model() -> Model {
    let scene = Scene::parse(TWO_LIGHTS, "test".as_ref()).expect("a scene");
    let gallery = ["one", "two"].map(|name| GalleryScene { name, text: TWO_LIGHTS }).to_vec();
    Model::new(Document::new(scene, Source::Gallery("one".into())), Settings::default(), gallery)
}

#[test]
fn keys_move_the_chosen_light() {
    let mut m = model();
    m.apply(Command::MoveLight(DVec3::X));
    assert_eq!(m.scene().lights[0].position, DVec3::new(-2.0 + STEP, 4.0, 0.0), "the first at first");
    m.apply(Command::Second);
    m.apply(Command::MoveLight(DVec3::Y));
    assert_eq!(m.scene().lights[1].position, DVec3::new(2.0, 4.0 + STEP, 0.0), "then the second");
    m.apply(Command::ChooseLight(7));
    assert!(m.message.as_ref().is_some_and(|m| m.is_error), "there is no eighth");
    m.apply(Command::MoveLight(DVec3::Z));
    assert_eq!(m.scene().lights[1].position.z, STEP, "and still the second");
}

#[test]
fn components_move_one_by_one() {
    let mut m = model();
    m.settings.ways[0] = "composite".parse().expect("a way");
    m.apply(Command::First);
    assert_eq!(m.component, Some(Side::Left), "the first light is a collection");
    m.apply(Command::MoveLight(DVec3::Y));
    let offsets: Vec<DVec3> = m.document.components().iter().map(|c| c.offset).collect();
    assert_eq!(offsets.len(), 2, "all but the central one are named");
    let moved: Vec<&DVec3> = offsets.iter().filter(|o| o.y != 0.0).collect();
    assert!(matches!(moved[..], [o] if o.x == -0.5 && o.y == STEP), "the left one alone moved: {offsets:?}");
    m.apply(Command::Second);
    m.apply(Command::MoveLight(DVec3::X));
    assert!(
        m.document.components().iter().any(|c| (c.offset.x - 0.5 - STEP).abs() < 1e-12),
        "the right one: {:?}",
        m.document.components()
    );
    assert_eq!(m.scene().lights[0].position.x, -2.0, "the light stays");
    m.document.end_stroke();
    let moved = m.document.components().to_vec();
    m.apply(Command::MoveLight(DVec3::Z));
    m.apply(Command::Undo);
    assert_eq!(m.document.components(), moved, "moving a component is a step");
    m.apply(Command::ChooseLight(1));
    m.apply(Command::First);
    assert_eq!(
        (m.light, m.component),
        (0, None),
        "of a point light there are no components: G is the first light"
    );
}

#[test]
fn shapes_of_the_papers() {
    let mut m = model();
    m.apply(Command::Shape(PaperShape::Cone));
    let shape = m.scene().objects[1].parts[0].shape.clone();
    assert_eq!(shape, antumbra_scene::Shape::Cone { radius: 0.5, height: 1.0 }, "the ball is a cone");
    m.apply(Command::Undo);
    assert!(!m.document.is_modified(), "and a ball again");
}

#[test]
fn deleting_and_undoing() {
    let mut m = model();
    m.choose(Some(Item::Light(1)));
    m.apply(Command::Delete);
    assert_eq!(
        (m.scene().lights.len(), m.light, m.chosen),
        (1, 0, None),
        "one is left, and is the one that moves"
    );
    m.apply(Command::Delete);
    assert_eq!(m.scene().lights.len(), 1, "nothing was chosen");
    m.apply(Command::Undo);
    assert_eq!(m.scene().lights.len(), 2, "it is back");
    m.choose(Some(Item::Object(1)));
    m.apply(Command::Duplicate);
    assert_eq!(m.chosen, Some(Item::Object(2)), "the copy is chosen");
    m.apply(Command::Undo);
    assert_eq!(m.chosen, None, "and gone");
    m.move_item(Item::Object(7), DVec3::X);
    m.move_item(Item::Light(7), DVec3::X);
    for _ in 0..3 {
        m.choose(Some(Item::Light(0)));
        m.apply(Command::Delete);
    }
    m.apply(Command::MoveLight(DVec3::X));
    m.apply(Command::First);
    assert!(m.scene().lights.is_empty(), "without lights nothing moves, and nothing panics");
}

#[test]
fn changes_are_not_lost_unasked() {
    let mut m = model();
    m.apply(Command::NextScene(true));
    assert_eq!(*m.document.source(), Source::Gallery("two".into()), "nothing was changed");
    m.apply(Command::MoveLight(DVec3::X));
    m.apply(Command::NextScene(true));
    assert_eq!(m.dialog, Some(Dialog::Unsaved(Then::Show(Source::Gallery("one".into())))), "it asks");
    m.apply(Command::Escape);
    assert_eq!((m.dialog.clone(), m.document.source().name().as_str()), (None, "two"), "and stays");
    m.apply(Command::Quit);
    assert!(m.requests.is_empty(), "nor ends");
    m.go_on(Then::Quit);
    assert_eq!(m.requests, [Request::Quit], "but does when told");
    m.apply(Command::MoveCamera(DVec3::Y));
    m.apply(Command::Undo);
    assert!(!m.document.is_modified(), "the camera does not count");
}

#[test]
fn what_cannot_be_shown_leaves_what_is() {
    let mut m = model();
    m.show(Source::File("/nowhere/scene.toml".into()));
    assert!(
        m.message.as_ref().is_some_and(|m| m.is_error && m.text.contains("/nowhere/scene.toml")),
        "{:?}",
        m.message
    );
    assert_eq!(m.scene().lights.len(), 2, "the old one is still there");
}

#[test]
fn saving_goes_on_with_what_was_to_be_done() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mine.toml");
    let mut m = model();
    m.apply(Command::MoveLight(DVec3::X));
    m.apply(Command::Quit);
    m.save_then(Then::Quit);
    assert_eq!(
        (m.dialog.clone(), m.requests.len()),
        (Some(Dialog::SaveAs), 0),
        "of the gallery: it asks where"
    );
    m.apply(Command::Escape);
    assert_eq!((m.dialog.clone(), m.after_save.clone()), (None, None), "and forgets it");
    m.apply(Command::SaveAs);
    assert!(m.save_here(&path), "saved: {:?}", m.message);
    assert_eq!(
        (m.dialog.clone(), m.requests.len(), m.document.is_modified()),
        (None, 0, false),
        "and nothing else"
    );
    m.apply(Command::MoveLight(DVec3::X));
    let two = Source::Gallery("two".into());
    m.save_then(Then::Show(two.clone()));
    assert_eq!(*m.document.source(), two, "a scene with a file is saved without asking");
    m.apply(Command::MoveLight(DVec3::X));
    m.save_then(Then::Quit);
    assert!(!m.save_here(&folder.path().join("no folder/x.toml")), "where it cannot be");
    assert!(m.requests.is_empty() && m.dialog == Some(Dialog::SaveAs), "it asks on");
    assert!(m.save_here(&path), "where it can be: {:?}", m.message);
    assert_eq!(m.requests, [Request::Quit], "it ends");
}

#[test]
fn measuring_is_stopped_by_escape_and_by_another_scene() {
    let mut m = model();
    let ways = m.settings.ways;
    for stop in [Command::Escape, Command::NextScene(true), Command::Timing] {
        m.settings.layout = Layout::Split;
        m.measure_all();
        assert!(m.timing.measuring().is_some() && m.settings.timing, "it is under way");
        assert_eq!(m.settings.layout, Layout::Single, "one at a time");
        m.apply(stop);
        assert!(m.timing.measuring().is_none(), "{stop:?} ends it");
        assert_eq!((m.settings.layout, m.settings.ways), (Layout::Split, ways), "as before");
    }
}

#[test]
fn motion_is_what_moves() {
    let mut m = model();
    assert!(!m.is_moving(), "it stands still at first");
    m.apply(Command::PlayPause);
    assert!(m.is_moving(), "the second light orbits");
    m.document.edit(("motion", 1), |s| s.lights[1].motion = None);
    assert!(!m.is_moving(), "nothing moves: no frames for nothing");
}
