//! Swings: what whole sets share and comes and goes with a period in time, as a thermostat makes it, or with a number of sets, as a buffer of several does. Functions of the
//! time are too coarse for more than a few periods, and errors of single sets say little of them.

use super::levels::MODES;
use crate::diagnose::periodic::lines::{blur, strongest};
use crate::diagnose::statistics::amplitudes::agree;
use crate::diagnose::statistics::evidence::Greatest;
use crate::diagnose::statistics::periodogram::{FINENESS, Sum, chi2, power};
use std::collections::{BTreeMap, BTreeSet};

/// Modes that may swing: the first ones of [`MODES`].
pub const SWINGING: usize = 3;

/// A set.
#[derive(Debug, Clone, Copy)]
pub struct Seen {
    /// Its recording.
    pub take: usize,
    /// Its number in that.
    pub number: usize,
    /// When it was taken, s.
    pub time_s: f64,
    /// Phase offset (rad) and commanded position (m).
    pub at: [f64; 2],
    /// What it says of each mode.
    pub modes: [Sum; SWINGING],
}

/// What all sets say.
#[derive(Debug, Clone, Default)]
pub struct Swings {
    sets: Vec<Seen>,
}

/// When swings come again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Comes {
    /// With a frequency, Hz.
    Hz(f64),
    /// With every so many sets, whenever those are taken.
    EverySets(usize),
}

/// What swings go with: the time, or the number of the set.
type Clock = fn(&Seen) -> f64;

/// A recording's sets: when, and what they say of a mode.
type Take = Vec<(f64, Sum)>;

/// The strongest line of a mode, by one clock.
struct Found {
    /// Its frequency: Hz, or cycles a set.
    frequency: f64,
    /// What it says among all frequencies.
    found: Greatest,
    /// What the recordings say.
    takes: Vec<Take>,
}

/// The strongest swing of a mode.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swing {
    /// Its mode.
    pub mode: &'static str,
    /// When it comes again.
    pub comes: Comes,
    /// What it says among all frequencies.
    pub found: Greatest,
}

/// Fewer cycles over the longest recording are a drift.
const LEAST_CYCLES: f64 = 2.0;
/// Sets that a recording has at least.
pub const LEAST_SETS: usize = 16;
/// A line's numbers in a recording: cosine and sine.
const NUMBERS: usize = 2;
/// Standard deviations that a set is taken to be off at most.
const MOST: f64 = 10.0;
/// A swing of every other set is off by fewer cycles over a recording.
const ALTERNATING_CYCLES: f64 = 1.0;
/// One whose period is a number of sets, up to so many, by fewer: a step of the scan is a quarter of a cycle, and its last one may be that far from the
/// end.
const OFF_CYCLES: f64 = 0.3;
const MOST_SETS: usize = 12;
/// What is looked at: times, and numbers of sets.
const CLOCKS: f64 = 2.0;
/// A swing that goes with the sets' numbers says more than one in time, nats: of sets that are evenly apart both say the same.
const CLEARLY_NATS: f64 = 3.0;
/// Products of frequencies and sets that are looked at, at most.
const MOST_PRODUCTS: f64 = 2e8;

impl Swings {
    /// With one more set.
    pub fn add(&mut self, mut seen: Seen) {
        for (score, information) in &mut seen.modes {
            let most = MOST * information.sqrt();
            *score = score.clamp(-most, most);
        }
        self.sets.push(seen);
    }

    /// Those of both.
    pub fn and(mut self, other: Self) -> Self {
        self.sets.extend(other.sets);
        self
    }

    /// The strongest of each mode, with a phase of its own in each recording and of the same size in all.
    pub fn strongest(&self) -> Vec<Swing> {
        (0..SWINGING).filter_map(|mode| self.swing(mode)).collect()
    }

    /// That of a mode.
    fn swing(&self, mode: usize) -> Option<Swing> {
        let in_time = self.of_mode(mode, |set| set.time_s);
        let by_number = self.of_mode(mode, |set| set.number as f64);
        let ln_bayes = |line: &Option<Found>| line.as_ref().map_or(0.0, |line| line.found.ln_bayes);
        let clearly = ln_bayes(&by_number) > ln_bayes(&in_time) + CLEARLY_NATS;
        let swing = |comes, found| Swing { mode: MODES[mode], comes, found };
        let period = by_number.filter(|_| clearly).and_then(|line| {
            let sets = line.period().filter(|&sets| !self.settings_come_again(sets))?;
            Some(swing(Comes::EverySets(sets), line.found))
        });
        period.or_else(|| {
            let line = in_time?;
            let comes = if line.alternates() { Comes::EverySets(2) } else { Comes::Hz(line.frequency) };
            Some(swing(comes, line.found))
        })
    }

