//! What is under the pointer, and dragging it.

use antumbra::glam::{DVec2, DVec3};
use antumbra_reference::{Ray, Tracer};
use antumbra_scene::{LightKind, Moment, Scene, Shape};

use super::camera::Lens;

/// A light or an object, by its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Item {
    /// A light.
    Light(usize),
    /// An object.
    Object(usize),
}

/// How far from its mark a light is still meant, points.
pub(crate) const REACH: f64 = 14.0;

/// Where the mark of a light is: at the light, and for a sun on its way to the camera's target.
pub(crate) fn mark(scene: &Scene, moment: &Moment, light: usize) -> Option<DVec3> {
    let light = moment.lights.get(light)?;
    Some(match light.kind {
        LightKind::Directional { direction } => {
            let camera = scene.camera;
            camera.target - direction * (0.4 * camera.eye.distance(camera.target))
        }
        _ => light.position,
    })
}

/// What a click at a point of the picture means: the nearest mark of a light, else the object that is seen there.
pub(crate) fn at(scene: &Scene, time: f64, lens: &Lens, point: DVec2) -> Option<Item> {
    let moment = scene.moment(time);
    let marks = (0..moment.lights.len()).filter_map(|i| {
        let seen = lens.project(mark(scene, &moment, i)?)?;
        Some((i, seen.distance(point))).filter(|&(_, distance)| distance <= REACH)
    });
    if let Some((light, _)) = marks.min_by(|a, b| a.1.total_cmp(&b.1)) {
        return Some(Item::Light(light));
    }
    let tracer = Tracer::from_moment(scene, &moment);
    let surface = tracer.surface(&Ray::new(lens.camera().eye, lens.direction(point)))?;
    moment.primitives.get(surface.primitive as usize).map(|p| Item::Object(p.object))
}

/// Whether a thing moves when it is dragged without having been chosen: lights and solid things do, floors and walls,
/// which fill the picture, do not.
pub(crate) fn is_loose(scene: &Scene, item: Item) -> bool {
    match item {
        Item::Light(_) => true,
        Item::Object(i) => scene.objects.get(i).is_some_and(|object| {
            object.parts.iter().all(|part| !matches!(part.shape, Shape::Plane | Shape::Rectangle { .. }))
        }),
    }
}

/// A thing held by the pointer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grip {
    /// What is held.
    pub(crate) item: Item,
    /// The point of it that is under the pointer, world space.
    held: DVec3,
}

impl Grip {
    /// Takes hold of a thing at a point of the picture.
    pub(crate) fn new(scene: &Scene, time: f64, lens: &Lens, point: DVec2, item: Item) -> Option<Self> {
        let moment = scene.moment(time);
        let held = match item {
            Item::Light(i) => mark(scene, &moment, i)?,
            Item::Object(i) => {
                let tracer = Tracer::from_moment(scene, &moment);
                let seen = tracer.surface(&Ray::new(lens.camera().eye, lens.direction(point)));
                let place = moment.primitives.iter().find(|p| p.object == i)?.pose.translation;
                seen.map_or(place, |surface| surface.point)
            }
        };
        Some(Self { item, held })
    }

    /// Moves the grip to another point of the picture, level or, if `upright`, up and down; by how much it moved.
    pub(crate) fn drag(&mut self, lens: &Lens, to: DVec2, upright: bool) -> DVec3 {
        let (_, _, forward) = lens.camera().axes();
        let up = DVec3::Y;
        let (normal, along) = if upright {
            // The upright plane that faces the eye; only its height counts.
            ((forward - up * forward.y).normalize_or(DVec3::Z), Some(up))
        } else if forward.y.abs() < 0.1 {
            // A level plane seen from its edge: then across the picture.
            (forward, None)
        } else {
            (up, None)
        };
        let Some(there) = lens.on_plane(to, self.held, normal) else { return DVec3::ZERO };
        let by = match along {
            Some(axis) => axis * axis.dot(there - self.held),
            // Level to the last bit.
            None if normal == up => DVec3 { y: 0.0, ..there - self.held },
            None => there - self.held,
        };
        self.held += by;
        by
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene() -> Scene {
        let text = r#"
[camera]
eye = [0, 6, 10]
[[light]]
name = "lamp"
type = "point"
position = [2, 4, 0]
intensity = 30
[[object]]
name = "floor"
shape = { type = "plane" }
[[object]]
name = "ball"
shape = { type = "sphere", radius = 0.5 }
translation = [0, 0.5, 0]
"#;
        Scene::parse(text, "test".as_ref()).expect("a scene")
    }

    #[test]
    fn clicks_find_things() {
        let scene = scene();
        let lens = Lens::new(&scene.camera, DVec2::new(800.0, 600.0));
        let seen = |p| lens.project(p).expect("in front");
        let lamp = seen(DVec3::new(2.0, 4.0, 0.0));
        assert_eq!(at(&scene, 0.0, &lens, lamp + 5.0), Some(Item::Light(0)), "near its mark");
        assert_eq!(
            at(&scene, 0.0, &lens, seen(DVec3::new(0.0, 0.5, 0.0))),
            Some(Item::Object(1)),
            "the ball"
        );
        assert_eq!(
            at(&scene, 0.0, &lens, seen(DVec3::new(-3.0, 0.0, 0.0))),
            Some(Item::Object(0)),
            "the floor"
        );
        assert_eq!(at(&scene, 0.0, &lens, DVec2::new(400.0, -900.0)), None, "the sky");
        assert!(!is_loose(&scene, Item::Object(0)) && is_loose(&scene, Item::Object(1)), "floors stay");
    }

    #[test]
    fn what_is_dragged_stays_under_the_pointer() {
        let scene = scene();
        let lens = Lens::new(&scene.camera, DVec2::new(800.0, 600.0));
        let from = lens.project(DVec3::new(0.0, 0.5, 0.0)).expect("in front");
        let mut grip = Grip::new(&scene, 0.0, &lens, from, Item::Object(1)).expect("a ball");
        let held = grip.held;
        let to = from + DVec2::new(90.0, 40.0);
        let by = grip.drag(&lens, to, false);
        assert!(by.y == 0.0 && lens.project(held + by).expect("in front").distance(to) < 1e-6, "{by}");
        let up = grip.drag(&lens, to - DVec2::new(0.0, 50.0), true);
        assert!(up.x == 0.0 && up.z == 0.0 && up.y > 0.0, "{up} is upwards alone");
        assert_eq!(
            grip.drag(&lens, DVec2::new(400.0, -5000.0), false),
            DVec3::ZERO,
            "not beyond the horizon"
        );
    }
}
