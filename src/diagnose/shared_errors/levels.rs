//! Levels: which samples share an error, and in which way they are off together.

/// Which samples share an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Level {
    /// All of a set.
    Set,
    /// All of a frame.
    Frame,
    /// A row of a frame.
    Row,
    /// A column of a frame.
    Column,
    /// Two by two pixels of a frame.
    Neighbours,
    /// None.
    Pixel,
    /// A row in all frames of a set.
    RowOfSet,
    /// A column in all frames of a set.
    ColumnOfSet,
}

impl Level {
    /// What shares an error, in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Set => "set",
            Self::Frame => "frame",
            Self::Row => "row",
            Self::Column => "column",
            Self::Neighbours => "few neighbours",
            Self::Pixel => "pixel",
            Self::RowOfSet => "row of a set",
            Self::ColumnOfSet => "column of a set",
        }
    }
}

/// All levels.
pub const LEVELS: [Level; 8] = [
    Level::Set,
    Level::Frame,
    Level::Row,
    Level::Column,
    Level::Neighbours,
    Level::Pixel,
    Level::RowOfSet,
    Level::ColumnOfSet,
];

/// In which way samples may be off together: by so much light (DN), in proportion to the signal, in phase (rad), as if the target
/// were where it is at another time (s), or, of a set, at another place (m), or, of a set too, with another velocity (m/s), or in proportion to the camera's own light.
pub const MODES: [&str; 6] = ["offset", "gain", "phase", "position", "velocity", "light"];
/// Of [`MODES`], the phase.
pub const PHASE: usize = 2;
/// Of [`MODES`], the position.
pub const POSITION: usize = 3;
/// Of [`MODES`], the velocity.
pub const VELOCITY: usize = 4;
/// Of [`MODES`], the camera's own light.
pub const LIGHT: usize = 5;
