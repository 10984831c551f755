//! Random worlds.

use crate::frames::Geometry;
use crate::time_domain::{Programme, Pulse, Scene, Sensor, Waveform, World};
use rand::seq::IndexedRandom;
use rand::{Rng, RngExt};

/// Sensor sizes, in pixels.
const SIZES: [(usize, usize); 6] = [(12, 10), (14, 12), (16, 12), (20, 15), (24, 18), (32, 24)];
/// Most pixels times frames of a campaign.
const MOST_SAMPLES: usize = 900_000;
/// Focal length over width: a field of view of about 40 degrees.
const FOCAL_LENGTH: f64 = 1.375;

/// What is drawn, before anything of it is built.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Any size.
    Any,
    /// The smallest sensor, few sets.
    Tiny,
}

/// A random world; with the carriage moving, where `motion` asks for it.
pub fn world<R: Rng>(random: &mut R, motion: bool, scale: Scale) -> World {
    let (width, height) = match scale {
        Scale::Tiny => SIZES[0],
        Scale::Any => *SIZES.choose(random).unwrap_or(&SIZES[0]),
    };
    let geometry = Geometry { width, height };
    let sensor = Sensor {
        adc_bits: 12,
        pedestal_dn: 64.0,
        gain_e_per_dn: f64::from(random.random_range(8..=16)),
        read_noise_e: f64::from(random.random_range(15..=60)),
        focal_length_px: FOCAL_LENGTH * width as f64,
    };
    let waveform = waveform(random);
    // The brightest pixel at the nearest place is well within the converter's range.
    let brightest_dn = random.random_range(0.35..0.75) * (sensor.full_scale_dn() - sensor.pedestal_dn);
    let ambient_dn = random.random_range(0.02..0.08) * sensor.full_scale_dn();
    let brightest_e = (brightest_dn - ambient_dn) * sensor.gain_e_per_dn / (1.0 + waveform.mean());
    let ambient_e = ambient_dn * sensor.gain_e_per_dn;
    let scene = Scene::random(geometry, sensor.focal_length_px, brightest_e, ambient_e, random.random());
    let programme = programme(random, motion, scale);
    let seed = random.random();
    let takes = fitting(programme, geometry, seed);
    let frequency_hz = *[20e6, 30e6, 30e6, 30e6, 40e6].choose(random).unwrap_or(&30e6);
    World { scene, sensor, frequency_hz, waveform, takes }
}

/// Light and gate with edges of a few nanoseconds.
fn waveform<R: Rng>(random: &mut R) -> Waveform {
    let mut pulse = |duty: f64, floor: f64| Pulse {
        duty,
        rise: random.random_range(0.08..0.25),
        fall: random.random_range(0.08..0.25),
        pole: random.random_range(0.05..0.1),
        floor,
    };
    let light = pulse(0.5, 0.0);
    let gate = pulse(0.5, 0.15);
    let duty = if random.random_bool(0.4) { random.random_range(0.44..0.54) } else { 0.5 };
    Waveform::of(&Pulse { duty, ..light }.samples(), &gate.samples())
}

fn programme<R: Rng>(random: &mut R, motion: bool, scale: Scale) -> Programme {
    if scale == Scale::Tiny {
        return Programme {
            schemes: [true, false],
            offsets: 12,
            positions: 12,
            runs: usize::from(motion),
            dark: 0,
            harmonics: 0,
            period_s: 0.025,
        };
    }
    let schemes =
        *[[true, false], [false, true], [true, true], [true, true]].choose(random).unwrap_or(&[true; 2]);
    let mut maybe = |share: f64, low: usize, high: usize| {
        if random.random_bool(share) { random.random_range(low..=high) } else { 0 }
    };
    Programme {
        schemes,
        offsets: maybe(0.9, 16, 48),
        positions: maybe(1.0, 18, 51),
        runs: if motion { maybe(1.0, 1, 3) } else { maybe(0.65, 1, 3) },
        dark: maybe(0.3, 10, 40),
        harmonics: maybe(0.3, 3, 9),
        period_s: *[0.02, 0.025, 0.025, 0.03125].choose(random).unwrap_or(&0.025),
    }
}

/// The recordings of `programme`, made shorter until they are no more than [`MOST_SAMPLES`].
fn fitting(mut programme: Programme, geometry: Geometry, seed: u64) -> Vec<crate::time_domain::Take> {
    loop {
        let takes = programme.takes(seed);
        let frames: usize = takes.iter().map(|take| take.rows.len() * take.steps_rad.len()).sum();
        if frames * geometry.pixels() <= MOST_SAMPLES {
            return takes;
        }
        let least = programme;
        programme.runs = programme.runs.min(if programme.runs > 1 { programme.runs - 1 } else { 1 });
        programme.offsets = (programme.offsets * 4 / 5).max(12.min(programme.offsets));
        programme.positions = (programme.positions * 4 / 5).max(15.min(programme.positions));
        if programme == least {
            return takes;
        }
    }
}
