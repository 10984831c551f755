//! Worst-case errors of the pipeline's arithmetic, derived, against exact arithmetic on the same integer frames.
//!
//! Vectors are normalised before the CORDIC (its x is at least 1.0 = 2^fraction ulp), so the phase bound holds
//! for every amplitude down to one code.

use super::{Pipeline, exact};
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4, TAU};

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
        let codes_a_rad = 2f64.powi(phase_bits as i32) / TAU;
        let ulp = 2f64.powi(-(derived.fraction_bits as i32));
        // Two coordinates, each off by at most half an ulp.
        let half_ulp_vector = FRAC_1_SQRT_2 * ulp;

        let rounding_of_input = if derived.normaliser.drop_bits > 0 { half_ulp_vector } else { 0.0 };
        let walk = Walk::new(pipeline.cordic.iterations, half_ulp_vector, 1.0 - rounding_of_input);
        let angle_bits = phase_bits + pipeline.cordic.angle_guard_bits;
        let table_codes: f64 = (1..)
            .zip(&derived.angle_table)
            .map(|(i, &angle)| (exact::atan_of_power_of_two_f64(i, angle_bits) - angle as f64).abs())
            .sum::<f64>()
            / 2f64.powi(pipeline.cordic.angle_guard_bits as i32);

        let phase = vec![
            Contribution {
                name: "irrational factor",
                phase_codes: derived.factor_error / 2.0 * codes_a_rad,
                why: format!(
                    "{}/{} for {}, relative error {:.1e}; a scale error e of one coordinate turns a vector by at most e/2",
                    derived.quadrature_factor,
                    derived.in_phase_factor,
                    if derived.quadrature_factor == 1 { "1" } else { "sqrt(3)" },
                    derived.factor_error
                ),
            },
            Contribution {
                name: "rounding of the normalised vector",
                phase_codes: rounding_of_input * codes_a_rad,
                why: match derived.normaliser.drop_bits {
                    0 => "none: the CORDIC's word holds every bit of the sums".to_owned(),
                    bits => format!("{bits} bits rounded off, half an ulp of 2^-{} each coordinate", derived.fraction_bits),
                },
            },
            Contribution {
                name: "rounding of x and y",
                phase_codes: walk.turned_rad * codes_a_rad,
                why: "half an ulp each coordinate and iteration, over a vector not shorter than 1.0 times the gain so far".to_owned(),
            },
            Contribution {
                name: "remaining angle",
                phase_codes: walk.remaining_rad * codes_a_rad,
                why: format!(
                    "atan 2^-{} after the last iteration, and the wrong decisions that rounding can cause",
                    pipeline.cordic.iterations
                ),
            },
            Contribution {
                name: "rounding of the angle table",
                phase_codes: table_codes,
                why: "sum of the table's own rounding errors, each known".to_owned(),
            },
            Contribution {
                name: "rounding to the phase word",
                phase_codes: 0.5,
                why: "half a code".to_owned(),
            },
        ];

        let phase = with_weight_error(phase, pipeline, codes_a_rad);

        let relative = |value: f64, truth: f64| (value / truth - 1.0).abs();
        let gain = exact::cordic_gain_f64(pipeline.cordic.iterations);
        let exponent = f64::from(pipeline.output.amplitude_fraction_bits)
            + f64::from(derived.normaliser.magnitude_bits)
            - 1.0
            - f64::from(derived.fraction_bits);
        let scheme = &pipeline.modulation.scheme;
        let divisor =
            scheme.gain * (derived.in_phase_factor * pipeline.modulation.frames_per_step as i64) as f64;
        let amplitude_truth = exponent.exp2() / (gain * divisor);
        let offset_truth = f64::from(pipeline.output.offset_fraction_bits).exp2()
            / (scheme.offset_gain() * pipeline.modulation.frames_per_step as i64) as f64;
        let distance_truth = crate::units::unambiguous_range_m(pipeline.modulation.frequency_hz)
            / pipeline.output.distance_unit_m
            / f64::from(phase_bits).exp2();
        Self {
            phase,
            // x falls short of |v| K by 1 − cos of the remaining angle, is off by the vectors' rounding, and a scale error of y
            // changes |v| by at most its own size.
            amplitude_relative: relative(derived.amplitude_factor.value(), amplitude_truth)
                + derived.factor_error
                + walk.turned_rad
                + rounding_of_input
                + scheme.weight_error_amplitude
                + walk.remaining_rad * walk.remaining_rad / 2.0
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
fn with_weight_error(
    mut phase: Vec<Contribution>,
    pipeline: &Pipeline,
    codes_a_rad: f64,
) -> Vec<Contribution> {
    let scheme = &pipeline.modulation.scheme;
    if scheme.weight_error_rad > 0.0 {
        let contribution = Contribution {
            name: "rounding of the weights",
            phase_codes: scheme.weight_error_rad * codes_a_rad,
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

/// How far rounding can lead the iteration astray.
struct Walk {
    /// Sum of the angles by which the roundings of x and y can turn the vector.
    turned_rad: f64,
    /// Bound on the vector's angle after the last iteration.
    remaining_rad: f64,
}

impl Walk {
    /// `rounding`: norm of one iteration's error vector; `least`: least norm of the vector before the first.
    ///
    /// Let B bound |angle| before iteration i. The decision is right for the vector as it stands, so after it
    /// |angle| ≤ max(α_i, B − α_i) + δ_i, with δ_i the turn by rounding. B starts at 45° (octant fold) plus the rounding of
    /// the input, which moves both.
    fn new(iterations: u32, rounding: f64, least: f64) -> Self {
        let (mut remaining_rad, mut turned_rad, mut norm) = (FRAC_PI_4 + rounding, 0.0, least);
        for i in 1..=iterations {
            let tangent = 2f64.powi(-(i as i32));
            let alpha = tangent.atan();
            norm = norm * (1.0 + tangent * tangent).sqrt() - rounding;
            let delta = (rounding / norm).asin();
            turned_rad += delta;
            remaining_rad = alpha.max(remaining_rad - alpha) + delta;
        }
        Self { turned_rad, remaining_rad }
    }
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
