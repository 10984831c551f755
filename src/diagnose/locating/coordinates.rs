//! The coordinates in which a residual is looked for: for each, columns that no physics asked for.
//!
//! A column is a way in which frames may be off (more light, more signal, another phase, more contrast) times a function of the coordinate.

use super::line_ways::{LINE_WAYS, Ways};
use super::neighbours::{NEIGHBOURS, neighbours};
use super::ranges::Ranges;
use super::velocities;
use crate::diagnose::tangents::acting::Acting;
use crate::diagnose::tangents::columns::Frame;
use crate::physics::{Moment, Pixels, cos_sin, ln};
use crate::units::phase_rad;
use crate::widest::widest;
use std::f64::consts::TAU;

/// What a column may be made of, in one frame.
pub struct View<'a> {
    /// When and how the frame was taken.
    pub moment: &'a Moment,
    /// Number of its recording.
    pub take: usize,
    /// The model's signal and tangents.
    pub frame: &'a Frame,
    /// The pixels.
    pub pixels: &'a Pixels,
    /// What the coordinates range over.
    pub ranges: &'a Ranges,
}

impl View<'_> {
    /// Whether a pixel's phase and amplitude are looked at: where the target moves, and everywhere where nothing does.
    fn tells(&self, pixel: usize) -> bool {
        self.ranges.is_still || self.pixels.target[pixel]
    }
}

/// A coordinate.
pub struct Coordinate {
    /// Its name in a verdict.
    pub name: &'static str,
    /// How many columns it has; none where it has one value only.
    pub columns: fn(&Ranges) -> usize,
    /// The columns that act in a frame.
    pub fill: fn(&View) -> Acting,
    /// What a column looks like, in words.
    pub shape: fn(&Ranges, usize) -> String,
}

/// In which way a frame is off: by so much light, in proportion to its signal, in phase, in proportion to its modulated part.
pub const MODES: [&str; 4] = ["offset", "gain", "phase", "contrast"];

fn mode(view: &View, mode: usize) -> Vec<f64> {
    match mode {
        0 => vec![1.0; view.frame.base.len()],
        1 => view.frame.base.to_vec(),
        2 => view.frame.phase().collect(),
        _ => contrast(view),
    }
}

/// Of pixels that do not tell how their light splits, what is more of it would be more contrast, too.
fn contrast(view: &View) -> Vec<f64> {
    let mut contrast = times(&view.frame.own[0], &view.pixels.amplitude_1m_dn);
    let untold = contrast.iter_mut().zip(&view.ranges.tells_constant).filter(|(_, tells)| !**tells);
    untold.for_each(|(contrast, _)| *contrast = 0.0);
    contrast
}

/// Columns of all modes, for functions of the frame alone: `(number of the function, its value)`, in order.
pub fn by_frame(view: &View, of: usize, functions: &[(usize, f64)]) -> Acting {
    by_frame_after(Acting::default(), 0, view, of, functions)
}

/// The same after other columns, from number `first` on.
fn by_frame_after(
    mut columns: Acting,
    first: usize,
    view: &View,
    of: usize,
    functions: &[(usize, f64)],
) -> Acting {
    for number in 0..MODES.len() {
        let pattern = columns.pattern(mode(view, number));
        for &(function, value) in functions.iter().filter(|(_, value)| *value != 0.0) {
            columns.share(first + number * of + function, pattern, value);
        }
    }
    columns
}

/// Columns of all modes, for functions of the pixel.
fn by_pixel(view: &View, of: usize, function: impl Fn(usize) -> Vec<(usize, f64)>) -> Acting {
    let count = view.frame.base.len();
    let mut columns: Vec<Vec<f64>> = vec![vec![0.0; count]; MODES.len() * of];
    let modes: Vec<Vec<f64>> = (0..MODES.len()).map(|number| mode(view, number)).collect();
    for pixel in 0..count {
        for (which, value) in function(pixel) {
            for (number, base) in modes.iter().enumerate() {
                columns[number * of + which][pixel] = base[pixel] * value;
            }
        }
    }
    each(columns)
}

/// Columns that have a pattern each.
pub fn each(columns: Vec<Vec<f64>>) -> Acting {
    let mut acting = Acting::default();
    columns.into_iter().enumerate().for_each(|(number, values)| acting.column(number, values));
    acting
}

/// A column of so many functions of each mode, in words.
pub fn mode_shape(of: usize, column: usize, what: impl Fn(usize) -> String) -> String {
    format!("{}, {}", MODES[column / of], what(column % of))
}

