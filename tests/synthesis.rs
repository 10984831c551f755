//! Can it be built? Yosys reads the core as plain Verilog and maps it to two families of FPGAs.
//!
//! Chain of trust: `cosim.rs` shows what the core does in simulation; here, that nothing in it is left to a tool's mercy (no
//! latch, no undriven or doubly driven wire) and that the sums lie in block RAM, as the memory's size needs. Then `vuris synth` in
//! short: what it counts, its wrapper, its gate; the measurement itself is `make synth`.

mod support;

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;
use support::{accepted, small, two_at_a_time};
use vuris::artifact::{self, Artifact};
use vuris::cosim::{IVERILOG, Tool, VVP, Verilator, find, output};
use vuris::hdl::{Source, rtl_artifacts};
use vuris::spec::{PRESETS, Pipeline};
use vuris::synthesis::{
    Accuracy, AccuracyMethod, Area, Baseline, Cache, Family, Flow, Kind, Mapped, Measured, OctaveMean,
    Program, Routed, Speed, Target, Verilog, peers, wrapper,
};

/// Runs `commands` on the core of `pipeline`, any warning an error; the number of cells of each type in the end.
fn yosys(pipeline: &Pipeline, commands: &str) -> BTreeMap<String, usize> {
    let folder = tempfile::tempdir().unwrap();
    let artifacts = rtl_artifacts(&Source { pipeline, spec: "test" });
    artifact::write(folder.path(), &artifacts).unwrap();
    let files: Vec<&str> =
        artifacts.iter().map(|file| file.path.as_str()).filter(|path| path.ends_with(".v")).collect();
    // Without -sv: Verilog-2005.
    let script = format!(
        "read_verilog {}; hierarchy -check -top {}; {commands}; tee -q -o cells stat",
        files.join(" "),
        pipeline.top()
    );
    let output = Command::new("yosys")
        .current_dir(folder.path())
        .args(["-q", "-e", ".*", "-p", &script])
        .output()
        .expect("yosys is not here: apt-get install yosys, or `make setup`");
    let said = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.trim().is_empty(), "yosys: {said}\n{}", pipeline.to_toml());
    // Of the report, the lines of two words: a cell's type and its number.
    let report = std::fs::read_to_string(folder.path().join("cells")).unwrap();
    let mut cells = BTreeMap::new();
    for line in report.lines() {
        if let [cell, number] = line.split_whitespace().collect::<Vec<_>>()[..] {
            cells.insert(cell.to_owned(), number.parse().unwrap());
        }
    }
    assert!(!cells.is_empty(), "{report}");
    cells
}

#[test]
fn yosys_finds_no_latch_and_no_loose_wire_in_cores_of_every_kind() {
    let mut pipelines = accepted(20);
    pipelines.extend(PRESETS.iter().map(|preset| Pipeline::named(preset.name).unwrap()));
    let cells = two_at_a_time(&pipelines, |pipeline| {
        yosys(pipeline, "proc; check -assert; flatten; opt_clean; check -assert")
    });
    for (pipeline, cells) in pipelines.iter().zip(&cells) {
        let latches: Vec<_> = cells.keys().filter(|cell| cell.contains("latch")).collect();
        assert!(latches.is_empty(), "{latches:?}\n{}", pipeline.to_toml());
        // The columns of the sums, the phases that wait for their partners, and no other memory that is written.
        let columns = pipeline.derived().memory_columns.len() + usize::from(pipeline.unwrapping.is_some());
        assert_eq!(cells.get("$memwr_v2"), Some(&columns), "{cells:?}\n{}", pipeline.to_toml());
    }
    println!("{} cores: {} cells", pipelines.len(), cells.iter().flat_map(BTreeMap::values).sum::<usize>());
}

/// The ECP5's block RAM has 18 Kbit; its other memory is made of look-up tables (TRELLIS_DPR16X4).
#[test]
fn the_sums_of_the_presets_lie_in_block_ram_of_an_ecp5() {
    for preset in PRESETS {
        let pipeline = Pipeline::named(preset.name).unwrap();
        let cells = yosys(&pipeline, &format!("synth_ecp5 -top {}", pipeline.top()));
        println!("{}: {cells:?}", preset.name);
        let count = |cell: &str| cells.get(cell).copied().unwrap_or(0);
        let least = pipeline.derived().memory_bits.div_ceil(18 * 1024);
        assert!((least..least * 5 / 4).contains(&count("DP16KD")), "{least} at least");
        assert_eq!(count("TRELLIS_DPR16X4"), 0);
        assert!(count("TRELLIS_FF") < 6000 && count("LUT4") < 6000 && count("MULT18X18D") < 20);
    }
}

