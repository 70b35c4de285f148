//! Frames that are not frames: a clear error, and nothing drawn.

use crate::context::in_each_api;
use crate::shot::{Canvas, Shot, each_batch};
use crate::world::World;
use antumbra_gl::{Encoding, Error, Falloff, Frame, Light, NO_SHADOW, Occluder, Renderer};
use glam::{DMat4, DVec3, DVec4, Vec3};

/// Frames that are refused, and a word of what the error says.
fn bad_frames<'w>(shot: &Shot<'w>, max_samples: u32) -> Vec<(&'static str, Frame<'w>)> {
    let good = shot.frame();
    let camera = |view: DMat4, projection: DMat4| {
        let mut frame = good;
        frame.camera.view = view;
        frame.camera.projection = projection;
        frame
    };
    let (view, projection) = (good.camera.view, good.camera.projection);
    let part = |viewport| good.viewport(viewport);
    let samples = |samples| {
        let mut frame = good;
        frame.surface.samples = samples;
        frame
    };
    let behind = DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::new(0.0, 0.0, 1.0, 1.0), DVec4::Z * -0.5);
    let reversed = DMat4::from_scale(DVec3::new(1.0, 1.0, -1.0)) * projection;
    vec![
        ("matrices", camera(DMat4::NAN, projection)),
        ("matrices", camera(view, DMat4::NAN)),
        ("matrices", camera(view * f64::INFINITY, projection)),
        ("rotation", camera(view * DMat4::from_scale(DVec3::splat(2.0)), projection)),
        ("rotation", camera(DMat4::ZERO, projection)),
        ("rotation", camera(projection, projection)),
        ("inverted", camera(view, DMat4::ZERO)),
        ("near plane", camera(view, behind)),
        ("depth run", camera(view, reversed)),
        ("viewport", part([0, 0, 0, 10])),
        ("viewport", part([0, 0, 10, 0])),
        ("viewport", part([0, 0, -10, 10])),
        ("viewport", part([-1, 0, 10, 10])),
        ("viewport", part([0, 0, i32::MAX, 10])),
        ("viewport", part([i32::MIN; 4])),
        ("samples", samples(0)),
        ("samples", samples(max_samples + 1)),
        ("samples", samples(u32::MAX)),
        ("ambient", good.ambient(Vec3::NAN)),
        ("ambient", good.ambient(Vec3::NEG_ONE)),
        ("ambient", good.ambient(Vec3::INFINITY)),
    ]
}

#[test]
fn bad_frames_are_refused_and_nothing_is_drawn() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let canvas = Canvas::new(gl);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        for (word, frame) in bad_frames(&shot, renderer.caps().max_samples) {
            let refused = |error: Error| {
                let text = error.to_string();
                let says = text.contains(word) || (word == "samples" && text.contains("multisampled"));
                assert!(says && !text.contains('\n'), "{text:?} does not speak of the {word}");
            };
            refused(renderer.overlay(&frame, Encoding::Linear).expect_err(word));
            let mut shaded = 0;
            refused(each_batch(&mut renderer, &frame, |_| shaded += 1).expect_err(word));
            assert_eq!(shaded, 0, "no mask is handed out");
            gl.assert_no_complaint(word);
        }
        for gamma in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            let refused = renderer.overlay(&shot.frame(), Encoding::Gamma(gamma));
            assert!(
                matches!(refused, Err(Error::BadFrame(why)) if why.to_string().contains("gamma")),
                "{refused:?}"
            );
        }
        assert!(canvas.read(0).iter().all(|texel| *texel == [255; 4]), "nothing is drawn");
        renderer.overlay(&shot.frame(), Encoding::Linear).expect("a right frame after all the bad ones");
    });
}

/// Lights whose numbers make no sense are named, and nothing is drawn.
#[test]
fn bad_lights_are_refused_by_number() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let canvas = Canvas::new(gl);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let good = Light::point(DVec3::Y * 5.0, Vec3::ONE);
        let spot = |inner, outer| Light::spot(DVec3::Y * 5.0, DVec3::NEG_Y, inner, outer, Vec3::ONE);
        let bad = [
            ("intensity", good.with_intensity(Vec3::NAN)),
            ("intensity", good.with_intensity(Vec3::INFINITY)),
            ("intensity", good.with_intensity(Vec3::new(1.0, -1.0, 1.0))),
            ("falloff", good.with_falloff(Falloff::classic(0.0, 0.0, 0.0))),
            ("falloff", good.with_falloff(Falloff::classic(0.0, f32::NAN, 1.0))),
            ("falloff", good.with_falloff(Falloff::classic(-1.0, 0.0, 1.0))),
            ("half-angles", spot(f32::NAN, 0.5)),
            ("half-angles", spot(0.1, f32::NAN)),
            ("half-angles", spot(0.6, 0.5)),
            ("half-angles", spot(0.1, 4.0)),
        ];
        for (word, light) in bad {
            let mut lights = world.lights.clone();
            let at = lights.len();
            lights.push(light);
            let frame = shot.frame().lights(&lights);
            for result in
                [renderer.overlay(&frame, Encoding::Linear), each_batch(&mut renderer, &frame, |_| {})]
            {
                let named = |e: &Error| matches!(e, Error::BadLight { index, fault } if *index == at && fault.to_string().contains(word));
                assert!(result.as_ref().is_err_and(named), "{light:?}: {result:?}");
            }
        }
        let occluders = [Occluder::sphere(DVec3::Y, 1.0).with_id(NO_SHADOW)];
        let refused = renderer.overlay(&shot.frame().occluders(&occluders), Encoding::Linear);
        assert!(
            matches!(refused, Err(Error::BadFrame(why)) if why.to_string().contains("id")),
            "{refused:?}"
        );
        assert!(canvas.read(0).iter().all(|texel| *texel == [255; 4]), "nothing is drawn");
    });
}

#[test]
fn multisampled_surfaces_need_sample_shading() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let shot = Shot::new(gl, &world);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        if !gl.is_desktop() {
            let surface = shot.frame().surface.with_samples(4);
            let refused = renderer.warm_up(&surface, &[]);
            assert!(matches!(refused, Err(Error::Unsupported { .. })), "{refused:?}");
            assert_eq!(renderer.caps().max_samples, 1, "and the caps say so");
        }
    });
}

/// Where nothing was drawn there is nothing to shadow, whatever else the textures hold.
#[test]
fn the_background_is_left_alone() {
    in_each_api(|gl| {
        let world = World::one_of_each();
        let up = DMat4::from_cols(DVec4::X, DVec4::Z, -DVec4::Y, DVec4::new(0.0, 0.0, -50.0, 1.0));
        let mut camera = world.camera(crate::shot::VIEWPORT);
        camera.view = up.inverse();
        let shot = Shot::with(gl, &world, camera, crate::shot::VIEWPORT, antumbra_gl::DepthFormat::default());
        let sky = |i: usize| shot.seen[i].is_none();
        let canvas = Canvas::new(gl);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        renderer.overlay(&shot.frame(), Encoding::Linear).expect("the frame is right");
        let picture = canvas.read(0);
        let count = (0..picture.len()).filter(|&i| sky(i)).count();
        assert!(count > 1000, "{count} pixels of background to look at");
        assert!(
            (0..picture.len()).filter(|&i| sky(i)).all(|i| picture[i] == [255; 4]),
            "background has changed"
        );
        for mask in shot.masks(&mut renderer, &shot.frame()) {
            assert!((0..mask.len()).filter(|&i| sky(i)).all(|i| mask[i] == 255), "background is lit");
        }
    });
}
