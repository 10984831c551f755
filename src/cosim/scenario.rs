//! What the core is driven with: corners, random frames, broken streams, resets.

use super::accesses::{read_all, register_accesses};
use crate::frames::RawSets;
use crate::hdl::{Scenario, Segment};
use crate::model::{Beat, StreamEvent, beats_of_set};
use crate::spec::{Pipeline, Scheme, Word};
use num_complex::Complex64;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

/// `sets` sets whose codes `code` gives, for set, frame within the set and pixel.
fn sets_of(pipeline: &Pipeline, sets: usize, mut code: impl FnMut(usize, usize, usize) -> u32) -> RawSets {
    let (geometry, frames) = (pipeline.geometry(), pipeline.derived().frames_per_set);
    let mut codes = Vec::with_capacity(sets * frames * geometry.pixels());
    for set in 0..sets {
        for frame in 0..frames {
            codes.extend((0..geometry.pixels()).map(|pixel| code(set, frame, pixel)));
        }
    }
    RawSets::new(geometry, frames, codes).expect("whole sets of a pipeline's geometry")
}

fn full_scale(pipeline: &Pipeline) -> u32 {
    Word::unsigned(pipeline.sensor.adc_bits).max() as u32
}

/// Sets of uniformly random codes; every eighth pixel sees only the lowest codes, so that weak vectors occur.
pub fn random_sets(pipeline: &Pipeline, seed: u64, sets: usize) -> RawSets {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let full_scale = full_scale(pipeline);
    sets_of(pipeline, sets, |_, _, pixel| {
        random.random_range(0..=if pixel % 8 == 7 { 3 } else { full_scale })
    })
}

/// Up to so many phase steps, all combinations of two codes are tried.
const MOST_STEPS_COMBINED: usize = 6;

/// For each phase step whether it has the greater of two codes: every combination, or with many steps those in which a sum
/// is at an extreme or a single step differs from all others.
fn patterns(scheme: &Scheme) -> Vec<Vec<bool>> {
    let steps = scheme.steps();
    if steps <= MOST_STEPS_COMBINED {
        return (0..1_usize << steps)
            .map(|bits| (0..steps).map(|step| bits >> step & 1 == 1).collect())
            .collect();
    }
    let vectors = scheme.characteristic_polynomial();
    // The sums' extremes in sixteen directions, the axes and the diagonals among them.
    let extremes = (0..16).map(|part| {
        let direction = Complex64::from_polar(1.0, TAU * f64::from(part) / 16.0);
        vectors.iter().map(|c| (c * direction.conj()).re > 0.0).collect()
    });
    let singles = (0..2 * steps).map(|n| (0..steps).map(|step| (step == n % steps) == (n < steps)).collect());
    let constant = [false, true].map(|greater| vec![greater; steps]);
    constant.into_iter().chain(extremes).chain(singles).collect()
}

/// Sets in which a pixel's phase steps are one of: every combination of least and greatest code (all sums at their
/// extremes, all axes and diagonals among them), every combination of two neighbouring codes (the weakest vectors),
/// codes around saturation, and codes that the stream's bytes can carry and the converter cannot make. With more than
/// six steps, chosen combinations.
pub fn corner_sets(pipeline: &Pipeline) -> RawSets {
    let full_scale = full_scale(pipeline);
    let patterns = patterns(&pipeline.modulation.scheme);
    let frames_per_step = pipeline.modulation.frames_per_step;
    let saturation = pipeline.sensor.saturation_dn as u32;
    let pairs = [
        (0, full_scale),
        (full_scale / 2, full_scale / 2 + 1),
        (saturation - 1, saturation),
        (0, 1),
        (full_scale / 4, full_scale - full_scale / 4),
        (full_scale, (1 << pipeline.sensor.adc_bits.next_multiple_of(8)) - 1),
    ];
    // As many sets as it takes to have every pattern, up to eight on the smallest sensors; a stride without a common divisor
    // spreads the patterns over them.
    let count = pairs.len() * patterns.len();
    let stride = [37, 41, 43].into_iter().find(|stride| !count.is_multiple_of(*stride)).unwrap_or(1);
    let pixels = pipeline.geometry().pixels();
    sets_of(pipeline, count.div_ceil(pixels).min(8), |set, frame, pixel| {
        let corner = (set * pixels + pixel) * stride % count;
        let (low, high) = pairs[corner / patterns.len()];
        if patterns[corner % patterns.len()][frame / frames_per_step] { high } else { low }
    })
}

/// A set's beats, frame by frame, to be broken.
struct Broken {
    frames: Vec<Vec<Beat>>,
    width: usize,
}

impl Broken {
    fn new(pipeline: &Pipeline, seed: u64) -> Self {
        let raw = random_sets(pipeline, seed, 1);
        let beats: Vec<Beat> = beats_of_set(&raw, 0).collect();
        let frames = beats.chunks(pipeline.geometry().pixels()).map(<[Beat]>::to_vec).collect();
        Self { frames, width: pipeline.sensor.width }
    }

