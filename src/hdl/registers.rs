//! Template context of the register block, and its map for software: C header, Rust constants, documentation.

use super::Source;
use super::text::{counter_bits, literal};
use crate::artifact::Artifact;
use crate::spec::{ADDRESS_BITS, Content, Counter, REGISTER_BYTES, REGISTERS, Register};
use askama::Template;
use std::fmt::Write;

/// The wire that a count arrives on, or the register that holds it.
fn wire(counter: Counter) -> &'static str {
    match counter {
        Counter::SetsDone => "sets_done_i",
        Counter::SetsDiscarded => "sets_discarded_i",
        Counter::StallClocks => "stall_clocks_i",
        Counter::SaturatedPixels => "saturated_pixels_q",
        Counter::SetNumber => "set_number_q",
    }
}

/// A register, as the template takes it.
struct Row {
    name: &'static str,
    /// The case label: its number.
    label: String,
    /// What it reads as.
    value: String,
    /// A setting's value after a reset.
    reset: String,
    meaning: &'static str,
}

#[derive(Template)]
#[template(path = "registers.v", escape = "none")]
struct RegisterBlock {
    banner: String,
    prefix: String,
    address_bits: u32,
    /// The comment's table.
    rows: Vec<String>,
    /// Bits of a register's number.
    word_bits: u32,
    constants: Vec<Row>,
    variables: Vec<Row>,
    /// Case labels of the numbers beyond the last register.
    missing: Vec<String>,
    settings: Vec<Row>,
}

/// Every register with its byte address.
fn map() -> impl Iterator<Item = (u32, &'static Register)> {
    (0..).step_by(REGISTER_BYTES as usize).zip(REGISTERS)
}

fn access(register: &Register) -> &'static str {
    if register.writable() { "read and write" } else { "read" }
}

/// A 32-bit literal in hexadecimal.
fn hexadecimal(value: u32) -> String {
    format!("32'h{value:08x}")
}

pub(super) fn registers(source: &Source, banner: String) -> askama::Result<String> {
    let word_bits = counter_bits(REGISTERS.len() - 1);
    let row = |bits: u32, (address, register): (u32, &'static Register)| Row {
        name: register.name,
        label: literal(bits, i64::from(address / REGISTER_BYTES)),
        value: match register.content {
            Content::Constant(value) => hexadecimal(value(source.pipeline)),
            Content::Counter(counter) => wire(counter).to_owned(),
            Content::Setting(_) => format!("{}_q", register.name),
        },
        reset: match register.content {
            Content::Setting(value) => hexadecimal(value(source.pipeline)),
            Content::Constant(_) | Content::Counter(_) => String::new(),
        },
        meaning: register.meaning,
    };
    let constant = |(_, register): &(u32, &Register)| matches!(register.content, Content::Constant(_));
    let short = |register: &Register| if register.writable() { "rw" } else { "ro" };
    RegisterBlock {
        banner,
        prefix: source.pipeline.prefix(),
        address_bits: ADDRESS_BITS,
        rows: map()
            .map(|(address, register)| {
                format!("0x{address:02x}    | {:<6} | {}", short(register), register.name)
            })
            .collect(),
        word_bits,
        constants: map().filter(constant).map(|place| row(word_bits, place)).collect(),
        variables: map().filter(|place| !constant(place)).map(|place| row(word_bits, place)).collect(),
        missing: (REGISTERS.len()..1 << word_bits).map(|number| literal(word_bits, number as i64)).collect(),
        settings: map()
            .filter(|(_, register)| register.writable())
            .map(|place| row(ADDRESS_BITS - 2, place))
            .collect(),
    }
    .render()
}

/// What a register holds after a reset, where that is known.
fn after_reset(source: &Source, register: &Register) -> u32 {
    match register.content {
        Content::Constant(value) | Content::Setting(value) => value(source.pipeline),
        Content::Counter(_) => 0,
    }
}

