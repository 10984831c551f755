//! BMP and PNG.

use super::pictures::Picture;
use crate::frames::Geometry;
use crate::problem::{Problem, Result};
use image::{DynamicImage, ImageReader};
use std::fs::File;
use std::io::{BufRead, BufReader, Seek};
use std::path::Path;

/// Reads the picture at `file`.
pub(super) fn read(file: &Path) -> Result<Picture> {
    let io = |error: std::io::Error| Problem::io(file, "read", &error);
    let mut bytes = BufReader::new(File::open(file).map_err(io)?);
    // A decoder would stretch narrow codes to 8 bits, and nobody would know.
    let start = bytes.fill_buf().map_err(io)?;
    if let (true, Some(&bits), Some(&colour)) = (start.starts_with(b"\x89PNG"), start.get(24), start.get(25))
        && bits < 8
        && colour != PALETTE
    {
        return Err(Problem::in_file(file, format_args!("has {bits} bits a sample"))
            .expected("8 or 16 bits")
            .remedy("save it with 8 bits a sample"));
    }
    if start.starts_with(b"BM") && start.get(28) == Some(&16) {
        return Err(Problem::in_file(file, "has 16 bits a pixel, of which a colour has 5 or 6")
            .expected("8 bits a sample: narrower ones would be stretched")
            .remedy("save it with 8 bits of grey, or 24 of colour"));
    }
    bytes.rewind().map_err(io)?;
    let broken = |error: &dyn std::fmt::Display| {
        Problem::in_file(file, format_args!("cannot be decoded: {error}"))
            .expected("a whole picture, BMP or PNG")
            .remedy("copy or save it again")
    };
    let picture = ImageReader::new(bytes)
        .with_guessed_format()
        .map_err(|error| broken(&error))?
        .decode()
        .map_err(|error| broken(&error))?;
    let geometry = Geometry { width: picture.width() as usize, height: picture.height() as usize };
    let channels = usize::from(picture.color().channel_count());
    let samples = match picture {
        DynamicImage::ImageLuma8(pixels) => wide(pixels.into_raw()),
        DynamicImage::ImageLumaA8(pixels) => wide(pixels.into_raw()),
        DynamicImage::ImageRgb8(pixels) => wide(pixels.into_raw()),
        DynamicImage::ImageRgba8(pixels) => wide(pixels.into_raw()),
        DynamicImage::ImageLuma16(pixels) => wide(pixels.into_raw()),
        DynamicImage::ImageLumaA16(pixels) => wide(pixels.into_raw()),
        DynamicImage::ImageRgb16(pixels) => wide(pixels.into_raw()),
        DynamicImage::ImageRgba16(pixels) => wide(pixels.into_raw()),
        other => return Err(broken(&format_args!("its samples are {:?}", other.color()))),
    };
    Ok(Picture { geometry, channels, samples })
}

/// A PNG's colour type of indices into a table of colours.
const PALETTE: u8 = 3;

fn wide<T: Into<u32>>(samples: Vec<T>) -> Vec<u32> {
    samples.into_iter().map(Into::into).collect()
}
