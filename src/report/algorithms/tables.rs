//! Tables of algorithms and of designed rows.

use super::super::table::aligned;
use super::words;
use crate::algorithms::{Algorithm, Design, Verdict};

/// A row for each of `algorithms`, with the verdict of its roots.
pub fn algorithms_table(algorithms: &[Algorithm]) -> String {
    let header = [
        "algorithm",
        "frames",
        "step",
        "roots m of exp(i m step)",
        "rejects harmonics",
        "under a linear step error too",
        "step error: free of swing to order",
        "offset drift",
        "noise factor",
        "weights",
    ];
    let row = |algorithm: &Algorithm| {
        let verdict = Verdict::new(algorithm);
        vec![
            algorithm.name.clone(),
            algorithm.frames().to_string(),
            algorithm.equal_step().map_or_else(|| "unequal".to_owned(), |step| step.to_string()),
            words::roots(algorithm, &verdict),
            words::list(&verdict.rejected(1)),
            words::list(&verdict.rejected(2)),
            order(verdict.step_order),
            if verdict.offset_order > 1 { "rejected" } else { "seen" }.to_owned(),
            format!("{:.4}", verdict.noise_factor),
            words::weights(algorithm),
        ]
    };
    aligned(header, algorithms.iter().map(row)).to_string()
}

/// The highest power of a step error without a swing: one less than the root's multiplicity.
fn order(step_order: usize) -> String {
    step_order.checked_sub(1).map_or_else(|| "biased".to_owned(), |order| order.to_string())
}

/// A row for each of `designs`, in their order. A drift of the amplitude by 100 % a frame would turn every phase by the angle
/// in the last column but one; smaller ones in proportion.
pub fn design_table(designs: &[Design]) -> String {
    let header = [
        "rank",
        "frames",
        "step",
        "noise factor",
        "noise over the DFT's",
        "signed digits",
        "growth, bits",
        "rejects harmonics",
        "under a linear step error too",
        "step error: free of swing to order",
        "turn by amplitude drift, rad",
        "in-phase, quadrature",
    ];
    let row = |design: &Design| {
        vec![
            design.rank.to_string(),
            design.scheme.steps().to_string(),
            design.step.to_string(),
            format!("{:.4}", design.verdict.noise_factor),
            format!("{:.3}", design.noise_over_dft()),
            design.digits.to_string(),
            design.growth_bits.to_string(),
            words::list(&design.verdict.rejected(1)),
            words::list(&design.verdict.rejected(2)),
            order(design.verdict.step_order),
            format!("{:.2}", design.verdict.drift_turn_rad),
            words::rows(&design.scheme),
        ]
    };
    aligned(header, designs.iter().map(row)).to_string()
}
