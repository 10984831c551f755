//! `vuris generate`: what is in the repository is what it writes, `--check` compares both ways and writes nothing, and
//! what a user put beside it stays.

use assert_cmd::cargo::cargo_bin_cmd;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;
use vuris::synthesis::Target;

const SPEC: &str = "bench.toml";

/// A home with the small specification [`SPEC`] and its output in `out`.
fn generated() -> tempfile::TempDir {
    let home = tempfile::tempdir().unwrap();
    let preset = text(&run(home.path(), &["explain", "--spec", "vuris", "--toml"], 0));
    let small = preset.replace("\"vuris\"", "\"bench\"").replace("= 160", "= 8").replace("= 120", "= 2");
    assert_ne!(preset, small);
    fs::write(home.path().join(SPEC), small).unwrap();
    generate(home.path());
    home
}

/// Runs the program in `home`; standard output. Standard error must be empty.
fn run(home: &Path, arguments: &[&str], code: i32) -> Vec<u8> {
    let output = cargo_bin_cmd!("vuris").current_dir(home).args(arguments).output().unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(stderr, "", "{arguments:?}");
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", text(&output.stdout));
    output.stdout
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_owned()).unwrap()
}

fn generate(home: &Path) -> String {
    text(&run(home, &["generate", "--spec", SPEC, "--out", "out"], 0))
}

fn check(home: &Path, code: i32) -> String {
    text(&run(home, &["generate", "--spec", SPEC, "--out", "out", "--check"], code))
}

/// Bytes and time of change of every file below `folder`, by its path within.
fn snapshot(folder: &Path) -> BTreeMap<PathBuf, (Vec<u8>, SystemTime)> {
    fn collect(folder: &Path, within: &Path, found: &mut BTreeMap<PathBuf, (Vec<u8>, SystemTime)>) {
        for entry in fs::read_dir(folder.join(within)).unwrap() {
            let path = within.join(entry.unwrap().file_name());
            let full = folder.join(&path);
            if full.is_dir() {
                collect(folder, &path, found);
            } else {
                found.insert(path, (fs::read(&full).unwrap(), full.metadata().unwrap().modified().unwrap()));
            }
        }
    }
    let mut found = BTreeMap::new();
    collect(folder, Path::new(""), &mut found);
    found
}

fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    snapshot(folder).into_iter().map(|(path, (bytes, _))| (path, bytes)).collect()
}

/// The command that a check recommends, between backquotes.
fn recommended(checked: &str) -> Vec<String> {
    let command = checked.split('`').nth(1).unwrap_or_else(|| panic!("no command in:\n{checked}"));
    let words: Vec<String> = command.split(' ').map(str::to_owned).collect();
    assert_eq!(words[0], "vuris", "{command}");
    words[1..].to_vec()
}

/// Checks that find `differences`, write nothing, and recommend a command after which all is well.
fn assert_found_and_repaired(home: &Path, differences: &[&str]) {
    let good = {
        let fresh = tempfile::tempdir().unwrap();
        fs::copy(home.join(SPEC), fresh.path().join(SPEC)).unwrap();
        generate(fresh.path());
        contents(&fresh.path().join("out"))
    };
    let before = snapshot(home);
    let checked = check(home, 1);
    assert_eq!(snapshot(home), before, "a check writes nothing");
    let lines: Vec<&str> = checked.lines().collect();
    assert_eq!(lines[..lines.len() - 1], *differences);
    assert!(lines[lines.len() - 1].starts_with(&format!("out: {} file", differences.len())), "{checked}");
    let command = recommended(&checked);
    run(home, &command.iter().map(String::as_str).collect::<Vec<_>>(), 0);
    assert!(check(home, 0).contains("up to date"));
    assert_eq!(contents(&home.join("out")), good);
}