/// The register map for software, where there is a register block.
pub(super) fn map_artifacts(source: &Source) -> Vec<Artifact> {
    if !source.pipeline.registers.axi4_lite {
        return Vec::new();
    }
    let prefix = source.pipeline.prefix();
    vec![
        Artifact::new(format!("software/{prefix}_registers.h"), header(source, &prefix)),
        Artifact::new(format!("software/{prefix}_registers.rs"), constants(source)),
        Artifact::new("software/registers.md", documentation(source)),
    ]
}

/// A constant of the map: name, type, value, meaning.
struct Constant {
    name: String,
    /// Bits of its type.
    bits: u32,
    value: String,
    meaning: String,
}

fn map_constants(source: &Source) -> Vec<Constant> {
    let mut all: Vec<Constant> = map()
        .map(|(address, register)| Constant {
            name: format!("{}_OFFSET", register.name.to_uppercase()),
            bits: 32,
            value: format!("0x{address:02x}"),
            meaning: format!("{}: {}", access(register), register.meaning),
        })
        .collect();
    for name in ["identification", "version"] {
        let register = REGISTERS.iter().find(|register| register.name == name);
        all.extend(register.map(|register| Constant {
            name: format!("{}_VALUE", name.to_uppercase()),
            bits: 32,
            value: format!("0x{:08x}", after_reset(source, register)),
            meaning: format!("what {name} reads as"),
        }));
    }
    all.push(Constant {
        name: "SPECIFICATION_HASH".to_owned(),
        bits: 64,
        value: format!("0x{:016x}", source.pipeline.hash()),
        meaning: "what hash_high and hash_low read as: the specification that this file was made from"
            .to_owned(),
    });
    all
}

fn header(source: &Source, prefix: &str) -> String {
    let name = prefix.to_uppercase();
    let mut text = format!(
        "/* Registers of {prefix}_pipeline: byte offsets from the base of its AXI4-Lite port, 32 bits each.\n \
         * Generated by `vuris generate --spec {}`: change the specification, not this file.\n \
         * SPDX-License-Identifier: MIT OR Apache-2.0 */\n\
         #ifndef {name}_REGISTERS_H\n#define {name}_REGISTERS_H\n",
        source.spec
    );
    for Constant { name: constant, bits, value, meaning } in map_constants(source) {
        let suffix = if bits == 64 { "ull" } else { "u" };
        // Writing into a string cannot fail.
        let _ = write!(text, "\n/* {meaning} */\n#define {name}_{constant} {value}{suffix}\n");
    }
    text + "\n#endif\n"
}

fn constants(source: &Source) -> String {
    let mut text = format!(
        "// Registers of {}: byte offsets from the base of its AXI4-Lite port, 32 bits each.\n\
         // Generated by `vuris generate --spec {}`: change the specification, not this file.\n\
         // SPDX-License-Identifier: MIT OR Apache-2.0\n",
        source.pipeline.top(),
        source.spec
    );
    for Constant { name, bits, value, meaning } in map_constants(source) {
        let _ = write!(text, "\n/// {meaning}\npub const {name}: u{bits} = {value};\n");
    }
    text
}

fn documentation(source: &Source) -> String {
    let mut text = format!(
        "<!-- Generated by `vuris generate --spec {}`: change the specification, not this file. -->\n\
         # Registers of {}\n\n\
         32 bits each, over AXI4-Lite. A read of another address, a write to one and a write to a register that is only read answer\n\
         SLVERR and change nothing. The specification hash is the first 64 bits of the SHA-256 of what\n\
         `vuris explain --spec {} --toml` prints.\n\n\
         | address | name | access | after reset | meaning |\n| --- | --- | --- | --- | --- |\n",
        source.spec,
        source.pipeline.top(),
        source.spec
    );
    for (address, register) in map() {
        let Register { name, meaning, .. } = register;
        let _ = writeln!(
            text,
            "| 0x{address:02x} | {name} | {} | 0x{:08x} | {meaning} |",
            access(register),
            after_reset(source, register)
        );
    }
    text
}
