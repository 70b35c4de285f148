//! Where the overlay belongs in a host with a tone curve: before it, on linear colours (docs/hosts.md).

mod common;

use antumbra::{Soft, Technique};
use antumbra_host::{Api, RenderOptions, Stage, TestContext};
use antumbra_reference::Tracer;
use antumbra_scene::Scene;

const SIZE: (u32, u32) = (480, 270);

/// A filmic curve, as displayed: K. Narkowicz, ACES Filmic Tone Mapping Curve, 2015.
fn displayed(linear: f32) -> f32 {
    let x = linear.max(0.0);
    let film = (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14);
    film.clamp(0.0, 1.0).powf(1.0 / 2.2)
}

/// Pixels, away from edges, that are off by more than 4/255 where the overlay is drawn on the linear picture before the
/// curve, and where it is drawn on what the curve has made, as if that were a plain gamma of 2.2.
#[test]
fn an_overlay_belongs_before_the_tone_curve() {
    let Some(context) = TestContext::new(Api::Gl33) else { return };
    let mut stage = Stage::new(context.gl()).expect("a stage");
    let gallery = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let (mut compared, mut before, mut after) = (0, 0, 0);
    for name in ["balls-on-the-floor", "coloured-lights", "shadows-on-objects", "sun-and-spotlights"] {
        let scene = Scene::load(&gallery.join(name).with_extension("toml")).expect("a gallery scene");
        let options = RenderOptions {
            time: 0.0,
            width: SIZE.0,
            height: SIZE.1,
            msaa: 1,
            visibility: false,
            shadows: true,
            technique: Technique::default(),
            soft: Soft::Native,
        };
        let with = stage.render(&scene, &options).expect("the scene draws").image;
        let options = RenderOptions { shadows: false, ..options };
        let without = stage.render(&scene, &options).expect("the scene draws").image;
        let tracer = Tracer::new(&scene, 0.0);
        let truth = tracer.render(SIZE.0, SIZE.1, 1, &|_, _| {});
        let mut band = vec![false; truth.len()];
        for light in 0..scene.lights.len() {
            let edges = common::band(&tracer, light, SIZE.0, SIZE.1);
            band.iter_mut().zip(edges).for_each(|(band, edge)| *band |= edge);
        }
        for i in (0..truth.len()).filter(|&i| !band[i]) {
            let off = |picture: &dyn Fn(usize) -> f32| {
                (0..3).any(|c| (picture(c) - displayed(truth[i][c])).abs() > 4.0 / 255.0)
            };
            // The factor that the overlay multiplies with, encoded as Encoding::Gamma(2.2) does.
            let factor = |c: usize| (with[i][c] / without[i][c].max(1e-9)).min(1.0).powf(1.0 / 2.2);
            compared += 1;
            before += usize::from(off(&|c| displayed(with[i][c])));
            after += usize::from(off(&|c| displayed(without[i][c]) * factor(c)));
        }
    }
    let share = |count: usize| 100.0 * count as f64 / compared as f64;
    println!(
        "of {compared} pixels off by more than 4/255: {:.3} % before, {:.1} % after",
        share(before),
        share(after)
    );
    assert!(compared > 200_000, "{compared} pixels are compared");
    assert!(share(before) <= 0.05, "before the curve: {:.3} %", share(before));
    assert!(share(after) > 5.0, "after the curve: {:.1} %", share(after));
}
