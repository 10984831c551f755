//! Frames of one size, one after the other, in codes.

use super::codes::{Code, Levels};
use crate::frames::Geometry;
use crate::problem::{Problem, Result};
use std::path::{Path, PathBuf};

/// A file, and how many frames it gave.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// The file.
    pub file: PathBuf,
    /// Frames that it holds, at least 1.
    pub frames: usize,
    /// Size of each.
    pub geometry: Geometry,
}

/// The frames that have been read so far.
#[derive(Debug, Clone, PartialEq)]
pub struct Stack {
    levels: Levels,
    codes: Vec<u32>,
    sources: Vec<Source>,
    rounded: usize,
    saturated: usize,
}

impl Stack {
    /// No frames yet; `levels` says how numbers become codes.
    pub fn new(levels: Levels) -> Self {
        Self { levels, codes: Vec::new(), sources: Vec::new(), rounded: 0, saturated: 0 }
    }

    /// Adds a frame of `file`, whose `numbers` are in C order `[row, column]`, as many as `geometry` has pixels.
    ///
    /// # Errors
    /// A frame of another size than those before; a number that is no code; no memory.
    pub(super) fn push(
        &mut self,
        file: &Path,
        geometry: Geometry,
        numbers: impl Iterator<Item = f64>,
    ) -> Result<()> {
        let frame = match self.sources.last() {
            Some(source) if source.file == file => source.frames,
            _ => 0,
        };
        if let Some(first) = self.sources.first()
            && first.geometry != geometry
        {
            let size = |of: Geometry| format!("{} x {} pixels", of.width, of.height);
            let which = if frame == 0 { String::new() } else { format!("frame {frame} ") };
            let found = format_args!("{which}has {}", size(geometry));
            return Err(Problem::in_file(file, found)
                .expected(format_args!("{}, as {} has", size(first.geometry), first.file.display()))
                .remedy("leave out one of them, or crop them to one size"));
        }
        self.codes.try_reserve(geometry.pixels()).map_err(|_| {
            Problem::in_file(file, format_args!("{} codes do not fit into memory", self.codes.len()))
                .remedy("import fewer frames at a time")
        })?;
        let before = self.codes.len();
        for (pixel, number) in numbers.enumerate() {
            let code = match self.levels.code(number) {
                Code::Good { code, rounded } => {
                    self.rounded += usize::from(rounded);
                    code
                }
                Code::Saturated(code) => {
                    self.saturated += 1;
                    code
                }
                bad => {
                    let (row, column) = geometry.row_column(pixel);
                    let found =
                        format_args!("the number {number} at frame {frame}, row {row}, column {column}");
                    return Err(self.levels.refuse(Problem::in_file(file, found), bad));
                }
            };
            self.codes.push(code);
        }
        if self.codes.len() - before != geometry.pixels() || geometry.pixels() == 0 {
            return Err(Problem::in_file(file, format_args!("{} pixels", self.codes.len() - before))
                .expected(format_args!("{} x {}, at least 1", geometry.width, geometry.height)));
        }
        match self.sources.last_mut() {
            Some(source) if source.file == file => source.frames += 1,
            _ => self.sources.push(Source { file: file.to_owned(), frames: 1, geometry }),
        }
        Ok(())
    }

    /// The files, in order.
    pub fn sources(&self) -> &[Source] {
        &self.sources
    }

    /// How many frames there are.
    pub fn frames(&self) -> usize {
        self.sources.iter().map(|source| source.frames).sum()
    }

    /// Size of a frame; `None` while there is none.
    pub fn geometry(&self) -> Option<Geometry> {
        self.sources.first().map(|source| source.geometry)
    }

    /// All codes, in C order `[frame, row, column]`.
    pub fn codes(&self) -> &[u32] {
        &self.codes
    }

    /// How many numbers were no whole codes after scaling, and were rounded.
    pub fn rounded(&self) -> usize {
        self.rounded
    }

    /// How many codes were at or above the saturation code.
    pub fn saturated(&self) -> usize {
        self.saturated
    }
}
