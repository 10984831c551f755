//! The vocabulary that travels between modules: a sensor's geometry and its raw frames.

/// The sensor's pixels: `width` columns by `height` rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Geometry {
    /// Pixels in a line.
    pub width: usize,
    /// Lines in a frame.
    pub height: usize,
}

impl Geometry {
    /// Pixels in a frame.
    pub fn pixels(self) -> usize {
        self.width * self.height
    }

    /// Row and column of the pixel that arrives as number `pixel` of a frame.
    pub fn row_column(self, pixel: usize) -> (usize, usize) {
        (pixel / self.width, pixel % self.width)
    }

    /// The up to four neighbours of a pixel: left, right, above, below.
    pub fn beside(self, pixel: usize) -> [Option<usize>; 4] {
        let (row, column) = self.row_column(pixel);
        [
            (column > 0).then(|| pixel - 1),
            (column + 1 < self.width).then(|| pixel + 1),
            (row > 0).then(|| pixel - self.width),
            (row + 1 < self.height).then(|| pixel + self.width),
        ]
    }

    /// The up to four neighbours at its corners.
    pub fn diagonal(self, pixel: usize) -> [Option<usize>; 4] {
        let [left, right, above, below] = self.beside(pixel);
        let at = |row: Option<usize>, column: Option<usize>| Some(row? + column? - pixel);
        [at(above, left), at(above, right), at(below, left), at(below, right)]
    }
}

/// Raw codes of whole sets, in C order `[set, frame, row, column]`, in DN.
///
/// A set is the raw frames of one phase measurement.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RawSets {
    geometry: Geometry,
    frames_per_set: usize,
    codes: Vec<u32>,
}

impl RawSets {
    /// Wraps `codes`, whose length must be a whole number of sets; `None` where it is not.
    pub fn new(geometry: Geometry, frames_per_set: usize, codes: Vec<u32>) -> Option<Self> {
        let set = geometry.pixels() * frames_per_set;
        (set > 0 && codes.len().is_multiple_of(set)).then_some(Self { geometry, frames_per_set, codes })
    }

    /// The sensor's size.
    pub fn geometry(&self) -> Geometry {
        self.geometry
    }

    /// Raw frames in a set.
    pub fn frames_per_set(&self) -> usize {
        self.frames_per_set
    }

    /// Number of sets.
    pub fn sets(&self) -> usize {
        self.codes.len() / (self.geometry.pixels() * self.frames_per_set)
    }

    /// The codes of frame `frame` of set `set`, row by row.
    pub fn frame(&self, set: usize, frame: usize) -> &[u32] {
        let pixels = self.geometry.pixels();
        let start = (set * self.frames_per_set + frame) * pixels;
        &self.codes[start..start + pixels]
    }

    /// All codes in C order `[set, frame, row, column]`.
    pub fn codes(&self) -> &[u32] {
        &self.codes
    }

    /// The first `sets` sets (all where there are fewer).
    #[must_use]
    pub fn first_sets(mut self, sets: usize) -> Self {
        self.codes.truncate(sets * self.frames_per_set * self.geometry.pixels());
        self
    }
}
