//! A second proof for survivors: the module around the cell gives the same outputs at all times, whatever enters, whether or not
//! its registers are the same. ABC proves it from power-up with registers at 0, by signal correspondence and property-directed
//! reachability. What the core around the module guarantees is a row of [`SURROUNDINGS`].

use super::Mutant;
use super::netlist::Netlist;
use crate::problem::{Problem, Result};
use crate::proof::formal::{never, padding};
use crate::proof::yosys::attempt;
use crate::spec::Pipeline;
use std::fmt::Write;

/// What the rest of the core does to a module.
struct Surrounding {
    /// The module's noun.
    noun: &'static str,
    /// The instance, with its dot; any where it is empty.
    instance: &'static str,
    /// What never happens at its ports: outputs begin with `gold_`.
    never: fn(&Pipeline) -> String,
    /// When the outputs below are looked at; `moves` counts the clocks with `advance_i` since power-up, up to 3.
    counts: &'static str,
    /// These.
    beside: &'static [&'static str],
}

const SURROUNDINGS: &[Surrounding] = &[
    Surrounding {
        noun: "accumulator",
        instance: "",
        // Of the proof `framing`: no drain starts in another, and only a first frame is taken beside one. Of the top, and watched by
        // the benches: sums that are not valid hold nothing up.
        never: |_| {
            "(gold_drain_busy_o && (drain_start_i || (take_i && !first_frame_i))) || (!advance_i && !gold_valid_o)".to_owned()
        },
        counts: "gold_valid_o",
        beside: &["first_o", "last_o", "saturated_o", "in_phase_o", "quadrature_o", "offset_o"],
    },
    Surrounding {
        noun: "sequencer",
        instance: "",
        // Of the proof `framing`: the frame that comes next has a place within the set.
        never: |pipeline| format!("frame_i && next_place_i > {}", pipeline.modulation.scheme.steps() - 1),
        counts: "1'b1",
        beside: &[],
    },
    Surrounding {
        noun: "amplitude",
        instance: "",
        never: |_| "1'b0".to_owned(),
        // Nothing valid has come through its two registers before.
        counts: "moves >= 2'd2",
        beside: &["amplitude_o"],
    },
    Surrounding {
        noun: "stream_register",
        instance: "u_result_register.",
        // Of the top, and of the proof `pipeline`: between the result's fields there are zeros. Above it: a line's last, a frame's first.
        never: |pipeline| format!("|(data_i & {{2'b00, {}}})", padding(pipeline)),
        counts: "1'b1",
        beside: &[],
    },
];

/// Whether the module's outputs are proved the same.
pub(super) fn proved(netlist: &Netlist, mutant: &Mutant) -> Result<bool> {
    let path = netlist.folder.join("modules.il");
    let text = std::fs::read_to_string(&path).map_err(|error| Problem::io(&path, "read", &error))?;
    let instances = mutant.instance();
    // The top's own cells would have the whole core around them.
    let Some(module) = module_of(&text, &format!("\\{}", netlist.top), instances) else { return Ok(false) };
    let local = Mutant { cell: mutant.cell[instances.len()..].to_owned(), ..mutant.clone() };
    // Mutants are proved side by side in one folder.
    let folder = tempfile::Builder::new()
        .prefix("vuris-equal-")
        .tempdir()
        .map_err(|error| Problem::io(&std::env::temp_dir(), "write", &error))?;
    let folder = folder.path();
    for (name, text) in
        [("modules.il", text.as_str()), ("miter.v", &miter(&ports(&text, module), &netlist.pipeline, mutant))]
    {
        let path = folder.join(name);
        std::fs::write(&path, text).map_err(|error| Problem::io(&path, "write", &error))?;
    }
    let script = format!(
        "read_rtlil modules.il\ncopy {module} gold\ncopy {module} gate\n{}read_verilog miter.v\nhierarchy -check -top miter\n\
         proc\nflatten\nopt_merge\nopt_clean -purge\nmemory_map\nopt_expr\nopt_clean -purge\ntechmap\nopt_expr\ndffunmap\nsimplemap\n\
         setundef -undriven -zero\nsetundef -init -zero\naigmap\nopt_clean\nwrite_aiger -zinit circuit.aig\n",
        local.command("gate", "")
    );
    Ok(attempt(folder, &script)?.0 && never(folder, PATIENCE_S)?)
}

