//! An angle unit by itself: its specification's TOML file.

use super::{AngleSpecification, AngleUnit, Atan, Cordic, read_cordic, write_cordic};
use crate::fields::{self, Fields};
use crate::problem::Result;
use crate::spec::Tables;
use crate::spec::file::{NAME_RULE, check_name};

/// The first line of such a file.
pub(in crate::spec) const ANGLE_FORMAT: &str = "vuris-angle/1";

/// An angle unit with a name, to be generated without a camera around it.
#[derive(Debug, Clone, PartialEq)]
pub struct AngleCore {
    /// What the names of its modules begin with, `-` for `_`.
    pub name: String,
    /// The unit.
    pub unit: AngleUnit,
}

impl AngleCore {
    /// Reads the text of a specification; `source` is the name that a refusal gives.
    pub fn parse(source: &str, text: &str) -> Result<Self> {
        let table = fields::parse(source, text)?;
        let top = Fields::top(source, &table);
        top.only(&["format", "name", "atan", "vector", "cordic", "poly", "output"])?;
        let expected = format!("\"{ANGLE_FORMAT}\"");
        if top.text("format", &expected)? != ANGLE_FORMAT {
            return Err(top.refuse("format", &expected));
        }
        let name = top.text("name", NAME_RULE)?.to_owned();
        check_name(source, &name)?;
        let vector = top.section("vector")?;
        vector.only(&["x_bits", "y_bits", "metric"])?;
        let output = top.section("output")?;
        output.only(&["phase_bits", "length_bits"])?;
        let phase_bits = output.integer("phase_bits", 4..=24)? as u32;
        let (atan, cordic) = read_atan(&top, phase_bits)?;
        let specification = AngleSpecification {
            x_bits: vector.integer("x_bits", 2..=56)? as u32,
            y_bits: vector.integer("y_bits", 2..=56)? as u32,
            metric: vector.integer_or("metric", 1..=3, 1)?,
            atan,
            cordic,
            phase_bits,
            length_bits: output.integer_or("length_bits", 0..=32, 0)? as u32,
        };
        Ok(Self { name, unit: AngleUnit::new(source, specification)? })
    }

    /// The specification as the text of a TOML file, from which it can be read again.
    pub fn to_toml(&self) -> String {
        let AngleSpecification { x_bits, y_bits, metric, phase_bits, length_bits, atan, cordic } =
            &*self.unit;
        let (name, algorithm) = match atan {
            Atan::Cordic => ("cordic", write_cordic(cordic)),
            Atan::Poly(tables) => ("poly", format!("[poly]\ntables = \"{}\"\n", tables.name())),
        };
        format!(
            "format = \"{ANGLE_FORMAT}\"\nname = \"{}\"\natan = \"{name}\"\n\
             \n[vector]\nx_bits = {x_bits}\ny_bits = {y_bits}\nmetric = {metric}\n\
             \n{}\n[output]\nphase_bits = {phase_bits}\nlength_bits = {length_bits}\n",
            self.name, algorithm
        )
    }

    /// What the names of all Verilog modules begin with.
    pub fn prefix(&self) -> String {
        self.name.replace('-', "_")
    }

    /// Name of the top Verilog module.
    pub fn top(&self) -> String {
        format!("{}_angle", self.prefix())
    }
}

/// The algorithm, and its table of the file: the other one's is refused, not ignored.
fn read_atan(top: &Fields, phase_bits: u32) -> Result<(Atan, Cordic)> {
    let algorithms = "\"cordic\" or \"poly\"";
    let atan = if top.has("atan") { top.text("atan", algorithms)? } else { "cordic" };
    let (own, other) = match atan {
        "cordic" => ("cordic", "poly"),
        "poly" => ("poly", "cordic"),
        _ => return Err(top.refuse("atan", algorithms)),
    };
    if top.has(other) {
        return Err(top.refuse(other, format!("no such table where atan = \"{own}\"")));
    }
    let section = top.section(own)?;
    if own == "cordic" {
        return Ok((Atan::Cordic, read_cordic(&section)?));
    }
    section.only(&["tables"])?;
    let kinds = Tables::ALL.map(|tables| format!("\"{}\"", tables.name())).join(" or ");
    let name = section.text("tables", &kinds)?;
    let tables = Tables::ALL.into_iter().find(|tables| tables.name() == name);
    let tables = tables.ok_or_else(|| section.refuse("tables", &kinds))?;
    // No iteration is done; these are within every limit.
    Ok((Atan::Poly(tables), Cordic::new(phase_bits.min(20), 3, 4)))
}
