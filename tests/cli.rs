//! The commands as a user meets them: what they print, what they write, and how they end.

use assert_cmd::cargo::{cargo_bin, cargo_bin_cmd};
use npyz::NpyFile;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use vuris::recording::Recording;
use vuris::recording::matching::{SchemeChoice, pipeline_for};
use vuris::spec::{Pipeline, Word};

const CAMPAIGN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/practice-01");
/// Of the recordings in it.
const SHAPE: [u64; 3] = [102, 18, 24];

fn output(home: &Path, arguments: &[&str]) -> Output {
    cargo_bin_cmd!("vuris").current_dir(home).args(arguments).output().unwrap()
}

/// Standard output of a run that succeeds, and in which nobody sees signs of life, since there is no terminal.
fn run(home: &Path, arguments: &[&str]) -> String {
    let output = output(home, arguments);
    assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{arguments:?}");
    let stdout = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {stdout}");
    assert!(!stdout.contains(|c: char| c.is_control() && c != '\n'), "{arguments:?}: {stdout:?}");
    stdout
}

fn home() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

fn recording(name: &str) -> String {
    format!("{CAMPAIGN}/{name}")
}

/// The number behind `before` in `text`.
fn number_after(text: &str, before: &str) -> f64 {
    let rest = text.split(before).nth(1).unwrap_or_else(|| panic!("no {before:?} in\n{text}")).trim_start();
    let end = rest.find(|c: char| !"+-.0123456789e".contains(c)).unwrap_or(rest.len());
    rest[..end].parse().unwrap_or_else(|_| panic!("no number behind {before:?} in\n{text}"))
}

// ---------------------------------------------------------------- help

