//! ꟻLIP: how different two pictures look to someone who flips between them.
//!
//! After Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, "ꟻLIP: A Difference Evaluator for
//! Alternating Images" (2020), for pictures of low dynamic range. Colours are blurred as the eye blurs them at the
//! viewing distance and compared in a space where distances are perceived ones; edges and points that one picture has
//! and the other has not make a difference count more. 0 is equal, 1 as different as green and blue.

use core::f64::consts::PI;

use rayon::prelude::*;

/// Pixels a degree of the viewer's visual field: a screen 0.7 m wide with 3840 pixels across, 0.7 m away, as the
/// paper has it.
pub const PIXELS_PER_DEGREE: f64 = 67.020_643;

/// Exponent on colour differences (q_c, section 4.1).
const COLOR_EXPONENT: f64 = 0.7;
/// Colour differences up to this part of the largest are spread over [0, `SPREAD`] (p_c, p_t).
const BEND: f64 = 0.4;
const SPREAD: f64 = 0.95;
/// Width of the feature detectors, degrees (w, section 4.2): what the eye sees as one line.
const FEATURE_WIDTH: f64 = 0.082;

/// Gaussians a exp(-π² d² / b) sqrt(π / b) that make the contrast sensitivity of a channel (table 1): pairs (a, b).
const SENSITIVITY: [[(f64, f64); 2]; 3] =
    [[(1.0, 0.0047), (0.0, 1e-5)], [(1.0, 0.0053), (0.0, 1e-5)], [(34.1, 0.04), (13.5, 0.025)]];

/// Linear sRGB to CIE XYZ (IEC 61966-2-1, D65).
const TO_XYZ: [[f64; 3]; 3] = [
    [0.412_390_8, 0.357_584_3, 0.180_480_8],
    [0.212_639_0, 0.715_168_7, 0.072_192_3],
    [0.019_330_8, 0.119_194_8, 0.950_532_2],
];

/// CIE XYZ to linear sRGB.
const TO_RGB: [[f64; 3]; 3] = [
    [3.240_969_9, -1.537_383_2, -0.498_610_8],
    [-0.969_243_6, 1.875_967_5, 0.041_555_1],
    [0.055_630_1, -0.203_977_0, 1.056_971_5],
];

/// The difference of each pixel, in [0, 1], rows as in the pictures. The pictures are linear RGB with sRGB primaries;
/// values outside [0, 1] are clamped as a screen does, and what is not a number is black.
///
/// `pixels_per_degree` is of the viewer's visual field, [`PIXELS_PER_DEGREE`] where nothing else is known; at least 1.
///
/// # Panics
/// If `test` or `reference` has not `width * height` pixels.
pub fn flip(
    test: &[[f32; 3]],
    reference: &[[f32; 3]],
    width: usize,
    height: usize,
    pixels_per_degree: f64,
) -> Vec<f32> {
    assert_eq!(Some(reference.len()), width.checked_mul(height), "a pixel for each place");
    assert_eq!(test.len(), reference.len(), "the pictures have the same size");
    if reference.is_empty() {
        return Vec::new();
    }
    let density = if pixels_per_degree >= 1.0 { pixels_per_degree.min(1e3) } else { 1.0 };
    let test = Seen::new(test, width, height, density);
    let reference = Seen::new(reference, width, height, density);
    // As far apart as two colours of a screen are: green and blue.
    let [green, blue] = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|rgb| hunt_lab(multiply(&TO_XYZ, rgb)));
    let largest = distance(green, blue).powf(COLOR_EXPONENT);
    let difference = |i: usize| {
        let color = spread(distance(test.lab[i], reference.lab[i]).powf(COLOR_EXPONENT), largest);
        let edges = (test.edges[i] - reference.edges[i]).abs();
        let points = (test.points[i] - reference.points[i]).abs();
        let feature = (edges.max(points) / 2f64.sqrt()).clamp(0.0, 1.0).sqrt();
        #[expect(clippy::cast_possible_truncation, reason = "a difference has no use for more digits")]
        let difference = color.powf(1.0 - feature) as f32;
        difference
    };
    (0..test.lab.len()).into_par_iter().map(difference).collect()
}

/// The mean of a map of differences; 0 for no pixels.
pub fn mean(map: &[f32]) -> f64 {
    if map.is_empty() { 0.0 } else { map.iter().map(|v| f64::from(*v)).sum::<f64>() / map.len() as f64 }
}

