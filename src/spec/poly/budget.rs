//! Worst-case error of the angle by tables and multipliers.

use super::Poly;
use crate::spec::Contribution;
use std::f64::consts::TAU;

impl Poly {
    /// What the worst vector's phase may be off by, in the segment of the arctangent where the sum is greatest.
    ///
    /// With t = minor/major, an error e of t turns the angle by e/(1 + t²); the error of t itself is at most ulp/major by
    /// the coordinates, which both fall short by at most an ulp and so partly cancel, t times the relative error of the
    /// reciprocal, and half an ulp of the ratio, whose word stands for the middle of what is rounded down to it.
    pub fn budget(&self) -> Vec<Contribution> {
        let codes_a_rad = f64::from(self.phase_bits).exp2() / TAU;
        let coordinate = (1.0 - f64::from(self.coordinate_bits)).exp2();
        let ratio = (-1.0 - f64::from(self.ratio_bits)).exp2();
        let segments = f64::from(self.arctangent.segment_bits).exp2();
        let of_segment = |segment: usize, table: f64| {
            let (low, high) = (segment as f64 / segments, (segment + 1) as f64 / segments);
            let turned = codes_a_rad / (1.0 + low * low);
            [coordinate * turned, self.reciprocal.relative_error * high * turned, ratio * turned, table, 0.5]
        };
        let sum = |codes: &[f64; 5]| codes.iter().sum::<f64>();
        let worst = self
            .arctangent
            .segment_errors
            .iter()
            .enumerate()
            .map(|(segment, &table)| of_segment(segment, table))
            .max_by(|a, b| sum(a).total_cmp(&sum(b)))
            .unwrap_or_default();
        let names = [
            ("complement for negation", "a negative coordinate falls short by an ulp of the normalised word"),
            ("reciprocal", "the factor's table, its rounding, and the product rounded down"),
            (
                "rounding of the ratio",
                "half an ulp: the arctangent's table takes the middle of what is rounded down",
            ),
            ("arctangent", "lines and curves, their rounding, and the product rounded down"),
            ("rounding to the phase word", "half a code"),
        ];
        names
            .into_iter()
            .zip(worst)
            .map(|((name, why), phase_codes)| Contribution { name, phase_codes, why: why.to_owned() })
            .collect()
    }

    /// Worst case of the phase in phase codes, for any vector that is not zero.
    pub fn phase_codes(&self) -> f64 {
        self.budget().iter().map(|contribution| contribution.phase_codes).sum()
    }
}
