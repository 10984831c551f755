//! How exact a core is: the figures beside its area.

use serde::{Deserialize, Serialize};

/// Errors of an angle core's phase against exact arithmetic, in 2^-16 turn whatever the width of its phase is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Accuracy {
    /// Who computed the phases.
    pub method: AccuracyMethod,
    /// Vectors that were compared; the zero vector is none.
    pub vectors: u64,
    /// The largest error of all.
    pub largest: f64,
    /// The root of the mean square of all errors.
    pub rms: f64,
    /// The largest error among vectors of the four highest octaves of the length.
    pub largest_strong: f64,
    /// The largest error among vectors shorter than 16 codes, of which none is left out.
    pub largest_weak: f64,
    /// The mean error (bias) of every octave that was looked at.
    pub means: Vec<OctaveMean>,
}

/// Who computed the phases that were compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AccuracyMethod {
    /// The integer model, which is bit-exact with the hardware.
    Model,
    /// The Verilog itself, in Verilator.
    Verilator,
}

/// The mean error of the vectors whose length is from 2^octave up to 2^(octave + 1).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct OctaveMean {
    /// Binary logarithm of the shortest length, codes.
    pub octave: u32,
    /// Mean error, 2^-16 turn.
    pub mean: f64,
}

impl Accuracy {
    /// The largest mean error of an octave from `codes` up, without its sign.
    pub fn largest_mean_from(&self, codes: u32) -> Option<f64> {
        let octaves = self.means.iter().filter(|mean| 1_u64 << mean.octave.min(63) >= u64::from(codes));
        octaves.map(|mean| mean.mean.abs()).max_by(f64::total_cmp)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bias_is_that_of_the_worst_octave_from_a_length_up() {
        let means = [(3, 9.0), (4, 0.01), (5, -0.04)].map(|(octave, mean)| OctaveMean { octave, mean });
        let mut accuracy = Accuracy {
            method: AccuracyMethod::Model,
            vectors: 3,
            largest: 9.0,
            rms: 1.0,
            largest_strong: 0.1,
            largest_weak: 9.0,
            means: means.to_vec(),
        };
        assert_eq!(accuracy.largest_mean_from(16), Some(0.04));
        assert_eq!(accuracy.largest_mean_from(8), Some(9.0));
        accuracy.means.clear();
        assert_eq!(accuracy.largest_mean_from(16), None);
    }
}
