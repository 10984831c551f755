//! The reference in floating point: what a pipeline would give without words and rounding.
//!
//! For a set of frames I_n = A cos(n δ − φ) + B, the scheme's weights are applied to the mean of each step's frames in
//! `f64`, √3, the arc tangent and a DFT's cosines and sines being those of `f64`. Nothing of the hardware's arithmetic is used, so that a
//! disagreement beyond the error budget is a fault of one of the two.

use crate::frames::RawSets;
use crate::problem::{Problem, Result};
use crate::spec::Pipeline;
use crate::units::unambiguous_range_m;
use std::f64::consts::TAU;

/// Results of whole sets; every list is in C order `[set, row, column]`.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceImages {
    /// Phase φ as a fraction of a turn, in [0, 1); 0 where there is no vector.
    pub phase_turns: Vec<f64>,
    /// Amplitude A, DN.
    pub amplitude_dn: Vec<f64>,
    /// Offset B, DN, the sensor's pedestal included.
    pub offset_dn: Vec<f64>,
    /// Range c φ / (4π f), m, in [0, unambiguous range).
    pub range_m: Vec<f64>,
    /// Whether there is a phase: a vector, of at least the specification's minimum amplitude.
    pub valid: Vec<bool>,
    /// Whether any frame of the set reached the specification's saturation.
    pub saturated: Vec<bool>,
}

/// The reference of `pipeline` for the raw frames `raw`.
///
/// # Errors
/// The frames are not of the pipeline's size or number.
pub fn reference_images(pipeline: &Pipeline, raw: &RawSets) -> Result<ReferenceImages> {
    let frames_per_set = pipeline.derived().frames_per_set;
    if raw.geometry() != pipeline.geometry() || raw.frames_per_set() != frames_per_set {
        let size = |geometry: crate::frames::Geometry, frames| {
            format!("{frames} frames of {} x {} pixels a set", geometry.width, geometry.height)
        };
        return Err(Problem::at("raw frames", size(raw.geometry(), raw.frames_per_set()))
            .expected(format_args!(
                "{}, as {} has it",
                size(pipeline.geometry(), frames_per_set),
                pipeline.name
            ))
            .remedy("adapt the pipeline to the recording"));
    }
    let scheme = &pipeline.modulation.scheme;
    let coefficients = scheme.true_coefficients();
    let frames_per_step = pipeline.modulation.frames_per_step;
    let unambiguous_m = unambiguous_range_m(pipeline.modulation.frequency_hz);
    let pixels = raw.geometry().pixels();
    let count = raw.sets() * pixels;
    let list = || Vec::with_capacity(count);
    let mut images = ReferenceImages {
        phase_turns: list(),
        amplitude_dn: list(),
        offset_dn: list(),
        range_m: list(),
        valid: Vec::with_capacity(count),
        saturated: Vec::with_capacity(count),
    };
    for set in 0..raw.sets() {
        let frames: Vec<&[u32]> = (0..frames_per_set).map(|frame| raw.frame(set, frame)).collect();
        for pixel in 0..pixels {
            let [mut in_phase, mut quadrature, mut offset] = [0.0; 3];
            for (place, held) in frames.chunks(frames_per_step).enumerate() {
                let step = pipeline.modulation.step_at(place);
                let sum: f64 = held.iter().map(|frame| f64::from(frame[pixel])).sum();
                let mean = sum / frames_per_step as f64;
                in_phase += coefficients[step].re * mean;
                quadrature += coefficients[step].im * mean;
                offset += scheme.offset[step] as f64 * mean;
            }
            let amplitude_dn = in_phase.hypot(quadrature) / scheme.gain;
            let phase_turns = turns(quadrature.atan2(in_phase));
            images.phase_turns.push(phase_turns);
            images.amplitude_dn.push(amplitude_dn);
            images.offset_dn.push(offset / scheme.offset_gain() as f64);
            images.range_m.push(phase_turns * unambiguous_m);
            images.valid.push(amplitude_dn > 0.0 && amplitude_dn >= pipeline.output.minimum_amplitude_dn);
            let saturates = |frame: &&[u32]| i64::from(frame[pixel]) >= pipeline.sensor.saturation_dn;
            images.saturated.push(frames.iter().any(saturates));
        }
    }
    Ok(images)
}

/// An angle in rad as a fraction of a turn in [0, 1).
fn turns(angle_rad: f64) -> f64 {
    let turns = (angle_rad / TAU).rem_euclid(1.0);
    // A negative angle below the resolution of 1.0 rounds up to the whole turn.
    if turns < 1.0 { turns } else { 0.0 }
}

/// Statistics of the differences between two lists of numbers, in their unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DifferenceStatistics {
    /// How many differences there are.
    pub count: usize,
    /// Their mean.
    pub mean: f64,
    /// Root of their mean square, the mean not removed.
    pub rms: f64,
    /// The largest magnitude.
    pub max_abs: f64,
}

