//! What each light does at each pixel, and how pictures are held against it.

use crate::shot::Shot;
use crate::world::{World, ray};
use antumbra_gl::{Area, Camera};
use antumbra_reference::Surface;
use glam::Vec3;

/// By how much antialiasing may be off where a shadow is narrower than a pixel, or its tip ends: it
/// knows one edge exactly and two by their angle. A ball's or a disc's other side it does not know:
/// a thread of shadow through the pixel's centre counts as half of it.
const SLIVER: f32 = 0.5;

/// The fraction of pixels in which, for each light, shadows meet, each with an edge in the pixel: of their visibilities
/// the smaller one is taken, and a little light is left along the seam.
pub(crate) const SEAMS: f64 = 1e-3;

/// Points a side of the grid that measures such a pixel.
const GRID: i32 = 16;

/// Root mean square error of antialiased edges. It is .002 to .01 where each pixel is cut once; the rest is pixels that are
/// cut more often, of which small pictures have many.
const EDGES: f64 = 0.045;

/// What each light does at each pixel.
pub(crate) struct Truth<'w> {
    world: &'w World,
    camera: Camera,
    viewport: [i32; 4],
    seen: Vec<Option<Surface>>,
    /// The side of what a pixel stands for, in pixels: less for one of several samples.
    pub(crate) footprint: f64,
    /// For each light and pixel: visibility, and irradiance without occluders.
    pub(crate) lights: Vec<Vec<(f32, Vec3)>>,
    /// Pixels without an edge of anything in or next to them, as far as centres tell: there a
    /// picture must be right.
    pub(crate) sure: Vec<bool>,
}

impl<'w> Truth<'w> {
    pub(crate) fn new(world: &'w World, shot: &Shot<'_>) -> Self {
        let (seen, width) = (&shot.seen, shot.viewport[2]);
        let seen_by = |light: usize| {
            // Of a light with an area one sample is a guess.
            assert_eq!(world.lights[light].area, Area::None, "the truth is of hard lights");
            let color = world.tracer.lights()[light].color;
            seen.iter().map(move |surface| {
                surface.as_ref().map_or((1.0, Vec3::ZERO), |s| {
                    let e = color * world.tracer.unoccluded_irradiance(light, s, 1, 0);
                    (world.visibility(light, s), e.as_vec3())
                })
            })
        };
        let lights: Vec<Vec<(f32, Vec3)>> =
            (0..world.lights.len()).map(|light| seen_by(light).collect()).collect();
        let width = width as usize;
        let same = |i: usize, j: usize| {
            seen[i].map(|s| s.primitive) == seen[j].map(|s| s.primitive)
                && lights.iter().all(|l| l[i].0 == l[j].0 && (l[i].1 == Vec3::ZERO) == (l[j].1 == Vec3::ZERO))
        };
        let height = seen.len() / width;
        let sure = (0..seen.len())
            .map(|i| {
                let (x, y) = (i % width, i / width);
                let inside = x > 0 && y > 0 && x + 1 < width && y + 1 < height;
                inside
                    && [-1isize, 0, 1].iter().all(|dy| {
                        let row = i.wrapping_add_signed(dy * width as isize);
                        [row - 1, row, row + 1].iter().all(|&j| same(i, j))
                    })
            })
            .collect();
        Self {
            world,
            camera: shot.camera,
            viewport: shot.viewport,
            footprint: 1.0,
            seen: seen.clone(),
            lights,
            sure,
        }
    }

    /// (Σ V E + ambient) / (Σ E + ambient), with the visibilities given.
    fn ratio_with(&self, pixel: usize, visibility: impl Fn(usize) -> f32) -> Vec3 {
        let (mut arrives, mut all) = (self.world.ambient, self.world.ambient);
        for (i, light) in self.lights.iter().enumerate() {
            let e = light[pixel].1;
            arrives += e * visibility(i);
            all += e;
        }
        Vec3::select(all.cmpgt(Vec3::ZERO), (arrives / all.max(Vec3::splat(1e-30))).min(Vec3::ONE), Vec3::ONE)
    }

