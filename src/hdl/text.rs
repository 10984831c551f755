//! Fragments of Verilog: literals, ranges, extensions, banners.

use crate::spec::Word;
use askama::Template;
use std::fmt::Display;

#[derive(Template)]
#[template(path = "banner.v", escape = "none")]
struct Banner<'a> {
    purpose: &'a str,
    spec: &'a str,
}

/// The first lines of a generated file.
pub(super) fn banner(spec: &str, purpose: &str) -> String {
    let banner = Banner { purpose, spec };
    finished(banner.render()).trim_end().to_owned()
}

/// A rendered template with its last newline, which askama drops and Verilator wants.
///
/// Templates are checked when the crate is compiled and write into a string: rendering cannot fail.
pub(super) fn finished(rendered: askama::Result<String>) -> String {
    let mut text = rendered.expect("rendering into a string cannot fail");
    if !text.ends_with('\n') {
        text.push('\n');
    }
    text
}

/// The range `[bits-1:0]`.
pub(super) fn range(bits: u32) -> String {
    format!("[{}:0]", bits - 1)
}

/// The range `[high:low]`.
pub(super) fn slice(high: impl Display, low: impl Display) -> String {
    format!("[{high}:{low}]")
}

/// The index `[place]`.
pub(super) fn bit(place: impl Display) -> String {
    format!("[{place}]")
}

/// An unsigned literal.
pub(super) fn literal(bits: u32, value: i64) -> String {
    debug_assert!(Word::unsigned(bits).contains(value));
    format!("{bits}'d{value}")
}

/// A signed literal.
pub(super) fn signed_literal(bits: u32, value: i64) -> String {
    debug_assert!(Word::signed(bits).contains(value));
    // The least value has no positive literal: its pattern is written.
    match value {
        0.. => format!("{bits}'sd{value}"),
        _ if value == Word::signed(bits).min() => format!("{bits}'sh{:x}", Word::signed(bits).pattern(value)),
        _ => format!("-{bits}'sd{}", -value),
    }
}

/// `name` of `from` bits as one of `to` bits, zeros above.
pub(super) fn zero_extended(name: &str, from: u32, to: u32) -> String {
    match to - from {
        0 => name.to_owned(),
        spare => format!("{{{spare}'d0, {name}}}"),
    }
}

/// Bits that count from 0 to `largest`.
pub(super) fn counter_bits(largest: usize) -> u32 {
    Word::holding(0, largest as i64).bits
}

/// Rows of a comment's table: columns padded to one width.
pub(super) fn table(rows: &[Vec<String>]) -> Vec<String> {
    let columns = rows.first().map_or(0, Vec::len);
    let width = |column: usize| rows.iter().map(|row| row[column].len()).max().unwrap_or(0);
    rows.iter()
        .map(|row| {
            let cells = (0..columns).map(|column| format!("{:<1$}", row[column], width(column)));
            cells.collect::<Vec<_>>().join(" | ").trim_end().to_owned()
        })
        .collect()
}