impl DifferenceStatistics {
    /// Of `values[i] − reference[i]`, each brought into [−period/2, period/2) where there is a `period` (> 0).
    ///
    /// `None` where the lists are empty or not equally long.
    pub fn between(values: &[f64], reference: &[f64], period: Option<f64>) -> Option<Self> {
        if values.len() != reference.len() {
            return None;
        }
        Self::of(values.iter().zip(reference).map(|(value, reference)| match period {
            Some(period) => wrap(value - reference, period),
            None => value - reference,
        }))
    }

    /// Of `differences`; `None` where there are none.
    pub fn of(differences: impl IntoIterator<Item = f64>) -> Option<Self> {
        let (mut count, mut sum, mut squares, mut max_abs) = (0, 0.0, 0.0, 0f64);
        for difference in differences {
            count += 1;
            sum += difference;
            squares += difference * difference;
            max_abs = max_abs.max(difference.abs());
        }
        let n = count as f64;
        (count > 0).then(|| Self { count, mean: sum / n, rms: (squares / n).sqrt(), max_abs })
    }
}

/// `difference` brought into [−period/2, period/2), `period` > 0.
pub(crate) fn wrap(difference: f64, period: f64) -> f64 {
    (difference + period / 2.0).rem_euclid(period) - period / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frames::Geometry;
    use crate::spec::SCHEMES;

    /// On noise-free frames rounded to whole codes, the reference is the truth but for the rounding.
    #[test]
    fn every_scheme_gives_phase_amplitude_offset_and_range() {
        for scheme in SCHEMES {
            for frames_per_step in [1, 3] {
                let pipeline = crate::spec::Pipeline::named("vuris")
                    .unwrap()
                    .adapted("test", |specification| {
                        specification.sensor.width = 12;
                        specification.sensor.height = 2;
                        specification.sensor.adc_bits = 16;
                        specification.modulation.scheme = scheme.clone();
                        specification.modulation.frames_per_step = frames_per_step;
                    })
                    .unwrap();
                let truth = |pixel: usize| pixel as f64 / 24.0;
                let codes = (0..scheme.steps() * frames_per_step)
                    .flat_map(|frame| (0..24).map(move |pixel| (frame, pixel)))
                    .map(|(frame, pixel)| {
                        let step_rad = scheme.angle_rad(frame / frames_per_step);
                        (20_000.0 * (step_rad - truth(pixel) * TAU).cos() + 30_000.0).round() as u32
                    })
                    .collect();
                let raw =
                    RawSets::new(Geometry { width: 12, height: 2 }, scheme.steps() * frames_per_step, codes)
                        .unwrap();
                let images = reference_images(&pipeline, &raw).unwrap();
                let unambiguous_m = unambiguous_range_m(30e6);
                for pixel in 0..24 {
                    let phase = images.phase_turns[pixel];
                    assert!((0.0..1.0).contains(&phase));
                    // Half a code of 20000 in each frame turns the vector by less than 2e-5 turns.
                    assert!(wrap(phase - truth(pixel), 1.0).abs() < 2e-5, "{} {pixel}", scheme.name);
                    assert!((images.amplitude_dn[pixel] - 20_000.0).abs() < 1.5);
                    assert!((images.offset_dn[pixel] - 30_000.0).abs() < 0.6);
                    assert_eq!(images.range_m[pixel], phase * unambiguous_m);
                    assert!(images.valid[pixel] && !images.saturated[pixel]);
                }
            }
        }
    }

    #[test]
    fn a_pixel_without_a_vector_is_invalid_and_a_full_code_saturated() {
        let pipeline = crate::spec::Pipeline::named("vuris-four-frame").unwrap();
        let pipeline = pipeline
            .adapted("test", |specification| {
                specification.sensor.width = 8;
                specification.sensor.height = 1;
            })
            .unwrap();
        let mut codes = vec![100; 4 * 8];
        codes[1] = 4095;
        let raw = RawSets::new(Geometry { width: 8, height: 1 }, 4, codes).unwrap();
        let images = reference_images(&pipeline, &raw).unwrap();
        assert_eq!(images.valid[..3], [false, true, false]);
        assert_eq!(images.saturated[..3], [false, true, false]);
        let other = RawSets::new(Geometry { width: 4, height: 1 }, 4, vec![0; 16]).unwrap();
        assert!(reference_images(&pipeline, &other).unwrap_err().to_string().contains("4 x 1"));
    }

    #[test]
    fn statistics_by_hand_and_across_the_wrap() {
        let statistics = DifferenceStatistics::between(&[1.0, 2.0, 6.0], &[0.0, 3.0, 4.0], None).unwrap();
        assert_eq!(statistics.count, 3);
        assert_eq!(statistics.max_abs, 2.0);
        assert!((statistics.mean - 2.0 / 3.0).abs() < 1e-15);
        assert!((statistics.rms - 2f64.sqrt()).abs() < 1e-15);
        let wrapped = DifferenceStatistics::between(&[0.01], &[0.99], Some(1.0)).unwrap();
        assert!((wrapped.mean - 0.02).abs() < 1e-15);
        assert_eq!(DifferenceStatistics::between(&[1.0], &[], None), None);
        assert_eq!(DifferenceStatistics::of([]), None);
        assert_eq!(turns(-1e-300), 0.0);
    }
}
