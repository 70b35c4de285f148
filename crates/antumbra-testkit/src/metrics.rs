//! How far a visibility image is from the reference: misclassified pixels away from the edges, and
//! root-mean-square and largest errors over a mask.
//!
//! Images are rows from top to bottom of visibilities in [0, 1], 1 = lit. All images of one call have
//! the same length; another length is a mistake in the test and panics.

/// A visibility this near to 0 or 1 is not partial: it is what float32 makes of rays' fractions.
const WHOLE: f32 = 1e-6;

/// The pixels that are within `radius` of an edge, where `radius` counts pixels in the larger of the
/// two directions (Chebyshev).
///
/// An edge runs *through* a pixel whose reference visibility is partial (or not a number): that pixel
/// is at distance 0. An edge runs *between* two of eight neighbours if visibility crosses 1/2 from one
/// to the other or they see different objects (`ids`, `None` for the background): both are at
/// distance 1. So a radius of 1 is the band of one pixel on either side of the edge, and a radius of
/// 0 is the partial pixels alone.
///
/// # Panics
/// If `reference` or `ids` has not `width * height` entries.
pub fn edge_band(
    reference: &[f32],
    ids: &[Option<u32>],
    width: usize,
    height: usize,
    radius: usize,
) -> Vec<bool> {
    assert_eq!(Some(reference.len()), width.checked_mul(height), "a visibility for each pixel");
    assert_eq!(ids.len(), reference.len(), "an object for each pixel");
    const FAR: usize = usize::MAX - 1;
    let mut distance = vec![FAR; reference.len()];
    for y in 0..height {
        for x in 0..width {
            let here = y * width + x;
            let whole = reference[here] <= WHOLE || reference[here] >= 1.0 - WHOLE;
            if !whole {
                distance[here] = 0;
            }
            // The half of the neighbours that come later; the others have looked at this pixel.
            for (dx, dy) in [(1, 0), (-1, 1), (0, 1), (1, 1)] {
                let Some(there) = neighbor(x, y, dx, dy, width, height) else { continue };
                let lit = |i: usize| reference[i] > 0.5;
                if lit(here) != lit(there) || ids[here] != ids[there] {
                    distance[here] = distance[here].min(1);
                    distance[there] = distance[there].min(1);
                }
            }
        }
    }
    // Two sweeps spread the Chebyshev distance exactly: every shortest way is a monotone part each.
    for y in 0..height {
        for x in 0..width {
            relax(&mut distance, x, y, &[(-1, 0), (-1, -1), (0, -1), (1, -1)], width, height);
        }
    }
    for y in (0..height).rev() {
        for x in (0..width).rev() {
            relax(&mut distance, x, y, &[(1, 0), (1, 1), (0, 1), (-1, 1)], width, height);
        }
    }
    distance.into_iter().map(|d| d <= radius).collect()
}

/// One step of the distance sweep at (x, y).
fn relax(distance: &mut [usize], x: usize, y: usize, from: &[(isize, isize)], width: usize, height: usize) {
    let here = y * width + x;
    for (dx, dy) in from {
        if let Some(there) = neighbor(x, y, *dx, *dy, width, height) {
            distance[here] = distance[here].min(distance[there] + 1);
        }
    }
}

/// The index of a neighbour, if it is in the image.
fn neighbor(x: usize, y: usize, dx: isize, dy: isize, width: usize, height: usize) -> Option<usize> {
    let x = x.checked_add_signed(dx).filter(|x| *x < width)?;
    let y = y.checked_add_signed(dy).filter(|y| *y < height)?;
    Some(y * width + x)
}

/// How many pixels outside `band` are lit in one image and dark in the other, by which side of 1/2
/// they are on. A pixel of `test` that is not a number counts.
///
/// # Panics
/// If the lengths differ.
pub fn misclassified(test: &[f32], reference: &[f32], band: &[bool]) -> usize {
    pairs(test, reference, band, false).filter(|(t, r)| t.is_nan() || (*t > 0.5) != (*r > 0.5)).count()
}

/// The root of the mean squared difference over the pixels where `mask` is true; not a number if one
/// of those is not. 0 where the mask is empty: a test that means to measure something looks at the
/// mask too.
///
/// # Panics
/// If the lengths differ.
pub fn rms(test: &[f32], reference: &[f32], mask: &[bool]) -> f64 {
    let (mut sum, mut count) = (0.0, 0u64);
    for (t, r) in pairs(test, reference, mask, true) {
        let difference = f64::from(t) - f64::from(r);
        sum += difference * difference;
        count += 1;
    }
    if count == 0 { 0.0 } else { (sum / count as f64).sqrt() }
}

