//! What hosts do without thinking of shadows: masks left bound, a scissor, cameras inverted in float32, clip space upside down.

use crate::context::{Kind, in_each, in_each_api};
use crate::lights::{STEP, many_lights};
use crate::sampled::area_lights;
use crate::shot::{Canvas, Shot, VIEWPORT, each_batch};
use antumbra_gl::{DepthFormat, Encoding, Error, Occluder, Renderer, Technique, Unsupported};
use glam::{DMat4, Mat4};
use glow::HasContext;
use std::ffi::CString;

/// A mask that stays bound is bound no more once it is no more.
#[test]
fn a_mask_that_the_host_left_bound_may_go() {
    in_each_api(|gl| {
        let (hard, soft) = (many_lights(3), area_lights(3));
        let (shot, soft_shot) = (Shot::new(gl, &hard), Shot::new(gl, &soft));
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        each_batch(&mut renderer, &shot.frame(), |batch| {
            // SAFETY: the mask lives.
            unsafe {
                gl.gl.active_texture(glow::TEXTURE0);
                gl.gl.bind_texture(glow::TEXTURE_2D, Some(batch.textures[0].glow()));
            }
        })
        .expect("the frame is right");
        let bound = || {
            // SAFETY: a query.
            unsafe { gl.gl.get_parameter_texture(glow::TEXTURE_BINDING_2D) }
        };
        let mask = bound().expect("the mask is bound");
        let _canvas = Canvas::new(gl);
        // Masks of floats in place of those of bytes.
        renderer.overlay(&soft_shot.frame(), Encoding::Linear).expect("the frame is right");
        gl.assert_no_complaint("an overlay that made other masks");
        assert_eq!(bound(), None, "nothing stands for what is gone");
        // SAFETY: a query of a name that was one.
        assert!(!unsafe { gl.gl.is_texture(mask) }, "the old mask is gone, and nothing has taken its name");
    });
}

/// The overlay stays within the frame's rectangle, whatever technique draws it, and the host's scissor is as it was.
#[test]
fn an_overlay_is_clipped() {
    in_each_api(|gl| {
        let world = many_lights(3);
        let shot = Shot::new(gl, &world);
        let [x, y, width, height] = [VIEWPORT[0] + 20, VIEWPORT[1] + 10, VIEWPORT[2] / 2, VIEWPORT[3] / 2];
        for technique in Shot::able(&shot.frame()) {
            let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
            renderer.set_technique(technique).expect("a technique");
            let [all, clipped] = [shot.frame(), shot.frame().clip([x, y, width, height])].map(|frame| {
                let canvas = Canvas::new(gl);
                renderer.overlay(&frame, Encoding::Linear).expect("the frame is right");
                canvas.read(0)
            });
            let inside = |i: usize| {
                let (column, row) = (i as i32 % VIEWPORT[2], i as i32 / VIEWPORT[2]);
                (x..x + width).contains(&column) && (y..y + height).contains(&row)
            };
            let right = |i: usize| if inside(i) { clipped[i] == all[i] } else { clipped[i] == [255; 4] };
            assert!(
                (0..all.len()).all(right),
                "{technique}: what is drawn is what is drawn without, or nothing"
            );
            let dark = (0..all.len()).filter(|&i| all[i] != [255; 4]);
            let (within, without): (Vec<_>, Vec<_>) = dark.partition(|&i| inside(i));
            assert!(
                within.len() > 100 && without.len() > 100,
                "{technique}: there are shadows on both sides"
            );
        }
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let error = renderer.overlay(&shot.frame().clip([0, 0, -1, 4]), Encoding::Linear);
        assert!(error.expect_err("a negative width").to_string().contains("clip rectangle"), "it is named");
    });
}