#[test]
fn the_repository_holds_what_the_program_writes() {
    let fresh = tempfile::tempdir().unwrap();
    // What has been measured is not generated, and the guide shows it.
    fs::create_dir(fresh.path().join("generated")).unwrap();
    for measured in ["generated/synthesis.json", "generated/synthesis.md"] {
        fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join(measured), fresh.path().join(measured)).unwrap();
    }
    run(fresh.path(), &["generate", "--spec", "vuris"], 0);
    let repository = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (committed, written) =
        (contents(&repository.join("generated")), contents(&fresh.path().join("generated")));
    let all: Vec<&PathBuf> = committed.keys().chain(written.keys()).collect();
    let different: Vec<_> = all.iter().filter(|path| committed.get(**path) != written.get(**path)).collect();
    assert!(different.is_empty(), "`make generate` writes {different:?}");
    assert!(written.len() > 30);
    let checked = text(&run(repository, &["generate", "--spec", "vuris", "--check"], 0));
    assert_eq!(checked, format!("generated: {} files are up to date\n", written.len() - 2));
}

/// The guide shows the area of the very Verilog beside it, and of no other.
#[test]
fn the_guide_shows_what_synthesis_has_measured() {
    let home = generated();
    let guide = home.path().join("out/integration.md");
    let before = fs::read_to_string(&guide).unwrap();
    assert!(before.contains("have not been measured") && !before.contains("| 4711 |"), "{before}");
    let spec = home.path().join(SPEC);
    let target = Target::named(spec.to_str().unwrap(), SPEC).unwrap();
    let measured = format!(
        "{{\"note\": \"\", \"format\": \"vuris-synthesis/1\", \"tools\": {{}}, \"target_mhz\": 400, \"seeds\": [1], \"targets\": [{{\
         \"name\": \"bench\", \"purpose\": \"\", \"kind\": \"pipeline\", \"digest\": \"{}\", \"latency_clocks\": null, \
         \"clocks_per_sample\": null, \"accuracy\": null, \"results\": [{{\"family\": \"ecp5\", \"area\": AREA, \"accepted\": AREA, \
         \"speed\": {{\"does-not-fit\": \"too large\"}}}}]}}]}}",
        target.verilog.digest()
    );
    let area = "{\"luts\": 4711, \"lut4\": 0, \"carries\": 0, \"lut_memories\": 0, \"registers\": 0, \"block_rams\": 0, \"multipliers\": 0}";
    fs::write(home.path().join("out/synthesis.json"), measured.replace("AREA", area)).unwrap();
    assert!(check(home.path(), 1).contains("stale   integration.md"));
    generate(home.path());
    assert!(fs::read_to_string(&guide).unwrap().contains("| 4711 |"));
    let text = fs::read_to_string(&spec).unwrap();
    fs::write(&spec, text.replace("height = 2", "height = 4")).unwrap();
    generate(home.path());
    assert!(!fs::read_to_string(&guide).unwrap().contains("| 4711 |"), "the figures are another core's");
}

#[test]
fn every_written_file_says_how_it_was_made() {
    let home = generated();
    for (path, bytes) in contents(&home.path().join("out")) {
        let head: String = text(&bytes).lines().take(4).collect();
        assert!(
            head.contains(&format!("Generated by `vuris generate --spec {SPEC}`")),
            "{}: {head}",
            path.display()
        );
    }
}

#[test]
fn a_fresh_output_is_up_to_date_and_the_check_writes_nothing() {
    let home = generated();
    let before = snapshot(home.path());
    let checked = check(home.path(), 0);
    assert_eq!(checked, format!("out: {} files are up to date\n", before.len() - 1));
    assert_eq!(snapshot(home.path()), before);
}

#[test]
fn a_check_of_nothing_finds_every_file_missing_and_makes_no_folder() {
    let home = generated();
    let count = contents(&home.path().join("out")).len();
    let checked = text(&run(home.path(), &["generate", "--spec", SPEC, "--check"], 1));
    assert_eq!(checked.lines().filter(|line| line.starts_with("missing ")).count(), count);
    assert!(checked.contains(&format!("`vuris generate --spec {SPEC} --out generated`")), "{checked}");
    assert!(!home.path().join("generated").exists());
}