/// The root of the mean squared difference over all pixels, as [`rms`].
///
/// # Panics
/// If the lengths differ.
pub fn rmse(test: &[f32], reference: &[f32]) -> f64 {
    rms(test, reference, &vec![true; reference.len()])
}

/// The largest difference over the pixels where `mask` is true; infinite if one of those is not a
/// number, 0 where the mask is empty.
///
/// # Panics
/// If the lengths differ.
pub fn max_abs(test: &[f32], reference: &[f32], mask: &[bool]) -> f64 {
    pairs(test, reference, mask, true)
        .map(|(t, r)| (f64::from(t) - f64::from(r)).abs())
        .map(|d| if d.is_nan() { f64::INFINITY } else { d })
        .fold(0.0, f64::max)
}

/// Both values of each pixel whose mask is `wanted`.
fn pairs<'a>(
    test: &'a [f32],
    reference: &'a [f32],
    mask: &'a [bool],
    wanted: bool,
) -> impl Iterator<Item = (f32, f32)> + 'a {
    assert_eq!(test.len(), reference.len(), "the images have the same size");
    assert_eq!(mask.len(), reference.len(), "the mask has the images' size");
    let both = test.iter().copied().zip(reference.iter().copied());
    both.zip(mask).filter(move |(_, m)| **m == wanted).map(|(pair, _)| pair)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An image from rows of digits: 0 dark, 1 lit, others partial in tenths.
    fn image(rows: &[&str]) -> (Vec<f32>, usize, usize) {
        let value = |c: u8| match c {
            b'0' => 0.0,
            b'1' => 1.0,
            c => f32::from(c - b'0') / 10.0,
        };
        (rows.iter().flat_map(|r| r.bytes().map(value)).collect(), rows[0].len(), rows.len())
    }

    fn drawn(band: &[bool], width: usize) -> Vec<String> {
        let row = |r: &[bool]| r.iter().map(|b| if *b { '#' } else { '.' }).collect();
        band.chunks(width).map(row).collect()
    }

    #[track_caller]
    fn assert_band(rows: &[&str], ids: Option<&[Option<u32>]>, radius: usize, expected: &[&str]) {
        let (reference, width, height) = image(rows);
        let nothing = vec![None; reference.len()];
        let band = edge_band(&reference, ids.unwrap_or(&nothing), width, height, radius);
        assert_eq!(drawn(&band, width), expected, "{rows:?} with radius {radius}");
    }

    #[test]
    fn a_hard_edge_has_one_pixel_on_either_side() {
        let rows = ["000111", "000111", "000111"];
        assert_band(&rows, None, 0, &["......", "......", "......"]);
        assert_band(&rows, None, 1, &["..##..", "..##..", "..##.."]);
        assert_band(&rows, None, 2, &[".####.", ".####.", ".####."]);
        assert_band(&rows, None, 99, &["######", "######", "######"]);
    }

    #[test]
    fn a_partial_pixel_is_on_the_edge() {
        let rows = ["11111", "11711", "11111"];
        assert_band(&rows, None, 0, &[".....", "..#..", "....."]);
        assert_band(&rows, None, 1, &[".###.", ".###.", ".###."]);
    }

    #[test]
    fn distances_are_chebyshev() {
        let rows = ["11111", "11111", "11011", "11111", "11111"];
        assert_band(&rows, None, 1, &[".....", ".###.", ".###.", ".###.", "....."]);
        assert_band(&rows, None, 2, &["#####", "#####", "#####", "#####", "#####"]);
        let rows = ["01111", "11111", "11111", "11111"];
        assert_band(&rows, None, 1, &["##...", "##...", ".....", "....."]);
        assert_band(&rows, None, 2, &["###..", "###..", "###..", "....."]);
    }

    #[test]
    fn objects_have_edges_too() {
        let ids = [None, None, Some(0), Some(0), Some(7), Some(7)];
        assert_band(&["111111"], Some(&ids), 1, &[".####."]);
        assert_band(&["1", "1", "1", "1", "1", "1"], Some(&ids), 1, &[".", "#", "#", "#", "#", "."]);
    }

    #[test]
    fn images_without_pixels_or_edges() {
        assert!(edge_band(&[], &[], 0, 0, 3).is_empty(), "no pixels, no band");
        assert_band(&["1111"], None, 3, &["...."]);
        assert_band(&["0"], None, 3, &["."]);
        let nan = edge_band(&[1.0, f32::NAN, 1.0], &[None; 3], 3, 1, 0);
        assert_eq!(nan, [false, true, false], "what is not a number is not whole");
    }

    #[test]
    fn misclassified_counts_outside_the_band() {
        let reference = [1.0, 1.0, 0.0, 0.0];
        let band = [false, true, false, false];
        assert_eq!(misclassified(&reference, &reference, &band), 0, "equal images");
        assert_eq!(misclassified(&[0.9, 0.0, 0.1, 0.4], &reference, &band), 0, "the right side of 1/2");
        assert_eq!(misclassified(&[0.4, 0.0, 0.1, 0.6], &reference, &band), 2, "the wrong side, twice");
        assert_eq!(misclassified(&[f32::NAN, 1.0, f32::NAN, 0.0], &reference, &band), 2, "NaN is wrong");
    }

    #[test]
    fn errors_over_a_mask() {
        let (test, reference) = ([1.0, 0.5, 0.25, 0.0], [1.0, 0.0, 0.0, 1.0]);
        assert_eq!(
            rms(&test, &reference, &[false, true, true, false]),
            (0.3125f64 / 2.0).sqrt(),
            "two pixels"
        );
        assert_eq!(rmse(&test, &reference), (1.3125f64 / 4.0).sqrt(), "all pixels");
        assert_eq!(max_abs(&test, &reference, &[true, true, true, false]), 0.5, "the last pixel is masked");
        assert_eq!(max_abs(&test, &reference, &[true; 4]), 1.0, "all pixels");
        assert_eq!(rms(&test, &reference, &[false; 4]), 0.0, "an empty mask");
        assert_eq!(max_abs(&test, &reference, &[false; 4]), 0.0, "an empty mask");
        let nan = [f32::NAN, 0.0];
        assert!(rmse(&nan, &[0.0, 0.0]).is_nan(), "NaN is not hidden");
        assert_eq!(max_abs(&nan, &[0.0, 0.0], &[true; 2]), f64::INFINITY, "NaN is not hidden");
        assert_eq!(rms(&nan, &[0.0, 0.0], &[false, true]), 0.0, "NaN is masked");
    }

    #[test]
    #[should_panic(expected = "the images have the same size")]
    fn another_size_is_a_mistake() {
        misclassified(&[1.0], &[1.0, 0.0], &[false, false]);
    }

    #[test]
    fn the_band_is_what_its_definition_says() {
        // Against the definition, pixel by pixel, on random images.
        let mut random = fastrand::Rng::with_seed(3);
        for _ in 0..300 {
            let (width, height) = (random.usize(1..12), random.usize(1..12));
            let size = width * height;
            let value = |r: &mut fastrand::Rng| [0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.3][r.usize(0..8)];
            let reference: Vec<f32> = (0..size).map(|_| value(&mut random)).collect();
            let ids: Vec<Option<u32>> = (0..size).map(|_| (random.usize(0..20) == 0).then_some(1)).collect();
            let at = |i: usize| ((i % width) as isize, (i / width) as isize);
            let apart = |a: usize, b: usize| {
                let ((ax, ay), (bx, by)) = (at(a), at(b));
                ax.abs_diff(bx).max(ay.abs_diff(by))
            };
            let own = |i: usize| {
                let crosses = |j: usize| (reference[i] > 0.5) != (reference[j] > 0.5) || ids[i] != ids[j];
                let beside = (0..size).any(|j| apart(i, j) == 1 && crosses(j));
                if reference[i] == 0.3 { Some(0) } else { beside.then_some(1) }
            };
            for radius in 0..4 {
                let band = edge_band(&reference, &ids, width, height, radius);
                for (i, in_band) in band.into_iter().enumerate() {
                    let expected = (0..size).any(|j| own(j).is_some_and(|d| d + apart(i, j) <= radius));
                    assert_eq!(in_band, expected, "pixel {i} of {width} by {height}: {reference:?} {ids:?}");
                }
            }
        }
    }
}
