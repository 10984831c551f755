//! Worst-case errors of the pipeline's arithmetic, derived, against exact arithmetic on the same integer frames.
//!
//! Vectors are normalised before they are turned, so the phase bound holds for every amplitude down to one code.

use super::{Pipeline, exact};
use std::f64::consts::TAU;

/// One source of phase error.
#[derive(Debug, Clone, PartialEq)]
pub struct Contribution {
    /// What it is.
    pub name: &'static str,
    /// Its worst case in phase codes.
    pub phase_codes: f64,
    /// Why no input exceeds it.
    pub why: String,
}

/// The worst cases of phase, amplitude, offset and distance.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorBudget {
    /// Sources of phase error, in the order in which the data meets them.
    pub phase: Vec<Contribution>,
    /// Relative error of the amplitude before its last rounding.
    pub amplitude_relative: f64,
    /// Relative error of the offset's factor.
    pub offset_relative: f64,
    /// Relative error of the distance's factor.
    pub distance_relative: f64,
    phase_bits: u32,
}

impl ErrorBudget {
    /// Derives the bounds of `pipeline`.
    pub(super) fn new(pipeline: &Pipeline) -> Self {
        let derived = pipeline.derived();
        let phase_bits = pipeline.output.phase_bits;
        let angle = derived.angle.budget();

        let relative = |value: f64, truth: f64| (value / truth - 1.0).abs();
        let gain = exact::angle_gain_f64(derived.angle.metric, derived.angle.stages.x_iterations);
        let exponent = f64::from(pipeline.output.amplitude_fraction_bits)
            + f64::from(derived.angle.magnitude_bits)
            - 1.0
            - f64::from(derived.angle.fraction_bits);
        let scheme = &pipeline.modulation.scheme;
        let divisor = scheme.gain * pipeline.modulation.frames_per_step as f64;
        let amplitude_truth = exponent.exp2() / (gain * divisor);
        let offset_truth = f64::from(pipeline.output.offset_fraction_bits).exp2()
            / (scheme.offset_gain() * pipeline.modulation.frames_per_step as i64) as f64;
        let distance_truth = crate::units::unambiguous_range_m(pipeline.modulation.frequency_hz)
            / pipeline.output.distance_unit_m
            / f64::from(phase_bits).exp2()
            / derived.unwrapper.as_ref().map_or(1.0, |unwrapper| unwrapper.ratio[1] as f64);
        Self {
            phase: with_weight_error(angle.phase, pipeline),
            amplitude_relative: relative(derived.amplitude_factor.value(), amplitude_truth)
                + angle.length_relative
                + scheme.weight_error_amplitude
                + 1e-14,
            offset_relative: relative(derived.offset_factor.value(), offset_truth) + 1e-14,
            distance_relative: relative(derived.distance_factor.value(), distance_truth) + 1e-14,
            phase_bits,
        }
    }

    /// Worst case of the phase in phase codes, for any vector that is not zero.
    pub fn phase_codes(&self) -> f64 {
        self.phase.iter().map(|contribution| contribution.phase_codes).sum()
    }

    /// The same in radians.
    pub fn phase_rad(&self) -> f64 {
        self.phase_codes() * TAU / f64::from(self.phase_bits).exp2()
    }

    /// Worst case of the amplitude in its codes, at a true amplitude of `codes` of them.
    pub fn amplitude_codes(&self, codes: f64) -> f64 {
        0.5 + codes * self.amplitude_relative
    }

    /// Worst case of the offset in its codes, at a true offset of `codes` of them.
    pub fn offset_codes(&self, codes: f64) -> f64 {
        0.5 + codes * self.offset_relative
    }

    /// Worst case of the distance in its codes against the distance of the same phase word, at `codes` of them.
    pub fn distance_codes(&self, codes: f64) -> f64 {
        0.5 + codes * self.distance_relative
    }
}

/// `phase` with what weights that are not quite the true ones do to a sinusoid, before everything else.
fn with_weight_error(mut phase: Vec<Contribution>, pipeline: &Pipeline) -> Vec<Contribution> {
    let scheme = &pipeline.modulation.scheme;
    if scheme.weight_error_rad > 0.0 {
        let contribution = Contribution {
            name: "rounding of the weights",
            phase_codes: scheme.weight_error_rad * f64::from(pipeline.output.phase_bits).exp2() / TAU,
            why: format!(
                "of a sinusoid over constant light: the sums of the weights times it, with {} weights instead of the true \
                 ones, turn by so much at most; constant light adds nothing, as the weights add up to 0",
                scheme.name
            ),
        };
        phase.insert(0, contribution);
    }
    phase
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A bound below one code makes the phase faithful: one of the two codes next to the truth, for every vector.
    #[test]
    fn the_presets_are_faithful_and_tell_where_the_error_comes_from() {
        for preset in crate::spec::PRESETS {
            let budget = Pipeline::named(preset.name).unwrap().budget();
            assert!(budget.phase_codes() < 1.0, "{}: {budget:?}", preset.name);
            assert!(budget.phase_codes() > 0.5);
        }
    }
}