#[test]
fn a_missing_file_is_found_and_written() {
    let home = generated();
    fs::remove_file(home.path().join("out/tb/testbench.v")).unwrap();
    assert_found_and_repaired(home.path(), &["missing tb/testbench.v"]);
}

#[test]
fn a_missing_folder_is_found_and_written() {
    let home = generated();
    fs::remove_dir_all(home.path().join("out/tb")).unwrap();
    assert_found_and_repaired(
        home.path(),
        &[
            "missing tb/bench_taps.v",
            "missing tb/harness.cpp",
            "missing tb/icarus.f",
            "missing tb/testbench.v",
            "missing tb/verilator.f",
        ],
    );
}

#[test]
fn a_stale_file_is_found_with_the_line_and_written() {
    let home = generated();
    let path = home.path().join("out/rtl/bench_accumulator.v");
    let good = fs::read_to_string(&path).unwrap();
    let lines: Vec<&str> = good.lines().collect();
    let with = |line: usize, new: &str| {
        let mut lines = lines.clone();
        lines[line - 1] = new;
        lines.join("\n") + "\n"
    };
    let last = lines.len();
    for (changed, line) in [
        (with(1, "// another"), 1),
        (with(17, "  // another"), 17),
        (with(last, "endmodule // another"), last),
        // The last line's end is missing, and a line is appended.
        (good.trim_end().to_owned(), last),
        (good.clone() + "// another\n", last + 1),
        (with(9, lines[8]).replacen('\n', "\r\n", 1), 1),
        (String::new(), 1),
    ] {
        assert_ne!(changed, good);
        fs::write(&path, changed).unwrap();
        let difference = format!("stale   rtl/bench_accumulator.v, from line {line}");
        assert_found_and_repaired(home.path(), &[&difference]);
    }
}

#[test]
fn another_specification_makes_the_output_stale() {
    let home = generated();
    let text = fs::read_to_string(home.path().join(SPEC)).unwrap();
    fs::write(home.path().join(SPEC), text.replace("iterations = 19", "iterations = 18")).unwrap();
    let checked = check(home.path(), 1);
    assert!(checked.contains("stale   rtl/bench_angle.v, from line "), "{checked}");
    let line = 1 + text.lines().position(|line| line == "iterations = 19").unwrap();
    // The generated copy has a line more at its top.
    assert!(
        checked.contains(&format!("stale   rtl/specification.toml, from line {}", line + 1)),
        "{checked}"
    );
    generate(home.path());
    check(home.path(), 0);
}

#[test]
fn a_surplus_file_of_an_earlier_run_is_found_and_removed() {
    let home = generated();
    let out = home.path().join("out");
    fs::copy(out.join("rtl/bench_accumulator.v"), out.join("rtl/bench_divider.v")).unwrap();
    fs::copy(out.join("vectors/usable.hex"), out.join("vectors/z.hex")).unwrap();
    fs::copy(out.join("tb/harness.cpp"), out.join("tb/harness2.cpp")).unwrap();
    let found = ["surplus rtl/bench_divider.v", "surplus tb/harness2.cpp", "surplus vectors/z.hex"];
    assert_found_and_repaired(home.path(), &found);
}

#[test]
fn the_files_of_another_name_are_removed() {
    let home = generated();
    let text = fs::read_to_string(home.path().join(SPEC)).unwrap();
    fs::write(home.path().join(SPEC), text.replace("\"bench\"", "\"other\"")).unwrap();
    let checked = check(home.path(), 1);
    assert!(
        checked.contains("surplus rtl/bench_pipeline.v\n")
            && checked.contains("missing rtl/other_pipeline.v\n"),
        "{checked}"
    );
    generate(home.path());
    check(home.path(), 0);
    let left = contents(&home.path().join("out"));
    assert!(left.keys().all(|path| !path.to_string_lossy().contains("rtl/bench")), "{:?}", left.keys());
}

