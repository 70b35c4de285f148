//! Lights with an area as collections of points, with every technique, against the ray tracer.

mod common;

use antumbra::glam::{DVec2, DVec3};
use antumbra::{Area, Pattern, Soft, Technique};
use antumbra_host::{Api, RenderOptions, Stage, TestContext, objection};
use antumbra_reference::{Ray, Surface, Tracer};
use antumbra_scene::{Light, LightKind, Scene};
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const WIDTH: u32 = 320;
const HEIGHT: u32 = 240;

/// A light over a floor, and a disc parallel to it between, which every technique knows exactly.
fn scene(light: &str) -> Scene {
    let text = format!(
        "[camera]\neye = [0, 6, 5]\ntarget = [0, 0, 0]\nfov_y = 40\n\
         [[light]]\nname = \"light\"\nintensity = 50\n{light}\n\
         [[object]]\nname = \"floor\"\nshape = {{ type = \"plane\" }}\n\
         [[object]]\nname = \"disc\"\nshape = {{ type = \"disc\", radius = 0.7 }}\ntranslation = [0.1, 0.9, -0.2]\n"
    );
    Scene::parse(&text, "samples".as_ref()).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

const LIGHTS: [&str; 3] = [
    "type = \"sphere\"\nposition = [1.0, 4.0, 0.5]\nradius = 0.8",
    "type = \"disc\"\nposition = [-1.5, 3.5, 0.5]\nradius = 0.9\ndirection = [0.5, -1, -0.1]",
    "type = \"rectangle\"\nposition = [1.0, 3.5, 1.5]\nwidth = 1.8\nheight = 1.0\ndirection = [-0.2, -1, -0.4]\n\
     right = [1, -0.2, 0]",
];

/// The techniques that can average hard shadows over these lights.
fn able(scene: &Scene, soft: Soft) -> Vec<Technique> {
    let moment = scene.moment(0.0);
    let physical = Technique::all().map(|mut technique| {
        if technique.paints() {
            technique.set("shade", "physical").expect("techniques that paint can do without");
        }
        technique
    });
    let able: Vec<Technique> =
        physical.filter(|technique| objection(scene, &moment, technique, soft).is_none()).collect();
    let names: Vec<&str> = able.iter().map(Technique::name).collect();
    assert_eq!(names, ["analytic", "composite", "projected", "volume", "map"], "all can");
    able
}

/// The scene's light as the renderer has it.
fn area(light: &Light) -> Area {
    match light.kind {
        LightKind::Sphere { radius } => Area::Sphere { radius },
        LightKind::Disc { direction, radius } => Area::Disc { direction, radius },
        LightKind::Rectangle { direction, right, width, height } => Area::Rectangle {
            direction,
            half_right: right * (0.5 * width),
            half_up: direction.cross(right) * (0.5 * height),
        },
        _ => Area::None,
    }
}

fn draw(stage: &mut Stage, scene: &Scene, technique: Technique, soft: Soft) -> Vec<f32> {
    let options = RenderOptions {
        time: 0.0,
        width: WIDTH,
        height: HEIGHT,
        msaa: 1,
        visibility: true,
        shadows: true,
        technique,
        soft,
    };
    stage.render(scene, &options).expect("the scene draws").visibility.swap_remove(0)
}

fn seen(scene: &Scene, tracer: &Tracer, pixel: u32) -> Option<Surface> {
    let (x, y) = (f64::from(pixel % WIDTH) + 0.5, f64::from(pixel / WIDTH) + 0.5);
    let (origin, direction) = scene.camera.ray(x, y, WIDTH, HEIGHT);
    tracer.surface(&Ray::new(origin, direction))
}

/// What a point sends to the surface, written out: cosines over squared distance.
fn weight(point: DVec3, area: &Area, surface: &Surface) -> f64 {
    let to_point = point - surface.point;
    let direction = to_point.normalize();
    let sent = match area {
        Area::Disc { direction: axis, .. } | Area::Rectangle { direction: axis, .. } => {
            (-direction.dot(*axis)).max(0.0)
        }
        _ => 1.0,
    };
    surface.normal.dot(direction).max(0.0) * sent / to_point.length_squared()
}

/// The points of a light, more than one, as docs/theory/samples.md describes them.
fn offsets(area: &Area, count: u32, pattern: Pattern, mut each: impl FnMut(DVec3)) {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    const PLASTIC: f64 = 0.754_877_666_246_692_7;
    let (n, side) = (f64::from(count), count.isqrt());
    let [right, up] = match *area {
        Area::Sphere { radius } => [DVec3::X * radius, DVec3::Z * radius],
        Area::Disc { direction, radius } => {
            let right = direction.any_orthonormal_vector() * radius;
            [right, direction.cross(right)]
        }
        Area::Rectangle { half_right, half_up, .. } => [half_right, half_up],
        _ => panic!("a light with an area"),
    };
    for k in (0..count).map(f64::from) {
        let turn = DVec2::from_angle(TAU * GOLDEN * k);
        each(match (pattern, area) {
            (Pattern::Row, _) => right.lerp(-right, 1.0 - k / (n - 1.0)),
            (_, Area::Rectangle { .. }) if side * side == count => {
                let s = f64::from(side);
                right * (2.0 * (k % s + 0.5) / s - 1.0) + up * (2.0 * ((k / s).floor() + 0.5) / s - 1.0)
            }
            (_, Area::Rectangle { .. }) => {
                right * (2.0 * (k + 0.5) / n - 1.0) + up * (2.0 * (0.5 + k * GOLDEN).fract() - 1.0)
            }
            (_, Area::Disc { .. }) => (right * turn.x + up * turn.y) * ((k + 0.5) / n).sqrt(),
            _ => {
                let height = 1.0 - 2.0 * (k + 0.5) / n;
                let share = (0.5 + PLASTIC * k).fract();
                // Newton's method for 2 t - sin 2 t = π share.
                let mut t = FRAC_PI_2 * share.cbrt();
                for _ in 0..50 {
                    t -= (2.0 * t - (2.0 * t).sin() - PI * share) / (2.0 - 2.0 * (2.0 * t).cos());
                }
                let across = (1.0 - height * height).sqrt();
                (right * (turn.x * across) + up * (turn.y * across) + DVec3::Y * (right.length() * height))
                    * t.sin()
            }
        });
    }
}

/// Of each pixel the visibility of the light's points, and their average.
fn traced(scene: &Scene, count: u32, pattern: Pattern) -> Vec<Option<(usize, Vec<bool>, f64)>> {
    let (light, mut points) = (&scene.lights[0], Vec::new());
    let area = area(light);
    offsets(&area, count, pattern, |offset| points.push(light.position + offset));
    let mut split = scene.clone();
    let point = |&position: &DVec3| Light { position, kind: LightKind::Point, ..light.clone() };
    split.lights = points.iter().map(point).collect();
    let tracer = Tracer::new(&split, 0.0);
    let one = |pixel| {
        let surface = seen(scene, &tracer, pixel)?;
        let lit: Vec<bool> =
            (0..points.len()).map(|i| tracer.visibility_at(i, &surface, 1, 0) > 0.5).collect();
        let weights: Vec<f64> = points.iter().map(|&point| weight(point, &area, &surface)).collect();
        let arrives: f64 = weights.iter().zip(&lit).filter(|(_, lit)| **lit).map(|(w, _)| w).sum();
        let all: f64 = weights.iter().sum();
        Some((surface.primitive as usize, lit, if all > 0.0 { arrives / all } else { 1.0 }))
    };
    (0..WIDTH * HEIGHT).into_par_iter().map(one).collect()
}

/// Where no point's shadow has its edge in the pixel or beside it, the average is the ray tracer's: to the step of the
/// half floats that masks of area lights are, and the rounding of the sums.
#[test]
fn averages_are_those_of_the_same_points() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    for light in LIGHTS {
        let scene = scene(light);
        for (count, pattern) in [(3, Pattern::Row), (5, Pattern::Spread), (16, Pattern::Spread)] {
            let truth = traced(&scene, count, pattern);
            let soft = Soft::Samples { count, pattern };
            let techniques = able(&scene, soft);
            for technique in techniques {
                let drawn = draw(&mut stage, &scene, technique, soft);
                let (mut compared, mut partial) = (0, 0);
                for y in 1..HEIGHT - 1 {
                    for x in 1..WIDTH - 1 {
                        let at = |dx: u32, dy: u32| &truth[((y + dy - 1) * WIDTH + x + dx - 1) as usize];
                        let Some((primitive, lit, expected)) = at(1, 1) else { continue };
                        let same = |other: &Option<(usize, Vec<bool>, f64)>| {
                            other.as_ref().is_some_and(|(p, l, _)| p == primitive && l == lit)
                        };
                        if !(0..9).all(|i| same(at(i % 3, i / 3))) {
                            continue;
                        }
                        compared += 1;
                        partial += usize::from(*expected > 0.01 && *expected < 0.99);
                        let found = f64::from(drawn[(y * WIDTH + x) as usize]);
                        assert!(
                            (found - expected).abs() < 6e-4,
                            "{technique}, {soft}, {light}: {found} for {expected} at {x} {y}"
                        );
                    }
                }
                assert!(compared > 30_000 && partial > 100, "{technique}, {soft}: {partial} of {compared}");
            }
        }
    }
}