    /// Whether all recordings are at the same phase offset and position again after so many `sets`: what goes with these does so with the sets' numbers.
    fn settings_come_again(&self, sets: usize) -> bool {
        let mut takes: BTreeMap<usize, BTreeMap<usize, [f64; 2]>> = BTreeMap::new();
        for seen in &self.sets {
            takes.entry(seen.take).or_default().insert(seen.number, seen.at);
        }
        let again = |take: &BTreeMap<usize, [f64; 2]>| {
            take.iter().all(|(number, at)| take.get(&(number + sets)).is_none_or(|later| later == at))
        };
        takes.values().all(again)
    }

    /// The recordings that say something of a mode; none where all of them move alike, because there what comes again with the phase or the position
    /// does so in time.
    fn takes(&self, mode: usize, clock: Clock) -> Vec<Take> {
        let mut takes: BTreeMap<usize, Vec<&Seen>> = BTreeMap::new();
        for seen in self.sets.iter().filter(|seen| seen.modes[mode].1 > 0.0) {
            takes.entry(seen.take).or_default().push(seen);
        }
        takes.retain(|_, sets| sets.len() >= LEAST_SETS);
        if !move_apart(takes.values().map(|sets| sets.iter().map(|set| set.at))) {
            return Vec::new();
        }
        let of_mode = |mut sets: Vec<&Seen>| {
            sets.sort_by(|a, b| clock(a).total_cmp(&clock(b)));
            let sums = sets.iter().map(|set| set.modes[mode]);
            let (score, information) = sums.fold((0.0, 0.0), |sum, set| (sum.0 + set.0, sum.1 + set.1));
            let mean = score / information;
            sets.iter()
                .map(|set| (clock(set), (set.modes[mode].0 - mean * set.modes[mode].1, set.modes[mode].1)))
                .collect()
        };
        takes.into_values().map(of_mode).collect()
    }

    /// The strongest line of a mode.
    fn of_mode(&self, mode: usize, clock: Clock) -> Option<Found> {
        let mut takes = self.takes(mode, clock);
        let longest_s = takes.iter().map(|sets| sets[sets.len() - 1].0 - sets[0].0).fold(0.0, f64::max);
        let usual_s = usual(takes.iter().flat_map(gaps).collect())?;
        let sets = takes.iter().map(Vec::len).sum::<usize>() as f64;
        let most = MOST_PRODUCTS / (sets * FINENESS * longest_s);
        let ends = (LEAST_CYCLES / longest_s, (0.5 / usual_s).min(most));
        if !longest_s.is_finite() || ends.0.is_nan() || ends.0 >= ends.1 {
            return None;
        }
        // Errors of sets that are white raise all frequencies of a recording alike.
        let frequency = strongest(&takes, ends, 0.0)?.frequency;
        for take in &mut takes {
            let others = chi2(take) - power(take, frequency);
            let noise = (others / (take.len() - NUMBERS) as f64).max(1.0);
            take.iter_mut().for_each(|(_, sum)| *sum = (sum.0 / noise, sum.1 / noise));
        }
        let line = strongest(&takes, ends, 0.0)?;
        let size = |take: &Take| {
            let sigma = blur(take.iter().map(|(_, sum)| sum.1).sum());
            (sigma * power(take, line.frequency).sqrt(), sigma)
        };
        let sizes: Vec<(f64, f64)> = takes.iter().map(size).collect();
        let found = Greatest::of(line.chi2, NUMBERS * takes.len(), CLOCKS * line.looked);
        agree(&sizes).then_some(Found { frequency: line.frequency, found, takes })
    }
}

impl Found {
    /// Whether what comes again in time does so with every other set.
    fn alternates(&self) -> bool {
        self.takes.iter().all(|take| {
            let off_hz = 0.5 / usual(gaps(take)).unwrap_or(f64::NAN) - self.frequency;
            off_hz.abs() * span(take) < ALTERNATING_CYCLES
        })
    }

    /// The period of what comes again by the sets' numbers, in sets; nothing where it is no whole one, or may be several.
    fn period(&self) -> Option<usize> {
        let longest = self.takes.iter().map(span).fold(0.0, f64::max);
        let is_near = |turns: usize, sets: usize| {
            (self.frequency - turns as f64 / sets as f64).abs() * longest < OFF_CYCLES
        };
        let near = |sets: usize| (1..sets).any(|turns| is_coprime(turns, sets) && is_near(turns, sets));
        let mut periods = (2..=MOST_SETS).filter(|&sets| near(sets));
        let period = periods.next()?;
        periods.next().is_none().then_some(period)
    }
}

