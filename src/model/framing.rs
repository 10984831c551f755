//! Framing: which pixel of which phase step a beat is, and whether its set can be trusted.
//!
//! A set is complete when all its frames have arrived, each with every line of the right length, and the stream then
//! either starts another frame or falls silent. Anything else discards the set; the core waits for the next start of set.

use super::stream::{Beat, StreamEvent};
use crate::spec::Pipeline;

/// Where an accepted beat belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PixelSlot {
    /// Pixel number within the frame.
    pub address: usize,
    /// The scheme's phase step that the frame has.
    pub step: usize,
    /// Whether this is the set's first frame, whose samples replace what the memory holds.
    pub first_frame: bool,
}

/// What an event of the stream led to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FramingEvent {
    /// A complete set may be drained (before the beat's own sample is added).
    pub commit: bool,
    /// The beat's place, where it belongs to a set.
    pub slot: Option<PixelSlot>,
    /// Where a set is complete: it was of the second modulation frequency.
    pub second_frequency: bool,
    /// Where a set is complete: the one before was of the other frequency, and nothing was discarded between.
    pub partner: bool,
    /// Number within its set of the frame that must come next, where the event decides that: where a frame begins, and where a
    /// set is lost.
    pub next: Option<usize>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    /// After reset or a fault: waiting for a start of set, whatever else arrives.
    Lost,
    /// Between sets: only a start of set may follow.
    Idle,
    /// Within a set.
    Active,
    /// All pixels have arrived: the next beat must start a frame.
    Closing,
}

/// The framing state machine.
#[derive(Debug, Clone)]
pub struct Framing {
    width: usize,
    height: usize,
    frames_per_step: usize,
    /// The phase step at each place of a set.
    order: Vec<usize>,
    longest_pause_clocks: u32,
    state: State,
    column: usize,
    row: usize,
    repeat: usize,
    place: usize,
    /// The present set is of the second frequency.
    second_frequency: bool,
    /// The frequency of the last complete set, unless something has been discarded since.
    before: Option<bool>,
    /// Sets that were complete, modulo 2^32.
    pub sets_done: u32,
    /// Sets that were discarded, modulo 2^32.
    pub sets_discarded: u32,
}

impl Framing {
    /// The state after reset.
    pub fn new(pipeline: &Pipeline) -> Self {
        Self {
            width: pipeline.sensor.width,
            height: pipeline.sensor.height,
            frames_per_step: pipeline.modulation.frames_per_step,
            order: pipeline.modulation.steps_in_order(),
            longest_pause_clocks: pipeline.sensor.line_blanking_clocks,
            state: State::Lost,
            column: 0,
            row: 0,
            repeat: 0,
            place: 0,
            second_frequency: false,
            before: None,
            sets_done: 0,
            sets_discarded: 0,
        }
    }

    /// Advances by one event.
    pub fn advance(&mut self, event: StreamEvent) -> FramingEvent {
        match event {
            StreamEvent::Reset => {
                *self = Self {
                    state: State::Lost,
                    before: None,
                    sets_done: 0,
                    sets_discarded: 0,
                    ..self.at_start()
                };
                FramingEvent::default()
            }
            StreamEvent::Pause { clocks } => self.silence(clocks > self.longest_pause_clocks),
            StreamEvent::Rest => self.silence(true),
            StreamEvent::Beat(beat) => self.beat(beat),
            StreamEvent::Access(_) => FramingEvent::default(),
        }
    }

    /// A silence that is `long` ends a frame.
    fn silence(&mut self, long: bool) -> FramingEvent {
        if long && self.state == State::Closing { self.commit() } else { FramingEvent::default() }
    }

    fn at_start(&self) -> Self {
        Self { column: 0, row: 0, repeat: 0, place: 0, ..self.clone() }
    }

    fn commit(&mut self) -> FramingEvent {
        self.state = State::Idle;
        self.sets_done = self.sets_done.wrapping_add(1);
        let second_frequency = self.second_frequency;
        let before = self.before.replace(second_frequency);
        let partner = before == Some(!second_frequency);
        FramingEvent { commit: true, second_frequency, partner, ..FramingEvent::default() }
    }

    fn discard(&mut self) {
        self.sets_discarded = self.sets_discarded.wrapping_add(1);
        self.before = None;
    }

    fn beat(&mut self, beat: Beat) -> FramingEvent {
        let closes = self.state == State::Closing && beat.start_of_frame;
        let outcome = if closes { self.commit() } else { FramingEvent::default() };
        let start = beat.start_of_set && beat.start_of_frame;
        if start {
            if self.state == State::Active {
                self.discard();
            }
            let second_frequency = beat.second_frequency;
            *self = Self { state: State::Active, second_frequency, ..self.at_start() };
        }
        let in_place = beat.start_of_frame == (self.column == 0 && self.row == 0)
            && (start || !beat.start_of_set)
            && beat.end_of_line == (self.column == self.width - 1);
        let (slot, next) = match self.state {
            State::Active if in_place => {
                let next = beat.start_of_frame.then(|| self.next_frame());
                (Some(self.take()), next)
            }
            State::Lost => (None, None),
            State::Active | State::Idle | State::Closing => {
                self.discard();
                self.state = State::Lost;
                (None, Some(0))
            }
        };
        FramingEvent { slot, next, ..outcome }
    }

    /// Number of the frame after the one that is being taken.
    fn next_frame(&self) -> usize {
        (self.place * self.frames_per_step + self.repeat + 1) % (self.order.len() * self.frames_per_step)
    }

    /// The slot of a beat that is in place, and one step onwards.
    fn take(&mut self) -> PixelSlot {
        let slot = PixelSlot {
            address: self.row * self.width + self.column,
            step: self.order[self.place],
            first_frame: self.place == 0 && self.repeat == 0,
        };
        let places = self.order.len();
        for (count, limit) in [
            (&mut self.column, self.width),
            (&mut self.row, self.height),
            (&mut self.repeat, self.frames_per_step),
            (&mut self.place, places),
        ] {
            *count += 1;
            if *count < limit {
                return slot;
            }
            *count = 0;
        }
        self.state = State::Closing;
        slot
    }
}
