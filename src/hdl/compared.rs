//! What the benches compare with the model: the values of every pixel, and the stages where they pass.

use super::top::result_fields;
use crate::model::PixelRecord;
use crate::spec::{Pipeline, Word};

/// A value of every pixel, in a file of golden values.
pub struct Vector {
    /// Name of the file, and of the value.
    pub name: &'static str,
    pub(super) word: fn(&Pipeline) -> Word,
    pub(super) value: fn(&PixelRecord) -> i64,
    /// Whether a pipeline has it.
    belongs: fn(&Pipeline) -> bool,
}

fn always(_: &Pipeline) -> bool {
    true
}

pub(super) fn unwraps(pipeline: &Pipeline) -> bool {
    pipeline.derived().unwrapper.is_some()
}

/// The vectors of `pipeline`'s benches.
pub(super) fn vectors(pipeline: &Pipeline) -> impl Iterator<Item = &'static Vector> {
    VECTORS.iter().filter(|vector| (vector.belongs)(pipeline))
}

/// All vectors.
pub const VECTORS: &[Vector] = &[
    Vector { name: "in_phase", word: |p| p.derived().in_phase, value: |r| r.sums.in_phase, belongs: always },
    Vector {
        name: "quadrature",
        word: |p| p.derived().quadrature,
        value: |r| r.sums.quadrature,
        belongs: always,
    },
    Vector {
        name: "offset_sum",
        word: |p| p.derived().offset_sum,
        value: |r| r.sums.offset,
        belongs: always,
    },
    Vector {
        name: "saturated",
        word: |_| Word::unsigned(1),
        value: |r| r.sums.saturated.into(),
        belongs: always,
    },
    Vector { name: "phase", word: |p| p.derived().phase, value: |r| r.phase, belongs: always },
    Vector {
        name: "amplitude",
        word: |p| p.derived().amplitude,
        value: |r| r.amplitude,
        belongs: |p| p.output.amplitude,
    },
    Vector { name: "offset", word: |p| p.derived().offset, value: |r| r.offset, belongs: always },
    Vector { name: "distance", word: |p| p.derived().distance, value: |r| r.distance, belongs: always },
    Vector { name: "usable", word: |_| Word::unsigned(1), value: |r| r.valid.into(), belongs: always },
    Vector {
        name: "unwrapped",
        word: |p| p.derived().unwrapper.as_ref().map_or(Word::unsigned(1), |unwrapper| unwrapper.unwrapped),
        value: |r| r.unwrapped,
        belongs: unwraps,
    },
    Vector {
        name: "unambiguous",
        word: |_| Word::unsigned(1),
        value: |r| r.unambiguous.into(),
        belongs: unwraps,
    },
];

/// A place in the core where every pixel of every set passes once.
pub struct Stage {
    /// Its name in messages.
    pub name: &'static str,
    /// When a pixel passes: a Verilog expression over the core's wires.
    pub(super) strobe: &'static str,
    /// What is compared there: the vector, and the wire that carries it. An empty wire: a field of the result word.
    probes: &'static [(&'static str, &'static str)],
}

/// All stages, in the order in which a pixel meets them.
pub const STAGES: &[Stage] = &[
    Stage {
        name: "accumulator",
        strobe: "dut.sums_valid && dut.sums_taken",
        probes: &[
            ("in_phase", "dut.sums_in_phase"),
            ("quadrature", "dut.sums_quadrature"),
            ("offset_sum", "dut.sums_offset"),
            ("saturated", "dut.sums_saturated"),
        ],
    },
    Stage {
        name: "angle",
        strobe: "dut.angle_valid && dut.advance",
        probes: &[("phase", "dut.angle_phase")],
    },
    Stage {
        name: "results",
        strobe: "dut.result_valid && dut.advance",
        probes: &[
            ("amplitude", "dut.result_amplitude"),
            ("offset", "dut.result_offset"),
            ("distance", "dut.result_distance"),
            ("usable", "dut.result_usable"),
            ("unwrapped", "dut.result_unwrapped"),
            ("unambiguous", "dut.result_unambiguous"),
        ],
    },
    Stage {
        name: "output",
        strobe: "m_axis_tvalid && m_axis_tready",
        probes: &[
            ("phase", ""),
            ("amplitude", ""),
            ("offset", ""),
            ("distance", ""),
            ("usable", ""),
            ("saturated", ""),
            ("unwrapped", ""),
            ("unambiguous", ""),
        ],
    },
];

/// A value compared at a stage.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Channel {
    /// `stage.vector`.
    pub name: String,
    /// Index into [`STAGES`].
    pub stage: usize,
    /// Name of the vector.
    pub vector: &'static str,
    /// Its word.
    pub word: Word,
    /// Its wire.
    pub(super) probe: String,
    /// Its lowest bit among the taps' values.
    pub(super) low: usize,
}

/// Bits that the taps give each channel.
pub(super) const TAP_BITS: usize = 64;

/// Every channel of `pipeline`'s benches.
pub fn channels(pipeline: &Pipeline) -> Vec<Channel> {
    let fields = result_fields(pipeline);
    let mut channels = Vec::new();
    for (stage, Stage { name, probes, .. }) in STAGES.iter().enumerate() {
        for &(probed, wire) in *probes {
            let Some(vector) = vectors(pipeline).find(|vector| vector.name == probed) else { continue };
            let field = fields.iter().find(|field| field.name == probed);
            let probe = match (wire, field) {
                ("", Some(field)) => format!("m_axis_tdata[{} +: {}]", field.low, field.bits),
                _ => wire.to_owned(),
            };
            channels.push(Channel {
                name: format!("{name}.{probed}"),
                stage,
                vector: vector.name,
                word: (vector.word)(pipeline),
                probe,
                low: channels.len() * TAP_BITS,
            });
        }
    }
    channels
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_probe_names_a_vector_and_only_what_a_pipeline_lacks_is_left_out() {
        let probes: Vec<&str> =
            STAGES.iter().flat_map(|stage| stage.probes).map(|&(probed, _)| probed).collect();
        assert!(probes.iter().all(|probed| VECTORS.iter().any(|vector| vector.name == *probed)));
        let compared = |pipeline: &Pipeline| -> Vec<&str> {
            channels(pipeline).iter().map(|channel| channel.vector).collect()
        };
        let left = |lacking: &[&str]| -> Vec<&str> {
            probes.iter().copied().filter(|probed| !lacking.contains(probed)).collect()
        };
        let pipeline = Pipeline::named("vuris").unwrap();
        let phase_only = pipeline.adapted("test", |s| s.output.amplitude = false).unwrap();
        assert_eq!(compared(&pipeline), left(&["unwrapped", "unambiguous"]));
        assert_eq!(compared(&phase_only), left(&["unwrapped", "unambiguous", "amplitude"]));
    }
}
