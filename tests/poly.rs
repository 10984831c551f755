//! The angle by tables and multipliers: its Verilog against its model, and what its specification refuses.
//!
//! That the model is right is shown beside it, in `src/model/poly.rs`: every vector of 12 bits, and vectors of every strength.

use std::process::Command;
use vuris::artifact::Artifact;
use vuris::cosim::{Simulator, Traffic, Verilator, lint, simulate_angle};
use vuris::hdl::{angle_core_artifacts, angle_stimulus};
use vuris::model::turn;
use vuris::spec::AngleCore;

fn text(x_bits: u32, y_bits: u32, phase_bits: u32, tables: &str) -> String {
    format!(
        "format = \"vuris-angle/1\"\nname = \"unit\"\natan = \"poly\"\n[vector]\nx_bits = {x_bits}\ny_bits = {y_bits}\n\
         [poly]\ntables = \"{tables}\"\n[output]\nphase_bits = {phase_bits}\n"
    )
}

/// Units of every kind: words narrower, as wide as and wider than a coordinate, and the ends of every range.
fn units() -> Vec<AngleCore> {
    let words = [(16, 16, 16), (2, 2, 8), (7, 12, 10), (18, 3, 16), (40, 33, 20), (24, 24, 13)];
    words
        .into_iter()
        .flat_map(|(x, y, phase)| ["logic", "memory"].map(|tables| text(x, y, phase, tables)))
        .map(|text| AngleCore::parse("test", &text).unwrap())
        .collect()
}

/// Values that differ when `core` is driven in `simulator` with the first `mixtures` of pauses and stops, after `fault` has
/// changed its files.
fn mismatches(
    core: &AngleCore,
    simulator: Simulator,
    mixtures: usize,
    fault: &dyn Fn(&mut Vec<Artifact>),
) -> u64 {
    let folder = tempfile::tempdir().unwrap();
    let vectors = angle_stimulus(&core.unit, 7);
    let traffics = &Traffic::profiles(7)[..mixtures];
    let outcomes = simulate_angle(core, "test", &vectors, simulator, traffics, folder.path(), fault).unwrap();
    assert_eq!(outcomes.len(), mixtures);
    assert!(outcomes.iter().all(|outcome| outcome.mismatches > 0 || outcome.values == vectors.len() as u64));
    outcomes.iter().map(|outcome| outcome.mismatches).sum()
}

#[test]
fn the_verilog_is_the_model() {
    for core in units() {
        assert_eq!(mismatches(&core, Simulator::Icarus, 1, &|_| {}), 0, "{}", core.to_toml());
    }
    for core in &units()[..2] {
        assert_eq!(mismatches(core, Simulator::Verilator, 4, &|_| {}), 0, "{}", core.to_toml());
    }
}

/// The bench's vectors reach every segment of the arctangent and nearly every factor, so that it sees their tables.
#[test]
fn the_stimulus_reaches_the_tables() {
    let core = AngleCore::parse("test", &text(16, 16, 16, "logic")).unwrap();
    let mut angles = std::collections::BTreeSet::new();
    for (x, y) in angle_stimulus(&core.unit, 7) {
        angles.insert(turn(&core.unit, x, y).phase >> 8);
    }
    assert_eq!(angles.len(), 256, "256 angles of a turn, 32 of an octant");
}

/// What the ECP5's multiplier does with all its registers in use, after Lattice's TN1267; the tools have no model of it.
fn mult18x18d() -> String {
    let bits = |name: &str, count: usize| {
        (0..count).map(|bit| format!("{name}{bit}")).collect::<Vec<_>>().join(", ")
    };
    let concatenated = |name: &str, count: usize| {
        (0..count).rev().map(|bit| format!("{name}{bit}")).collect::<Vec<_>>().join(", ")
    };
    let parameters = [
        "REG_INPUTA_CLK",
        "REG_INPUTA_CE",
        "REG_INPUTB_CLK",
        "REG_INPUTB_CE",
        "REG_PIPELINE_CLK",
        "REG_PIPELINE_CE",
        "REG_OUTPUT_CLK",
        "REG_OUTPUT_CE",
        "CLK0_DIV",
        "CLK1_DIV",
        "CLK2_DIV",
        "CLK3_DIV",
        "GSR",
        "SOURCEB_MODE",
        "RESETMODE",
        "MULT_BYPASS",
        "HIGHSPEED_CLK",
    ]
    .map(|name| format!("parameter {name} = \"NONE\""))
    .join(", ");
    format!(
        "module MULT18X18D #({parameters}) (input CLK0, CLK1, CLK2, CLK3, CE0, CE1, CE2, CE3, RST0, RST1, RST2, RST3, \
         SIGNEDA, SIGNEDB, SOURCEA, SOURCEB, {}, {}, output {});\n\
         reg [17:0] a; reg [17:0] b; reg [35:0] m; reg [35:0] p;\n\
         wire signed [18:0] wa = {{SIGNEDA & a[17], a}}; wire signed [18:0] wb = {{SIGNEDB & b[17], b}};\n\
         wire [37:0] product = wa * wb;\n\
         always @(posedge CLK0) if (CE0) begin a <= {{{}}}; b <= {{{}}}; m <= product[35:0]; p <= m; end\n\
         assign {{{}}} = p;\nendmodule\n",
        bits("A", 18),
        bits("B", 18),
        bits("P", 36),
        concatenated("A", 18),
        concatenated("B", 18),
        concatenated("P", 36)
    )
}

