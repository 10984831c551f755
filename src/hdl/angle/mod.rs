//! The angle unit's modules: for every architecture those that it is made of.

mod folded;
mod iterative;
mod normaliser;
mod phase;
mod unrolled;

use super::text::range;
use crate::spec::{AngleUnit, Architecture};
use askama::Template;

/// What the angle unit's templates are rendered from.
#[derive(Debug, Clone, Copy)]
pub struct AngleSource<'a> {
    /// What all module names begin with.
    pub prefix: &'a str,
    /// The unit.
    pub unit: &'a AngleUnit,
    /// Bits of what travels beside the vector, 1 or more.
    pub meta_bits: u32,
}

/// A module of the angle unit.
pub(super) struct AngleModule {
    /// Its noun.
    pub noun: &'static str,
    /// One sentence, the first line of its file.
    pub purpose: &'static str,
    /// Whether an architecture has it.
    pub belongs: fn(Architecture) -> bool,
    /// Its text, after a banner.
    pub render: fn(&AngleSource, String) -> askama::Result<String>,
}

fn is_iterative(architecture: Architecture) -> bool {
    architecture == Architecture::Iterative
}

/// All modules, those that others are made of first.
pub(super) const ANGLE_MODULES: &[AngleModule] = &[
    AngleModule {
        noun: "normaliser",
        purpose: "Quadrant fold and leading-zero shift.",
        belongs: |architecture| !is_iterative(architecture),
        render: normaliser::normaliser,
    },
    AngleModule {
        noun: "cordic",
        purpose: "CORDIC in vectoring mode.",
        belongs: |architecture| !is_iterative(architecture),
        render: |source, banner| match source.unit.architecture {
            Architecture::Folded { stages, rounds } => folded::cordic(source, stages, rounds, banner),
            _ => unrolled::cordic(source, banner),
        },
    },
    AngleModule {
        noun: "phase",
        purpose: "The phase of a turned vector, its fold undone.",
        belongs: |architecture| !is_iterative(architecture),
        render: phase::phase,
    },
    AngleModule {
        noun: "angle",
        purpose: "The angle unit: from a vector to its phase.",
        belongs: |_| true,
        render: |source, banner| match source.unit.architecture {
            Architecture::Iterative => iterative::angle(source, banner),
            _ => angle(source, banner),
        },
    },
];

#[derive(Template)]
#[template(path = "angle.v", escape = "none")]
struct Angle<'a> {
    banner: String,
    prefix: &'a str,
    folded: bool,
    quarters: bool,
    with_length: bool,
    latency: u32,
    clocks_a_vector: u32,
    x_bits: u32,
    y_bits: u32,
    bits_range: String,
    phase_bits: u32,
    length_bits: u32,
    shift_bits: u32,
    shift_range: String,
    length_range: String,
    directions_range: String,
    meta_bits: u32,
}

fn angle(source: &AngleSource, banner: String) -> askama::Result<String> {
    let unit = source.unit;
    let length_bits = unit.length_word().bits;
    Angle {
        banner,
        prefix: source.prefix,
        folded: matches!(unit.architecture, Architecture::Folded { .. }),
        quarters: unit.sector_bits == 2,
        with_length: unit.with_length(),
        latency: unit.latency_clocks(),
        clocks_a_vector: unit.clocks_a_vector(0),
        x_bits: unit.x_bits,
        y_bits: unit.y_bits,
        bits_range: range(unit.magnitude_bits),
        phase_bits: unit.phase_bits,
        length_bits,
        shift_bits: unit.shift_bits(),
        shift_range: range(unit.shift_bits()),
        length_range: range(length_bits),
        directions_range: range(unit.iterations + 1),
        meta_bits: source.meta_bits,
    }
    .render()
}
