//! Algorithms and designed rows for programs.

use crate::algorithms::{Algorithm, Design, Verdict};
use crate::spec::Scheme;
use serde_json::{Value, json};

/// The format's name and version; a field that goes or changes its meaning makes another version.
const FORMAT: &str = "vuris-algorithms/1";

fn text(value: &Value) -> String {
    format!("{value:#}")
}

fn weights(scheme: &Scheme) -> Value {
    json!({
        "in_phase": scheme.in_phase,
        "quadrature": scheme.quadrature,
        "quadrature_factor_squared": scheme.irrational.squared(),
        "offset": scheme.offset,
        "gain": scheme.gain,
    })
}

fn verdict(verdict: &Verdict) -> Value {
    json!({
        "roots": verdict.roots.iter().map(|(m, times)| json!({"m": m, "times": times})).collect::<Vec<_>>(),
        "step_order": verdict.step_order,
        "motion_order": verdict.motion_order,
        "offset_order": verdict.offset_order,
        "amplitude_drift_turn_rad": verdict.drift_turn_rad,
        "noise_factor": verdict.noise_factor,
        "harmonics": verdict.harmonics.iter().map(|row| json!({
            "harmonic": row.harmonic,
            "rejected": row.rejected(),
            "upper_roots": row.upper_roots,
            "lower_roots": row.lower_roots,
            "looks_like": row.alias,
            "upper_leakage": row.leakage[0],
            "lower_leakage": row.leakage[1],
        })).collect::<Vec<_>>(),
    })
}

/// `algorithms` with their verdicts. Roots are m of exp(i m δ) in Surrel's sign; orders are their multiplicities.
pub fn algorithms_json(algorithms: &[Algorithm]) -> String {
    let row = |algorithm: &Algorithm| {
        json!({
            "name": algorithm.name,
            "reference": algorithm.reference,
            "remark": algorithm.remark,
            "frames": algorithm.frames(),
            "angles_turns": algorithm.angles.iter().map(|angle| [angle.numerator(), angle.denominator()]).collect::<Vec<_>>(),
            "coefficients": algorithm.polynomial.coefficients().iter().map(|c| [c.re, c.im]).collect::<Vec<_>>(),
            "linear": algorithm.estimator.is_none(),
            "rounded": algorithm.is_rounded(),
            "weights": algorithm.scheme.as_ref().map(weights),
            "verdict": verdict(&Verdict::new(algorithm)),
        })
    };
    let rows: Vec<Value> = algorithms.iter().map(row).collect();
    text(&json!({"format": FORMAT, "algorithms": rows}))
}

/// `designs` in their order.
pub fn designs_json(designs: &[Design]) -> String {
    let row = |design: &Design| {
        json!({
            "rank": design.rank,
            "frames": design.scheme.steps(),
            "step_turns": [design.step.numerator(), design.step.denominator()],
            "signed_digits": design.digits,
            "growth_bits": design.growth_bits,
            "noise_over_dft": design.noise_over_dft(),
            "weights": weights(&design.scheme),
            "verdict": verdict(&design.verdict),
        })
    };
    let rows: Vec<Value> = designs.iter().map(row).collect();
    text(&json!({"format": FORMAT, "designs": rows}))
}
