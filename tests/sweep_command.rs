//! `vuris sweep` as a user meets it: files, shards, a run that was killed, and what it recommends.

use assert_cmd::cargo::{cargo_bin, cargo_bin_cmd};
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};
use vuris::spec::{AngleUnit, Architecture, Design, Pipeline, Rounding};
use vuris::sweep::{AreaModel, Configuration, throughput_named};

const GRID: &[&str] = &[
    "sweep",
    "--word",
    "8,13",
    "--phase-bits",
    "10-12",
    "--iterations",
    "11,12",
    "--vector-guard-bits",
    "2",
    "--angle-guard-bits",
    "3",
    "--samples",
    "2000",
    "--cycles-per-pixel",
    "1,iterative",
];

fn output(home: &Path, arguments: &[&str], more: &[&str]) -> Output {
    cargo_bin_cmd!("vuris").current_dir(home).args(arguments).args(more).output().unwrap()
}

/// Standard output of a run that succeeds and is silent otherwise.
fn run(home: &Path, arguments: &[&str], more: &[&str]) -> String {
    let output = output(home, arguments, more);
    assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{more:?}");
    assert_eq!(output.status.code(), Some(0), "{more:?}");
    String::from_utf8(output.stdout).unwrap()
}

/// The error of a run that does not.
fn refusal(home: &Path, arguments: &[&str], more: &[&str]) -> String {
    let output = output(home, arguments, more);
    assert_eq!(output.status.code(), Some(2), "{arguments:?} {more:?}");
    String::from_utf8(output.stderr).unwrap()
}

fn home() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

/// The three files of a sweep.
fn files(folder: &Path) -> [Vec<u8>; 3] {
    ["sweep.csv", "sweep.parquet", "sweep.svg"].map(|name| fs::read(folder.join(name)).unwrap())
}

/// Everything but the times of a run's output.
fn results(text: &str) -> String {
    text.lines().filter(|line| line.starts_with('|')).collect::<Vec<_>>().join("\n")
}

#[test]
fn one_configuration_is_shown_octave_by_octave() {
    let home = home();
    let text = run(home.path(), &["sweep", "--word", "10", "--phase-bits", "10", "--iterations", "12"], &[]);
    assert!(text.contains("every vector") && text.contains("fitted model"), "{text}");
    assert_eq!(text.lines().filter(|line| line.starts_with("| ")).count(), 1 + 1 + 10, "{text}");
    assert!(text.contains("| 256 to 512 "), "{text}");
    assert!(text.contains("1048575 vectors in "), "{text}");
    assert_eq!(fs::read_dir(home.path()).unwrap().count(), 0, "nothing is written without --out");
}

#[test]
fn shards_and_any_number_of_threads_give_the_files_of_one_run() {
    let home = home();
    let text = run(home.path(), GRID, &["--out", "whole"]);
    let whole = files(&home.path().join("whole"));
    for shard in ["2/3", "1/3"] {
        run(home.path(), GRID, &["--out", "parts", "--shard", shard]);
    }
    let problem = refusal(home.path(), GRID, &["--out", "parts", "--merge"]);
    assert!(problem.contains("shard 3/3 is missing") && problem.contains("way out"), "{problem}");
    // The last one is made elsewhere, by one thread.
    let single = cargo_bin_cmd!("vuris")
        .current_dir(home.path())
        .env("RAYON_NUM_THREADS", "1")
        .args(GRID)
        .args(["--out", "elsewhere", "--shard", "3/3"])
        .output()
        .unwrap();
    assert!(single.status.success());
    let journal = "sweep-3-of-3.journal";
    fs::copy(home.path().join("elsewhere").join(journal), home.path().join("parts").join(journal)).unwrap();
    let merged = run(home.path(), GRID, &["--out", "parts", "--merge"]);
    assert_eq!(results(&merged), results(&text));
    assert!(files(&home.path().join("parts")) == whole, "merged files differ");
    // A shard of another sweep is no shard of this one.
    let other: Vec<&str> =
        GRID.iter().map(|&argument| if argument == "2000" { "2001" } else { argument }).collect();
    let other = refusal(home.path(), &other, &["--out", "parts", "--merge"]);
    assert!(other.contains("missing"), "{other}");
}

