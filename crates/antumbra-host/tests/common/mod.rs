//! The oracle's side of the comparisons.
#![allow(dead_code, reason = "each test program uses a part")]

pub(crate) mod awkward;

use antumbra_reference::{Sampling, Tracer};
use antumbra_scene::Scene;
use antumbra_testkit::metrics::edge_band;
use antumbra_testkit::truth;

/// One light's visibility as the reference sees it.
pub(crate) struct Truth {
    /// As [`truth::Truth::visibility`].
    pub(crate) visibility: Vec<f32>,
    /// As [`truth::Truth::edge`].
    pub(crate) edge: Vec<bool>,
    /// Pixels within one pixel of an edge of the shadow or of an object.
    pub(crate) band: Vec<bool>,
}

/// Traces one light.
pub(crate) fn truth(scene: &Scene, tracer: &Tracer, light: usize, width: u32, height: u32) -> Truth {
    let truth = truth::Truth::new(scene, tracer, light, width, height);
    let band = truth.band(1);
    Truth { visibility: truth.visibility, edge: truth.edge, band }
}

/// Pixels within one pixel of an edge of a light's shadow or of an object.
pub(crate) fn band(tracer: &Tracer, light: usize, width: u32, height: u32) -> Vec<bool> {
    let centers = tracer.visibility(light, width, height, Sampling::Center { light_samples: 1 }, &|_, _| {});
    edge_band(&centers, &tracer.primitives_seen(width, height), width as usize, height as usize, 1)
}
