//! Picture files: which they are ([`plan`]), what is in them ([`png`], [`apng`], [`exr`]), and how they come to be at once or
//! not at all ([`staged`]), whatever ends the program ([`signals`]).

pub(crate) mod apng;
pub(crate) mod exr;
pub(crate) mod plan;
pub(crate) mod png;
pub(crate) mod signals;
pub(crate) mod staged;

use std::io::{self, Seek, Write};

use glam::Vec3;

/// The formats of pictures, by the extension of the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    /// 8-bit sRGB.
    Png,
    /// Linear 32-bit float.
    Exr,
}

/// A picture ready to be written.
pub(crate) struct Picture<'a> {
    /// Pixels across.
    pub(crate) width: u32,
    /// Pixels down.
    pub(crate) height: u32,
    /// Linear radiance, rows top to bottom.
    pub(crate) pixels: &'a [[f32; 3]],
    /// Factor on radiance.
    pub(crate) exposure: f64,
}

impl Picture<'_> {
    /// Linear colour after exposure.
    fn exposed(&self, index: usize) -> [f32; 3] {
        #[expect(clippy::cast_possible_truncation, reason = "pictures are 32-bit")]
        let exposure = self.exposure as f32;
        (Vec3::from(self.pixels[index]) * exposure).to_array()
    }

    /// Writes the picture.
    ///
    /// # Errors
    /// What the file system says.
    pub(crate) fn write(&self, format: Format, to: &mut (impl Write + Seek)) -> io::Result<()> {
        match format {
            Format::Png => png::write_picture(self, to),
            Format::Exr => exr::write_picture(self, to),
        }
    }
}
