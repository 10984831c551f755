//! Laser and gate as pulses in time, and their correlation by summation over the period.

use std::f64::consts::TAU;

/// Samples a period.
pub const SAMPLES: usize = 4096;
/// Periods after which a low pass has settled: what is left of its start is below e^-40.
const SETTLING_PERIODS: usize = 12;
/// Harmonics below this share of the fundamental are not told.
const TOLD: f64 = 2e-6;
const MOST_HARMONICS: usize = 25;

/// A periodic pulse: linear edges, then a low pass of one pole. All times in periods.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulse {
    /// From the middle of the rising edge to the middle of the falling one, 0 to 1.
    pub duty: f64,
    /// Length of the rising edge, below twice the duty.
    pub rise: f64,
    /// Length of the falling edge.
    pub fall: f64,
    /// Time constant of the low pass, above 0.02.
    pub pole: f64,
    /// What is left between pulses, 0 to 1.
    pub floor: f64,
}

impl Pulse {
    /// One period, 4096 values from `floor` to 1 (somewhat less where edges and low pass leave no flat top).
    pub fn samples(&self) -> Vec<f64> {
        let edge = |time: f64, length: f64| (time / length + 0.5).clamp(0.0, 1.0);
        let drive = |sample: usize| {
            // The rising edge is in the middle of the first half, so that no edge meets the period's end.
            let time = sample as f64 / SAMPLES as f64 - 0.25;
            let rising = edge(time, self.rise);
            let falling = edge(time - self.duty, self.fall);
            self.floor + (1.0 - self.floor) * (rising - falling)
        };
        let keep = (-1.0 / (SAMPLES as f64 * self.pole)).exp();
        let mut level = self.duty;
        let mut period = vec![0.0; SAMPLES];
        for _ in 0..SETTLING_PERIODS.max((40.0 * self.pole) as usize) {
            for (sample, out) in period.iter_mut().enumerate() {
                level = keep * level + (1.0 - keep) * drive(sample);
                *out = level;
            }
        }
        period
    }
}

/// What a gate lets through of the light, over their delay: the fundamental's amplitude is 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Waveform {
    correlation: Vec<f64>,
}

impl Waveform {
    /// Of a period of light and one of the gate, 4096 values each: c(x) = mean over s of light(s + x) gate(s).
    pub fn of(light: &[f64], gate: &[f64]) -> Self {
        let product = |shift: usize| {
            let (before, after) = light.split_at(shift);
            let shifted = after.iter().chain(before);
            shifted.zip(gate).map(|(light, gate)| light * gate).sum::<f64>()
        };
        let correlation: Vec<f64> = (0..SAMPLES).map(product).collect();
        let (cosine, sine) = fourier(&correlation, 1);
        let scale = 1.0 / cosine.hypot(sine);
        Self { correlation: correlation.into_iter().map(|value| value * scale).collect() }
    }

    /// The correlation where the gate is `delay_rad` behind the light.
    pub fn at(&self, delay_rad: f64) -> f64 {
        let place = delay_rad / TAU * SAMPLES as f64;
        // The whole number below, without a call of a library for each of so many delays.
        let (towards, samples) = (place as i64, SAMPLES as i64);
        let cell = towards - i64::from(place < towards as f64);
        let t = place - cell as f64;
        let value = |offset: i64| self.correlation[(cell + offset - 1).rem_euclid(samples) as usize];
        let (before, from, to, after) = (value(0), value(1), value(2), value(3));
        // Catmull and Rom (1974).
        let bend = 2.0 * before - 5.0 * from + 4.0 * to - after;
        let twist = 3.0 * (from - to) + after - before;
        from + 0.5 * t * (to - before + t * (bend + t * twist))
    }

    /// The mean over the period, in units of the fundamental's amplitude.
    pub fn mean(&self) -> f64 {
        self.correlation.iter().sum::<f64>() / SAMPLES as f64
    }

