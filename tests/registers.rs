//! The register block: what software finds, from outside the generator.
//!
//! Chain of trust: the golden answers of the model are compared here with what `sha256sum`, a C compiler and rustc make of the
//! generated files, and with figures by hand; both benches compare the hardware with the model on every access, and count on
//! their own what the counters must hold (`cosim.rs`); `faults.rs` shows that they see a wrong register.

mod support;

use std::collections::BTreeMap;
use std::io::Write;
use std::process::{Command, Stdio};
use support::small;
use vuris::artifact::Artifact;
use vuris::cosim::{Simulator, Traffic, random_sets, register_accesses, simulate};
use vuris::hdl::{Golden, Scenario, Segment, Source, all_artifacts};
use vuris::model::{Access, ReadData, StreamEvent};
use vuris::spec::Pipeline;

fn artifacts(pipeline: &Pipeline) -> BTreeMap<String, String> {
    let source = Source { pipeline, spec: "test" };
    let golden = Golden::new(pipeline, &Scenario::default());
    all_artifacts(&source, &golden).into_iter().map(|Artifact { path, text }| (path, text)).collect()
}

/// What `program` prints when it gets `input`; it must succeed.
fn piped(program: &str, arguments: &[&str], input: &str) -> String {
    let mut child = Command::new(program)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::inherit())
        .spawn()
        .unwrap_or_else(|error| panic!("{program}: {error}"));
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{program}");
    String::from_utf8(output.stdout).unwrap()
}

/// Answers to `accesses` of a core that has just been reset.
fn answers(pipeline: &Pipeline, accesses: &[Access]) -> Vec<(bool, ReadData)> {
    let events = accesses.iter().map(|&access| StreamEvent::Access(access)).collect();
    let segment = Segment { name: "accesses".to_owned(), events };
    let golden = Golden::new(pipeline, &Scenario { segments: vec![segment] });
    golden.accesses.iter().map(|access| (access.answer.okay, access.answer.data)).collect()
}

fn read(address: u32) -> Access {
    Access::Read { address }
}

#[test]
fn the_specification_hash_is_what_sha256sum_says_of_the_printed_specification() {
    for preset in ["vuris", "vuris-four-frame"] {
        let output = assert_cmd::cargo::cargo_bin_cmd!("vuris")
            .args(["explain", "--spec", preset, "--toml"])
            .output()
            .unwrap();
        let sum = piped("sha256sum", &[], &String::from_utf8(output.stdout).unwrap());
        let expected = &sum[..16];
        let pipeline = Pipeline::named(preset).unwrap();
        let files = artifacts(&pipeline);
        let header = &files[&format!("software/{}_registers.h", pipeline.prefix())];
        assert!(header.contains(&format!("_SPECIFICATION_HASH 0x{expected}ull\n")), "{expected}\n{header}");
        let explained =
            assert_cmd::cargo::cargo_bin_cmd!("vuris").args(["explain", "--spec", preset]).output().unwrap();
        assert!(
            String::from_utf8(explained.stdout).unwrap().contains(&format!("| 0x{expected} ")),
            "{expected}"
        );
        let word = |at: usize| u32::from_str_radix(&expected[at..at + 8], 16).unwrap();
        let high_and_low = answers(&pipeline, &[read(0x0c), read(0x08)]);
        assert_eq!(high_and_low, [(true, ReadData::Value(word(0))), (true, ReadData::Value(word(8)))]);
    }
}

#[test]
fn every_change_of_a_specification_changes_its_hash() {
    let base = small("vuris", |_| {});
    let text = base.to_toml();
    let mut hashes = vec![base.hash()];
    for (from, to) in [
        ("width = 12", "width = 13"),
        ("frequency_hz = 30000000.0", "frequency_hz = 30000001.0"),
        ("order = [0, 1, 2, 3, 4]", "order = [0, 1, 2, 4, 3]"),
        ("phase_step_bits = 16", "phase_step_bits = 15"),
        ("frequency_factor = 30", "frequency_factor = 31"),
        ("axi4_lite = true", "axi4_lite = false"),
        ("name = \"vuris\"", "name = \"other\""),
    ] {
        assert_eq!(text.matches(from).count(), 1, "{from}\n{text}");
        hashes.push(Pipeline::parse("changed", &text.replace(from, to)).unwrap().hash());
    }
    hashes.sort_unstable();
    hashes.dedup();
    assert_eq!(hashes.len(), 8);
    // Whitespace, comments and defaults that are left out are not the specification.
    let short = text.replace("order = [0, 1, 2, 3, 4]\nphase_step_bits = 16\n", "# the usual order\n\n");
    assert_ne!(short, text);
    assert_eq!(Pipeline::parse("short", &short).unwrap().hash(), base.hash());
}

