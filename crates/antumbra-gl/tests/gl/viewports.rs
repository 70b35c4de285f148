//! Viewports that are a part of the window.

use crate::context::{in_each_api, in_each_tier};
use crate::lights::many_lights;
use crate::shot::{Canvas, Shot, assert_needs_floats};
use antumbra_gl::{DepthFormat, Encoding, Renderer};

/// A corner that is no multiple of anything.
const PART: [i32; 4] = [37, 21, 101, 75];
const WINDOW: [i32; 2] = [160, 120];

/// Shadows fall in the viewport, where they belong, and nothing outside it changes; for one batch of
/// lights and for several.
#[test]
fn a_viewport_with_an_offset_is_shadowed_and_nothing_else() {
    in_each_tier(|gl| {
        for count in [3, 20] {
            let world = many_lights(count);
            let shot = Shot::with(gl, &world, world.camera(PART), PART, DepthFormat::default());
            let truth = world.truth(&shot);
            let canvas = Canvas::white(gl, WINDOW, 1);
            let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
            if count > 8 && !gl.has_floats() {
                assert_needs_floats(&mut renderer, &shot.frame());
                continue;
            }
            renderer.overlay(&shot.frame(), Encoding::Linear).expect("the frame is right");
            let window = canvas.read(0);
            let [x, y, width, height] = PART;
            let inside = |i: usize| {
                let (px, py) = (i as i32 % WINDOW[0] - x, i as i32 / WINDOW[0] - y);
                (0..width).contains(&px) && (0..height).contains(&py)
            };
            let outside = (0..window.len()).filter(|&i| !inside(i)).all(|i| window[i] == [255; 4]);
            assert!(outside, "{count} lights: pixels outside the viewport have changed");
            let part: Vec<_> = (0..window.len()).filter(|&i| inside(i)).map(|i| window[i]).collect();
            truth.assert_overlay(&part, crate::lights::STEP);
            for (light, mask) in shot.masks(&mut renderer, &shot.frame()).iter().enumerate() {
                truth.assert_mask(light, mask);
            }
            gl.assert_no_complaint("a part of the window");
        }
    });
}

/// A part of the viewport's size draws what the whole window of that size draws.
#[test]
fn an_offset_changes_no_bit_of_the_masks() {
    in_each_api(|gl| {
        let world = many_lights(3);
        let whole = [0, 0, PART[2], PART[3]];
        let format = DepthFormat::default();
        let shifted = Shot::with(gl, &world, world.camera(PART), PART, format);
        let plain = Shot::with(gl, &world, world.camera(whole), whole, format);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let masks = [&shifted, &plain].map(|shot| shot.masks(&mut renderer, &shot.frame()));
        let [shifted, plain] = &masks;
        for (a, b) in shifted.iter().flatten().zip(plain.iter().flatten()) {
            // Positions are unprojected from other numbers: an edge may round to the next step.
            assert!(a.abs_diff(*b) <= 1, "{a} and {b}");
        }
    });
}

/// The smallest viewport there is.
#[test]
fn one_pixel_is_a_picture() {
    in_each_api(|gl| {
        let world = many_lights(3);
        let viewport = [2, 1, 1, 1];
        let shot = Shot::with(gl, &world, world.camera(viewport), viewport, DepthFormat::default());
        let canvas = Canvas::white(gl, [4, 3], 1);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        renderer.overlay(&shot.frame(), Encoding::Linear).expect("the frame is right");
        gl.assert_no_complaint("one pixel");
        let others = canvas.read(0).iter().enumerate().filter(|(i, _)| *i != 6).all(|(_, t)| *t == [255; 4]);
        assert!(others, "only that pixel may change");
        assert_eq!(shot.masks(&mut renderer, &shot.frame()).len(), 3, "a mask a light");
    });
}
