//! Animated PNG: frames one after the other, each the part of the picture that changed since the one before.

use std::io::{self, Write};

use super::png::{into_io, rgb8};
use crate::args::Size;

/// An animation on its way to a file; it plays again and again. Only the last frame is held.
pub(crate) struct Animation<W: Write> {
    writer: png::Writer<W>,
    width: usize,
    last: Vec<u8>,
}

impl<W: Write> Animation<W> {
    /// An animation of exactly `frames` frames, each shown for `delay` seconds.
    ///
    /// # Errors
    /// What the file system says; that there are no frames.
    pub(crate) fn new(to: W, size: Size, frames: u32, delay: f64) -> io::Result<Self> {
        let mut encoder = rgb8(to, size.width, size.height);
        let (seconds, parts) = fraction(delay);
        encoder.set_animated(frames, 0).map_err(into_io)?;
        encoder.set_frame_delay(seconds, parts).map_err(into_io)?;
        // What a frame does not cover stays.
        encoder.set_dispose_op(png::DisposeOp::None).map_err(into_io)?;
        encoder.set_blend_op(png::BlendOp::Source).map_err(into_io)?;
        encoder.validate_sequence(true);
        let writer = encoder.write_header().map_err(into_io)?;
        Ok(Self { writer, width: size.width as usize, last: Vec::new() })
    }

    /// Writes the next frame: 8-bit sRGB levels, three bytes a pixel, rows top to bottom.
    ///
    /// # Errors
    /// What the file system says; that there are enough frames.
    pub(crate) fn frame(&mut self, levels: Vec<u8>) -> io::Result<()> {
        let stride = 3 * self.width;
        if self.last.is_empty() {
            self.writer.write_image_data(&levels).map_err(into_io)?;
        } else {
            let [left, top, right, bottom] = changed(&self.last, &levels, self.width);
            let rows = levels.chunks_exact(stride).skip(top).take(bottom - top);
            let part: Vec<u8> = rows.flat_map(|row| &row[3 * left..3 * right]).copied().collect();
            let side = |side: usize| u32::try_from(side).map_err(io::Error::other);
            // Back to the corner first: position and size together may never leave the picture.
            self.writer.set_frame_position(0, 0).map_err(into_io)?;
            self.writer.set_frame_dimension(side(right - left)?, side(bottom - top)?).map_err(into_io)?;
            self.writer.set_frame_position(side(left)?, side(top)?).map_err(into_io)?;
            self.writer.write_image_data(&part).map_err(into_io)?;
        }
        self.last = levels;
        Ok(())
    }

    /// Writes the end.
    ///
    /// # Errors
    /// What the file system says; that there were fewer frames than promised.
    pub(crate) fn finish(self) -> io::Result<()> {
        self.writer.finish().map_err(into_io)
    }
}

/// The smallest rectangle that holds all pixels that differ: left, top, right, bottom, the latter two past the end. The
/// first pixel where none does: a frame has at least one.
fn changed(old: &[u8], new: &[u8], width: usize) -> [usize; 4] {
    let stride = 3 * width;
    let mut found: Option<[usize; 4]> = None;
    for (y, (old, new)) in old.chunks_exact(stride).zip(new.chunks_exact(stride)).enumerate() {
        let differs = |x: &usize| old[3 * x..3 * x + 3] != new[3 * x..3 * x + 3];
        if old == new {
            continue;
        }
        let (Some(left), Some(right)) = ((0..width).find(differs), (0..width).rfind(differs)) else {
            continue;
        };
        let [a, top, b, _] = found.unwrap_or([left, y, right + 1, y + 1]);
        found = Some([a.min(left), top, b.max(right + 1), y + 1]);
    }
    found.unwrap_or([0, 0, 1, 1])
}

/// A positive number as numerator and denominator of 16 bits: as near as they come, in the smallest such numbers.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to 16 bits before")]
fn fraction(value: f64) -> (u16, u16) {
    let numerator = |denominator: u16| (value * f64::from(denominator)).round().clamp(1.0, 65535.0) as u16;
    let off =
        |denominator: u16| (f64::from(numerator(denominator)) / f64::from(denominator) - value).abs() / value;
    let mut best = 1;
    for denominator in 2..=u16::MAX {
        // Less by more than rounding.
        if off(denominator) < off(best) - 1e-12 {
            best = denominator;
        }
    }
    (numerator(best), best)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn delays_are_fractions() {
        for (value, expected) in [
            (0.05, (1, 20)),
            (1.0 / 30.0, (1, 30)),
            (1001.0 / 30_000.0, (1001, 30_000)),
            (2.5, (5, 2)),
            (65_535.0, (65_535, 1)),
            (1e9, (65_535, 1)),
            (0.01, (1, 100)),
        ] {
            assert_eq!(fraction(value), expected, "{value}");
        }
        let (numerator, denominator) = fraction(std::f64::consts::PI / 50.0);
        let got = f64::from(numerator) / f64::from(denominator);
        assert!((got - std::f64::consts::PI / 50.0).abs() < 1e-8, "{numerator}/{denominator} is near");
    }

    #[test]
    fn changes_are_bounded_tightly() {
        let old = vec![7; 3 * 5 * 4];
        assert_eq!(changed(&old, &old, 5), [0, 0, 1, 1], "one pixel where nothing changed");
        let with = |pixels: &[(usize, usize)]| {
            let mut new = old.clone();
            for (x, y) in pixels {
                new[3 * (5 * y + x) + 2] = 9;
            }
            changed(&old, &new, 5)
        };
        assert_eq!(with(&[(3, 2)]), [3, 2, 4, 3], "one pixel");
        assert_eq!(with(&[(3, 1), (1, 3)]), [1, 1, 4, 4], "two corners");
        assert_eq!(with(&[(0, 0), (4, 3)]), [0, 0, 5, 4], "everything");
    }

    #[test]
    fn the_number_of_frames_is_kept() {
        let size = Size { width: 2, height: 1 };
        let mut bytes = Vec::new();
        let mut animation = Animation::new(&mut bytes, size, 2, 0.1).expect("two frames");
        animation.frame(vec![0; 6]).expect("the first");
        assert!(animation.finish().is_err(), "the second is missing");
        assert!(Animation::new(&mut Vec::new(), size, 0, 0.1).is_err(), "no frames are no animation");
    }
}
