//! Pictures as files.

use std::io;
use std::path::Path;

/// Writes RGB rows from the top as a PNG, all of it or nothing.
pub(crate) fn write(path: &Path, width: u32, height: u32, rgb: &[u8]) -> io::Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut file = tempfile::NamedTempFile::new_in(folder)?;
    let mut encoder = png::Encoder::new(io::BufWriter::new(&mut file), width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    encoder.write_header()?.write_image_data(rgb)?;
    file.persist(path)?;
    Ok(())
}
