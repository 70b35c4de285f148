//! Stratified samples that depend only on what they are for: pixel, light and number, never on threads or order.

use std::f64::consts::{FRAC_PI_4, TAU};

use glam::DVec2;

/// Mixes words into one well-scattered word: each step is a bijection of 32 bits with good avalanche
/// (the constants are those of lowbias32, C. Wellons, Prospecting for Hash Functions, 2018).
pub(crate) fn hash<const N: usize>(words: [u32; N]) -> u32 {
    words.iter().fold(0x9e37_79b9, |state, &word| scramble(state ^ scramble(word.wrapping_add(0x7f4a_7c15))))
}

fn scramble(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// A sequence of points of the unit square, each part of it as even as can be.
///
/// Owen-scrambled, shuffled Sobol points (B. Burley, Practical Hash-based Owen Scrambling, JCGT 9(4), 2020). Every
/// aligned run of 2^k points has one in each of the 2^k boxes of any shape 2^-i by 2^(i-k). Each point is computed on
/// its own, nothing is stored. Patterns of different seeds are unrelated, point by point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pattern {
    order: u32,
    x: u32,
    y: u32,
}

impl Pattern {
    pub(crate) fn new(seed: u32) -> Self {
        Self { order: hash([seed, 1]), x: hash([seed, 2]), y: hash([seed, 3]) }
    }

    /// Point number `index`.
    pub(crate) fn point(&self, index: u32) -> DVec2 {
        // Shuffled, or the same index of two patterns would fall in the same stratum of both.
        let index = owen_scrambled(index, self.order);
        let unit = |word: u32| f64::from(word) / 4_294_967_296.0;
        // The first dimension of Sobol's sequence is the index with its bits reversed.
        DVec2::new(
            unit(owen_scrambled(index.reverse_bits(), self.x)),
            unit(owen_scrambled(sobol_second(index), self.y)),
        )
    }
}

/// The second dimension of Sobol's sequence, whose generator matrix is Pascal's triangle modulo 2.
fn sobol_second(mut index: u32) -> u32 {
    let mut column = 1u32 << 31;
    let mut result = 0;
    while index != 0 {
        if index & 1 != 0 {
            result ^= column;
        }
        index >>= 1;
        column ^= column >> 1;
    }
    result
}

/// Flips each bit depending on the bits above it: a random tree over the unit interval keeps strata whole.
fn owen_scrambled(word: u32, seed: u32) -> u32 {
    // The hash lets each bit depend on those below it only (S. Laine and T. Karras, Stratified Sampling for
    // Stochastic Transparency, 2011, with Burley's constants).
    let mut x = word.reverse_bits();
    x = x.wrapping_add(seed);
    x ^= x.wrapping_mul(0x6c50_b47c);
    x ^= x.wrapping_mul(0xb82f_1e52);
    x ^= x.wrapping_mul(0xc7af_e638);
    x ^= x.wrapping_mul(0x8d22_f6e6);
    x.reverse_bits()
}

/// The unit square onto the unit disc, area to area, strata staying compact (P. Shirley and K. Chiu, A Low
/// Distortion Map Between Disk and Square, 1997). Returned as radius and angle.
pub(crate) fn disc(u: DVec2) -> (f64, f64) {
    let v = 2.0 * u - 1.0;
    if v == DVec2::ZERO {
        return (0.0, 0.0);
    }
    if v.x.abs() > v.y.abs() {
        (v.x, FRAC_PI_4 * (v.y / v.x))
    } else {
        (v.y, TAU / 4.0 - FRAC_PI_4 * (v.x / v.y))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sixty-four points have one in each box of every shape of area 1/64, in any aligned run.
    #[test]
    fn points_are_stratified() {
        for seed in 0..50 {
            let pattern = Pattern::new(seed);
            for run in [0, 64, 64 * 1001] {
                let points: Vec<DVec2> = (run..run + 64).map(|i| pattern.point(i)).collect();
                for level in 0..=6 {
                    let (columns, rows) = (1u32 << level, 1u32 << (6 - level));
                    let mut cells = [0; 64];
                    for p in &points {
                        assert!(p.cmpge(DVec2::ZERO).all() && p.cmplt(DVec2::ONE).all(), "{p} is outside");
                        let cell = *p * DVec2::new(f64::from(columns), f64::from(rows));
                        cells[(cell.y as u32 * columns + cell.x as u32) as usize] += 1;
                    }
                    assert!(cells.iter().all(|&n| n == 1), "seed {seed}, {columns} by {rows}: {cells:?}");
                }
            }
        }
    }

    /// The integral of x²y over the square, 1/6: the error falls faster than 1/n, the independent points' 1/√n.
    #[test]
    fn points_integrate() {
        let worst = |count: u32| {
            (0..50)
                .map(|seed| {
                    let pattern = Pattern::new(seed);
                    let sum: f64 = (0..count).map(|i| pattern.point(i)).map(|p| p.x * p.x * p.y).sum();
                    (sum / f64::from(count) - 1.0 / 6.0).abs()
                })
                .fold(0.0, f64::max)
        };
        let (coarse, fine) = (worst(64), worst(1024));
        assert!(coarse < 0.005 && fine < coarse / 16.0, "errors {coarse} and {fine}");
    }

    /// Two patterns are independent: the mean of the product of their deviations vanishes.
    #[test]
    fn patterns_are_unrelated() {
        let mut sum = 0.0;
        for seed in 0..1000 {
            let (a, b) = (Pattern::new(hash([seed, 0])), Pattern::new(hash([seed, 1])));
            sum += (0..16).map(|i| (a.point(i).x - 0.5) * (b.point(i).x - 0.5)).sum::<f64>();
        }
        // 16000 products of variance 1/144 each: standard deviation 6.6e-4 of the mean.
        assert!((sum / 16_000.0).abs() < 3e-3, "correlation {}", sum / 16_000.0);
    }

    #[test]
    fn the_disc_is_covered_evenly() {
        let pattern = Pattern::new(3);
        let inside = (0..10_000).filter(|&i| disc(pattern.point(i)).0.abs() < 0.5).count();
        // A quarter of the area; strata across the circle r = 1/2 leave an error of about 30 points.
        assert!((2400..=2600).contains(&inside), "{inside} of 10000 within half the radius");
    }
}
