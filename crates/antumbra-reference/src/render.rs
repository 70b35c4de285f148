//! Pictures: radiance, visibility of each light, and which primitive each pixel sees. Rows run in parallel; every
//! pixel depends on its own place alone, so the result is the same on any number of threads.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::{
    ray::Ray,
    sampling::{Pattern, hash},
    tracer::{Surface, Tracer},
};

/// Where in a pixel visibility is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// At the surface point seen through the pixel's centre.
    Center {
        /// Points of an area light; 0 counts as 1. Hard lights need only one.
        light_samples: u32,
    },
    /// The mean over a regular grid of points of the pixel, of those that see the primitive its centre sees.
    Area {
        /// Points along each side of the pixel; 0 counts as 1.
        grid: u32,
        /// Points of an area light for each; 0 counts as 1.
        light_samples: u32,
    },
}

/// Told after each row: rows done, rows in all. Called from any thread; the last call has both equal, but calls
/// may overtake each other.
pub type Progress<'a> = &'a (dyn Fn(u64, u64) + Sync);

/// Keeps the patterns of pixels, of lights in a picture and of lights in a visibility picture apart.
const PIXEL: u32 = 1;
const LIGHT: u32 = 2;
const VISIBILITY: u32 = 3;

impl Tracer {
    /// Linear radiance, rows top to bottom, without exposure; the background where nothing is seen.
    ///
    /// Each of `samples` rays (0 counts as 1) goes through its own stratum of the pixel and takes its own stratum of
    /// every area light. A single ray goes through the pixel's centre. Empty if either side is zero.
    pub fn render(&self, width: u32, height: u32, samples: u32, progress: Progress<'_>) -> Vec<[f32; 3]> {
        let samples = samples.max(1);
        rows(width, height, [0.0; 3], progress, |x, y| {
            let mut sum = DVec3::ZERO;
            for index in 0..samples {
                let offset = if samples == 1 { DVec2::splat(0.5) } else { stratum(x, y, index) };
                sum += self.sample(x, y, offset, width, height, index);
            }
            (sum / f64::from(samples)).as_vec3().to_array()
        })
    }

    /// Adds ray number `sample` of every pixel to `sums`, linear radiance, rows top to bottom: a picture made step by
    /// step. After the rays 0 to N - 1, N above 1, `sums` over N is [`render`](Self::render) with N samples, to
    /// rounding; any N is a whole picture, and the best ones are powers of two.
    ///
    /// `keep_going` is asked before each row, from any thread. Once it says no the remaining rows are left as they
    /// were, and the answer is false: each row has got the ray or not, and nothing tells which. An empty picture is
    /// complete at once.
    ///
    /// # Panics
    /// If `sums` has not `width` times `height` elements.
    pub fn accumulate(
        &self,
        width: u32,
        height: u32,
        sample: u32,
        sums: &mut [DVec3],
        keep_going: &(dyn Fn() -> bool + Sync),
    ) -> bool {
        assert_eq!(
            sums.len(),
            width as usize * height as usize,
            "a sum for each of {width} by {height} pixels"
        );
        if sums.is_empty() {
            return true;
        }
        let stopped = AtomicBool::new(false);
        sums.par_chunks_mut(width as usize).zip(0..height).for_each(|(row, y)| {
            if stopped.load(Ordering::Relaxed) {
                return;
            }
            if !keep_going() {
                stopped.store(true, Ordering::Relaxed);
                return;
            }
            for (x, sum) in (0..width).zip(row) {
                *sum += self.sample(x, y, stratum(x, y, sample), width, height, sample);
            }
        });
        !stopped.into_inner()
    }

    /// The visibility of one light, rows top to bottom: 1 lit, 0 in full shadow or facing away, and 1 where the pixel's
    /// centre sees the background. Empty if either side is zero.
    ///
    /// # Panics
    /// If there is no such light.
    pub fn visibility(
        &self,
        light: usize,
        width: u32,
        height: u32,
        sampling: Sampling,
        progress: Progress<'_>,
    ) -> Vec<f32> {
        assert!(light < self.lights().len(), "light {light} of {}", self.lights().len());
        let (grid, light_samples) = match sampling {
            Sampling::Center { light_samples } => (1, light_samples),
            Sampling::Area { grid, light_samples } => (grid.max(1), light_samples),
        };
        rows(width, height, 1.0, progress, |x, y| {
            let Some(center) = self.seen(x, y, DVec2::splat(0.5), width, height) else { return 1.0 };
            let at = |surface: &Surface, column: u32, row: u32| {
                let seed = hash([VISIBILITY, x, y, light as u32, column, row]);
                self.visibility_at(light, surface, light_samples, seed)
            };
            if grid == 1 {
                return at(&center, 0, 0) as f32;
            }
            let (mut sum, mut count) = (0.0, 0u64);
            for row in 0..grid {
                for column in 0..grid {
                    let offset = (DVec2::new(f64::from(column), f64::from(row)) + 0.5) / f64::from(grid);
                    if let Some(surface) = self.seen(x, y, offset, width, height)
                        && surface.primitive == center.primitive
                    {
                        sum += at(&surface, column, row);
                        count += 1;
                    }
                }
            }
            // An even grid misses the centre, and so may miss a primitive that only the centre sees.
            (if count > 0 { sum / count as f64 } else { at(&center, 0, 0) }) as f32
        })
    }

    /// The primitive seen through each pixel's centre, an index into `Moment::primitives`, rows top to bottom.
    pub fn primitives_seen(&self, width: u32, height: u32) -> Vec<Option<u32>> {
        rows(width, height, None, &|_, _| {}, |x, y| {
            self.seen(x, y, DVec2::splat(0.5), width, height).map(|surface| surface.primitive)
        })
    }

    /// Radiance along one ray through a pixel, with stratum number `index` of every area light.
    fn sample(&self, x: u32, y: u32, offset: DVec2, width: u32, height: u32, index: u32) -> DVec3 {
        match self.seen(x, y, offset, width, height) {
            Some(surface) => {
                self.radiance(&surface, |light| Pattern::new(hash([LIGHT, x, y, light])).point(index))
            }
            None => self.background,
        }
    }

    /// What is seen through a point of a pixel, `offset` counted from its top left corner.
    fn seen(&self, x: u32, y: u32, offset: DVec2, width: u32, height: u32) -> Option<Surface> {
        let at = DVec2::new(f64::from(x), f64::from(y)) + offset;
        let (origin, direction) = self.camera.ray(at.x, at.y, width, height);
        self.surface(&Ray::new(origin, direction))
    }
}

/// Where in its pixel ray number `index` goes.
fn stratum(x: u32, y: u32, index: u32) -> DVec2 {
    Pattern::new(hash([PIXEL, x, y])).point(index)
}

/// Fills a picture row by row, in parallel.
fn rows<T: Copy + Send + Sync>(
    width: u32,
    height: u32,
    empty: T,
    progress: Progress<'_>,
    pixel: impl Fn(u32, u32) -> T + Sync,
) -> Vec<T> {
    let mut picture = vec![empty; width as usize * height as usize];
    if picture.is_empty() {
        return picture;
    }
    let done = AtomicU64::new(0);
    picture.par_chunks_mut(width as usize).zip(0..height).for_each(|(row, y)| {
        for (x, value) in (0..width).zip(row) {
            *value = pixel(x, y);
        }
        progress(done.fetch_add(1, Ordering::Relaxed) + 1, u64::from(height));
    });
    picture
}
