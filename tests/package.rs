//! Can an outside user build the core in? Every generated package file, list, script and picture is used by the tool that it
//! is for, in a folder of its own, and what is broken is refused.
//!
//! Chain of trust: `generated.rs` shows that the files are written whole; here, that FuseSoC, the simulators and Yosys take them
//! as they are. That ports, numbers and diagrams tell the truth is shown in simulation, by `cocotb.rs`.

mod support;

use std::path::Path;
use std::process::Command;
use support::{hdl_tool, said, small};
use vuris::artifact::{self, Artifact};
use vuris::cosim::{aborted_then_good, random_sets};
use vuris::hdl::{Golden, Segment, Source, all_artifacts, angle_core_artifacts, angle_stimulus};
use vuris::package::{angle_package_artifacts, package_artifacts, ports};
use vuris::spec::{ANGLE_PRESETS, AngleCore, PRESETS, Pipeline};

/// Everything that `vuris generate` writes for `pipeline`, with a set of random frames.
fn artifacts(pipeline: &Pipeline) -> Vec<Artifact> {
    let source = Source { pipeline, spec: "test" };
    let set = Segment::of_sets("random", &random_sets(pipeline, 1, 1));
    let mut files = all_artifacts(&source, &Golden::new(pipeline, &aborted_then_good(pipeline, set)));
    files.extend(package_artifacts(&source, &files, &[]));
    files
}

/// The files of a small sensor in a folder, after `change`.
fn changed(change: impl FnOnce(&mut Vec<Artifact>)) -> (Pipeline, tempfile::TempDir) {
    let pipeline = small("vuris", |_| {});
    let mut files = artifacts(&pipeline);
    let before = files.clone();
    change(&mut files);
    assert!(files.len() == before.len());
    let folder = tempfile::tempdir().unwrap();
    artifact::write(folder.path(), &files).unwrap();
    (pipeline, folder)
}

/// Replaces `old`, once, in the file that ends with `path`.
fn replaced(files: &mut [Artifact], path: &str, old: &str, new: &str) {
    let file = files.iter_mut().find(|file| file.path.ends_with(path)).unwrap();
    assert!(file.text.contains(old), "{path} has no {old}");
    file.text = file.text.replacen(old, new, 1);
}

fn core_name(pipeline: &Pipeline) -> String {
    format!("vuris:pipeline:{}:{}", pipeline.top(), env!("CARGO_PKG_VERSION"))
}

/// `fusesoc run` of a target.
fn fusesoc(core: &str, folder: &Path, target: &str) -> (bool, String) {
    let target = format!("--target={target}");
    said(hdl_tool("fusesoc", "fusesoc", folder).args(["--cores-root", ".", "run", &target, core]))
}

/// Changes the fifth value of a file of golden values.
fn with_another_last_digit(file: &mut Artifact) {
    let mut lines: Vec<String> = file.text.lines().map(str::to_owned).collect();
    let digit = if lines[5].ends_with('0') { "1" } else { "0" };
    let last = lines[5].len() - 1;
    lines[5].replace_range(last.., digit);
    file.text = lines.join("\n") + "\n";
}

#[test]
fn fusesoc_runs_every_target() {
    let (pipeline, folder) = changed(|_| {});
    for (target, expected) in [
        ("sim", "PASS values="),
        ("sim_verilator", "PASS values="),
        ("lint", "verilator -f"),
        ("synth", "yosys"),
    ] {
        let (success, said) = fusesoc(&core_name(&pipeline), folder.path(), target);
        assert!(success && said.contains(expected), "{target}:\n{said}");
        assert!(!said.contains("WARNING") && !said.contains("%Warning"), "{target}:\n{said}");
    }
    let netlist = folder.path().join(format!(
        "build/vuris_pipeline_{}_{}/synth/vuris_pipeline_{0}_{1}.json",
        pipeline.top(),
        env!("CARGO_PKG_VERSION")
    ));
    assert!(netlist.is_file(), "{} is not there", netlist.display());
}

/// The exit code, which is all that a build server looks at.
#[test]
fn a_wrong_value_fails_both_simulations_in_fusesoc() {
    let (pipeline, folder) = changed(|files| {
        let file = files.iter_mut().find(|file| file.path == "vectors/phase.hex").unwrap();
        with_another_last_digit(file);
    });
    for target in ["sim", "sim_verilator"] {
        let (success, said) = fusesoc(&core_name(&pipeline), folder.path(), target);
        assert!(!success && said.contains("MISMATCH channel=output.phase record=4 "), "{target}:\n{said}");
    }
}

#[test]
fn a_loose_wire_fails_the_lint_in_fusesoc() {
    let (pipeline, folder) =
        changed(|files| replaced(files, "_pipeline.v", "\nendmodule", "\nwire loose = clk_i;\nendmodule"));
    let (success, said) = fusesoc(&core_name(&pipeline), folder.path(), "lint");
    assert!(!success && said.contains("'loose'"), "{said}");
}

