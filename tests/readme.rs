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
/// lateral motion, docs/open-question.md the candidates. All that is drawn is seeded.
#[test]
fn the_readme_shows_the_papers_tables() {
    let output = Command::cargo_bin("vuris").unwrap().arg("paper").output().unwrap();
    let printed = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let readme = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/README.md")).unwrap();
    let notes = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/paper.md")).unwrap();
    let question = text("docs/open-question.md");
    for (title, shown, name) in [
        ("## The paper's numbers", &readme, "README"),
        ("## The open question", &readme, "README"),
        ("## The paper's candidates", &question, "docs/open-question.md"),
        ("## Rivals against lateral motion", &notes, "docs/paper.md"),
    ] {
        let section = &printed[printed.find(title).expect("the table is printed")..];
        let lines = section.lines().skip_while(|line| !line.starts_with('|'));
        let rows: Vec<&str> = lines.take_while(|line| line.starts_with('|')).collect();
        assert!(rows.len() > 6, "{title}: {} rows", rows.len());
        assert!(shown.contains(&rows.join("\n")), "{name} does not show\n{}", rows.join("\n"));
    }
}

fn text(path: &str) -> String {
    std::fs::read_to_string(format!("{}/{path}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// The cells of the one row of `text` whose first cell is `name`.
fn row(text: &str, name: &str) -> Vec<String> {
    let rows = text.lines().filter(|line| line.starts_with('|'));
    let cells = |line: &str| line.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect();
    let mut found: Vec<Vec<String>> =
        rows.map(cells).filter(|cells: &Vec<String>| cells[0] == name).collect();
    assert_eq!(found.len(), 1, "rows of {name}");
    found.remove(0)
}

/// What was measured of `target` on an ECP5: LUTs, registers, block RAMs, multipliers, median Fmax in MHz, and of the target:
/// latency, clocks a sample, greatest error in 2^-16 turn.
fn measured(target: &str) -> [String; 8] {
    let file: serde_json::Value = serde_json::from_str(&text("generated/synthesis.json")).unwrap();
    let targets = file["targets"].as_array().unwrap();
    let target = targets.iter().find(|row| row["name"] == target).unwrap();
    let results = target["results"].as_array().unwrap();
    let ecp5 = results.iter().find(|row| row["family"] == "ecp5").unwrap();
    let routed = ecp5["speed"]["routed"].as_array().unwrap();
    let mut speeds: Vec<f64> = routed.iter().map(|seed| seed["fmax_mhz"].as_f64().unwrap()).collect();
    speeds.sort_by(f64::total_cmp);
    let area = |name: &str| ecp5["area"][name].to_string();
    let error = target["accuracy"]["largest"].as_f64();
    [
        area("luts"),
        area("registers"),
        area("block_rams"),
        area("multipliers"),
        format!("{:.1}", speeds[speeds.len() / 2]),
        target["latency_clocks"].to_string(),
        target["clocks_per_sample"].to_string(),
        error.map_or(String::new(), |error| format!("{error:.3}")),
    ]
}

/// Areas, frequencies and errors of README and docs/hardware.md are those of generated/synthesis.json.
#[test]
fn areas_and_frequencies_are_the_measured_ones() {
    let (readme, notes) = (text("README.md"), text("docs/hardware.md"));
    for (name, target) in [
        ("**VURIS, unrolled**", "angle-16"),
        ("**VURIS, tables and multipliers**", "angle-16-poly"),
        ("**VURIS, one iteration a clock**", "angle-16-iterative"),
    ] {
        let [luts, registers, _, multipliers, fmax, _, clocks, error] = measured(target);
        assert_eq!(row(&readme, name)[1..], [clocks, luts, registers, multipliers, fmax, error], "{name}");
    }
    for (name, target) in [
        ("CORDIC, unrolled", "angle-16"),
        ("CORDIC, one iteration a clock", "angle-16-iterative"),
        ("`atan = \"poly\"`, tables in logic", "angle-16-poly"),
        ("`atan = \"poly\"`, tables in memory", "angle-16-poly-memory"),
    ] {
        let [luts, registers, memories, multipliers, fmax, latency, clocks, _] = measured(target);
        let expected = [clocks, latency, luts, registers, memories, multipliers, fmax];
        assert_eq!(row(&notes, name)[1..], expected, "{name}");
    }
    for target in ["vuris", "vuris-fast", "vuris-four-frame"] {
        let [luts, registers, memories, multipliers, fmax, _, clocks, _] = measured(target);
        let expected = [clocks, luts, registers, memories, multipliers, fmax];
        assert_eq!(row(&readme, &format!("`{target}`"))[1..], expected, "{target}");
    }
}

/// The public cores' numbers are those of src/synthesis/peers.csv.
#[test]
fn the_public_cores_numbers_are_those_of_the_table() {
    let readme = text("README.md");
    let mut peers = csv::Reader::from_reader(include_bytes!("../src/synthesis/peers.csv").as_slice());
    let header = peers.headers().unwrap().clone();
    let peers: Vec<csv::StringRecord> = peers.records().map(|record| record.unwrap()).collect();
    for (name, configuration, amplitude) in [
        ("ZipCPU topolar, without amplitude", "topolar, 16-bit phase", "no"),
        (
            "Open Logic olo_fix_cordic_vect, pipelined, without amplitude",
            "olo_fix_cordic_vect, PIPELINED",
            "no",
        ),
        (
            "FloPoCo FixAtan2 by multipliers, frequency 700",
            "FixAtan2 reciprocal-multiply-atan, degree 2, frequency 700",
            "no",
        ),
        ("ZipCPU seqpolar, with amplitude", "seqpolar, 16-bit phase", "yes"),
    ] {
        let field = |record: &csv::StringRecord, name: &str| {
            record[header.iter().position(|column| column == name).unwrap()].to_owned()
        };
        let known = |record: &&csv::StringRecord| {
            [field(record, "configuration"), field(record, "amplitude"), field(record, "input_bits")]
                == [configuration, amplitude, "16"]
        };
        let peer = peers.iter().find(known).unwrap_or_else(|| panic!("peers.csv has no {configuration}"));
        let number = |name: &str| field(peer, name).parse::<f64>().unwrap();
        let luts = number("lut4") + 2.0 * number("ccu2c");
        let expected = ["clocks_per_sample", "", "registers", "multipliers", "fmax_mhz", "largest"]
            .map(|name| if name.is_empty() { luts } else { number(name) });
        let shown: Vec<f64> = row(&readme, name)[1..].iter().map(|cell| cell.parse().unwrap()).collect();
        assert_eq!(shown, expected, "{name}");
    }
}

/// How many mutants there are and what became of them, and how much is covered, is what the pages in docs/ say.
#[test]
fn mutants_and_coverage_are_those_of_their_pages() {
    let readme = text("README.md").split_whitespace().collect::<Vec<_>>().join(" ");
    let mutants = row(&text("docs/mutation-vuris.md"), "**all**");
    let [all, killed, timed_out, equivalent, survived]: [u32; 5] =
        std::array::from_fn(|column| mutants[column + 1].parse().unwrap());
    assert_eq!(all, killed + timed_out + equivalent + survived);
    let coverage = row(&text("docs/coverage-vuris.md"), "**all**");
    let percent = |cell: &str| cell.split(['(', ')']).nth(1).unwrap().to_owned();
    for sentence in [
        format!(
            "of {all} single-bit faults that Yosys puts into the netlist, {equivalent} are proved to be none"
        ),
        format!("of the other {} the benches kill {}, {}", all - equivalent, killed + timed_out, mutants[6]),
        format!("{} of the lines run and {} of the bits move", percent(&coverage[1]), percent(&coverage[2])),
    ] {
        assert!(readme.contains(&sentence), "the README does not say: {sentence}");
    }
    for page in ["mutation-vuris", "mutation-vuris-fast"] {
        let page = text(&format!("docs/{page}.md"));
        assert!(!page.contains("not explained"), "a survivor without an explanation: {page}");
    }
}