/// Root mean square error inside the penumbra against the ray tracer at 4096 samples.
fn error(drawn: &[f32], truth: &[Option<f64>]) -> f64 {
    let inside = drawn.iter().zip(truth).filter_map(|(drawn, truth)| Some(f64::from(*drawn) - (*truth)?));
    let squares: Vec<f64> = inside.map(|difference| difference * difference).collect();
    assert!(squares.len() > 200, "{} pixels in the penumbra", squares.len());
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

/// MATHS: evenly spread points on the side of the light that faces the receiver are wrong by .094 (5 of them), .037
/// (16), .0125 (64) and .0042 (256). A ball's fixed set, spread in three dimensions, is up to 1.6 times as far off.
#[test]
fn more_points_come_nearer_to_the_truth() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    // The table of docs/theory/samples.md.
    let table =
        [[0.142, 0.045, 0.0195, 0.0065], [0.116, 0.0315, 0.0088, 0.002], [0.079, 0.0235, 0.007, 0.0014]];
    for (light, bounds) in LIGHTS.into_iter().zip(table) {
        let scene = scene(light);
        let tracer = Tracer::new(&scene, 0.0);
        let truth: Vec<Option<f64>> = (0..WIDTH * HEIGHT)
            .into_par_iter()
            .map(|pixel| {
                // One in nine is enough to look at.
                let looked_at = pixel % WIDTH % 3 == 1 && pixel / WIDTH % 3 == 1;
                let surface = looked_at.then(|| seen(&scene, &tracer, pixel)).flatten()?;
                let rough = tracer.visibility_at(0, &surface, 64, pixel);
                let inside = (0.001..0.999).contains(&rough);
                inside.then(|| tracer.visibility_at(0, &surface, 4096, pixel))
            })
            .collect();
        for technique in able(&scene, Soft::samples(4)) {
            // The last is left out where it takes a quarter of a minute.
            let counts = if matches!(technique.name(), "map" | "volume") { 3 } else { 4 };
            let errors = [4, 16, 64, 256][..counts].iter().map(|&count| {
                let drawn = draw(&mut stage, &scene, technique, Soft::samples(count));
                error(&drawn, &truth)
            });
            let errors: Vec<f64> = errors.collect();
            println!("{technique}, {light:?}: {errors:.4?}");
            // The others' edges are not antialiased: part of a step in the pixels that edges run through, more of them the
            // more points there are, and each step smaller.
            let smooth = matches!(technique.name(), "analytic" | "composite");
            let steps = if smooth { [0.0; 4] } else { [0.0095, 0.0065, 0.0055, 0.003] };
            for ((error, bound), step) in errors.iter().zip(bounds).zip(steps) {
                assert!(*error < bound + step, "{technique}, {light}: {errors:?}");
            }
            assert!(errors.windows(2).all(|w| w[1] < 0.6 * w[0]), "{technique}, {light}: {errors:?}");
        }
    }
}

/// A light that is next to nothing casts the hard shadow, whatever the pattern.
#[test]
fn points_that_coincide_give_the_hard_shadow() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    let hard = scene("type = \"point\"\nposition = [1.0, 4.0, 0.5]");
    let tiny = scene("type = \"sphere\"\nposition = [1.0, 4.0, 0.5]\nradius = 1e-5");
    for soft in [Soft::samples(1), Soft::samples(9), Soft::Samples { count: 3, pattern: Pattern::Row }] {
        for technique in able(&tiny, soft) {
            let expected = draw(&mut stage, &hard, technique, Soft::Native);
            let found = draw(&mut stage, &tiny, technique, soft);
            assert!(found.iter().all(|v| v.is_finite()), "{technique}: numbers");
            let worst = expected.iter().zip(&found).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            // Half a step of eight bits in either, the half float, and an edge that moves 1e-5 m in pixels of 2 cm.
            // A map's texels turn with the light: a filtered edge moves by a hundredth of one.
            let texels = if technique.name() == "map" { 0.005 } else { 0.0 };
            assert!(worst <= 1.0 / 255.0 + 1e-3 + texels, "{technique}, {soft}: {worst}");
        }
    }
}
