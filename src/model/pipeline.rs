//! The whole pipeline: from the raw stream to results, with what every stage held on the way.

use super::accumulator::{Accumulator, Sums};
use super::framing::Framing;
use super::registers::{Access, Answer, Registers};
use super::sequencer::{NextFrame, next_frame};
use super::stream::StreamEvent;
use super::unwrapping::PhaseMemory;
use super::{amplitude, distance, offset, turn};
use crate::spec::Pipeline;

/// What the stages held for one pixel of one set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PixelRecord {
    /// Accumulator: the sums as they drain.
    pub sums: Sums,
    /// Phase, a fraction of a turn in the phase word.
    pub phase: i64,
    /// Amplitude, in its unit.
    pub amplitude: i64,
    /// Offset, in its unit.
    pub offset: i64,
    /// Distance, in its unit; of the unwrapped phase where the pipeline unwraps.
    pub distance: i64,
    /// Unwrapped phase, in its unit; 0 where there is none.
    pub unwrapped: i64,
    /// Whether there is an unwrapped phase.
    pub unambiguous: bool,
    /// Whether there is a phase: a vector, and not weaker than the specification's minimum.
    pub valid: bool,
}

/// A pixel's results from its sums, without what takes the set before: unwrapped phase and, where there is one, distance.
pub fn pixel(pipeline: &Pipeline, sums: Sums) -> PixelRecord {
    let turned = turn(&pipeline.derived().angle, sums.in_phase, sums.quadrature);
    let amplitude = amplitude(pipeline, turned.length, turned.shift, turned.zero);
    PixelRecord {
        sums,
        phase: turned.phase,
        amplitude,
        offset: offset(pipeline, sums.offset),
        distance: if pipeline.derived().unwrapper.is_some() { 0 } else { distance(pipeline, turned.phase) },
        unwrapped: 0,
        unambiguous: false,
        valid: !turned.zero && amplitude >= pipeline.derived().minimum_amplitude,
    }
}

/// The core as a whole, event by event.
#[derive(Debug, Clone)]
pub struct PipelineModel<'a> {
    pipeline: &'a Pipeline,
    framing: Framing,
    accumulator: Accumulator<'a>,
    registers: Registers<'a>,
    phase_memory: Option<PhaseMemory<'a>>,
    announced: Option<NextFrame>,
}

impl<'a> PipelineModel<'a> {
    /// The core after reset.
    pub fn new(pipeline: &'a Pipeline) -> Self {
        Self {
            pipeline,
            framing: Framing::new(pipeline),
            accumulator: Accumulator::new(pipeline),
            registers: Registers::new(pipeline),
            phase_memory: PhaseMemory::of(pipeline),
            announced: None,
        }
    }

    /// Advances by one event; the pixels of a set, in order, where the event completes one.
    pub fn advance(&mut self, event: StreamEvent) -> Option<Vec<PixelRecord>> {
        let outcome = self.framing.advance(event);
        self.announced = outcome.next.map(|frame| next_frame(self.pipeline, frame));
        if event == StreamEvent::Reset {
            self.registers = Registers::new(self.pipeline);
        }
        let set = outcome.commit.then(|| self.set(outcome.second_frequency, outcome.partner));
        if let (Some(slot), StreamEvent::Beat(beat)) = (outcome.slot, event) {
            self.accumulator.add(slot, beat.code);
        }
        set
    }

    /// The pixels of the set that the accumulator holds, in order.
    fn set(&mut self, second: bool, partner: bool) -> Vec<PixelRecord> {
        let mut set: Vec<_> =
            self.accumulator.sums().iter().map(|&sums| pixel(self.pipeline, sums)).collect();
        if let Some(memory) = &mut self.phase_memory {
            for (address, record) in set.iter_mut().enumerate() {
                let unwrapped = memory.unwrap_pixel(address, record.phase, record.valid, second, partner);
                record.unambiguous = unwrapped.is_some();
                record.unwrapped = unwrapped.unwrap_or(0);
                record.distance = distance(self.pipeline, record.unwrapped);
            }
        }
        set
    }

    /// What the last event made the sequencer tell the modulation hardware, where it did; after a reset that is the set's first
    /// frame, until something else is told.
    pub fn announced(&self) -> Option<NextFrame> {
        self.announced
    }

    /// The answer of the register block to `access`.
    pub fn answer(&mut self, access: Access) -> Answer {
        self.registers.answer(access)
    }

    /// Complete and discarded sets since reset.
    pub fn counters(&self) -> (u32, u32) {
        (self.framing.sets_done, self.framing.sets_discarded)
    }
}
