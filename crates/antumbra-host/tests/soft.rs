//! Soft shadows in closed form against the ray tracer, which samples the lights.

mod common;

use antumbra::{Soft, Technique};
use antumbra_host::{Api, RenderOptions, Stage, TestContext};
use antumbra_reference::{Ray, Tracer};
use antumbra_scene::Scene;
use rayon::prelude::*;
use std::fmt::Write;

const WIDTH: u32 = 960;
const HEIGHT: u32 = 600;
/// Every so many pixels, across and down, one is looked at.
const STEP: u32 = 9;

/// Points of the light for each pixel in a penumbra.
const SAMPLES: u32 = 1 << 12;

/// What comparisons find inside penumbrae.
#[derive(Default)]
struct Found {
    pixels: usize,
    squares: f64,
    largest: f64,
    /// Sum of squared differences of two independent estimates of the truth.
    noise: f64,
}

impl Found {
    fn rms(&self) -> f64 {
        (self.squares / self.pixels.max(1) as f64).sqrt()
    }

    /// Standard error of the truth: each estimate has half the variance of the difference.
    fn truth_error(&self) -> f64 {
        (0.5 * self.noise / self.pixels.max(1) as f64).sqrt()
    }
}

/// Compares one light of a scene where its visibility is partial, and the surface is smooth within the pixel.
fn compare(stage: &mut Stage, scene: &Scene, technique: Technique, found: &mut Found) {
    let options = RenderOptions {
        time: 0.0,
        width: WIDTH,
        height: HEIGHT,
        msaa: 1,
        visibility: true,
        shadows: true,
        technique,
        soft: Soft::Native,
    };
    let drawn = stage.render(scene, &options).expect("the scene draws");
    let tracer = Tracer::new(scene, 0.0);
    let looked_at = |i: &u32| i % WIDTH % STEP == 4 && i / WIDTH % STEP == 4;
    let pixels: Vec<(f64, f64)> = (0..WIDTH * HEIGHT)
        .into_par_iter()
        .filter(looked_at)
        .filter_map(|i| {
            let (x, y) = (f64::from(i % WIDTH) + 0.5, f64::from(i / WIDTH) + 0.5);
            let (origin, direction) = scene.camera.ray(x, y, WIDTH, HEIGHT);
            let surface = tracer.surface(&Ray::new(origin, direction))?;
            let rough = tracer.visibility_at(0, &surface, 64, i);
            // Where the horizon leaves less than a hundredth of the light there is nothing to see.
            let full = tracer.unoccluded_irradiance(0, &surface, 64, i);
            if !(0.001..0.999).contains(&rough) || full < 0.02 {
                return None;
            }
            let [a, b] = [1, 2].map(|seed| tracer.visibility_at(0, &surface, SAMPLES / 2, i * 2 + seed));
            let drawn = f64::from(drawn.visibility[0][i as usize]);
            Some((drawn - 0.5 * (a + b), 0.5 * (a - b)))
        })
        .collect();
    for (difference, noise) in pixels {
        found.pixels += 1;
        found.squares += difference * difference;
        found.largest = found.largest.max(difference.abs());
        found.noise += 2.0 * noise * noise;
    }
}

fn number(random: &mut fastrand::Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * random.f64()
}

const LIGHTS: [&str; 3] = ["sphere", "disc", "rectangle"];