#[test]
fn all_kinds_at_once_are_found_in_the_order_of_paths_and_repaired() {
    let home = generated();
    let out = home.path().join("out");
    fs::copy(out.join("rtl/files.f"), out.join("rtl/aaa.f")).unwrap();
    fs::remove_file(out.join("rtl/bench_distance.v")).unwrap();
    let vectors = fs::read_to_string(out.join("vectors/phase.hex")).unwrap();
    fs::write(out.join("vectors/phase.hex"), vectors.replacen('\n', "\n00000\n", 1)).unwrap();
    assert_found_and_repaired(
        home.path(),
        &["surplus rtl/aaa.f", "missing rtl/bench_distance.v", "stale   vectors/phase.hex, from line 2"],
    );
}

#[test]
fn generating_twice_changes_nothing() {
    let home = generated();
    let before = snapshot(home.path());
    let said = generate(home.path());
    assert_eq!(said, format!("out: {} files of specification bench\n", before.len() - 1));
    assert_eq!(snapshot(home.path()), before, "not even the times of change");
}

#[test]
fn a_users_own_files_stay() {
    let home = generated();
    let out = home.path().join("out");
    let own = ["notes.txt", "rtl/wrapper.v", "tb/mine/tb.v", "vectors/notes.md", "synthesis/run.tcl"];
    for path in own {
        fs::create_dir_all(out.join(path).parent().unwrap()).unwrap();
        fs::write(out.join(path), "// mine\n").unwrap();
    }
    fs::remove_file(out.join("rtl/bench_pipeline.v")).unwrap();
    generate(home.path());
    assert!(out.join("rtl/bench_pipeline.v").is_file());
    for path in own {
        assert_eq!(fs::read_to_string(out.join(path)).unwrap(), "// mine\n", "{path}");
    }
    // In the folders that hold nothing but generated files they are surplus all the same; beside them they are not.
    let checked = check(home.path(), 1);
    let found: Vec<&str> = checked.lines().filter_map(|line| line.strip_prefix("surplus ")).collect();
    let own = ["rtl/wrapper.v", "tb/mine/tb.v", "vectors/notes.md"];
    assert_eq!(
        found,
        own.map(|path| format!("{path}, which vuris did not write: remove it, or move it away"))
    );
}

/// A link among the generated files leads to files that are not of this output, even where they were generated too.
#[test]
fn links_are_not_followed() {
    let home = generated();
    let out = home.path().join("out");
    run(home.path(), &["generate", "--spec", "vuris", "--out", "elsewhere"], 0);
    let elsewhere = snapshot(&home.path().join("elsewhere"));
    std::os::unix::fs::symlink(home.path().join("elsewhere/rtl"), out.join("rtl/other")).unwrap();
    std::os::unix::fs::symlink("/nonexistent", out.join("rtl/dangling.v")).unwrap();
    generate(home.path());
    assert_eq!(snapshot(&home.path().join("elsewhere")), elsewhere, "files of another output are gone");
    let before = fs::read(out.join("tb/harness.cpp")).unwrap();
    std::os::unix::fs::symlink(".", out.join("tb/loop")).unwrap();
    generate(home.path());
    assert_eq!(
        fs::read(out.join("tb/harness.cpp")).ok(),
        Some(before),
        "the output removes itself through a link"
    );
}

/// A check must not recommend a command that leaves its finding as it is.
#[test]
fn what_generating_does_not_remove_the_check_tells_the_user_to_remove() {
    let home = generated();
    fs::write(home.path().join("out/rtl/wrapper.v"), "// mine\n").unwrap();
    let checked = check(home.path(), 1);
    assert!(checked.contains("surplus rtl/wrapper.v"), "{checked}");
    generate(home.path());
    assert!(home.path().join("out/rtl/wrapper.v").is_file());
    let last = checked.lines().last().unwrap();
    assert!(!last.ends_with("writes them") && checked.contains("remove"), "nothing repairs this:\n{checked}");
}
