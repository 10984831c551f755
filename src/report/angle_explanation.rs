//! The angle unit's derived numbers.

use super::explanation::Section;
use crate::spec::{Architecture, Pipeline, StageWord, exact};

/// The table of `pipeline`'s angle unit.
pub(super) fn angle(pipeline: &Pipeline) -> Section {
    let (derived, cordic) = (pipeline.derived(), &pipeline.cordic);
    let angle = &derived.angle;
    let mut section = Section::new("angle unit");
    section.row(
        "architecture",
        match angle.architecture {
            Architecture::Unrolled => "unrolled".to_owned(),
            Architecture::Folded { stages, rounds } => format!("a ring of {stages} stages, {rounds} rounds"),
            Architecture::Iterative => "one iteration a clock".to_owned(),
            Architecture::Tables => "tables and multipliers".to_owned(),
        },
        format!("a vector every {} clocks", angle.clocks_a_vector(0)),
    );
    section.row(
        "metric",
        angle.metric,
        "the angle is that of (in-phase, sqrt(metric) x quadrature): no multiplier",
    );
    section.row(
        "magnitudes",
        format!("{} bits", angle.magnitude_bits),
        "of both sums, without sign; a negative one is complemented",
    );
    section.row("shifts", format!("{:?}", angle.shifts), "together they reach every number of leading zeros");
    section.row(
        "normalised to",
        format!("{} fraction bits", angle.fraction_bits),
        format!(
            "phase bits {} + vector guard bits {}; {}",
            pipeline.output.phase_bits,
            cordic.vector_guard_bits,
            match (angle.pad_bits(), angle.drop_bits()) {
                (pad, 0) => format!("{pad} bits appended, nothing lost"),
                (_, drop) => format!("{drop} bits cut off"),
            }
        ),
    );
    let words = |words: &[StageWord]| {
        let text = |word: &StageWord| format!("{}.{}", word.bits, word.fraction_bits);
        match (words.first(), words.last()) {
            (Some(first), Some(last)) => format!("{} to {}", text(first), text(last)),
            _ => String::new(),
        }
    };
    section.row("x, bits.fraction bits", words(&angle.stages.x), "from iteration 0 to the last, unsigned");
    section.row("y, bits.fraction bits", words(&angle.stages.y), "from iteration 0 to the last, signed");
    section.row(
        "iterations",
        angle.iterations,
        format!("by atan sqrt(metric) / 2^i; x follows the first {}", angle.stages.x_iterations),
    );
    section.row(
        "gain",
        format!("{:.9}", exact::angle_gain_f64(angle.metric, angle.stages.x_iterations)),
        "product of sqrt(1 + metric / 4^i), from i = 0, and the middle of what the last angles leave",
    );
    section.row("angle", format!("{} bits", angle.angle_bits), "phase bits and angle guard bits");
    section.row(
        "tables of angles",
        angle.groups.len(),
        "sums of the angles of a few iterations, by their directions",
    );
    section.row(
        "latency",
        format!("{} clocks", derived.latency_clocks),
        format!(
            "from a pixel's sums at the memory's output to its result: angle {}, amplitude, offset and distance 2, output 1",
            angle.latency_clocks()
        ),
    );
    section
}
