//! Known geometry, the ray tracer, every scene of the gallery, and poses that make no sense.

use std::path::Path;

use antumbra_host::describe;
use antumbra_reference::{Ray, Tracer};
use antumbra_scene::{Moment, Scene};
use glam::DVec3;

use super::{Drawing, Fact, Line, LineKind, Situation};

/// A floor, a light (the keys after its name) and an object (the keys after its name).
fn scene(light: &str, object: &str) -> Scene {
    let text = format!(
        "camera = {{ eye = [0, 9, 9] }}\n\
         [[light]]\nname = \"lamp\"\nintensity = 100\n{light}\n\
         [[object]]\nname = \"floor\"\nshape = {{ type = \"plane\" }}\n\
         [[object]]\nname = \"thing\"\n{object}\n"
    );
    Scene::parse(&text, "test.toml".as_ref()).expect("a good scene")
}

fn ball(y: f64, radius: f64) -> String {
    format!("shape = {{ type = \"sphere\", radius = {radius} }}\ntranslation = [0, {y}, 0]")
}

fn with<T>(scene: &Scene, moment: &Moment, use_it: impl FnOnce(&Situation<'_>) -> T) -> T {
    let described = describe(scene, moment).expect("meshes are meshes");
    use_it(&Situation::new(scene, moment, &described))
}

/// Everything there is to draw and to say about light 0 and object 1, the "thing".
fn all(scene: &Scene) -> (Drawing, Vec<Fact>) {
    with(scene, &scene.moment(0.0), |situation| {
        let mut drawing = Drawing::default();
        situation.outlines(0, 1, &mut drawing);
        situation.tangent_rays(0, 1, 24, &mut drawing);
        situation.volume(0, 1, 3.0, &mut drawing);
        (drawing, situation.facts(0, 1))
    })
}

fn of(drawing: &Drawing, kind: LineKind) -> Vec<&Line> {
    drawing.lines.iter().filter(|line| line.kind == kind).collect()
}

fn only(drawing: &Drawing, kind: LineKind) -> &Line {
    let lines = of(drawing, kind);
    assert_eq!(lines.len(), 1, "one {kind:?}, not {lines:?}");
    lines[0]
}

fn value<'a>(fact: &'a Fact, label: &str) -> &'a str {
    let found = fact.lines.iter().find(|line| line.0 == label);
    &found.unwrap_or_else(|| panic!("no {label} in {fact:?}")).1
}

/// The tangent cone of a ball at height 2 from a light at height 6, 3 aside: with a = 4, q = a² - r² = 15 and
/// s² = 25 - 1 = 24 the centre is 3 a 6 / q = 4.8 from the light's foot, the semi-axes 6 s / q and 6 / √q.
#[test]
fn a_ball_under_a_point_light_has_the_ellipse_computed_by_hand() {
    let scene = scene("type = \"point\"\nposition = [-3, 6, 0]", &ball(2.0, 1.0));
    let (drawing, facts) = all(&scene);
    let (center, a, b) = (1.8, 6.0 * 24f64.sqrt() / 15.0, 6.0 / 15f64.sqrt());
    let ellipse = |p: DVec3| ((p.x - center) / a).powi(2) + (p.z / b).powi(2);
    let edge = only(&drawing, LineKind::HardEdge);
    assert!(edge.closed && edge.points.len() >= 100, "{edge:?}");
    for p in &edge.points {
        assert!((ellipse(*p) - 1.0).abs() < 1e-9 && p.y.abs() < 1e-12, "{p} is not on it");
    }
    let rays = of(&drawing, LineKind::TangentRay);
    assert_eq!(rays.len(), 24);
    for ray in rays {
        let [from, by, end] = ray.points[..] else { panic!("{ray:?}") };
        assert_eq!(from, DVec3::new(-3.0, 6.0, 0.0));
        assert!((ellipse(end) - 1.0).abs() < 1e-9, "{end} is not on the edge");
        let middle = DVec3::Y * 2.0;
        let distance = (end - from).cross(middle - from).length() / (end - from).length();
        assert!((distance - 1.0).abs() < 1e-9, "passes the centre at {distance}");
        assert!((by.distance(middle) - 1.0).abs() < 1e-9, "touches at {by}");
        assert!((by - from).cross(end - from).length() < 1e-9, "{by} is not on the way");
    }
    assert_eq!(facts.len(), 1);
    assert_eq!(facts[0].title, "Shadow of thing from lamp on floor");
    assert_eq!(value(&facts[0], "shape"), "ellipse");
    assert_eq!(value(&facts[0], "centre"), "(1.8, 0, 0) m");
    assert_eq!(value(&facts[0], "semi-axes"), "1.96 m and 1.549 m");
    let e = (1.0 - (b / a).powi(2)).sqrt();
    assert_eq!(value(&facts[0], "eccentricity"), format!("{e:.4}"));
    assert_eq!(value(&facts[0], "area"), format!("{:.3} m²", std::f64::consts::PI * a * b));
}

