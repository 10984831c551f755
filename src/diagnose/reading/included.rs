//! What the description of a camera includes beside what a prediction shows: errors and noise at random, and low bits that are cut off.

use super::data::Data;
use crate::diagnose::fitting::set_errors::Jitter;
use crate::diagnose::shared_errors::random::{EXCESS_NOISE, JITTERS, RandomEffect};
use crate::physics::{Active, Effect, effects};

/// A random effect is more than the camera includes where it is stronger by so many standard deviations: what was found in one campaign, and is included since, is
/// found again in the next one as exactly as that shows it.
const MORE_SIGMAS: f64 = 5.0;

/// What no sample's prediction shows.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Unpredicted {
    /// Random errors of frames, of the phase (rad) and of the time (s).
    pub jitter: Jitter,
    /// Noise in proportion to the signal, relative, squared.
    pub square: f64,
    /// Low bits of the codes that are cut off.
    pub bits_cut: u32,
}

impl Unpredicted {
    /// Of the effects that a camera includes in each of its recordings: what acts in all of them.
    pub fn of<'a>(recordings: impl Iterator<Item = &'a [Active]>) -> Self {
        let names = [JITTERS[0], JITTERS[1], EXCESS_NOISE, effects::FIXED_POINT];
        let strengths = |effects: &[Active]| {
            names.map(|name| {
                let of_name = effects.iter().filter(|active| active.effect.name == name);
                let values = of_name.map(|active| active.values[0]);
                // What is there twice has the same deviates, and a bit is cut off once.
                if name == effects::FIXED_POINT { values.fold(0.0, f64::max) } else { values.sum() }
            })
        };
        let least = |one: [f64; 4], other: [f64; 4]| std::array::from_fn(|n| one[n].min(other[n]));
        let [phase_rad, time_s, relative, bits] = recordings.map(strengths).reduce(least).unwrap_or_default();
        // Bits are whole numbers of a few.
        Self { jitter: [phase_rad, time_s], square: relative * relative, bits_cut: bits as u32 }
    }

    /// Whether the camera includes this `jitter`, as strong as it was found or stronger.
    pub fn includes(&self, jitter: &RandomEffect) -> bool {
        let number = JITTERS.iter().position(|name| *name == jitter.name);
        let included = number.map_or(0.0, |number| self.jitter[number]);
        included > 0.0 && jitter.strength.value < included + MORE_SIGMAS * jitter.strength.sigma
    }
}

/// How much of each number of `effect` the camera of `data` includes in every one of the recordings `takes`, as far as strengths tell it.
pub fn included_of(data: &Data, effect: &Effect, takes: &[usize]) -> Vec<f64> {
    // What is less is certainly included.
    let least = |one: f64, other: f64| {
        if one * other > 0.0 { one.signum() * one.abs().min(other.abs()) } else { 0.0 }
    };
    let of = |number: usize| {
        let of_take = |&take: &usize| Active::in_all(&data.takes[take].included, effect, number);
        takes.iter().map(of_take).reduce(least).unwrap_or(0.0)
    };
    (0..effect.parameters.len()).map(of).collect()
}
