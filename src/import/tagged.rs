//! TIFF, page by page: a camera's stack is often one file of many pages.

use super::pictures::Picture;
use crate::frames::Geometry;
use crate::problem::{Problem, Result};
use std::fs::File;
use std::io::BufReader;
use std::path::Path;
use tiff::ColorType;
use tiff::decoder::{Decoder, DecodingResult};
use tiff::tags::Tag;

/// `PlanarConfiguration` of a file that stores the channels one after the other.
const PLANAR: u16 = 2;
/// `SampleFormat` of whole numbers from 0 on.
const UNSIGNED: u16 = 1;
/// `PhotometricInterpretation` of grey whose greatest number is black.
const WHITE_IS_ZERO: u16 = 0;

/// Gives the pages of `file` to `take`, one after the other.
pub(super) fn read(file: &Path, mut take: impl FnMut(Picture) -> Result<()>) -> Result<()> {
    let opened = File::open(file).map_err(|error| Problem::io(file, "read", &error))?;
    let mut decoder = Decoder::new(BufReader::new(opened)).map_err(|error| broken(file, 0, &error))?;
    for page in 0.. {
        let picture = this_page(file, page, &mut decoder)?;
        take(picture)?;
        if !decoder.more_images() {
            break;
        }
        decoder.next_image().map_err(|error| broken(file, page + 1, &error))?;
    }
    Ok(())
}

fn broken(file: &Path, page: usize, error: &dyn std::fmt::Display) -> Problem {
    Problem::in_file(file, format_args!("page {page} cannot be decoded: {error}"))
        .expected("a whole TIFF, plain or compressed by LZW or deflate")
        .remedy("copy or save it again")
}

fn this_page(file: &Path, page: usize, decoder: &mut Decoder<BufReader<File>>) -> Result<Picture> {
    let broken = |error: tiff::TiffError| broken(file, page, &error);
    let (width, height) = decoder.dimensions().map_err(broken)?;
    let geometry = Geometry { width: width as usize, height: height as usize };
    let kind = decoder.colortype().map_err(broken)?;
    let refuse = |what: &dyn std::fmt::Display| {
        Problem::in_file(file, format_args!("page {page} {what}"))
            .expected("unsigned grey of 8, 16 or 32 bits, or colour of 8 or 16 bits with --channel")
            .remedy("save it as grey of 16 bits, or as flat numbers for `vuris import raw`")
    };
    let of_kind = format!("is of the kind {kind:?}");
    let channels = match kind {
        ColorType::Gray(8 | 16 | 32) => 1,
        ColorType::GrayA(8 | 16) => 2,
        ColorType::RGB(8 | 16) => 3,
        ColorType::RGBA(8 | 16) => 4,
        _ => return Err(refuse(&of_kind)),
    };
    let planes: Option<u16> = decoder.find_tag_unsigned(Tag::PlanarConfiguration).map_err(broken)?;
    if channels > 1 && planes == Some(PLANAR) {
        return Err(refuse(&of_kind).expected("grey, or colours that are stored pixel by pixel"));
    }
    let formats: Option<Vec<u16>> = decoder.find_tag_unsigned_vec(Tag::SampleFormat).map_err(broken)?;
    if let Some(other) = formats.into_iter().flatten().find(|&format| format != UNSIGNED) {
        let kind = match other {
            2 => "signed numbers",
            3 => "floating point numbers",
            _ => "no plain numbers",
        };
        return Err(refuse(&format_args!("has {kind} (SampleFormat {other})")));
    }
    let white: Option<u16> = decoder.find_tag_unsigned(Tag::PhotometricInterpretation).map_err(broken)?;
    if white == Some(WHITE_IS_ZERO) {
        return Err(Problem::in_file(
            file,
            format_args!("page {page} has white at 0 (PhotometricInterpretation 0)"),
        )
        .expected("black at 0: which code a sample was is not known where it is turned round")
        .remedy("save it with black at 0"));
    }
    let samples: Vec<u32> = match decoder.read_image().map_err(broken)? {
        DecodingResult::U8(samples) => samples.into_iter().map(u32::from).collect(),
        DecodingResult::U16(samples) => samples.into_iter().map(u32::from).collect(),
        DecodingResult::U32(samples) => samples,
        _ => return Err(refuse(&of_kind)),
    };
    Ok(Picture { geometry, channels, samples })
}
