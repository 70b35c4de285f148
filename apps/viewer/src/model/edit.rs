//! Changes of a scene: shapes, moving, adding and deleting.

use antumbra::glam::{DQuat, DVec3};
use antumbra_scene::{Light, LightKind, Motion, Object, Part, Pose, Primitive, Scene, Shape, limits};

use super::command::PaperShape;

/// Keeps a position within what a scene file may say.
pub(crate) fn within(position: DVec3) -> DVec3 {
    let limit = DVec3::splat(limits::MAX_COORDINATE);
    if position.is_finite() { position.clamp(-limit, limit) } else { DVec3::ZERO }
}

/// Moves a light, along with its motion. A directional light has no position: it is turned, as if the light were ten
/// metres from the origin and moved there.
pub(crate) fn move_light(light: &mut Light, by: DVec3) {
    if let LightKind::Directional { direction } = &mut light.kind {
        *direction = (*direction * 10.0 - by).try_normalize().unwrap_or(*direction);
        return;
    }
    light.position = within(light.position + by);
    light.motion = light.motion.take().map(|motion| motion.translated(by));
}

/// Moves an object, along with its motion.
pub(crate) fn move_object(object: &mut Object, by: DVec3) {
    object.pose.translation = within(object.pose.translation + by);
    object.motion = object.motion.take().map(|motion| motion.translated(by));
}

/// The object whose shape the papers' keys change: the chosen one, else the first that casts a shadow and is no
/// ground.
pub(crate) fn shadowed_object(scene: &Scene, chosen: Option<usize>) -> Option<usize> {
    let stands = |object: &Object| {
        object.casts_shadow
            && !object.parts.iter().any(|p| matches!(p.shape, Shape::Plane | Shape::Rectangle { .. }))
    };
    chosen.filter(|&i| i < scene.objects.len()).or_else(|| scene.objects.iter().position(stands))
}

/// Gives an object one of the papers' shapes, as large as it was.
pub(crate) fn reshape(object: &mut Object, shape: PaperShape) {
    let radius = size(object);
    let shape = match shape {
        PaperShape::Circle => Shape::Disc { radius },
        PaperShape::Sphere => Shape::Sphere { radius },
        PaperShape::Triangle => {
            let corner =
                |turns: f64| DQuat::from_rotation_y(turns * std::f64::consts::TAU) * (DVec3::Z * radius);
            Shape::Triangle { vertices: [corner(0.0), corner(1.0 / 3.0), corner(2.0 / 3.0)] }
        }
        PaperShape::Cone => Shape::Cone { radius, height: 2.0 * radius },
    };
    object.parts = vec![Part { shape, pose: Pose::IDENTITY }];
}

/// About the radius of an object; 0.5 for an infinite one.
fn size(object: &Object) -> f64 {
    if let [Part { shape, .. }] = object.parts.as_slice() {
        match *shape {
            Shape::Disc { radius } | Shape::Sphere { radius } | Shape::Cone { radius, .. } => return radius,
            Shape::Triangle { vertices } => {
                return vertices.iter().map(|v| v.length()).fold(0.0, f64::max).max(limits::MIN_LENGTH);
            }
            _ => {}
        }
    }
    let bounds = object.parts.iter().map(|part| {
        let pose = part.pose;
        let primitive = Primitive {
            object: 0,
            part: 0,
            shape: part.shape.clone(),
            pose,
            color: DVec3::ONE,
            casts_shadow: true,
            receives_shadow: true,
        };
        primitive.bounds()
    });
    let whole = bounds.reduce(|a, b| a.zip(b).map(|((al, ah), (bl, bh))| (al.min(bl), ah.max(bh))));
    let radius = whole.flatten().map_or(0.5, |(low, high)| 0.5 * (high - low).max_element());
    radius.clamp(limits::MIN_LENGTH, limits::MAX_LENGTH)
}

/// Adds a light of a kind near the target of the camera and above it; its number, or `None` if there are too many.
pub(crate) fn add_light(scene: &mut Scene, kind: LightKind, distance: f64) -> Option<usize> {
    if scene.lights.len() >= limits::MAX_LIGHTS {
        return None;
    }
    let name = scene.unique_light_name("light");
    let directional = matches!(kind, LightKind::Directional { .. });
    // As bright as the scale of the scene asks for: the same illuminance below it.
    let intensity = if directional { 2.0 } else { (2.0 * distance * distance).min(limits::MAX_BRIGHTNESS) };
    let position = if directional {
        DVec3::ZERO
    } else {
        within(scene.camera.target + DVec3::new(0.3, 0.8, 0.3) * distance)
    };
    scene.lights.push(Light { name, kind, position, color: DVec3::ONE, intensity, motion: None });
    Some(scene.lights.len() - 1)
}