/// The iCE40's block RAM has 4 Kbit, up to 16 bits a word, and there is no other memory.
#[test]
fn the_sums_of_a_small_sensor_lie_in_block_ram_of_an_ice40() {
    let pipeline = small("vuris", |specification| {
        (specification.sensor.width, specification.sensor.height) = (32, 24);
    });
    let cells = yosys(&pipeline, &format!("synth_ice40 -top {}", pipeline.top()));
    println!("{cells:?}");
    // 768 pixels of 14 + 14 + 12 bits and a flag: at least 31,488 bits of 4096 a block.
    assert_eq!(pipeline.derived().memory_word_bits, 41);
    assert_eq!(cells.get("SB_RAM40_4K"), Some(&9));
    let registers: usize =
        cells.iter().filter(|(cell, _)| cell.starts_with("SB_DFF")).map(|(_, count)| count).sum();
    assert!(registers < 6000, "{registers} registers");
}

// ---------------------------------------------------------------- what `vuris synth` does, in short

/// A core of one stage: registers, an adder, two outputs.
const ADDER: &str = "`default_nettype none\nmodule adder (\n  input wire clk_i,\n  input wire [3:0] a_i,\n  input wire [3:0] b_i,\n  \
     output reg [4:0] sum_o,\n  output wire parity_o\n);\n  always @(posedge clk_i) sum_o <= {1'b0, a_i} + {1'b0, b_i};\n  \
     assign parity_o = ^a_i;\nendmodule\n`default_nettype wire\n";

fn adder() -> Verilog {
    Verilog::new("adder", "clk_i", vec![Artifact::new("adder.v", ADDER)]).unwrap()
}

/// A flow of Debian's Yosys, older than the one of `make synth` and here wherever tests run; its results in `folder`.
fn debian_flow(folder: &Path) -> Flow {
    let yosys = Program::at(&find(Tool { name: "yosys", remedy: "apt-get install yosys" }).unwrap()).unwrap();
    Flow::new(yosys, Cache::new(folder))
}

#[test]
fn a_small_design_has_the_area_that_one_counts_by_hand_and_is_synthesised_once() {
    let folder = tempfile::tempdir().unwrap();
    let flow = debian_flow(folder.path());
    let area = flow.area(&adder(), Family::Ice40).unwrap();
    // A table for each of the four bits that are added, one for the parity; a carry out of each, the last of which is the fifth
    // bit of the sum itself.
    assert_eq!((area.luts, area.registers, area.carries), (5, 5, 4), "{area:?}");
    assert_eq!((area.block_rams, area.multipliers), (0, 0));
    let area = flow.area(&adder(), Family::Ecp5).unwrap();
    assert_eq!((area.luts, area.registers), (area.lut4 + 2 * area.carries, 5), "{area:?}");
    // Another text is another result; the same one is not computed again.
    let kept: Vec<_> = std::fs::read_dir(folder.path()).unwrap().collect();
    assert_eq!(kept.len(), 2, "{kept:?}");
    let other = Verilog::new("adder", "clk_i", vec![Artifact::new("adder.v", ADDER.replace("^a_i", "&a_i"))])
        .unwrap();
    flow.area(&other, Family::Ice40).unwrap();
    flow.area(&adder(), Family::Ice40).unwrap();
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 3);
    // What Yosys refuses is said and not kept.
    let broken = Verilog::new("adder", "clk_i", vec![Artifact::new("adder.v", "module adder (;")]).unwrap();
    let problem = flow.area(&broken, Family::Ice40).unwrap_err().to_string();
    assert!(problem.contains("adder.v:1: ERROR"), "{problem}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 3);
}