/// Two neighbouring hats of `count` over 0 … 1, and how much of each.
fn hats(place: f64, count: usize) -> [(usize, f64); 2] {
    let along = place.clamp(0.0, 1.0) * (count - 1) as f64;
    let left = (along.floor() as usize).min(count - 2);
    let share = along - left as f64;
    [(left, 1.0 - share), (left + 1, share)]
}

fn within(value: f64, (low, high): (f64, f64)) -> f64 {
    (value - low) / (high - low)
}

fn between(part: usize, count: usize, (low, high): (f64, f64)) -> f64 {
    low + (high - low) * part as f64 / (count - 1) as f64
}

const POSITIONS: usize = 14;
const TIMES: usize = 8;
const LIGHTS: usize = 10;
const CODES: usize = 14;
const CYCLES: usize = 6;
/// Columns of the phase coordinate that go with the range's phase; those after them go with the phase that was set.
pub const OF_RANGE: usize = 6 * CYCLES;
/// Cycles a turn of the phase offset at most.
const OFFSET_CYCLES: usize = 4;
/// Functions of the phase offset: cosine and sine of each.
pub const OF_OFFSET: usize = 2 * OFFSET_CYCLES;
/// Cycles a turn of a frame's commanded phase at most: what a shifter does to the light, the read-out or the gate goes with that, where it is not the frame's number in another word.
const COMMANDED_CYCLES: usize = 2;
/// Functions of what is commanded: of the phase offset, and after these of the whole phase.
const OF_COMMANDED: usize = OF_OFFSET + 2 * COMMANDED_CYCLES;
/// Functions of what is commanded that are less are zero: offsets are written with six digits.
const LEAST_OF_OFFSET: f64 = 1e-5;
/// A pixel's row or column matters to its own numbers only by something that changes from frame to frame.
const CHANGES: [&str; 4] = ["with velocity", "with the frame of a set", "with distance", "with time"];

/// All coordinates whose columns are functions.
pub const COORDINATES: [Coordinate; 11] = [
    Coordinate {
        name: "phase",
        columns: |_| OF_RANGE + MODES.len() * OF_COMMANDED,
        fill: phase,
        shape: phase_shape,
    },
    Coordinate {
        name: "position_m",
        columns: |ranges| if ranges.has_places { MODES.len() * POSITIONS } else { 0 },
        fill: |view| {
            let position_m = view.moment.commanded_m();
            by_frame(view, POSITIONS, &hats(within(position_m, view.ranges.position_m), POSITIONS))
        },
        shape: |ranges, column| {
            mode_shape(POSITIONS, column, |n| format!("at {:.2} m", between(n, POSITIONS, ranges.position_m)))
        },
    },
    Coordinate {
        name: "velocity_m_s",
        columns: |_| velocities::COLUMNS,
        fill: velocities::fill,
        shape: |_, column| velocities::shape(column),
    },
    Coordinate {
        name: "frame",
        columns: |ranges| MODES.len() * ranges.frame_numbers,
        fill: |view| {
            let number = view.ranges.frames[view.take].1 + view.moment.frame;
            by_frame(view, view.ranges.frame_numbers, &[(number, 1.0)])
        },
        shape: |ranges, column| {
            mode_shape(ranges.frame_numbers, column, |n| {
                let frames =
                    ranges.frames.iter().find(|(frames, first)| (*first..first + frames).contains(&n));
                frames.map_or_else(String::new, |(frames, first)| format!("frame {} of {frames}", n - first))
            })
        },
    },
    Coordinate {
        name: "time_s",
        columns: |ranges| MODES.len() * TIMES * ranges.duration_s.len(),
        fill: |view| {
            let of = TIMES * view.ranges.duration_s.len();
            let place = view.moment.time_s / view.ranges.duration_s[view.take].max(1e-9);
            by_frame(view, of, &hats(place, TIMES).map(|(n, value)| (view.take * TIMES + n, value)))
        },
        shape: |ranges, column| {
            mode_shape(TIMES * ranges.duration_s.len(), column, |n| {
                format!("at {:.1} s", between(n % TIMES, TIMES, (0.0, ranges.duration_s[n / TIMES])))
            })
        },
    },
    Coordinate {
        name: "row",
        columns: |_| MODES.len() * LINE_WAYS.len() * CHANGES.len(),
        fill: |view| by_line(view, &view.ranges.rows),
        shape: line_shape,
    },
    Coordinate {
        name: "column",
        columns: |_| MODES.len() * LINE_WAYS.len() * CHANGES.len(),
        fill: |view| by_line(view, &view.ranges.columns),
        shape: line_shape,
    },
    Coordinate { name: "code", columns: |_| CODES + 2 * PATTERNS.len(), fill: code, shape: code_shape },
    Coordinate {
        name: "amplitude",
        columns: |_| MODES.len() * LIGHTS,
        fill: |view| {
            let light: Vec<f64> = amplitude_dn(view).into_iter().map(|dn| ln(dn.max(1e-6))).collect();
            let ends = view.ranges.ln_amplitude;
            by_pixel(view, LIGHTS, |pixel| match view.tells(pixel) {
                true => hats(within(light[pixel], ends), LIGHTS).to_vec(),
                false => Vec::new(),
            })
        },
        shape: |ranges, column| {
            mode_shape(LIGHTS, column, |n| {
                format!("at an amplitude of {:.0} DN", between(n, LIGHTS, ranges.ln_amplitude).exp())
            })
        },
    },
    Coordinate {
        name: "set",
        columns: |ranges| if ranges.has_sets { MODES.len() * 2 } else { 0 },
        fill: |view| {
            let odd = if view.moment.set % 2 == 0 { 1.0 } else { -1.0 };
            by_frame(view, 2, &[(0, odd), (1, odd * centred(view.moment))])
        },
        shape: |_, column| {
            mode_shape(2, column, |n| ["every other set", "every other set, with the frame"][n].to_owned())
        },
    },
    Coordinate {
        name: "neighbours",
        columns: |_| NEIGHBOURS.len(),
        fill: neighbours,
        shape: |_, column| NEIGHBOURS[column].to_owned(),
    },
];

