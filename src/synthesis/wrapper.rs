//! Registers around a design, so that place and route times the design itself.
//!
//! A core alone has more ports than a package has pins, and paths from and to pins that no real circuit has. Inside the
//! wrapper every input bit comes from a register of its own (all of them one long shift register), every output bit goes to a
//! register of its own, and those are folded by parity, four a stage, into one pin. Nothing of the design can be removed, and
//! the only long paths from register to register are its own.

use super::verilog::Verilog;
use crate::problem::{Problem, Result};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A port of a design.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Port {
    /// Its name.
    pub name: String,
    /// Its bits.
    pub bits: usize,
    /// Whether the design drives it.
    pub output: bool,
}

#[derive(Deserialize)]
struct Netlist {
    modules: BTreeMap<String, Module>,
}

#[derive(Deserialize)]
struct Module {
    ports: BTreeMap<String, PortOfNetlist>,
}

#[derive(Deserialize)]
struct PortOfNetlist {
    direction: String,
    bits: Vec<serde_json::Value>,
}

/// The ports of the module `top` in the netlist that Yosys' `write_json` wrote, in the order of their names.
pub fn ports(netlist: &str, top: &str) -> Result<Vec<Port>> {
    let netlist: Netlist = serde_json::from_str(netlist).map_err(|error| {
        Problem::at("yosys", format_args!("its netlist cannot be read: {error}"))
            .expected("the output of `write_json`")
    })?;
    let module = netlist
        .modules
        .get(top)
        .ok_or_else(|| Problem::at(top, "is not in the netlist").expected("the top module's name"))?;
    module
        .ports
        .iter()
        .map(|(name, port)| {
            let output = match port.direction.as_str() {
                "input" => Ok(false),
                "output" => Ok(true),
                other => Err(Problem::at(top, format_args!("the port {name} is {other}"))
                    .expected("inputs and outputs only")),
            }?;
            Ok(Port { name: name.clone(), bits: port.bits.len(), output })
        })
        .collect()
}

/// Outputs that one parity register folds: a look-up table has as many inputs.
const FOLD: usize = 4;

/// Name of the wrapper's module.
pub(super) const WRAPPER: &str = "vuris_register_wrapper";

/// The wrapper of `design`, which has `ports`: Verilog-2005, the module `vuris_register_wrapper`.
pub fn wrapper(verilog: &Verilog, ports: &[Port]) -> Result<String> {
    let (clock, top) = (verilog.clock(), verilog.top());
    if !ports.iter().any(|port| port.name == clock && !port.output && port.bits == 1) {
        let names: Vec<&str> = ports.iter().map(|port| port.name.as_str()).collect();
        return Err(Problem::at(top, format_args!("has no clock input {clock}"))
            .expected(format_args!("one of its inputs: {}", names.join(", ")))
            .remedy("name it with --clock"));
    }
    let of = |output: bool| ports.iter().filter(move |port| port.output == output && port.name != clock);
    let (inputs, outputs): (usize, usize) =
        (of(false).map(|port| port.bits).sum(), of(true).map(|port| port.bits).sum());
    if inputs < 2 || outputs == 0 {
        return Err(Problem::at(top, format_args!("has {inputs} input and {outputs} output bits"))
            .expected("two input bits or more beside the clock, and an output"));
    }
    let mut text = format!(
        "`default_nettype none\n\
         module {WRAPPER} (\n  input  wire clk,\n  input  wire serial_i,\n  output wire parity_o\n);\n  \
         (* keep *) reg [{}:0] inputs;\n  wire [{}:0] outputs;\n  (* keep *) reg [{}:0] level_0;\n  \
         always @(posedge clk) inputs <= {{inputs[{}:0], serial_i}};\n  \
         always @(posedge clk) level_0 <= outputs;\n\n  {top} u_design (\n    .\\{clock} (clk)",
        inputs - 1,
        outputs - 1,
        outputs - 1,
        inputs - 2,
    );
    for (output, word) in [(false, "inputs"), (true, "outputs")] {
        let mut low = 0;
        for port in of(output) {
            text += &format!(",\n    .\\{} ({word}[{}:{low}])", port.name, low + port.bits - 1);
            low += port.bits;
        }
    }
    text += "\n  );\n\n";
    let (mut level, mut bits) = (0, outputs);
    while bits > 1 {
        let folded = bits.div_ceil(FOLD);
        text += &format!("  reg [{}:0] level_{};\n  always @(posedge clk) begin\n", folded - 1, level + 1);
        for bit in 0..folded {
            let high = (FOLD * (bit + 1)).min(bits) - 1;
            text += &format!("    level_{}[{bit}] <= ^level_{level}[{high}:{}];\n", level + 1, FOLD * bit);
        }
        text += "  end\n";
        (level, bits) = (level + 1, folded);
    }
    text += &format!("  assign parity_o = level_{level}[0];\nendmodule\n`default_nettype wire\n");
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::artifact::Artifact;

    /// Of Yosys 0.70, shortened.
    const NETLIST: &str = r#"{ "creator": "Yosys 0.70", "modules": {
        "stage": { "attributes": {}, "ports": {} },
        "top": { "ports": {
            "clk_i": { "direction": "input", "bits": [ 2 ] },
            "a": { "direction": "input", "bits": [ 3, 4, 5 ] },
            "sum": { "direction": "output", "bits": [ 6, 7, "0", "1", 8 ] } } } } }"#;

    fn verilog(clock: &str) -> Verilog {
        Verilog::new("top", clock, vec![Artifact::new("top.v", "")]).unwrap()
    }

    #[test]
    fn every_bit_of_every_port_is_connected_once() {
        let ports = ports(NETLIST, "top").unwrap();
        let text = wrapper(&verilog("clk_i"), &ports).unwrap();
        for line in [
            "(* keep *) reg [2:0] inputs;",
            "always @(posedge clk) inputs <= {inputs[1:0], serial_i};",
            ".\\clk_i (clk),",
            ".\\a (inputs[2:0]),",
            ".\\sum (outputs[4:0])",
            "level_1[0] <= ^level_0[3:0];",
            "level_1[1] <= ^level_0[4:4];",
            "level_2[0] <= ^level_1[1:0];",
            "assign parity_o = level_2[0];",
        ] {
            assert!(text.lines().any(|other| other.trim() == line), "{line} is not in\n{text}");
        }
    }

    #[test]
    fn what_cannot_be_wrapped_is_refused() {
        let all = ports(NETLIST, "top").unwrap();
        let said = wrapper(&verilog("clock"), &all).unwrap_err().to_string();
        assert!(said.contains("has no clock input clock") && said.contains("a, clk_i, sum"), "{said}");
        assert!(wrapper(&verilog("a"), &all).is_err(), "a clock of three bits");
        assert!(wrapper(&verilog("sum"), &all).is_err(), "a clock that is an output");
        let no_output: Vec<Port> = all.into_iter().filter(|port| !port.output).collect();
        assert!(wrapper(&verilog("clk_i"), &no_output).is_err());
        assert!(ports(NETLIST, "other").is_err() && ports("", "top").is_err());
        let both_ways = NETLIST.replacen("output", "inout", 1);
        assert!(ports(&both_ways, "top").unwrap_err().to_string().contains("is inout"));
    }
}
