//! Can the benches fail? Faults are seeded into the generated Verilog, one at a time, and both benches must see each.
//!
//! Chain of trust: `accuracy.rs` shows that the model is right, `cosim.rs` that the Verilog agrees with it; this file shows
//! that the agreement means something, and that a disagreement is told as it is.

mod support;

use std::path::Path;
use support::{everything, small, two_at_a_time};
use vuris::artifact::Artifact;
use vuris::cosim::{Simulation, Simulator, Traffic, simulate};
use vuris::frames::RawSets;
use vuris::hdl::{Golden, MODULES, Scenario, Segment, Source, rtl_artifacts};
use vuris::spec::Pipeline;

/// What goes wrong; the right text, which must be there exactly once; what replaces it.
struct Fault(&'static str, &'static str, &'static str);

/// A module's noun, and its faults.
type Faults = (&'static str, &'static [Fault]);

/// Faults of the preset `vuris`.
const PRESET_FAULTS: &[Faults] = &[
    (
        "stream_register",
        &[
            Fault("spare word lost", "spare_valid_q ? spare_q : data_i", "data_i"),
            Fault("word taken while there is no room", "ready_o = !spare_valid_q", "ready_o = 1'b1"),
            Fault("offered word changes", "if (!valid_q || ready_i) data_q", "data_q"),
            Fault("word survives a reset", "      valid_q       <= 1'b0;\n", ""),
        ],
    ),
    (
        "delay",
        &[
            Fault("delay does not hold", "if (advance_i) begin", "begin"),
            Fault("delay survives a reset", "if (!rst_ni) valid_q <= {CLOCKS{1'b0}};", ""),
        ],
    ),
    (
        "framing",
        &[
            Fault("one step too few", "LAST_PLACE[PLACE_BITS-1:0]", "LAST_PLACE[PLACE_BITS-1:0] - 1'b1"),
            Fault("one line too few", "LAST_ROW[ROW_BITS-1:0]", "LAST_ROW[ROW_BITS-1:0] - 1'b1"),
            Fault("silence ends no set", "commit_by_frame || commit_by_pause", "commit_by_frame"),
            Fault(
                "silence a clock short",
                "LAST_SILENCE[SILENCE_BITS-1:0]",
                "LAST_SILENCE[SILENCE_BITS-1:0] - 1'b1",
            ),
            Fault(
                "silence a clock long",
                "LAST_SILENCE[SILENCE_BITS-1:0]",
                "LAST_SILENCE[SILENCE_BITS-1:0] + 1'b1",
            ),
            Fault("any frame ends a set", "commit_by_frame = closing &&", "commit_by_frame = state_q[1] &&"),
            Fault("broken set goes on", "else if (fault) state_q <= LOST;", ""),
            Fault("broken set not counted", " + {31'd0, fault}", ""),
            Fault("abandoned set not counted", " + {31'd0, abandoned}", ""),
            Fault("lost core counts every beat", "(start || state_q != LOST)", "1'b1"),
            Fault("end of line not looked at", "&& end_of_line_i == last_column;", ";"),
            Fault("start of set not looked at", "&& start_of_set_i == start", ""),
            Fault(
                "start of frame not looked at",
                "start_of_frame_i == (column == {COLUMN_BITS{1'b0}} && row == {ROW_BITS{1'b0}})",
                "1'b1",
            ),
            Fault("frame not held while sums drain", " || (in_set && drain_busy_i && !behind)", ""),
            Fault("frame not held while a set commits", "hold   = commit_by_frame || (", "hold   = ("),
            Fault("frame overtakes the drain by a pixel", "drain_address_i > {", "drain_address_i >= {"),
            Fault("second frame overtakes the drain", "behind = first_frame && ", "behind = "),
            Fault("state survives a reset", "state_q          <= LOST;\n      silence_q", "silence_q"),
            Fault("counter survives a reset", "      sets_discarded_q <= 32'd0;\n", ""),
            Fault(
                "frame out of place calls for the next",
                "take && start_of_frame_i;",
                "accept && start_of_frame_i;",
            ),
            Fault("lost set calls for nothing", "lost_o           = fault", "lost_o           = 1'b0"),
        ],
    ),
    (
        "sequencer",
        &[
            Fault("step of the next frame", "step_at(place_i)", "step_at(next_place_i)"),
            Fault("lost set is told without a strobe", "<= frame_i || lost_i;", "<= frame_i;"),
            Fault("lost set does not call for a first frame", "<= lost_i || next_first_i", "<= next_first_i"),
            Fault("lost set goes on", "lost_i ? {STEP_BITS{1'b0}} : next_place_i", "next_place_i"),
            Fault("told what was told before", "if (frame_i || lost_i) begin", "if (next_strobe_q) begin"),
            Fault("phase cut off instead of rounded", "16'd43691", "16'd43690"),
            Fault("what is told survives a reset", "      next_first_q  <= 1'b1;\n", ""),
        ],
    ),
    (
        "sum_memory",
        &[
            Fault("lowest bit not stored", "<= write_data_i;", "<= {write_data_i[WORD_BITS-1:1], 1'b0};"),
            Fault("sums that wait are read over", "if (read_i) read_data_q", "read_data_q"),
        ],
    ),
    (
        "accumulator",
        &[
            Fault(
                "sign of a weight",
                "-(sample_quadrature + (sample_quadrature << 1))",
                "sample_quadrature + (sample_quadrature << 1)",
            ),
            Fault("weight shifted a place too few", "(sample_in_phase << 2)", "(sample_in_phase << 1)"),
            Fault("weights of two steps swapped", "case (step_i)", "case (step_i ^ 3'd1)"),
            Fault("saturation a code late", "sample_i >= SATURATION", "sample_i > SATURATION"),
            Fault(
                "saturation not sticky",
                "(saturated_before && !term_first_q) || saturated_term_q",
                "saturated_term_q",
            ),
            Fault("saturation of the last set", "saturated_before && !term_first_q", "saturated_before"),
            Fault("sums of the last set", "term_first_q      <= first_frame_i", "term_first_q      <= 1'b0"),
            Fault("one pixel too few drains", "PIXELS[ADDRESS_BITS:0]", "PIXELS[ADDRESS_BITS:0] - 1'b1"),
            Fault(
                "line ends a pixel early",
                "LAST_COLUMN[COLUMN_BITS-1:0]",
                "LAST_COLUMN[COLUMN_BITS-1:0] - 1'b1",
            ),
            Fault(
                "frame starts a pixel late",
                "first_q <= drain_address_q == {(ADDRESS_BITS+1){1'b0}}",
                "first_q <= drain_address_q == {{ADDRESS_BITS{1'b0}}, 1'b1}",
            ),
            Fault(
                "drain does not wait",
                "drain_busy_q && advance_i && !drain_end",
                "drain_busy_q && !drain_end",
            ),
            Fault("drain survives a reset", "      drain_busy_q <= 1'b0;\n      valid_q", "      valid_q"),
        ],
    ),
    (
        "scaling",
        &[
            Fault("factor one too large", "26'sd780", "26'sd781"),
            Fault(
                "sum extended without its sign",
                "{(X_BITS-IN_PHASE_BITS){in_phase_i[IN_PHASE_BITS-1]}}",
                "{(X_BITS-IN_PHASE_BITS){1'b0}}",
            ),
        ],
    ),
    (
        "shift_stage",
        &[
            Fault("one coordinate shifted a place less", "minor_i << PLACES", "minor_i << (PLACES - 1)"),
            Fault("shift not counted", "shift_i | THIS_STAGE", "shift_i"),
        ],
    ),
    (
        "normaliser",
        &[
            Fault("magnitude as one's complement", " + {{(X_BITS-2){1'b0}}, x_i[X_BITS-1]}", ""),
            Fault(
                "smaller coordinate not swapped",
                "swapped ? x_magnitude_q : y_magnitude_q",
                "y_magnitude_q",
            ),
            Fault(
                "signs exchanged",
                "swapped, y_negative_q, x_negative_q",
                "swapped, x_negative_q, y_negative_q",
            ),
            Fault("vector cut off instead of rounded", "minor_kept + minor_carry", "minor_kept"),
        ],
    ),
    (
        "cordic_stage",
        &[
            Fault("shift without sign", ">>> (PLACES - 1)", ">> (PLACES - 1)"),
            Fault("carry of the rounding dropped", "x_i[PLACES-1] ^ !negative", "!negative"),
            Fault(
                "angle added the wrong way",
                "STEP ^ {ANGLE_BITS{negative}}",
                "STEP ^ {ANGLE_BITS{!negative}}",
            ),
            Fault("iteration does not hold", "if (advance_i) begin", "begin"),
        ],
    ),
    (
        "cordic",
        &[
            Fault("one angle of the table off by 1", "(23'd41718)", "(23'd41719)"),
            Fault("one iteration by the next one's shift", ".PLACES(7)", ".PLACES(8)"),
        ],
    ),
    (
        "phase",
        &[
            Fault(
                "octant counted from the wrong axis",
                "swapped ? octant_q[1] : octant_q[0]",
                "swapped ? octant_q[0] : octant_q[1]",
            ),
            Fault(
                "octant counted backwards",
                "backwards = ^octant_q",
                "backwards = octant_q[2] ^ octant_q[0]",
            ),
            Fault("phase cut off instead of rounded", "kept + carry", "kept"),
            Fault("phase without a vector", "zero_q ? {PHASE_BITS{1'b0}} : turned", "turned"),
        ],
    ),
    (
        "amplitude",
        &[
            Fault("shifted a place too far", "6'd25", "6'd26"),
            Fault("amplitude cut off instead of rounded", "shifted[0]}", "1'b0}"),
        ],
    ),
    (
        "registers",
        &[
            Fault("a constant off by 1", "= 32'h0000000c;  // width", "= 32'h0000000d;  // width"),
            Fault("two counters exchanged", "= sets_done_i;", "= sets_discarded_i;"),
            Fault("counter of another clock", "= stall_clocks_i;", "= stall_clocks_i + 32'd1;"),
            Fault("every result is saturated", "delivered_i && delivered_saturated_i", "delivered_i"),
            Fault(
                "saturated pixel counted while it waits",
                "delivered_i && delivered_saturated_i",
                "delivered_saturated_i",
            ),
            Fault("set counted while it waits", "delivered_i && delivered_first_i", "delivered_first_i"),
            Fault("missing register is there", "4'd13: read_known_d = 1'b0;", ""),
            Fault("register beyond the map", "read_block && read_known_d", "read_known_d"),
            Fault(
                "registers repeat beyond the map",
                "read_block ? read_constant_d | read_variable_d : 32'd0",
                "read_constant_d | read_variable_d",
            ),
            Fault("write to what is only read succeeds", "write_okay ? OKAY : SLVERR", "OKAY"),
            Fault("any register is the one", "write && write_frequency_factor", "write"),
            Fault("bytes not looked at", "if (w_strobes_q[2]) frequency", "frequency"),
            Fault("two bytes exchanged", "[15:8] <= w_data_q[15:8]", "[15:8] <= w_data_q[23:16]"),
            Fault("write without its data", "aw_valid_q && w_valid_q &&", "aw_valid_q &&"),
            Fault("write without its address", "aw_valid_q && w_valid_q &&", "w_valid_q &&"),
            Fault("answer lost", " && (!b_valid_q || bready_i)", ""),
            Fault("write's answer withdrawn", "else if (bready_i)", "else"),
            Fault("read's answer withdrawn", "else if (rready_i)", "else"),
            Fault("read's answer changes", "if (!r_valid_q) begin", "begin"),
            Fault("address taken that is not offered any more", "if (!aw_valid_q) aw_word_q", "aw_word_q"),
            Fault("data taken that are not offered any more", "if (!w_valid_q) begin", "begin"),
            Fault("read taken while there is no room", "arready_o = !r_valid_q", "arready_o = 1'b1"),
            Fault("setting survives a reset", "<= 32'h0000001e;", "<= frequency_factor_q;"),
            Fault("count survives a reset", "      saturated_pixels_q <= 32'd0;\n", ""),
            Fault("answer survives a reset", "      b_valid_q          <= 1'b0;\n", ""),
            Fault("read survives a reset", "      r_valid_q          <= 1'b0;\n", ""),
            Fault("half a write survives a reset", "      aw_valid_q         <= 1'b0;\n", ""),
        ],
    ),
    ("offset", &[Fault("factor one too large", "33'd233017", "33'd233018")]),
    ("distance", &[Fault("factor one too large", "40'd3997233", "40'd3997234")]),
    (
        "pipeline",
        &[
            Fault("no vector is usable", "polar_usable = !polar_zero", "polar_usable = 1'b1"),
            Fault("code beyond full scale wraps", " | {12{above_range}}", ""),
            Fault("free clock counted as stalled", "s_axis_tvalid && !s_axis_tready", "!s_axis_tready"),
            Fault("pipeline does not wait", "advance = !result_valid || result_ready", "advance = 1'b1"),
            Fault("another flag counted as saturated", "(m_axis_tdata[81])", "(m_axis_tdata[80])"),
            Fault("flags a clock early", ".CLOCKS(2)\n  ) u_polar_delay", ".CLOCKS(1)\n  ) u_polar_delay"),
        ],
    ),
];

/// Faults of what the preset has no use for: several frames a step, another order of the steps, and a least amplitude.
const FOUR_FRAME_FAULTS: &[Faults] = &[
    (
        "framing",
        &[
            Fault(
                "one frame a step too few",
                "LAST_REPEAT[REPEAT_BITS-1:0]",
                "LAST_REPEAT[REPEAT_BITS-1:0] - 1'b1",
            ),
            Fault("each frame of the first step is first", " && repetition == {REPEAT_BITS{1'b0}};", ";"),
            Fault(
                "each frame of the last step calls for a first",
                "= last_repeat && last_place;",
                "= last_place;",
            ),
            Fault("each frame calls for the next step", "!last_repeat ? place : last_place", "last_place"),
        ],
    ),
    (
        "sequencer",
        &[
            Fault("two steps of the order exchanged", "2'd0: step_at = 2'd2", "2'd0: step_at = 2'd3"),
            Fault("order begins with step 0", "next_step_q   <= 2'd2", "next_step_q   <= 2'd0"),
            Fault("phase of the place", "phase_of(step)", "phase_of(next_place_i)"),
        ],
    ),
    ("pipeline", &[Fault("least amplitude is too weak", "amplitude >= 16'd8", "amplitude > 16'd8")]),
];

/// The specification of `FOUR_FRAME_FAULTS`: 0.5 DN is what a sum of 2 codes in 2 frames gives, which weak pixels meet.
fn four_frame() -> Pipeline {
    small("vuris-four-frame", |specification| {
        specification.modulation.frames_per_step = 2;
        specification.modulation.order = Some(vec![2, 0, 3, 1]);
        specification.output.minimum_amplitude_dn = 0.5;
    })
}

impl Fault {
    fn seed(&self, prefix: &str, noun: &str, artifacts: &mut [Artifact]) {
        let &Self(name, text, instead) = self;
        let path = format!("rtl/{prefix}_{noun}.v");
        let file = artifacts.iter_mut().find(|artifact| artifact.path == path).expect(&path);
        assert_eq!(file.text.matches(text).count(), 1, "fault `{name}`: {text:?} in {path}");
        file.text = file.text.replace(text, instead);
    }
}

/// A run whose mismatches name no clock is not run again for its waveform, which would take most of the time.
fn without_waveform(artifacts: &mut [Artifact]) {
    for artifact in artifacts.iter_mut().filter(|artifact| artifact.path.starts_with("tb/")) {
        artifact.text = artifact.text.replace(" clock=%", " at=%");
    }
}

/// Runs the simulation under the mixtures of traffic that it uses, until something is found. Some
/// faults need one clock of a stop at one place, and so more seeds than one.
fn first_finding(
    pipeline: &Pipeline,
    golden: &Golden,
    simulator: Simulator,
    seeds: std::ops::RangeInclusive<u32>,
    fault: &dyn Fn(&mut Vec<Artifact>),
) -> Option<String> {
    let folder = tempfile::tempdir().unwrap();
    let source = Source { pipeline, spec: "small" };
    let simulation = Simulation::build(source, golden, simulator, folder.path(), &|artifacts| {
        fault(artifacts);
        without_waveform(artifacts);
    })
    .unwrap();
    seeds.flat_map(Traffic::profiles).find_map(|traffic| {
        let outcome = simulation.run(traffic).unwrap();
        assert_eq!(outcome.mismatches > 0, !outcome.findings.is_empty());
        outcome.findings.first().map(ToString::to_string)
    })
}

fn every_fault_is_seen_by(simulator: Simulator) {
    let mut seen = 0;
    for (pipeline, table) in [(small("vuris", |_| {}), PRESET_FAULTS), (four_frame(), FOUR_FRAME_FAULTS)] {
        let golden = Golden::new(&pipeline, &everything(&pipeline, 1));
        for &(noun, faults) in table {
            let source = Source { pipeline: &pipeline, spec: "small" };
            for fault in faults {
                fault.seed(&pipeline.prefix(), noun, &mut rtl_artifacts(&source));
            }
        }
        let clean = first_finding(&pipeline, &golden, simulator, 1..=1, &|_| {});
        assert_eq!(clean, None, "without a fault");
        let faults: Vec<(&str, &Fault)> =
            table.iter().flat_map(|&(noun, faults)| faults.iter().map(move |fault| (noun, fault))).collect();
        let findings = two_at_a_time(&faults, |&(noun, fault)| {
            first_finding(&pipeline, &golden, simulator, 1..=4, &|artifacts| {
                fault.seed(&pipeline.prefix(), noun, artifacts);
            })
        });
        let mut missed = Vec::new();
        for (&(noun, Fault(name, ..)), finding) in faults.iter().zip(findings) {
            println!("{noun}: {name}: {}", finding.as_deref().unwrap_or("NOT SEEN"));
            if finding.is_none() {
                missed.push(format!("{noun}: {name}"));
            }
        }
        assert!(missed.is_empty(), "{} does not see: {missed:#?}", simulator.name());
        seen += faults.len();
    }
    println!("{}: {seen} faults seeded, {seen} seen", simulator.name());
}

#[test]
fn icarus_sees_every_fault() {
    every_fault_is_seen_by(Simulator::Icarus);
}

#[test]
fn verilator_sees_every_fault() {
    every_fault_is_seen_by(Simulator::Verilator);
}

#[test]
fn every_module_has_a_fault() {
    for noun in MODULES.iter().map(|module| module.noun).chain(["pipeline"]) {
        assert!(PRESET_FAULTS.iter().any(|&(of, faults)| of == noun && !faults.is_empty()), "{noun}");
    }
}

/// First clock (of 10 units), last clock and number of signals of a waveform: the header of an FST file is a block of type 0 and 329
/// bytes, which holds the times at 9 and 17, Euler's number at 25 to tell the byte order, and the signals at 49; each
/// following block its type and its length.
fn waveform(path: &Path) -> (u64, u64, u64) {
    let bytes = std::fs::read(path).unwrap();
    let word = |at: usize| <[u8; 8]>::try_from(&bytes[at..at + 8]).unwrap();
    let number = |at: usize| u64::from_be_bytes(word(at));
    assert_eq!((bytes[0], number(1), f64::from_ne_bytes(word(25))), (0, 329, std::f64::consts::E));
    let mut blocks = vec![0_usize];
    while let Some(&at) = blocks.last().filter(|&&at| at < bytes.len()) {
        blocks.push(at + 1 + number(at + 1) as usize);
    }
    assert_eq!(blocks.last(), Some(&bytes.len()), "the last block is cut short");
    (number(9) / 10, number(17) / 10, number(49))
}

/// All is dark but one pixel, in the second set, at row 2 and column 5, which sees 5 DN in the third frame. That frame's
/// in-phase weight is -1, and the fault takes its sign away. Nothing below is computed: it is worked out by hand.
#[test]
fn a_mismatch_is_told_with_place_clock_and_both_values_and_leaves_a_waveform() {
    let (width, pixels, frames) = (12, 108, 4);
    let (row, column) = (2, 5);
    let mut codes = vec![0; 2 * frames * pixels];
    codes[(frames + 2) * pixels + row * width + column] = 5;

    // In reset for clocks 1 to 4, offered in 5, in the input's register in 6, the first pixel is taken in clock 7. The
    // first set's 432nd in 438; the second set's start commits the first in 439, whose sums come out from 441 on: from
    // then on, the second set's beats are taken. After the last of them, 64 clocks of silence are a pause, and one more
    // commits it.
    let first_beat = 7;
    let first_sums = first_beat + 432 + 2;
    let second_commit = first_sums + 432 + 64;
    let sums = second_commit + 2 + row * width + column;
    // Scaling 1; magnitudes and swap 2; 12 bits take shifts by 8, 4, 2, 1; 20 iterations; phase 2; distance 2; output 1.
    let (vector, polar) = (sums + 1, sums + 1 + 2 + 4 + 20 + 2);
    let (distance, output) = (polar + 2, polar + 2 + 1);
    assert_eq!((sums, output), (968, 1000));

    // -5 is half a turn away from 5. Half the range: 299792458 m/s / (2 * 30 MHz) / 2 = 249827.05 * 10 um.
    let half_turn = "expected 100000000000000000 (131072), actual 000000000000000000 (0)";
    let half_range = "expected 0111100111111100011 (249827), actual 0000000000000000000 (0)";
    let five = "expected 1111111111011 (-5), actual 0000000000101 (5)";
    let expected = [
        ("accumulator, in_phase", sums, five),
        ("sums, x", vector, five),
        ("cordic, phase", polar, half_turn),
        ("distance, distance", distance, half_range),
        ("output, phase", output, half_turn),
        ("output, distance", output, half_range),
    ]
    .map(|(stage, clock, values)| {
        format!("stage {stage}: result set 1 (a flash, set 1), pixel row 2 column 5, clock cycle {clock}: {values}")
    });

    let pipeline = small("vuris-four-frame", |_| {});
    let raw = RawSets::new(pipeline.geometry(), frames, codes).unwrap();
    let golden = Golden::new(&pipeline, &Scenario { segments: vec![Segment::of_sets("a flash", &raw)] });
    let source = Source { pipeline: &pipeline, spec: "small" };
    let fault = Fault("sign of a weight", "-sample_in_phase", "sample_in_phase");
    for simulator in Simulator::ALL {
        let folder = tempfile::tempdir().unwrap();
        let traffic = Traffic { seed: 1, pause_percent: 0, stop_percent: 0 };
        let outcome = simulate(&source, &golden, simulator, traffic, folder.path(), &|artifacts| {
            fault.seed(&pipeline.prefix(), "accumulator", artifacts);
        })
        .unwrap();
        let told: Vec<String> = outcome.findings.iter().map(ToString::to_string).collect();
        assert_eq!(told, expected, "{}", simulator.name());
        assert_eq!(outcome.mismatches, 6);

        let (from, to, signals) = waveform(&outcome.waveform.unwrap());
        println!("{}: waveform of clocks {from} to {to}, {signals} signals", simulator.name());
        assert!(from < sums as u64 - 100 && to > output as u64 + 100, "{from} to {to}");
        assert!(signals > 500, "{signals} signals");
    }
}
