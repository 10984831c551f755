//! What the README shows is what the program prints.

use assert_cmd::Command;

/// The demonstration, run in the repository, ends with the very lines that the README shows. Simulator, seeds and
/// recordings are fixed, so they are the same on every machine.
#[test]
fn the_readme_shows_what_the_demonstration_prints() {
    let root = env!("CARGO_MANIFEST_DIR");
    let out = tempfile::tempdir().unwrap();
    let output = Command::cargo_bin("vuris")
        .unwrap()
        .current_dir(root)
        .args(["demo", "--out"])
        .arg(out.path())
        .output()
        .unwrap();
    let printed = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{printed}{}", String::from_utf8_lossy(&output.stderr));
    let summary = &printed[printed.rfind("bit-exact:").expect("the demonstration sums up")..];
    assert_eq!(summary.lines().count(), 4, "{summary}");
    let readme = std::fs::read_to_string(format!("{root}/README.md")).unwrap();
    for line in summary.lines() {
        assert!(readme.lines().any(|shown| shown == line), "the README does not show the line\n{line}");
    }
}

/// The worst case that the README quotes is the one that `vuris explain` derives, rounded.
#[test]
fn the_readme_quotes_the_derived_bound() {
    let budget = vuris::spec::Pipeline::named("vuris").unwrap().budget();
    let readme = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/README.md")).unwrap();
    let (codes, mrad) = (budget.phase_codes(), 1e3 * budget.phase_rad());
    assert!(readme.contains(&format!("{codes:.2} of a phase code")), "{codes:.2} of a phase code");
    assert!(readme.contains(&format!("{mrad:.3} mrad, for every vector")), "{mrad:.3} mrad");
}

/// The result word's fields in docs/hardware.md are the preset's.
#[test]
fn the_hardware_notes_list_the_result_words_fields() {
    let pipeline = vuris::spec::Pipeline::named("vuris").unwrap();
    let notes = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/hardware.md")).unwrap();
    for field in vuris::hdl::result_fields(&pipeline) {
        let bits = match field.bits {
            1 => field.low.to_string(),
            _ => format!("{}:{}", field.low + field.bits - 1, field.low),
        };
        let row = format!("| {bits} | {} |", field.name);
        assert!(notes.contains(&row), "docs/hardware.md has no row beginning {row}");
    }
    let latency = format!("results {} clocks after", pipeline.derived().latency_clocks);
    assert!(notes.contains(&latency), "docs/hardware.md does not say: {latency}");
}

/// Of the tables that `vuris paper` prints, the README has the paper's numbers and the open question, docs/paper.md the rivals against
/// lateral motion. All that is drawn is seeded.
#[test]
fn the_readme_shows_the_papers_tables() {
    let output = Command::cargo_bin("vuris").unwrap().arg("paper").output().unwrap();
    let printed = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let readme = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/README.md")).unwrap();
    let notes = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/paper.md")).unwrap();
    for (title, shown, name) in [
        ("## The paper's numbers", &readme, "README"),
        ("## The open question", &readme, "README"),
        ("## Rivals against lateral motion", &notes, "docs/paper.md"),
    ] {
        let section = &printed[printed.find(title).expect("the table is printed")..];
        let lines = section.lines().skip_while(|line| !line.starts_with('|'));
        let rows: Vec<&str> = lines.take_while(|line| line.starts_with('|')).collect();
        assert!(rows.len() > 6, "{title}: {} rows", rows.len());
        assert!(shown.contains(&rows.join("\n")), "{name} does not show\n{}", rows.join("\n"));
    }
}
