//! Swings: what whole sets share and comes and goes with a period in time, as a thermostat makes it. Functions of the time are too coarse for more
//! than a few periods, and errors of single sets say little of them.

use super::clusters::MODES;
use super::evidence::of_greatest;
use super::lines::{Sum, agree, strongest};
use std::collections::BTreeMap;

/// Modes that may swing: the first ones of [`MODES`].
pub const SWINGING: usize = 3;

/// A set: its recording, its time (s), and what it says of each mode.
type Seen = (usize, f64, [Sum; SWINGING]);

/// What all sets say.
#[derive(Debug, Clone, Default)]
pub struct Swings {
    sets: Vec<Seen>,
}

/// The strongest swing of a mode.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swing {
    /// Its mode.
    pub mode: &'static str,
    /// Its frequency, Hz.
    pub hz: f64,
    /// Evidence, nats.
    pub ln_bayes: f64,
    /// Chi squared that it explains, and by how many numbers.
    pub chi2: (f64, usize),
    /// Frequencies that were looked at.
    pub looked: f64,
}

/// Fewer cycles over the longest recording are a drift.
const LEAST_CYCLES: f64 = 2.0;
/// Sets that a recording has at least.
const LEAST_SETS: usize = 16;
/// Recordings at least: in one alone, what comes again with the position or the phase does so in time.
const LEAST_TAKES: usize = 2;
/// Standard deviations that a set is taken to be off at most.
const MOST: f64 = 4.0;
/// Frequencies that are looked at, at most.
const MOST_CYCLES: f64 = 20_000.0;

impl Swings {
    /// With one more set.
    pub fn add(&mut self, take: usize, time_s: f64, modes: [Sum; SWINGING]) {
        let tame = |(score, information): Sum| {
            let most = MOST * information.sqrt();
            (score.clamp(-most, most), information)
        };
        self.sets.push((take, time_s, modes.map(tame)));
    }

    /// Those of both.
    pub fn and(mut self, other: Self) -> Self {
        self.sets.extend(other.sets);
        self
    }

    /// The strongest of each mode, with a phase of its own in each recording and of the same size in all.
    pub fn strongest(&self) -> Vec<Swing> {
        (0..SWINGING).filter_map(|mode| self.of_mode(mode)).collect()
    }

    fn of_mode(&self, mode: usize) -> Option<Swing> {
        let mut takes: BTreeMap<usize, Vec<(f64, Sum)>> = BTreeMap::new();
        for (take, time_s, modes) in self.sets.iter().filter(|set| set.2[mode].1 > 0.0) {
            takes.entry(*take).or_default().push((*time_s, modes[mode]));
        }
        takes.retain(|_, sets| sets.len() >= LEAST_SETS);
        let mut takes: Vec<_> = takes.into_values().collect();
        if takes.len() < LEAST_TAKES {
            return None;
        }
        takes.iter_mut().for_each(|sets| sets.sort_by(|a, b| a.0.total_cmp(&b.0)));
        let longest_s = takes.iter().map(|sets| sets[sets.len() - 1].0 - sets[0].0).fold(0.0, f64::max);
        let between_s = takes.iter().flat_map(|sets| sets.windows(2).map(|pair| pair[1].0 - pair[0].0));
        let shortest_s = between_s.filter(|s| *s > 0.0).fold(f64::INFINITY, f64::min);
        if !longest_s.is_finite() || longest_s <= 0.0 {
            return None;
        }
        let ends = (LEAST_CYCLES / longest_s, (0.5 / shortest_s).min(MOST_CYCLES / longest_s));
        if ends.0 >= ends.1 {
            return None;
        }
        let line = strongest(&takes, ends, 0.0)?;
        if !agree(&line.sizes) {
            return None;
        }
        // Errors of sets that are white raise all frequencies alike.
        let numbers = 2 * takes.len();
        let all = takes.iter().flatten().map(|(_, (score, information))| score * score / information);
        let others = takes.iter().map(Vec::len).sum::<usize>() - numbers;
        let noise = ((all.sum::<f64>() - line.chi2) / others as f64).max(1.0);
        let chi2 = line.chi2 / noise;
        let ln_bayes = of_greatest(chi2, numbers, line.looked);
        Some(Swing {
            mode: MODES[mode],
            hz: line.frequency,
            ln_bayes,
            chi2: (chi2, numbers),
            looked: line.looked,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;
    use std::f64::consts::TAU;

    /// Of two recordings of 120 sets each, a fifth of a second from one to the next, with so many standard deviations of noise.
    fn swing(noise: f64, phase: impl Fn(usize, f64) -> f64) -> Option<Swing> {
        let mut swings = Swings::default();
        for take in 0..2_usize {
            let draws = Draws::of(11, take as u64).normal(120);
            for (set, draw) in draws.iter().enumerate() {
                let time_s = 0.2 * set as f64;
                let sum = noise * draw + phase(take, time_s);
                swings.add(take, time_s, [(0.0, 0.0), (0.0, 0.0), (sum, 1.0)]);
            }
        }
        swings.strongest().into_iter().next()
    }

    #[test]
    fn a_thermostat_is_found_below_the_noise() {
        let found = swing(1.0, |take, time_s| 0.8 * (TAU * time_s / 3.1 + take as f64).sin()).unwrap();
        assert!(found.ln_bayes > 4.0 && (found.hz - 1.0 / 3.1).abs() < 0.02, "{found:?}");
        assert_eq!(found.mode, "phase");
    }

    #[test]
    fn noise_does_not_swing_even_where_there_is_more_of_it() {
        for noise in [1.0, 3.0] {
            let found = swing(noise, |_, _| 0.0);
            assert!(found.is_none_or(|swing| swing.ln_bayes < 1.0), "{noise}: {found:?}");
        }
    }

    #[test]
    fn what_one_recording_alone_shows_is_no_swing() {
        let found = swing(1.0, |take, time_s| if take == 0 { 1.5 * (TAU * time_s / 3.1).sin() } else { 0.0 });
        assert_eq!(found, None);
    }
}
