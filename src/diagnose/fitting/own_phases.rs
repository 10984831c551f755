//! What pixels' own phases are at several modulation frequencies, which no recording states: of a camera whose clock paths delay they grow with the frequency,
//! of one whose phase shifter is per pixel they do not, and where the phase of all pixels begins is another at each frequency.

use super::start::numbers;
use crate::diagnose::reading::data::{Data, Take};
use crate::diagnose::reading::frequencies::{Frequency, others, usual};
use crate::diagnose::statistics::median::median;
use crate::frames::Geometry;
use crate::physics::AtFrequency;
use crate::units::wrap_rad;
use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

/// Own phases at frequencies other than the usual one, which is that of most frames.
#[derive(Debug, Clone, Default)]
pub struct OwnPhases {
    /// At each.
    others: Vec<(Frequency, AtFrequency)>,
    /// Those at the usual one, rad: a value a pixel; empty where there is no other.
    usual_rad: Vec<f64>,
    /// Their mean, rad.
    mean_rad: f64,
}

/// A pixel that has less of the usual amplitude has no phase to speak of.
const LEAST_SHARE: f64 = 0.1;
/// Fewer pixels do not tell phases from delays.
const LEAST_PIXELS: usize = 30;
/// Own phases are delays where that is clear by so many nats.
const DELAY_NATS: f64 = 10.0;
/// Patterns of what pixels have at two frequencies are one where they agree by so many standard deviations of what noise makes.
const ALIKE: f64 = 4.0;
/// Pixels that are so many times as far off as usual (median) do not see what others do.
const FAR_OFF: f64 = 7.0;

impl OwnPhases {
    /// What the sets of which `counts` is true say of them.
    pub fn of(data: &Data, counts: &(dyn Fn(usize) -> bool + Sync)) -> Self {
        let others = others(&data.takes);
        let Some(usual) = usual(&data.takes).filter(|_| !data.assumed.still_scene) else {
            return Self::default();
        };
        let sets = data.sets();
        let seen = |frequency: Frequency| {
            let is_of = |set: usize| {
                counts(set) && Frequency::of(&data.takes[sets[set].0]).is_some_and(|of| of == frequency)
            };
            let [amplitude, phase_rad, ..] = numbers(data, &is_of, &Self::default());
            // Light falls with the square of the distance, and what a phase is known to with light.
            let lit = data.lit().filter(|moment| Frequency { hz: moment.frequency_hz } == frequency);
            let information = lit.map(|moment| moment.commanded_m().powi(-4)).sum();
            Phasors { amplitude, phase_rad, information }
        };
        let mut at_usual = seen(usual);
        let mean_rad = at_usual.unwrapped(&data.target);
        let at = |frequency: Frequency| {
            let delays = frequency.hz / usual.hz;
            let (times, phase_rad) = at_usual.beside(&seen(frequency), data.geometry(), &data.target, delays);
            (frequency, AtFrequency { frequency_hz: frequency.hz, times, phase_rad })
        };
        Self { others: others.into_iter().map(at).collect(), usual_rad: at_usual.phase_rad, mean_rad }
    }

    /// What there is to be said of pixels.
    pub fn at_frequencies(&self) -> Vec<AtFrequency> {
        self.others.iter().map(|(_, at)| *at).collect()
    }

    /// The number of a recording's frequency among [`Self::besides_rad`].
    pub fn number(&self, take: &Take) -> usize {
        let frequency = Frequency::of(take);
        let place = self.others.iter().position(|(other, _)| frequency.is_some_and(|of| of == *other));
        place.map_or(0, |place| place + 1)
    }

    /// What pixels have besides their own phases at the usual frequency, rad, a value each: there nothing, and at each of the others.
    pub fn besides_rad(&self, pixels: usize) -> Vec<Vec<f64>> {
        let of = |at: &AtFrequency| -> Vec<f64> {
            self.usual_rad.iter().map(|own_rad| (at.times - 1.0) * own_rad + at.phase_rad).collect()
        };
        std::iter::once(vec![0.0; pixels]).chain(self.others.iter().map(|(_, at)| of(at))).collect()
    }

