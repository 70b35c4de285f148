//! Whole pictures against Mitsuba 3, an independent renderer: `tools/make_references.py` made the references from the
//! very scene files that are traced here, and says how lights and shapes are mapped.
//!
//! A picture is judged four times, in units of its brightest channel:
//!
//! - the mean difference, at most 1e-4: a wrong convention or a lost ray shows here, where noise averages out;
//! - the root mean square difference, at most a quarter more than the noise of both pictures and half floats (rounding by
//!   2.4e-4 on average at most) explain;
//! - `smooth`: the largest difference at a pixel with no edge of an object, face, cone or hard shadow around it. For hard
//!   lights that is 1/256, one of our samples on the other side of an edge too thin for the mask. For soft ones it is noise:
//!   256 independent samples of a half-lit point scatter by 3.1e-2, stratified ones by about a third, and Mitsuba's
//!   as much;
//! - `edge`: the largest difference anywhere. At an edge both pictures count samples on its two sides.

use std::path::Path;

use antumbra_reference::{Ray, Sampling, Tracer};
use antumbra_scene::{LightKind, Scene};
use exr::prelude::*;
use glam::DVec3;

/// One of 256 samples on the other side of an edge.
const HARD: f64 = 1.0 / 256.0;
/// Two thirds of one standard deviation of independent samples of a half-lit point: ours are stratified.
const SOFT: f64 = 2e-2;
/// Two standard deviations of independent samples of a pixel that an edge halves.
const EDGE: f64 = 6e-2;

type Picture = Vec<[f32; 3]>;

const QUIET: &(dyn Fn(u64, u64) + Sync) = &|_, _| {};

fn folder() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/mitsuba"))
}

fn reference(name: &str) -> (usize, Picture) {
    let read = read_first_rgba_layer_from_file(
        folder().join(format!("{name}.exr")),
        |size, _| (size.width(), vec![[0.0; 3]; size.area()]),
        |(width, picture): &mut (usize, Picture), at, (r, g, b, _): (f32, f32, f32, f32)| {
            picture[at.y() * *width + at.x()] = [r, g, b];
        },
    );
    read.expect("the committed reference").layer_data.channel_data.pixels
}

/// The root mean square of the reference's own noise, from the table beside it.
fn reference_noise(name: &str) -> f64 {
    let table = std::fs::read_to_string(folder().join("noise.csv")).expect("the committed table");
    let row = table
        .lines()
        .find_map(|line| line.strip_prefix(name)?.strip_prefix(','))
        .expect("a row of the table");
    row.parse().expect("a number")
}

fn rms(a: &Picture, b: &Picture) -> f64 {
    let sum: f64 = a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| f64::from(a - b).powi(2)).sum();
    (sum / (3 * a.len()) as f64).sqrt()
}

/// What decides how a pixel looks, seen through its centre or as a mean over it.
struct Pixel {
    primitive: Option<u32>,
    normal: DVec3,
    /// For each hard light: whether it shines this way, and how much of the pixel it reaches.
    hard: Vec<(bool, f32)>,
}

impl Pixel {
    /// Whether no edge runs between two pixels: of an object, of a face (round shapes turn by less from one pixel to the
    /// next), of a spot's cone, or of a hard shadow.
    fn goes_on(&self, other: &Self) -> bool {
        self.primitive == other.primitive && self.normal.dot(other.normal) > 0.9 && self.hard == other.hard
    }
}

/// Pixels with an edge within one pixel.
fn edges(scene: &Scene, tracer: &Tracer, width: u32, height: u32) -> Vec<bool> {
    let area = Sampling::Area { grid: 4, light_samples: 1 };
    let hard: Vec<(usize, Vec<f32>)> = tracer
        .lights()
        .iter()
        .enumerate()
        .filter(|(_, light)| {
            matches!(light.kind, LightKind::Point | LightKind::Directional { .. } | LightKind::Spot { .. })
        })
        .map(|(index, _)| (index, tracer.visibility(index, width, height, area, QUIET)))
        .collect();
    let pixel = |index: usize| {
        let (x, y) = (f64::from(index as u32 % width), f64::from(index as u32 / width));
        let (origin, direction) = scene.camera.ray(x + 0.5, y + 0.5, width, height);
        let Some(surface) = tracer.surface(&Ray::new(origin, direction)) else {
            return Pixel { primitive: None, normal: DVec3::X, hard: vec![] };
        };
        let shines = |light| tracer.unoccluded_irradiance(light, &surface, 1, 0) > 0.0;
        let hard = hard.iter().map(|(light, map)| (shines(*light), map[index])).collect();
        Pixel { primitive: Some(surface.primitive), normal: surface.normal, hard }
    };
    let (width, height) = (width as usize, height as usize);
    let pixels: Vec<Pixel> = (0..width * height).map(pixel).collect();
    (0..width * height)
        .map(|index| {
            let (x, y) = (index % width, index / width);
            let (columns, rows) =
                (x.saturating_sub(1)..width.min(x + 2), y.saturating_sub(1)..height.min(y + 2));
            rows.clone().any(|row| {
                columns.clone().any(|column| !pixels[index].goes_on(&pixels[row * width + column]))
            })
        })
        .collect()
}

