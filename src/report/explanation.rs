//! Every derived number of a pipeline, with its reason, as a table that an engineer can check by hand.

use super::angle_explanation::angle;
use super::table::aligned;
use crate::hdl::{result_bits, result_fields};
use crate::spec::{Pipeline, REGISTER_BYTES, REGISTERS, SHARE_BITS, SchemeOrigin, Word, exact};
use crate::units::unambiguous_range_m;
use std::f64::consts::TAU;

/// A table of quantity, value and reason.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Section {
    /// What it is about.
    pub title: &'static str,
    /// Quantity, value and reason of each row.
    pub rows: Vec<[String; 3]>,
}

impl Section {
    pub(super) fn new(title: &'static str) -> Self {
        Self { title, rows: Vec::new() }
    }

    pub(super) fn row(&mut self, quantity: &str, value: impl ToString, why: impl ToString) {
        self.rows.push([quantity.to_owned(), value.to_string(), why.to_string()]);
    }

    fn text(&self) -> String {
        format!("{}\n", aligned([self.title, "value", "why"], &self.rows))
    }
}

fn word(word: Word) -> String {
    format!("{} bits {}", word.bits, if word.signed { "signed" } else { "unsigned" })
}

/// The tables of `pipeline`, in the order in which the data meets what they are about.
pub fn sections(pipeline: &Pipeline) -> Vec<Section> {
    let mut sections = vec![input(pipeline), accumulator(pipeline), angle(pipeline), output(pipeline)];
    sections.extend(unwrapping(pipeline));
    sections.extend([registers(pipeline), errors(pipeline)]);
    sections
}

/// The tables of `pipeline` as text.
pub fn explanation(pipeline: &Pipeline) -> String {
    let mut text = format!(
        "{}: scheme {}, {}\n",
        pipeline.name, pipeline.modulation.scheme.name, pipeline.modulation.scheme.reference
    );
    for section in sections(pipeline) {
        text.push('\n');
        text.push_str(&section.text());
    }
    text
}

fn input(pipeline: &Pipeline) -> Section {
    let (derived, sensor) = (pipeline.derived(), &pipeline.sensor);
    let scheme = &pipeline.modulation.scheme;
    let mut section = Section::new("raw stream");
    section.row("sample", word(derived.sample), "adc_bits");
    section.row(
        "pixels a frame",
        pipeline.geometry().pixels(),
        format!("{} x {}", sensor.width, sensor.height),
    );
    section.row(
        "raw frames a set",
        derived.frames_per_set,
        format!("{} x {} frames a step", scheme.steps_in_words(), pipeline.modulation.frames_per_step),
    );
    let modulation = &pipeline.modulation;
    let order = modulation.steps_in_order();
    section.row(
        "order of the steps",
        format!("{order:?}"),
        "place by place; the sequencer tells the modulation hardware, and each frame gets its step's weights",
    );
    let phases: Vec<i64> = (0..scheme.steps()).map(|step| modulation.step_phase_code(step)).collect();
    section.row(
        "phase of each step",
        format!("{phases:?}"),
        format!("turns / 2^{}, rounded to nearest, whole turns left out", modulation.phase_step_bits),
    );
    section.row("saturated from", format!("{} DN", sensor.saturation_dn), "saturation_dn, or full scale");
    section.row(
        "silence that ends a frame",
        format!("{} clocks", sensor.line_blanking_clocks),
        "line_blanking_clocks",
    );
    section
}