    /// A pixel's own phase at the usual frequency, but for turns, where it is counted together with those of the others.
    pub fn beside_others(&self, phase_rad: f64) -> f64 {
        if self.others.is_empty() { phase_rad } else { self.mean_rad + wrap_rad(phase_rad - self.mean_rad) }
    }
}

/// Amplitudes and phases, a value a pixel.
struct Phasors {
    amplitude: Vec<f64>,
    phase_rad: Vec<f64>,
    /// What phases are known to is the inverse root of this, in units that are the same at all frequencies.
    information: f64,
}

impl Phasors {
    fn phasor(&self, pixel: usize) -> Complex64 {
        Complex64::from_polar(self.amplitude[pixel], self.phase_rad[pixel])
    }

    /// Brings all phases to within half a turn of those of the target's mean, which it gives, rad.
    fn unwrapped(&mut self, target: &[bool]) -> f64 {
        let of_target = (0..target.len()).filter(|&pixel| target[pixel]);
        let mean_rad = of_target.map(|pixel| self.phasor(pixel)).sum::<Complex64>().arg();
        self.phase_rad.iter_mut().for_each(|phase| *phase = mean_rad + wrap_rad(*phase - mean_rad));
        mean_rad
    }

    /// Which pixels of the `target` have the usual amplitude.
    fn bright(&self, target: &[bool]) -> Vec<bool> {
        let mut all: Vec<f64> =
            self.amplitude.iter().zip(target).filter(|(_, is_target)| **is_target).map(|(a, _)| *a).collect();
        let least = LEAST_SHARE * median(&mut all);
        self.amplitude.iter().zip(target).map(|(amplitude, target)| *target && *amplitude > least).collect()
    }

    /// What pixels of the `target` have at another frequency beside what they have here: so many times these phases (once, or, where they are `delays`, as the frequencies
    /// are), and something that all have besides, rad.
    fn beside(&self, other: &Self, geometry: Geometry, target: &[bool], delays: f64) -> (f64, f64) {
        let (here, there) = (self.bright(target), other.bright(target));
        let mut seen: Vec<usize> = (0..target.len()).filter(|&pixel| here[pixel] && there[pixel]).collect();
        // The phase that all have besides own phases which count so many times, and what that leaves of each.
        let left = |seen: &[usize], times: f64| {
            let own =
                |pixel: usize| Complex64::from_polar(self.amplitude[pixel], times * self.phase_rad[pixel]);
            let sum: Complex64 = seen.iter().map(|&pixel| other.phasor(pixel) * own(pixel).conj()).sum();
            let common_rad = sum.arg();
            let of = |pixel: &usize| {
                wrap_rad(other.phase_rad[*pixel] - times * self.phase_rad[*pixel] - common_rad)
            };
            (common_rad, DVector::from_iterator(seen.len(), seen.iter().map(of)))
        };
        let untrended = |seen: &[usize], times: f64| without_trend(geometry, seen, &left(seen, times).1);
        if seen.len() >= LEAST_PIXELS {
            let far = [1.0, delays].map(|times| {
                let left = untrended(&seen, times).abs();
                let usual = median(&mut left.as_slice().to_vec());
                left.iter().map(|left| *left > FAR_OFF * usual).collect::<Vec<_>>()
            });
            let stays = |place: usize| far.iter().all(|far| !far[place]);
            seen =
                seen.iter().enumerate().filter(|(place, _)| stays(*place)).map(|(_, pixel)| *pixel).collect();
        }
        let mut times = 1.0;
        if seen.len() >= LEAST_PIXELS {
            // Over what noise would leave.
            let square = |times: f64| {
                let noise = times * times / self.information + 1.0 / other.information;
                untrended(&seen, times).norm_squared() / noise
            };
            let nats = 0.5 * (seen.len() - TREND) as f64 * (square(1.0) / square(delays)).ln();
            // Without a pattern at both, what else there is decides: it is nearer to noise where that is multiplied.
            let here = DVector::from_iterator(seen.len(), seen.iter().map(|&pixel| self.phase_rad[pixel]));
            let (here, there) = (without_trend(geometry, &seen, &here), untrended(&seen, 0.0));
            let are_alike =
                here.dot(&there) > ALIKE * here.norm() * there.norm() / (seen.len() as f64).sqrt();
            if nats > DELAY_NATS && are_alike {
                times = delays;
            }
        }
        (times, left(&seen, times).0)
    }
}

