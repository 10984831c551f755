//! `cargo bench --bench diagnose`: seconds and memory of `vuris diagnose`, and how they grow with sets, pixels, what is there and what is
//! tried. Beside them, as the machine's own measure, the seconds in which `vuris simulate` makes the same frames.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// A campaign, and how many formulas are candidates beside the registry's effects.
struct Case {
    size: &'static str,
    recordings: &'static str,
    effects: &'static [&'static str],
    formulas: usize,
}

const ALL: &str = "four-rail,four-sweep,four-motion,wdft-rail,wdft-sweep,wdft-motion";
const WDFT: &str = "wdft-rail,wdft-sweep,wdft-motion";
const SCATTER: &[&str] = &["lens_scatter"];
const PAIR: &[&str] = &["lens_scatter", "multipath_interference"];

const fn case(size: &'static str, recordings: &'static str, effects: &'static [&'static str]) -> Case {
    Case { size, recordings, effects, formulas: 0 }
}

const CASES: [Case; 12] = [
    // As the practice campaigns are: clean, one effect, two.
    case("24x18", ALL, &[]),
    case("24x18", ALL, SCATTER),
    case("24x18", ALL, PAIR),
    // Sets.
    case("24x18", "wdft-rail", &[]),
    case("24x18", "wdft-rail,wdft-sweep", &[]),
    case("24x18", WDFT, &[]),
    // Pixels.
    case("48x36", WDFT, &[]),
    case("96x72", WDFT, &[]),
    case("160x120", WDFT, &[]),
    case("160x120", WDFT, SCATTER),
    // Candidates.
    Case { formulas: 10, ..case("24x18", WDFT, &[]) },
    Case { formulas: 20, ..case("24x18", WDFT, &[]) },
];

/// Runs `vuris` with `arguments`; how long it took, and the most memory that it was seen to hold, MB.
fn run(arguments: &[&str]) -> (Duration, f64) {
    let started = Instant::now();
    let mut child = Command::new(env!("CARGO_BIN_EXE_vuris"))
        .args(arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("vuris runs");
    let status = format!("/proc/{}/status", child.id());
    let mut peak_mb: f64 = 0.0;
    loop {
        let seen = std::fs::read_to_string(&status).unwrap_or_default();
        let peak = seen.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kilobytes = peak.and_then(|peak| peak.trim().strip_suffix(" kB")?.parse::<f64>().ok());
        peak_mb = peak_mb.max(kilobytes.unwrap_or(0.0) / 1024.0);
        if let Some(status) = child.try_wait().expect("vuris ends") {
            assert!(status.success(), "vuris {} failed", arguments.join(" "));
            return (started.elapsed(), peak_mb);
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// A library of so many formulas, waves over rows and columns.
fn library(folder: &Path, formulas: usize) -> PathBuf {
    let mut text = String::new();
    for number in 0..formulas {
        let _ = write!(
            text,
            "[[effect]]\nname = \"wave_{number}\"\nsentence = \"A wave over the rows.\"\nacts_on = \"signal\"\n\
             formula = \"amplitude_dn * sin({}.3 * row + column) * cos(PI * set)\"\n[[effect.parameter]]\n\
             name = \"amplitude_dn\"\nunit = \"DN\"\nbounds = [-50, 50]\ntypical = 1\n",
            number + 1
        );
    }
    let file = folder.join("library.toml");
    std::fs::write(&file, text).expect("a library is written");
    file
}

fn main() {
    let folder = tempfile::tempdir().expect("a folder");
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    println!("On {threads} cores:\n");
    println!(
        "| pixels | sets | effects | formulas besides | simulate, s | diagnose, s | ratio | most memory, MB |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for (number, case) in CASES.iter().enumerate() {
        let out = folder.path().join(number.to_string());
        let out_name = out.to_str().expect("a path in letters");
        let mut simulate =
            vec!["simulate", "--size", case.size, "--recordings", case.recordings, "--out", out_name];
        simulate.extend(case.effects.iter().flat_map(|effect| ["--effect", effect]));
        let (made, _) = run(&simulate);
        let sets: usize = case.recordings.split(',').map(|name| rows(&out.join(name).join("sets.csv"))).sum();
        let library = library(folder.path(), case.formulas);
        let mut diagnose = vec!["diagnose", out_name];
        if case.formulas > 0 {
            diagnose.extend(["--library", library.to_str().expect("a path in letters")]);
        }
        let (told, peak_mb) = run(&diagnose);
        let (made, told) = (made.as_secs_f64(), told.as_secs_f64());
        let effects = if case.effects.is_empty() { "none".to_owned() } else { case.effects.join(", ") };
        println!(
            "| {} | {sets} | {effects} | {} | {made:.2} | {told:.1} | {:.0} | {peak_mb:.0} |",
            case.size.replace('x', " × "),
            case.formulas,
            told / made
        );
        std::fs::remove_dir_all(&out).expect("the campaign is removed");
    }
}

/// Sets of a recording: rows of its table, less the heading.
fn rows(table: &Path) -> usize {
    std::fs::read_to_string(table).expect("the table of sets").lines().count() - 1
}