    fn events(self) -> Vec<StreamEvent> {
        self.frames.into_iter().flatten().map(StreamEvent::Beat).collect()
    }
}

/// A way of breaking a set.
struct Fault {
    name: &'static str,
    apply: fn(&mut Broken),
}

impl Broken {
    /// The beat at `pixel` of the second frame, and all that the set has before and after it: only a wrong marker tells that
    /// such a set is broken.
    fn marker(&mut self, pixel: usize) -> &mut Beat {
        &mut self.frames[1][pixel]
    }
}

/// Every way in which a stream can lose or gain pixels, lines, frames or markers.
const FAULTS: &[Fault] = &[
    Fault {
        name: "first frame a line short",
        apply: |set| {
            // Two lines are enough to be too short, and keep the stimulus small.
            let lines = set.frames[0].len() / set.width;
            let kept = lines.saturating_sub(1).clamp(1, 2);
            set.frames[0].truncate(kept * set.width);
            set.frames[1].truncate(set.width);
            set.frames.truncate(2);
            if lines == 1 {
                set.frames[0].truncate(set.width - 1);
            }
        },
    },
    Fault {
        name: "line a pixel short",
        apply: |set| {
            set.frames.truncate(1);
            set.frames[0].truncate(2 * set.width);
            set.frames[0].remove(1);
        },
    },
    Fault {
        name: "line a pixel long",
        apply: |set| {
            set.frames.truncate(1);
            set.frames[0].truncate(2 * set.width);
            let again = Beat { start_of_frame: false, start_of_set: false, ..set.frames[0][0] };
            set.frames[0].insert(1, again);
        },
    },
    Fault {
        name: "line without its end",
        apply: |set| {
            set.frames.truncate(1);
            set.frames[0].truncate(2 * set.width);
            set.frames[0][set.width - 1].end_of_line = false;
        },
    },
    Fault {
        name: "start of frame in the middle of a frame",
        apply: |set| {
            set.frames.truncate(1);
            set.frames[0].truncate(set.width + 2);
            if let Some(beat) = set.frames[0].last_mut() {
                beat.start_of_frame = true;
            }
        },
    },
    Fault {
        name: "start of set without start of frame",
        apply: |set| {
            set.frames.truncate(1);
            set.frames[0].truncate(set.width);
            set.frames[0][0].start_of_frame = false;
        },
    },
    Fault {
        name: "set that starts with the end of a line",
        apply: |set| {
            set.frames.truncate(1);
            set.frames[0].truncate(set.width);
            set.frames[0][0].end_of_line = true;
        },
    },
    Fault { name: "end of line missing", apply: |set| set.marker(set.width - 1).end_of_line = false },
    Fault { name: "end of line too early", apply: |set| set.marker(set.width - 2).end_of_line = true },
    Fault { name: "start of frame missing", apply: |set| set.marker(0).start_of_frame = false },
    Fault { name: "start of frame within one", apply: |set| set.marker(1).start_of_frame = true },
    Fault { name: "start of set alone within a frame", apply: |set| set.marker(1).start_of_set = true },
    Fault {
        name: "last frame missing",
        apply: |set| {
            set.frames.pop();
        },
    },
    Fault {
        name: "first frame missing",
        apply: |set| {
            set.frames.remove(0);
            set.frames.truncate(1);
            set.frames[0].truncate(set.width);
        },
    },
    Fault {
        name: "last frame a pixel short",
        apply: |set| {
            if let Some(frame) = set.frames.last_mut() {
                frame.pop();
            }
        },
    },
    Fault {
        name: "last frame a line long",
        apply: |set| {
            let width = set.width;
            if let Some(frame) = set.frames.last_mut() {
                let mut line: Vec<Beat> = frame[..width].to_vec();
                line[0].start_of_frame = false;
                frame.extend(line);
            }
        },
    },
    Fault {
        name: "one frame too many",
        apply: |set| {
            let mut frame = set.frames[set.frames.len() - 1].clone();
            frame.truncate(set.width);
            set.frames.push(frame);
        },
    },
];

/// Sensors of more pixels share a good set among the faults that need one, for the simulators' sake.
const LARGE_PIXELS: usize = 4096;

/// Lines before any start of set, then every fault, each followed by a good set (the last few only, on a large sensor: there
/// the next broken set's start shows that the core has recovered).
pub fn faulty_stream(pipeline: &Pipeline, seed: u64) -> Vec<Segment> {
    let mut stray = Broken::new(pipeline, seed);
    stray.frames.remove(0);
    stray.frames.truncate(1);
    stray.frames[0].truncate(pipeline.sensor.width + 1);
    let mut segments =
        vec![Segment { name: "stream joined in the middle".to_owned(), events: stray.events() }];
    let large = pipeline.geometry().pixels() > LARGE_PIXELS;
    for (number, fault) in FAULTS.iter().enumerate() {
        let mut set = Broken::new(pipeline, seed + number as u64);
        (fault.apply)(&mut set);
        segments.push(Segment { name: fault.name.to_owned(), events: set.events() });
        if !large || number + 5 >= FAULTS.len() || number % 6 == 5 {
            let good = random_sets(pipeline, seed + 1000 + number as u64, 1);
            segments.push(Segment::of_sets(&format!("good set after: {}", fault.name), &good));
        }
    }
    segments
}