/// The wrapper around the preset's top module and around the adder is plain Verilog to every tool that the core is plain
/// Verilog to.
#[test]
fn the_register_wrapper_is_plain_verilog() {
    let pipeline = small("vuris", |_| {});
    let whole = Target::of_pipeline(&pipeline, "test").unwrap().verilog;
    let cache = tempfile::tempdir().unwrap();
    let flow = debian_flow(cache.path());
    for verilog in [whole, adder()] {
        let folder = tempfile::tempdir().unwrap();
        let mut files = verilog.files().to_vec();
        files.push(Artifact::new("wrapper.v", wrapper(&verilog, &flow.ports(&verilog).unwrap()).unwrap()));
        artifact::write(folder.path(), &files).unwrap();
        let names: Vec<&str> = files.iter().map(|file| file.path.as_str()).collect();
        let top = "vuris_register_wrapper";
        for verilator in Verilator::all().unwrap() {
            let mut command = verilator.command();
            command.args([
                "--lint-only",
                "-Wall",
                "--language",
                "1364-2005",
                "-Wno-DECLFILENAME",
                "--top-module",
                top,
            ]);
            let (success, said) = output(command.args(&names).current_dir(folder.path())).unwrap();
            assert!(success && !said.contains('%'), "{said}");
        }
        let mut command = Command::new(find(IVERILOG).unwrap());
        command.args(["-g2005", "-Wall", "-o", "wrapped", "-s", top]).args(&names);
        let (success, said) = output(command.current_dir(folder.path())).unwrap();
        assert!(success && said.is_empty(), "{said}");
    }
}

/// Every input bit comes from a register of its own and every output bit reaches the pin: a stream of bits through the
/// wrapped adder in Icarus against the same in integers.
#[test]
fn the_register_wrapper_lets_every_bit_through() {
    let (verilog, cache) = (adder(), tempfile::tempdir().unwrap());
    let text = wrapper(&verilog, &debian_flow(cache.path()).ports(&verilog).unwrap()).unwrap();
    const CLOCKS: usize = 400;
    // A maximal shift register of 16 bits.
    let mut state = 1_u32;
    let bits: Vec<u32> = std::iter::repeat_with(|| {
        state = state >> 1 | ((state ^ state >> 2 ^ state >> 3 ^ state >> 5) & 1) << 15;
        state & 1
    })
    .take(CLOCKS)
    .collect();
    let stream: String = bits.iter().rev().map(u32::to_string).collect();
    let bench = format!(
        "module bench;\n  reg clk = 0;\n  reg [{0}:0] bits = {CLOCKS}'b{stream};\n  wire parity;\n  integer n;\n  \
         vuris_register_wrapper dut (.clk(clk), .serial_i(bits[0]), .parity_o(parity));\n  \
         initial for (n = 0; n < {CLOCKS}; n = n + 1) begin\n    #1 clk = 1;\n    #1 $display(\"%b\", parity);\n    \
         bits = bits >> 1;\n    clk = 0;\n  end\nendmodule\n",
        CLOCKS - 1
    );
    let files =
        [Artifact::new("adder.v", ADDER), Artifact::new("wrapper.v", text), Artifact::new("bench.v", bench)];
    let printed = |files: &[Artifact]| {
        let folder = tempfile::tempdir().unwrap();
        artifact::write(folder.path(), files).unwrap();
        let mut command = Command::new(find(IVERILOG).unwrap());
        command.args(["-g2005", "-o", "wrapped", "-s", "bench", "adder.v", "wrapper.v", "bench.v"]);
        let (success, said) = output(command.current_dir(folder.path())).unwrap();
        assert!(success, "{said}");
        output(Command::new(find(VVP).unwrap()).args(["-N", "wrapped"]).current_dir(folder.path())).unwrap().1
    };
    // Ports in the order of their names: a_i in the low bits, then b_i; of the outputs parity_o, then sum_o.
    let at = |clock: usize, back: usize| bits[clock - back];
    let word = |clock: usize, low: usize| (0..4).map(|bit| at(clock, low + bit) << bit).sum::<u32>();
    // Bits after the first clock have gone through inputs, level_0 and two levels of parity; the sum through its register too.
    let expected = |clock: usize| {
        let (parity, sum) = (clock - 3, clock - 4);
        (word(parity, 0).count_ones() + (word(sum, 0) + word(sum, 4)).count_ones()) & 1
    };
    let lines = printed(&files);
    let lines: Vec<&str> = lines.lines().collect();
    assert_eq!(lines.len(), CLOCKS);
    let wrong =
        |lines: &[&str]| (20..CLOCKS).filter(|&clock| lines[clock] != expected(clock).to_string()).count();
    assert_eq!(wrong(&lines), 0);
    // Where one bit of the six is left out, the stream is another one.
    let leaking = files.clone().map(|file| {
        let text = file.text.replace("level_1[0] <= ^level_0[3:0]", "level_1[0] <= ^level_0[3:1]");
        Artifact { text, ..file }
    });
    assert_ne!(leaking, files);
    let lines = printed(&leaking);
    assert!(wrong(&lines.lines().collect::<Vec<_>>()) > CLOCKS / 4);
}

