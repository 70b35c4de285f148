//! OpenEXR: linear 32-bit float, channels R, G and B, exposure applied, nothing clamped.

use std::io::{self, Seek, Write};

use exr::error::Error;
use exr::image::{Encoding, Image, SpecificChannels};
use exr::prelude::WritableImage;

use super::Picture;

/// Writes a picture, losslessly compressed.
pub(crate) fn write_picture(picture: &Picture, to: &mut (impl Write + Seek)) -> io::Result<()> {
    let width = picture.width as usize;
    let channels = SpecificChannels::rgb(|position: exr::math::Vec2<usize>| {
        let [red, green, blue] = picture.exposed(position.1 * width + position.0);
        (red, green, blue)
    });
    let mut image = Image::from_channels((width, picture.height as usize), channels);
    image.layer_data.encoding = Encoding::SMALL_FAST_LOSSLESS;
    image.write().to_buffered(to).map_err(|error| match error {
        Error::Io(error) => error,
        other => io::Error::other(other.to_string()),
    })
}