/// A picture as it is seen from the viewing distance.
struct Seen {
    /// Perceived colour, CIELAB with Hunt's adjustment, of each pixel.
    lab: Vec<[f64; 3]>,
    /// Strength of the edge at each pixel.
    edges: Vec<f64>,
    /// Strength of the point or line at each pixel.
    points: Vec<f64>,
}

impl Seen {
    fn new(picture: &[[f32; 3]], width: usize, height: usize, density: f64) -> Self {
        let clamp = |v: f32| if v.is_nan() { 0.0 } else { f64::from(v).clamp(0.0, 1.0) };
        let opponent: Vec<[f64; 3]> =
            picture.iter().map(|rgb| opponent(multiply(&TO_XYZ, rgb.map(clamp)))).collect();
        let size = Size { width, height };
        let [y, rg, by]: [Vec<f64>; 3] =
            core::array::from_fn(|channel| opponent.iter().map(|v| v[channel]).collect());
        let blurred = [blur(&y, 0, size, density), blur(&rg, 1, size, density), blur(&by, 2, size, density)];
        let lab = (0..y.len())
            .into_par_iter()
            .map(|i| {
                let rgb = multiply(&TO_RGB, from_opponent([blurred[0][i], blurred[1][i], blurred[2][i]]));
                hunt_lab(multiply(&TO_XYZ, rgb.map(|v| v.clamp(0.0, 1.0))))
            })
            .collect();
        let lightness: Vec<f64> = y.iter().map(|y| (y + 16.0) / 116.0).collect();
        let (edges, points) = features(&lightness, size, density);
        Self { lab, edges, points }
    }
}

#[derive(Clone, Copy)]
struct Size {
    width: usize,
    height: usize,
}

/// A channel as the eye blurs it: a sum of Gaussians, each separable, of total weight 1.
fn blur(channel: &[f64], which: usize, size: Size, density: f64) -> Vec<f64> {
    // All channels have the reach of the widest Gaussian, three standard deviations (σ² = b / 2π²).
    let widest = SENSITIVITY.iter().flatten().map(|g| g.1).fold(0.0, f64::max);
    let radius = reach(3.0 * (widest / (2.0 * PI * PI)).sqrt() * density);
    let mut sum = vec![0.0; channel.len()];
    let mut weight = 0.0;
    for (a, b) in SENSITIVITY[which] {
        if a == 0.0 {
            continue;
        }
        let at = |d: isize| (-PI * PI * (d as f64 / density).powi(2) / b).exp();
        let kernel: Vec<f64> = (-radius..=radius).map(at).collect();
        let a = a * (PI / b).sqrt();
        weight += a * kernel.iter().sum::<f64>().powi(2);
        let part = convolve(channel, &kernel, &kernel, size);
        sum.iter_mut().zip(part).for_each(|(sum, part)| *sum += a * part);
    }
    sum.iter().map(|v| v / weight).collect()
}

/// Strength of edges and of points: lengths of the first and second derivative of a Gaussian, each scaled so that its
/// positive and its negative part have weight 1.
fn features(lightness: &[f64], size: Size, density: f64) -> (Vec<f64>, Vec<f64>) {
    let deviation = 0.5 * FEATURE_WIDTH * density;
    let radius = reach(3.0 * deviation);
    let gauss = |d: isize| (-(d as f64).powi(2) / (2.0 * deviation * deviation)).exp();
    let across: Vec<f64> = (-radius..=radius).map(gauss).collect();
    let total: f64 = across.iter().sum();
    let across: Vec<f64> = across.iter().map(|v| v / total).collect();
    let first = balanced((-radius..=radius).map(|d| -(d as f64) * gauss(d)).collect());
    let second = balanced(
        (-radius..=radius).map(|d| ((d as f64 / deviation).powi(2) - 1.0) * gauss(d)).collect::<Vec<_>>(),
    );
    let strength = |along: &[f64]| -> Vec<f64> {
        let x = convolve(lightness, along, &across, size);
        let y = convolve(lightness, &across, along, size);
        x.iter().zip(y).map(|(x, y)| x.hypot(y)).collect()
    };
    (strength(&first), strength(&second))
}