/// Numbers of a trend over the image.
const TREND: usize = 6;

/// Values of the pixels `seen` without what goes with row and column, or their squares: a delay along these has a name of its own.
fn without_trend(geometry: Geometry, seen: &[usize], values: &DVector<f64>) -> DVector<f64> {
    let of = |&pixel: &usize| {
        let (row, column) = geometry.row_column(pixel);
        let (y, x) = (row as f64 / geometry.height as f64 - 0.5, column as f64 / geometry.width as f64 - 0.5);
        [1.0, x, y, x * x, x * y, y * y]
    };
    let rows: Vec<f64> = seen.iter().flat_map(of).collect();
    let trend = DMatrix::from_row_slice(seen.len(), TREND, &rows).qr().q();
    values - &trend * trend.tr_mul(values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{Plan, Simulation, chain, injection, number_of, practice_camera, recorded, sensor};
    use crate::diagnose::diagnose;
    use crate::physics::{Draws, Stage};
    use std::path::Path;
    use std::sync::Arc;

    const GEOMETRY: Geometry = Geometry { width: 16, height: 12 };
    /// The other frequency over the usual one.
    const RATIOS: [f64; 4] = [2.0, 4.0 / 3.0, 0.75, 0.5];
    /// What all pixels have there besides, rad, and the noise of each, rad.
    const ALL_RAD: f64 = 2.5;
    const NOISE_RAD: f64 = 0.003;

    /// What is said of pixels whose own phases are `own`, rad, and at another frequency, which is so many times the usual one, so many times that and `ALL_RAD`; four pixels see something else.
    fn said(own: impl Fn(usize) -> f64, ratio: f64, times: f64) -> (f64, f64) {
        said_in_noise(own, ratio, times, NOISE_RAD)
    }

    /// The same where the noise there is so much, rad.
    fn said_in_noise(own: impl Fn(usize) -> f64, ratio: f64, times: f64, noise_rad: f64) -> (f64, f64) {
        let count = GEOMETRY.pixels();
        let mut target = vec![true; count];
        target[..20].fill(false);
        let of = |seed: u64, times: f64, all_rad: f64, noise_rad: f64| {
            let noise = Draws::of(seed, 1).normal(count);
            let far = |pixel: usize| if pixel % 50 == 40 { 2.0 * seed as f64 } else { 0.0 };
            let phase = |pixel: usize| {
                3.0 + times * (own(pixel) - 3.0) + all_rad + noise_rad * noise[pixel] + far(pixel)
            };
            // The background is anywhere.
            let phase_rad = (0..count).map(|p| wrap_rad(if target[p] { phase(p) } else { p as f64 }));
            Phasors { amplitude: vec![100.0; count], phase_rad: phase_rad.collect(), information: 7.0 }
        };
        let mut usual = of(1, 1.0, 0.0, NOISE_RAD);
        usual.unwrapped(&target);
        usual.beside(&of(2, times, ALL_RAD, noise_rad), GEOMETRY, &target, ratio)
    }

    #[test]
    fn phases_of_a_pattern_are_told_from_delays() {
        let draws = Draws::of(3, 1).normal(GEOMETRY.pixels());
        // The pattern goes over the end of the turn.
        let pattern = |pixel: usize| 3.0 + 0.1 * draws[pixel];
        for ratio in RATIOS {
            let same = said(pattern, ratio, 1.0);
            assert!(same.0 == 1.0 && wrap_rad(same.1 - ALL_RAD).abs() < 0.002, "{same:?}");
            let delays = said(pattern, ratio, ratio);
            let all_rad = ALL_RAD + 3.0 * (1.0 - ratio);
            assert!(delays.0 == ratio && wrap_rad(delays.1 - all_rad).abs() < 0.002, "{delays:?}");
        }
    }

    /// Delays that are hardly more than the noise are delays.
    #[test]
    fn weak_delays_are_told() {
        let draws = Draws::of(3, 1).normal(GEOMETRY.pixels());
        let pattern = |pixel: usize| 3.0 + 1.5 * NOISE_RAD * draws[pixel];
        assert_eq!((said(pattern, 2.0, 2.0).0, said(pattern, 2.0, 1.0).0), (2.0, 1.0));
    }

    /// A delay along the columns has a name: it is not taken for what pixels have; and without any pattern noise decides nothing.
    #[test]
    fn a_skew_is_left_to_be_found() {
        for ratio in RATIOS {
            let skew = |pixel: usize| 3.0 + 0.02 * (pixel % GEOMETRY.width) as f64;
            assert_eq!((said(skew, ratio, ratio).0, said(skew, ratio, 1.0).0), (1.0, 1.0));
            assert_eq!(said(|_| 3.0, ratio, 1.0).0, 1.0);
            // Nor does more noise than light lets expect, or what harmonics do there.
            assert_eq!(said_in_noise(|_| 3.0, ratio, 1.0, 2.0 * NOISE_RAD).0, 1.0);
        }
    }

    #[test]
    fn a_few_pixels_tell_where_phases_begin() {
        let geometry = Geometry { width: 3, height: 2 };
        let of = |phase_rad: f64| Phasors {
            amplitude: vec![1.0; 6],
            phase_rad: vec![phase_rad; 6],
            information: 1.0,
        };
        let (times, all_rad) = of(0.0).beside(&of(1.0), geometry, &[true; 6], 0.5);
        assert!(times == 1.0 && (all_rad - 1.0).abs() < 1e-12);
        assert_eq!(of(0.0).beside(&of(1.0), geometry, &[false; 6], 0.5), (1.0, 0.0));
    }

    /// A rail at 30 MHz, and motion at 40 MHz, where own phases are delays and begin elsewhere: clean; and what there is beside it is found as strong as it is, whether the frequency
    /// itself is off, or frames have phases at random.
    #[test]
    fn what_pixels_have_at_two_frequencies_is_fitted() {
        const OTHER_HZ: f64 = 40e6;
        const TIMES: f64 = 4.0 / 3.0;
        let (camera, seed) = (practice_camera(GEOMETRY), 5);
        let sensor = sensor(&camera);
        let of = |effects: &[&str]| {
            let effects: Vec<_> = effects.iter().map(|effect| injection(effect).unwrap()).collect();
            let mut pixels = Stage::bench().pixels(&sensor, seed);
            pixels.at_frequencies =
                vec![AtFrequency { frequency_hz: OTHER_HZ, times: TIMES, phase_rad: 2.0 }];
            let chain = chain(&camera, Arc::new(pixels), effects);
            let take = |(name, frequency_hz): (&str, f64)| {
                let mut plan = Plan::usual(seed);
                plan.frequency_hz = frequency_hz;
                let simulation = Simulation {
                    chain: &chain,
                    sensor: &sensor,
                    noise: true,
                    seed,
                    recording: number_of(name),
                };
                let course = plan.course(name).unwrap();
                recorded(Path::new("simulated"), name, &plan, &course, &camera, &simulation, &|| ()).unwrap()
            };
            let recordings = [("four-rail", 30e6), ("four-sweep", 30e6), ("four-motion", OTHER_HZ)].map(take);
            diagnose(&Data::of(&recordings, Vec::new()).unwrap())
        };
        let clean = of(&[]);
        assert!(
            clean.answer.effects.is_empty() && clean.answer.located.is_empty(),
            "{:?}",
            clean.answer.located
        );
        let [at] = clean.judgement.fit.pixels.at_frequencies[..] else { panic!() };
        // The usual one is that of motion.
        assert_eq!((at.frequency_hz, at.times), (30e6, 0.75));
        for (effect, value) in
            [("modulation_frequency_error:relative=0.003", 0.003), ("clock_jitter:sigma_rad=0.01", 0.01)]
        {
            let found = of(&[effect]).answer.effects;
            assert_eq!(
                found.iter().map(|row| row.name).collect::<Vec<_>>(),
                [effect.split(':').next().unwrap()]
            );
            let strength = &found[0].parameters[0];
            assert!(
                (strength.value - value).abs() < 4.0 * strength.sigma && strength.sigma < 0.2 * value,
                "{strength:?}"
            );
        }
    }
}
