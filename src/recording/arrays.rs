//! Writing results: named `.npy` arrays in a folder that appears whole or not at all.
//!
//! The folder carries [`MANIFEST`], by which a later run knows that it may replace it. Nothing else is ever replaced:
//! not a folder without the manifest, and not one in which somebody has put a file of their own.

use super::staging::Staging;
use crate::problem::{Problem, Result};
use npyz::WriterBuilder;
use std::fs::{self, File};
use std::io::BufWriter;
use std::path::Path;

/// The file that marks a folder of results.
pub const MANIFEST: &str = "vuris-process.toml";
const FORMAT: &str = "vuris-process/1";

/// Numbers of an array, in C order, of the type in which they are written.
#[derive(Debug, Clone, PartialEq)]
pub enum Numbers {
    /// `|u1`
    U8(Vec<u8>),
    /// `<u2`
    U16(Vec<u16>),
    /// `<u4`
    U32(Vec<u32>),
    /// `<f4`
    F32(Vec<f32>),
    /// `<f8`
    F64(Vec<f64>),
}

impl Numbers {
    /// Codes of an unsigned register of `bits` bits, 1 to 32, in the narrowest type that holds them; a code outside the
    /// register saturates.
    pub fn codes(bits: u32, codes: impl IntoIterator<Item = i64>) -> Self {
        let codes = codes.into_iter();
        match bits {
            0..=8 => Self::U8(codes.map(|code| code.clamp(0, 0xff) as u8).collect()),
            9..=16 => Self::U16(codes.map(|code| code.clamp(0, 0xffff) as u16).collect()),
            _ => Self::U32(codes.map(|code| code.clamp(0, 0xffff_ffff) as u32).collect()),
        }
    }

    /// How many numbers there are.
    pub fn count(&self) -> usize {
        match self {
            Self::U8(numbers) => numbers.len(),
            Self::U16(numbers) => numbers.len(),
            Self::U32(numbers) => numbers.len(),
            Self::F32(numbers) => numbers.len(),
            Self::F64(numbers) => numbers.len(),
        }
    }
}

/// An array to be written as `name.npy`.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedArray {
    /// Lower case letters, digits and `_`, such as `phase_code`.
    pub name: String,
    /// Size of each axis, such as `[set, row, column]`; the product is the number of numbers.
    pub shape: Vec<usize>,
    /// The numbers.
    pub numbers: Numbers,
}

/// Writes `arrays` into the new folder `folder`, with a manifest that lists them and repeats `provenance` (fields that
/// say what the results were made from; `format` and `files` are the manifest's own).
///
/// A folder of earlier results is replaced.
///
/// # Errors
/// `folder` is something else than earlier results, holds a file that is not of them, or cannot be written; an array's
/// numbers are not as many as its shape says, or its name cannot be a file's. What stood there is untouched.
pub fn write_arrays(folder: &Path, arrays: &[NamedArray], provenance: &toml::Table) -> Result<()> {
    may_be_replaced(folder)?;
    let staging = Staging::beside(folder)?;
    let mut files = Vec::new();
    for array in arrays {
        let file = format!("{}.npy", array.name);
        let is_name = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        if array.name.is_empty() || !array.name.chars().all(is_name) || files.contains(&file) {
            return Err(Problem::in_file(folder, format_args!("an array is called \"{}\"", array.name))
                .expected("lower case letters, digits and _, each name once"));
        }
        let shape: Vec<u64> = array.shape.iter().map(|&size| size as u64).collect();
        write_npy(&staging.path().join(&file), &shape, &array.numbers).map_err(|error| {
            Problem::io(&folder.join(&file), "write", &error).expected(format_args!(
                "room for {} numbers of shape {:?}",
                array.numbers.count(),
                array.shape
            ))
        })?;
        files.push(file);
    }
    let mut manifest = provenance.clone();
    manifest.insert("format".to_owned(), FORMAT.into());
    manifest.insert("files".to_owned(), files.into());
    let text = format!(
        "# Written by vuris. While this folder holds only these files, a later run may replace it.\n{manifest}"
    );
    staging.write_text(MANIFEST, &text)?;
    staging.publish()
}

/// Writes one array.
pub(super) fn write_npy(path: &Path, shape: &[u64], numbers: &Numbers) -> std::io::Result<()> {
    fn write<T: npyz::AutoSerialize + Copy>(
        path: &Path,
        shape: &[u64],
        numbers: &[T],
    ) -> std::io::Result<()> {
        if shape.iter().product::<u64>() != numbers.len() as u64 {
            return Err(std::io::Error::other("the array's numbers are not as many as its shape says"));
        }
        let file = BufWriter::new(File::create_new(path)?);
        let mut writer = npyz::WriteOptions::new().default_dtype().shape(shape).writer(file).begin_nd()?;
        writer.extend(numbers.iter().copied())?;
        writer.finish()
    }
    match numbers {
        Numbers::U8(numbers) => write(path, shape, numbers),
        Numbers::U16(numbers) => write(path, shape, numbers),
        Numbers::U32(numbers) => write(path, shape, numbers),
        Numbers::F32(numbers) => write(path, shape, numbers),
        Numbers::F64(numbers) => write(path, shape, numbers),
    }
}