/// A measurement of one target on one family.
fn measured(area: Area, speed: Speed) -> Vec<Measured> {
    let result = Mapped { family: Family::Ecp5, area, accepted: area, speed };
    vec![Measured {
        name: "core".to_owned(),
        purpose: "a core".to_owned(),
        kind: Kind::AngleCore { input_bits: 16, phase_bits: 16, amplitude: false },
        digest: String::new(),
        latency_clocks: Some(20),
        clocks_per_sample: Some(1),
        accuracy: None,
        results: vec![result],
    }]
}

fn routed(fmax_mhz: f64) -> Speed {
    Speed::Routed(vec![Routed { seed: 1, fmax_mhz, path: "a to b".to_owned() }])
}

fn baseline(targets: Vec<Measured>) -> Baseline {
    let yosys = BTreeMap::from([("synthesis".to_owned(), "Yosys 0.70".to_owned())]);
    let (note, format) = ("Generated by `vuris synth`".to_owned(), "vuris-synthesis/1".to_owned());
    Baseline { note, format, tools: yosys, target_mhz: 400, seeds: vec![1], targets }
}

#[test]
fn the_gate_lets_five_percent_pass_and_no_more_in_either_direction() {
    let area = |luts, registers, block_rams| Area { luts, registers, block_rams, ..Area::default() };
    let old = baseline(measured(area(1000, 400, 0), routed(190.0)));
    let changes = |new: Area| -> Vec<String> {
        old.changes(&measured(new, routed(190.0))).iter().map(ToString::to_string).collect()
    };
    for passes in [area(1000, 400, 0), area(1050, 420, 0), area(950, 380, 0)] {
        assert_eq!(changes(passes), Vec::<String>::new(), "{passes:?}");
    }
    for (new, said) in [
        (area(1060, 400, 0), "core on ecp5: LUTs: old 1000, new 1060 (+6.0 %)"),
        (area(1051, 400, 0), "core on ecp5: LUTs: old 1000, new 1051 (+5.1 %)"),
        (area(940, 400, 0), "core on ecp5: LUTs: old 1000, new 940 (-6.0 %)"),
        (area(1000, 424, 0), "core on ecp5: registers: old 400, new 424 (+6.0 %)"),
        (area(1000, 400, 1), "core on ecp5: block RAMs: old 0, new 1"),
    ] {
        assert_eq!(changes(new), [said]);
    }
    assert_eq!(changes(area(1100, 500, 0)).len(), 2);
    // What does not fit any more, what is not measured any more, and what is new.
    let too_large = measured(area(1000, 400, 0), Speed::DoesNotFit("57 of 56 block RAMs".to_owned()));
    assert!(old.changes(&too_large)[0].to_string().ends_with("new does not: 57 of 56 block RAMs"));
    assert_eq!(baseline(too_large).changes(&measured(area(1000, 400, 0), routed(1.0))), []);
    assert_eq!(old.gone(&[]).len(), 1);
    assert_eq!(old.gone(&old.targets), []);
    assert_eq!(baseline(Vec::new()).changes(&old.targets), []);
}

