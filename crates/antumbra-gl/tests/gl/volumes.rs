//! `volume`, in every way of counting, where shadow volumes are known to break.

use crate::cameras::{REVERSED, cameras};
use crate::context::{Gl, in_each_api};
use crate::depth_only::without;
use crate::occluders::nonsense;
use crate::shot::{Shot, VIEWPORT, each_batch};
use crate::world::{ONE_OF_EACH, World};
use antumbra_gl::Part;
use antumbra_gl::{Area, Error, Frame, Light, MeshOccluder, Occluder, Renderer, Technique};
use antumbra_math::{Shape, TriangleMesh};
use glam::{DMat4, DVec3, DVec4, Vec3};
use std::sync::Arc;

const COUNTINGS: [&str; 3] = ["per-volume", "depth-pass", "depth-fail"];

/// An eye that is on the edge of a volume, to rounding.
const ON_AN_EDGE: &str = "behind a corner of the wall";

/// A renderer for each way of counting.
fn renderers(gl: &Gl) -> Vec<Renderer> {
    let with = |counting: &str| {
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let technique = Technique::parse(&format!("volume:counting={counting}")).expect("a technique");
        renderer.set_technique(technique).expect("a technique");
        renderer
    };
    COUNTINGS.map(with).into()
}

/// Asserts that all lights of a frame are right, in every way of counting. Returns how many pixels were judged.
fn assert_right<'r>(
    gl: &Gl,
    renderers: impl IntoIterator<Item = &'r mut Renderer>,
    shot: &Shot<'_>,
    frame: &Frame<'_>,
    world: &World,
    what: &str,
) -> usize {
    let truth = world.truth(shot);
    let mut all = 0;
    for renderer in renderers {
        let what = format!("{:?}, {what}, {}", gl.kind, renderer.technique());
        let masks = shot.masks(renderer, frame);
        let judged: usize =
            masks.iter().enumerate().map(|(light, mask)| truth.assert_classified(light, mask, &what)).sum();
        all += judged;
        gl.assert_no_complaint(&what);
    }
    all
}

/// No projection cuts a volume: finite, infinite, reversed, off-centre, parallel, and parallel from behind the eye.
/// With the floor among the occluders volumes end there, without it they go on for ever, through the far plane.
#[test]
fn every_projection_has_the_right_shadows() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let endless: Vec<Occluder> =
            world.occluders.iter().copied().filter(|o| !matches!(o.shape, Shape::Plane(_))).collect();
        assert_eq!(endless.len() + 1, world.occluders.len(), "all but the floor");
        let mut renderers = renderers(gl);
        for (name, camera, format) in cameras(&world) {
            let shot = Shot::with(gl, &world, camera, VIEWPORT, format);
            let judged = assert_right(gl, &mut renderers, &shot, &shot.frame(), &world, name);
            assert!(judged > 50_000, "{name}: {judged} pixels are judged");
            let frame = shot.frame().occluders(&endless);
            assert_right(gl, &mut renderers, &shot, &frame, &world, &format!("{name}, endless"));
        }
    });
}

/// The surface's kind decides nothing but which polygons are left out.
#[test]
fn every_kind_of_surface_has_the_right_shadows() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let mut renderers = renderers(gl);
        for (normals, ids) in [(true, true), (true, false), (false, true), (false, false)] {
            let frame = without(&shot, normals, ids);
            let what = format!("normals {normals}, ids {ids}");
            let judged = assert_right(gl, &mut renderers, &shot, &frame, &world, &what);
            assert!(judged > 50_000, "{what}: {judged} pixels are judged");
            // A host without ids has none for its occluders either.
            let nameless: Vec<Occluder> = world.occluders.iter().map(|o| o.with_id(0)).collect();
            if !ids {
                let frame = frame.occluders(&nameless);
                assert_right(gl, &mut renderers, &shot, &frame, &world, "nameless occluders");
            }
        }
    });
}