fn is_coprime(one: usize, other: usize) -> bool {
    (2..=one.min(other)).all(|divisor| !one.is_multiple_of(divisor) || !other.is_multiple_of(divisor))
}

/// Whether recordings, each `at` these phase offsets and positions, do not all move alike.
pub fn move_apart<T: Iterator<Item = [f64; 2]>>(takes: impl Iterator<Item = T>) -> bool {
    let moves = |mut at: T| {
        let first = at.next();
        let differs = |way: usize, at: [f64; 2]| first.is_some_and(|first| first[way] != at[way]);
        at.fold([false; 2], |moves, at| [0, 1].map(|way| moves[way] || differs(way, at)))
    };
    takes.map(moves).collect::<BTreeSet<[bool; 2]>>().len() > 1
}

/// From the first set to the last.
fn span(take: &Take) -> f64 {
    take[take.len() - 1].0 - take[0].0
}

/// Times from set to set, s.
fn gaps(take: &Take) -> Vec<f64> {
    take.windows(2).map(|pair| pair[1].0 - pair[0].0).collect()
}

/// The median of those that are times.
pub fn usual(mut gaps_s: Vec<f64>) -> Option<f64> {
    gaps_s.retain(|s| *s > 0.0);
    gaps_s.sort_by(f64::total_cmp);
    gaps_s.get(gaps_s.len() / 2).copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;
    use std::f64::consts::TAU;

    /// Of a sweep and a rail of 120 sets each, a fifth of a second from one to the next, with so many standard deviations of noise in each.
    fn swing(seed: u64, noise: [f64; 2], phase: impl Fn(usize, f64) -> f64) -> Option<Swing> {
        let mut swings = Swings::default();
        for take in 0..2_usize {
            let draws = Draws::of(seed, take as u64).normal(120);
            for (set, draw) in draws.iter().enumerate() {
                let time_s = 0.2 * set as f64;
                let mut at = [0.0; 2];
                at[take] = set as f64;
                let sum = noise[take] * draw + phase(take, time_s);
                let modes = [(0.0, 0.0), (0.0, 0.0), (sum, 1.0)];
                swings.add(Seen { take, number: set, time_s, at, modes });
            }
        }
        swings.strongest().into_iter().next()
    }

    fn hz(swing: Swing) -> f64 {
        if let Comes::Hz(hz) = swing.comes { hz } else { f64::NAN }
    }

    fn thermostat(take: usize, time_s: f64) -> f64 {
        0.8 * (TAU * time_s / 3.1 + take as f64).sin()
    }

    #[test]
    fn a_thermostat_is_found_below_the_noise() {
        let found = swing(11, [1.0, 1.0], thermostat).unwrap();
        assert!(found.found.ln_bayes > 4.0 && (hz(found) - 1.0 / 3.1).abs() < 0.02, "{found:?}");
        assert_eq!(found.mode, "phase");
        // It is as strong in the recording that has more noise, and in both where a set is far above the noise.
        assert!(swing(12, [0.5, 1.5], thermostat).is_some_and(|found| found.found.ln_bayes > 4.0));
        let strong = swing(13, [1.0, 1.0], |take, time_s| 8.0 * thermostat(take, time_s)).unwrap();
        assert!(strong.found.ln_bayes > 100.0, "{strong:?}");
    }

    #[test]
    fn what_changes_its_sign_from_set_to_set_alternates() {
        let alternates = |period_s: f64| {
            let swings = swing(14, [1.0, 1.0], |_, time_s| (TAU * time_s / period_s + 0.7).cos()).unwrap();
            swings.comes == Comes::EverySets(2)
        };
        assert!(alternates(0.4) && !alternates(0.42) && !alternates(0.5) && !alternates(3.1));
    }

    /// A sweep of so many sets, and as many of a rail that comes back after each run of `run`, which takes longer each time: with the noise of one, what each set
    /// has by its number.
    fn with_runs(sets: usize, run: usize, seed: u64, of_set: impl Fn(usize) -> f64) -> Option<Swing> {
        let mut swings = Swings::default();
        for take in 0..2_usize {
            let draws = Draws::of(seed, take as u64).normal(sets);
            for (number, draw) in draws.iter().enumerate() {
                let runs = if take == 1 { (number / run) as f64 } else { 0.0 };
                let time_s = 0.2 * (number as f64 + 7.3 * runs + 0.9 * runs * runs);
                let at = [take * (number % run), (1 - take) * number].map(|at| at as f64);
                let modes = [(0.0, 0.0), (0.0, 0.0), (draw + of_set(number), 1.0)];
                swings.add(Seen { take, number, time_s, at, modes });
            }
        }
        swings.strongest().into_iter().next()
    }

    /// What every fifth set has of its own, or comes again with seven or eleven of them, whenever these are taken; and nothing of a period that is no number of sets.
    #[test]
    fn a_period_may_be_a_number_of_sets() {
        let fifth = with_runs(240, 13, 15, |number| if number % 5 == 3 { 2.0 } else { 0.0 }).unwrap();
        assert_eq!((fifth.mode, fifth.comes), ("phase", Comes::EverySets(5)), "{fifth:?}");
        let wave = |sets: usize, period: f64| {
            let wave = with_runs(sets, 13, 16, |number| 2.0 * (TAU * number as f64 / period).cos());
            wave.map(|wave| wave.comes)
        };
        for period in [2, 3, 7, 10, 11, 12] {
            assert_eq!(wave(102, period as f64), Some(Comes::EverySets(period)), "{period}");
        }
        assert!(!matches!(wave(102, 5.37), Some(Comes::EverySets(_))));
        // Few sets do not tell eleven from twelve.
        assert!(!matches!(wave(26, 11.5), Some(Comes::EverySets(_))));
    }

    /// Runs of twelve sets come again to the same places, and what goes with these comes again with twelve sets.
    #[test]
    fn what_comes_again_with_the_settings_is_no_period_of_sets() {
        let mut swings = Swings::default();
        let mut add = |take: usize, number: usize| {
            let modes = [(0.0, 0.0), (0.0, 0.0), (3.0 * (TAU * number as f64 / 12.0).sin(), 1.0)];
            let at = [take * (number % 12), (1 - take) * (number % 12)].map(|at| at as f64);
            let time_s = 0.2 * (number as f64 + 7.3 * (take * (number / 12)) as f64);
            swings.add(Seen { take, number, time_s, at, modes });
        };
        (0..240).for_each(|number| [0, 1].into_iter().for_each(|take| add(take, number)));
        assert!(swings.settings_come_again(12) && !swings.settings_come_again(6));
        assert!(!swings.strongest().iter().any(|swing| matches!(swing.comes, Comes::EverySets(_))));
    }

    #[test]
    fn noise_has_no_period_of_sets() {
        let alarms = (0..200).filter(|seed| {
            with_runs(102, 13, *seed, |_| 0.0).is_some_and(|swing| swing.found.ln_bayes > 1.0)
        });
        assert_eq!(alarms.count(), 0);
    }

    #[test]
    fn noise_does_not_swing_even_where_there_is_more_of_it() {
        for noise in [[1.0, 1.0], [3.0, 3.0], [1.0, 4.0]] {
            let alarms = (0..200).filter(|seed| {
                swing(*seed, noise, |_, _| 0.0).is_some_and(|swing| swing.found.ln_bayes > 1.0)
            });
            assert_eq!(alarms.count(), 0, "{noise:?}");
        }
    }

    #[test]
    fn what_one_recording_alone_shows_is_no_swing() {
        let found = swing(
            11,
            [1.0, 1.0],
            |take, time_s| if take == 0 { 1.5 * (TAU * time_s / 3.1).sin() } else { 0.0 },
        );
        assert_eq!(found, None);
    }

    #[test]
    fn recordings_that_move_alike_and_odd_times_show_nothing() {
        let swings = |at: f64, time_s: &dyn Fn(usize) -> f64| {
            let mut swings = Swings::default();
            for (take, set) in (0..2 * LEAST_SETS).map(|n| (n / LEAST_SETS, n % LEAST_SETS)) {
                let modes = [((set % 3) as f64, 1.0); SWINGING];
                swings.add(Seen {
                    take,
                    number: set,
                    time_s: time_s(set),
                    at: [set as f64, at * (take * set) as f64],
                    modes,
                });
            }
            swings.strongest()
        };
        assert_eq!(swings(0.0, &|set| set as f64).len(), 0);
        for time_s in [0.0, f64::NAN, f64::INFINITY] {
            assert_eq!(swings(1.0, &|_| time_s).len(), 0, "{time_s}");
        }
        // Nor do they take long.
        swings(1.0, &|set| if set == 1 { 1e9 } else { 1e-9 * set as f64 });
    }
}