/// A light over a floor and a large ball (both receive), and occluders between; some lights so low or large that the
/// horizon cuts them.
fn scene(random: &mut fastrand::Rng, light: &str, shapes: &[&str]) -> Scene {
    let mut text = String::from(
        "[camera]\neye = [0, 5, 7]\ntarget = [0, 0.5, 0]\nfov_y = 50\n\
         [[object]]\nname = \"floor\"\nshape = { type = \"plane\" }\n\
         [[object]]\nname = \"hill\"\nshape = { type = \"sphere\", radius = 3.0 }\n\
         translation = [1.8, -1.9, -1.0]\ncasts_shadow = false\n",
    );
    let angle = random.f64() * std::f64::consts::TAU;
    let (height, away) = if random.bool() { (number(random, 3.5, 6.0), 2.5) } else { (1.6, 6.0) };
    let position = [away * angle.cos(), height, away * angle.sin()];
    let size = number(random, 0.2, 1.4);
    let down = [-position[0] * 0.7, 0.6 - position[1], -position[2] * 0.7];
    let right = {
        let flat = (down[0] * down[0] + down[2] * down[2]).sqrt().max(1e-9);
        [-down[2] / flat, 0.0, down[0] / flat]
    };
    let size = match light {
        "sphere" => format!("radius = {size}"),
        "disc" => format!("radius = {size}\ndirection = {down:?}"),
        _ => format!(
            "width = {}\nheight = {}\ndirection = {down:?}\nright = {right:?}",
            size * 2.0,
            size * number(random, 0.6, 2.5)
        ),
    };
    write!(
        text,
        "[[light]]\nname = \"light\"\ntype = \"{light}\"\nposition = {position:?}\nintensity = 50\n{size}\n"
    )
    .expect("writing to a string");
    for (i, shape) in shapes.iter().enumerate() {
        let size = number(random, 0.3, 0.8);
        let shape = match *shape {
            "sphere" => format!("type = \"sphere\", radius = {size}"),
            "disc" => format!("type = \"disc\", radius = {size}"),
            "cone" => format!("type = \"cone\", radius = {size}, height = {}", size * 2.2),
            "rectangle" => format!("type = \"rectangle\", width = {}, depth = {size}", size * 2.0),
            _ => format!(
                "type = \"triangle\", vertices = [[{size}, 0, 0], [-{size}, 0.1, 0.2], [0, 0.3, {size}]]"
            ),
        };
        let spread = if shapes.len() > 1 { 0.9 } else { 1.5 };
        let at = [number(random, -spread, spread), number(random, 0.9, 1.7), number(random, -spread, spread)];
        let axis = [0; 4].map(|_| number(random, -1.0, 1.0));
        let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
        let rotation = axis.map(|x| x / length);
        write!(
            text,
            "[[object]]\nname = \"o{i}\"\nshape = {{ {shape} }}\ntranslation = {at:?}\nrotation = {rotation:?}\n\
             receives_shadow = false\n"
        )
        .expect("writing to a string");
    }
    Scene::parse(&text, "soft".as_ref()).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// A factor on the number of scenes, from `ANTUMBRA_CASES`.
fn more() -> u64 {
    std::env::var("ANTUMBRA_CASES").map_or(1, |n| n.parse().expect("a number"))
}

fn compare_all(light: &str, shapes: &[&str], scenes: u64, technique: Technique) -> Option<Found> {
    let context = TestContext::new(Api::Gl33)?;
    let mut stage = Stage::new(context.gl()).expect("a stage");
    let mut found = Found::default();
    for seed in 0..scenes {
        let mut random = fastrand::Rng::with_seed(seed);
        compare(&mut stage, &scene(&mut random, light, shapes), technique, &mut found);
    }
    println!(
        "{technique}, {light} light, {shapes:?}: {} pixels, rms {:.5}, largest {:.4}, truth within {:.5}",
        found.pixels,
        found.rms(),
        found.largest,
        found.truth_error()
    );
    assert!(found.pixels > 20 * scenes as usize, "{} pixels of penumbrae to look at", found.pixels);
    Some(found)
}

/// The closed form's own error is the quadrature's, 0.0006 (antumbra-math's tests), and the truth's is 0.0008.
#[test]
fn a_ball_past_a_glowing_ball() {
    let Some(found) = compare_all("sphere", &["sphere"], 20 * more(), Technique::default()) else { return };
    assert!(found.rms() <= 0.0011, "rms {}", found.rms());
    assert!(found.largest <= 0.006, "largest {}", found.largest);
}

#[test]
fn other_pairs() {
    for light in LIGHTS {
        for shape in ["sphere", "disc", "triangle", "rectangle", "cone"] {
            let Some(found) = compare_all(light, &[shape], 3 * more(), Technique::default()) else { return };
            assert!(found.rms() <= 0.0022, "{light}, {shape}: rms {}", found.rms());
            // A triangle's corner on a large light is what eight strips know least.
            let most = if shape == "triangle" { 0.03 } else { 0.009 };
            assert!(found.largest <= most, "{light}, {shape}: largest {}", found.largest);
        }
    }
}

/// Four occluders that overlap on the light: the union within the bound; the product, which is faster, as far off as it
/// is.
#[test]
fn several_occluders() {
    let shapes = ["sphere", "cone", "rectangle", "disc"];
    for light in LIGHTS {
        let exact = Technique::parse("analytic:quality=exact").expect("an option");
        let Some(found) = compare_all(light, &shapes, 2 * more(), exact) else { return };
        assert!(found.rms() <= 0.0014, "{light}: rms {}", found.rms());
        assert!(found.largest <= 0.018, "{light}: largest {}", found.largest);
        let Some(fast) = compare_all(light, &shapes, 2 * more(), Technique::default()) else { return };
        assert!(fast.rms() > found.rms(), "{light}: the product is not the union");
        assert!(fast.rms() <= 0.035, "{light}: product, rms {}", fast.rms());
    }
}