/// Adds an object of a shape at the target of the camera, or a little above; its number, or `None` if there are too
/// many.
pub(crate) fn add_object(scene: &mut Scene, kind: &str, shape: Shape) -> Option<usize> {
    if !has_room(scene, 1) {
        return None;
    }
    let name = scene.unique_object_name(kind);
    let translation = if shape == Shape::Plane { DVec3::ZERO } else { free_place(scene) };
    scene.objects.push(Object {
        name,
        parts: vec![Part { shape, pose: Pose::IDENTITY }],
        pose: Pose { translation, ..Pose::IDENTITY },
        color: DVec3::splat(0.8),
        casts_shadow: true,
        receives_shadow: true,
        motion: None,
    });
    Some(scene.objects.len() - 1)
}

/// What is said where there is no room.
pub(crate) const NO_ROOM: &str = "the scene has as many objects as a scene may have";

/// Whether an object of so many parts more is still a scene.
pub(crate) fn has_room(scene: &Scene, parts: usize) -> bool {
    let there: usize = scene.objects.iter().map(|o| o.parts.len()).sum();
    scene.objects.len() < limits::MAX_OBJECTS && there + parts <= limits::MAX_PARTS
}

/// Above what the camera looks at, or beside it where something is there already.
fn free_place(scene: &Scene) -> DVec3 {
    let (across, ..) = scene.camera.axes();
    let step = DVec3::new(across.x, 0.0, across.z).normalize_or(DVec3::X) * 1.5;
    let base = within(scene.camera.target + DVec3::Y);
    let taken = |place: &DVec3| scene.objects.iter().any(|o| o.pose.translation.distance(*place) < 1.0);
    // To the right and to the left in turn, farther each time.
    let side = |k: i32| f64::from((k + 1) / 2) * if k % 2 == 1 { 1.0 } else { -1.0 };
    within((0..64).map(|k| base + step * side(k)).find(|place| !taken(place)).unwrap_or(base))
}

/// An orbit round the vertical axis through the camera's target, once in eight seconds: what a thing that starts to
/// move does.
pub(crate) fn some_motion(scene: &Scene, position: DVec3) -> Motion {
    let target = scene.camera.target;
    Motion::Orbit { center: DVec3::new(target.x, position.y, target.z), axis: DVec3::Y, period: 8.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene() -> Scene {
        let text = r#"
[camera]
eye = [0, 3, 6]
[[light]]
name = "sun"
type = "directional"
direction = [0, -1, 0]
intensity = 3
[[object]]
name = "floor"
shape = { type = "plane" }
[[object]]
name = "box"
shape = { type = "box", size = [2, 4, 1] }
motion = { type = "orbit", center = [1, 0, 0], axis = [0, 1, 0], period = 2 }
"#;
        Scene::parse(text, "test".as_ref()).expect("a scene")
    }

    #[test]
    fn shapes_keep_their_size() {
        let mut s = scene();
        assert_eq!(shadowed_object(&s, None), Some(1), "not the floor");
        assert_eq!(shadowed_object(&s, Some(0)), Some(0), "unless it is chosen");
        assert_eq!(shadowed_object(&s, Some(9)), Some(1), "nor what is not there");
        for shape in [PaperShape::Triangle, PaperShape::Circle, PaperShape::Cone, PaperShape::Sphere] {
            reshape(&mut s.objects[1], shape);
            assert!((size(&s.objects[1]) - 2.0).abs() < 1e-12, "{shape:?} is {}", size(&s.objects[1]));
        }
        assert_eq!(size(&s.objects[0]), 0.5, "an infinite thing becomes a small one");
    }

    #[test]
    fn motions_move_along() {
        let mut s = scene();
        let before = s.moment(0.7).primitives[1].pose.translation;
        move_object(&mut s.objects[1], DVec3::new(1.0, 2.0, 3.0));
        let after = s.moment(0.7).primitives[1].pose.translation;
        assert!((after - before - DVec3::new(1.0, 2.0, 3.0)).length() < 1e-12, "{before} to {after}");
        move_object(&mut s.objects[1], DVec3::splat(1e9));
        assert!(
            s.objects[1].pose.translation.max_element() <= limits::MAX_COORDINATE,
            "not out of the world"
        );
    }

    #[test]
    fn suns_turn() {
        let mut s = scene();
        move_light(&mut s.lights[0], DVec3::X);
        let LightKind::Directional { direction } = s.lights[0].kind else { panic!("still a sun") };
        assert!(
            direction.x < 0.0 && (direction.length() - 1.0).abs() < 1e-12,
            "moved right, it shines left: {direction}"
        );
    }

    #[test]
    fn what_is_added_is_a_scene() {
        let mut s = scene();
        for _ in 0..3 {
            add_light(&mut s, LightKind::Sphere { radius: 0.2 }, 7.0).expect("room");
            add_object(&mut s, "ball", Shape::Sphere { radius: 0.5 }).expect("room");
        }
        s.lights[1].motion = Some(some_motion(&s, s.lights[1].position));
        assert_eq!(Scene::parse(&s.to_toml(), "test".as_ref()).expect("a scene"), s, "names are unique");
    }
}
