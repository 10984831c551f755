//! Template context of the unwrapping with two modulation frequencies.

use super::Source;
use super::control::Counters;
use super::text::{literal, signed_literal, table};
use crate::model;
use crate::spec::{SHARE_BITS, Unwrapper, Word};
use crate::units::unambiguous_range_m;
use askama::Template;

/// An entry of the table of whole turns.
struct Entry {
    /// The ambiguity number, modulo its width.
    label: String,
    value: String,
}

#[derive(Template)]
#[template(path = "unwrapping.v", escape = "none")]
struct Unwrapping {
    banner: String,
    prefix: String,
    range_m: String,
    m: i64,
    n: i64,
    m_literal: String,
    n_literal: String,
    share: i64,
    share_bits: u32,
    share_literal: String,
    codes_a_turn: i64,
    turn_literal: String,
    rows: Vec<String>,
    phase_bits: u32,
    unwrapped_bits: u32,
    difference_bits: u32,
    address_bits: u32,
    pixels: usize,
    residual_limit: i64,
    turns: Vec<Entry>,
    default_turns: String,
}

/// Renders the module. Of a pipeline that does not unwrap there is none: nobody asks for it.
pub(super) fn unwrapping(source: &Source, banner: String) -> askama::Result<String> {
    let pipeline = source.pipeline;
    let Some(unwrapper) = &pipeline.derived().unwrapper else { return Ok(String::new()) };
    let Unwrapper { ratio: [m, n], phase_bits, share, residual_limit, codes_a_turn, .. } = *unwrapper;
    let (unwrapped_bits, difference_bits) = (unwrapper.unwrapped.bits, unwrapper.difference.bits);
    let turn_bits = unwrapped_bits - phase_bits;
    let ambiguity = Word::unsigned(difference_bits - phase_bits);
    let value = |turns: i64| literal(turn_bits, turns);
    let mut turns: Vec<Entry> = (-m..)
        .zip(&unwrapper.whole_turns)
        .map(|(e, &turns)| Entry { label: literal(ambiguity.bits, ambiguity.wrap(e)), value: value(turns) })
        .collect();
    let default_turns = turns.pop().map(|entry| entry.value).unwrap_or_default();
    let rows = [(0, 1), (1, 3), (2, 7), (6, 7)].map(|(part, whole)| {
        // The phases of a range of part/whole turns of f0, rounded down.
        let phase =
            |factor: i64| (((part * factor) << phase_bits) / whole) & Word::unsigned(phase_bits).max();
        let (first, second) = (phase(m), phase(n));
        let unwrapped = model::unwrap_phases(unwrapper, first, second);
        [first, second, unwrapped.ambiguity, unwrapped.residual, unwrapped.code]
            .map(|value| value.to_string())
            .to_vec()
    });
    Unwrapping {
        banner,
        prefix: pipeline.prefix(),
        range_m: format!("{:.6}", unambiguous_range_m(pipeline.modulation.frequency_hz / m as f64)),
        m,
        n,
        m_literal: signed_literal(difference_bits, m),
        n_literal: signed_literal(difference_bits, n),
        share,
        share_bits: SHARE_BITS,
        share_literal: signed_literal(phase_bits + SHARE_BITS + 1, share),
        codes_a_turn,
        turn_literal: signed_literal(unwrapped_bits + 2, codes_a_turn),
        rows: table(&rows),
        phase_bits,
        unwrapped_bits,
        difference_bits,
        address_bits: Counters::new(source).address_bits,
        pixels: pipeline.geometry().pixels(),
        residual_limit,
        turns,
        default_turns,
    }
    .render()
}
