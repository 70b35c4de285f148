//! Which pixels a technique gets wrong.

use antumbra::Technique;
use antumbra_host::{RenderOptions, Stage};
use antumbra_reference::{Sampling, Tracer};
use antumbra_scene::Scene;
use antumbra_testkit::metrics::{edge_band, misclassified};

/// What a technique did with the lights of some scenes.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Classified {
    /// Lights looked at.
    pub(crate) lights: usize,
    /// Pixels on the wrong side outside the band.
    pub(crate) wrong: usize,
    /// Dark pixels outside the band.
    pub(crate) dark: usize,
    /// Lit pixels outside the band.
    pub(crate) lit: usize,
}

impl std::ops::AddAssign for Classified {
    fn add_assign(&mut self, other: Self) {
        self.lights += other.lights;
        self.wrong += other.wrong;
        self.dark += other.dark;
        self.lit += other.lit;
    }
}

/// Draws a scene in each of some ways and compares every light with the ray tracer, pixel centre by pixel centre, outside a
/// band of `band` pixels round the edges of shadows and objects. Says which lights are wrong.
pub(crate) fn classify(
    stage: &mut Stage,
    scene: &Scene,
    name: &str,
    techniques: &[Technique],
    band: usize,
) -> Vec<Classified> {
    let (width, height) = (scene.image.width, scene.image.height);
    let drawn: Vec<_> = techniques
        .iter()
        .map(|&technique| {
            let options = RenderOptions {
                time: 0.0,
                width,
                height,
                msaa: 1,
                visibility: true,
                shadows: false,
                technique,
                soft: antumbra::Soft::Native,
            };
            stage
                .render(scene, &options)
                .unwrap_or_else(|e| panic!("{name} with {technique}: {e}"))
                .visibility
        })
        .collect();
    let tracer = Tracer::new(scene, 0.0);
    let ids = tracer.primitives_seen(width, height);
    let (w, h) = (width as usize, height as usize);
    let mut found = vec![Classified::default(); techniques.len()];
    for light in 0..scene.lights.len() {
        let sampling = Sampling::Center { light_samples: 1 };
        let truth = tracer.visibility(light, width, height, sampling, &|_, _| {});
        let edges = edge_band(&truth, &ids, w, h, band);
        let seen = |i: &usize| !edges[*i] && ids[*i].is_some();
        let dark = (0..w * h).filter(|i| seen(i) && truth[*i] < 0.5).count();
        let lit = (0..w * h).filter(|i| seen(i) && truth[*i] >= 0.5).count();
        for ((found, drawn), technique) in found.iter_mut().zip(&drawn).zip(techniques) {
            let wrong = misclassified(&drawn[light], &truth, &edges);
            if wrong > 0 {
                let at = (0..w * h).find(|&i| !edges[i] && (drawn[light][i] >= 0.5) != (truth[i] >= 0.5));
                let at = at.map(|i| (i % w, i / w, ids[i], truth[i]));
                eprintln!(
                    "{name}, light {light} ({:?}), {technique}: {wrong} wrong, the first at {at:?}",
                    scene.lights[light].kind
                );
            }
            *found += Classified { lights: 1, wrong, dark, lit };
        }
    }
    found
}