fn accumulator(pipeline: &Pipeline) -> Section {
    let derived = pipeline.derived();
    let scheme = &pipeline.modulation.scheme;
    let mut section = Section::new("accumulator");
    let full_scale = pipeline.modulation.frames_per_step as i64 * derived.sample.max();
    for (name, weights, sum) in [
        ("in-phase sum", &scheme.in_phase, derived.in_phase),
        ("quadrature sum", &scheme.quadrature, derived.quadrature),
        ("offset sum", &scheme.offset, derived.offset_sum),
    ] {
        let part = |sign: i64| weights.iter().filter(|&&weight| weight * sign > 0).sum::<i64>();
        section.row(
            name,
            word(sum),
            format!(
                "weights {weights:?}: between {} x {full_scale} = {} and {} x {full_scale} = {}, for every partial sum too",
                part(-1),
                part(-1) * full_scale,
                part(1),
                part(1) * full_scale
            ),
        );
    }
    section.row("saturation flag", "1 bit", "set by any frame");
    section.row(
        "memory word",
        format!("{} bits", derived.memory_word_bits),
        if derived.storage.is_plain() {
            "the sums and the flag".to_owned()
        } else {
            let kept: Vec<String> = derived
                .storage
                .sums
                .iter()
                .map(|sum| format!("{:?} ({} bits)", sum.weights, sum.word.bits))
                .collect();
            format!("sums of weights {}, from which the three follow, and the flag", kept.join(", "))
        },
    );
    section.row(
        "memory columns",
        format!("{:?}", derived.memory_columns),
        "bits side by side, as wide as block RAMs can be, so that few of their bits lie idle",
    );
    section.row(
        "memory",
        format!("{} bits", derived.memory_bits),
        format!(
            "word x {} pixels, one buffer: a set's first frame replaces sums that have drained",
            pipeline.geometry().pixels()
        ),
    );
    section
}

fn output(pipeline: &Pipeline) -> Section {
    let (derived, output) = (pipeline.derived(), &pipeline.output);
    let mut section = Section::new("result");
    for field in result_fields(pipeline) {
        let top = field.low + field.bits - 1;
        section.row(field.name, format!("bits {top}:{}", field.low), field.meaning);
    }
    section.row(
        "result word",
        format!("{} bits", result_bits(pipeline)),
        "every field starts on a byte, the flags share one",
    );
    let factor = |constant: exact::ScaledConstant| format!("{} / 2^{}", constant.multiplier, constant.shift);
    section.row(
        "amplitude factor",
        factor(derived.amplitude_factor),
        "undoes the gains of CORDIC and scheme, and the frames a step",
    );
    section.row(
        "offset factor",
        factor(derived.offset_factor),
        format!(
            "1 / ({} x {}), in 2^-{} DN",
            pipeline.modulation.scheme.offset_gain(),
            pipeline.modulation.frames_per_step,
            output.offset_fraction_bits
        ),
    );
    let turns = derived.unwrapper.as_ref().map_or(1, |unwrapper| unwrapper.ratio[0]);
    let frequency_hz = pipeline.modulation.frequency_hz / turns as f64;
    section.row(
        "distance factor",
        factor(derived.distance_factor),
        format!(
            "{:.6} m a turn = c / (2 x {frequency_hz} Hz), in units of {} m",
            unambiguous_range_m(frequency_hz),
            output.distance_unit_m
        ),
    );
    section.row(
        "least amplitude",
        format!("{} codes", derived.minimum_amplitude),
        "a weaker pixel is not usable; nor is one without a vector",
    );
    section
}

fn registers(pipeline: &Pipeline) -> Section {
    let mut section = Section::new("registers");
    section.row(
        "specification hash",
        format!("0x{:016x}", pipeline.hash()),
        "first 64 bits of the SHA-256 of what `vuris explain --toml` prints of this specification",
    );
    if !pipeline.registers.axi4_lite {
        section.row("AXI4-Lite port", "none", "registers.axi4_lite = false");
        return section;
    }
    for (number, register) in REGISTERS.iter().enumerate() {
        let address = number as u32 * REGISTER_BYTES;
        let access = if register.writable() { "read and write" } else { "read" };
        section.row(register.name, format!("0x{address:02x}, {access}"), register.meaning);
    }
    section
}

