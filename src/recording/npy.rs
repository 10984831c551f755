//! Reading `.npy` files of unsigned codes, with nothing trusted: neither header nor length.

use crate::problem::{Problem, Result};
use npyz::{DType, NpyHeader, Order};
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

/// An array of unsigned numbers in C order.
#[derive(Debug, Clone, PartialEq)]
pub struct Codes {
    /// Size of each axis, at least 1.
    pub shape: Vec<usize>,
    /// The numbers, as many as the product of the shape.
    pub values: Vec<u32>,
}

/// Longest header that is read, bytes; numpy's own are 118.
const LONGEST_HEADER: u64 = 1 << 16;
/// Bytes decoded at a time: few enough to stay in the processor's cache.
const CHUNK: usize = 1 << 16;

/// Reads the array at `path`, whose type must be one of `allowed` (`<u2`, …) and whose number of axes that of `axes` (`[frame, row, column]`).
///
/// # Errors
/// A file that is not there, no array, of another type, order or number of axes, empty, or not as long as it says.
pub fn read(path: &Path, allowed: &[&str], axes: &str) -> Result<Codes> {
    let io = |error: &std::io::Error| Problem::io(path, "read", error);
    let mut file = File::open(path).map_err(|error| io(&error))?;
    let metadata = file.metadata().map_err(|error| io(&error))?;
    if !metadata.is_file() {
        return Err(Problem::in_file(path, "is not a file").expected("an array in numpy's .npy format"));
    }
    let mut start = Vec::new();
    file.by_ref().take(LONGEST_HEADER).read_to_end(&mut start).map_err(|error| io(&error))?;
    let (header, data_start) = header(path, &start)?;

    let dtype = match header.dtype() {
        DType::Plain(plain) => plain.to_string(),
        structured => structured.descr(),
    };
    let one_of = allowed.join(" or ");
    let example = allowed[0];
    if !allowed.contains(&dtype.as_str()) {
        return Err(Problem::in_file(path, format_args!("its numbers are of type {dtype}"))
            .expected(format_args!("type {one_of}: unsigned, little-endian"))
            .remedy(format_args!("save it with array.astype('{example}'), once its values fit")));
    }
    if header.order() == Order::Fortran {
        return Err(Problem::in_file(path, "its data are in Fortran order")
            .expected(format_args!("C order, {axes}"))
            .remedy("save it with numpy.ascontiguousarray(array)"));
    }
    let shape = header.shape();
    if shape.len() != axes.split(',').count() || shape.contains(&0) {
        return Err(Problem::in_file(path, format_args!("its shape is {}", shown(shape)))
            .expected(format_args!("{axes}, at least 1 of each"))
            .remedy("save it with array.reshape(…)"));
    }

    let item = if dtype.ends_with('1') {
        1
    } else if dtype.ends_with('2') {
        2
    } else {
        4
    };
    // The header's digits are bounded, so that this product and its bytes fit.
    let count = header.len();
    let (held, needed) = (metadata.len().saturating_sub(data_start), u128::from(count) * item as u128);
    if u128::from(held) != needed {
        let (what, remedy) = if u128::from(held) < needed {
            ("is truncated", "copy or save it again")
        } else {
            ("has trailing data", "save one array a file")
        };
        return Err(Problem::in_file(path, format_args!("{what}: {held} bytes after its header"))
            .expected(format_args!("{needed} bytes for the shape {} of {dtype}", shown(shape)))
            .remedy(remedy));
    }
    let mut values = Vec::new();
    values.try_reserve_exact(count as usize).map_err(|_| {
        Problem::in_file(path, format_args!("{count} codes do not fit into memory"))
            .remedy("split the recording")
    })?;
    file.seek(SeekFrom::Start(data_start)).map_err(|error| io(&error))?;
    let mut chunk = vec![0; CHUNK];
    while values.len() < count as usize {
        let bytes = &mut chunk[..CHUNK.min((count as usize - values.len()) * item)];
        file.read_exact(bytes).map_err(|error| io(&error))?;
        match item {
            1 => values.extend(bytes.iter().map(|&byte| u32::from(byte))),
            2 => values.extend(bytes.as_chunks().0.iter().map(|&pair| u32::from(u16::from_le_bytes(pair)))),
            _ => values.extend(bytes.as_chunks().0.iter().map(|&four| u32::from_le_bytes(four))),
        }
    }
    Ok(Codes { shape: shape.iter().map(|&size| size as usize).collect(), values })
}