/// Eyes inside one volume, inside several, in a ball's shadow a hair from its surface, and on the line from a
/// light through a corner, where sides are seen edge-on.
#[test]
fn an_eye_inside_volumes_sees_the_right_shadows() {
    in_each_api(|gl| {
        let mut renderers = renderers(gl);
        let ball = DVec3::new(-1.0, 1.0, 0.3);
        let light = DVec3::new(2.0, 5.0, 3.0);
        let away = (ball - light).normalize();
        let sun = DVec3::new(0.5, -1.0, -0.4).normalize();
        let views = [
            ("in the ball's shadow", ball + away * 0.8, DVec3::new(1.0, 0.0, -1.0)),
            ("in it, looking at the light", ball + away * 0.9, ball),
            ("at the ball's dark side", ball + away * 0.6001, DVec3::new(-2.0, 0.0, -1.5)),
            ("in the sun's shadow of the ball", ball + sun * 0.7, DVec3::new(1.0, 0.3, 0.0)),
            (
                "on the edge of the ball's shadow",
                ball + away * 0.3 + away.any_orthonormal_vector() * 0.67,
                DVec3::ZERO,
            ),
            (
                ON_AN_EDGE,
                DVec3::new(3.0, 2.5, -2.0) + (DVec3::new(3.0, 2.5, -2.0) - light) * 0.2,
                DVec3::ZERO,
            ),
            ("at the light", light, DVec3::ZERO),
            ("along the sun", ball - sun * 5.0, ball),
            ("into the sun", ball + sun * 1.1, ball - sun * 5.0),
        ];
        let mut judged = 0;
        for (what, eye, target) in views {
            let [e, t] = [eye, target].map(|v| format!("[{}, {}, {}]", v.x, v.y, v.z));
            let text = ONE_OF_EACH
                .replace("eye = [1.0, 3.5, 7.0]", &format!("eye = {e}"))
                .replace("target = [0.0, 0.6, 0.0]", &format!("target = {t}"));
            let world = World::parse(&text);
            let mut camera = world.camera(VIEWPORT);
            // Reversed: depth is near / distance.
            (camera.projection.z_axis.z, camera.projection.w_axis.z) = (0.0, 1e-4);
            let shot = Shot::with(gl, &world, camera, VIEWPORT, REVERSED);
            // Starting from the volumes that hold the eye, which is in none and in all.
            let able = renderers
                .iter_mut()
                .filter(|r| what != ON_AN_EDGE || r.technique().to_string() != "volume:counting=depth-pass");
            judged += assert_right(gl, able, &shot, &shot.frame(), &world, what);
        }
        assert!(judged > 200_000, "{judged} pixels are judged");
    });
}

/// Parallel sight begins infinitely far behind the eye's plane, and so do the polygons that count: what casts may be
/// on either side of it, and the whole picture may begin in shadow.
#[test]
fn parallel_sight_passes_what_is_behind_the_eye() {
    in_each_api(|gl| {
        let mut renderers = renderers(gl);
        // A ball behind the eye's plane, between it and the light; one whose shadow of the lamp holds all that is
        // behind the eye.
        for ball in ["[0.6, 4.5, 5.5]", "[1.4, 5.4, 10.0]", "[1.6, 4.4, 2.6]"] {
            let text =
                ONE_OF_EACH.replace("translation = [-1.0, 1.0, 0.3]", &format!("translation = {ball}"));
            let world = World::parse(&text);
            let mut camera = world.camera(VIEWPORT);
            let (far, aspect) = (40.0, 4.0 / 3.0);
            camera.projection = DMat4::from_cols(
                DVec4::X / (3.0 * aspect),
                DVec4::Y / 3.0,
                DVec4::Z * (-2.0 / far),
                DVec4::new(0.0, 0.0, -1.0, 1.0),
            );
            let shot = Shot::with(gl, &world, camera, VIEWPORT, antumbra_gl::DepthFormat::default());
            let what = format!("a ball at {ball}");
            let judged = assert_right(gl, &mut renderers, &shot, &shot.frame(), &world, &what);
            assert!(judged > 50_000, "{what}: {judged} pixels are judged");
        }
    });
}

