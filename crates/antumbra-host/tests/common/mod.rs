//! The oracle's side of the comparisons.
#![allow(dead_code, reason = "each test program uses a part")]

use antumbra_host::{Api, HeadlessContext};
use antumbra_reference::{Ray, Sampling, Tracer};
use antumbra_scene::Scene;
use antumbra_testkit::metrics::edge_band;
use rayon::prelude::*;

/// A context, or `None` where there is no OpenGL, said aloud; with `ANTUMBRA_REQUIRE_GL` that is a
/// failure.
pub(crate) fn context(api: Api) -> Option<HeadlessContext> {
    match HeadlessContext::new(api) {
        Ok(context) => Some(context),
        Err(e) => {
            assert!(std::env::var_os("ANTUMBRA_REQUIRE_GL").is_none(), "{e}");
            eprintln!("skipped: {e}");
            None
        }
    }
}

/// One light's visibility as the reference sees it.
pub(crate) struct Truth {
    /// Through pixel centres; over the whole pixel where `edge`.
    pub(crate) visibility: Vec<f32>,
    /// Pixels that see one smooth surface alone, and an edge of its shadow.
    pub(crate) edge: Vec<bool>,
    /// Pixels within one pixel of an edge of the shadow or of an object.
    pub(crate) band: Vec<bool>,
}

/// Points a side of an edge pixel's grid: 256 points know the area to about 1/16 * 1/4.
const GRID: u32 = 16;

/// Cosine of the angle by which a surface may turn within a pixel before it counts as a crease.
const CREASE: f64 = 0.9;

/// Traces one light. Pixel areas are sampled where the centres of neighbours on the same primitive
/// differ.
pub(crate) fn truth(scene: &Scene, tracer: &Tracer, light: usize, width: u32, height: u32) -> Truth {
    let centers = tracer.visibility(light, width, height, Sampling::Center { light_samples: 1 }, &|_, _| {});
    let ids = tracer.primitives_seen(width, height);
    let (w, h) = (width as usize, height as usize);
    let near_edge = |i: usize| {
        let (x, y) = (i % w, i / w);
        let mut neighbors = (y.saturating_sub(1)..(y + 2).min(h))
            .flat_map(|ny| (x.saturating_sub(1)..(x + 2).min(w)).map(move |nx| ny * w + nx));
        ids[i].is_some() && neighbors.any(|j| ids[j] == ids[i] && centers[j] != centers[i])
    };
    let area = |i: usize| {
        let (x, y) = ((i % w) as f64, (i / w) as f64);
        let (mut sum, mut count) = (0.0, 0);
        let mut first_normal = None;
        for n in 0..GRID * GRID {
            let at = |k: u32| (f64::from(k) + 0.5) / f64::from(GRID);
            let (origin, direction) = scene.camera.ray(x + at(n % GRID), y + at(n / GRID), width, height);
            match tracer.surface(&Ray::new(origin, direction)) {
                Some(surface)
                    if Some(surface.primitive) == ids[i]
                        && surface.normal.dot(*first_normal.get_or_insert(surface.normal)) > CREASE =>
                {
                    sum += tracer.visibility_at(light, &surface, 1, 0);
                    count += 1;
                }
                _ => {}
            }
        }
        // Where the pixel sees something else too, or a crease, antialiasing is the host's.
        (count == GRID * GRID).then(|| (sum / f64::from(count)) as f32)
    };
    let (visibility, edge) = (0..w * h)
        .into_par_iter()
        .map(|i| match near_edge(i).then(|| area(i)).flatten() {
            Some(v) => (v, v > 0.0 && v < 1.0),
            None => (centers[i], false),
        })
        .unzip();
    let band = edge_band(&centers, &ids, w, h, 1);
    Truth { visibility, edge, band }
}

/// Pixels within one pixel of an edge of a light's shadow or of an object.
pub(crate) fn band(tracer: &Tracer, light: usize, width: u32, height: u32) -> Vec<bool> {
    let centers = tracer.visibility(light, width, height, Sampling::Center { light_samples: 1 }, &|_, _| {});
    edge_band(&centers, &tracer.primitives_seen(width, height), width as usize, height as usize, 1)
}
