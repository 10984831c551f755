//! The table's rows of integers as hardware: the generator takes them all, and some are co-simulated, bit by bit.

mod support;

use assert_cmd::cargo::cargo_bin_cmd;
use std::path::Path;
use support::{everything, small, two_at_a_time};
use vuris::algorithms::{Request, design, table, usual_steps};
use vuris::cosim::{Simulation, Simulator, Traffic, standard};
use vuris::hdl::{Golden, Source, all_artifacts};
use vuris::spec::{Pipeline, Scheme};

fn pipeline(scheme: &Scheme) -> Pipeline {
    small("vuris", |specification| {
        (specification.sensor.width, specification.sensor.height) = (6, 3);
        specification.modulation.scheme = scheme.clone();
    })
}

fn designed() -> Scheme {
    let request = Request {
        reject: vec![2, 3, 4],
        motion: 1,
        harmonics_in_motion: false,
        drift: true,
        frames: 9,
        growth_bits: 8,
        steps: usual_steps(),
    };
    design(&request).unwrap().swap_remove(0).scheme
}

#[test]
fn the_generator_takes_every_row_of_integers() {
    let mut rows: Vec<Scheme> = table().unwrap().into_iter().filter_map(|row| row.scheme).collect();
    rows.push(designed());
    assert!(rows.len() > 70);
    for scheme in &rows {
        let pipeline = pipeline(scheme);
        assert_eq!(Pipeline::parse("again", &pipeline.to_toml()).unwrap(), pipeline, "{}", scheme.name);
        let golden = Golden::new(&pipeline, &standard(&pipeline, 1));
        let files = all_artifacts(&Source { pipeline: &pipeline, spec: "test" }, &golden);
        assert!(files.iter().any(|file| file.path.ends_with(".v")), "{}", scheme.name);
    }
}

#[test]
fn rows_of_the_table_and_a_designed_one_agree_in_verilator() {
    let of = |name: &str| vuris::algorithms::named(name).unwrap().unwrap().scheme.unwrap();
    let names = [
        "dft-3",
        "dft-6",
        "wdft-4",
        "wdft-6",
        "n-plus-1-b-6",
        "n-plus-3-3",
        "n-plus-3-4",
        "n-plus-3-6",
        "thirteen-frame",
    ];
    let rows: Vec<Scheme> = names.into_iter().map(of).chain([designed()]).collect();
    let values = two_at_a_time(&rows, |scheme| {
        let pipeline = pipeline(scheme);
        let golden = Golden::new(&pipeline, &everything(&pipeline, 11));
        let folder = tempfile::tempdir().unwrap();
        let source = Source { pipeline: &pipeline, spec: "test" };
        let simulation =
            Simulation::build(source, &golden, Simulator::Verilator, folder.path(), &|_| {}).unwrap();
        let outcome = simulation.run(Traffic::profiles(3)[0]).unwrap();
        let findings: Vec<String> = outcome.findings.iter().map(ToString::to_string).collect();
        assert_eq!(outcome.mismatches, 0, "{}: {findings:#?}", scheme.name);
        outcome.values
    });
    assert!(values.iter().all(|&values| values > 1000), "{values:?}");
}

// ---------------------------------------------------------------- the command

fn run(folder: &Path, arguments: &[&str], code: i32) -> String {
    let output = cargo_bin_cmd!("vuris").current_dir(folder).args(arguments).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {text}");
    text.into_owned()
}

#[test]
fn the_table_has_every_row_and_the_curves_are_written_and_written_anew() {
    let folder = tempfile::tempdir().unwrap();
    let text = run(folder.path(), &["algorithms"], 0);
    for name in [
        "four_frame",
        "wdft",
        "wdft-4",
        "hariharan",
        "n-plus-1-b-3",
        "n-plus-3-4",
        "carre",
        "novak",
        "dft-5",
        "dft-64",
    ] {
        assert!(
            text.lines().any(|line| line.starts_with(&format!("| {name} "))),
            "{name} is missing in\n{text}"
        );
    }
    assert!(!text.contains("biased"), "{text}");
    for _ in 0..2 {
        run(folder.path(), &["algorithms", "show", "wdft", "--out", "curves"], 0);
    }
    let csv = std::fs::read_to_string(folder.path().join("curves/algorithm-wdft.csv")).unwrap();
    assert!(csv.contains("\nwdft,harmonic,"), "{csv}");
    let svg = std::fs::read_to_string(folder.path().join("curves/algorithm-wdft.svg")).unwrap();
    assert!(svg.contains("</svg>") && !svg.contains("NaN"));
    let json: serde_json::Value =
        serde_json::from_str(&run(folder.path(), &["algorithms", "--json"], 0)).unwrap();
    assert!(json["algorithms"].as_array().unwrap().len() > 70);
    assert_eq!(json["algorithms"][1]["verdict"]["step_order"], 2);
}