/// Refuses a target that is there and is not, in whole, what an earlier run has written.
pub fn may_be_replaced(folder: &Path) -> Result<()> {
    let Ok(metadata) = folder.symlink_metadata() else { return Ok(()) };
    let refuse = |found: &str| {
        Problem::in_file(folder, found)
            .expected(format_args!("a new or empty folder, or one of earlier results (with {MANIFEST})"))
            .remedy("choose another folder for the output, or move this one away")
    };
    if !metadata.is_dir() {
        return Err(refuse("is there and is not a folder"));
    }
    let mut entries = fs::read_dir(folder).map_err(|error| Problem::io(folder, "read", &error))?;
    if entries.next().is_none() {
        return Ok(());
    }
    let manifest = fs::read_to_string(folder.join(MANIFEST)).ok().and_then(|text| text.parse().ok());
    let manifest: toml::Table = manifest.ok_or_else(|| refuse("is there and was not written by vuris"))?;
    let files = manifest.get("files").and_then(toml::Value::as_array);
    let (Some(FORMAT), Some(files)) = (manifest.get("format").and_then(toml::Value::as_str), files) else {
        return Err(refuse(&format!("its {MANIFEST} is not of the format {FORMAT}")));
    };
    let entries = fs::read_dir(folder).map_err(|error| Problem::io(folder, "read", &error))?;
    for entry in entries {
        let entry = entry.map_err(|error| Problem::io(folder, "read", &error))?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let listed = name == MANIFEST || files.iter().any(|file| file.as_str() == Some(&name));
        if !listed || !entry.file_type().is_ok_and(|kind| kind.is_file()) {
            return Err(refuse(&format!("holds \"{name}\", which vuris did not write")));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn array(name: &str, numbers: Numbers) -> NamedArray {
        NamedArray { name: name.to_owned(), shape: vec![1, 2, 2], numbers }
    }

    fn listing(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn types_fit_the_register_and_shapes_survive() {
        let home = tempfile::tempdir().unwrap();
        let out = home.path().join("out");
        let arrays = [
            array("valid", Numbers::codes(1, [0, 1, 1, 0])),
            array("amplitude_code", Numbers::codes(16, [0, 1, 65_535, 0])),
            array("phase_code", Numbers::codes(18, [0, 1, 262_143, 0])),
            array("range_m", Numbers::F64(vec![0.5, 1.5, 2.5, 3.5])),
        ];
        write_arrays(&out, &arrays, &toml::Table::new()).unwrap();
        for (name, descr) in
            [("valid", "|u1"), ("amplitude_code", "<u2"), ("phase_code", "<u4"), ("range_m", "<f8")]
        {
            let bytes = fs::read(out.join(format!("{name}.npy"))).unwrap();
            let file = npyz::NpyFile::new(&bytes[..]).unwrap();
            assert_eq!(file.dtype().descr(), format!("'{descr}'"));
            assert_eq!(file.shape(), [1, 2, 2]);
        }
        assert_eq!(listing(home.path()), ["out"], "nothing temporary is left");
    }

    #[test]
    fn earlier_results_are_replaced_as_a_whole() {
        let home = tempfile::tempdir().unwrap();
        let out = home.path().join("out");
        let provenance: toml::Table = "recording = \"four-rail\"".parse().unwrap();
        write_arrays(&out, &[array("a", Numbers::codes(8, [1, 2, 3, 4]))], &provenance).unwrap();
        write_arrays(&out, &[array("b", Numbers::codes(8, [1, 2, 3, 4]))], &provenance).unwrap();
        assert_eq!(listing(&out), ["b.npy", MANIFEST]);
        assert!(fs::read_to_string(out.join(MANIFEST)).unwrap().contains("four-rail"));
    }

    #[test]
    fn a_failure_leaves_what_stood_there() {
        let home = tempfile::tempdir().unwrap();
        let out = home.path().join("out");
        write_arrays(&out, &[array("a", Numbers::codes(8, [1, 2, 3, 4]))], &toml::Table::new()).unwrap();
        let before = fs::read(out.join("a.npy")).unwrap();
        let short = array("b", Numbers::F32(vec![1.0]));
        let good = array("a", Numbers::codes(8, [9, 9, 9, 9]));
        let problem = write_arrays(&out, &[good, short], &toml::Table::new()).unwrap_err().to_string();
        assert!(problem.contains("b.npy") && problem.contains("shape"), "{problem}");
        assert_eq!(fs::read(out.join("a.npy")).unwrap(), before);
        assert_eq!(listing(home.path()), ["out"], "nothing temporary is left");
    }

    #[test]
    fn what_vuris_did_not_write_is_never_replaced() {
        let home = tempfile::tempdir().unwrap();
        let result = [array("a", Numbers::codes(8, [1, 2, 3, 4]))];
        let refusal = |target: &Path| {
            write_arrays(target, &result, &toml::Table::new()).expect_err("must refuse").to_string()
        };
        let file = home.path().join("notes.txt");
        fs::write(&file, "mine").unwrap();
        assert!(refusal(&file).contains("is not a folder"));
        assert!(refusal(&file.join("out")).contains("cannot write"));
        assert!(refusal(&home.path().join("..")).contains("was not written by vuris"));
        assert_eq!(fs::read_to_string(&file).unwrap(), "mine");

        let folder = home.path().join("photographs");
        fs::create_dir(&folder).unwrap();
        fs::write(folder.join("1.raw"), "mine").unwrap();
        assert!(refusal(&folder).contains("was not written by vuris"));
        fs::remove_file(folder.join("1.raw")).unwrap();
        fs::write(folder.join(MANIFEST), "format = \"other/1\"").unwrap();
        assert!(refusal(&folder).contains(MANIFEST));

        let out = home.path().join("out");
        write_arrays(&out, &result, &toml::Table::new()).unwrap();
        fs::write(out.join("notes.txt"), "mine").unwrap();
        assert!(refusal(&out).contains("notes.txt"));
        assert_eq!(fs::read_to_string(out.join("notes.txt")).unwrap(), "mine");
    }
}