/// A frame's place in its set, -1 … 1.
pub fn centred(moment: &Moment) -> f64 {
    along(moment.frame, moment.frames)
}

/// A place among so many, -1 … 1.
pub fn along(index: usize, count: usize) -> f64 {
    if count > 1 { 2.0 * index as f64 / (count - 1) as f64 - 1.0 } else { 0.0 }
}

fn amplitude_dn(view: &View) -> Vec<f64> {
    // The tangent by the constant light at 1 m is the light's falloff.
    times(&view.frame.own[2], &view.pixels.amplitude_1m_dn)
}

fn times(per: &[f64], numbers: &[f64]) -> Vec<f64> {
    per.iter().zip(numbers).map(|(per, number)| per * number).collect()
}

/// Phase: of the range (not of the offset) in cycles a turn as phase and gain errors, and of the waveform; and the phase offset, or the commanded phase, whatever the range.
fn phase(view: &View) -> Acting {
    let moment = view.moment;
    let position_m = moment.commanded_m();
    let count = view.frame.base.len();
    let amplitude = amplitude_dn(view);
    let mut columns: Vec<Vec<f64>> = vec![vec![0.0; count]; OF_RANGE];
    for pixel in (0..count).filter(|&pixel| view.tells(pixel)) {
        let range_m = position_m * view.pixels.obliquity[pixel];
        let own_rad = view.pixels.own_phase_rad(pixel, moment.frequency_hz);
        let phase = phase_rad(range_m, moment.frequency_hz) + own_rad - moment.offset_rad;
        let angle = moment.step_rad - phase;
        let (once, wave_once) = (cos_sin(phase), cos_sin(angle));
        let (mut turned, mut wave) = ((1.0, 0.0), wave_once);
        for cycles in 1..=CYCLES {
            // cos(k a) and sin(k a) from those of (k − 1) a.
            (turned, wave) = (further(turned, once), further(wave, wave_once));
            let ((cosine, sine), (wave_cosine, wave_sine)) = (turned, wave);
            let at = 6 * (cycles - 1);
            columns[at][pixel] = cosine * view.frame.own[1][pixel] / view.frame.times;
            columns[at + 1][pixel] = sine * view.frame.own[1][pixel] / view.frame.times;
            columns[at + 2][pixel] = cosine * amplitude[pixel];
            columns[at + 3][pixel] = sine * amplitude[pixel];
            columns[at + 4][pixel] = wave_cosine * amplitude[pixel];
            columns[at + 5][pixel] = wave_sine * amplitude[pixel];
        }
    }
    let commanded_rad = moment.offset_rad + moment.step_rad;
    let of_offset = (1..=OFFSET_CYCLES).map(|cycles| cycles as f64 * moment.offset_rad);
    let of_phase = (1..=COMMANDED_CYCLES).map(|cycles| cycles as f64 * commanded_rad);
    let of_phase = of_phase.filter(|_| view.ranges.has_offsets);
    let turned = of_offset.chain(of_phase).map(cos_sin);
    // Of offsets that divide the turn evenly, what rounding leaves of a zero is one.
    let of = |value: f64| if value.abs() < LEAST_OF_OFFSET { 0.0 } else { value };
    let functions: Vec<_> = turned.flat_map(|(cosine, sine)| [of(cosine), of(sine)]).enumerate().collect();
    by_frame_after(each(columns), OF_RANGE, view, OF_COMMANDED, &functions)
}

