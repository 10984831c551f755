//! What pixels' own phases are at several modulation frequencies, which no recording states: of a camera whose clock paths delay they grow with the frequency,
//! of one whose phase shifter is per pixel they do not, and where the phase of all pixels begins is another at each frequency.

use super::data::{Data, Take};
use super::frequencies::{Frequency, others, usual};
use super::start::numbers;
use crate::frames::Geometry;
use crate::physics::AtFrequency;
use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;
use std::f64::consts::PI;

/// Own phases at frequencies other than the usual one, which is that of most frames.
#[derive(Debug, Clone, Default)]
pub struct OwnPhases {
    /// At each.
    others: Vec<(Frequency, AtFrequency)>,
    /// Those at the usual one, rad: a value a pixel; empty where they are the same at all.
    usual_rad: Vec<f64>,
    /// Their mean, rad.
    mean_rad: f64,
}

/// Fewer pixels of the target say nothing.
const LEAST_PIXELS: usize = 8;
/// A pixel that has less of the usual amplitude has no phase to speak of.
const LEAST_SHARE: f64 = 0.1;
/// What all pixels have at a frequency is there if it is so many times its standard deviation.
const CLEAR: f64 = 3.0;
/// Own phases are delays where that is clear by so many nats.
const DELAY_NATS: f64 = 10.0;

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
            Phasors { amplitude, phase_rad }
        };
        let mut at_usual = seen(usual);
        let mean_rad = at_usual.unwrapped(&data.target);
        let at = |frequency: Frequency| {
            let times = frequency.hz / usual.hz;
            let at = at_usual.beside(&seen(frequency), data.geometry(), &data.target, times)?;
            Some((frequency, AtFrequency { frequency_hz: frequency.hz, ..at }))
        };
        let others: Vec<_> = others.into_iter().filter_map(at).collect();
        let usual_rad = if others.is_empty() { Vec::new() } else { at_usual.phase_rad };
        Self { others, usual_rad, mean_rad }
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
        if self.others.is_empty() { phase_rad } else { self.mean_rad + within(phase_rad - self.mean_rad) }
    }
}

/// An angle from −π to π, rad.
fn within(angle_rad: f64) -> f64 {
    angle_rad - 2.0 * PI * (angle_rad / (2.0 * PI)).round()
}

/// Amplitudes and phases, a value a pixel.
struct Phasors {
    amplitude: Vec<f64>,
    phase_rad: Vec<f64>,
}

impl Phasors {
    fn phasor(&self, pixel: usize) -> Complex64 {
        Complex64::from_polar(self.amplitude[pixel], self.phase_rad[pixel])
    }

    /// Brings all phases to within half a turn of those of the target's mean, which it gives, rad.
    fn unwrapped(&mut self, target: &[bool]) -> f64 {
        let of_target = (0..target.len()).filter(|&pixel| target[pixel]);
        let mean_rad = of_target.map(|pixel| self.phasor(pixel)).sum::<Complex64>().arg();
        self.phase_rad.iter_mut().for_each(|phase| *phase = mean_rad + within(*phase - mean_rad));
        mean_rad
    }

    /// What pixels of the `target` have at another frequency beside what they have here: these phases, if they are no delays, which would be so many `times` what
    /// they are, and something besides; nothing where they are the same.
    fn beside(&self, other: &Self, geometry: Geometry, target: &[bool], times: f64) -> Option<AtFrequency> {
        let bright = |phasors: &Self, pixel: usize| {
            let mut all: Vec<f64> =
                phasors.amplitude.iter().zip(target).filter(|(_, is)| **is).map(|(a, _)| *a).collect();
            all.sort_by(f64::total_cmp);
            all.get(all.len() / 2).is_some_and(|usual| phasors.amplitude[pixel] > LEAST_SHARE * usual)
        };
        let seen: Vec<usize> =
            (0..target.len()).filter(|&p| target[p] && bright(self, p) && bright(other, p)).collect();
        if seen.len() < LEAST_PIXELS {
            return None;
        }
        // The phase that all have besides own phases which count so many times, and what that leaves of each.
        let left = |times: f64| {
            let own =
                |pixel: usize| Complex64::from_polar(self.amplitude[pixel], times * self.phase_rad[pixel]);
            let sum: Complex64 = seen.iter().map(|&pixel| other.phasor(pixel) * own(pixel).conj()).sum();
            let common_rad = sum.arg();
            let left =
                |pixel: &usize| within(other.phase_rad[*pixel] - times * self.phase_rad[*pixel] - common_rad);
            (common_rad, DVector::from_iterator(seen.len(), seen.iter().map(left)))
        };
        let square = |of: &DVector<f64>| without_trend(geometry, &seen, of).norm_squared();
        let [(common_rad, same), (common_of_delays_rad, delays)] = [1.0, times].map(left);
        let nats = 0.5 * seen.len() as f64 * (square(&same) / square(&delays)).ln();
        if nats > DELAY_NATS {
            return Some(AtFrequency { frequency_hz: 0.0, times, phase_rad: common_of_delays_rad });
        }
        let sigma_rad = same.norm() / seen.len() as f64;
        (common_rad.abs() > CLEAR * sigma_rad).then_some(AtFrequency {
            frequency_hz: 0.0,
            times: 1.0,
            phase_rad: common_rad,
        })
    }
}