/// A light of radius 0.5 at height 5 over a ball of radius 1 at 1.5: the outer cone's apex is at 8.5, its sine 1/7; the
/// inner one's at 1.5 + 7/3, its sine 3/7.
#[test]
fn umbra_and_penumbra_are_those_computed_by_hand() {
    let (drawing, facts) =
        all(&scene("type = \"sphere\"\nradius = 0.5\nposition = [0, 5, 0]", &ball(1.5, 1.0)));
    let umbra = 8.5 / 48f64.sqrt();
    let penumbra = (1.5 + 7.0 / 3.0) * 3.0 / 40f64.sqrt();
    for (kind, ray, radius) in
        [(LineKind::Umbra, LineKind::UmbraRay, umbra), (LineKind::Penumbra, LineKind::PenumbraRay, penumbra)]
    {
        for p in &only(&drawing, kind).points {
            assert!((p.length() - radius).abs() < 1e-9, "{kind:?} at {p}, not {radius}");
        }
        let rays = of(&drawing, ray);
        assert_eq!(rays.len(), 24);
        for line in rays {
            let [from, by, end] = line.points[..] else { panic!("{line:?}") };
            assert!((end.length() - radius).abs() < 1e-9, "{ray:?} ends at {end}");
            for (middle, size) in [(DVec3::Y * 5.0, 0.5), (DVec3::Y * 1.5, 1.0)] {
                let distance = (end - from).cross(middle - from).length() / (end - from).length();
                assert!((distance - size).abs() < 1e-9, "{ray:?} passes {middle} at {distance}");
            }
            assert!((by.distance(DVec3::Y * 1.5) - 1.0).abs() < 1e-9, "touches at {by}");
        }
    }
    assert!(of(&drawing, LineKind::Antumbra).is_empty());
    let titles: Vec<&str> = facts.iter().map(|fact| fact.title.as_str()).collect();
    assert_eq!(
        titles,
        ["Penumbra's outer edge of thing from lamp on floor", "Umbra of thing from lamp on floor"]
    );
    assert_eq!(value(&facts[1], "radius"), format!("{umbra:.3} m"));
    assert_eq!(value(&facts[1], "apex of the cone"), "(0, 8.5, 0) m");
}

/// A light of radius 2 at height 5 over a ball of radius 0.5 at 2: the umbra ends at height 1, and its cone's sine is 1/2.
#[test]
fn the_antumbra_is_the_one_computed_by_hand() {
    let (drawing, facts) =
        all(&scene("type = \"sphere\"\nradius = 2\nposition = [0, 5, 0]", &ball(2.0, 0.5)));
    for p in &only(&drawing, LineKind::Antumbra).points {
        assert!((p.length() - 3f64.sqrt().recip()).abs() < 1e-9, "{p}");
    }
    assert!(of(&drawing, LineKind::Umbra).is_empty());
    assert_eq!(of(&drawing, LineKind::UmbraRay).len(), 24, "rays past light and ball");
    for ray in of(&drawing, LineKind::UmbraRay) {
        assert!((ray.points[2].length() - 3f64.sqrt().recip()).abs() < 1e-9, "{ray:?}");
    }
    assert_eq!(facts.len(), 2);
}