fn take_the_ecp5s(artifacts: &mut Vec<Artifact>, change: &dyn Fn(String) -> String) {
    let list = artifacts.iter().find(|artifact| artifact.path == "ecp5/files.f").unwrap();
    let multipliers: Vec<&str> = list.text.lines().filter(|line| line.contains("multiplier")).collect();
    assert_eq!(multipliers, ["ecp5/unit_poly_multiplier.v"]);
    let place = artifacts.iter().position(|artifact| artifact.path == "ecp5/unit_poly_multiplier.v").unwrap();
    let text = change(artifacts.remove(place).text + &mult18x18d());
    let portable =
        artifacts.iter_mut().find(|artifact| artifact.path == "rtl/unit_poly_multiplier.v").unwrap();
    assert_ne!(portable.text, text);
    portable.text = text;
}

#[test]
fn the_ecp5s_multiplier_takes_the_portable_ones_place() {
    for tables in ["logic", "memory"] {
        let core = AngleCore::parse("test", &text(16, 16, 16, tables)).unwrap();
        let same = |artifacts: &mut Vec<Artifact>| take_the_ecp5s(artifacts, &|text| text);
        assert_eq!(mismatches(&core, Simulator::Icarus, 2, &same), 0);
        for (right, wrong) in [
            ("is_signed & b_i", "1'b0 & b_i"),
            (".A17(a[17])", ".A17(1'b0)"),
            (".P30(p[30])", ".P30()"),
            ("m <= product[35:0]; p <= m", "m <= product[35:0]; p <= product[35:0]"),
        ] {
            let other = |artifacts: &mut Vec<Artifact>| {
                take_the_ecp5s(artifacts, &|text| {
                    assert!(text.contains(right), "{right}");
                    text.replace(right, wrong)
                });
            };
            assert!(mismatches(&core, Simulator::Icarus, 1, &other) > 0, "{right}");
        }
    }
}

/// Faults in every module: file, what stands there, what stands there then.
const FAULTS: [(&str, &str, &str, &str); 20] = [
    ("logic", "octant", "sum[WORD_BITS] ^ x[WORD_BITS-1]", "sum[WORD_BITS]"),
    ("logic", "octant", "== y[WORD_BITS-1]", "!= y[WORD_BITS-1]"),
    ("logic", "octant", "{major_0[0]}}", "{1'b0}}"),
    ("logic", "octant", "{minor_4[0]}}", "{1'b0}}"),
    ("logic", "octant", "[WORD_BITS-1:WORD_BITS-4] == 4'd0", "[WORD_BITS-1:WORD_BITS-3] == 3'd0"),
    ("logic", "reciprocal", "~major_i[LOW_BITS-1:0]", "major_i[LOW_BITS-1:0]"),
    ("logic", "reciprocal", "FACTOR_9[index]", "!FACTOR_9[index]"),
    ("logic", "arctangent", "BASE_4[segment]", "!BASE_4[segment]"),
    ("logic", "arctangent", "SLOPE_3[segment]", "!SLOPE_3[segment]"),
    ("logic", "arctangent", "CURVE_2[bend]", "!CURVE_2[bend]"),
    ("logic", "arctangent", "!backwards_q, curve_q", "backwards_q, curve_q"),
    ("logic", "arctangent", "start_3_q <= start_2_q", "start_3_q <= start_q"),
    ("memory", "arctangent", "{backwards_i, segment}", "{!backwards_i, segment}"),
    (
        "memory",
        "arctangent",
        "offset_q      <= offset_read_q",
        "offset_q      <= {!ratio_i[OFFSET_BITS-1], ratio_i[OFFSET_BITS-2:0]}",
    ),
    ("memory", "reciprocal", "mirrored_q      <= mirrored_read_q", "mirrored_q      <= major_i"),
    ("logic", "multiplier", "if (advance_i) begin", "begin"),
    (
        "logic",
        "angle",
        "valid_q <= {valid_q[LATENCY_CLOCKS-2:0], valid_i}",
        "valid_q <= {valid_q[LATENCY_CLOCKS-2:0], 1'b1}",
    ),
    ("logic", "angle", "if (advance) meta_q", "meta_q"),
    ("logic", "angle", "&& !angle[PHASE_BITS-2]", ""),
    ("logic", "angle", "{PHASE_BITS{present}} & ", ""),
];

