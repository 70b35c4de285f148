//! PNG: pictures as 8-bit sRGB without a tone curve, visibilities as 16-bit grey.

use std::io::{self, Write};

use super::Picture;

/// Writes a picture, as its [`levels`].
pub(crate) fn write_picture(picture: &Picture, to: &mut impl Write) -> io::Result<()> {
    write_rgb8(picture.width as usize, picture.height as usize, &levels(picture), to)
}

/// A picture as 8-bit sRGB levels, three bytes a pixel, rows top to bottom: exposure, clamp to [0, 1], sRGB encoding,
/// rounding to the nearest of 256 levels. Not-a-number becomes 0.
pub(crate) fn levels(picture: &Picture) -> Vec<u8> {
    (0..picture.pixels.len()).flat_map(|index| picture.exposed(index).map(encode_srgb)).collect()
}

/// Writes one light's visibility, rows top to bottom: 0 to 1 becomes 0 to 65535.
pub(crate) fn write_visibility(
    width: u32,
    height: u32,
    visibility: &[u16],
    to: &mut impl Write,
) -> io::Result<()> {
    let bytes: Vec<u8> = visibility.iter().flat_map(|level| level.to_be_bytes()).collect();
    let mut encoder = png::Encoder::new(to, width, height);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Sixteen);
    write(encoder, &bytes)
}

/// Writes a picture of 8-bit sRGB levels, three bytes a pixel, rows top to bottom. Sides that 32 bits cannot count are
/// an error.
pub(crate) fn write_rgb8(width: usize, height: usize, bytes: &[u8], to: &mut impl Write) -> io::Result<()> {
    let side = |side: usize| u32::try_from(side).map_err(io::Error::other);
    write(rgb8(to, side(width)?, side(height)?), bytes)
}

/// An encoder of 8-bit sRGB levels, three bytes a pixel.
pub(super) fn rgb8<W: Write>(to: W, width: u32, height: u32) -> png::Encoder<'static, W> {
    let mut encoder = png::Encoder::new(to, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    encoder
}

fn write<W: Write>(encoder: png::Encoder<W>, bytes: &[u8]) -> io::Result<()> {
    let mut writer = encoder.write_header().map_err(into_io)?;
    writer.write_image_data(bytes).map_err(into_io)?;
    writer.finish().map_err(into_io)
}

/// What the encoder says, as an error of writing.
pub(super) fn into_io(error: png::EncodingError) -> io::Error {
    match error {
        png::EncodingError::IoError(error) => error,
        other => io::Error::other(other),
    }
}

/// A visibility in [0, 1] as one of 65536 levels, rounded to the nearest. Values outside are clamped; not-a-number
/// becomes 0.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to [0, 65535] before")]
pub(crate) fn visibility_level(visibility: f32) -> u16 {
    (f64::from(visibility.clamp(0.0, 1.0)) * 65535.0).round() as u16
}

/// Linear to sRGB (IEC 61966-2-1), as one of 256 levels.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "in [0, 255] by construction")]
pub(crate) fn encode_srgb(linear: f32) -> u8 {
    let linear = f64::from(linear.clamp(0.0, 1.0));
    let encoded = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    (encoded * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_levels() {
        // Levels from the definition: 18 % grey is level 118, half is 188; the toe is linear.
        for (linear, level) in
            [(0.0, 0), (1.0, 255), (0.18, 118), (0.5, 188), (0.001, 3), (-1.0, 0), (7.0, 255)]
        {
            assert_eq!(encode_srgb(linear), level, "sRGB level of {linear}");
        }
        assert_eq!(encode_srgb(f32::NAN), 0, "not-a-number is black");
        assert_eq!(encode_srgb(f32::INFINITY), 255, "infinity is white");
    }

    #[test]
    fn visibility_levels() {
        for (visibility, level) in [(0.0, 0), (1.0, 65535), (0.5, 32768), (1.5, 65535), (-0.1, 0)] {
            assert_eq!(visibility_level(visibility), level, "level of {visibility}");
        }
        assert_eq!(visibility_level(f32::NAN), 0, "not-a-number is dark");
    }
}
