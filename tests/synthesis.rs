//! Can it be built? Yosys reads the core as plain Verilog and maps it to two families of FPGAs.
//!
//! Chain of trust: `cosim.rs` shows what the core does in simulation; here, that nothing in it is left to a tool's mercy (no
//! latch, no undriven or doubly driven wire) and that the sums lie in block RAM, as the memory's size needs.

mod support;

use std::collections::BTreeMap;
use std::process::Command;
use support::{accepted, small, two_at_a_time};
use vuris::artifact;
use vuris::hdl::{Source, rtl_artifacts};
use vuris::spec::{PRESETS, Pipeline};

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
        yosys(pipeline, "proc; check -assert; flatten; opt_clean; check -assert; memory -nomap")
    });
    for (pipeline, cells) in pipelines.iter().zip(&cells) {
        let latches: Vec<_> = cells.keys().filter(|cell| cell.contains("latch")).collect();
        assert!(latches.is_empty(), "{latches:?}\n{}", pipeline.to_toml());
        // The sums, and no other memory.
        assert_eq!(cells.get("$mem_v2"), Some(&1), "{cells:?}\n{}", pipeline.to_toml());
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
    // 768 pixels of 16 + 15 + 16 bits and a flag: three words of 16, four of 12 or six of 8 bits, of 256, 512 or more.
    assert_eq!(pipeline.derived().memory_word_bits, 48);
    assert_eq!(cells.get("SB_RAM40_4K"), Some(&9));
    let registers: usize =
        cells.iter().filter(|(cell, _)| cell.starts_with("SB_DFF")).map(|(_, count)| count).sum();
    assert!(registers < 6000, "{registers} registers");
}