/// Light in the plane of a flat caster, on it, inside a solid and in its corner: what the analytic technique says, but
/// for pixels on edges.
#[test]
fn lights_in_awkward_places_are_those_of_the_closed_forms() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let mut renderers = renderers(gl);
        let mut analytic = Renderer::new(gl.gl.clone()).expect("a renderer");
        let casters = [
            Occluder::disc(DVec3::Y * 2.0, DVec3::Y, 0.5),
            Occluder::rectangle(DVec3::Y * 2.0, DVec3::X, DVec3::Z),
            Occluder::triangle([DVec3::Y * 2.0, DVec3::new(1.0, 2.0, 0.0), DVec3::new(0.0, 2.0, 1.0)]),
            Occluder::sphere(DVec3::Y * 2.0, 0.5),
            Occluder::cone(DVec3::Y * 2.0, DVec3::Y * 3.0, 0.5),
        ];
        let places = [
            DVec3::new(3.0, 2.0, 0.5),  // in the planes
            DVec3::new(0.1, 2.0, 0.05), // in the flat shapes, and inside the solids
            DVec3::new(0.1, 2.2, 0.05), // inside the solids
            DVec3::Y * 3.0,             // at the apex
            DVec3::Y * 8.0,             // straight above
        ];
        for caster in casters.map(|c| c.with_id(99)) {
            for place in places {
                let lights = [Light::point(place, Vec3::ONE)];
                let these = [caster];
                let frame = shot.frame().lights(&lights).occluders(&these);
                let expected = shot.masks(&mut analytic, &frame).remove(0);
                // What is in a solid with the light is dark to the closed forms, and lit in truth.
                let (center, radius) = caster.shape.bounding_sphere();
                let inside =
                    |i: usize| shot.seen[i].is_some_and(|s| s.point.distance(center) < radius * 1.01);
                let mut judged = [0, 0];
                let settled = |i: usize| {
                    let (x, y) = (i % 160, i / 160);
                    let is_inner = x > 1 && y > 1 && x < 158 && y < 118;
                    is_inner
                        && (-2isize..=2).all(|dy| {
                            (-2isize..=2)
                                .all(|dx| expected[i] == expected[i.wrapping_add_signed(dy * 160 + dx)])
                        })
                };
                // On a solid's very surface, to rounding, a light is inside or outside: then all or little is dark.
                let is_solid = matches!(caster.shape, Shape::Cone(_));
                let on_surface = is_solid && (place.y == 2.0 || place == DVec3::Y * 3.0);
                for renderer in &mut renderers {
                    let mask = shot.masks(renderer, &frame).remove(0);
                    assert!(mask.iter().all(|&m| m == 0 || m == 255), "lit or dark");
                    if on_surface {
                        continue;
                    }
                    let counts: Vec<usize> = (0..mask.len()).filter(|&i| settled(i) && !inside(i)).collect();
                    let dark = counts.iter().filter(|&&i| expected[i] == 0).count();
                    judged = [judged[0] + counts.len(), judged[1] + dark];
                    let wrong = counts.iter().filter(|&&i| mask[i] != expected[i]).count();
                    assert_eq!(wrong, 0, "{caster:?}, light at {place}, {}", renderer.technique());
                }
                assert!(
                    on_surface || judged[0] > 20_000,
                    "{caster:?}, light at {place}: {judged:?} are judged"
                );
                let above = place == DVec3::Y * 8.0;
                assert!(!above || judged[1] > 30, "{caster:?}: a shadow below the light, {judged:?}");
            }
        }
        gl.assert_no_complaint("awkward lights");
    });
}

#[test]
fn casters_that_are_none_cast_nothing() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        for mut renderer in renderers(gl) {
            for id in [0, 99] {
                for occluder in nonsense() {
                    let these = [occluder.with_id(id)];
                    let frame = shot.frame().occluders(&these);
                    let masks = shot.masks(&mut renderer, &frame);
                    assert!(masks.iter().flatten().all(|&m| m == 255), "{occluder:?} casts a shadow");
                }
            }
            // No casters, no lights, and lights that are nowhere.
            let bare = shot.frame().occluders(&[]);
            assert!(shot.masks(&mut renderer, &bare).iter().flatten().all(|&m| m == 255), "all is lit");
            assert_eq!(renderer.stats().polygons, 0, "nothing is drawn");
            assert!(shot.masks(&mut renderer, &shot.frame().lights(&[])).is_empty(), "no mask");
            let nowhere = [DVec3::NAN, DVec3::INFINITY].map(|p| Light::point(p, Vec3::ONE));
            let dark = [Light::directional(DVec3::ZERO, Vec3::ONE), Light::point(DVec3::Y * 5.0, Vec3::ZERO)];
            for lights in [nowhere, dark] {
                let masks = shot.masks(&mut renderer, &shot.frame().lights(&lights));
                assert!(masks.iter().flatten().all(|&m| m == 255), "{lights:?} are off");
            }
        }
        gl.assert_no_complaint("nonsense");
    });
}

