//! A frame like the one before allocates and compiles nothing.

use crate::context::in_each_api;
use crate::leaks::live;
use crate::lights::many_lights;
use crate::shot::{Canvas, Shot, each_batch};
use antumbra_gl::{Encoding, Light, Renderer, Technique};
use antumbra_math::Light as Place;
use glam::DVec3;

const FRAMES: usize = 100;

/// Lights on their way: the same number, somewhere else.
fn moved(lights: &[Light], step: usize) -> Vec<Light> {
    let offset =
        DVec3::new((step as f64 * 0.7).sin(), (step as f64 * 0.3).cos() * 0.5, (step as f64 * 0.9).cos());
    let place = |place| match place {
        Place::Point { position } => Place::Point { position: position + offset },
        other => other,
    };
    lights.iter().map(|light| light.with_place(place(light.place))).collect()
}

#[test]
fn a_steady_frame_allocates_and_makes_nothing() {
    in_each_api(|gl| {
        let able = Shot::able(&Shot::new(gl, &many_lights(1)).frame());
        for (technique, count) in able.iter().flat_map(|t| [3, 8, 20].map(|count| (*t, count))) {
            let world = many_lights(count);
            let shot = Shot::new(gl, &world);
            let _canvas = Canvas::new(gl);
            let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
            renderer.set_technique(technique).expect("a technique");
            // Maps are drawn light by light: as many frames would take minutes.
            let frames = if matches!(technique, Technique::Map(_)) { FRAMES / 10 } else { FRAMES };
            let lights: Vec<Vec<Light>> = (0..frames).map(|step| moved(&world.lights, step)).collect();
            let mut draw = |lights: &[Light]| {
                let frame = shot.frame().lights(lights);
                let mut batches = 0;
                let counted = allocation_counter::measure(|| {
                    renderer.overlay(&frame, Encoding::Linear).expect("the frame is right");
                    each_batch(&mut renderer, &frame, |_| batches += 1).expect("the frame is right");
                });
                assert_eq!(batches, count.div_ceil(8), "batches");
                counted.count_total
            };
            // Vectors grow to what the fullest frame needs: each frame is drawn once before.
            let first = draw(&lights[0]);
            assert!(first > 0, "the first frame allocates, and is seen to");
            lights.iter().for_each(|lights| _ = draw(lights));
            let before = live(&gl.gl);
            let counts: Vec<_> = lights.iter().map(|lights| draw(lights)).collect();
            assert!(
                counts.iter().all(|&n| n == 0),
                "{technique}, {count} lights: allocations by frame {counts:?}"
            );
            assert_eq!(live(&gl.gl), before, "OpenGL objects");
            gl.assert_no_complaint("steady frames");
        }
    });
}

/// After two frames only growing counts of pairs in sight may still allocate, and that ends: vectors
/// double.
#[test]
fn frames_after_the_second_hardly_allocate() {
    in_each_api(|gl| {
        let world = many_lights(8);
        let shot = Shot::new(gl, &world);
        let _canvas = Canvas::new(gl);
        let mut renderer = Renderer::new(gl.gl.clone()).expect("a renderer");
        let mut total = 0;
        for step in 0..FRAMES + 2 {
            let lights = moved(&world.lights, step);
            let frame = shot.frame().lights(&lights);
            let counted = allocation_counter::measure(|| {
                renderer.overlay(&frame, Encoding::Linear).expect("the frame is right");
            });
            if step >= 2 {
                total += counted.count_total;
            }
        }
        assert!(total <= 8, "{total} allocations in {FRAMES} frames of moving lights");
    });
}