/// A kernel whose positive values add up to 1 and whose negative ones to -1.
fn balanced(kernel: Vec<f64>) -> Vec<f64> {
    let positive: f64 = kernel.iter().filter(|v| **v > 0.0).sum();
    let negative: f64 = -kernel.iter().filter(|v| **v < 0.0).sum::<f64>();
    // Below two pixels a degree a detector may have one sign alone, and then detects nothing.
    let scale = |v: f64, by: f64| if by > 0.0 { v / by } else { 0.0 };
    kernel.into_iter().map(|v| scale(v, if v > 0.0 { positive } else { negative })).collect()
}

#[expect(clippy::cast_possible_truncation, reason = "a few hundred at most: the density is clamped")]
fn reach(pixels: f64) -> isize {
    pixels.ceil() as isize
}

/// Convolution with `across` along rows and `down` along columns, the border pixels repeated outwards.
fn convolve(channel: &[f64], across: &[f64], down: &[f64], size: Size) -> Vec<f64> {
    let Size { width, height } = size;
    let radius = across.len() / 2;
    let mut rows = vec![0.0; channel.len()];
    channel.par_chunks_exact(width).zip(rows.par_chunks_exact_mut(width)).for_each(|(row, out)| {
        let at = |i: usize| row[i.saturating_sub(radius).min(width - 1)];
        let padded: Vec<f64> = (0..width + 2 * radius).map(at).collect();
        for (x, out) in out.iter_mut().enumerate() {
            *out = padded[x..].iter().zip(across).map(|(v, k)| v * k).sum();
        }
    });
    let mut result = vec![0.0; channel.len()];
    result.par_chunks_exact_mut(width).enumerate().for_each(|(y, out)| {
        for (i, k) in down.iter().enumerate() {
            let from = (y + i).saturating_sub(radius).min(height - 1) * width;
            out.iter_mut().zip(&rows[from..from + width]).for_each(|(out, v)| *out += v * k);
        }
    });
    result
}

fn multiply(matrix: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// The XYZ of white.
fn white() -> [f64; 3] {
    multiply(&TO_XYZ, [1.0; 3])
}

/// XYZ to the linear opponent space YyCxCz: black and white, red and green, blue and yellow.
fn opponent(xyz: [f64; 3]) -> [f64; 3] {
    let white = white();
    let [x, y, z] = core::array::from_fn(|i| xyz[i] / white[i]);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn from_opponent([luma, rg, by]: [f64; 3]) -> [f64; 3] {
    let y = (luma + 16.0) / 116.0;
    let white = white();
    [(y + rg / 500.0) * white[0], y * white[1], (y - by / 200.0) * white[2]]
}

/// XYZ to CIELAB, with the chroma of dark colours lowered as the eye sees them (Hunt).
fn hunt_lab(xyz: [f64; 3]) -> [f64; 3] {
    const DELTA: f64 = 6.0 / 29.0;
    let curve = |v: f64| {
        if v > DELTA.powi(3) { v.cbrt() } else { v / (3.0 * DELTA * DELTA) + 4.0 / 29.0 }
    };
    let white = white();
    let [x, y, z] = core::array::from_fn(|i| curve(xyz[i] / white[i]));
    let lightness = 116.0 * y - 16.0;
    [lightness, 0.01 * lightness * 500.0 * (x - y), 0.01 * lightness * 200.0 * (y - z)]
}

/// HyAB: city-block in lightness, Euclidean in colour; true to the eye for large differences.
fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).abs() + (a[1] - b[1]).hypot(a[2] - b[2])
}

