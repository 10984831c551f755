//! Units of the angle that share a specification and not an architecture give the same phase.
//!
//! They do where the guard bits leave nothing to round differently: the unrolled unit keeps fewer bits of x than the others, and
//! only those that its error budget needs. The words here are small and have such guard bits; with fewer, phases differ by a
//! code for some vectors, within the budget of either.

use super::proof::{Proof, define, nothing};
use crate::artifact::Artifact;
use crate::hdl::{AngleSource, angle_artifacts};
use crate::problem::Result;
use crate::spec::{AngleCore, Pipeline};

/// Bits of either coordinate: a small word, all of whose values are met.
const COORDINATE_BITS: u32 = 4;
/// Bits of the phase.
const PHASE_BITS: u32 = 6;
/// Bits of what travels beside the vector.
const META_BITS: u32 = 1;

/// Results are compared whole in this many clocks after power-up, for all words: the first two of either unit are there by then, if
/// nothing pauses and no reset comes. That a later word is treated as these two are is not proved; of all words, for ever and with
/// any pauses, it is proved of one bit that travels beside the vector.
const LAST_RESULT_CLOCKS: u32 = 40;

/// The unrolled unit beside the folded, and beside the iterative one.
pub(super) const PAIRS: [Proof; 2] = [
    pair(
        "folded",
        "a folded angle unit gives the phases of the unrolled one (the first two words, 40 clocks), and loses and repeats no word (for ever)",
        |_| units("2"),
    ),
    pair(
        "iterative",
        "an iterative angle unit gives the phases of the unrolled one (the first two words, 40 clocks), and loses and repeats no word (for ever)",
        |_| units("\"one iteration a clock\""),
    ),
];

const fn pair(
    name: &'static str,
    purpose: &'static str,
    rtl: fn(&Pipeline) -> Result<Vec<Artifact>>,
) -> Proof {
    Proof {
        name,
        purpose,
        text: include_str!("../../../formal/equal.sv"),
        rtl,
        definitions: |_| wrappers(),
        setup: nothing,
        bounded: &[(0, LAST_RESULT_CLOCKS)],
        cover_clocks: |_| 60,
    }
}

/// The unrolled unit as `one`, and as `other` the one with this `cycles_per_pixel`.
fn units(cycles_per_pixel: &str) -> Result<Vec<Artifact>> {
    let mut files = unit("one", "1")?;
    files.extend(unit("other", cycles_per_pixel)?);
    Ok(files)
}

fn unit(prefix: &str, cycles_per_pixel: &str) -> Result<Vec<Artifact>> {
    let text = format!(
        "format = \"vuris-angle/1\"\nname = \"{prefix}\"\n[vector]\nx_bits = {COORDINATE_BITS}\ny_bits = {COORDINATE_BITS}\n\
         [cordic]\niterations = 6\nvector_guard_bits = 2\nangle_guard_bits = 1\ncycles_per_pixel = {cycles_per_pixel}\n\
         [output]\nphase_bits = {PHASE_BITS}\n"
    );
    let core = AngleCore::parse(prefix, &text)?;
    let source = AngleSource { prefix, unit: &core.unit, meta_bits: META_BITS };
    let mut files = angle_artifacts(&source, "proof");
    files.retain(|file| file.path.ends_with(".v"));
    Ok(files)
}

/// Either unit with a word in and a word out.
fn wrappers() -> String {
    let mut text = define("WORD_BITS", 2 * COORDINATE_BITS + META_BITS)
        + &define("RESULT_BITS", PHASE_BITS + 1 + META_BITS);
    for prefix in ["one", "other"] {
        text += &format!(
            "module {prefix}_unit (\n  input wire clk_i, input wire rst_ni, input wire valid_i, output wire ready_o,\n  \
             input wire [`WORD_BITS-1:0] data_i, output wire valid_o, input wire ready_i, output wire [`RESULT_BITS-1:0] data_o\n);\n  \
             wire [{x}:0] x, y;\n  wire meta, meta_o, zero_o;\n  wire [{phase}:0] phase_o;\n  assign {{x, y, meta}} = data_i;\n  \
             assign data_o = {{phase_o, zero_o, meta_o}};\n  {prefix}_angle #(.META_BITS({META_BITS})) u_angle (.clk_i(clk_i), .rst_ni(rst_ni), \
             .valid_i(valid_i), .ready_o(ready_o), .x_i(x), .y_i(y), .meta_i(meta), .valid_o(valid_o), .ready_i(ready_i), \
             .phase_o(phase_o), .zero_o(zero_o), .meta_o(meta_o));\nendmodule\n",
            x = COORDINATE_BITS - 1,
            phase = PHASE_BITS - 1,
        );
    }
    text
}