/// Twice the occluder's size, and the light's the other way round: p = 2 q - s.
#[test]
fn rectangles_and_discs_under_flat_lights() {
    let card = "shape = { type = \"rectangle\", width = 2, depth = 2 }\ntranslation = [0, 2, 0]";
    let rectangle = "type = \"rectangle\"\ndirection = [0, -1, 0]\nright = [1, 0, 0]\nwidth = 1\nheight = 1";
    let disc = "type = \"disc\"\ndirection = [0, -1, 0]\nradius = 0.5";
    for light in [rectangle, disc] {
        let (drawing, _) = all(&scene(&format!("{light}\nposition = [0, 4, 0]"), card));
        for (kind, half) in [(LineKind::Penumbra, 2.5), (LineKind::Umbra, 1.5)] {
            let line = only(&drawing, kind);
            assert!(line.closed, "{line:?}");
            let (low, high) =
                line.points.iter().fold((DVec3::MAX, DVec3::MIN), |(l, h), p| (l.min(*p), h.max(*p)));
            let error =
                (high - DVec3::new(half, 0.0, half)).abs().max((low + DVec3::new(half, 0.0, half)).abs());
            assert!(error.max_element() < 1e-9, "{kind:?} under {light}: {low} to {high}");
        }
        assert!(drawing.notes.is_empty(), "{:?}", drawing.notes);
        assert!(of(&drawing, LineKind::PenumbraRay).len() > 3, "no rays under {light}");
    }
    let (drawing, _) = all(&scene(&format!("{disc}\nposition = [0, 4, 0]"), &ball(2.0, 0.8)));
    assert_eq!(drawing.notes.len(), 1, "the missing umbra is said: {:?}", drawing.notes);
}

/// A box of side 1 at height 1 under a light at 3: the top's shadow is twice as large.
#[test]
fn boxes_have_the_edges_of_their_tops() {
    let cube = "shape = { type = \"box\", size = [1, 1, 1] }\ntranslation = [0, 1, 0]";
    let (drawing, _) = all(&scene("type = \"point\"\nposition = [0, 3, 0]", cube));
    for p in &only(&drawing, LineKind::HardEdge).points {
        assert!((p.abs().max_element() - 1.0).abs() < 1e-9, "{p}");
    }
    let rays = of(&drawing, LineKind::TangentRay);
    assert_eq!(rays.len(), 24, "on straight sides too");
    for ray in rays {
        assert!((ray.points[2].abs().max_element() - 1.0).abs() < 1e-9, "{ray:?}");
        assert!((ray.points[1].y - 1.5).abs() < 1e-9, "{ray:?}");
    }
    // The silhouette of the box is its top, and every side of the volume ends on the floor.
    assert_eq!(only(&drawing, LineKind::NearCap).points.len(), 4);
    let sides = of(&drawing, LineKind::VolumeSide);
    assert_eq!(sides.len(), 4);
    for side in sides {
        let [a, b, c, d] = side.points[..] else { panic!("{side:?}") };
        assert!(a.y == 1.5 && b.y == 1.5 && c.y.abs() < 1e-12 && d.y.abs() < 1e-12, "{side:?}");
        assert!((c.x.abs() - 1.0).abs() < 1e-12 && (c.z.abs() - 1.0).abs() < 1e-12, "{side:?}");
    }
}

/// What reaches through the floor casts from its silhouette, and a torus always does.
#[test]
fn other_meshes_have_silhouettes() {
    let light = "type = \"directional\"\ndirection = [0.3, -1, 0.2]";
    for shape in [
        "type = \"torus\", major_radius = 1, minor_radius = 0.3",
        "type = \"capsule\", radius = 0.4, height = 2",
    ] {
        let (drawing, _) = all(&scene(light, &format!("shape = {{ {shape} }}\ntranslation = [0, 0.5, 0]")));
        assert!(of(&drawing, LineKind::HardEdge).is_empty(), "{shape}");
        assert!(!of(&drawing, LineKind::Silhouette).is_empty(), "{shape}");
        assert!(!of(&drawing, LineKind::TangentRay).is_empty(), "{shape}");
    }
    let (drawing, _) = all(&scene(light, &ball(1.0, 0.5)));
    let near = only(&drawing, LineKind::NearCap);
    assert!(near.closed && near.points.len() >= 128, "a ball's silhouette has {} points", near.points.len());
    assert_eq!(of(&drawing, LineKind::VolumeSide).len(), near.points.len());
}