fn hold(name: &str, samples: u32, smooth: f64, edge: f64) {
    let scene = Scene::load(&folder().join(format!("{name}.toml"))).expect("the committed scene");
    let tracer = Tracer::new(&scene, 0.0);
    let (width, height) = (scene.image.width, scene.image.height);
    let (reference_width, theirs) = reference(name);
    assert_eq!(reference_width, width as usize, "{name}: width of the reference");
    let ours = tracer.render(width, height, samples, QUIET);
    assert_eq!(ours.len(), theirs.len(), "{name}: height of the reference");

    let brightest = f64::from(theirs.iter().flatten().fold(0.0f32, |a, &b| a.max(b)));
    assert!(brightest > 0.1, "{name}: an empty reference");
    // Half the samples again: their difference from all of them is about the noise of all of them.
    let noise = rms(&ours, &tracer.render(width, height, samples / 2, QUIET)).hypot(reference_noise(name));
    let edges = edges(&scene, &tracer, width, height);
    let (mut worst_smooth, mut worst_edge, mut smooth_pixels) = ((0.0, 0), (0.0, 0), 0);
    for (index, (a, b)) in ours.iter().zip(&theirs).enumerate() {
        let difference = (0..3).map(|c| f64::from(a[c] - b[c]).abs()).fold(0.0, f64::max) / brightest;
        let worst = if edges[index] { &mut worst_edge } else { &mut worst_smooth };
        smooth_pixels += usize::from(!edges[index]);
        if difference > worst.0 {
            *worst = (difference, index);
        }
    }
    let difference = rms(&ours, &theirs);
    let sum: f64 = ours.iter().flatten().zip(theirs.iter().flatten()).map(|(a, b)| f64::from(a - b)).sum();
    let mean = sum / (3 * ours.len()) as f64 / brightest;
    let place = |index: usize| (index % width as usize, index / width as usize);
    println!(
        "{name}: {smooth_pixels} of {} pixels smooth, there at most {:.2e} at {:?}; at edges {:.2e} at {:?}; rms {:.2e}, \
         noise of both {:.2e}; mean {mean:.2e}",
        ours.len(),
        worst_smooth.0,
        place(worst_smooth.1),
        worst_edge.0,
        place(worst_edge.1),
        difference / brightest,
        noise / brightest
    );
    assert!(smooth_pixels > ours.len() / 2, "{name}: only {smooth_pixels} pixels without an edge");
    assert!(worst_smooth.0 <= smooth, "{name}: {:e} at {:?}", worst_smooth.0, place(worst_smooth.1));
    assert!(worst_edge.0 <= edge, "{name}: {:e} at the edge {:?}", worst_edge.0, place(worst_edge.1));
    assert!(mean.abs() <= 4e-5, "{name}: {mean:e} brighter on average");
    let explained = 1.25 * noise.hypot(2.4e-4 * brightest);
    assert!(difference <= explained, "{name}: rms {difference:e}, of which {explained:e} is explained");
}

#[test]
fn points() {
    hold("points", 256, HARD, EDGE);
}

#[test]
fn sun() {
    hold("sun", 256, HARD, EDGE);
}

#[test]
fn spot() {
    hold("spot", 256, HARD, EDGE);
}

#[test]
fn shapes() {
    hold("shapes", 256, HARD, EDGE);
}

#[test]
fn sphere_light() {
    hold("sphere-light", 256, SOFT, EDGE);
}

#[test]
fn disc_light() {
    hold("disc-light", 256, SOFT, EDGE);
}

#[test]
fn rectangle_light() {
    hold("rectangle-light", 256, SOFT, EDGE);
}

#[test]
fn mesh() {
    // Penumbras from sharp teeth, a pixel wide and less.
    hold("mesh", 256, 2.0 * SOFT, EDGE);
}

#[test]
fn soft_sphere() {
    hold("soft-sphere", 256, SOFT, EDGE);
}

#[test]
fn soft_disc() {
    // Nothing in this picture is bright: noise is a larger share of it, and takes more samples.
    hold("soft-disc", 1024, SOFT, EDGE);
}

#[test]
fn soft_rectangle() {
    hold("soft-rectangle", 256, SOFT, EDGE);
}