fn further((c, s): (f64, f64), (cosine, sine): (f64, f64)) -> (f64, f64) {
    (c * cosine - s * sine, s * cosine + c * sine)
}

fn phase_shape(_: &Ranges, column: usize) -> String {
    if let Some(column) = column.checked_sub(OF_RANGE) {
        return mode_shape(OF_COMMANDED, column, |n| match n.checked_sub(OF_OFFSET) {
            None => format!("{} cycles a turn of the phase offset", n / 2 + 1),
            Some(n) => format!("{} cycles a turn of the commanded phase", n / 2 + 1),
        });
    }
    let cycles = column / 6 + 1;
    match column % 6 {
        0 | 1 => format!("{cycles} cycles a turn, phase"),
        2 | 3 => format!("{cycles} cycles a turn, offset"),
        _ => format!("{} cycles a turn of the waveform", cycles + 1),
    }
}

fn by_line(view: &View, places: &[Ways]) -> Acting {
    let moment = view.moment;
    let changes = [
        moment.velocity_m_s / view.ranges.speed_m_s.max(1e-9),
        centred(moment),
        2.0 * within(moment.position_m, view.ranges.position_m) - 1.0,
        2.0 * moment.time_s / view.ranges.duration_s[view.take].max(1e-9) - 1.0,
    ];
    let mut columns = Acting::default();
    for number in 0..MODES.len() {
        let base = mode(view, number);
        let pattern = |way: usize| base.iter().zip(places).map(|(b, ways)| b * ways[way]).collect();
        let patterns: [_; LINE_WAYS.len()] = std::array::from_fn(|way| columns.pattern(pattern(way)));
        for (n, &change) in changes.iter().enumerate() {
            for (way, &pattern) in patterns.iter().enumerate() {
                columns.share(LINE_WAYS.len() * (number * CHANGES.len() + n) + way, pattern, change);
            }
        }
    }
    columns
}

fn line_shape(_: &Ranges, column: usize) -> String {
    let of = LINE_WAYS.len();
    mode_shape(of * CHANGES.len(), column, |n| format!("{} {}", LINE_WAYS[n % of], CHANGES[n / of]))
}

/// Periods of patterns in the code, DN.
const PATTERNS: [f64; 6] = [8.0, 16.0, 32.0, 64.0, 128.0, 256.0];

fn code(view: &View) -> Acting {
    let base = &view.frame.base;
    let mut columns: Vec<Vec<f64>> = vec![vec![0.0; base.len()]; CODES + 2 * PATTERNS.len()];
    for (pixel, &signal) in base.iter().enumerate() {
        // Finer where most codes are: at a small signal.
        let place = (signal.max(0.0) / view.ranges.full_scale_dn).sqrt();
        for (hat, value) in hats(place, CODES) {
            columns[hat][pixel] = value;
        }
    }
    let (pedestal_dn, (_, patterns)) = (view.pixels.pedestal_dn, columns.split_at_mut(CODES));
    for (pair, period) in patterns.chunks_exact_mut(2).zip(PATTERNS) {
        let [cosines, sines] = pair else { continue };
        let (cosines, sines, base) = (&mut cosines[..], &mut sines[..], &base[..]);
        widest!((cosines: &'a mut [f64], sines: &'a mut [f64], base: &'a [f64], pedestal_dn: f64, period: f64) {
            for ((cosine, sine), signal) in cosines.iter_mut().zip(sines).zip(base) {
                (*cosine, *sine) = cos_sin(TAU * (signal + pedestal_dn) / period);
            }
        });
    }
    each(columns)
}

fn code_shape(ranges: &Ranges, column: usize) -> String {
    match column.checked_sub(CODES) {
        None => {
            let place = column as f64 / (CODES - 1) as f64;
            format!("at a signal of {:.0} DN", place * place * ranges.full_scale_dn)
        }
        Some(pattern) => format!("with a period of {} DN", PATTERNS[pattern / 2]),
    }
}
