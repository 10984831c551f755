//! Golden vectors: a scenario of the raw stream, and what the model says to it.

use crate::frames::RawSets;
use crate::model::{
    Access, Answer, Beat, NextFrame, PipelineModel, PixelRecord, ReadData, StreamEvent, beats_of_set,
};
use crate::spec::{Counter, Pipeline};

/// A named part of a scenario.
#[derive(Debug, Clone)]
pub struct Segment {
    /// What it tries, for messages.
    pub name: String,
    /// What happens on the stream.
    pub events: Vec<StreamEvent>,
}

impl Segment {
    /// All sets of `raw`, one after the other.
    pub fn of_sets(name: &str, raw: &RawSets) -> Self {
        let events = (0..raw.sets()).flat_map(|set| beats_of_set(raw, set)).map(StreamEvent::Beat).collect();
        Self { name: name.to_owned(), events }
    }
}

/// What drives the core, in order.
#[derive(Debug, Clone, Default)]
pub struct Scenario {
    /// Its parts.
    pub segments: Vec<Segment>,
}

impl Scenario {
    /// The same, with sets in turn at the first and the second modulation frequency; every fifth has that of the set before, so
    /// that it has no partner. Where no set starts, the mark comes and goes and means nothing.
    #[must_use]
    pub fn in_turn(mut self) -> Self {
        let (mut set, mut beat_number, mut second) = (0, 0_u32, true);
        for event in self.segments.iter_mut().flat_map(|segment| &mut segment.events) {
            let StreamEvent::Beat(beat) = event else { continue };
            beat_number = beat_number.wrapping_add(1);
            if beat.start_of_set && beat.start_of_frame {
                set += 1;
                second ^= set % 5 != 0;
                beat.second_frequency = second;
            } else {
                beat.second_frequency = beat_number.is_multiple_of(3);
            }
        }
        self
    }
}

/// One line of the stimulus: a beat, or an operation of the bench.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StimulusWord(pub u32);

/// Marks an operation instead of a beat.
const OPERATION: u32 = 8 << 16;

impl From<StreamEvent> for StimulusWord {
    /// `{second frequency, operation, end of line, start of set, start of frame, code[15:0]}`; operations: 9nnnn a pause of n clocks, a0000 reset,
    /// b0000 rest, c0000 the next access to a register begins.
    fn from(event: StreamEvent) -> Self {
        Self(match event {
            StreamEvent::Pause { clocks } => OPERATION | 1 << 16 | clocks.min(0xffff),
            StreamEvent::Reset => OPERATION | 2 << 16,
            StreamEvent::Rest => OPERATION | 3 << 16,
            StreamEvent::Access(_) => OPERATION | 4 << 16,
            StreamEvent::Beat(Beat { code, start_of_frame, start_of_set, end_of_line, second_frequency }) => {
                u32::from(second_frequency) << 20
                    | u32::from(end_of_line) << 18
                    | u32::from(start_of_set) << 17
                    | u32::from(start_of_frame) << 16
                    | code.min(0xffff)
            }
        })
    }
}

/// What a bench compares at a rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rest {
    /// Records that have come out by then.
    pub due: usize,
    /// Complete sets since the last reset.
    pub done: u32,
    /// Discarded sets since the last reset.
    pub discarded: u32,
}

/// An access to a register, and what it must give.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GoldenAccess {
    /// The access.
    pub access: Access,
    /// The answer.
    pub answer: Answer,
}

impl GoldenAccess {
    /// Words of an access in its file.
    pub const WORDS: usize = 3;

    /// The access as its file has it: `{write, okay, counter[3:0], strobes[3:0], address[7:0]}`, what is written, what is read.
    /// `counter` is 0 where a read gives a value, else 1 more than the counter's number.
    pub fn words(&self) -> [u64; Self::WORDS] {
        let (write, address, data, strobes) = match self.access {
            Access::Read { address } => (0, address, 0, 0),
            Access::Write { address, data, strobes } => (1, address, data, strobes),
        };
        let (counter, value) = match self.answer.data {
            ReadData::Value(value) => (0, value),
            ReadData::Counter(counter) => (counter.number() + 1, 0),
        };
        debug_assert!(Counter::ALL.len() < 15 && address < 256 && strobes < 16);
        let head = write << 17
            | u64::from(self.answer.okay) << 16
            | (counter as u64) << 12
            | u64::from(strobes) << 8
            | u64::from(address);
        [head, data.into(), value.into()]
    }
}

/// What is due before a reset, or at the end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Epoch {
    /// Records.
    pub records: usize,
    /// Announcements.
    pub announcements: usize,
}

/// A scenario with the model's answer.
#[derive(Debug, Clone, Default)]
pub struct Golden {
    /// The stimulus, with a last rest that lets the last set out.
    pub stimulus: Vec<StimulusWord>,
    /// Every pixel that comes out, in order.
    pub records: Vec<PixelRecord>,
    /// For every set that comes out: the name of its segment, and its number among those of the segment.
    pub sets: Vec<(String, usize)>,
    /// What is due before each reset, and at the end.
    pub epochs: Vec<Epoch>,
    /// What the sequencer tells the modulation hardware, in order.
    pub announcements: Vec<NextFrame>,
    /// Every access to a register, in order.
    pub accesses: Vec<GoldenAccess>,
    /// What is compared at each rest.
    pub rests: Vec<Rest>,
    /// Complete and discarded sets since the last reset.
    pub counters: (u32, u32),
    /// Sets discarded over all epochs.
    pub discarded: u32,
}

impl Golden {
    /// Runs the model over `scenario`.
    pub fn new(pipeline: &Pipeline, scenario: &Scenario) -> Self {
        let mut golden = Self::default();
        let mut model = PipelineModel::new(pipeline);
        // A set comes out at the event after its last pixel, which may already be another segment's.
        let mut open = (String::new(), 0);
        for segment in &scenario.segments {
            let mut number = 0;
            for &event in &segment.events {
                golden.advance(pipeline, &mut model, event, &open);
                if let StreamEvent::Beat(Beat { start_of_set: true, .. }) = event {
                    open = (segment.name.clone(), number);
                    number += 1;
                }
            }
        }
        golden.advance(pipeline, &mut model, StreamEvent::Rest, &open);
        golden.end_epoch();
        golden.counters = model.counters();
        golden.discarded += golden.counters.1;
        golden
    }

    fn advance(
        &mut self,
        pipeline: &Pipeline,
        model: &mut PipelineModel,
        event: StreamEvent,
        open: &(String, usize),
    ) {
        if let StreamEvent::Access(access) = event {
            if !pipeline.registers.axi4_lite {
                return;
            }
            self.accesses.push(GoldenAccess { access, answer: model.answer(access) });
        }
        self.stimulus.push(event.into());
        if event == StreamEvent::Reset {
            self.discarded += model.counters().1;
        }
        if let Some(records) = model.advance(event) {
            self.records.extend(records);
            self.sets.push(open.clone());
        }
        self.announcements.extend(model.announced());
        match event {
            StreamEvent::Reset => self.end_epoch(),
            StreamEvent::Rest => {
                let (done, discarded) = model.counters();
                self.rests.push(Rest { due: self.records.len(), done, discarded });
            }
            StreamEvent::Beat(_) | StreamEvent::Pause { .. } | StreamEvent::Access(_) => {}
        }
    }

    fn end_epoch(&mut self) {
        self.epochs.push(Epoch { records: self.records.len(), announcements: self.announcements.len() });
    }
}
