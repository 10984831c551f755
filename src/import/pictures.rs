//! Files of frames, each known by its first bytes: `.npy`, TIFF, BMP, PNG. Whatever their names say.

use super::stack::Stack;
use super::{bitmap, tagged};
use crate::frames::Geometry;
use crate::problem::{Problem, Result};
use crate::recording::read_npy;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// A colour that is taken for the grey code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Channel {
    /// The first.
    Red,
    /// The second.
    Green,
    /// The third.
    Blue,
}

/// A decoded picture.
pub(super) struct Picture {
    pub geometry: Geometry,
    /// 1 grey, 2 grey and transparency, 3 red, green, blue, 4 these and transparency.
    pub channels: usize,
    /// In C order `[row, column, channel]`.
    pub samples: Vec<u32>,
}

/// Reads a file's frames into the stack.
type Reader = fn(&Path, Option<Channel>, &mut Stack) -> Result<()>;

/// What a file of each format begins with.
const SIGNATURES: &[(&[u8], Reader)] = &[
    (b"\x93NUMPY", array),
    (b"II*\0", pages),
    (b"MM\0*", pages),
    (b"II+\0", pages),
    (b"MM\0+", pages),
    (b"BM", picture),
    (b"\x89PNG\r\n\x1a\n", picture),
];

/// Reads `files` into `stack`, in the order in which they are given: pictures of 8 or 16 bits a sample (of TIFF also 32, and every
/// page), and arrays `[frame, row, column]` of `|u1`, `<u2` or `<u4`. A picture in colour whose three channels are equal
/// everywhere is grey; of any other one `channel` is taken.
///
/// # Errors
/// A file that is not there, is none of these, is broken, in colour (or half transparent) without `channel`, of
/// another size than the first; a number that is no code.
pub fn read_pictures(files: &[PathBuf], channel: Option<Channel>, stack: &mut Stack) -> Result<()> {
    for file in files {
        let mut start = Vec::new();
        let opened = match file.metadata() {
            Ok(metadata) if metadata.is_dir() => {
                return Err(Problem::in_file(file, "is a folder")
                    .expected("files of frames")
                    .remedy(format_args!("name the files: {}/*", file.display())));
            }
            _ => File::open(file),
        };
        opened
            .and_then(|opened| opened.take(16).read_to_end(&mut start))
            .map_err(|error| Problem::io(file, "read", &error))?;
        match SIGNATURES.iter().find(|(signature, _)| start.starts_with(signature)) {
            Some((_, reader)) => reader(file, channel, stack)?,
            None => {
                return Err(Problem::in_file(file, "is neither BMP, PNG, TIFF nor .npy, by its first bytes")
                    .expected("frames in one of these formats")
                    .remedy("convert it without loss, or read flat numbers with `vuris import raw`"));
            }
        }
    }
    Ok(())
}

fn picture(file: &Path, channel: Option<Channel>, stack: &mut Stack) -> Result<()> {
    push(file, &bitmap::read(file)?, channel, stack)
}

fn pages(file: &Path, channel: Option<Channel>, stack: &mut Stack) -> Result<()> {
    tagged::read(file, |picture| push(file, &picture, channel, stack))
}

fn array(file: &Path, _: Option<Channel>, stack: &mut Stack) -> Result<()> {
    let array = read_npy(file, &["<u2", "|u1", "<u4"], "[frame, row, column]")?;
    let [_, height, width] = array.shape[..] else {
        return Err(Problem::in_file(file, "is not a stack").expected("an array [frame, row, column]"));
    };
    let geometry = Geometry { width, height };
    for frame in array.values.chunks(geometry.pixels().max(1)) {
        stack.push(file, geometry, frame.iter().map(|&value| f64::from(value)))?;
    }
    Ok(())
}

fn push(file: &Path, picture: &Picture, channel: Option<Channel>, stack: &mut Stack) -> Result<()> {
    let grey = grey(file, picture, channel)?;
    stack.push(file, picture.geometry, grey)
}

/// One number a pixel.
fn grey<'a>(
    file: &Path,
    picture: &'a Picture,
    channel: Option<Channel>,
) -> Result<impl Iterator<Item = f64> + 'a> {
    let channels = picture.channels.max(1);
    let refuse = |pixel: usize, what: &str| {
        let (row, column) = picture.geometry.row_column(pixel);
        let sample = &picture.samples[pixel * channels..][..channels];
        Problem::in_file(file, format_args!("{what}: {sample:?} at row {row}, column {column}"))
            .expected("grey of 8 or 16 bits a pixel")
            .remedy("save it as grey, or say which colour is the code: --channel red, green or blue")
    };
    let in_colour = channels >= 3;
    if channel.is_none() {
        let mut pixels = picture.samples.chunks_exact(channels);
        if let Some(pixel) =
            pixels.position(|sample| in_colour && (sample[0] != sample[1] || sample[1] != sample[2]))
        {
            return Err(refuse(pixel, "is in colour"));
        }
        // The same transparency everywhere says nothing.
        let first = picture.samples.get(channels - 1).copied();
        let mut pixels = picture.samples.chunks_exact(channels);
        if channels.is_multiple_of(2)
            && let Some(pixel) = pixels.position(|sample| sample.last().copied() != first)
        {
            return Err(refuse(pixel, "is transparent in places"));
        }
    }
    let taken = if in_colour { channel.map_or(0, |channel| channel as usize) } else { 0 };
    Ok(picture.samples.iter().skip(taken).step_by(channels).map(|&sample| f64::from(sample)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(
        channels: usize,
        samples: &[u32],
        channel: Option<Channel>,
    ) -> std::result::Result<Vec<f64>, String> {
        let geometry = Geometry { width: 1, height: samples.len() / channels };
        let picture = Picture { geometry, channels, samples: samples.to_vec() };
        grey(Path::new("a.png"), &picture, channel).map(Iterator::collect).map_err(|error| error.to_string())
    }

    #[test]
    fn equal_colours_are_grey_and_others_are_chosen() {
        assert_eq!(of(1, &[3, 4], None), Ok(vec![3.0, 4.0]));
        assert_eq!(of(3, &[3, 3, 3, 4, 4, 4], None), Ok(vec![3.0, 4.0]));
        let refusal = of(3, &[3, 3, 3, 4, 4, 5], None).unwrap_err();
        assert!(refusal.contains("is in colour: [4, 4, 5] at row 1, column 0"), "{refusal}");
        assert!(refusal.contains("--channel"), "{refusal}");
        for (channel, expected) in [(Channel::Red, 7.0), (Channel::Green, 8.0), (Channel::Blue, 9.0)] {
            assert_eq!(of(3, &[7, 8, 9], Some(channel)), Ok(vec![expected]));
            assert_eq!(of(4, &[7, 8, 9, 1], Some(channel)), Ok(vec![expected]));
        }
    }

    #[test]
    fn transparency_is_nothing_unless_it_differs() {
        assert_eq!(of(2, &[3, 255, 4, 255], None), Ok(vec![3.0, 4.0]));
        assert!(of(2, &[3, 255, 4, 254], None).unwrap_err().contains("transparent in places"));
        assert_eq!(of(2, &[3, 255, 4, 254], Some(Channel::Blue)), Ok(vec![3.0, 4.0]));
    }
}