/// Small differences over most of [0, 1], large ones over the rest, since all large ones look large.
fn spread(difference: f64, largest: f64) -> f64 {
    let bend = BEND * largest;
    if difference < bend {
        difference * SPREAD / bend
    } else {
        (SPREAD + (difference - bend) / (largest - bend) * (1.0 - SPREAD)).min(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: usize = 48;
    const HEIGHT: usize = 32;

    /// A picture from sRGB levels.
    fn picture(level: impl Fn(i32, i32) -> [i32; 3]) -> Vec<[f32; 3]> {
        let linear = |level: i32| {
            let v = f64::from(level) / 255.0;
            (if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }) as f32
        };
        (0..HEIGHT as i32)
            .flat_map(|y| (0..WIDTH as i32).map(move |x| (x, y)))
            .map(|(x, y)| level(x, y).map(linear))
            .collect()
    }

    fn edge(x: i32, y: i32, at: i32) -> [i32; 3] {
        if x + 2 * y < at { [200, 180, 150] } else { [60, 60, 90] }
    }

    fn waves(x: i32, y: i32, k: i32) -> [i32; 3] {
        [(x * 7 + y * 3) % 256, (x * x + k * y) % 256, (x * y + 31 * k) % 256]
    }

    /// Against the authors' own program, `flip-evaluator` 1.7: `evaluate(reference, test, "LDR")` on these pictures,
    /// for two viewing distances: the mean, and the pixel at column 20, row 15. 1e-4 is more than its float32 and its
    /// rounded colour matrices leave (3e-5 here).
    #[test]
    fn the_values_of_the_reference_implementation() {
        type Level = fn(i32, i32) -> [i32; 3];
        type Case = (&'static str, Level, Level, [(f64, f64); 2]);
        let cases: [Case; 7] = [
            ("equal", |x, y| edge(x, y, 60), |x, y| edge(x, y, 60), [(0.0, 0.0), (0.0, 0.0)]),
            (
                "shifted",
                |x, y| edge(x, y, 60),
                |x, y| edge(x, y, 66),
                [(0.191_428, 0.139_973), (0.129_239, 0.0)],
            ),
            (
                "point",
                |_, _| [128; 3],
                |x, y| if (x, y) == (20, 15) { [255; 3] } else { [128; 3] },
                [(0.002_800, 0.378_678), (0.001_060, 0.934_022)],
            ),
            ("opposite", |_, _| [0, 255, 0], |_, _| [0, 0, 255], [(1.0, 1.0), (1.0, 1.0)]),
            ("black", |_, _| [0; 3], |_, _| [255; 3], [(0.967_399, 0.967_388), (0.967_399, 0.967_391)]),
            (
                "waves",
                |x, y| waves(x, y, 1),
                |x, y| waves(x, y, 3),
                [(0.510_550, 0.393_243), (0.678_361, 0.640_139)],
            ),
            (
                "tint",
                |x, y| edge(x, y, 60),
                |x, y| edge(x, y, 60).map(|v| v - 9),
                [(0.169_303, 0.172_074), (0.161_289, 0.145_984)],
            ),
        ];
        for (name, reference, test, expected) in cases {
            let (reference, test) = (picture(reference), picture(test));
            for (density, (expected_mean, expected_pixel)) in
                [PIXELS_PER_DEGREE, 20.0].into_iter().zip(expected)
            {
                let map = flip(&test, &reference, WIDTH, HEIGHT, density);
                let (mean, pixel) = (mean(&map), f64::from(map[15 * WIDTH + 20]));
                eprintln!(
                    "{name} {density}: mean {mean:.6} ({expected_mean}), pixel {pixel:.6} ({expected_pixel})"
                );
                assert!(
                    (mean - expected_mean).abs() < 1e-4,
                    "{name} at {density}: mean {mean}, not {expected_mean}"
                );
                assert!(
                    (pixel - expected_pixel).abs() < 1e-4,
                    "{name} at {density}: {pixel}, not {expected_pixel}"
                );
            }
        }
    }

    #[test]
    fn any_picture_has_a_difference_in_zero_to_one() {
        let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, 0.0, 0.5, 1.0, 7.0];
        let mut random = fastrand::Rng::with_seed(5);
        for density in [f64::NAN, -1.0, 0.0, 1.0, 3.0, 67.0, f64::INFINITY] {
            for (width, height) in [(1, 1), (1, 5), (7, 1), (6, 4)] {
                let mut any = || -> Vec<[f32; 3]> {
                    (0..width * height).map(|_| [0; 3].map(|_| odd[random.usize(0..8)])).collect()
                };
                let map = flip(&any(), &any(), width, height, density);
                assert_eq!(map.len(), width * height, "a value for each pixel");
                assert!(
                    map.iter().all(|v| (0.0..=1.0).contains(v)),
                    "{width}x{height} at {density}: {map:?}"
                );
            }
        }
        assert!(flip(&[], &[], 0, 3, 67.0).is_empty(), "no pixels");
        assert_eq!(mean(&[]), 0.0, "no pixels");
    }

    #[test]
    #[should_panic(expected = "the pictures have the same size")]
    fn another_size_is_a_mistake() {
        flip(&[[0.0; 3]], &[[0.0; 3], [0.0; 3]], 2, 1, 67.0);
    }
}
