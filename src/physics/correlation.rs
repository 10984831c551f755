//! The correlation waveform: what light and sensor make of the phase between them.

/// The correlation of the modulated light with the sensor's own modulation, as harmonics of the modulation frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct Correlation {
    harmonics: Vec<Harmonic>,
}

/// One harmonic of the correlation waveform.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonic {
    /// Its number m: 1 is the fundamental.
    pub number: u32,
    /// Its amplitude a_m relative to the fundamental's.
    pub amplitude: f64,
    /// Its phase p_m in radians.
    pub phase_rad: f64,
}

impl Correlation {
    /// The fundamental alone: what every phase algorithm assumes.
    pub fn sinusoidal() -> Self {
        Self::with_harmonics(&[])
    }

    /// The fundamental and `harmonics`.
    pub fn with_harmonics(harmonics: &[Harmonic]) -> Self {
        let fundamental = Harmonic { number: 1, amplitude: 1.0, phase_rad: 0.0 };
        Self { harmonics: std::iter::once(fundamental).chain(harmonics.iter().copied()).collect() }
    }

    /// The measured camera: harmonics 2 to 7 at 1/105, 1/31, 1/500, 1/1020, 1/926 and 1/1449 of the fundamental
    /// (Drayton, Carnegie, Dorrington 2012, Table I). The table gives no phases: zero is assumed.
    pub fn measured() -> Self {
        let inverse_amplitudes = [105.0, 31.0, 500.0, 1020.0, 926.0, 1449.0];
        let harmonics: Vec<_> = (2..)
            .zip(inverse_amplitudes)
            .map(|(number, inverse)| Harmonic { number, amplitude: 1.0 / inverse, phase_rad: 0.0 })
            .collect();
        Self::with_harmonics(&harmonics)
    }

    /// Σ a_m cos(m · angle + p_m): the waveform at `angle_rad`, relative to the fundamental's amplitude.
    pub fn at(&self, angle_rad: f64) -> f64 {
        // The standard library's cosine is the platform's, and differs in its last bits from one to the next.
        let term = |h: &Harmonic| h.amplitude * libm::cos(f64::from(h.number) * angle_rad + h.phase_rad);
        self.harmonics.iter().map(term).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_measured_waveform_has_the_tables_amplitudes() {
        let measured = Correlation::measured();
        // Fourier analysis over 16 equal steps, enough for harmonics up to 7.
        for (number, inverse) in (1..).zip([1.0, 105.0, 31.0, 500.0, 1020.0, 926.0, 1449.0]) {
            let samples = (0..16).map(|n| f64::from(n) * std::f64::consts::TAU / 16.0);
            let projected: f64 =
                samples.map(|angle| measured.at(angle) * (f64::from(number) * angle).cos()).sum::<f64>()
                    / 8.0;
            assert!((projected - 1.0 / inverse).abs() < 1e-14, "harmonic {number}");
        }
    }
}