/// Silences: inside a line, between frames, and after the last pixel, of the longest that a frame may have and one
/// clock more.
pub fn silences(pipeline: &Pipeline, seed: u64) -> Vec<Segment> {
    let longest = pipeline.sensor.line_blanking_clocks;
    let (width, pixels) = (pipeline.sensor.width, pipeline.geometry().pixels());
    // A pause within a set never ends it, however long it is.
    let mut within = Broken::new(pipeline, seed).events();
    for at in [pixels, width, 1] {
        within.insert(at, StreamEvent::Pause { clocks: longest + 40 });
    }
    // After the last pixel, a line that comes in time makes the last frame too long; one that comes later is nobody's.
    let surplus = |name: &str, clocks, seed| {
        let mut set = Broken::new(pipeline, seed);
        let mut line: Vec<Beat> = set.frames[0][..width].to_vec();
        line[0] = Beat { start_of_frame: false, start_of_set: false, ..line[0] };
        set.frames.push(line);
        let mut events = set.events();
        events.insert(events.len() - width, StreamEvent::Pause { clocks });
        // Everything before has come out, so that nothing holds the beats and the pause is as long as it says.
        events.insert(0, StreamEvent::Rest);
        Segment { name: name.to_owned(), events }
    };
    vec![
        Segment { name: "silences within a set".to_owned(), events: within },
        surplus("surplus line after the longest pause", longest, seed + 1),
        surplus("surplus line after a silence", longest + 1, seed + 2),
        Segment::of_sets("good set after silences", &random_sets(pipeline, seed + 3, 1)),
    ]
}

/// A set broken off after a line, and a good one: small enough for a folder of golden vectors.
pub fn aborted_then_good(pipeline: &Pipeline, good: Segment) -> Scenario {
    let mut set = Broken::new(pipeline, 1);
    (FAULTS[0].apply)(&mut set);
    let mut segments = vec![Segment { name: FAULTS[0].name.to_owned(), events: set.events() }, good];
    if pipeline.registers.axi4_lite {
        let events = [vec![StreamEvent::Rest], read_all()].concat();
        segments.push(Segment { name: "registers in the end".to_owned(), events });
    }
    Scenario { segments }
}

/// Resets while a set accumulates, while one drains, while one drains and the next accumulates, and while nothing
/// happens; each followed by a good set.
pub fn resets(pipeline: &Pipeline, seed: u64) -> Vec<Segment> {
    let longest = pipeline.sensor.line_blanking_clocks;
    let pixels = pipeline.geometry().pixels();
    let good = |seed| Segment::of_sets("good set after a reset", &random_sets(pipeline, seed, 1));
    let mut accumulating = Broken::new(pipeline, seed).events();
    accumulating.truncate(pipeline.sensor.width + 3);
    accumulating.push(StreamEvent::Reset);
    let mut draining = Broken::new(pipeline, seed + 1).events();
    draining.extend([StreamEvent::Pause { clocks: longest + 8 }, StreamEvent::Reset]);
    let mut both = Broken::new(pipeline, seed + 2).events();
    both.extend(Broken::new(pipeline, seed + 3).events().into_iter().take(pixels / 2));
    both.push(StreamEvent::Reset);
    vec![
        Segment { name: "reset while a set accumulates".to_owned(), events: accumulating },
        good(seed + 4),
        Segment { name: "reset while a set drains".to_owned(), events: draining },
        good(seed + 5),
        Segment { name: "reset while a set drains and the next accumulates".to_owned(), events: both },
        good(seed + 6),
        Segment { name: "reset at rest".to_owned(), events: vec![StreamEvent::Rest, StreamEvent::Reset] },
        good(seed + 7),
    ]
}

/// Everything that needs no scene and no recording. The resets come first: after them the counters keep what the broken
/// streams make of them, and are compared at the rests.
pub fn standard(pipeline: &Pipeline, seed: u64) -> Scenario {
    let mut segments = vec![
        Segment::of_sets("corners", &corner_sets(pipeline)),
        Segment::of_sets("random frames", &random_sets(pipeline, seed, 2)),
    ];
    segments.extend(resets(pipeline, seed + 20_000));
    segments.extend(register_accesses(pipeline, seed + 40_000));
    segments.extend(faulty_stream(pipeline, seed + 10_000));
    segments.extend(silences(pipeline, seed + 30_000));
    let scenario = Scenario { segments };
    if pipeline.derived().unwrapper.is_some() { scenario.in_turn() } else { scenario }
}
