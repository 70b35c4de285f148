//! Soft shadows in closed form as pictures: against Mitsuba 3, an independent renderer, and as something that moves and
//! that the eye follows across a penumbra.

mod common;

use antumbra::glam::DVec3;
use antumbra::{Soft, Technique};
use antumbra_host::{Api, RenderOptions, Rendered, Stage, TestContext};
use antumbra_reference::{Ray, Surface, Tracer};
use antumbra_scene::Scene;
use exr::prelude::*;
use rayon::prelude::*;
use std::path::Path;

fn render(stage: &mut Stage, scene: &Scene, (width, height): (u32, u32), technique: Technique) -> Rendered {
    let options = RenderOptions {
        time: 0.0,
        width,
        height,
        msaa: 1,
        visibility: true,
        shadows: true,
        technique,
        soft: Soft::Native,
    };
    stage.render(scene, &options).expect("the scene draws")
}

fn seen(scene: &Scene, tracer: &Tracer, (width, height): (u32, u32), index: u32) -> Option<Surface> {
    let (x, y) = (f64::from(index % width) + 0.5, f64::from(index / width) + 0.5);
    let (origin, direction) = scene.camera.ray(x, y, width, height);
    tracer.surface(&Ray::new(origin, direction))
}

/// Pixels with another primitive or a crease (round shapes turn by less from one pixel to the next) within one pixel:
/// there a pixel is a mean over both.
fn silhouettes(surfaces: &[Option<Surface>], width: usize) -> Vec<bool> {
    let height = surfaces.len() / width;
    let goes_on = |a: Option<Surface>, b: Option<Surface>| match (a, b) {
        (Some(a), Some(b)) => a.primitive == b.primitive && a.normal.dot(b.normal) > 0.9,
        (a, b) => a.is_none() && b.is_none(),
    };
    (0..surfaces.len())
        .map(|index| {
            let (x, y) = (index % width, index / width);
            let (columns, rows) =
                (x.saturating_sub(1)..width.min(x + 2), y.saturating_sub(1)..height.min(y + 2));
            rows.flat_map(|row| columns.clone().map(move |column| row * width + column))
                .any(|neighbour| !goes_on(surfaces[index], surfaces[neighbour]))
        })
        .collect()
}

/// Mitsuba's pixels are means over their area, ours are their centres: so many of ours across make one of its.
const FINER: u32 = 4;

/// A picture `width` pixels wide as means of one that is [`FINER`].
fn coarse(fine: &[[f32; 3]], width: usize) -> Vec<[f32; 3]> {
    let finer = FINER as usize;
    let mut means = vec![[0.0; 3]; fine.len() / (finer * finer)];
    for (i, pixel) in fine.iter().enumerate() {
        let (x, y) = (i % (width * finer) / finer, i / (width * finer) / finer);
        let mean: &mut [f32; 3] = &mut means[y * width + x];
        (0..3).for_each(|c| mean[c] += pixel[c] / (finer * finer) as f32);
    }
    means
}