#[test]
fn a_killed_run_goes_on_where_it_was() {
    let home = home();
    let long: Vec<&str> =
        GRID.iter().map(|&argument| if argument == "2000" { "300000" } else { argument }).collect();
    run(home.path(), &long, &["--out", "whole"]);
    let journal = home.path().join("killed/sweep-1-of-1.journal");
    let records = || fs::read_to_string(&journal).map_or(0, |text| text.lines().count().saturating_sub(1));
    let mut child = Command::new(cargo_bin!("vuris"))
        .current_dir(home.path())
        .args(&long)
        .args(["--out", "killed"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let start = Instant::now();
    while records() < 3 && start.elapsed() < Duration::from_secs(300) {
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let kept = records();
    assert!((3..24).contains(&kept), "{kept} of 24 configurations were done when it was killed");
    assert!(!home.path().join("killed/sweep.csv").exists());
    // What a kill in the middle of a write leaves: half a line.
    let line = fs::read_to_string(&journal).unwrap().lines().last().unwrap().to_owned();
    let mut file = fs::OpenOptions::new().append(true).open(&journal).unwrap();
    file.write_all(&line.as_bytes()[..line.len() / 2]).unwrap();
    drop(file);
    let text = run(home.path(), &long, &["--out", "killed"]);
    assert!(text.contains(&format!("{kept} configurations taken from the journal")), "{text}");
    assert!(files(&home.path().join("killed")) == files(&home.path().join("whole")), "files differ");
    assert_eq!(records(), 24);
    let again = run(home.path(), &long, &["--out", "killed"]);
    assert!(again.contains("24 configurations taken") && !again.contains("vectors in"), "{again}");
}

/// A record that was changed, or that another unit made, is not believed.
#[test]
fn a_damaged_record_is_made_anew() {
    let home = home();
    run(home.path(), GRID, &["--out", "sweep"]);
    let path = home.path().join("sweep");
    let whole = files(&path);
    let journal = path.join("sweep-1-of-1.journal");
    let text = fs::read_to_string(&journal).unwrap();
    let place = text.find("\te3 ").unwrap() + 4;
    let digit = if &text[place..=place] == "9" { "8" } else { "9" };
    fs::write(&journal, format!("{}{digit}{}", &text[..place], &text[place + 1..])).unwrap();
    let again = run(home.path(), GRID, &["--out", "sweep"]);
    assert!(again.contains("23 configurations taken"), "{again}");
    assert!(files(&path) == whole);
}

#[test]
fn files_of_others_stay() {
    let home = home();
    fs::create_dir(home.path().join("mine")).unwrap();
    fs::write(home.path().join("mine/sweep.csv"), "mine").unwrap();
    let problem = refusal(home.path(), GRID, &["--out", "mine"]);
    assert!(problem.contains("mine/sweep.csv") && problem.contains("choose another folder"), "{problem}");
    assert_eq!(fs::read_to_string(home.path().join("mine/sweep.csv")).unwrap(), "mine");
    assert_eq!(fs::read_dir(home.path().join("mine")).unwrap().count(), 1);
    fs::create_dir(home.path().join("other")).unwrap();
    fs::write(home.path().join("other/sweep-1-of-1.journal"), "a diary\n").unwrap();
    let problem = refusal(home.path(), GRID, &["--out", "other"]);
    assert!(problem.contains("is no journal"), "{problem}");
    assert_eq!(fs::read_to_string(home.path().join("other/sweep-1-of-1.journal")).unwrap(), "a diary\n");
}

#[test]
fn what_cannot_be_done_is_refused_with_the_way_out() {
    let home = home();
    for (arguments, says) in [
        (&["--word", "31"][..], "x bits = 31"),
        (&["--word", "x"], "8,10-14"),
        (&["--word", "8", "--iterations", "99"], "cordic.iterations = 99"),
        (&["--word", "20", "--exhaustive"], "at most 32"),
        (&["--word", "8", "--cycles-per-pixel", "often"], "1,4,iterative"),
        (&["--shard", "0/2", "--out", "x"], "1 <= i <= n"),
        (&["--shard", "1/2"], "--out"),
        (&["--error", "1mrad"], "--recommend"),
        (&["--recommend"], "nothing is asked"),
        (&["--recommend", "--error", "1parsec"], "0.1mrad"),
        (&["--recommend", "--error", "1e-12mrad"], "ask for less"),
        (&["--recommend", "--add-noise=-1%"], "0.0001% to 100%"),
        (&["--recommend", "--add-noise=1%", "--amplitude-dn=0"], "amplitude 0 DN"),
        (&["--fit-area", "nowhere.csv"], "nowhere.csv"),
        (&["--out", "x", "--merge"], "all shards are missing"),
    ] {
        let problem = refusal(home.path(), &["sweep"], arguments);
        assert!(problem.contains(says), "{arguments:?}: {problem}");
    }
}

/// The specification's iterations are those of its own phase: another phase has its own.
#[test]
fn words_and_phases_are_swept_without_a_word_about_iterations() {
    let home = home();
    let text = run(home.path(), &["sweep", "--word", "12", "--phase-bits", "12", "--samples", "100"], &[]);
    assert!(text.contains("p12") && text.contains("i13"), "{text}");
    let own = run(home.path(), &["sweep", "--samples", "100"], &[]);
    assert!(own.contains("p18") && own.contains("i19"), "{own}");
}

/// The value behind `name = ` in a specification.
fn field(toml: &str, name: &str) -> u32 {
    let line = toml.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(" = ")).unwrap();
    line.parse().unwrap()
}

/// What is recommended is a specification, and its angle unit holds what was asked by its proved bound.
#[test]
fn a_recommendation_is_a_specification_that_holds_what_was_asked() {
    let home = home();
    let arguments = ["sweep", "--recommend", "--samples", "3000", "--spec", "vuris-four-frame"];
    let toml = run(home.path(), &arguments, &["--error", "1mrad"]);
    fs::write(home.path().join("small.toml"), &toml).unwrap();
    run(home.path(), &["generate", "--spec", "small.toml", "--out", "hardware"], &[]);
    let pipeline = Pipeline::parse("small.toml", &toml).unwrap();
    assert!(pipeline.derived().angle.budget().phase_rad() <= 1e-3);
    assert!(toml.contains("by the bound that is proved for every vector"), "{toml}");
    assert!(toml.contains("fitted model, extrapolated"), "the unit gives a length: {toml}");

    let relaxed = run(home.path(), &arguments, &["--error", "1mrad", "--sampled"]);
    assert!(relaxed.contains("3000 drawn in each octave") && relaxed.contains("not proved"), "{relaxed}");
    assert!(field(&relaxed, "phase_bits") <= field(&toml, "phase_bits"));
    let exact = run(home.path(), &arguments, &["--error", "0.2mrad"]);
    assert!(field(&exact, "phase_bits") > field(&toml, "phase_bits"));

    // A weaker pixel has more noise of its own: less will do.
    let noise = |amplitude: &str| {
        let toml = run(home.path(), &arguments, &["--add-noise", "1%", "--amplitude-dn", amplitude]);
        Pipeline::parse("noise.toml", &toml).unwrap();
        let added = toml.split("Added noise ").nth(1).unwrap().split(' ').next().unwrap();
        assert!(added.parse::<f64>().unwrap() <= 1.0, "{toml}");
        field(&toml, "phase_bits")
    };
    assert!(noise("20") < noise("2000"));
}

/// An angle unit by itself is recommended like a camera's; it has no noise of its own.
#[test]
fn an_angle_unit_by_itself_can_be_recommended() {
    let home = home();
    let arguments = ["sweep", "--recommend", "--samples", "2000", "--spec", "angle-16"];
    let toml = run(home.path(), &arguments, &["--error", "2mm", "--frequency-hz", "100e6"]);
    fs::write(home.path().join("unit.toml"), &toml).unwrap();
    run(home.path(), &["generate", "--spec", "unit.toml", "--out", "hardware"], &[]);
    let unit: AngleUnit = match Design::named(home.path().join("unit.toml").to_str().unwrap()).unwrap() {
        Design::Angle(core) => core.unit,
        Design::Pipeline(_) => panic!("a camera"),
    };
    // c / (2 f) = 1.499 m a turn.
    let limit_rad = 2e-3 / (299_792_458.0 / 200e6) * std::f64::consts::TAU;
    assert!(unit.budget().phase_rad() <= limit_rad && unit.budget().phase_rad() > limit_rad / 4.0);
    let problem = refusal(home.path(), &arguments, &["--add-noise", "1%"]);
    assert!(problem.contains("angle unit by itself"), "{problem}");
}

/// The area model is no further off the synthesised points than its documentation says.
#[test]
fn the_area_model_is_near_the_synthesised_points() {
    let points = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/area-points.csv");
    let mut reader = csv::Reader::from_path(points).unwrap();
    let header = reader.headers().unwrap().clone();
    let mut counts = [0; 3];
    for record in reader.records() {
        let record = record.unwrap();
        let text = |name| &record[header.iter().position(|column| column == name).unwrap()];
        let number = |name| text(name).parse::<u32>().unwrap();
        let configuration = Configuration {
            metric: number("metric").into(),
            x_bits: number("x_bits"),
            y_bits: number("y_bits"),
            phase_bits: number("phase_bits"),
            length_bits: number("length_bits"),
            iterations: number("iterations"),
            vector_guard_bits: number("vector_guard_bits"),
            angle_guard_bits: number("angle_guard_bits"),
            throughput: throughput_named(text("cycles_per_pixel")).unwrap(),
            pipeline_every: number("pipeline_every"),
            normaliser: text("normaliser") == "yes",
            rounding: Rounding::Nearest,
        };
        let unit = configuration.unit().unwrap();
        let (kind, percent) = match unit.architecture {
            Architecture::Unrolled => (0, 3.0),
            Architecture::Folded { .. } => (1, 5.0),
            Architecture::Iterative => (2, 12.0),
            Architecture::Tables => panic!("no CORDIC"),
        };
        counts[kind] += 1;
        let (model, real) =
            (AreaModel::of(unit.architecture).area(&unit).luts, f64::from(number("area_luts")));
        assert!(
            (model / real - 1.0).abs() < percent / 100.0,
            "{configuration}: {model:.0}, synthesised {real}"
        );
    }
    assert_eq!(counts, [19; 3]);
}

/// Synthesised areas are near the model's, say so in every output, and do for a fit.
#[test]
fn areas_are_synthesised_where_asked() {
    let home = home();
    let grid = ["sweep", "--word=8", "--phase-bits=8", "--iterations=8,9", "--cycles-per-pixel=1"];
    let fitted = run(home.path(), &grid, &["--out", "fitted"]);
    // Debian's Yosys, which every machine that runs these tests has, and a cache of this test's own.
    let output = cargo_bin_cmd!("vuris")
        .current_dir(home.path())
        .env("VURIS_YOSYS", "yosys")
        .env("XDG_CACHE_HOME", home.path().join("cache"))
        .args(grid)
        .args(["--out", "synthesised", "--synthesise"])
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let synthesised = String::from_utf8(output.stdout).unwrap();
    assert!(
        fitted.contains("LUTs (fitted model)") && synthesised.contains("LUTs (synthesised)"),
        "{synthesised}"
    );
    let areas = |folder: &str| -> Vec<f64> {
        let mut reader = csv::Reader::from_path(home.path().join(folder).join("sweep.csv")).unwrap();
        let header = reader.headers().unwrap().clone();
        let place = |name| header.iter().position(|column| column == name).unwrap();
        let (area, octave, source) = (place("area_luts"), place("octave"), place("area_source"));
        let records: Vec<_> = reader.records().map(|record| record.unwrap()).collect();
        assert!(records.iter().all(|record| record[source].starts_with(folder)));
        records.iter().filter(|r| &r[octave] == "all").map(|r| r[area].parse().unwrap()).collect()
    };
    let (model, real) = (areas("fitted"), areas("synthesised"));
    assert_eq!(model.len(), 2);
    for (model, real) in model.iter().zip(&real) {
        assert!((model / real - 1.0).abs() < 0.2 && real.fract() == 0.0, "{model} {real}");
    }
    assert!(fs::read_to_string(home.path().join("synthesised/sweep.svg")).unwrap().contains("(synthesised)"));
}

/// A file of synthesised areas made by known coefficients gives these back.
#[test]
fn the_area_model_is_fitted_to_a_sweeps_own_file() {
    let home = home();
    let grid = [
        "sweep",
        "--word=7,8,10",
        "--phase-bits=9,12",
        "--iterations=9-11",
        "--vector-guard-bits=2,4",
        "--angle-guard-bits=1,3",
        "--cycles-per-pixel=1,iterative",
    ];
    run(home.path(), &grid, &["--out", "sweep"]);
    let path = home.path().join("sweep/sweep.csv");
    let problem = refusal(home.path(), &["sweep", "--fit-area", "sweep/sweep.csv"], &[]);
    assert!(problem.contains("no synthesised"), "{problem}");
    // Both metrics: without the second one nothing tells what tripling costs.
    run(home.path(), &grid, &["--metric", "3", "--out", "tripled"]);
    let tripled = fs::read_to_string(home.path().join("tripled/sweep.csv")).unwrap();
    let tripled = tripled.split_once('\n').unwrap().1;
    let text = fs::read_to_string(&path).unwrap() + tripled;
    let text =
        text.replace("fitted model, extrapolated", "fitted model").replace("fitted model", "synthesised");
    fs::write(home.path().join("areas.csv"), text).unwrap();
    let fitted = run(home.path(), &["sweep", "--fit-area", "areas.csv"], &[]);
    assert!(fitted.contains("largest deviation 0.0 %"), "{fitted}");
}
