//! Does an outside user find what the package promises? `tb/cocotb` drives the generated core from Python, against numpy in
//! double precision, knowing only what `vuris generate` has written into its folder.
//!
//! Chain of trust: this shares neither model nor golden vectors nor benches with `cosim.rs`. The bounds, latencies, reset values and
//! timing diagrams that it holds the core to are those that the package states.

mod support;

use std::path::Path;
use support::{hdl_tool, said, small, two_at_a_time};
use vuris::artifact::{self, Artifact};
use vuris::hdl::{Golden, Scenario, Source, all_artifacts};
use vuris::package::package_artifacts;
use vuris::spec::{Pipeline, Throughput};

/// Everything that `vuris generate` writes for `pipeline`, without stimulus.
fn artifacts(pipeline: &Pipeline) -> Vec<Artifact> {
    let source = Source { pipeline, spec: "test" };
    let mut files = all_artifacts(&source, &Golden::new(pipeline, &Scenario::default()));
    files.extend(package_artifacts(&source, &files, &[]));
    files
}

/// Runs all tests, in Icarus, on a core of `files`: whether they pass, and what was said.
fn run(files: &[Artifact], seed: u32) -> (bool, String) {
    let folder = tempfile::tempdir().unwrap();
    artifact::write(folder.path(), files).unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tb/cocotb/run.py");
    let mut command = hdl_tool("python", "cocotb", folder.path());
    said(command.arg("-B").arg(script).args([".", "--seed", &seed.to_string()]))
}

#[test]
fn the_core_keeps_what_its_package_promises() {
    let pipelines = [
        small("vuris-fast", |_| {}),
        small("vuris", |specification| {
            (specification.sensor.width, specification.sensor.height) = (5, 4);
            specification.cordic.throughput = Throughput::CyclesPerPixel(5);
        }),
        small("vuris-four-frame", |specification| {
            (specification.sensor.width, specification.sensor.height) = (4, 2);
            specification.sensor.adc_bits = 10;
            specification.sensor.line_blanking_clocks = 16;
        }),
        small("vuris", |specification| {
            (specification.sensor.adc_bits, specification.sensor.saturation_dn) = (16, 60_000);
            specification.modulation.frames_per_step = 2;
            specification.output.minimum_amplitude_dn = 500.0;
        }),
    ];
    let results = two_at_a_time(&pipelines, |pipeline| run(&artifacts(pipeline), 7));
    for (pipeline, (success, said)) in pipelines.iter().zip(results) {
        assert!(success, "{said}\n{}", pipeline.to_toml());
        println!("{}", said.lines().last().unwrap());
    }
}

/// What is broken, in which file: text that is there, and what stands there instead.
type Fault = (&'static str, &'static str, &'static str, &'static str);

const FAULTS: [Fault; 12] = [
    ("markers swapped", "_pipeline.v", "({result_first, result_last,", "({result_last, result_first,"),
    ("a stopped word is lost", "_stream_register.v", "spare_valid_q <= 1'b1;", "spare_valid_q <= 1'b0;"),
    ("full scale is not saturated", "_accumulator.v", "sample_i >= SATURATION", "sample_i > SATURATION"),
    ("a code beyond full scale wraps", "_pipeline.v", "| {12{above_range}}", "| {12{above_range && 1'b0}}"),
    (
        "sums are never replaced",
        "_accumulator.v",
        "term_first_q      <= first_frame_i;",
        "term_first_q <= 1'b0;",
    ),
    (
        "broken sets go on",
        "_framing.v",
        "else if (fault) state_q <= LOST;",
        "else if (fault) state_q <= state_q;",
    ),
    (
        "a drain is overtaken",
        "_framing.v",
        "commit_by_frame || (in_set && drain_busy_i && !behind)",
        "commit_by_frame",
    ),
    ("a counter starts at 1", "_framing.v", "sets_discarded_q <= 32'd0;", "sets_discarded_q <= 32'd1;"),
    (
        "a set ends a clock early",
        "_framing.v",
        "LAST_SILENCE[SILENCE_BITS-1:0];",
        "LAST_SILENCE[SILENCE_BITS-1:0] - 1'b1;",
    ),
    (
        "a diagram draws a stop a clock short",
        "timing-next-set.json",
        "\"wave\": \"1....0.1",
        "\"wave\": \"1....01.",
    ),
    (
        "a diagram draws a result a clock late",
        "timing-set.json",
        "\"wave\": \"0.....|..|10|",
        "\"wave\": \"0.....|..|.1|",
    ),
    ("a port has another width", "explanation.json", "\"bits\": 88", "\"bits\": 80"),
];

#[test]
fn a_broken_core_or_promise_is_found() {
    let pipeline = small("vuris", |specification| {
        (specification.sensor.width, specification.sensor.height) = (4, 3);
    });
    let good = artifacts(&pipeline);
    let mut broken: Vec<(&str, Vec<Artifact>)> = Vec::new();
    for (what, path, old, new) in FAULTS {
        let mut files = good.clone();
        let file = files.iter_mut().find(|file| file.path.ends_with(path)).unwrap();
        assert!(file.text.contains(old), "{what}: {path} has no {old}");
        file.text = file.text.replacen(old, new, 1);
        broken.push((what, files));
    }
    // Bounds and times that the core does not keep.
    let phase = pipeline.budget().phase_codes();
    for (what, old, new) in [
        (
            "a bound is half as large",
            format!("\"codes\": {phase:?}"),
            format!("\"codes\": {:?}", phase / 2.0),
        ),
        (
            "a latency is too short",
            "silence_to_first_result_clocks\": 9".to_owned(),
            "silence_to_first_result_clocks\": 8".to_owned(),
        ),
    ] {
        let mut files = good.clone();
        let file = files.iter_mut().find(|file| file.path.ends_with("explanation.json")).unwrap();
        assert!(file.text.contains(&old), "{what}: {old}");
        file.text = file.text.replacen(&old, &new, 1);
        broken.push((what, files));
    }
    let results = two_at_a_time(&broken, |(_, files)| run(files, 7));
    for ((what, _), (success, said)) in broken.iter().zip(results) {
        assert!(!success, "nothing is found where {what}:\n{said}");
        let failed = said.lines().last().unwrap_or("");
        assert!(failed.contains(" failed"), "{what} breaks the tests themselves:\n{said}");
        println!("{what}: {failed}");
    }
}
