//! Surfaces with and without normals and ids, in every format.

use crate::context::in_each_api;
use crate::lights::{STEP, overlay};
use crate::shot::{Shot, VIEWPORT, known, texture};
use crate::world::World;
use antumbra_gl::{DepthFormat, Encoding, Frame, NormalSpace, Normals, Renderer};
use glam::{DMat3, DVec3};
use glow::HasContext;

/// The surface without one thing or the other.
pub(crate) fn without<'w>(shot: &Shot<'w>, normals: bool, ids: bool) -> Frame<'w> {
    let mut frame = shot.frame();
    if !normals {
        frame.surface.normals = None;
    }
    if !ids {
        frame.surface.ids = None;
    }
    frame
}

/// Every kind of surface has the shadows that the ray tracer has: no acne on any shape, no detached
/// shadows.
#[test]
fn every_kind_of_surface_has_the_right_shadows() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let truth = world.truth(&shot);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        for (normals, ids) in [(true, true), (true, false), (false, true), (false, false)] {
            let frame = without(&shot, normals, ids);
            for (light, mask) in shot.masks(&mut renderer, &frame).iter().enumerate() {
                let wrong = (0..mask.len())
                    .filter(|&i| truth.sure[i] && truth.lights[light][i].1.max_element() > 0.0)
                    .filter(|&i| (f32::from(mask[i]) / 255.0 - truth.lights[light][i].0).abs() > 0.5)
                    .count();
                assert_eq!(wrong, 0, "normals {normals}, ids {ids}, light {light}: pixels are wrong");
            }
            gl.assert_no_complaint("masks");
            if normals && ids {
                truth.assert_overlay(&overlay(gl, &mut renderer, &frame, Encoding::Linear), STEP);
            }
        }
    });
}

/// An object that the light shines on does not shadow itself, seen by depth alone: the lit side of
/// each shape stays lit, with 24 and with 16 bits of depth.
#[test]
fn lit_sides_stay_lit_without_ids() {
    in_each_api(|gl| {
        for bits in [24, 16] {
            let world = World::one_of_each();
            let format = DepthFormat::fixed(bits);
            // A near plane that is not wasteful: 16 bits are few.
            let mut camera = world.camera(VIEWPORT);
            camera.projection.w_axis.z = -8.0;
            let shot = Shot::with(gl, &world, camera, VIEWPORT, format);
            let truth = world.truth(&shot);
            let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
            for own in &world.occluders {
                let mut judged = 0;
                let these = [*own];
                let frame = without(&shot, false, false).occluders(&these);
                for (light, mask) in shot.masks(&mut renderer, &frame).iter().enumerate() {
                    let lit: Vec<usize> = (0..mask.len())
                        .filter(|&i| truth.sure[i] && shot.seen[i].is_some_and(|s| s.primitive + 1 == own.id))
                        // Off the terminator by three degrees: there rounding decides which side is lit.
                        .filter(|&i| {
                            let to_light =
                                world.lights[light].place.vector_from(shot.seen[i].expect("seen").point);
                            shot.seen[i].is_some_and(|s| s.normal.dot(to_light.normalize()) > 0.05)
                        })
                        .collect();
                    let dark = lit.iter().filter(|&&i| mask[i] < 255).count();
                    assert_eq!(dark, 0, "{bits} bits, {own:?}, light {light}: dark of {} lit", lit.len());
                    judged += lit.len();
                }
                assert!(judged > 30, "{bits} bits, {own:?}: {judged} lit pixels are judged");
            }
        }
    });
}

/// World normals are as good as view normals, and 8 bits of normal are enough for antialiasing.
#[test]
fn normals_come_in_any_space_and_format() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let expected = shot.masks(&mut renderer, &shot.frame());
        let size = [VIEWPORT[2], VIEWPORT[3]];
        let world_normals: Vec<[f32; 4]> = shot
            .seen
            .iter()
            .map(|s| s.map_or([0.0; 4], |s| (s.normal * 3.0).as_vec3().extend(0.0).to_array()))
            .collect();
        let to_view = DMat3::from_mat4(shot.camera.view);
        let bytes: Vec<[u8; 4]> = shot
            .seen
            .iter()
            .map(|s| s.map_or(DVec3::ZERO, |s| to_view * s.normal))
            .map(|n| n.extend(1.0).to_array().map(|c| (c * 127.5 + 127.5).round() as u8))
            .collect();
        let world_texture = texture(&gl.gl, size, [glow::RGBA32F, glow::RGBA, glow::FLOAT], &world_normals);
        let byte_texture = texture(&gl.gl, size, [glow::RGBA8, glow::RGBA, glow::UNSIGNED_BYTE], &bytes);
        let kinds = [
            // The same but for rounding.
            (Normals::new(known(world_texture), NormalSpace::World), 2, 0.0),
            // A normal is off by half a degree: edges on grazing surfaces get wider or narrower.
            (Normals::new(known(byte_texture), NormalSpace::View).biased(), 25, 5e-3),
        ];
        for (normals, tolerance, over) in kinds {
            let surface = shot.frame().surface.with_normals(normals);
            let masks = shot.masks(&mut renderer, &shot.frame().surface(surface));
            let pairs = expected.iter().flatten().zip(masks.iter().flatten());
            let off = pairs.filter(|(a, b)| a.abs_diff(**b) > tolerance).count();
            let allowed = (expected.len() * shot.seen.len()) as f64 * over;
            assert!(off as f64 <= allowed, "{normals:?}: {off} differ by more than {tolerance}");
        }
        // SAFETY: made above.
        unsafe {
            gl.gl.delete_texture(world_texture);
            gl.gl.delete_texture(byte_texture);
        }
    });
}

/// Normals found from the depth are those of the surface up to the viewport's borders: a floor in a
/// shadow that fills the picture comes out the same with and without a texture of normals.
#[test]
fn normals_from_depth_hold_at_the_borders() {
    in_each_api(|gl| {
        let world = World::parse(
            r#"
            camera = { eye = [0.5, 4.0, 3.0], target = [0.0, 0.0, 0.4], up = [0.2, 1.0, 0.0], fov_y = 30.0 }
            [[light]]
            name = "blocked"
            type = "point"
            position = [1.0, 9.0, 2.0]
            intensity = 60.0
            [[light]]
            name = "free"
            type = "point"
            position = [-6.0, 2.0, 1.0]
            intensity = 40.0
            [[object]]
            name = "floor"
            shape = { type = "plane" }
            [[object]]
            name = "ball"
            shape = { type = "sphere", radius = 1.5 }
            translation = [0.7, 6.5, 1.6]
            "#,
        );
        let shot = Shot::new(gl, &world);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let [with, found] = [true, false]
            .map(|normals| overlay(gl, &mut renderer, &without(&shot, normals, true), Encoding::Linear));
        let shadowed = with.iter().filter(|texel| texel[0] < 250).count();
        assert!(shadowed > with.len() / 5, "the shadow reaches the borders");
        let off = with.iter().zip(&found).filter(|(a, b)| (0..3).any(|c| a[c].abs_diff(b[c]) > 1)).count();
        assert_eq!(off, 0, "pixels differ by more than a step of 8 bits");
    });
}
