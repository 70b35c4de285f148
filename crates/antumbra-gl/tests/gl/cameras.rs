//! Projections and depth buffers of every kind.

use crate::context::in_each_api;
use crate::lights::{STEP, overlay};
use crate::shot::{Shot, VIEWPORT};
use crate::world::World;
use antumbra_gl::{Camera, DepthFormat, Encoding, Renderer};
use antumbra_scene::Scene;
use glam::camera::rh::proj;
use glam::{DMat4, DVec3, DVec4};

pub(crate) const REVERSED: DepthFormat = DepthFormat::float().reversed().zero_to_one();

/// Every projection that hosts use, with what its depth buffer is like.
pub(crate) fn cameras(world: &World) -> Vec<(&'static str, Camera, DepthFormat)> {
    let aspect = f64::from(VIEWPORT[2]) / f64::from(VIEWPORT[3]);
    let usual = DepthFormat::default();
    let angle = 45f64.to_radians();
    let perspective = proj::opengl::perspective(angle as f32, aspect as f32, 0.5, 60.0).as_dmat4();
    let y = (angle * 0.5).tan().recip();
    // Reversed, infinite: depth is near / distance.
    let reversed = DMat4::from_cols(
        DVec4::X * (y / aspect),
        DVec4::Y * y,
        DVec4::new(0.0, 0.0, 0.0, -1.0),
        DVec4::Z * 0.25,
    );
    let shift = DMat4::from_translation(DVec3::new(0.2, -0.1, 0.0));
    let flat = |near: f64, far: f64| {
        let (h, w) = (3.0, 3.0 * aspect);
        DMat4::from_cols(
            DVec4::X / w,
            DVec4::Y / h,
            DVec4::Z * (-2.0 / (far - near)),
            DVec4::new(0.0, 0.0, -(far + near) / (far - near), 1.0),
        )
    };
    let reverse = DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::Z * -0.5, DVec4::new(0.0, 0.0, 0.5, 1.0));
    [
        ("infinite", world.camera(VIEWPORT).projection, usual),
        ("perspective", perspective, usual),
        ("off-centre", shift * perspective, usual),
        ("reversed", reversed, REVERSED),
        ("orthographic", flat(0.1, 40.0), usual),
        ("orthographic from behind the eye", flat(-5.0, 40.0), usual),
        ("orthographic off-centre", shift * flat(0.1, 40.0), usual),
        ("orthographic reversed", reverse * flat(0.1, 40.0), REVERSED),
    ]
    .map(|(name, projection, format)| (name, Camera::new(world.view, projection), format))
    .into()
}

#[test]
fn every_projection_has_the_right_shadows() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        for (name, camera, format) in cameras(&world) {
            eprintln!("{name}");
            let shot = Shot::with(gl, &world, camera, VIEWPORT, format);
            let truth = world.truth(&shot);
            truth.assert_overlay(&overlay(gl, &mut renderer, &shot.frame(), Encoding::Linear), STEP);
            for (light, mask) in shot.masks(&mut renderer, &shot.frame()).iter().enumerate() {
                truth.assert_mask(light, mask);
            }
        }
    });
}

/// A host's own float32 matrices are as good as float64 ones, to a step of 8 bits, but for a pixel in
/// a thousand on edges.
#[test]
fn matrices_in_float32_do() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let shot = Shot::new(gl, &world);
        let exact = shot.masks(&mut renderer, &shot.frame());
        let mut frame = shot.frame();
        frame.camera = Camera::new(frame.camera.view.as_mat4(), frame.camera.projection.as_mat4());
        let rounded = shot.masks(&mut renderer, &frame);
        let off =
            exact.iter().flatten().zip(rounded.iter().flatten()).filter(|(a, b)| a.abs_diff(**b) > 1).count();
        assert!(off <= shot.seen.len() * exact.len() / 1000, "{off} of {} differ", shot.seen.len());
    });
}

/// A thousand kilometres from the origin the shadows are the same: the view takes the camera's
/// position off in float64 before anything is rounded.
#[test]
fn far_from_the_origin_shadows_stay_sharp() {
    in_each_api(|gl| {
        let offset = DVec3::new(1e6, -2e5, 1e6);
        let scene = Scene::parse(crate::world::ONE_OF_EACH, "far.toml".as_ref()).expect("the scene is right");
        let mut moved = scene.moment(0.0);
        moved.primitives.iter_mut().for_each(|p| p.pose.translation += offset);
        moved.lights.iter_mut().for_each(|l| l.position += offset);
        let mut far_scene = scene.clone();
        far_scene.camera.eye += offset;
        far_scene.camera.target += offset;
        let (near, far) = (World::one_of_each(), World::of_moment(&far_scene, &moved));
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let near_shot = Shot::new(gl, &near);
        let near_masks = near_shot.masks(&mut renderer, &near_shot.frame());
        let far_shot = Shot::new(gl, &far);
        let far_masks = far_shot.masks(&mut renderer, &far_shot.frame());
        let off = near_masks
            .iter()
            .flatten()
            .zip(far_masks.iter().flatten())
            .filter(|(a, b)| a.abs_diff(**b) > 2)
            .count();
        // Which object a pixel on a silhouette sees is decided by rounding: 1e-10 of the distance.
        assert!(off <= 10, "{off} pixels differ by more than two steps");
    });
}