/// A view that was inverted in float32 ends in a row that is not quite (0, 0, 0, 1).
#[test]
fn a_view_with_rounding_is_a_view() {
    in_each_api(|gl| {
        let world = many_lights(2);
        let shot = Shot::new(gl, &world);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let mut rounded = shot.frame();
        rounded.camera.view.w_axis.w = f64::from(0.999_999_94_f32);
        rounded.camera.view.x_axis.w = 3e-8;
        let [exact, rounded] = [shot.frame(), rounded].map(|frame| {
            let canvas = Canvas::new(gl);
            renderer.overlay(&frame, Encoding::Linear).expect("the frame is right");
            canvas.read(0)
        });
        assert!(exact == rounded, "the same picture");
        assert!(exact.iter().any(|texel| texel[0] < 200), "of shadows");
        let mut model = Mat4::from_scale(glam::Vec3::splat(2.0)).as_dmat4();
        model.w_axis.w = f64::from(0.999_999_94_f32);
        Occluder::placed(Occluder::sphere([0.0; 3], 1.0).shape, model.to_cols_array()).expect("affine");
    });
}

/// A host that reverses depth and does not say so is told.
#[test]
fn depth_runs_the_way_the_host_says() {
    in_each_api(|gl| {
        let world = many_lights(2);
        let shot = Shot::new(gl, &world);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let _canvas = Canvas::new(gl);
        let mut contradicting = shot.frame();
        contradicting.surface.depth_format = DepthFormat::fixed(24).reversed();
        let error = renderer.overlay(&contradicting, Encoding::Linear).expect_err("depth is not reversed");
        assert!(error.to_string().contains("DepthFormat::reversed"), "{error}");
        let mut other = shot.frame();
        other.camera.projection =
            DMat4::from_scale(glam::DVec3::new(1.0, 1.0, -1.0)) * other.camera.projection;
        renderer.overlay(&other, Encoding::Linear).expect_err("depth is reversed");
    });
}

/// Cones and other shapes without extent cast nothing.
#[test]
fn a_cone_without_height_casts_nothing() {
    in_each_api(|gl| {
        let world = many_lights(2);
        let shot = Shot::new(gl, &world);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let occluders = [Occluder::cone([0.0, 2.0, 0.0], [0.0, 2.0, 0.0], 1.0)];
        let canvas = Canvas::new(gl);
        renderer.overlay(&shot.frame().occluders(&occluders), Encoding::Linear).expect("the frame is right");
        assert!(canvas.read(0).iter().all(|texel| *texel == [255; 4]), "nothing is dark");
    });
}

/// Where clip space can be turned over: refused with its origin above, and right with whichever depth.
#[test]
fn clip_control_is_the_hosts() {
    type ClipControl = extern "system" fn(u32, u32);
    in_each([Kind::Gl33], |gl| {
        let name = CString::new("glClipControl").expect("no zeros");
        let address = gl.context.get_proc_address(&name);
        assert!(!address.is_null(), "the driver of the tests has it");
        // SAFETY: OpenGL's function of this name has this signature.
        let clip_control: ClipControl = unsafe { std::mem::transmute(address) };
        let world = many_lights(3);
        let shot = Shot::new(gl, &world);
        for technique in [Technique::analytic().into(), "volume".parse().expect("a technique")] {
            let technique: Technique = technique;
            let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
            renderer.set_technique(technique).expect("a technique");
            let canvas = Canvas::new(gl);
            clip_control(glow::UPPER_LEFT, glow::NEGATIVE_ONE_TO_ONE);
            let refused = renderer.overlay(&shot.frame(), Encoding::Linear);
            let masks = renderer.masks(&shot.frame()).map(|_| ());
            clip_control(glow::LOWER_LEFT, glow::ZERO_TO_ONE);
            for refused in [refused, masks] {
                assert_eq!(refused, Err(Error::Unsupported(Unsupported::UpperLeft)), "{technique}");
            }
            assert!(canvas.read(0).iter().all(|texel| *texel == [255; 4]), "{technique}: nothing is drawn");
            // What the host drew before lies between -1 and 1, as the frame says.
            renderer.overlay(&shot.frame(), Encoding::Linear).expect("the frame is right");
            // SAFETY: a query.
            let depth = unsafe { gl.gl.get_parameter_i32(glow::CLIP_DEPTH_MODE) } as u32;
            assert_eq!(depth, glow::ZERO_TO_ONE, "{technique}: as it was");
            clip_control(glow::LOWER_LEFT, glow::NEGATIVE_ONE_TO_ONE);
            world.truth(&shot).assert_overlay(&canvas.read(0), STEP);
        }
    });
}
