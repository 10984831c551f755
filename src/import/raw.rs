//! Flat dumps: numbers of one type, frame by frame, row by row, behind a header that is skipped.

use super::stack::Stack;
use crate::frames::Geometry;
use crate::problem::{Problem, Result};
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// The type of a dump's numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Number {
    /// Unsigned, 1 byte.
    U8,
    /// Unsigned, 2 bytes.
    U16,
    /// Two's complement, 2 bytes.
    I16,
    /// Unsigned, 4 bytes.
    U32,
    /// IEEE 754, 4 bytes.
    F32,
}

/// Which byte of a number comes first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ByteOrder {
    /// The least significant.
    Little,
    /// The most significant.
    Big,
}

/// How a dump is laid out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RawLayout {
    /// Frames in a file, at least 1.
    pub frames: usize,
    /// Size of a frame, at least 1 by 1.
    pub geometry: Geometry,
    /// Type of the numbers.
    pub number: Number,
    /// Order of their bytes.
    pub byte_order: ByteOrder,
    /// Bytes before the first number.
    pub offset: u64,
}

impl Number {
    /// Bytes of one.
    pub fn bytes(self) -> usize {
        match self {
            Self::U8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// The number in `little`, of whose bytes the least significant is the first; all types are exact in 64 bits.
    fn value(self, little: [u8; 4]) -> f64 {
        let [a, b, ..] = little;
        match self {
            Self::U8 => f64::from(a),
            Self::U16 => f64::from(u16::from_le_bytes([a, b])),
            Self::I16 => f64::from(i16::from_le_bytes([a, b])),
            Self::U32 => f64::from(u32::from_le_bytes(little)),
            Self::F32 => f64::from(f32::from_le_bytes(little)),
        }
    }
}

impl RawLayout {
    /// Bytes of a file that is laid out so; `None` where they are more than can be counted.
    fn file_bytes(&self) -> Option<u64> {
        let frame =
            self.geometry.width.checked_mul(self.geometry.height)?.checked_mul(self.number.bytes())?;
        (frame.checked_mul(self.frames)? as u64).checked_add(self.offset)
    }

    fn value(&self, bytes: &[u8]) -> f64 {
        let mut little = [0; 4];
        little[..bytes.len()].copy_from_slice(bytes);
        if self.byte_order == ByteOrder::Big {
            little[..bytes.len()].reverse();
        }
        self.number.value(little)
    }
}

/// Reads `files`, each laid out as `layout` says, into `stack`.
///
/// # Errors
/// A file that is not there, or longer or shorter than `layout` says; a number that is no code.
pub fn read_raw(files: &[PathBuf], layout: &RawLayout, stack: &mut Stack) -> Result<()> {
    files.iter().try_for_each(|file| read_one(file, layout, stack))
}

fn read_one(file: &Path, layout: &RawLayout, stack: &mut Stack) -> Result<()> {
    let io = |error: std::io::Error| Problem::io(file, "read", &error);
    let opened = File::open(file).map_err(io)?;
    let metadata = opened.metadata().map_err(io)?;
    if !metadata.is_file() {
        return Err(Problem::in_file(file, "is not a file").expected("a flat dump of numbers"));
    }
    let Geometry { width, height } = layout.geometry;
    let shape = format!("{},{height},{width}", layout.frames);
    let Some(needed) = layout.file_bytes() else {
        return Err(Problem::at("--shape", shape).expected("frames,rows,columns of a file that can exist"));
    };
    let held = metadata.len();
    if held != needed {
        let mut problem = Problem::in_file(file, format_args!("{held} bytes")).expected(format_args!(
            "{needed}: --shape {shape}, {} a number, behind --offset {}",
            layout.number.bytes(),
            layout.offset
        ));
        // A header is the usual reason for what is too much.
        if let Some(offset) = (held + layout.offset).checked_sub(needed).filter(|_| held > needed) {
            problem = problem.remedy(format_args!(
                "correct --shape or --type; or --offset {offset}, where the rest is a header"
            ));
        } else {
            problem = problem.remedy("correct --shape, --type or --offset, or copy the file again");
        }
        return Err(problem);
    }
    let mut reader = BufReader::new(opened);
    reader.seek(SeekFrom::Start(layout.offset)).map_err(io)?;
    let item = layout.number.bytes();
    let mut frame = vec![0; layout.geometry.pixels() * item];
    for _ in 0..layout.frames {
        reader.read_exact(&mut frame).map_err(io)?;
        stack.push(file, layout.geometry, frame.chunks_exact(item).map(|bytes| layout.value(bytes)))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_every_type_in_both_orders() {
        // Bytes by hand from the definitions: two's complement, IEEE 754 (1.5 = 0x3fc00000).
        let cases: [(Number, &[u8], f64); 5] = [
            (Number::U8, &[200], 200.0),
            (Number::U16, &[0x12, 0x34], 4660.0),
            (Number::I16, &[0xff, 0xfe], -2.0),
            (Number::U32, &[0xff, 0x00, 0x00, 0x01], 4_278_190_081.0),
            (Number::F32, &[0x3f, 0xc0, 0x00, 0x00], 1.5),
        ];
        for (number, big, expected) in cases {
            let geometry = Geometry { width: 1, height: 1 };
            let layout = RawLayout { frames: 1, geometry, number, byte_order: ByteOrder::Big, offset: 0 };
            assert_eq!(layout.value(big), expected);
            let little: Vec<u8> = big.iter().rev().copied().collect();
            assert_eq!(RawLayout { byte_order: ByteOrder::Little, ..layout }.value(&little), expected);
        }
    }
}