/// Two changes of four percent are one of eight.
#[test]
fn small_changes_add_up_against_what_was_accepted() {
    let area = |luts| Area { luts, ..Area::default() };
    let first = baseline(measured(area(1000), routed(190.0)));
    let mut second = baseline(measured(area(1040), routed(190.0)));
    assert_eq!(first.changes(&second.targets), []);
    second.keep_accepted(&first);
    let third = measured(area(1080), routed(190.0));
    assert_eq!(second.changes(&third).len(), 1);
    // The file keeps what was accepted.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("synthesis.json");
    assert_eq!(Baseline::read(&path).unwrap(), None);
    std::fs::write(&path, second.to_json().unwrap()).unwrap();
    assert_eq!(Baseline::read(&path).unwrap(), Some(second));
    std::fs::write(&path, "{}").unwrap();
    assert!(Baseline::read(&path).unwrap_err().to_string().contains("synthesis.json: missing field"));
}

/// The tables in the repository are those of the measurement in the repository.
#[test]
fn the_tables_are_those_of_the_baseline() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("generated");
    let baseline = Baseline::read(&folder.join("synthesis.json")).unwrap().expect("`make synth` writes it");
    let text = std::fs::read_to_string(folder.join("synthesis.md")).unwrap();
    assert!(text == vuris::report::synthesis(&baseline), "generated/synthesis.md: `make synth` writes it");
    for target in Target::all().unwrap() {
        assert!(baseline.targets.iter().any(|measured| measured.name == target.name), "{}", target.name);
    }
}

/// Our cores stand beside the public ones, with what has been measured of them, and a dash for what has not.
#[test]
fn a_bare_core_stands_beside_the_public_ones() {
    let mut targets = measured(Area { luts: 1234, registers: 987, ..Area::default() }, routed(201.5));
    let table = vuris::report::comparison_table(&targets);
    let row = table.lines().find(|line| line.contains("**core**")).unwrap();
    for cell in ["1234", "987", "201.5", "16, 16", "0, 0"] {
        assert!(row.split('|').any(|other| other.trim() == cell), "{cell}: {row}");
    }
    assert_eq!(table.lines().count(), 3 + peers().len());
    assert!(row.trim_end().ends_with("- |"), "{row}");
    targets[0].accuracy = Some(Accuracy {
        method: AccuracyMethod::Model,
        vectors: 1 << 24,
        largest: 0.912,
        rms: 0.31,
        largest_strong: 0.8,
        largest_weak: 0.75,
        means: vec![OctaveMean { octave: 4, mean: -0.0123 }],
    });
    let text = vuris::report::synthesis(&baseline(targets));
    assert!(text.contains("0.912 / 0.800 / 0.750") && text.contains("-0.0123"), "{text}");
}

// ---------------------------------------------------------------- the command

/// Stands for Yosys and for nextpnr: `FAKE_LUTS` tables, one input of two bits, one output, 123.45 MHz. Its version names the tables, as
/// another result of one version would not be looked for.
const FAKE: &str = r#"#!/bin/sh
case "$*" in
  --version) echo "Yosys $FAKE_LUTS" ;;
  *cells.json*)
    case "$*" in *synth_ice40*) lut=SB_LUT4 ;; *) lut=LUT4 ;; esac
    echo "{\"design\": {\"num_cells_by_type\": {\"$lut\": $FAKE_LUTS}}}" > cells.json ;;
  *ports.json*)
    top=$(echo "$*" | sed 's/.*-top \([a-z0-9_]*\);.*/\1/')
    port() { echo "\"$1\": {\"direction\": \"$2\", \"bits\": [$3]}"; }
    echo "{\"modules\": {\"$top\": {\"ports\": {$(port clk_i input 2), $(port a input 3,4), $(port y output 5)}}}}" > ports.json ;;
  *netlist.json*--seed*)
    report=$(echo "$*" | sed 's/.*--report \([^ ]*\) .*/\1/')
    end='{"cell": "q_TRELLIS_FF_Q"}'
    path="{\"from\": \"posedge clk\", \"to\": \"posedge clk\", \"path\": [{\"from\": $end, \"to\": $end}]}"
    echo "{\"critical_paths\": [$path], \"fmax\": {\"clk\": {\"achieved\": 123.45}}}" > "$report" ;;
  *netlist.json*) echo {} > netlist.json ;;
  *) exit 1 ;;
esac
"#;

/// A folder to call `vuris synth` in, with a tool that gives areas of our choice.
struct Desk {
    folder: tempfile::TempDir,
}

