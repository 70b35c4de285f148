//! What shadows cost: the same frame with and without, in one run.
//!
//! ```text
//! cargo run --release -p antumbra-host --example frame_time [lights] [spheres] [size] [radius]
//! ```
//!
//! Spheres over a floor under point lights (8, 8, 512 by default), or glowing balls of that radius, metres. Each round draws the frame
//! plainly (colour and depth alone) and with shadows, one after the other, every frame between two glFinish; the first
//! rounds are dropped. Absolute times depend on the machine, the ratio is what counts.

use antumbra_host::{Api, Buffers, ColorFormat, HeadlessContext, Stage};
use antumbra_scene::Scene;
use glow::HasContext;
use std::fmt::Write;
use std::time::Instant;

const ROUNDS: usize = 60;
const WARM_UP: usize = 5;

fn scene(lights: usize, spheres: usize, radius: f64) -> String {
    let mut text =
        String::from("ambient = [0.1, 0.1, 0.1]\n[camera]\neye = [0, 6, 10]\ntarget = [0, 0.5, 0]\n");
    let circle = |i: usize, n: usize| (i as f64 / n as f64 * std::f64::consts::TAU).sin_cos();
    for i in 0..lights {
        let (sin, cos) = circle(i, lights);
        let intensity = 200.0 / lights as f64;
        let (x, z) = (4.0 * cos, 4.0 * sin);
        let kind = if radius > 0.0 { format!("sphere\"\nradius = {radius}") } else { "point\"".into() };
        write!(
            text,
            "[[light]]\nname = \"l{i}\"\ntype = \"{kind}\nposition = [{x}, 7, {z}]\nintensity = {intensity}\n"
        )
        .expect("writing to a string");
    }
    text.push_str("[[object]]\nname = \"floor\"\nshape = { type = \"plane\" }\n");
    for i in 0..spheres {
        // A sunflower: even spacing for any number.
        let turn = i as f64 * 2.399963;
        let out = 3.2 * ((i as f64 + 0.5) / spheres as f64).sqrt();
        let radius = 1.4 / (spheres as f64).sqrt();
        let (x, z) = (out * turn.cos(), out * turn.sin());
        let y = radius * 1.5;
        write!(
            text,
            "[[object]]\nname = \"s{i}\"\nshape = {{ type = \"sphere\", radius = {radius} }}\ntranslation = [{x}, {y}, {z}]\n"
        )
        .expect("writing to a string");
    }
    text
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut next = |default| arguments.next().map_or(Ok(default), |a| a.parse::<usize>());
    let (lights, spheres, size) = (next(8)?, next(8)?, next(512)? as u32);
    let radius = arguments.next().map_or(Ok(0.0), |a| a.parse::<f64>())?;
    let scene = Scene::parse(&scene(lights, spheres, radius), "frame_time.toml".as_ref())?;
    let context = HeadlessContext::new(Api::Gl33)?;
    let gl = context.gl().clone();
    let mut stage = Stage::new(&gl)?;
    let setting = stage.setting(&scene, 0.0, 1.0)?;
    let (mut plain, mut shadowed) = (Vec::new(), Vec::new());
    for round in 0..ROUNDS + WARM_UP {
        for (with_shadows, times) in [(false, &mut plain), (true, &mut shadowed)] {
            // SAFETY: waits for the context of this thread.
            unsafe { gl.finish() };
            let start = Instant::now();
            let buffers = if with_shadows { Buffers::All } else { Buffers::Color };
            stage.draw(&setting, size, size, 1, ColorFormat::Rgba8, buffers)?;
            if with_shadows {
                stage.add_shadows(&setting)?;
            }
            // SAFETY: as above.
            unsafe { gl.finish() };
            if round >= WARM_UP {
                times.push(start.elapsed().as_secs_f64() * 1e3);
            }
        }
    }
    let median = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    let (plain, shadowed) = (median(&mut plain), median(&mut shadowed));
    println!("{}, {lights} lights, {spheres} spheres, {size}x{size}", context.info().renderer);
    println!("{:?}", stage.shadows().stats());
    println!(
        "plain {plain:.2} ms, with shadows {shadowed:.2} ms (medians of {ROUNDS}, wall time between glFinish)"
    );
    println!("ratio {:.2}", shadowed / plain);
    Ok(())
}