/// Registers and their answers, by hand, for 12 x 9 pixels and 5 frames a set: "VURS" is 56 55 52 53 in ASCII.
#[test]
fn reads_and_writes_are_answered_as_documented() {
    let pipeline = small("vuris", |_| {});
    let write = |address, data, strobes| Access::Write { address, data, strobes };
    let value = |data| (true, ReadData::Value(data));
    let slverr = |data| (false, ReadData::Value(data));
    let version: Vec<u32> = env!("CARGO_PKG_VERSION").split('.').map(|part| part.parse().unwrap()).collect();
    let cases = [
        (read(0x00), value(0x5655_5253)),
        (read(0x04), value(version[0] << 16 | version[1] << 8 | version[2])),
        (read(0x10), value(12)),
        (read(0x14), value(9)),
        (read(0x18), value(5)),
        // What a write is answered with is the factor that it leaves.
        (read(0x30), value(30)),
        (write(0x30, 0x8899_aabb, 15), value(0x8899_aabb)),
        (write(0x30, 0x1122_3344, 0b0101), value(0x8822_aa44)),
        (write(0x33, 0x5566_7788, 0b1000), value(0x5522_aa44)),
        (write(0x30, 0xffff_ffff, 0), value(0x5522_aa44)),
        (read(0x31), value(0x5522_aa44)),
        (write(0x00, 1, 15), slverr(0x5522_aa44)),
        (write(0x1c, 1, 15), slverr(0x5522_aa44)),
        (write(0x34, 1, 15), slverr(0x5522_aa44)),
        (read(0x34), slverr(0)),
        (read(0xfc), slverr(0)),
        (read(0x30), value(0x5522_aa44)),
    ];
    let (accesses, expected): (Vec<_>, Vec<_>) = cases.into_iter().unzip();
    assert_eq!(answers(&pipeline, &accesses), expected);
    // After a reset it is the specification's again.
    let events =
        [StreamEvent::Access(accesses[6]), StreamEvent::Reset, StreamEvent::Access(read(0x30))].to_vec();
    let segment = Segment { name: "a reset".to_owned(), events };
    let golden = Golden::new(&pipeline, &Scenario { segments: vec![segment] });
    assert_eq!(golden.accesses[1].answer.data, ReadData::Value(30));
}

#[test]
fn a_core_without_registers_has_no_port_no_file_and_no_access() {
    let pipeline = small("vuris", |specification| specification.registers.axi4_lite = false);
    assert!(register_accesses(&pipeline, 1).is_empty());
    assert!(answers(&pipeline, &[read(0)]).is_empty());
    let files = artifacts(&pipeline);
    assert!(files.keys().all(|path| !path.contains("registers") && !path.starts_with("software/")));
    assert!(!files["rtl/vuris_pipeline.v"].contains("axil") && !files["rtl/files.f"].contains("registers"));
    let with = artifacts(&small("vuris", |_| {}));
    assert!(
        with["rtl/vuris_pipeline.v"].contains("s_axil_awvalid") && with.contains_key("vectors/accesses.hex")
    );
}

