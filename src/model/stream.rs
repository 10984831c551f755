//! The raw stream: one beat a pixel, as AXI4-Stream carries it; and what else happens to the core beside it.

use super::registers::Access;
use crate::frames::RawSets;

/// One accepted beat of the input stream.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Beat {
    /// Raw code, DN (`tdata`).
    pub code: u32,
    /// First pixel of a frame (`tuser[0]`).
    pub start_of_frame: bool,
    /// First pixel of a set's first frame (`tuser[1]`).
    pub start_of_set: bool,
    /// Last pixel of a line (`tlast`).
    pub end_of_line: bool,
    /// The set is of the second modulation frequency (`tuser[2]`, where the pipeline unwraps); looked at with the start of set.
    pub second_frequency: bool,
}

/// What can happen to the core.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StreamEvent {
    /// A beat is accepted.
    Beat(Beat),
    /// Nothing arrives for exactly so many clocks.
    Pause {
        /// How many, 1 to 65535.
        clocks: u32,
    },
    /// Nothing arrives until everything that is due has come out.
    Rest,
    /// A processor begins to access a register; the stream does not wait for it. A core without registers knows nothing of it.
    Access(Access),
    /// The core is reset.
    Reset,
}

/// The beats of set `set` of `raw`, frame after frame.
pub fn beats_of_set(raw: &RawSets, set: usize) -> impl Iterator<Item = Beat> + '_ {
    let width = raw.geometry().width;
    (0..raw.frames_per_set()).flat_map(move |frame| {
        raw.frame(set, frame).iter().enumerate().map(move |(pixel, &code)| Beat {
            code,
            start_of_frame: pixel == 0,
            start_of_set: pixel == 0 && frame == 0,
            end_of_line: pixel % width == width - 1,
            second_frequency: false,
        })
    })
}
