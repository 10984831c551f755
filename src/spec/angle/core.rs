//! An angle unit by itself: its specification's TOML file.

use super::{AngleSpecification, AngleUnit, read_cordic, write_cordic};
use crate::fields::{self, Fields};
use crate::problem::Result;
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
        top.only(&["format", "name", "vector", "cordic", "output"])?;
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
        let specification = AngleSpecification {
            x_bits: vector.integer("x_bits", 2..=40)? as u32,
            y_bits: vector.integer("y_bits", 2..=40)? as u32,
            metric: vector.integer_or("metric", 1..=3, 1)?,
            cordic: read_cordic(&top.section("cordic")?)?,
            phase_bits: output.integer("phase_bits", 4..=24)? as u32,
            length_bits: output.integer_or("length_bits", 0..=32, 0)? as u32,
        };
        Ok(Self { name, unit: AngleUnit::new(source, specification)? })
    }

    /// The specification as the text of a TOML file, from which it can be read again.
    pub fn to_toml(&self) -> String {
        let AngleSpecification { x_bits, y_bits, metric, phase_bits, length_bits, cordic } = &*self.unit;
        format!(
            "format = \"{ANGLE_FORMAT}\"\nname = \"{}\"\n\
             \n[vector]\nx_bits = {x_bits}\ny_bits = {y_bits}\nmetric = {metric}\n\
             \n{}\n[output]\nphase_bits = {phase_bits}\nlength_bits = {length_bits}\n",
            self.name,
            write_cordic(cordic)
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