/// Lines end where a spot's cone does: 20° around straight down from height 4 is 1.456 m.
#[test]
fn spots_light_a_part_of_the_edge() {
    let light = "type = \"spot\"\nposition = [0, 4, 0]\ndirection = [0, -1, 0]\nouter_angle = 20";
    let thing = "shape = { type = \"sphere\", radius = 0.5 }\ntranslation = [0.7, 1, 0]";
    let (drawing, _) = all(&scene(light, thing));
    let edge = only(&drawing, LineKind::HardEdge);
    let reach = 4.0 * 20f64.to_radians().tan();
    assert!(!edge.closed && edge.points.len() > 10, "{edge:?}");
    assert!(edge.points.iter().all(|p| p.length() <= reach + 1e-9), "beyond the cone");
    let ends = [edge.points[0], edge.points[edge.points.len() - 1]];
    assert!(ends.iter().all(|p| (p.length() - reach).abs() < 1e-3), "cut at the cone: {ends:?}");
    let rays = of(&drawing, LineKind::TangentRay);
    assert!(
        !rays.is_empty() && rays.len() < 24 && rays.iter().all(|ray| ray.points[2].length() <= reach + 1e-9)
    );
}

/// Against ray casts: outside the penumbra's edge all of the light arrives, inside not all of it; in the umbra nothing,
/// outside it something.
#[test]
fn outlines_divide_what_the_ray_tracer_sees() {
    let lights = [
        "type = \"sphere\"\nradius = 0.6\nposition = [-1, 6, 0.5]",
        "type = \"disc\"\nradius = 0.6\ndirection = [0.2, -1, 0]\nposition = [-1, 6, 0.5]",
        "type = \"rectangle\"\ndirection = [0.2, -1, 0]\nright = [1, 0.2, 0]\nwidth = 1.4\nheight = 0.8\n\
         position = [-1, 6, 0.5]",
        "type = \"point\"\nposition = [-1, 6, 0.5]",
        "type = \"directional\"\ndirection = [0.3, -1, 0.1]",
    ];
    let shapes = [
        "type = \"sphere\", radius = 0.8",
        "type = \"ellipsoid\", radii = [0.9, 0.5, 0.7]",
        "type = \"cone\", radius = 0.8, height = 1.2",
        "type = \"cylinder\", radius = 0.8, height = 1.2, radius_top = 0.4",
        "type = \"capsule\", radius = 0.5, height = 0.8",
        "type = \"box\", size = [1, 0.6, 1.4]",
        "type = \"disc\", radius = 0.9",
        "type = \"rectangle\", width = 1.6, depth = 1.2",
        "type = \"triangle\", vertices = [[-1, 0, -0.6], [1, 0.2, -0.7], [0, -0.1, 1]]",
    ];
    let mut checked = 0;
    for light in lights {
        for shape in shapes {
            let thing =
                format!("shape = {{ {shape} }}\ntranslation = [0.2, 1.8, 0]\nrotation = [0.1, 0.2, 0.15, 1]");
            let scene = scene(light, &thing);
            let (drawing, _) = all(&scene);
            let tracer = Tracer::new(&scene, 0.0);
            let visible = |p: DVec3| {
                let down = Ray::new(p.with_y(1e-3), DVec3::NEG_Y);
                let floor = tracer.surface(&down).expect("the floor");
                tracer.visibility_at(0, &floor, 1024, 7)
            };
            let before = checked;
            for line in &drawing.lines {
                let fits = |outside: f64, inside: f64| match line.kind {
                    LineKind::HardEdge => outside == 1.0 && inside == 0.0,
                    LineKind::Penumbra => outside == 1.0 && inside < 1.0,
                    _ => outside > 0.0 && inside == 0.0,
                };
                if ![LineKind::HardEdge, LineKind::Penumbra, LineKind::Umbra].contains(&line.kind) {
                    continue;
                }
                let middle = line.points.iter().sum::<DVec3>() / line.points.len() as f64;
                // A step that shows in 1024 rays; the chords are within a thousandth of the edge.
                let step = if line.kind == LineKind::HardEdge { 0.003 } else { 0.08 };
                for p in line.points.iter().step_by(3) {
                    let outside = visible(middle + (*p - middle) * (1.0 + step));
                    let inside = visible(middle + (*p - middle) * (1.0 - step));
                    assert!(
                        fits(outside, inside),
                        "{shape} under {light}, {:?} at {p}: {outside} outside, {inside} inside",
                        line.kind
                    );
                    checked += 1;
                }
            }
            assert!(checked > before, "{shape} under {light} has an outline");
        }
    }
    assert!(checked > 1500, "only {checked} points");
}

fn check(drawing: &Drawing, facts: &[Fact], what: &str) {
    for line in &drawing.lines {
        assert!(line.points.len() >= 2, "{what}: {line:?}");
        assert!(line.points.iter().all(|p| p.is_finite()), "{what}: {line:?}");
    }
    for fact in facts {
        let wrong = fact.lines.iter().find(|(_, value)| value.contains("NaN"));
        assert!(wrong.is_none(), "{what}: {fact:?}");
    }
}

