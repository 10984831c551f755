//! Sequencer: which phase step the next raw frame must have, and which one a frame that arrives has.
//!
//! The order is the specification's. What the modulation hardware is told follows framing: a frame that begins calls for the
//! one after it, and a set that is lost calls for the first frame of another.

use crate::spec::Pipeline;

/// What the modulation hardware is told about the next raw frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NextFrame {
    /// The scheme's phase step.
    pub step: usize,
    /// Its phase, in 2^−`phase_step_bits` of a turn.
    pub phase: i64,
    /// Whether it is a set's first frame, whose first pixel carries the start of set.
    pub first: bool,
}

/// What is told where frame number `frame` of a set (from 0) is to come next.
pub fn next_frame(pipeline: &Pipeline, frame: usize) -> NextFrame {
    let modulation = &pipeline.modulation;
    let step = modulation.step_at(frame / modulation.frames_per_step);
    NextFrame { step, phase: modulation.step_phase_code(step), first: frame == 0 }
}
