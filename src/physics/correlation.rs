//! The correlation waveform: what light and sensor make of the phase between them.

use super::per_pixel::PerPixel;
use super::trig::cos_sin;
use crate::widest::widest;
use std::sync::Arc;

/// The modulation frequency of the paper's linearity measurements, Hz (Drayton, Carnegie, Dorrington 2012), and so of
/// [`Correlation::measured`]. Elsewhere, as for the paper's motion, it is assumed.
pub const FREQUENCY_HZ: f64 = 30e6;

/// The correlation of the modulated light with the sensor's own modulation, as harmonics of the modulation frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct Correlation {
    harmonics: Arc<Vec<Harmonic>>,
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
        Self { harmonics: Arc::new(std::iter::once(fundamental).chain(harmonics.iter().copied()).collect()) }
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

    /// Adds a_m cos(m · angle + p_m) for the harmonic `number` (>= 1), by its parts: `cosine` · cos(m · angle) + `sine` · sin(m · angle).
    pub fn add_harmonic(&mut self, number: u32, cosine: f64, sine: f64) {
        let amplitude = libm::hypot(cosine, sine);
        Arc::make_mut(&mut self.harmonics).push(Harmonic {
            number,
            amplitude,
            phase_rad: libm::atan2(-sine, cosine),
        });
    }

    /// The harmonics, the fundamental among them.
    pub fn harmonics(&self) -> &[Harmonic] {
        &self.harmonics
    }

    /// Parts of cos(m · angle) and sin(m · angle) for m = 1, 2, … up to the highest harmonic.
    fn parts(&self) -> Vec<(f64, f64)> {
        let highest = self.harmonics.iter().map(|h| h.number).max().unwrap_or(0) as usize;
        let mut parts = vec![(0.0, 0.0); highest];
        for harmonic in self.harmonics.iter().filter(|h| h.number > 0) {
            let (cosine, sine) = cos_sin(harmonic.phase_rad);
            let part = &mut parts[harmonic.number as usize - 1];
            part.0 += harmonic.amplitude * cosine;
            part.1 -= harmonic.amplitude * sine;
        }
        parts
    }

    /// waveform(angle − phase), a pixel at a time, relative to the fundamental's amplitude.
    fn relative(&self, phase_rad: &[f64], angle_rad: f64) -> Vec<f64> {
        let mut relative = vec![0.0; phase_rad.len()];
        let parts = self.parts();
        pulp::Arch::new().dispatch(LookUp { parts: &parts, phase_rad, angle_rad, relative: &mut relative });
        relative
    }

    /// Σ a_m cos(m · angle + p_m): the waveform at `angle_rad`, relative to the fundamental's amplitude.
    pub fn at(&self, angle_rad: f64) -> f64 {
        // The standard library's cosine is the platform's, and differs in its last bits from one to the next.
        let term = |h: &Harmonic| h.amplitude * libm::cos(f64::from(h.number) * angle_rad + h.phase_rad);
        self.harmonics.iter().map(term).sum()
    }
}

/// A correlation waveform at the phases of many pixels.
#[derive(Debug)]
pub struct Waveform {
    correlation: Correlation,
    phase_rad: PerPixel,
    angle_rad: f64,
    relative: Vec<f64>,
}

impl Waveform {
    /// `correlation` at `angle_rad` less the pixels' phases.
    pub fn of(correlation: &Correlation, phase_rad: &PerPixel, angle_rad: f64) -> Self {
        let relative = correlation.relative(phase_rad, angle_rad);
        Self { correlation: correlation.clone(), phase_rad: phase_rad.clone(), angle_rad, relative }
    }

    /// What [`Self::of`] would give for a correlation with further harmonics, but for rounding; nothing where `correlation`, or a phase, is another.
    pub fn with_more(&self, correlation: &Correlation, phase_rad: &PerPixel, angle_rad: f64) -> Option<Self> {
        let more = correlation.harmonics.strip_prefix(&self.correlation.harmonics[..])?;
        if self.angle_rad != angle_rad || self.phase_rad != *phase_rad {
            return None;
        }
        let mut relative = self.relative.clone();
        for harmonic in more.iter().filter(|harmonic| harmonic.number > 0 && harmonic.amplitude != 0.0) {
            let (relative, phases) = (&mut relative[..], &phase_rad[..]);
            let (number, amplitude, begin_rad) =
                (f64::from(harmonic.number), harmonic.amplitude, harmonic.phase_rad);
            widest!((relative: &'a mut [f64], phases: &'a [f64], angle_rad: f64,
                     number: f64, amplitude: f64, begin_rad: f64) {
                for (relative, phase_rad) in relative.iter_mut().zip(phases) {
                    *relative += amplitude * cos_sin(number * (angle_rad - phase_rad) + begin_rad).0;
                }
            });
        }
        Some(Self { correlation: correlation.clone(), phase_rad: phase_rad.clone(), angle_rad, relative })
    }

