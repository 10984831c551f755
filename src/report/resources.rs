//! What one core takes of an FPGA, for its integration guide.

use crate::synthesis::{Baseline, Speed};

/// The table's lines for the core called `name` whose Verilog has `digest`; none where `baseline` has not measured this very
/// Verilog.
pub fn resources(baseline: &Baseline, name: &str, digest: &str) -> Vec<String> {
    let Some(measured) =
        baseline.targets.iter().find(|target| target.name == name && target.digest == digest)
    else {
        return Vec::new();
    };
    let mut lines = vec![
        "| part | LUTs | registers | block RAM | DSP | clock, MHz (median, range over seeds) |".to_owned(),
        "| --- | --- | --- | --- | --- | --- |".to_owned(),
    ];
    for mapped in &measured.results {
        let speed = match (mapped.speed.frequencies_mhz(), &mapped.speed) {
            (Some((median, least, largest)), _) => format!("{median:.1}, {least:.1} to {largest:.1}"),
            (None, Speed::DoesNotFit(why)) => format!("does not fit: {why}"),
            (None, Speed::Routed(_)) => "not placed".to_owned(),
        };
        let area = &mapped.area;
        lines.push(format!(
            "| {} | {} | {} | {} | {} | {speed} |",
            mapped.family.part(),
            area.luts,
            area.registers,
            area.block_rams,
            area.multipliers
        ));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthesis::{Area, Family, Kind, Mapped, Measured};
    use std::collections::BTreeMap;

    #[test]
    fn only_the_very_verilog_that_was_measured_has_a_table() {
        let area = Area { luts: 4373, registers: 3544, block_rams: 57, ..Area::default() };
        let results = vec![Mapped {
            family: Family::ALL[0],
            area,
            accepted: area,
            speed: Speed::DoesNotFit("57 of 56 block RAMs".to_owned()),
        }];
        let measured = Measured {
            name: "vuris".to_owned(),
            purpose: String::new(),
            kind: Kind::Pipeline,
            digest: "abc".to_owned(),
            latency_clocks: None,
            clocks_per_sample: None,
            accuracy: None,
            results,
        };
        let baseline = Baseline {
            note: String::new(),
            format: String::new(),
            tools: BTreeMap::new(),
            target_mhz: 1,
            seeds: vec![1],
            targets: vec![measured],
        };
        let lines = resources(&baseline, "vuris", "abc");
        assert_eq!(lines.len(), 3);
        assert!(
            lines[2].contains("| 4373 | 3544 | 57 | 0 | does not fit: 57 of 56 block RAMs |"),
            "{lines:?}"
        );
        assert!(resources(&baseline, "vuris", "abd").is_empty());
        assert!(resources(&baseline, "other", "abc").is_empty());
    }
}