#[test]
fn every_seeded_fault_is_found() {
    for (tables, noun, right, wrong) in FAULTS {
        let core = AngleCore::parse("test", &text(16, 16, 16, tables)).unwrap();
        let fault = |artifacts: &mut Vec<Artifact>| {
            let path = if noun == "angle" {
                "rtl/unit_angle.v".to_owned()
            } else {
                format!("rtl/unit_poly_{noun}.v")
            };
            let file = artifacts.iter_mut().find(|artifact| artifact.path == path).unwrap();
            assert!(file.text.contains(right), "{path}: {right}");
            file.text = file.text.replace(right, wrong);
        };
        assert!(mismatches(&core, Simulator::Icarus, 1, &fault) > 0, "{noun}: {right}");
    }
}

#[test]
fn no_tool_finds_anything_doubtful() {
    for core in units() {
        let folder = tempfile::tempdir().unwrap();
        vuris::artifact::write(folder.path(), &angle_core_artifacts(&core, "test", &[(1, 0)])).unwrap();
        for verilator in Verilator::all().unwrap() {
            let said = lint(&verilator, folder.path(), &core.top()).unwrap();
            assert!(said.is_empty(), "{said}\n{}", core.to_toml());
        }
        let list = std::fs::read_to_string(folder.path().join("rtl/files.f")).unwrap();
        let files: Vec<&str> = list.lines().filter(|line| line.ends_with(".v")).collect();
        let script = format!(
            "read_verilog {}; hierarchy -check -top {}; proc; check -assert; flatten; opt_clean; check -assert; memory -nomap; \
             select -assert-count {} t:$mem_v2; select -assert-none t:*latch*",
            files.join(" "),
            core.top(),
            if core.to_toml().contains("memory") { 2 } else { 0 }
        );
        for (tool, arguments) in [
            ("iverilog", vec!["-g2005", "-Wall", "-t", "null", "-s", "unit_angle", "-f", "rtl/files.f"]),
            ("yosys", vec!["-q", "-e", ".*", "-p", &script]),
        ] {
            let output = Command::new(tool).current_dir(folder.path()).args(arguments).output().unwrap();
            let said = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success() && said.trim().is_empty(), "{tool}: {said}\n{}", core.to_toml());
        }
    }
}

#[test]
fn what_does_not_fit_the_algorithm_is_refused() {
    let good = text(16, 16, 16, "logic");
    for (right, wrong, found, allowed) in [
        ("\"poly\"", "\"table\"", "atan = \"table\"", "\"cordic\" or \"poly\""),
        ("\"logic\"", "\"lut\"", "poly.tables = \"lut\"", "\"logic\" or \"memory\""),
        ("phase_bits = 16", "phase_bits = 21", "output.phase_bits = 21", "8 to 20"),
        ("phase_bits = 16", "phase_bits = 16\nlength_bits = 8", "output.length_bits = 8", "the phase alone"),
        ("y_bits = 16", "y_bits = 16\nmetric = 3", "vector.metric = 3", "1 where atan"),
        ("[poly]", "[cordic]\niterations = 16\n[poly]", "cordic", "no such table where atan = \"poly\""),
        ("tables", "table", "poly.table", "tables"),
    ] {
        assert!(good.contains(right));
        let said = AngleCore::parse("test.toml", &good.replace(right, wrong)).unwrap_err().to_string();
        assert!(said.starts_with("test.toml: ") && said.contains(found) && said.contains(allowed), "{said}");
    }
}