    /// Whether it is what [`Self::of`] would give.
    pub fn is_of(&self, correlation: &Correlation, phase_rad: &PerPixel, angle_rad: f64) -> bool {
        self.angle_rad == angle_rad && self.correlation == *correlation && self.phase_rad == *phase_rad
    }

    /// A value a pixel, relative to the fundamental's amplitude.
    pub fn relative(&self) -> &[f64] {
        &self.relative
    }
}

/// Pixels that are done together, harmonic after harmonic: so the compiler does several at once.
const BLOCK: usize = 64;

/// What [`Correlation::relative`] does, with the widest registers that the machine has; without fused operations the bits are the same on all.
struct LookUp<'a> {
    parts: &'a [(f64, f64)],
    phase_rad: &'a [f64],
    angle_rad: f64,
    relative: &'a mut [f64],
}

impl pulp::NullaryFnOnce for LookUp<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { parts, phase_rad, angle_rad, relative } = self;
        for (relative, phase_rad) in relative.chunks_mut(BLOCK).zip(phase_rad.chunks(BLOCK)) {
            let (mut cosine, mut sine) = ([1.0; BLOCK], [0.0; BLOCK]);
            for ((cosine, sine), phase_rad) in cosine.iter_mut().zip(&mut sine).zip(phase_rad) {
                (*cosine, *sine) = cos_sin(angle_rad - phase_rad);
            }
            let (mut turned, mut waveform) = (([1.0; BLOCK], [0.0; BLOCK]), [0.0; BLOCK]);
            for (in_phase, quadrature) in parts {
                for n in 0..BLOCK {
                    // cos(m a) and sin(m a) from those of (m − 1) a.
                    let (c, s) = (turned.0[n], turned.1[n]);
                    turned.0[n] = c * cosine[n] - s * sine[n];
                    turned.1[n] = s * cosine[n] + c * sine[n];
                    waveform[n] += in_phase * turned.0[n] + quadrature * turned.1[n];
                }
            }
            relative.copy_from_slice(&waveform[..relative.len()]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Many pixels at once are each pixel by itself, in blocks and beyond them.
    #[test]
    fn many_pixels_are_each_pixel() {
        let mut waveform = Correlation::measured();
        waveform.add_harmonic(3, 0.02, -0.01);
        let phase_rad: Vec<f64> = (0..150).map(|n| f64::from(n) * 0.37 - 9.0).collect();
        let relative = waveform.relative(&phase_rad, 1.234);
        assert_eq!(relative.len(), phase_rad.len());
        for (relative, phase) in relative.iter().zip(&phase_rad) {
            let third = 0.02 * libm::cos(3.0 * (1.234 - phase)) - 0.01 * libm::sin(3.0 * (1.234 - phase));
            let expected = Correlation::measured().at(1.234 - phase) + third;
            assert!((relative - expected).abs() < 1e-12, "{phase}: {relative}, not {expected}");
        }
    }

    /// One harmonic more is one more, and of another waveform, or at other phases, nothing is known.
    #[test]
    fn further_harmonics_are_added() {
        let phase_rad: PerPixel = (0..70).map(|n| f64::from(n) * 0.37 - 9.0).collect();
        let known = Waveform::of(&Correlation::measured(), &phase_rad, 1.234);
        let mut more = Correlation::measured();
        more.add_harmonic(2, 0.0, 0.0);
        more.add_harmonic(5, 0.02, -0.01);
        let further = known.with_more(&more, &phase_rad, 1.234).unwrap();
        let anew = Waveform::of(&more, &phase_rad, 1.234);
        assert!(further.is_of(&more, &phase_rad, 1.234));
        for (further, anew) in further.relative().iter().zip(anew.relative()) {
            assert!((further - anew).abs() < 1e-14, "{further}, not {anew}");
        }
        assert!(
            known.relative().iter().zip(anew.relative()).any(|(known, anew)| (known - anew).abs() > 1e-3)
        );
        assert!(further.with_more(&Correlation::measured(), &phase_rad, 1.234).is_none());
        assert!(known.with_more(&more, &phase_rad, 1.235).is_none());
        let others: PerPixel = phase_rad.iter().map(|phase| phase + 1e-9).collect();
        assert!(known.with_more(&more, &others, 1.234).is_none());
    }

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