/// A shape as numpy prints it.
fn shown(shape: &[u64]) -> String {
    format!("({})", shape.iter().map(u64::to_string).collect::<Vec<_>>().join(", "))
}

/// The header at the start of a file, and where the data begin.
fn header(path: &Path, start: &[u8]) -> Result<(NpyHeader, u64)> {
    let refuse = |found: &str| {
        Problem::in_file(path, found)
            .expected("an array in numpy's .npy format, version 1 to 3")
            .remedy("save it with numpy.save")
    };
    let (text_start, text_length) = match start {
        [0x93, b'N', b'U', b'M', b'P', b'Y', 1, _, a, b, ..] => (10, u32::from_le_bytes([*a, *b, 0, 0])),
        [0x93, b'N', b'U', b'M', b'P', b'Y', 2 | 3, _, a, b, c, d, ..] => {
            (12, u32::from_le_bytes([*a, *b, *c, *d]))
        }
        [0x93, b'N', b'U', b'M', b'P', b'Y', ..] => return Err(refuse("is of an unknown version of .npy")),
        _ => return Err(refuse("is not an .npy file")),
    };
    let data_start = text_start + text_length as usize;
    let Some(text) = start.get(text_start..data_start) else {
        return Err(refuse("its header is truncated or too long"));
    };
    if !is_plain(text) {
        return Err(refuse("its header is not that of a plain array"));
    }
    let header = NpyHeader::from_reader(&start[..data_start])
        .map_err(|error| refuse(&format!("its header cannot be read: {error}")))?;
    Ok((header, data_start as u64))
}

/// Whether the header's text is safe to parse: no escapes, little nesting (the parser is recursive), and no more than
/// 19 digits, which keep the product of all sizes below 10^19 and so within 64 bits.
fn is_plain(text: &[u8]) -> bool {
    let count = |is: fn(&u8) -> bool| text.iter().filter(|byte| is(byte)).count();
    text.is_ascii()
        && !text.contains(&b'\\')
        && count(|byte| matches!(byte, b'(' | b'[' | b'{')) <= 8
        && count(u8::is_ascii_digit) <= 19
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const GOOD: &[u8] = b"{'descr': '<u2', 'fortran_order': False, 'shape': (1, 2, 2, 3), }\n";

    fn file(text: &[u8], data: &[u8]) -> Vec<u8> {
        [b"\x93NUMPY\x01\x00", &(text.len() as u16).to_le_bytes()[..], text, data].concat()
    }

    proptest! {
        /// Whatever a header holds, it is read or refused.
        #[test]
        fn no_header_panics(changes in proptest::collection::vec((0..GOOD.len(), any::<u8>()), 0..6), cut in 0usize..100) {
            let mut text = GOOD.to_vec();
            for (at, byte) in changes {
                text[at] = byte;
            }
            let mut bytes = file(&text, &[0; 24]);
            bytes.truncate(bytes.len() - cut.min(bytes.len()));
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("frames.npy");
            std::fs::write(&path, bytes).unwrap();
            let _ = read(&path, &["<u2", "<u4"], "[set, frame, row, column]");
        }
    }

    #[test]
    fn headers_that_would_exhaust_stack_or_word_are_refused() {
        let deep = [b"(".repeat(30_000), b")".repeat(30_000)].concat();
        let wide =
            b"{'descr': '<u2', 'fortran_order': False, 'shape': (4294967296, 4294967296, 4294967296, 1), }\n";
        for text in [&deep[..], &wide[..]] {
            let problem = header(Path::new("frames.npy"), &file(text, &[])).err().unwrap();
            assert!(problem.to_string().contains("not that of a plain array"));
        }
    }
}
