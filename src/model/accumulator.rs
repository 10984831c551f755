//! Accumulator: in-phase, quadrature and offset sums of every pixel, added while frames arrive.

use super::framing::PixelSlot;
use crate::spec::Pipeline;

/// The sums of one pixel, as the memory holds them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Sums {
    /// Σ in-phase weight · code.
    pub in_phase: i64,
    /// Σ quadrature weight · code.
    pub quadrature: i64,
    /// Σ offset weight · code.
    pub offset: i64,
    /// A sample of any frame was saturated.
    pub saturated: bool,
}

/// The sum memory with its adders.
#[derive(Debug, Clone)]
pub struct Accumulator<'a> {
    pipeline: &'a Pipeline,
    memory: Vec<Sums>,
}

impl<'a> Accumulator<'a> {
    /// A memory of all the sensor's pixels. Its contents do not matter: a set's first frame replaces them.
    pub fn new(pipeline: &'a Pipeline) -> Self {
        Self { pipeline, memory: vec![Sums::default(); pipeline.geometry().pixels()] }
    }

    /// Adds the sample `code` (clipped to full scale) at `slot`.
    pub fn add(&mut self, slot: PixelSlot, code: u32) {
        let derived = self.pipeline.derived();
        let scheme = &self.pipeline.modulation.scheme;
        let sample = i64::from(code).min(derived.sample.max());
        let before = if slot.first_frame { Sums::default() } else { self.memory[slot.address] };
        let after = Sums {
            in_phase: before.in_phase + scheme.in_phase[slot.step] * sample,
            quadrature: before.quadrature + scheme.quadrature[slot.step] * sample,
            offset: before.offset + scheme.offset[slot.step] * sample,
            saturated: before.saturated || sample >= self.pipeline.sensor.saturation_dn,
        };
        debug_assert!(derived.in_phase.contains(after.in_phase));
        debug_assert!(derived.quadrature.contains(after.quadrature));
        debug_assert!(derived.offset_sum.contains(after.offset));
        self.memory[slot.address] = after;
    }

    /// The sums of all pixels, in the order in which they drain.
    pub fn sums(&self) -> &[Sums] {
        &self.memory
    }
}
