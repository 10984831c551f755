//! The forward simulator: a scene, a waveform, light, charge and noise to raw frames.
//!
//! Frame n of a set samples, as in the recording format,
//! I_n = A_n Σ_m a_m cos(m (k δ − φ_n) + p_m) + B_n, where k is the frame's phase step, and φ_n, A_n and B_n are the
//! pixel's phase, amplitude and offset at the frame's start: an object that moves changes all three from frame to frame.
//!
//! Two ways lead to frames, over one waveform, one sensor and one random stream a frame: [`simulate`] traces a [`Scene`] of moving
//! objects; a [`Chain`] takes a target on a rail through places from encoder to code, at each of which effects of [`EFFECTS`] may act.
//!
//! Absent: exposure times that blur a moving edge.

mod chain;
mod correlation;
mod draws;
mod effect;
pub mod effects;
mod exposure;
mod formula;
mod per_pixel;
mod pixels;
mod powers;
mod pulse;
mod scene;
mod sensor;
mod settled;
mod shape;
mod slopes;
mod stage;
mod trig;

pub use chain::{Chain, Memory};
pub use correlation::{Correlation, FREQUENCY_HZ, Harmonic, Waveform};
pub use draws::Draws;
pub use effect::{Act, Active, Chance, Effect, Fidelity, Parameter, Place};
pub use effects::EFFECTS;
pub use exposure::{Before, Exposure, Included, Moment};
pub use formula::{COORDINATES, Formula, Target};
pub use per_pixel::{PerPixel, root_mean_square};
pub use pixels::{AtFrequency, Pixels, is_same_frequency};
pub use powers::ln;
pub use pulse::Pulse;
pub use scene::{Object, Scene, Surface};
pub use sensor::{Light, Sensor};
pub use settled::{accelerated_s, settled};
pub use shape::{Hit, Shape, Vector};
pub use stage::Stage;
pub use trig::cos_sin;

use crate::frames::RawSets;
use crate::problem::{Problem, Result};
use crate::spec::Scheme;
use crate::units::phase_rad;
use rand_distr::{Distribution, StandardNormal};

/// How the raw frames are taken.
#[derive(Debug, Clone, PartialEq)]
pub struct Acquisition {
    /// The phase steps of a set.
    pub scheme: Scheme,
    /// Raw frames taken one after the other at every phase step, at least 1.
    pub frames_per_step: usize,
    /// The scheme's phase steps in the order in which they are taken.
    pub order: Vec<usize>,
    /// Modulation frequency, Hz, > 0.
    pub frequency_hz: f64,
    /// From the start of a raw frame to the start of the next, s; sets follow each other without a pause.
    pub frame_period_s: f64,
    /// Number of sets.
    pub sets: usize,
}

impl Acquisition {
    /// Raw frames in a set.
    pub fn frames_per_set(&self) -> usize {
        self.order.len() * self.frames_per_step
    }

    /// Start of frame `frame` of set `set`, s.
    fn start_s(&self, set: usize, frame: usize) -> f64 {
        (set * self.frames_per_set() + frame) as f64 * self.frame_period_s
    }

    /// Mean of the starts of a set's frames, s.
    fn middle_s(&self, set: usize) -> f64 {
        (self.start_s(set, 0) + self.start_s(set, self.frames_per_set().saturating_sub(1))) / 2.0
    }
}

/// Takes raw frames of `scene`, and says how far away everything really was.
///
/// The true radial ranges in m, `[set, row, column]`, are those at the middle of the set (the mean of its frames'
/// starts), which is what a symmetric scheme measures of a moving object. NaN where a pixel has no true range: where
/// it sees nothing, or one object at the set's beginning and another later.
///
/// `noise_seed` draws shot and read noise; `None` leaves them out. A frame's noise follows from the seed and the frame's
/// number alone, so codes do not depend on order. Waveform and light avoid the platform's mathematical library. The normal
/// deviates do not quite: about one in a hundred comes from its exponential function or logarithm, whose last bit may differ
/// from machine to machine, and with it, rarely, a code. [`Draws`] would be free of that, and other noise than that of the
/// golden files that are made with these.
///
/// Refuses a sensor without pixels and a set without frames.
pub fn simulate(
    scene: &Scene,
    correlation: &Correlation,
    sensor: &Sensor,
    acquisition: &Acquisition,
    noise_seed: Option<u64>,
) -> Result<(RawSets, Vec<f64>)> {
    let view = |time_s| scene.view(sensor.geometry, sensor.focal_length_px, time_s);
    let object = |surface: Option<Surface>| surface.map(|surface| surface.object);
    let frames_per_set = acquisition.frames_per_set();
    let mut codes = Vec::new();
    let mut true_range_m = Vec::new();
    for set in 0..acquisition.sets {
        let middle = view(acquisition.middle_s(set));
        let mut true_m: Vec<f64> = middle.iter().map(|s| s.map_or(f64::NAN, |s| s.range_m)).collect();
        for frame in 0..frames_per_set {
            let step = acquisition.order[frame / acquisition.frames_per_step];
            let angle_rad = acquisition.scheme.angle_rad(step);
            let mut noise = noise_seed.map(|seed| draws::source(seed, (set * frames_per_set + frame) as u64));
            for (pixel, surface) in view(acquisition.start_s(set, frame)).into_iter().enumerate() {
                if object(surface) != object(middle[pixel]) {
                    true_m[pixel] = f64::NAN;
                }
                let light = sensor.light(surface);
                let phase_rad = surface.map_or(0.0, |s| phase_rad(s.range_m, acquisition.frequency_hz));
                let charge_e = light.amplitude_e * correlation.at(angle_rad - phase_rad) + light.offset_e;
                codes.push(match &mut noise {
                    Some(source) => sensor.noisy_code(charge_e, StandardNormal.sample(source)),
                    None => sensor.code(charge_e),
                });
            }
        }
        true_range_m.extend(true_m);
    }
    let frames = RawSets::new(sensor.geometry, frames_per_set, codes).ok_or_else(|| {
        let found = format!("{} pixels, {frames_per_set} frames a set", sensor.geometry.pixels());
        Problem::at("simulation", found).expected("at least one pixel, and one frame for every phase step")
    })?;
    Ok((frames, true_range_m))
}

#[cfg(test)]
mod tests;
