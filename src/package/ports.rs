//! The core's ports, as its top module declares them.

use crate::hdl::{Source, rtl_artifacts};
use crate::spec::Pipeline;

/// Which way a port points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// Into the core.
    Input,
    /// Out of the core.
    Output,
}

impl Direction {
    /// Verilog's word for it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Input => "input",
            Self::Output => "output",
        }
    }
}

/// A port of the top module.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Port {
    /// Its name.
    pub name: String,
    /// Which way it points.
    pub direction: Direction,
    /// Its width.
    pub bits: u32,
    /// What it carries.
    pub meaning: String,
    /// What an output shows from the first clock edge in reset until something else is due; nothing where its value has no
    /// meaning until the valid beside it.
    pub at_reset: Option<u32>,
}

/// The ports of `pipeline`'s top module, in their order. Each is declared in a line of its own, with its meaning as a comment.
pub fn ports(pipeline: &Pipeline) -> Vec<Port> {
    let artifacts = rtl_artifacts(&Source { pipeline, spec: "" });
    let top = format!("rtl/{}.v", pipeline.top());
    let text = artifacts.iter().find(|artifact| artifact.path == top).map_or("", |artifact| &artifact.text);
    let header =
        text.lines().skip_while(|line| !line.starts_with("module ")).take_while(|line| *line != ");");
    header.filter_map(|line| declared(pipeline, line)).collect()
}

/// The port that a line such as `  input  wire [15:0] s_axis_tdata,  // raw code` declares.
fn declared(pipeline: &Pipeline, line: &str) -> Option<Port> {
    let (declaration, meaning) = line.split_once("//").unwrap_or((line, ""));
    let mut words = declaration.trim().trim_end_matches(',').split_whitespace();
    let direction = match words.next()? {
        "input" => Direction::Input,
        "output" => Direction::Output,
        _ => return None,
    };
    let words: Vec<&str> = words.collect();
    let name = *words.last()?;
    let range = words.iter().find_map(|word| word.strip_prefix('[')?.strip_suffix(":0]"));
    let bits = 1 + range.map_or(Ok(0), str::parse).ok()?;
    let at_reset = match direction {
        Direction::Input => None,
        Direction::Output => value_at_reset(pipeline, name),
    };
    Some(Port { name: name.to_owned(), direction, bits, meaning: meaning.trim().to_owned(), at_reset })
}

/// A stream offers nothing and takes whatever comes, the first frame is due, a setting is as specified, a counter or strobe is 0;
/// a stream's payload has no reset.
fn value_at_reset(pipeline: &Pipeline, name: &str) -> Option<u32> {
    let first_step = pipeline.modulation.step_at(0);
    match name {
        "frequency_factor_o" => Some(pipeline.registers.frequency_factor),
        "next_frame_first_o" => Some(1),
        "next_frame_step_o" => Some(first_step as u32),
        "next_frame_phase_o" => Some(pipeline.modulation.step_phase_code(first_step) as u32),
        _ if name.ends_with("valid") || name.ends_with("_o") => Some(0),
        _ if name.ends_with("ready") => Some(1),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hdl::result_bits;

    #[test]
    fn every_port_of_the_presets_is_read_with_its_width_and_meaning() {
        for preset in crate::spec::PRESETS {
            let pipeline = Pipeline::named(preset.name).unwrap();
            let ports = ports(&pipeline);
            let text = rtl_artifacts(&Source { pipeline: &pipeline, spec: "" })
                .into_iter()
                .find(|artifact| artifact.path.ends_with("_pipeline.v"))
                .unwrap()
                .text;
            let wires = |word: &str| text.matches(&format!("\n  {word} ")).count();
            assert_eq!(ports.len(), wires("input") + wires("output"), "{ports:?}");
            assert!(ports.iter().all(|port| !port.meaning.is_empty()), "{ports:?}");
            let bits = |name: &str| ports.iter().find(|port| port.name == name).unwrap().bits;
            assert_eq!(bits("m_axis_tdata"), result_bits(&pipeline));
            assert_eq!(bits("s_axis_tdata"), pipeline.sensor.adc_bits.next_multiple_of(8));
            assert_eq!((bits("clk_i"), bits("s_axis_tuser"), bits("sets_done_o")), (1, 2, 32));
        }
    }

    #[test]
    fn what_is_not_a_port_is_none() {
        let pipeline = Pipeline::named("vuris").unwrap();
        for line in ["module vuris_pipeline (", "", "  wire [3:0] inner;  // wire", "  // input wire a"] {
            assert_eq!(declared(&pipeline, line), None, "{line}");
        }
        let port = declared(&pipeline, "  output wire [87:0] m_axis_tdata,      // the result, // as above")
            .unwrap();
        assert_eq!((port.bits, port.meaning.as_str()), (88, "the result, // as above"));
        assert_eq!(port.at_reset, None);
    }
}