    /// (Σ V E + ambient) / (Σ E + ambient).
    pub(crate) fn ratio(&self, pixel: usize) -> Vec3 {
        self.ratio_with(pixel, |light| self.lights[light][pixel].0)
    }

    /// A light's visibility over a pixel's area, of the primitive seen through its centre.
    fn area(&self, light: usize, pixel: usize) -> f32 {
        let [_, _, width, height] = self.viewport;
        let (x, y) = (pixel as i32 % width, pixel as i32 / width);
        let at = |p: i32, k: i32, size: i32| {
            let off_middle = (f64::from(k) + 0.5) / f64::from(GRID) - 0.5;
            (f64::from(p) + 0.5 + off_middle * self.footprint) / f64::from(size)
        };
        let of = |k: i32| {
            let at = [at(x, k % GRID, width), at(y, k / GRID, height)];
            self.world.tracer.surface(&ray(&self.camera, at))
        };
        let same = |s: &Surface| self.seen[pixel].is_some_and(|seen| seen.primitive == s.primitive);
        let points: Vec<_> = (0..GRID * GRID).filter_map(of).filter(same).collect();
        points.iter().map(|s| self.world.visibility(light, s)).sum::<f32>() / points.len() as f32
    }

    /// Whether a pixel that is sure holds a piece of shadow or light narrower than itself.
    pub(crate) fn is_sliver(&self, light: usize, pixel: usize) -> bool {
        self.area(light, pixel) != self.lights[light][pixel].0
    }

    /// Asserts that a picture that was white is now the ratio, in linear light, wherever that is
    /// sure: within `tolerance` (a step of 8 bits is 0.004) but for [`SEAMS`], and everywhere
    /// within [`SLIVER`] of what it is over the pixel's area.
    pub(crate) fn assert_overlay(&self, picture: &[[u8; 4]], tolerance: f32) {
        assert_eq!(picture.len(), self.sure.len(), "a pixel each");
        let mut count = Count::default();
        for i in (0..picture.len()).filter(|&i| self.sure[i]) {
            let expected = self.ratio(i);
            let [r, g, b, _] = picture[i].map(|c| f32::from(c) / 255.0);
            let off = |from: Vec3| (Vec3::new(r, g, b) - from).abs().max_element();
            let close = off(expected) <= tolerance;
            let area = || {
                let areas: Vec<f32> = (0..self.lights.len()).map(|light| self.area(light, i)).collect();
                let area = self.ratio_with(i, |light| areas[light]);
                (area != expected, off(area))
            };
            count.add(i, close, expected.min_element() < 0.9, area);
        }
        count.assert_right("the overlay", self.lights.len());
        assert!(count.dark > 100 && count.light > 100, "there are shadows and light to look at: {count:?}");
    }

    /// Asserts that a light's mask, of a technique without antialiasing, is on the right side of one half wherever
    /// that is sure and the light would arrive. Returns how many pixels those are.
    pub(crate) fn assert_classified(&self, light: usize, mask: &[u8], what: &str) -> usize {
        assert_eq!(mask.len(), self.sure.len(), "a pixel each");
        let counts = |i: &usize| self.sure[*i] && self.lights[light][*i].1 != Vec3::ZERO;
        let wrong: Vec<usize> = (0..mask.len())
            .filter(counts)
            .filter(|&i| (mask[i] >= 128) != (self.lights[light][i].0 >= 0.5))
            .collect();
        let judged = (0..mask.len()).filter(counts).count();
        assert!(
            wrong.is_empty(),
            "{what}, light {light}: {} pixels are wrong: {:?}",
            wrong.len(),
            &wrong[..wrong.len().min(99)]
        );
        judged
    }

    /// Asserts that a light's mask is its visibility, 0 or 255, wherever that is sure and the
    /// light would arrive at all, but for [`SEAMS`], and everywhere within [`SLIVER`] of what it is
    /// over the pixel's area.
    pub(crate) fn assert_mask(&self, light: usize, mask: &[u8]) {
        self.assert_mask_where_sure(light, mask);
        self.assert_edges(light, mask);
    }