/// Values of the pixels `seen` without what goes with row and column, or their squares: a delay along these has a name of its own.
fn without_trend(geometry: Geometry, seen: &[usize], values: &DVector<f64>) -> DVector<f64> {
    let of = |&pixel: &usize| {
        let (row, column) = geometry.row_column(pixel);
        let (y, x) = (row as f64 / geometry.height as f64 - 0.5, column as f64 / geometry.width as f64 - 0.5);
        [1.0, x, y, x * x, x * y, y * y]
    };
    let rows: Vec<f64> = seen.iter().flat_map(of).collect();
    let trend = DMatrix::from_row_slice(seen.len(), 6, &rows).qr().q();
    values - &trend * trend.tr_mul(values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::Draws;

    const GEOMETRY: Geometry = Geometry { width: 16, height: 12 };
    /// The other frequency over the usual one; what all pixels have there besides, rad; their noise, rad.
    const TIMES: f64 = 4.0 / 3.0;
    const ALL_RAD: f64 = 2.5;
    const NOISE_RAD: f64 = 0.003;

    /// What is said of pixels whose own phases are `own`, rad, and at another frequency so many times that and `all_rad`.
    fn said(own: impl Fn(usize) -> f64, times: f64, all_rad: f64) -> Option<AtFrequency> {
        let count = GEOMETRY.pixels();
        let mut target = vec![true; count];
        target[..20].fill(false);
        let of = |seed: u64, times: f64, all_rad: f64| {
            let noise = Draws::of(seed, 1).normal(count);
            let phase = |pixel: usize| 3.0 + times * (own(pixel) - 3.0) + all_rad + NOISE_RAD * noise[pixel];
            // The background is anywhere.
            let phase_rad = (0..count).map(|p| within(if target[p] { phase(p) } else { p as f64 }));
            Phasors { amplitude: vec![100.0; count], phase_rad: phase_rad.collect() }
        };
        let mut usual = of(1, 1.0, 0.0);
        usual.unwrapped(&target);
        usual.beside(&of(2, times, all_rad), GEOMETRY, &target, TIMES)
    }

    #[test]
    fn phases_of_a_pattern_are_told_from_delays() {
        let draws = Draws::of(3, 1).normal(GEOMETRY.pixels());
        // The pattern goes over the end of the turn.
        let pattern = |pixel: usize| 3.0 + 0.1 * draws[pixel];
        let same = said(pattern, 1.0, ALL_RAD).unwrap();
        assert!(same.times == 1.0 && (within(same.phase_rad - ALL_RAD)).abs() < 0.001, "{same:?}");
        let delays = said(pattern, TIMES, ALL_RAD).unwrap();
        let all_rad = ALL_RAD + 3.0 * (1.0 - TIMES);
        assert!(delays.times == TIMES && within(delays.phase_rad - all_rad).abs() < 0.001, "{delays:?}");
        // What is the same at both needs no words.
        assert_eq!(said(pattern, 1.0, 0.0), None);
        assert!(said(pattern, TIMES, 0.0).is_some());
    }

    /// A delay along the columns has a name: it is not taken for what pixels have.
    #[test]
    fn a_skew_is_left_to_be_found() {
        let skew = |pixel: usize| 3.0 + 0.05 * (pixel % GEOMETRY.width) as f64;
        let said = said(skew, TIMES, ALL_RAD).unwrap();
        assert_eq!(said.times, 1.0);
    }

    #[test]
    fn a_few_pixels_say_nothing() {
        let geometry = Geometry { width: 3, height: 2 };
        let of = |phase_rad: f64| Phasors { amplitude: vec![1.0; 6], phase_rad: vec![phase_rad; 6] };
        assert_eq!(of(0.0).beside(&of(1.0), geometry, &[true; 6], TIMES), None);
    }
}
