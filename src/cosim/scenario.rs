//! What the core is driven with: corners, random frames, broken streams, resets.

use crate::frames::RawSets;
use crate::hdl::{Scenario, Segment};
use crate::model::{Beat, StreamEvent, beats_of_set};
use crate::spec::{Pipeline, Word};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

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

/// One set in which a pixel's phase steps are one of: every combination of least and greatest code (all sums at their
/// extremes, all axes and diagonals among them), every combination of two neighbouring codes (the weakest vectors), and
/// codes around saturation.
pub fn corner_sets(pipeline: &Pipeline) -> RawSets {
    let full_scale = full_scale(pipeline);
    let steps = pipeline.modulation.scheme.steps();
    let frames_per_step = pipeline.modulation.frames_per_step;
    let saturation = pipeline.sensor.saturation_dn as u32;
    let pairs = [
        (0, full_scale),
        (full_scale / 2, full_scale / 2 + 1),
        (saturation - 1, saturation),
        (0, 1),
        (full_scale / 4, full_scale - full_scale / 4),
    ];
    sets_of(pipeline, 1, |_, frame, pixel| {
        let (low, high) = pairs[(pixel >> steps) % pairs.len()];
        if pixel >> (frame / frames_per_step) & 1 == 1 { high } else { low }
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

/// Every way in which a stream can lose or gain pixels, lines or frames. Each set is followed by a good one.
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

/// Lines before any start of set, then every fault, each followed by a good set.
pub fn faulty_stream(pipeline: &Pipeline, seed: u64) -> Vec<Segment> {
    let mut stray = Broken::new(pipeline, seed);
    stray.frames.remove(0);
    stray.frames.truncate(1);
    stray.frames[0].truncate(pipeline.sensor.width + 1);
    let mut segments =
        vec![Segment { name: "stream joined in the middle".to_owned(), events: stray.events() }];
    for (fault, seed) in FAULTS.iter().zip(seed + 1..) {
        let mut set = Broken::new(pipeline, seed);
        (fault.apply)(&mut set);
        segments.push(Segment { name: fault.name.to_owned(), events: set.events() });
        let good = random_sets(pipeline, seed + 1000, 1);
        segments.push(Segment::of_sets(&format!("good set after: {}", fault.name), &good));
    }
    segments
}

/// A set broken off after a line, and a good one: small enough for a folder of golden vectors.
pub fn aborted_then_good(pipeline: &Pipeline, good: Segment) -> Scenario {
    let mut set = Broken::new(pipeline, 1);
    (FAULTS[0].apply)(&mut set);
    Scenario { segments: vec![Segment { name: FAULTS[0].name.to_owned(), events: set.events() }, good] }
}

/// Resets while a set accumulates, while one drains, and while nothing happens; each followed by a good set.
pub fn resets(pipeline: &Pipeline, seed: u64) -> Vec<Segment> {
    let good = |seed| Segment::of_sets("good set after a reset", &random_sets(pipeline, seed, 1));
    let mut accumulating = Broken::new(pipeline, seed).events();
    accumulating.truncate(pipeline.sensor.width + 3);
    accumulating.push(StreamEvent::Reset);
    let mut draining = Broken::new(pipeline, seed + 1).events();
    draining.extend([StreamEvent::Silence, StreamEvent::Reset]);
    vec![
        Segment { name: "reset while a set accumulates".to_owned(), events: accumulating },
        good(seed + 2),
        Segment { name: "reset while a set drains".to_owned(), events: draining },
        good(seed + 3),
        Segment { name: "reset at rest".to_owned(), events: vec![StreamEvent::Silence, StreamEvent::Reset] },
        good(seed + 4),
    ]
}

/// Everything that needs no scene and no recording.
pub fn standard(pipeline: &Pipeline, seed: u64) -> Scenario {
    let mut segments = vec![
        Segment::of_sets("corners", &corner_sets(pipeline)),
        Segment::of_sets("random frames", &random_sets(pipeline, seed, 2)),
    ];
    segments.extend(faulty_stream(pipeline, seed + 10_000));
    segments.extend(resets(pipeline, seed + 20_000));
    Scenario { segments }
}