    /// The same but for edges, of which a pixel has too many where occluders are dust.
    pub(crate) fn assert_mask_where_sure(&self, light: usize, mask: &[u8]) {
        assert_eq!(mask.len(), self.sure.len(), "a pixel each");
        let mut count = Count::default();
        for i in (0..mask.len()).filter(|&i| self.sure[i] && self.lights[light][i].1 != Vec3::ZERO) {
            let (m, v) = (f32::from(mask[i]) / 255.0, self.lights[light][i].0);
            let area = || (self.area(light, i) != v, (self.area(light, i) - m).abs());
            // The grid finds a 256th of a pixel, and so do 8 bits.
            count.add(i, (m - v).abs() < 1.5 / 255.0, v < 0.5, area);
        }
        assert!(
            (count.dark + count.light) * 20 > mask.len(),
            "light {light}: few pixels are judged: {count:?}"
        );
        count.assert_right(&format!("light {light}"), 1);
    }

    /// Asserts that where a shadow's edge, and no other, crosses the pixels the mask is the visibility over the pixel's
    /// area: within [`SLIVER`], and [`EDGES`] in the mean.
    fn assert_edges(&self, light: usize, mask: &[u8]) {
        let lights = &self.lights[light];
        let width = self.viewport[2] as usize;
        let is_edge = |i: &usize| {
            let near = |j: usize| {
                self.seen.get(j).is_some_and(|s| s.map(|s| s.primitive) == self.seen[*i].map(|s| s.primitive))
                    && lights[j].1 != Vec3::ZERO
            };
            let around = [-1isize, 0, 1]
                .iter()
                .flat_map(|dy| [-1isize, 0, 1].map(|dx| i.wrapping_add_signed(dy * width as isize + dx)));
            let around: Vec<usize> = around.collect();
            let inside = (1..width - 1).contains(&(*i % width));
            inside
                && self.seen[*i].is_some()
                && around.iter().all(|&j| near(j))
                && around.iter().any(|&j| lights[j].0 != lights[*i].0)
        };
        // One in three: each takes a hundred rays.
        let edges: Vec<usize> = (0..mask.len()).filter(is_edge).step_by(3).collect();
        let off: Vec<f32> = edges.iter().map(|&i| f32::from(mask[i]) / 255.0 - self.area(light, i)).collect();
        let squares: f64 = off.iter().map(|off| f64::from(*off).powi(2)).sum();
        let rms = (squares / edges.len().max(1) as f64).sqrt();
        let far: Vec<_> = edges.iter().zip(&off).filter(|(_, off)| !(off.abs() <= SLIVER)).collect();
        eprintln!("light {light}: {} pixels of edges, rms {rms:.4}", edges.len());
        assert!(far.is_empty(), "light {light}: edges are wrong: {far:?}");
        assert!(rms <= EDGES, "light {light}: rms {rms} over {} pixels of edges", edges.len());
    }
}

/// How many pixels are how.
#[derive(Debug, Default)]
struct Count {
    light: usize,
    dark: usize,
    seams: usize,
    wrong: Vec<(usize, f32)>,
}

impl Count {
    /// `area`: whether the pixel holds a sliver, and how far off its area the renderer is.
    fn add(&mut self, pixel: usize, close: bool, dark: bool, area: impl Fn() -> (bool, f32)) {
        *if dark { &mut self.dark } else { &mut self.light } += 1;
        if close {
            return;
        }
        let (sliver, off) = area();
        if off > SLIVER {
            self.wrong.push((pixel, off));
        } else if !sliver {
            self.seams += 1;
        }
    }

    fn assert_right(&self, what: &str, lights: usize) {
        assert!(self.wrong.is_empty(), "{what}: {} pixels are wrong: {self:?}", self.wrong.len());
        let allowed = ((self.dark + self.light) as f64 * SEAMS * lights as f64) as usize;
        assert!(self.seams <= allowed, "{what}: too many pixels are not quite right: {self:?}");
    }
}
