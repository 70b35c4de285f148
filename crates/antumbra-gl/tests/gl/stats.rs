//! What a renderer says of its frames: pairs and tiles, looked at and culled.

use crate::context::in_each_api;
use crate::shot::{Canvas, Shot, VIEWPORT};
use crate::world::World;
use antumbra_gl::{Encoding, Renderer, Stats};
use std::collections::HashSet;

/// Two lights, two balls in sight and one far from it.
const BALLS: &str = r#"
[camera]
eye = [0.0, 6.0, 6.0]
[[light]]
name = "left"
type = "point"
position = [-2.0, 5.0, 1.0]
intensity = 60.0
[[light]]
name = "right"
type = "point"
position = [2.0, 5.0, 1.0]
intensity = 60.0
[[object]]
name = "floor"
shape = { type = "plane" }
[[object]]
name = "ball"
shape = { type = "sphere", radius = 0.4 }
translation = [-0.6, 0.6, 0.0]
[[object]]
name = "another"
shape = { type = "sphere", radius = 0.3 }
translation = [0.8, 0.5, 0.2]
[[object]]
name = "far away"
shape = { type = "sphere", radius = 0.4 }
translation = [300.0, 0.6, 0.0]
"#;

/// Tiles of the viewport in which a pixel is not what it would be without shadows.
fn changed(pixels: impl Iterator<Item = bool>) -> usize {
    let tile = |i: usize| (i % VIEWPORT[2] as usize / 16, i / VIEWPORT[2] as usize / 16);
    pixels.enumerate().filter(|(_, changed)| *changed).map(|(i, _)| tile(i)).collect::<HashSet<_>>().len()
}

fn assert_right(stats: &Stats, changed: usize, what: &str) {
    let all = (VIEWPORT[2] as usize).div_ceil(16) * (VIEWPORT[3] as usize).div_ceil(16);
    assert_eq!(stats.tiles, all, "{what}: the viewport's tiles");
    assert!(changed > 2, "{what}: {changed} tiles have shadows");
    let touched = stats.touched_tiles;
    assert!((changed..=3 * changed).contains(&touched), "{what}: {touched} tiles touched, {changed} changed");
    assert!(touched < all, "{what}: not everywhere");
    // What is in a map has its depth kept, wherever its shadow is.
    let most = if what.contains("map") { 6 } else { 4 };
    assert!((4..=most).contains(&stats.drawn_pairs), "{what}: two balls under two lights: {stats:?}");
    assert!(stats.pairs >= 6, "{what}: all were looked at: {stats:?}");
    assert!(stats.polygons >= stats.drawn_pairs, "{what}: {stats:?}");
    assert_eq!(stats.batches, 1, "{what}");
}

#[test]
fn what_is_culled_is_counted() {
    in_each_api(|gl| {
        let world = World::parse(BALLS);
        let shot = Shot::new(gl, &world);
        let frame = shot.frame();
        for technique in Shot::able(&frame) {
            let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
            renderer.set_technique(technique).expect("a technique");
            let masks = shot.masks(&mut renderer, &frame);
            let dark = changed(masks[0].iter().zip(&masks[1]).map(|(a, b)| a.min(b) < &255));
            assert_right(&renderer.stats(), dark, &format!("masks of {technique}"));

            let canvas = Canvas::new(gl);
            renderer.overlay(&frame, Encoding::Linear).expect("the frame is right");
            let picture = canvas.read(0);
            let dark = changed(picture.iter().map(|pixel| pixel[..3] != [255; 3]));
            assert_right(&renderer.stats(), dark, &format!("overlay of {technique}"));

            let nothing = frame.occluders(&[]);
            renderer.overlay(&nothing, Encoding::Linear).expect("the frame is right");
            let stats = renderer.stats();
            assert_eq!((stats.pairs, stats.drawn_pairs, stats.touched_tiles), (0, 0, 0), "{technique}");
            assert_eq!(stats.tiles, 80, "{technique}: the viewport is what it was");
        }
    });
}