/// A mesh in a mirror is the mirrored mesh, and one that is far too large or small for float32 is no trouble.
#[test]
fn meshes_cast_in_any_affine_pose() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let cone = Arc::new(TriangleMesh::cone(0.6, 1.2, 48).expect("a cone"));
        let tiny = Arc::new(TriangleMesh::cone(0.6e-20, 1.2e-20, 48).expect("a cone"));
        let pose = DMat4::from_translation(DVec3::new(0.3, 2.0, 0.0)) * DMat4::from_rotation_z(0.7);
        // The cone's 48 sides are the same in the mirror.
        let mirror = DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0));
        let grown = DMat4::from_scale(DVec3::splat(1e20));
        for renderer in &mut renderers(gl) {
            let mut cast = |mesh: &Arc<TriangleMesh>, model: DMat4| {
                let meshes = [MeshOccluder::new(mesh.clone(), model).with_id(99)];
                shot.masks(renderer, &shot.frame().occluders(&[]).meshes(&meshes))
            };
            let plain = cast(&cone, pose);
            assert!(
                plain.iter().all(|mask| mask.iter().filter(|&&m| m == 0).count() > 100),
                "it casts shadows"
            );
            for (what, mesh, model) in [("mirrored", &cone, pose * mirror), ("grown", &tiny, pose * grown)] {
                let other = cast(mesh, model);
                let off = plain.iter().flatten().zip(other.iter().flatten()).filter(|(a, b)| a != b).count();
                assert!(off <= 3, "{what}: {off} pixels differ");
            }
        }
        gl.assert_no_complaint("meshes");
    });
}

/// A surface of the floor's own height lies under a disc and under nothing: no acne where a flat caster lies on its
/// receiver.
#[test]
fn what_lies_in_a_flat_casters_plane_is_lit() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let sheet = Occluder::rectangle(DVec3::new(0.5, 0.0, 0.5), DVec3::X * 1.5, DVec3::Z * 1.5);
        for mut renderer in renderers(gl) {
            for id in [0, 99] {
                let these = [sheet.with_id(id)];
                let frame = shot.frame().occluders(&these);
                let masks = shot.masks(&mut renderer, &frame);
                let dark = masks.iter().flatten().filter(|&&m| m != 255).count();
                assert_eq!(
                    dark,
                    0,
                    "{}, id {id}: the sheet shadows the floor it lies on",
                    renderer.technique()
                );
            }
        }
    });
}

#[test]
fn lights_with_an_area_are_refused() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let lamp = world.lights[0].with_area(Area::Sphere { radius: 0.1 });
        let these_lights = [world.lights[1], lamp];
        let frame = shot.frame().lights(&these_lights);
        for mut renderer in renderers(gl) {
            let Err(Error::Refused { technique: "volume", refusal }) =
                each_batch(&mut renderer, &frame, |_| {})
            else {
                panic!("an area was accepted");
            };
            assert!(
                refusal.part == Part::Light(1) && refusal.reason.to_string().contains("area"),
                "{refusal:?}"
            );
        }
        let fail = Technique::parse("volume:counting=depth-fail").expect("a technique");
        assert_eq!(fail.to_string(), "volume:counting=depth-fail", "written as read");
        let says = Technique::parse("volume:counting=zfail").expect_err("no such way").to_string();
        assert!(says.contains("per-volume or depth-pass or depth-fail"), "{says}");
    });
}

/// A known limit: the count is one of eight bits. 255 sheets on top of each other are dark, 256 are none.
#[test]
fn the_256th_layer_turns_the_light_on() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let lights = [Light::point(DVec3::Y * 8.0, Vec3::ONE)];
        let sheets: Vec<Occluder> = (0..256)
            .map(|i| Occluder::rectangle(DVec3::Y * (4.0 + 0.002 * f64::from(i)), DVec3::X, DVec3::Z))
            .collect();
        for mut renderer in renderers(gl) {
            let mut under = |count: usize| {
                let frame = shot.frame().lights(&lights).occluders(&sheets[..count]);
                let mask = shot.masks(&mut renderer, &frame).remove(0);
                let is_under =
                    |s: &antumbra_reference::Surface| s.point.y == 0.0 && s.point.abs().max_element() < 1.0;
                let seen = shot.seen.iter().zip(&mask).filter(|(s, _)| s.as_ref().is_some_and(is_under));
                seen.map(|(_, &m)| m).collect::<Vec<u8>>()
            };
            assert!(under(255).len() > 100 && under(255).iter().all(|&m| m == 0), "255 layers are dark");
            assert!(under(256).iter().all(|&m| m == 255), "256 are counted as none");
        }
    });
}