/// The unwrapping, where there is one.
fn unwrapping(pipeline: &Pipeline) -> Option<Section> {
    let unwrapper = pipeline.derived().unwrapper.as_ref()?;
    let ([m, n], bits) = (unwrapper.ratio, unwrapper.phase_bits);
    let frequency_hz = pipeline.modulation.frequency_hz;
    let range_m = unambiguous_range_m(frequency_hz / m as f64);
    let code_m = range_m / unwrapper.codes_a_turn as f64;
    let phase_codes = pipeline.budget().phase_codes();
    let margin = unwrapper.margin_codes();
    let mut section = Section::new("unwrapping");
    section.row(
        "second frequency",
        format!("{} MHz", frequency_hz * n as f64 / m as f64 / 1e6),
        format!("{n}/{m} of the first, {} MHz", frequency_hz / 1e6),
    );
    section.row(
        "unambiguous range",
        format!("{range_m:.4} m"),
        "c / (2 f0), f0 the frequencies' common divisor",
    );
    section.row(
        "unwrapped phase",
        word(unwrapper.unwrapped),
        format!("turns of f0 / {} = {m} x {n} x 2^{bits}", unwrapper.codes_a_turn),
    );
    section.row(
        "share of the second range",
        format!("{} / 2^{SHARE_BITS}", unwrapper.share),
        "its weight over the sum of both, rounded",
    );
    section.row(
        "memory of phases",
        format!("{} bits", (bits as usize + 1) * pipeline.geometry().pixels()),
        format!("phase and flag, {} bits, x {} pixels", bits + 1, pipeline.geometry().pixels()),
    );
    section.row(
        "margin",
        format!("{margin:.1} codes, {:.1} mrad for noise", (margin - phase_codes) * code_mrad(pipeline)),
        format!("2^{} / ({m} + {n}): both phases off by less have the right ambiguity number", bits - 1),
    );
    section.row(
        "trusted residual",
        format!("{} codes", unwrapper.residual_limit),
        "residual_limit_turns; of N phase 1 - M phase 2 modulo a turn, either sign",
    );
    let error = unwrapper.error_codes(phase_codes);
    section.row(
        "worst-case error",
        format!("{error:.3} codes = {:.2} um", error * code_m * 1e6),
        "both phases' worst cases, weighted, and half a code of the mean",
    );
    Some(section)
}

/// A phase code in mrad.
fn code_mrad(pipeline: &Pipeline) -> f64 {
    1e3 * TAU / f64::from(pipeline.output.phase_bits).exp2()
}

fn errors(pipeline: &Pipeline) -> Section {
    let budget = pipeline.budget();
    let code_mrad = code_mrad(pipeline);
    let mut section = Section::new("worst-case error");
    for contribution in &budget.phase {
        section.row(
            &format!("phase: {}", contribution.name),
            format!(
                "{:.4} codes = {:.5} mrad",
                contribution.phase_codes,
                contribution.phase_codes * code_mrad
            ),
            &contribution.why,
        );
    }
    section.row(
        "phase, sum",
        format!("{:.4} codes = {:.5} mrad", budget.phase_codes(), budget.phase_codes() * code_mrad),
        if budget.phase_codes() < 1.0 {
            "faithful: one of the two codes next to the exact phase of the same frames, at every amplitude"
        } else {
            "for every vector that is not zero, at every amplitude"
        },
    );
    section.row(
        "amplitude",
        format!("0.5 codes + {:.2e}", budget.amplitude_relative),
        "last rounding, and relative: factors, rounding in the CORDIC",
    );
    section.row(
        "offset",
        format!("0.5 codes + {:.2e}", budget.offset_relative),
        "last rounding, and relative: the factor",
    );
    section.row(
        "distance",
        format!("0.5 codes + {:.2e}", budget.distance_relative),
        "last rounding, and relative: the factor; beside the phase's own error",
    );
    let scheme = &pipeline.modulation.scheme;
    if let SchemeOrigin::Dft { .. } = scheme.origin {
        // Harmonics above half the steps are mirrors of lower ones; 1 less than the steps is the fundamental's.
        let leakage = |m: usize| scheme.harmonic_leakage(m as i32);
        let worst = (2..=scheme.steps() / 2).max_by(|&one, &other| leakage(one).total_cmp(&leakage(other)));
        if let Some(worst) = worst {
            section.row(
                "harmonics that rounded weights let through",
                format!("{:.2e} at most", leakage(worst)),
                format!("of harmonic {worst}'s own amplitude, over the fundamental's; the exact DFT lets none through up to half its steps"),
            );
        }
    }
    let noise = scheme.noise_factor();
    section.row(
        "noise of the scheme",
        format!("{noise:.4} x sigma / amplitude rad"),
        "from its weights, for white noise: what the errors above are to be compared with",
    );
    section
}
