//! How far a picture of visibilities is off inside the penumbra of an area light.

use antumbra_reference::{Ray, Tracer};
use antumbra_scene::Scene;
use rayon::prelude::*;

/// Pixels looked at along the longer side, at most.
const GRID: u32 = 128;

/// Rays to the light that tell whether a pixel is in the penumbra.
const ROUGH: u32 = 256;

/// Rays to the light from each pixel that is: a standard error of at most 1/128, were they not stratified.
const SAMPLES: u32 = 4096;

/// The visibility of one area light in pixels of its penumbra, as the ray tracer finds it.
#[derive(Clone, Debug, PartialEq)]
pub struct Penumbra {
    /// Index of each pixel, rows from top to bottom, and the visibility of what its centre sees, from 0 to 1.
    pub pixels: Vec<(usize, f32)>,
}

impl Penumbra {
    /// Traces the light of this index in the scene at the tracer's moment, in pixels of a grid 128 across at most.
    /// Empty where the picture is, and for lights without area.
    ///
    /// # Panics
    /// If there is no such light.
    pub fn new(scene: &Scene, tracer: &Tracer, light: usize, width: u32, height: u32) -> Self {
        let step = width.max(height).div_ceil(GRID).max(1) as usize;
        let looked_at = (step / 2..height as usize)
            .step_by(step)
            .flat_map(|y| (step / 2..width as usize).step_by(step).map(move |x| (x, y)));
        let one = |(x, y): (usize, usize)| {
            let (origin, direction) = scene.camera.ray(x as f64 + 0.5, y as f64 + 0.5, width, height);
            let surface = tracer.surface(&Ray::new(origin, direction))?;
            let pixel = y * width as usize + x;
            #[expect(clippy::cast_possible_truncation, reason = "a seed")]
            let seed = pixel as u32;
            let inside = |visibility: f64| visibility > 0.0 && visibility < 1.0;
            if !inside(tracer.visibility_at(light, &surface, ROUGH, seed)) {
                return None;
            }
            Some((pixel, tracer.visibility_at(light, &surface, SAMPLES, seed) as f32))
        };
        Self { pixels: looked_at.collect::<Vec<_>>().into_par_iter().filter_map(one).collect() }
    }

    /// Root mean square error of visibilities, rows from top to bottom; `None` where no pixel is in the penumbra, or
    /// the picture lacks one that is.
    pub fn rmse(&self, visibility: &[f32]) -> Option<f64> {
        let mut sum = 0.0;
        for (pixel, truth) in &self.pixels {
            let difference = f64::from(*visibility.get(*pixel)?) - f64::from(*truth);
            sum += difference * difference;
        }
        (!self.pixels.is_empty()).then(|| (sum / self.pixels.len() as f64).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn penumbra(light: &str, [width, height]: [u32; 2]) -> Penumbra {
        let text = format!(
            "[camera]\neye = [0, 8, 0]\ntarget = [0, 0, 0]\nup = [0, 0, -1]\nfov_y = 60\n\
             [[light]]\nname = \"key\"\nposition = [0, 4, 0]\nintensity = 1\n{light}\n\
             [[object]]\nname = \"floor\"\nshape = {{ type = \"plane\" }}\n\
             [[object]]\nname = \"disc\"\nshape = {{ type = \"disc\", radius = 0.5 }}\ntranslation = [0, 2, 0]\n"
        );
        let scene = Scene::parse(&text, "scene.toml".as_ref()).expect("the scene is right");
        Penumbra::new(&scene, &Tracer::new(&scene, 0.0), 0, width, height)
    }

    /// A ball of radius 1/2, 2 m above a disc as large. The umbra is a cylinder. From the rim the ball is seen under
    /// 2 atan(1/4), whose tangent is 8/15, so the penumbra ends 1/2 + 2 * 8/15 m from the axis.
    #[test]
    fn it_is_the_ring_that_geometry_says() {
        let size = 300;
        let found = penumbra("type = \"sphere\"\nradius = 0.5", [size; 2]);
        let metres = 2.0 * 8.0 * 30f64.to_radians().tan() / f64::from(size);
        let out = |pixel: usize| {
            let at = |k: usize| (k as f64 + 0.5 - f64::from(size) / 2.0) * metres;
            at(pixel % size as usize).hypot(at(pixel / size as usize))
        };
        // What the eye sees of the floor is not behind the disc: 8/6 of its radius. Every third pixel is looked at.
        let end: f64 = 0.5 + 16.0 / 15.0;
        let area = std::f64::consts::PI * (end.powi(2) - (0.5f64 * 8.0 / 6.0).powi(2));
        let expected = area / (3.0 * metres).powi(2);
        let count = found.pixels.len() as f64;
        // 256 rays do not see the last 1/256 of the ball, a fortieth of its diameter, and of the penumbra: 4 % of its area.
        assert!((count - expected).abs() < 0.06 * expected, "{count} pixels, not {expected}");
        assert!(found.pixels.iter().all(|(pixel, _)| out(*pixel) < end), "none is outside");
        assert!(found.pixels.iter().any(|(_, v)| *v < 0.2), "dark within");
        assert!(found.pixels.iter().any(|(_, v)| *v > 0.98), "light without");
    }

    #[test]
    fn the_error_is_that_of_its_pixels_alone() {
        let found = penumbra("type = \"sphere\"\nradius = 0.5", [100; 2]);
        let mut picture = vec![f32::NAN; 100 * 100];
        for (i, (pixel, truth)) in found.pixels.iter().enumerate() {
            picture[*pixel] = truth + if i % 2 == 0 { 0.25 } else { -0.25 };
        }
        let rmse = found.rmse(&picture).expect("there is a penumbra");
        assert!((rmse - 0.25).abs() < 1e-6, "{rmse}");
        assert_eq!(found.rmse(&picture[..50]), None, "too small a picture");
    }

    #[test]
    fn there_may_be_none() {
        assert_eq!(penumbra("type = \"point\"", [40; 2]).pixels, [], "a hard shadow has none");
        let empty = penumbra("type = \"sphere\"\nradius = 0.5", [0; 2]);
        assert_eq!((empty.pixels.len(), empty.rmse(&[])), (0, None), "nor has a picture of no pixels");
    }
}
