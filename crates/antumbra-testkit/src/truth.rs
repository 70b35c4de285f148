//! What the ray tracer says a picture of visibilities should be, and where no picture can be held to it.

use antumbra_reference::{Ray, Sampling, Tracer};
use antumbra_scene::{LightKind, Scene};
use rayon::prelude::*;

use crate::metrics::edge_band;

/// Points a side of an edge pixel's grid: 256 points know the area to about 1/16 * 1/4.
const GRID: u32 = 16;

/// Rays to an area light from each pixel: a standard error of at most 1/32 in a penumbra.
const LIGHT_SAMPLES: u32 = 256;

/// Cosine of the angle by which a surface may turn within a pixel before it counts as a crease.
const CREASE: f64 = 0.9;

/// One light's visibility as the reference sees it, rows from top to bottom.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// Through pixel centres; over the whole pixel where `edge` is true of a light without area.
    pub visibility: Vec<f32>,
    /// Pixels that see one smooth surface alone and are partly lit: by an edge of the shadow that runs through them,
    /// or by part of an area light.
    pub edge: Vec<bool>,
    /// Through pixel centres.
    centers: Vec<f32>,
    /// The primitive each pixel sees.
    ids: Vec<Option<u32>>,
    width: usize,
    height: usize,
}

impl Truth {
    /// Traces the light of this index in the scene at the tracer's moment. Where the centres of neighbours on the same
    /// primitive differ, the area of the pixel is sampled.
    ///
    /// # Panics
    /// If there is no such light.
    pub fn new(scene: &Scene, tracer: &Tracer, light: usize, width: u32, height: u32) -> Self {
        let kind = tracer.lights()[light].kind;
        let hard = matches!(kind, LightKind::Point | LightKind::Directional { .. } | LightKind::Spot { .. });
        let light_samples = if hard { 1 } else { LIGHT_SAMPLES };
        let centers = tracer.visibility(light, width, height, Sampling::Center { light_samples }, &|_, _| {});
        let ids = tracer.primitives_seen(width, height);
        let (w, h) = (width as usize, height as usize);
        let (visibility, edge) = if hard {
            let area = |i| pixel_area(scene, tracer, light, (width, height), i, ids[i]);
            let near_edge = |i: usize| {
                ids[i].is_some() && neighbors(i, w, h).any(|j| ids[j] == ids[i] && centers[j] != centers[i])
            };
            (0..w * h)
                .into_par_iter()
                .map(|i| match near_edge(i).then(|| area(i)).flatten() {
                    Some(v) => (v, v > 0.0 && v < 1.0),
                    None => (centers[i], false),
                })
                .unzip()
        } else {
            (centers.clone(), centers.iter().map(|v| *v > 0.0 && *v < 1.0).collect())
        };
        Self { visibility, edge, centers, ids, width: w, height: h }
    }

    /// Pixels within `radius` pixels of an edge of the shadow or of an object, as [`edge_band`] counts them.
    pub fn band(&self, radius: usize) -> Vec<bool> {
        edge_band(&self.centers, &self.ids, self.width, self.height, radius)
    }
}

/// The pixel and those around it.
fn neighbors(i: usize, width: usize, height: usize) -> impl Iterator<Item = usize> {
    let (x, y) = (i % width, i / width);
    (y.saturating_sub(1)..(y + 2).min(height))
        .flat_map(move |ny| (x.saturating_sub(1)..(x + 2).min(width)).map(move |nx| ny * width + nx))
}

/// The visibility averaged over the pixel; `None` where it sees something else too, or a crease: there antialiasing is
/// the host's.
fn pixel_area(
    scene: &Scene,
    tracer: &Tracer,
    light: usize,
    (width, height): (u32, u32),
    pixel: usize,
    id: Option<u32>,
) -> Option<f32> {
    let (x, y) = ((pixel % width as usize) as f64, (pixel / width as usize) as f64);
    let mut sum = 0.0;
    let mut first_normal = None;
    for n in 0..GRID * GRID {
        let at = |k: u32| (f64::from(k) + 0.5) / f64::from(GRID);
        let (origin, direction) = scene.camera.ray(x + at(n % GRID), y + at(n / GRID), width, height);
        let surface = tracer.surface(&Ray::new(origin, direction))?;
        if Some(surface.primitive) != id
            || surface.normal.dot(*first_normal.get_or_insert(surface.normal)) <= CREASE
        {
            return None;
        }
        sum += tracer.visibility_at(light, &surface, 1, 0);
    }
    Some((sum / f64::from(GRID * GRID)) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ball of radius 1 at height 1 over a floor seen from straight above, under a light at height 4.
    fn scene(light: &str) -> Scene {
        let text = format!(
            "[camera]\neye = [0, 8, 0]\ntarget = [0, 0, 0]\nup = [0, 0, -1]\nfov_y = 60\n\
             [[light]]\nname = \"key\"\nposition = [0, 4, 0]\nintensity = 1\n{light}\n\
             [[object]]\nname = \"floor\"\nshape = {{ type = \"plane\" }}\ncasts_shadow = false\n\
             [[object]]\nname = \"ball\"\nshape = {{ type = \"sphere\", radius = 1 }}\ntranslation = [0, 1, 0]\n"
        );
        Scene::parse(&text, "scene.toml".as_ref()).expect("the scene is right")
    }

    fn truth(light: &str) -> Truth {
        let scene = scene(light);
        Truth::new(&scene, &Tracer::new(&scene, 0.0), 0, 96, 96)
    }

    /// The shadow is the disc of radius 4 tan(asin(1/3)) = √2: half an edge pixel on average, its area in pixels.
    #[test]
    fn edges_are_areas_of_pixels() {
        let truth = truth("type = \"point\"");
        let metres = 2.0 * 8.0 * (30f64.to_radians()).tan() / 96.0;
        // The ball's lit cap ends at height 4/3, sqrt(8)/3 from the axis: seen at 8 sqrt(8)/20 on the floor.
        let lit = 1.28 * std::f64::consts::PI / (metres * metres);
        let shadow = 2.0 * std::f64::consts::PI / (metres * metres);
        let dark: f64 = truth.visibility.iter().map(|v| 1.0 - f64::from(*v)).sum();
        assert!((dark - (shadow - lit)).abs() < 0.01 * shadow, "{dark} pixels dark, not {}", shadow - lit);
        let edges = truth.edge.iter().filter(|e| **e).count();
        let around = 2.0 * std::f64::consts::PI * 2f64.sqrt() / metres;
        assert!((around..1.5 * around).contains(&(edges as f64)), "{edges} edge pixels round {around}");
        let (near, far) = (truth.band(1), truth.band(2));
        assert!(truth.edge.iter().zip(&near).all(|(edge, near)| !edge || *near), "edges are in the band");
        assert!(near.iter().zip(&far).all(|(near, far)| !near || *far), "bands are nested");
        assert!(far.iter().filter(|f| **f).count() > near.iter().filter(|n| **n).count(), "and grow");
    }

    #[test]
    fn a_penumbra_is_partly_lit() {
        let truth = truth("type = \"sphere\"\nradius = 0.5");
        let partly = truth.visibility.iter().filter(|v| **v > 0.1 && **v < 0.9).count();
        let edges = truth.edge.iter().filter(|e| **e).count();
        assert!(partly > 300 && edges >= partly, "{partly} pixels partly lit, {edges} edges");
        assert!(truth.visibility.contains(&0.0) && truth.visibility.contains(&1.0), "umbra and light");
    }
}