#[test]
fn every_scene_at_many_times() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut seen = [0; 3];
    for entry in folder.read_dir().expect("the gallery") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let scene = Scene::load(&path).expect("the gallery's scenes are good");
        for step in 0..5 {
            let time = f64::from(step) * 1.37;
            let moment = scene.moment(time);
            let what = format!("{} at {time}", path.display());
            with(&scene, &moment, |situation| {
                for (light, primitive) in
                    situation.pairs().step_by(if scene.lights.len() > 20 { 37 } else { 1 })
                {
                    let mut drawing = Drawing::default();
                    situation.outlines(light, primitive, &mut drawing);
                    situation.tangent_rays(light, primitive, 16, &mut drawing);
                    let facts = situation.facts(light, primitive);
                    let points: usize = drawing.lines.iter().map(|line| line.points.len()).sum();
                    let receivers = situation.receivers.len();
                    assert!(points <= receivers * 6000, "{what}: {points} points on {receivers} receivers");
                    situation.volume(light, primitive, 5.0, &mut drawing);
                    check(&drawing, &facts, &what);
                    seen[0] += drawing.lines.len();
                    seen[1] += facts.len();
                    seen[2] += drawing.notes.len();
                }
            });
        }
    }
    assert!(seen[0] > 10_000 && seen[1] > 500, "{seen:?} lines, facts and notes");
}

/// Light inside, on and beneath things, and numbers that are none: no line, or a line that is finite.
#[test]
fn poses_that_make_no_sense() {
    let kinds = [
        "type = \"point\"",
        "type = \"sphere\"\nradius = 0.5",
        "type = \"disc\"\nradius = 0.5\ndirection = [0, -1, 0]",
        "type = \"rectangle\"\nwidth = 1\nheight = 1\nright = [1, 0, 0]\ndirection = [0, -1, 0]",
        "type = \"spot\"\ndirection = [0, -1, 0]",
    ];
    let shapes = [
        "type = \"sphere\", radius = 1",
        "type = \"cone\", radius = 1, height = 2",
        "type = \"disc\", radius = 1",
        "type = \"rectangle\", width = 2, depth = 2",
        "type = \"triangle\", vertices = [[-1, 0, -1], [1, 0, -1], [0, 0, 1]]",
        "type = \"box\", size = [2, 2, 2]",
        "type = \"torus\", major_radius = 1, minor_radius = 0.5",
        "type = \"plane\"",
    ];
    let heights = [-3.0, -1.0, 0.0, 1.0, 2.0, 3.0, 1e9, 1e-300, f64::NAN, f64::INFINITY];
    let mut lines = 0;
    for kind in kinds {
        for shape in shapes {
            let scene = scene(&format!("{kind}\nposition = [0, 3, 0]"), &format!("shape = {{ {shape} }}"));
            for light in heights {
                for thing in heights {
                    let mut moment = scene.moment(0.0);
                    moment.lights[0].position.y = light;
                    moment.primitives[1].pose.translation.y = thing;
                    with(&scene, &moment, |situation| {
                        let mut drawing = Drawing::default();
                        situation.outlines(0, 1, &mut drawing);
                        situation.tangent_rays(0, 1, 8, &mut drawing);
                        situation.tangent_rays(0, 1, 0, &mut drawing);
                        for distance in [1.0, 0.0, -1.0, f64::NAN, f64::INFINITY, 1e300] {
                            situation.volume(0, 1, distance, &mut drawing);
                        }
                        let facts = situation.facts(0, 1);
                        check(&drawing, &facts, &format!("{shape} at {thing}, {kind} at {light}"));
                        lines += drawing.lines.len();
                        // Numbers that do not exist.
                        let before = drawing.clone();
                        for (light, primitive) in [(1, 1), (0, 2), (usize::MAX, usize::MAX)] {
                            situation.outlines(light, primitive, &mut drawing);
                            situation.tangent_rays(light, primitive, 8, &mut drawing);
                            situation.volume(light, primitive, 1.0, &mut drawing);
                            assert!(situation.facts(light, primitive).is_empty());
                        }
                        assert_eq!(drawing, before);
                    });
                }
            }
        }
    }
    assert!(lines > 1000, "only {lines} lines");
}