/// Header, constants and documentation, read by the tools that they are for, say what the hardware's table of cases says.
#[test]
fn header_constants_and_documentation_are_the_hardwares_map() {
    let pipeline = small("vuris", |_| {});
    let files = artifacts(&pipeline);
    let hardware: Vec<(u32, String)> = files["rtl/vuris_registers.v"]
        .lines()
        .filter_map(|line| {
            let (label, rest) = line.trim().strip_prefix("4'd")?.split_once(": read_")?;
            Some((4 * label.parse::<u32>().unwrap(), rest.split_once("// ")?.1.to_owned()))
        })
        .collect();
    assert_eq!(hardware.len(), 13);
    let folder = tempfile::tempdir().unwrap();
    for (path, name) in
        [("software/vuris_registers.h", "registers.h"), ("software/vuris_registers.rs", "registers.rs")]
    {
        std::fs::write(folder.path().join(name), &files[path]).unwrap();
    }
    let (mut c, mut rust) =
        ("#include <stdio.h>\n#include \"registers.h\"\nint main(void) {\n".to_owned(), String::new());
    rust += "mod registers { include!(\"registers.rs\"); }\nfn main() {\n";
    let mut expected = String::new();
    for (address, name) in &hardware {
        let upper = name.to_uppercase();
        c += &format!("  printf(\"%u\\n\", VURIS_{upper}_OFFSET);\n");
        rust += &format!("  println!(\"{{}}\", registers::{upper}_OFFSET);\n");
        expected += &format!("{address}\n");
        let row = format!("| 0x{address:02x} | {name} | ");
        assert!(files["software/registers.md"].contains(&row), "{row}");
    }
    c += "  printf(\"%x %llx\\n\", VURIS_IDENTIFICATION_VALUE, VURIS_SPECIFICATION_HASH);\n  return 0;\n}\n";
    rust += "  println!(\"{:x} {:x}\", registers::IDENTIFICATION_VALUE, registers::SPECIFICATION_HASH);\n";
    rust += "  assert_eq!(registers::VERSION_VALUE.leading_zeros() / 8, 2);\n}\n";
    expected += &format!("56555253 {:x}\n", pipeline.hash());
    std::fs::write(folder.path().join("c.c"), c).unwrap();
    std::fs::write(folder.path().join("rust.rs"), rust).unwrap();
    for (program, arguments) in [
        ("cc", ["-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror", "c.c", "-o", "c"].as_slice()),
        ("rustc", ["--edition", "2024", "-D", "warnings", "rust.rs", "-o", "rust"].as_slice()),
    ] {
        let status = Command::new(program).current_dir(folder.path()).args(arguments).status();
        assert!(status.unwrap_or_else(|error| panic!("{program}: {error}")).success(), "{program}");
        assert_eq!(
            piped(folder.path().join(arguments[arguments.len() - 1]).to_str().unwrap(), &[], ""),
            expected
        );
    }
}

/// Accesses beside a stream, by hand: every one of them is answered and compared, a write's answer as one value, a read's as two.
#[test]
fn every_access_is_answered_in_both_simulators() {
    let pipeline = small("vuris", |_| {});
    let mut events = vec![StreamEvent::Rest];
    let accesses: Vec<StreamEvent> = (0..40)
        .map(|number| match number % 4 {
            0 => Access::Write { address: 0x30, data: 0x0101_0101 * number, strobes: number / 4 },
            1 => read(0x30),
            _ => read(4 * (number % 14)),
        })
        .map(StreamEvent::Access)
        .collect();
    events.extend(accesses);
    let segments = vec![
        Segment::of_sets("a set", &random_sets(&pipeline, 1, 1)),
        Segment { name: "accesses".to_owned(), events },
    ];
    let with = Golden::new(&pipeline, &Scenario { segments: segments.clone() });
    let without = Golden::new(&pipeline, &Scenario { segments: segments[..1].to_vec() });
    for simulator in Simulator::ALL {
        let run = |golden: &Golden, traffic| {
            let folder = tempfile::tempdir().unwrap();
            let source = Source { pipeline: &pipeline, spec: "test" };
            let outcome = simulate(&source, golden, simulator, traffic, folder.path(), &|_| {}).unwrap();
            assert_eq!(outcome.mismatches, 0, "{:?}", outcome.findings);
            outcome.values
        };
        let traffic = Traffic { seed: 3, pause_percent: 10, stop_percent: 60 };
        // One more rest of three counters, and the answers.
        assert_eq!(run(&with, traffic) - run(&without, traffic), 3 + 10 + 2 * 30, "{}", simulator.name());
    }
}