impl Desk {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("fake"), FAKE).unwrap();
        std::fs::set_permissions(
            folder.path().join("fake"),
            std::os::unix::fs::PermissionsExt::from_mode(0o755),
        )
        .unwrap();
        Self { folder }
    }

    /// What it prints, and its exit code, where every target takes `luts` tables.
    fn synth(&self, luts: u32, arguments: &[&str]) -> (String, i32) {
        let mut command = assert_cmd::cargo::cargo_bin_cmd!("vuris");
        command
            .current_dir(self.folder.path())
            .env("FAKE_LUTS", luts.to_string())
            .env("XDG_CACHE_HOME", self.folder.path());
        for variable in ["VURIS_YOSYS", "VURIS_NEXTPNR_ECP5", "VURIS_NEXTPNR_ICE40"] {
            command.env(variable, self.folder.path().join("fake"));
        }
        let output = command.arg("synth").args(arguments).output().unwrap();
        let said = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
        (said.into_owned(), output.status.code().unwrap())
    }

    fn json(&self) -> String {
        std::fs::read_to_string(self.folder.path().join("generated/synthesis.json")).unwrap_or_default()
    }
}

#[test]
fn the_command_fails_on_six_percent_and_writes_nothing_until_it_is_accepted() {
    let desk = Desk::new();
    let (said, code) = desk.synth(1000, &["--seeds", "3"]);
    assert!(code == 0 && said.contains("no baseline to compare with") && said.contains("123.5"), "{said}");
    let first = desk.json();
    assert!(first.contains("\"luts\": 1000"), "{first}");
    // Four percent pass and are written, but are not what the next is compared with.
    let (said, code) = desk.synth(1040, &[]);
    assert!(code == 0 && said.contains("no area differs"), "{said}");
    assert!(said.contains("measured by another tool: synthesis: Yosys 1000, now Yosys 1040"), "{said}");
    let second = desk.json();
    assert!(second.contains("\"luts\": 1040") && second.contains("\"luts\": 1000"), "{second}");
    for arguments in [&[][..], &["--family", "ecp5"], &["--target", "vuris"]] {
        let (said, code) = desk.synth(1060, arguments);
        assert!(
            code == 1 && said.contains("CHANGED vuris on ecp5: LUTs: old 1000, new 1060 (+6.0 %)"),
            "{said}"
        );
        assert_eq!(desk.json(), second, "{arguments:?}");
    }
    let (said, code) = desk.synth(1060, &["--accept"]);
    assert!(code == 0, "{said}");
    assert!(!desk.json().contains("1000") && desk.json().contains("1060"));
    let (said, code) = desk.synth(1060, &["--check"]);
    assert!(code == 0 && said.contains("up to date"), "{said}");
    // Another digest, another table.
    let path = desk.folder.path().join("generated/synthesis.json");
    let stale = desk.json().replacen("\"digest\": \"", "\"digest\": \"0", 1).replace("1060", "1061");
    std::fs::write(path, stale).unwrap();
    let (said, code) = desk.synth(1060, &["--check"]);
    assert_eq!(code, 1, "{said}");
    assert!(said.contains("vuris has other Verilog than when it was measured"), "{said}");
    assert!(said.contains("stale   synthesis.md, from line"), "{said}");
}

#[test]
fn what_is_not_there_is_named() {
    let desk = Desk::new();
    for (arguments, what) in [
        (&["--target", "nobody"][..], "--target: nobody\n  expected: vuris"),
        (&["--check"], "synthesis.json: is not there"),
        (&["--top", "t", "nowhere.v"], "nowhere.v: cannot read"),
        (&["--top", "t", "fake"], "comes without a Verilog file"),
        (&["--spec", "nowhere.toml"], "nowhere.toml"),
    ] {
        let (said, code) = desk.synth(1, arguments);
        assert!(code == 2 && said.contains(what), "{arguments:?}: {said}");
    }
    std::fs::remove_file(desk.folder.path().join("fake")).unwrap();
    let (said, code) = desk.synth(1, &["--target", "vuris"]);
    assert!(code == 2 && said.contains("cannot be started") && said.contains("set VURIS_YOSYS"), "{said}");
}
