//! A picture to put pictures and text on.

use ab_glyph::{Font, FontRef, PxScale, ScaleFont, point};
use epaint_default_fonts::UBUNTU_LIGHT;

/// An 8-bit sRGB picture, rows top to bottom.
pub(super) struct Canvas {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) bytes: Vec<u8>,
    font: Option<FontRef<'static>>,
}

impl Canvas {
    /// A canvas of one colour.
    pub(super) fn new(width: usize, height: usize, color: [u8; 3]) -> Self {
        // The font is part of the program: that it can be read is a test's to say.
        let font = FontRef::try_from_slice(UBUNTU_LIGHT).ok();
        Self { width, height, bytes: color.repeat(width * height), font }
    }

    /// Sets a pixel; outside the canvas nothing happens.
    pub(super) fn set(&mut self, x: usize, y: usize, color: [u8; 3]) {
        if x < self.width && y < self.height {
            let at = 3 * (y * self.width + x);
            self.bytes[at..at + 3].copy_from_slice(&color);
        }
    }

    /// Puts a picture with its top left corner at a place.
    pub(super) fn put(&mut self, picture: &Tile, (left, top): (usize, usize)) {
        for (i, pixel) in picture.pixels.iter().enumerate() {
            self.set(left + i % picture.width, top + i / picture.width, *pixel);
        }
    }

    /// Writes a line of text with its top left corner at a place, `size` pixels high. What does not fit into `room`
    /// pixels across is cut off, with dots.
    pub(super) fn text(
        &mut self,
        text: &str,
        (left, top): (usize, usize),
        room: usize,
        size: f32,
        color: [u8; 3],
    ) {
        let Some(font) = self.font.clone() else { return };
        let font = font.as_scaled(PxScale::from(size));
        let mut text = text.to_owned();
        let wide = |text: &str| text.chars().map(|c| font.h_advance(font.glyph_id(c))).sum::<f32>();
        if wide(&text) > room as f32 {
            while text.pop().is_some() && wide(&text) + wide("...") > room as f32 {}
            text.push_str("...");
        }
        let (mut x, baseline) = (left as f32, top as f32 + font.ascent());
        let mut last = None;
        for c in text.chars() {
            let id = font.glyph_id(c);
            x += last.map_or(0.0, |last| font.kern(last, id));
            if let Some(glyph) =
                font.outline_glyph(id.with_scale_and_position(font.scale(), point(x, baseline)))
            {
                let bounds = glyph.px_bounds();
                glyph.draw(|u, v, part| {
                    self.blend(bounds.min.x + u as f32, bounds.min.y + v as f32, color, part);
                });
            }
            x += font.h_advance(id);
            last = Some(id);
        }
    }

    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "places and levels, clamped")]
    fn blend(&mut self, x: f32, y: f32, color: [u8; 3], part: f32) {
        let (x, y) = (x.max(0.0) as usize, y.max(0.0) as usize);
        if x < self.width && y < self.height {
            let at = 3 * (y * self.width + x);
            for (level, color) in self.bytes[at..at + 3].iter_mut().zip(color) {
                let mixed = f32::from(*level) + (f32::from(color) - f32::from(*level)) * part.clamp(0.0, 1.0);
                *level = mixed.round() as u8;
            }
        }
    }
}

/// A picture of the size that a tile of the sheet has.
pub(super) struct Tile {
    /// Pixels across.
    pub(super) width: usize,
    /// Pixels down.
    pub(super) height: usize,
    /// Rows top to bottom.
    pub(super) pixels: Vec<[u8; 3]>,
}

/// How a picture becomes a tile: blocks of this many pixels a side make one, or one makes a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Zoom {
    /// Smaller.
    Out(usize),
    /// Larger.
    In(usize),
}

impl Zoom {
    /// That which makes tiles between `least` and `most` pixels across, or nearly.
    pub(super) fn new(width: usize, least: usize, most: usize) -> Self {
        if width > most { Self::Out(width.div_ceil(most)) } else { Self::In((least / width.max(1)).max(1)) }
    }

    /// The tile of a picture: blocks are averaged as they are, in linear light where the picture is, and coloured
    /// after.
    pub(super) fn tile<const N: usize>(
        self,
        pixels: &[[f32; N]],
        width: usize,
        height: usize,
        color: impl Fn([f32; N]) -> [u8; 3],
    ) -> Tile {
        let (across, down) = match self {
            Self::Out(k) => ((width / k).max(1), (height / k).max(1)),
            Self::In(k) => (width * k, height * k),
        };
        let at = |x: usize, y: usize| match self {
            Self::In(k) => pixels[y / k * width + x / k],
            Self::Out(k) => {
                let rows = y * k..((y + 1) * k).min(height);
                let block = rows.flat_map(|v| (x * k..((x + 1) * k).min(width)).map(move |u| v * width + u));
                let (mut sum, mut count) = ([0f32; N], 0f32);
                for i in block {
                    sum.iter_mut().zip(pixels[i]).for_each(|(sum, value)| *sum += value);
                    count += 1.0;
                }
                sum.map(|sum| sum / count)
            }
        };
        let pixels = (0..down).flat_map(|y| (0..across).map(move |x| (x, y))).map(|(x, y)| color(at(x, y)));
        Tile { width: across, height: down, pixels: pixels.collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_drawn_and_cut_off() {
        let mut canvas = Canvas::new(200, 30, [0; 3]);
        canvas.text("analytic", (10, 4), 180, 20.0, [255; 3]);
        let lit = |canvas: &Canvas, columns: std::ops::Range<usize>| {
            columns
                .flat_map(|x| (0..30).map(move |y| (x, y)))
                .any(|(x, y)| canvas.bytes[3 * (y * 200 + x)] > 128)
        };
        assert!(lit(&canvas, 10..30), "the font is there");
        assert!(!lit(&canvas, 0..9), "nothing before it");
        let mut canvas = Canvas::new(200, 30, [0; 3]);
        canvas.text("a name that is far too long for its room", (0, 4), 100, 20.0, [255; 3]);
        assert!(lit(&canvas, 70..100) && !lit(&canvas, 101..200), "dots, and no more than the room");
        canvas.text("outside", (190, 25), 100, 20.0, [255; 3]);
        canvas.text("nothing fits", (0, 0), 0, 20.0, [255; 3]);
    }

    #[test]
    fn tiles_are_averages_or_blocks() {
        assert_eq!(Zoom::new(960, 320, 480), Zoom::Out(2), "960 to 480");
        assert_eq!(Zoom::new(481, 320, 480), Zoom::Out(2), "481 to 240");
        assert_eq!(Zoom::new(400, 320, 480), Zoom::In(1), "as it is");
        assert_eq!(Zoom::new(48, 320, 480), Zoom::In(6), "48 to 288");
        let picture = [[0.0f32], [1.0], [0.5], [0.5], [1.0], [1.0]];
        let level = |v: [f32; 1]| [(v[0] * 100.0).round() as u8; 3];
        let tile = Zoom::Out(2).tile(&picture, 3, 2, level);
        assert_eq!((tile.width, tile.height, tile.pixels), (1, 1, vec![[63; 3]]), "mean of 0, 1, 1/2 and 1");
        let tile = Zoom::In(2).tile(&picture, 3, 2, level);
        assert_eq!((tile.width, tile.height), (6, 4), "twice the size");
        assert_eq!(tile.pixels[2..4], [[100; 3], [100; 3]], "blocks of the second pixel");
    }
}