#[test]
fn help_names_every_command_and_every_option() {
    let commands: [(&str, &[&str]); 12] = [
        (
            "algorithms",
            &["show", "design", "--json", "--out <DIR>", "--frequency-hz <HZ>", "--frame-ms <MS>"],
        ),
        ("generate", &["--spec <FILE|PRESET>", "--out <DIR>", "--check", "default: generated"]),
        (
            "verify",
            &[
                "--spec <FILE|PRESET>",
                "--simulator <SIMULATOR>",
                "verilator",
                "icarus",
                "all",
                "--recording <DIR>",
                "--scheme <SCHEME>",
                "specified",
                "auto",
                "--sets <N>",
                "--seed <SEED>",
                "--pause <PERCENT>",
                "--stop <PERCENT>",
                "--work <DIR>",
            ],
        ),
        (
            "process",
            &["<RECORDING>", "--spec <FILE|PRESET>", "--out <DIR>", "--scheme <SCHEME>", "specified", "auto"],
        ),
        ("explain", &["--spec <FILE|PRESET>", "--toml", "vuris-four-frame"]),
        ("scene", &["--out <DIR>", "--seed <SEED>"]),
        (
            "simulate",
            &[
                "--out <DIR>",
                "--effect <NAME[:PARAMETER=VALUE,…]>",
                "--camera <camera.toml>",
                "--light <DUTY,EDGE_S,BANDWIDTH_HZ>",
                "--demodulation <DUTY,EDGE_S,BANDWIDTH_HZ>",
                "--size <WxH>",
                "--seed <SEED>",
                "--recordings <NAME>",
                "--frequency-hz <HZ>",
                "--frame-period-s <S>",
                "--frames-per-second",
            ],
        ),
        ("import", &["stack", "raw"]),
        ("atlas", &["--out <DIR>"]),
        (
            "sweep",
            &[
                "--spec <FILE|PRESET>",
                "--word <LIST>",
                "--metric <1|3>",
                "--phase-bits <LIST>",
                "--iterations <LIST>",
                "--vector-guard-bits <LIST>",
                "--angle-guard-bits <LIST>",
                "--cycles-per-pixel <LIST>",
                "--normaliser <NORMALISER>",
                "--rounding <ROUNDING>",
                "--frequency-hz <HZ>",
                "--samples <N>",
                "--exhaustive",
                "--synthesise",
                "--out <DIR>",
                "--shard <I/N>",
                "--merge",
                "--fit-area <FILE>",
                "--recommend",
                "--error <ERROR>",
                "--sampled",
                "--add-noise <SHARE>",
                "--amplitude-dn <DN>",
                "--offset-dn <DN>",
                "--gain-e-per-dn <E>",
                "--read-noise-e <E>",
            ],
        ),
        ("demo", &["--out <DIR>", "--campaign <DIR>", "default: target/demo"]),
        (
            "synth",
            &[
                "--out <DIR>",
                "--target <NAME>",
                "--family <FAMILY>",
                "ecp5",
                "ice40",
                "--seeds <N>",
                "--jobs <N>",
                "--accept",
                "--check",
                "--spec <FILE|PRESET>",
                "--top <MODULE>",
                "--clock <PORT>",
            ],
        ),
    ];
    let home = home();
    let overview = run(home.path(), &["--help"]);
    for (command, options) in commands {
        assert!(overview.contains(&format!("\n  {command} ")), "{command}:\n{overview}");
        let help = run(home.path(), &[command, "--help"]);
        assert_eq!(run(home.path(), &["help", command]), help);
        assert!(help.contains(&format!("Usage: vuris {command} ")), "{help}");
        // Lines are wrapped: what belongs together can stand on two.
        let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
        for option in options {
            assert!(help.contains(option), "{command} --help without {option}:\n{help}");
        }
        assert!(run(home.path(), &[command, "-h"]).contains("-h, --help"));
    }
    assert_eq!(run(home.path(), &["--version"]), format!("vuris {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn without_a_command_the_help_is_an_error() {
    let home = home();
    let output = output(home.path(), &[]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("Usage: vuris <COMMAND>"));
}

// ---------------------------------------------------------------- explain

/// The tables' values by quantity; those of the worst-case errors are called `error: …`.
fn explained(spec: &str) -> BTreeMap<String, String> {
    let text = run(home().path(), &["explain", "--spec", spec]);
    let mut values = BTreeMap::new();
    let mut prefix = "";
    for line in text.lines().filter(|line| line.starts_with("| ")) {
        let cells: Vec<&str> = line.trim_matches('|').split(" | ").map(str::trim).collect();
        assert_eq!(cells.len(), 3, "{line}");
        assert!(cells.iter().all(|cell| !cell.is_empty()), "an empty cell: {line}");
        if cells[1] == "value" {
            prefix = if cells[0] == "worst-case error" { "error: " } else { "" };
            continue;
        }
        let before = values.insert(format!("{prefix}{}", cells[0]), cells[1].to_owned());
        assert!(before.is_none(), "{} stands twice:\n{text}", cells[0]);
    }
    values
}

/// The numbers here are computed by hand from the weights 2 −2 −3 4 −1, 0 2 −3 0 1 and 1 2 3 2 1 on codes up to 4095.
#[test]
fn explain_prints_the_widths_of_the_wdft_preset_as_computed_by_hand() {
    let values = explained("vuris");
    for (quantity, value) in [
        ("sample", "12 bits unsigned"),
        ("pixels a frame", "19200"),
        ("raw frames a set", "5"),
        ("saturated from", "4095 DN"),
        // ±6 · 4095 = ±24570 < 2^15
        ("in-phase sum", "16 bits signed"),
        // ±3 · 4095 = ±12285 < 2^14
        ("quadrature sum", "15 bits signed"),
        // 9 · 4095 = 36855 < 2^16
        ("offset sum", "16 bits unsigned"),
        // 3 · 4095 = 12285 < 2^14 twice, 4095, and a flag: 14 + 14 + 12 + 1
        ("memory word", "41 bits"),
        // 41 · 160 · 120
        ("memory", "787200 bits"),
        // 19 + 19 + 5 + 2 blocks of 1024 x 18, 1024 x 18, 4096 x 4 and 16384 x 1 bits
        ("memory columns", "[18, 18, 4, 1]"),
        // sin 60° = √3 / 2
        ("metric", "3"),
        // 16 bits, without the sign
        ("magnitudes", "15 bits"),
        // −1 is 15 places away from the top: 8 + 4 + 2 + 1 = 15
        ("shifts", "[8, 4, 2, 1]"),
        // 18 + 2
        ("normalised to", "20 fraction bits"),
        ("iterations", "19"),
        // 18 + 5
        ("angle", "23 bits"),
        // Load, start, iterations 0 to 18, the last direction, the result: 1 + 1 + 19 + 1 + 1; 2 + 1 behind the angle unit
        ("latency", "26 clocks"),
        ("phase", "bits 17:0"),
        // 24570² + 3 · 12285² = (32503)², / 9 · 2^4 = 57783 < 2^16: from bit 24 on
        ("amplitude", "bits 39:24"),
        // 12 + 4 bits
        ("offset", "bits 55:40"),
        // 299792458 / 60e6 m / 10 um = 499654 < 2^19
        ("distance", "bits 74:56"),
        ("result word", "88 bits"),
    ] {
        assert_eq!(values.get(quantity).map(String::as_str), Some(value), "{quantity}");
    }
}

#[test]
fn explain_prints_the_widths_of_the_four_frame_preset_as_computed_by_hand() {
    let values = explained("vuris-four-frame");
    for (quantity, value) in [
        ("raw frames a set", "4"),
        // ±4095
        ("in-phase sum", "13 bits signed"),
        ("quadrature sum", "13 bits signed"),
        // 4 · 4095 = 16380 < 2^14
        ("offset sum", "14 bits unsigned"),
        // 13 + 13 + 14 + 1, · 19200
        ("memory word", "41 bits"),
        ("memory", "787200 bits"),
        ("metric", "1"),
        ("magnitudes", "12 bits"),
        // 12 places: 8 + 4 + 2 + 1
        ("shifts", "[8, 4, 2, 1]"),
        ("normalised to", "20 fraction bits"),
        // As the WDFT's: the same iterations
        ("latency", "26 clocks"),
    ] {
        assert_eq!(values.get(quantity).map(String::as_str), Some(value), "{quantity}");
    }
}

#[test]
fn explain_prints_every_derived_word_and_bound() {
    for preset in ["vuris", "vuris-four-frame"] {
        let pipeline = Pipeline::named(preset).unwrap();
        let (derived, budget, values) = (pipeline.derived(), pipeline.budget(), explained(preset));
        let word =
            |Word { bits, signed }| format!("{bits} bits {}", if signed { "signed" } else { "unsigned" });
        for (quantity, expected) in [
            ("sample", word(derived.sample)),
            ("in-phase sum", word(derived.in_phase)),
            ("quadrature sum", word(derived.quadrature)),
            ("offset sum", word(derived.offset_sum)),
            ("magnitudes", format!("{} bits", derived.angle.magnitude_bits)),
            ("iterations", derived.angle.iterations.to_string()),
            ("angle", format!("{} bits", derived.angle.angle_bits)),
            ("memory", format!("{} bits", derived.memory_bits)),
            ("latency", format!("{} clocks", derived.latency_clocks)),
        ] {
            assert_eq!(values[quantity], expected, "{quantity}");
        }
        for (quantity, word) in [
            ("phase", derived.phase),
            ("amplitude", derived.amplitude),
            ("offset", derived.offset),
            ("distance", derived.distance),
        ] {
            let (top, low) = values[quantity].strip_prefix("bits ").unwrap().split_once(':').unwrap();
            assert_eq!(
                top.parse::<u32>().unwrap() - low.parse::<u32>().unwrap() + 1,
                word.bits,
                "{quantity}"
            );
        }
        // The sum of the worst cases is the sum of the rows, each rounded to four decimals.
        let codes = |cell: &String| cell.split(' ').next().unwrap().parse::<f64>().unwrap();
        let rows: Vec<f64> = values
            .iter()
            .filter(|(quantity, _)| quantity.starts_with("error: phase: "))
            .map(|(_, v)| codes(v))
            .collect();
        assert_eq!(rows.len(), budget.phase.len());
        let sum = codes(&values["error: phase, sum"]);
        assert!((rows.iter().sum::<f64>() - sum).abs() < 1e-4 * rows.len() as f64, "{rows:?} {sum}");
        assert!((budget.phase_codes() - sum).abs() < 1e-4);
        for quantity in ["amplitude", "offset", "distance"] {
            assert!(values[&format!("{quantity} factor")].contains(" / 2^"), "{quantity}");
        }
    }
}

#[test]
fn an_explained_specification_reads_back_as_itself() {
    let home = home();
    for preset in ["vuris", "vuris-four-frame"] {
        let toml = run(home.path(), &["explain", "--spec", preset, "--toml"]);
        fs::write(home.path().join("my.toml"), &toml).unwrap();
        assert_eq!(run(home.path(), &["explain", "--spec", "my.toml", "--toml"]), toml);
        let explained = run(home.path(), &["explain", "--spec", preset]);
        assert_eq!(run(home.path(), &["explain", "--spec", "my.toml"]), explained);
    }
    // Numbers that are not round survive as well.
    let toml = run(home.path(), &["explain", "--spec", "vuris", "--toml"]);
    let odd = toml
        .replace("30000000.0", "80652000.125")
        .replace("1e-5", "3.3e-6")
        .replace("amplitude_dn = 0.0", "amplitude_dn = 12.5");
    fs::write(home.path().join("odd.toml"), &odd).unwrap();
    assert_eq!(run(home.path(), &["explain", "--spec", "odd.toml", "--toml"]), odd);
}

/// A reader that has seen enough closes the pipe; a disk can be full. Neither is a reason to panic.
#[test]
fn an_output_that_cannot_be_written_to_is_no_panic() {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    for stdout in [Stdio::from(writer), Stdio::from(full)] {
        let mut command = Command::new(cargo_bin!("vuris"));
        let output = command.args(["explain", "--spec", "vuris"]).stdout(stdout).output().unwrap();
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(!stderr.contains("panicked"), "{stderr}");
        assert_ne!(output.status.code(), Some(101));
    }
}

// ---------------------------------------------------------------- process

/// The array `name` of the folder `results`, of the type `descr` and the recordings' shape.
fn array<T: npyz::Deserialize>(results: &Path, name: &str, descr: &str) -> Vec<T> {
    let bytes = fs::read(results.join(format!("{name}.npy"))).unwrap();
    let file = NpyFile::new(&bytes[..]).unwrap();
    assert_eq!(file.dtype().descr(), format!("'{descr}'"), "{name}");
    assert_eq!(file.shape(), SHAPE, "{name}");
    assert_eq!(file.order(), npyz::Order::C, "{name}");
    file.into_vec().unwrap()
}

fn codes(results: &Path, name: &str, descr: &str) -> Vec<f64> {
    match descr {
        "|u1" => array::<u8>(results, name, descr).into_iter().map(f64::from).collect(),
        "<u2" => array::<u16>(results, name, descr).into_iter().map(f64::from).collect(),
        _ => array::<u32>(results, name, descr).into_iter().map(f64::from).collect(),
    }
}

/// `difference` to the nearest multiple of `period`.
fn wrapped(difference: f64, period: f64) -> f64 {
    difference - (difference / period).round() * period
}

/// Largest magnitude; NaN if any is.
fn largest(differences: impl Iterator<Item = f64>) -> f64 {
    differences.fold(0.0, |largest, d| if d.abs() <= largest { largest } else { d.abs() })
}

#[test]
fn processing_writes_arrays_that_stay_within_the_error_budget_of_every_pixel() {
    for (name, preset) in [("four-rail", "vuris-four-frame"), ("wdft-rail", "vuris")] {
        let home = home();
        let printed = run(home.path(), &["process", &recording(name), "--spec", preset, "--out", "results"]);
        let results = home.path().join("results");
        let base = Pipeline::named(preset).unwrap();
        let opened = Recording::open(Path::new(&recording(name))).unwrap();
        let (pipeline, _) = pipeline_for(&opened, &base, SchemeChoice::Specified).unwrap();
        let budget = pipeline.budget();

        let phase = codes(&results, "phase", "<u4");
        let amplitude = codes(&results, "amplitude", "<u2");
        let offset = codes(&results, "offset", "<u2");
        let distance = codes(&results, "distance", "<u4");
        let flags = codes(&results, "flags", "|u1");
        let phase_turns: Vec<f64> = array(&results, "reference_phase_turns", "<f8");
        let amplitude_dn: Vec<f64> = array(&results, "reference_amplitude_dn", "<f8");
        let offset_dn: Vec<f64> = array(&results, "reference_offset_dn", "<f8");
        let range_m: Vec<f64> = array(&results, "reference_range_m", "<f8");
        assert_eq!(flags, codes(&results, "reference_flags", "|u1"));
        assert!(flags.iter().all(|&flag| flag == 1.0), "every pixel of these is valid, and none saturated");

        // Codes that the reference's own rounding can account for.
        let float = 1e-6;
        let turn = 2f64.powi(18);
        // The speed of light over twice 30 MHz, in units of 10 um.
        let unambiguous = 299_792_458.0 / 60e6 / 1e-5;
        for pixel in 0..phase.len() {
            let at = format!("{name}, pixel {pixel}");
            let error = wrapped(phase[pixel] - phase_turns[pixel] * turn, turn);
            assert!(error.abs() <= budget.phase_codes() + float, "{at}: phase off by {error} codes");
            let truth = amplitude_dn[pixel] * 16.0;
            let error = amplitude[pixel] - truth;
            assert!(
                error.abs() <= budget.amplitude_codes(truth) + float,
                "{at}: amplitude off by {error} codes"
            );
            let truth = offset_dn[pixel] * 16.0;
            let error = offset[pixel] - truth;
            assert!(error.abs() <= budget.offset_codes(truth) + float, "{at}: offset off by {error} codes");
            let truth = phase[pixel] / turn * unambiguous;
            let error = distance[pixel] - truth;
            assert!(
                error.abs() <= budget.distance_codes(truth) + float,
                "{at}: distance off by {error} codes"
            );
            assert!((distance[pixel] - truth.round()).abs() <= 1.0, "{at}");
            let error = wrapped(distance[pixel] - range_m[pixel] / 1e-5, unambiguous);
            let allowed = budget.distance_codes(truth) + budget.phase_codes() * unambiguous / turn + float;
            assert!(error.abs() <= allowed, "{at}: distance off by {error} codes of the reference");
        }

        // What is printed about the differences is what the arrays say.
        let phases = phase.iter().zip(&phase_turns);
        let phase_mrad = largest(phases.map(|(&code, &turns)| wrapped(code / turn - turns, 1.0) * 1e3 * TAU));
        let amplitudes = amplitude.iter().zip(&amplitude_dn);
        let amplitude_error = largest(amplitudes.map(|(&code, &truth)| code / 16.0 - truth));
        let offsets = offset.iter().zip(&offset_dn);
        let offset_error = largest(offsets.map(|(&code, &truth)| code / 16.0 - truth));
        let distances = distance.iter().zip(&range_m);
        let distance_um = largest(distances.map(|(&code, &m)| wrapped(code - m / 1e-5, unambiguous) * 10.0));
        for (row, expected) in [
            ("phase, mrad", phase_mrad),
            ("amplitude, DN", amplitude_error),
            ("offset, DN", offset_error),
            ("distance, um", distance_um),
        ] {
            let line = printed.lines().find(|line| line.trim_start().starts_with(row)).unwrap();
            let shown: f64 = line.split_whitespace().last().unwrap().parse().unwrap();
            assert!((shown - expected).abs() < 1e-5, "{name}: {line}, not {expected}");
        }
        let pixels: u64 = SHAPE.iter().product();
        assert!(
            printed.contains(&format!("{pixels} pixels in 102 sets; 0 without a phase, 0 saturated")),
            "{printed}"
        );
    }
}

#[test]
fn processing_says_that_the_sensors_size_is_the_recordings() {
    let home = home();
    let printed =
        run(home.path(), &["process", &recording("wdft-rail"), "--spec", "vuris", "--out", "results"]);
    assert!(printed.starts_with("wdft-rail: scheme wdft, 30 MHz\n"), "{printed}");
    assert!(printed.contains("sensor 24 x 18 from frames.npy instead of 160 x 120\n"), "{printed}");
    assert!(printed.contains("written: results\n"), "{printed}");
    assert!(!printed.contains("scheme wdft from"), "the scheme is as specified: {printed}");
}

#[test]
fn the_manifest_says_what_the_codes_mean() {
    let home = home();
    run(home.path(), &["process", &recording("wdft-rail"), "--spec", "vuris", "--out", "results"]);
    let manifest = fs::read_to_string(home.path().join("results/vuris-process.toml")).unwrap();
    let manifest: toml::Table = manifest.parse().unwrap();
    assert_eq!(manifest["recording"].as_str(), Some("wdft-rail"));
    assert_eq!(manifest["spec"].as_str(), Some("vuris"));
    assert_eq!(manifest["scheme"].as_str(), Some("wdft"));
    assert_eq!(manifest["phase_turns_per_code"].as_float(), Some(2f64.powi(-18)));
    assert_eq!(manifest["amplitude_dn_per_code"].as_float(), Some(0.0625));
    assert_eq!(manifest["offset_dn_per_code"].as_float(), Some(0.0625));
    assert_eq!(manifest["distance_m_per_code"].as_float(), Some(1e-5));
    let mut listed: Vec<&str> =
        manifest["files"].as_array().unwrap().iter().map(|file| file.as_str().unwrap()).collect();
    listed.push("vuris-process.toml");
    listed.sort_unstable();
    assert_eq!(listed, files(&home.path().join("results")));
}

/// Names in `folder`, sorted.
fn files(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_scheme_chosen_from_the_recording_is_said_and_gives_what_its_preset_gives() {
    let home = home();
    let four = recording("four-rail");
    let printed =
        run(home.path(), &["process", &four, "--spec", "vuris", "--scheme", "auto", "--out", "auto"]);
    assert!(printed.contains("four-rail: scheme four_frame, 30 MHz"), "{printed}");
    assert!(printed.contains("scheme four_frame from the phase steps instead of wdft"), "{printed}");
    run(home.path(), &["process", &four, "--spec", "vuris-four-frame", "--out", "specified"]);
    for name in files(&home.path().join("specified")).iter().filter(|name| name.ends_with(".npy")) {
        let read = |folder: &str| fs::read(home.path().join(folder).join(name)).unwrap();
        assert_eq!(read("auto"), read("specified"), "{name}");
    }
}

#[test]
fn processing_twice_replaces_the_results() {
    let home = home();
    let (four, wdft) = (recording("four-rail"), recording("wdft-rail"));
    run(home.path(), &["process", &four, "--spec", "vuris-four-frame", "--out", "results"]);
    run(home.path(), &["process", &wdft, "--spec", "vuris", "--out", "results"]);
    run(home.path(), &["process", &wdft, "--spec", "vuris", "--out", "fresh/below"]);
    assert_eq!(files(home.path()), ["fresh", "results"], "nothing temporary is left");
    let fresh = home.path().join("fresh/below");
    assert_eq!(files(&home.path().join("results")), files(&fresh));
    for name in files(&fresh) {
        let read = |folder: &Path| fs::read(folder.join(&name)).unwrap();
        assert_eq!(read(&home.path().join("results")), read(&fresh), "{name}");
    }
}

#[test]
fn a_campaign_is_processed_recording_by_recording() {
    let home = home();
    let printed =
        run(home.path(), &["process", CAMPAIGN, "--spec", "vuris", "--scheme", "auto", "--out", "all"]);
    assert_eq!(files(&home.path().join("all")), ["four-rail", "wdft-rail"]);
    assert!(
        printed.contains("four-rail: scheme four_frame") && printed.contains("wdft-rail: scheme wdft"),
        "{printed}"
    );
    run(home.path(), &["process", &recording("wdft-rail"), "--spec", "vuris", "--out", "one"]);
    for name in files(&home.path().join("one")) {
        let read = |folder: &str| fs::read(home.path().join(folder).join(&name)).unwrap();
        assert_eq!(read("all/wdft-rail"), read("one"), "{name}");
    }
    let printed = run(home.path(), &["process", CAMPAIGN, "--spec", "vuris", "--out", "wdft"]);
    assert_eq!(files(&home.path().join("wdft")), ["wdft-rail"]);
    assert!(printed.contains("four-rail: left out: "), "{printed}");
    assert!(printed.contains("four-rail: `--scheme auto` takes it"), "{printed}");
}

// ---------------------------------------------------------------- verify

/// Runs in the repository, below which `make setup` puts Verilator.
#[test]
fn a_recording_is_bit_exact_in_both_simulators() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let printed = run(
        root,
        &[
            "verify",
            "--spec",
            "vuris",
            "--recording",
            "tests/data/practice-01/wdft-rail",
            "--sets",
            "2",
            "--simulator",
            "all",
        ],
    );
    assert!(
        printed.contains("wdft-rail: sensor 24 x 18 from frames.npy instead of 160 x 120\n"),
        "{printed}"
    );
    let mut compared = Vec::new();
    for simulator in ["verilator", "icarus"] {
        let start = format!(
            "vuris in {simulator}: bit-exact: recording wdft-rail, 2 sets, 25 % pauses, 25 % stops: "
        );
        compared.push(number_after(&printed, &start));
        let line = printed.lines().find(|line| line.starts_with(&start)).unwrap();
        assert!(line.contains("of 2 result sets, 0 sets discarded as due"), "{line}");
        // Not less than a raw code a clock.
        assert!(number_after(line, "discarded as due,") >= f64::from(2 * 5 * 24 * 18), "{line}");
    }
    assert_eq!(compared[0], compared[1], "both simulators compare the same values");
    // Sums and flag, vector, phase, amplitude, offset, distance, flags: at least ten values of every pixel.
    assert!(compared[0] >= f64::from(10 * 2 * 24 * 18), "{printed}");
}

// ---------------------------------------------------------------- scene

#[test]
fn the_scenes_picture_shows_the_numbers_that_are_printed() {
    let home = home();
    let printed = run(home.path(), &["scene", "--out", "new/pictures"]);
    let svg = fs::read_to_string(home.path().join("new/pictures/error-maps.svg")).unwrap();
    assert!(svg.starts_with("<!-- Generated by `vuris scene`, seed 2012. -->\n<svg "), "{}", &svg[..60]);
    assert!(svg.trim_end().ends_with("</svg>"));
    let mut errors_mm = Vec::new();
    for name in ["four frames", "WDFT"] {
        let error_mm = number_after(&printed, &format!("{name}: range error"));
        assert!(svg.contains(&format!("RMS {error_mm:.1} mm")), "{name}: {printed}");
        errors_mm.push(error_mm);
    }
    assert!(errors_mm[1] > 0.0 && errors_mm[1] < errors_mm[0], "{printed}");
    assert!(printed.ends_with("written: new/pictures/error-maps.svg\n"), "{printed}");

    let again = run(home.path(), &["scene", "--out", "again", "--seed", "2012"]);
    assert_eq!(fs::read_to_string(home.path().join("again/error-maps.svg")).unwrap(), svg);
    assert_eq!(again.lines().take(2).collect::<Vec<_>>(), printed.lines().take(2).collect::<Vec<_>>());
    run(home.path(), &["scene", "--out", "again", "--seed", "1"]);
    assert_ne!(
        fs::read_to_string(home.path().join("again/error-maps.svg")).unwrap(),
        svg,
        "another seed, other noise"
    );
}