    /// The correlation plus a wave of `order` cycles with the amplitude `size` and the phase `phase_rad`.
    pub fn with_wave(&self, order: f64, size: f64, phase_rad: f64) -> Self {
        let wave = |sample: usize| size * (order * TAU * sample as f64 / SAMPLES as f64 + phase_rad).cos();
        let correlation = self.correlation.iter().enumerate().map(|(sample, value)| value + wave(sample));
        Self { correlation: correlation.collect() }
    }

    /// Where the fundamental is at its crest: −crest_rad behind the light, rad.
    pub fn crest_rad(&self) -> f64 {
        let (cosine, sine) = fourier(&self.correlation, 1);
        (-sine).atan2(cosine)
    }

    /// Amplitudes and phases (rad) of the harmonics from the first on, as far as they matter, relative to the first: in
    /// a_m cos(m x + p_m) with x measured from the fundamental's own crest.
    pub fn harmonics(&self) -> (Vec<f64>, Vec<f64>) {
        let parts: Vec<(f64, f64)> = (1..=MOST_HARMONICS)
            .map(|order| {
                let (cosine, sine) = fourier(&self.correlation, order);
                (cosine.hypot(sine), (-sine).atan2(cosine))
            })
            .collect();
        let (first, crest) = parts[0];
        let told = parts.iter().rposition(|part| part.0 > TOLD * first).unwrap_or(0);
        let relative = |(index, (amplitude, phase)): (usize, &(f64, f64))| {
            let order = (index + 1) as f64;
            let (sine, cosine) = (phase - order * crest).sin_cos();
            (amplitude / first, if index == 0 { 0.0 } else { sine.atan2(cosine) })
        };
        let mut all: Vec<(f64, f64)> = parts[..=told].iter().enumerate().map(relative).collect();
        all[0].0 = 1.0;
        all.into_iter().unzip()
    }
}

/// Cosine and sine part of harmonic `order` of a sampled period.
fn fourier(period: &[f64], order: usize) -> (f64, f64) {
    let turn = TAU * order as f64 / period.len() as f64;
    let sum = |part: fn(f64) -> f64| {
        let terms = period.iter().enumerate().map(|(sample, value)| value * part(turn * sample as f64));
        2.0 * terms.sum::<f64>() / period.len() as f64
    };
    (sum(f64::cos), sum(f64::sin))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLOW: Pulse = Pulse { duty: 0.5, rise: 0.15, fall: 0.1, pole: 0.08, floor: 0.0 };

    #[test]
    fn the_told_harmonics_are_the_whole_waveform() {
        let waveform = Waveform::of(&SLOW.samples(), &Pulse { duty: 0.47, ..SLOW }.samples());
        let (amplitude, phase_rad) = waveform.harmonics();
        let (cosine, sine) = fourier(&waveform.correlation, 1);
        let crest = (-sine).atan2(cosine);
        for step in 0..50 {
            let x = 0.1277 * f64::from(step);
            let sum: f64 = (1..)
                .zip(amplitude.iter().zip(&phase_rad))
                .map(|(order, (a, p))| a * (f64::from(order) * (x + crest) + p).cos())
                .sum();
            let rest = waveform.at(x) - waveform.mean() - sum;
            assert!(rest.abs() < 1e-5, "{rest} at {x}");
        }
    }

    /// Two square waves correlate to a triangle: odd harmonics fall as 1/m².
    #[test]
    fn squares_correlate_to_a_triangle() {
        let square = Pulse { duty: 0.5, rise: 1e-6, fall: 1e-6, pole: 1e-6, floor: 0.0 }.samples();
        let (amplitude, _) = Waveform::of(&square, &square).harmonics();
        for order in [3, 5, 7] {
            let expected = 1.0 / f64::from(order * order);
            assert!((amplitude[order as usize - 1] - expected).abs() < 1e-4, "{order}: {amplitude:?}");
        }
        assert!(amplitude[1] < 1e-9);
    }
}