/// Seconds for a proof.
const PATIENCE_S: u32 = 60;

/// A port: whether it is an input, its bits, its name.
struct Port<'a> {
    input: bool,
    bits: u32,
    name: &'a str,
}

/// The text of `module` in RTLIL.
fn block<'a>(text: &'a str, module: &str) -> Option<&'a str> {
    let start = text.find(&format!("\nmodule {module}\n"))?;
    text[start + 1..].split("\nend\n").next()
}

/// The module that `instances` (each with its dot) lead to from `top`; nothing where there are none.
fn module_of<'a>(text: &'a str, top: &str, instances: &str) -> Option<&'a str> {
    let mut module = None;
    for instance in instances.split_terminator('.') {
        let ending = format!(" \\{instance}");
        let within = block(text, module.unwrap_or(top))?;
        module =
            within.lines().find_map(|line| line.trim().strip_prefix("cell ")?.strip_suffix(ending.as_str()));
        module?;
    }
    module
}

/// The ports of `module`.
fn ports<'a>(text: &'a str, module: &str) -> Vec<Port<'a>> {
    let wires =
        block(text, module).unwrap_or("").lines().filter_map(|line| line.trim().strip_prefix("wire "));
    wires
        .filter_map(|wire| {
            let words: Vec<&str> = wire.split_whitespace().collect();
            let input = words.contains(&"input");
            let width = words.iter().position(|&word| word == "width").and_then(|at| words.get(at + 1));
            (input || words.contains(&"output")).then_some(())?;
            Some(Port {
                input,
                bits: width.map_or(Some(1), |width| width.parse().ok())?,
                name: words.last()?.strip_prefix('\\')?,
            })
        })
        .collect()
}

/// Original and mutant with the same inputs; `watched` is 1 where their outputs differ and it matters.
fn miter(ports: &[Port], pipeline: &Pipeline, mutant: &Mutant) -> String {
    let around =
        |row: &&Surrounding| row.noun == mutant.noun && [mutant.instance(), ""].contains(&row.instance);
    let surrounding = SURROUNDINGS.iter().find(around);
    let [mut inputs, mut outputs, mut gold, mut gate] = [const { String::new() }; 4];
    let mut differences = Vec::new();
    for &Port { input, bits, name } in ports {
        let top = bits - 1;
        let (mut from_gold, mut from_gate) = (name.to_owned(), name.to_owned());
        // Writing into a string cannot fail.
        if name == "rst_ni" {
            (from_gold, from_gate) = ("rst_n".to_owned(), "rst_n".to_owned());
        } else if input {
            let _ = write!(inputs, "input wire [{top}:0] {name}, ");
        } else {
            (from_gold, from_gate) = (format!("gold_{name}"), format!("gate_{name}"));
            let _ = writeln!(outputs, "  wire [{top}:0] {from_gold}, {from_gate};");
            let counts = surrounding.filter(|row| row.beside.contains(&name));
            let counts = counts.map_or("1'b1", |row| row.counts);
            differences.push(format!("({counts} && {from_gold} != {from_gate})"));
        }
        let _ = write!(gold, "{}.{name}({from_gold})", if gold.is_empty() { "" } else { ", " });
        let _ = write!(gate, "{}.{name}({from_gate})", if gate.is_empty() { "" } else { ", " });
    }
    let advances = if ports.iter().any(|port| port.name == "advance_i") { "advance_i" } else { "1'b0" };
    format!(
        "module miter ({inputs}input wire reset, output wire watched);\n{outputs}  reg started = 1'b0;\n  reg left = 1'b0;\n  \
         reg [1:0] moves = 2'd0;\n  wire rst_n = started && !reset;\n  wire leaves = {};\n  always @(posedge clk_i) begin\n    started <= 1'b1;\n    \
         if ({advances} && moves != 2'd3) moves <= moves + 2'd1;\n    \
         if (rst_n && leaves) left <= 1'b1;\n  end\n  gold u_gold ({gold});\n  gate u_gate ({gate});\n  \
         assign watched = rst_n && !left && !leaves && ({});\nendmodule\n",
        surrounding.map_or_else(|| "1'b0".to_owned(), |row| (row.never)(pipeline)),
        differences.join(" || ")
    )
}