/// Three scenes whose shadows overlap, in linear light, against pictures with 2048 samples a pixel
/// (`tools/make_references.py`): the root mean square difference of the pixels without a silhouette, relative to the
/// root mean square of the picture, at most 0.0016: no more than the noise of the references.
#[test]
fn mitsuba() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../antumbra-reference/tests/mitsuba");
    let table = std::fs::read_to_string(folder.join("noise.csv")).expect("the committed table");
    for name in ["soft-sphere", "soft-disc", "soft-rectangle"] {
        let scene = Scene::load(&folder.join(name).with_extension("toml")).expect("the committed scene");
        let size = (scene.image.width, scene.image.height);
        let theirs = read_first_rgba_layer_from_file(
            folder.join(name).with_extension("exr"),
            |size, _| (size.width(), vec![[0.0; 3]; size.area()]),
            |(width, picture): &mut (usize, Vec<[f32; 3]>), at, (r, g, b, _): (f32, f32, f32, f32)| {
                picture[at.y() * *width + at.x()] = [r, g, b];
            },
        );
        let (width, theirs) = theirs.expect("the committed picture").layer_data.channel_data.pixels;
        let tracer = Tracer::new(&scene, 0.0);
        let surfaces: Vec<_> = (0..size.0 * size.1).map(|i| seen(&scene, &tracer, size, i)).collect();
        assert_eq!((width, theirs.len()), (size.0 as usize, surfaces.len()), "{name}: size of the reference");
        let silhouette = silhouettes(&surfaces, width);
        let kept: Vec<usize> = (0..theirs.len()).filter(|i| !silhouette[*i]).collect();
        assert!(kept.len() > theirs.len() / 2, "{name}: only {} pixels without a silhouette", kept.len());
        let squares = |value: &dyn Fn(usize, usize) -> f32| -> f64 {
            kept.iter().map(|&i| (0..3).map(|c| f64::from(value(i, c)).powi(2)).sum::<f64>()).sum()
        };
        let scale = squares(&|i, c| theirs[i][c]);
        let relative = |ours: &[[f32; 3]]| (squares(&|i, c| ours[i][c] - theirs[i][c]) / scale).sqrt();
        let noise: f64 = table
            .lines()
            .find_map(|line| line.strip_prefix(name)?.strip_prefix(',')?.parse().ok())
            .expect("a row of the table");
        let noise = noise / (scale / (3 * kept.len()) as f64).sqrt();
        let exact = Technique::parse("analytic:quality=exact").expect("an option");
        let [exact, fast] = [exact, Technique::default()].map(|technique| {
            let drawn = render(&mut stage, &scene, (size.0 * FINER, size.1 * FINER), technique).image;
            relative(&coarse(&drawn, width))
        });
        println!(
            "{name}: {} of {} pixels, relative RMSE {exact:.5}, with the product {fast:.5}; noise of the reference {noise:.5}",
            kept.len(),
            theirs.len()
        );
        assert!(noise <= 0.0017, "{name}: the reference's noise, {noise}");
        assert!(exact <= 0.0016, "{name}: relative RMSE {exact}");
        assert!(fast > exact, "{name}: shadows overlap");
    }
}

/// Pixels of what moves.
const SIZE: (u32, u32) = (480, 300);