#[test]
fn a_row_that_is_shown_as_a_specification_is_generated_and_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let toml = run(folder.path(), &["algorithms", "show", "hariharan", "--toml"], 0);
    std::fs::write(folder.path().join("own.toml"), toml).unwrap();
    run(folder.path(), &["generate", "--spec", "own.toml", "--out", "core"], 0);
    let text = run(folder.path(), &["algorithms", "show", "own.toml"], 0);
    for line in [
        "rule 1: insensitive to harmonics 2, 4, 6, 8, 10, 12",
        "no swing up to its power 1",
        "0, 2 once; -1 twice",
    ] {
        assert!(text.contains(line), "{line} is not in\n{text}");
    }
    // A file with nothing but the row; here with unequal steps.
    std::fs::write(
        folder.path().join("row.toml"),
        "[modulation.scheme]\nname = \"mine\"\nstep_turns = [\"0\", \"1/4\", \"1/2\"]\nin_phase = [1, 0, -1]\nquadrature = [-1, 2, -1]\n",
    )
    .unwrap();
    let text = run(folder.path(), &["algorithms", "show", "row.toml"], 0);
    assert!(text.contains("mine") && text.contains("swings with its first power"), "{text}");
    let text = run(folder.path(), &["algorithms", "show", "novak", "--toml"], 2);
    assert!(text.contains("not linear") && text.contains("way out"), "{text}");
    let text = run(folder.path(), &["algorithms", "show", "missing"], 2);
    assert!(text.contains("hariharan") && text.contains("way out"), "{text}");
}

#[test]
fn a_design_is_printed_generated_and_refused() {
    let folder = tempfile::tempdir().unwrap();
    let asked = ["algorithms", "design", "--reject", "3", "--tolerate", "motion,harmonics", "--frames", "5"];
    let text = run(folder.path(), &asked, 0);
    assert!(text.contains("[2, -2, -3, 4, -1], sqrt(3) [0, 2, -3, 0, 1]"), "{text}");
    let toml = run(folder.path(), &[&asked[..], &["--step", "1/3", "--toml"]].concat(), 0);
    assert_eq!(Pipeline::parse("design", &toml).unwrap().modulation.scheme.steps(), 5);
    let text =
        run(folder.path(), &["algorithms", "design", "--reject", "3", "--frames", "9", "--step", "1/4"], 2);
    assert!(text.contains("looks like the fundamental") && text.contains("way out"), "{text}");
    let text = run(folder.path(), &["algorithms", "design", "--frames", "9", "--step", "x"], 2);
    assert!(text.contains("--step x"), "{text}");
    let text = run(folder.path(), &["algorithms", "--frequency-hz", "0"], 2);
    assert!(text.contains("--frequency-hz 0"), "{text}");
}

/// Every line that the notes show below a command is one that it prints.
#[test]
fn the_notes_show_what_the_commands_print() {
    let notes = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/algorithms.md")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let mut commands = 0;
    for block in notes.split("```console\n").skip(1) {
        let mut lines = block.split("\n```").next().unwrap().lines();
        let command = lines.next().unwrap().strip_prefix("$ vuris ").unwrap();
        let arguments: Vec<&str> = command.split(' ').collect();
        let output = cargo_bin_cmd!("vuris").current_dir(folder.path()).args(&arguments).output().unwrap();
        let text = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
        for line in lines.filter(|line| *line != "…") {
            assert!(
                text.lines().any(|printed| printed == line),
                "{command} does not print\n{line}\nbut\n{text}"
            );
        }
        commands += 1;
    }
    assert!(commands >= 6, "{commands}");
}