#[test]
fn a_missing_file_in_the_list_fails_in_fusesoc() {
    let (pipeline, folder) =
        changed(|files| replaced(files, "pipeline.core", "rtl/vuris_framing.v", "rtl/vuris_framed.v"));
    assert!(!fusesoc(&core_name(&pipeline), folder.path(), "sim").0);
}

/// An angle unit by itself has no harness for Verilator, but all the rest.
#[test]
fn fusesoc_runs_every_target_of_an_angle_unit_and_fails_where_a_value_is_wrong() {
    let preset = ANGLE_PRESETS.iter().find(|preset| preset.name == "angle-16-iterative").unwrap();
    let unit = AngleCore::parse(preset.name, preset.text).unwrap();
    let mut files = angle_core_artifacts(&unit, "test", &angle_stimulus(&unit.unit, 1)[..200]);
    files.extend(angle_package_artifacts(&unit, "test", &files));
    let folder = tempfile::tempdir().unwrap();
    artifact::write(folder.path(), &files).unwrap();
    let core = format!("vuris:angle:angle_16_iterative_angle:{}", env!("CARGO_PKG_VERSION"));
    for (target, expected) in [("sim", "PASS values=200"), ("lint", "verilator -f"), ("synth", "yosys")] {
        let (success, said) = fusesoc(&core, folder.path(), target);
        assert!(success && said.contains(expected) && !said.contains("%Warning"), "{target}:\n{said}");
    }
    let file = files.iter_mut().find(|file| file.path == "vectors/phase.hex").unwrap();
    with_another_last_digit(file);
    artifact::write(folder.path(), &files).unwrap();
    let (success, said) = fusesoc(&core, folder.path(), "sim");
    assert!(!success && said.contains("MISMATCH vector 4 "), "{said}");
}

/// What the guide says under "the same without FuseSoC" and "synthesise".
#[test]
fn the_file_lists_and_scripts_work_as_the_guide_says() {
    let (_, folder) = changed(|_| {});
    let guide = std::fs::read_to_string(folder.path().join("integration.md")).unwrap();
    for (command, expected) in [
        ("iverilog -g2005 -s testbench -f tb/icarus.f -o sim && vvp -N sim", "PASS values="),
        ("yosys -s fpga/synth_ecp5.ys", "DP16KD"),
        ("yosys -s fpga/synth_ice40.ys", "SB_RAM40_4K"),
        (
            "verilator --cc --exe --build --top-module bench_taps -f tb/verilator.f && obj_dir/Vbench_taps",
            "PASS values=",
        ),
    ] {
        let told = guide.contains(command) || !command.starts_with("iverilog");
        assert!(told, "the guide does not say {command}");
        let mut shell = Command::new("sh");
        shell
            .current_dir(folder.path())
            .env_remove("VERILATOR_ROOT")
            .env_remove("MAKEFLAGS")
            .args(["-c", command]);
        let (success, said) = said(&mut shell);
        assert!(success && said.contains(expected), "{command}:\n{said}");
        let warns = |line: &str| line.starts_with("Warning") || line.starts_with("%Warning");
        assert!(!said.lines().any(warns), "{command}:\n{said}");
    }
}

/// Python reads JSON, XML and nothing that is only nearly so.
#[test]
fn pictures_and_numbers_are_well_formed_and_the_guide_shows_each() {
    const CHECK: &str = "import json, sys, xml.etree.ElementTree as xml\n\
                         for path in sys.argv[1:]: (json.load if path.endswith('json') else xml.parse)(open(path))";
    for preset in PRESETS {
        let pipeline = Pipeline::named(preset.name).unwrap();
        // A name with everything in it that a comment, a picture or a script could trip over.
        let source = Source { pipeline: &pipeline, spec: "a--b&<c>\"'.toml" };
        let files = package_artifacts(&source, &[], &[]);
        let folder = tempfile::tempdir().unwrap();
        artifact::write(folder.path(), &files).unwrap();
        let pages: Vec<&str> =
            files.iter().map(|file| file.path.as_str()).filter(|path| path.starts_with("doc/")).collect();
        assert_eq!(pages.len(), 5, "{pages:?}");
        let mut python = Command::new("python3");
        let (success, said) = said(python.current_dir(folder.path()).args(["-c", CHECK]).args(&pages));
        assert!(success, "{said}");
        let guide = &files.iter().find(|file| file.path == "integration.md").unwrap().text;
        for picture in pages.iter().filter(|path| path.ends_with(".svg")) {
            assert!(guide.contains(&format!("]({picture})")), "{picture}");
        }
        for port in ports(&pipeline) {
            assert!(guide.contains(&format!("| `{}` |", port.name)), "{}", port.name);
        }
        // One page: what an engineer reads before building it in.
        assert!(guide.lines().count() < 120, "{} lines", guide.lines().count());
    }
}