/// Lights and what they shine on; all but the first object cast. Penumbrae are several pixels wide: narrower ones are widened.
const SETUPS: [(&str, &str, &str); 5] = [
    ("a ball", r#"type = "sphere", position = [1.5, 4.0, 0.5], radius = 0.4"#, BALL),
    (
        "a cone",
        r#"type = "rectangle", position = [1.5, 4.0, 0.5], direction = [-0.3, -1, 0], right = [1, -0.3, 0.4], width = 1.2, height = 0.5"#,
        CONE,
    ),
    (
        "a card",
        r#"type = "disc", position = [-1.5, 3.5, 0.5], direction = [0.4, -1, 0], radius = 0.5"#,
        r#"{ type = "rectangle", width = 1.2, depth = 0.6 }"#,
    ),
    (
        "a ball, light cut by the horizon",
        r#"type = "sphere", position = [3.5, 0.9, 0.5], radius = 0.8"#,
        BALL,
    ),
    (
        "a cone, light cut by the horizon",
        r#"type = "rectangle", position = [3.5, 0.9, 0.5], direction = [-1, -0.1, 0], right = [0, 0, 1], width = 1.2, height = 1.4"#,
        CONE,
    ),
];
const BALL: &str = r#"{ type = "sphere", radius = 0.5 }"#;
const CONE: &str = r#"{ type = "cone", radius = 0.5, height = 1.0 }"#;

/// On a floor and on a hill whose horizon cuts lights that are low.
fn setup((_, light, shape): (&str, &str, &str)) -> Scene {
    let light = light.replace(", position", "\nposition").replace(", radius", "\nradius");
    let light = light.replace(", direction", "\ndirection").replace(", right", "\nright");
    let light = light.replace(", width", "\nwidth").replace(", height", "\nheight");
    let text = format!(
        "[camera]\neye = [0, 5, 7]\ntarget = [-0.5, 0.5, 0]\nfov_y = 45\n\
         [[light]]\nname = \"light\"\nintensity = 50\n{light}\n\
         [[object]]\nname = \"floor\"\nshape = {{ type = \"plane\" }}\ncasts_shadow = false\n\
         [[object]]\nname = \"hill\"\nshape = {{ type = \"sphere\", radius = 3.0 }}\n\
         translation = [-0.8, -2.3, -1.5]\ncasts_shadow = false\n\
         [[object]]\nname = \"occluder\"\nshape = {shape}\ntranslation = [0.3, 1.5, 0]\n\
         rotation = [0.2, 0, 0.3, 0.9327379053088815]\nreceives_shadow = false\n"
    );
    Scene::parse(&text, "soft".as_ref()).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// Lux, in a light of 50 candela: less is no level of 8 bits of what the light gives at the occluder's distance.
const DIM: f64 = 0.02;

/// No banding, no noise: a light moved by a tenth of a pixel, as the eye measures it at the light's distance, changes no
/// pixel by more than its true change and 2/255. The true change is the ray tracer's with the same points of the light.
/// So that slowness does not pass for smoothness, on a grid of penumbra pixels the change is the true one within 2/255.
#[test]
fn a_light_moved_a_little_changes_little() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    const BOUND: f64 = 2.0 / 255.0;
    for (number, about) in SETUPS.into_iter().enumerate() {
        let scene = setup(about);
        let step = 0.1 * 2.0 * (0.5 * scene.camera.fov_y).tan() / f64::from(SIZE.1)
            * scene.camera.eye.distance(scene.lights[0].position);
        let direction = [DVec3::X, DVec3::Y, DVec3::Z][number % 3];
        let mut moved = scene.clone();
        moved.lights[0].position += direction * step;
        let [before, after] =
            [&scene, &moved].map(|s| render(&mut stage, s, SIZE, Technique::default()).visibility);
        let tracers = [&scene, &moved].map(|s| Tracer::new(s, 0.0));
        let changes: Vec<(bool, f64, f64)> = (0..SIZE.0 * SIZE.1)
            .into_par_iter()
            .filter_map(|i| {
                let [a, b] = [&before, &after].map(|v| f64::from(v[0][i as usize]));
                let on_grid = i % SIZE.0 % 6 == 3 && i / SIZE.0 % 6 == 3 && (0.002..0.998).contains(&a);
                if (b - a).abs() <= BOUND && !on_grid {
                    return None;
                }
                let surface = seen(&scene, &tracers[0], SIZE, i)?;
                // Where the horizon leaves next to nothing of the light, any share of it is nothing to see.
                if tracers.iter().any(|t| t.unoccluded_irradiance(0, &surface, 64, i) < DIM) {
                    return None;
                }
                let [c, d] = [0, 1].map(|k| tracers[k].visibility_at(0, &surface, 1 << 12, i));
                Some((on_grid, b - a, d - c))
            })
            .collect();
        assert!(changes.iter().all(|c| c.1.is_finite() && c.2.is_finite()), "{}: numbers", about.0);
        let grid: Vec<_> = changes.iter().filter(|c| c.0).collect();
        let worst = changes.iter().map(|c| c.1.abs() - c.2.abs()).fold(f64::MIN, f64::max);
        let off = grid.iter().map(|c| (c.1 - c.2).abs()).fold(0.0, f64::max);
        let rms = |value: &dyn Fn(&(bool, f64, f64)) -> f64| {
            (grid.iter().map(|c| value(c).powi(2)).sum::<f64>() / grid.len() as f64).sqrt()
        };
        println!(
            "{}: moved by {step:.1e}; {} pixels of the grid change by {:.5} (RMS), {:.5} off, at most {off:.5}; of {} \
             looked at, the largest excess {worst:.5}",
            about.0,
            grid.len(),
            rms(&|c| c.2),
            rms(&|c| c.1 - c.2),
            changes.len(),
        );
        assert!(grid.len() > 60, "{}: a penumbra to look at", about.0);
        assert!(worst <= BOUND, "{}: a pixel changes by {worst} more than it should", about.0);
        assert!(off <= BOUND, "{}: a change is {off} off", about.0);
    }
}

/// How far a pixel lies off the mean of its neighbours, beyond the truth, in units of the mask: half a second difference.
///
/// Half floats round by 2^-12 at most, which is 2^-11 of half a second difference. The light that the horizon cuts leaves
/// no more than that. Elsewhere the error of eight nodes, at most .009 where an outline's corner lies on the light,
/// changes from one pixel to the next of a narrow penumbra.
const ROUNDING: f64 = 1.1 / 2048.0;

/// Along rows across penumbrae the second difference of the drawn visibility is the true one, traced, but for
/// rounding, and but for the quadrature where a penumbra is only a few pixels wide: there within 2/255, and over
/// all rows within a quarter of 1/255 at the root mean square.
#[test]
fn penumbrae_are_smooth() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    for about in SETUPS {
        let scene = setup(about);
        let drawn = &render(&mut stage, &scene, SIZE, Technique::default()).visibility[0];
        let tracer = Tracer::new(&scene, 0.0);
        let cut = about.0.ends_with("horizon");
        // The rays' own second differences are a fifth of what is to be seen: 5e-5, and 3e-4 where more is allowed.
        let (rays, step) = if cut { (1 << 18, 24) } else { (1 << 15, 8) };
        let found = (0..SIZE.1)
            .into_par_iter()
            .step_by(step)
            .map(|row| {
                // Only where the light is seen in part, or a neighbour sees it so.
                let partial = |index: u32| (0.001..0.999).contains(&drawn[index as usize]);
                let points: Vec<Option<(u32, f64, f64)>> = (0..SIZE.0)
                    .map(|x| {
                        let index = row * SIZE.0 + x;
                        let near = [index.saturating_sub(1), index, index + 1];
                        let near = near.iter().any(|&i| i / SIZE.0 == row && partial(i));
                        let surface = seen(&scene, &tracer, SIZE, index).filter(|_| near)?;
                        if tracer.unoccluded_irradiance(0, &surface, 64, row) < DIM {
                            return None; // any share of next to nothing is nothing to see
                        }
                        let truth = tracer.visibility_at(0, &surface, rays, row);
                        Some((surface.primitive, f64::from(drawn[index as usize]), truth))
                    })
                    .collect();
                let mut found = [0.0f64; 4];
                for three in points.windows(3) {
                    let [Some(a), Some(b), Some(c)] = three else { continue };
                    if (0.001..0.999).contains(&b.2) && a.0 == b.0 && b.0 == c.0 {
                        let bend =
                            |value: &dyn Fn(&(u32, f64, f64)) -> f64| value(b) - 0.5 * (value(a) + value(c));
                        let (drawn, truth) = (bend(&|p| p.1), bend(&|p| p.2));
                        let off = (drawn - truth).abs();
                        found = [
                            found[0] + 1.0,
                            found[1] + off * off,
                            found[2].max(off),
                            found[3].max(truth.abs()),
                        ];
                    }
                }
                found
            })
            .reduce(|| [0.0; 4], |a, b| [a[0] + b[0], a[1] + b[1], a[2].max(b[2]), a[3].max(b[3])]);
        let [count, squares, worst, truth] = found;
        let (name, rms) = (about.0, (squares / count).sqrt());
        println!(
            "{name}: {count} pixels off their neighbours by {rms:.5} (RMS), {worst:.5} at most; true bends up to {truth:.5}"
        );
        assert!(count > 250.0, "{name}: rows that cross a penumbra");
        assert!(rms <= 0.25 / 255.0, "{name}: pixels are {rms} off their neighbours");
        let bound = if cut { ROUNDING } else { 2.0 / 255.0 };
        assert!(worst <= bound, "{name}: a pixel is {worst} off its neighbours");
    }
}
