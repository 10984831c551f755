//! A placed and routed design: what nextpnr reports.

use super::wrapper::WRAPPER;
use crate::problem::{Problem, Result};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A design inside its wrapper, placed and routed with one seed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Routed {
    /// The seed of the placement.
    pub seed: u32,
    /// The highest clock frequency at which every path from register to register holds, MHz.
    pub fmax_mhz: f64,
    /// The registers at either end of the path that sets it.
    pub path: String,
}

/// What became of one seed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Routing {
    /// It was placed and routed.
    Routed(Routed),
    /// The part is too small: why.
    DoesNotFit(String),
}

#[derive(Deserialize)]
struct Report {
    fmax: BTreeMap<String, Frequency>,
    critical_paths: Vec<Path>,
}

#[derive(Deserialize)]
struct Frequency {
    achieved: f64,
}

#[derive(Deserialize)]
struct Path {
    from: String,
    to: String,
    path: Vec<Segment>,
}

#[derive(Deserialize)]
struct Segment {
    from: End,
    to: End,
}

#[derive(Deserialize)]
struct End {
    cell: String,
}

/// The register that a cell of the netlist is, without what the synthesis appended to its name.
fn register(cell: &str) -> String {
    let cell = cell.strip_prefix("u_design.").unwrap_or(cell);
    let end = ["_TRELLIS_FF", "_SB_DFF", "_SB_LUT4", "_LUT4", "_CCU2C", "_SB_CARRY"]
        .iter()
        .filter_map(|kind| cell.find(kind))
        .min()
        .unwrap_or(cell.len());
    cell[..end].to_owned()
}

impl Routed {
    /// Reads the report that nextpnr wrote with `--report`.
    pub fn parse(report: &str, seed: u32) -> Result<Self> {
        let unreadable = |found: String| {
            Problem::at("nextpnr", found)
                .expected("a report of one clock, with its highest frequency and its longest path")
                .remedy("use the nextpnr of `bash scripts/hdl-tools.sh synth`")
        };
        let report: Report = serde_json::from_str(report)
            .map_err(|error| unreadable(format!("its report cannot be read: {error}")))?;
        let slowest = report.fmax.values().map(|clock| clock.achieved).min_by(f64::total_cmp);
        let Some(fmax_mhz) = slowest.filter(|_| report.fmax.len() == 1) else {
            return Err(unreadable(format!("{WRAPPER} has {} clocks in its report", report.fmax.len())));
        };
        let path = report
            .critical_paths
            .iter()
            .find(|path| path.from == path.to && path.from.starts_with("posedge"))
            .and_then(|path| Some((path.path.first()?, path.path.last()?)))
            .map(|(first, last)| format!("{} to {}", register(&first.from.cell), register(&last.to.cell)))
            .ok_or_else(|| unreadable("its report has no path from register to register".to_owned()))?;
        Ok(Self { seed, fmax_mhz: (100.0 * fmax_mhz).round() / 100.0, path })
    }
}

/// Where nextpnr has failed and `said` why: that the part is too small, in its words; `None` for any other reason.
pub(super) fn does_not_fit(said: &str) -> Option<String> {
    const SIGNS: &[&str] = &[
        "no BELs remaining",
        "Unable to find legal placement",
        "Failed to expand region",
        "Unable to place",
    ];
    said.lines()
        .filter(|line| line.starts_with("ERROR"))
        .find(|line| SIGNS.iter().any(|sign| line.contains(sign)))
        .map(|line| line.trim_start_matches("ERROR:").trim().to_owned())
}

/// The median of frequencies, and the least and the largest: with an even number of them the higher of the middle ones.
pub fn median_and_range(frequencies_mhz: &[f64]) -> Option<(f64, f64, f64)> {
    let mut sorted = frequencies_mhz.to_vec();
    sorted.sort_by(f64::total_cmp);
    Some((*sorted.get(sorted.len() / 2)?, *sorted.first()?, *sorted.last()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of nextpnr-ecp5 0.11.1, shortened.
    const REPORT: &str = r#"{ "critical_paths": [
        { "from": "<async>", "to": "posedge $glbnet$clk$TRELLIS_IO_IN", "path": [
            { "delay": 0.0, "from": { "cell": "si" }, "to": { "cell": "inputs_TRELLIS_FF_Q" }, "type": "routing" } ] },
        { "from": "posedge $glbnet$clk$TRELLIS_IO_IN", "to": "posedge $glbnet$clk$TRELLIS_IO_IN", "path": [
            { "delay": 0.525, "from": { "cell": "u_design.u_iteration_18.negative_TRELLIS_FF_Q", "loc": [69, 8], "port": "Q" },
              "to": { "cell": "u_design.u_iteration_18.negative_TRELLIS_FF_Q", "loc": [69, 8], "port": "Q" }, "type": "clk-to-q" },
            { "delay": 0, "from": { "cell": "u_design.angle_18_TRELLIS_FF_Q_22", "loc": [67, 18], "port": "DI" },
              "to": { "cell": "u_design.angle_18_TRELLIS_FF_Q_22", "loc": [67, 18], "port": "DI" }, "type": "setup" } ] } ],
        "fmax": { "$glbnet$clk$TRELLIS_IO_IN": { "achieved": 186.49757385253906, "constraint": 400 } },
        "utilization": { "TRELLIS_COMB": { "available": 24288, "used": 2251 } } }"#;

    #[test]
    fn frequency_and_path_are_read() {
        let routed = Routed::parse(REPORT, 3).unwrap();
        let path = "u_iteration_18.negative to angle_18".to_owned();
        assert_eq!(routed, Routed { seed: 3, fmax_mhz: 186.5, path });
    }

    #[test]
    fn a_report_of_no_clock_of_two_or_without_a_path_is_an_error() {
        let none = REPORT.replace(
            r#""$glbnet$clk$TRELLIS_IO_IN": { "achieved": 186.49757385253906, "constraint": 400 }"#,
            "",
        );
        let two = REPORT.replace(r#""fmax": {"#, r#""fmax": { "other": { "achieved": 1.0 },"#);
        let no_path = REPORT.replace(r#""from": "posedge"#, r#""from": "negedge"#);
        for broken in [&none, &two, &no_path, ""] {
            assert_ne!(broken, REPORT);
            assert!(Routed::parse(broken, 1).is_err(), "{broken}");
        }
    }

    #[test]
    fn a_part_that_is_too_small_is_told_from_other_failures() {
        // What nextpnr-ecp5 0.11.1 and nextpnr-ice40 0.4 print.
        let ecp5 = "Info: Packing\nERROR: Unable to place cell 'u_sum_memory.memory.0.0', no BELs remaining to implement \
                    cell type 'DP16KD'\n0 warnings, 1 error\n";
        let reason = does_not_fit(ecp5).unwrap();
        assert!(reason.starts_with("Unable to place cell 'u_sum_memory") && reason.ends_with("'DP16KD'"));
        assert_eq!(does_not_fit("ERROR: Failed to open 'netlist.json'\n"), None);
        assert_eq!(does_not_fit("Warning: no BELs remaining\n"), None);
    }

    #[test]
    fn the_median_of_an_even_number_is_the_higher_middle() {
        assert_eq!(median_and_range(&[3.0, 1.0, 2.0]), Some((2.0, 1.0, 3.0)));
        assert_eq!(median_and_range(&[4.0, 1.0, 2.0, 3.0]), Some((3.0, 1.0, 4.0)));
        assert_eq!(median_and_range(&[]), None);
    }
}
