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
use vuris::hdl::{Golden, Scenario, Segment, Source, modules, rtl_artifacts};
use vuris::spec::{Pipeline, Throughput};

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
    ("delay", &[Fault("delay does not hold", "if (advance_i) begin", "begin")]),
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
            Fault(
                "lowest bit not stored",
                "memory_0[write_address_i] <= write_data_i[17:0];",
                "memory_0[write_address_i] <= {write_data_i[17:1], 1'b0};",
            ),
            Fault("sums that wait are read over", "if (read_i) read_1_q", "read_1_q"),
            Fault(
                "a column read from the next one's place",
                "read_data_o[40:36] = read_2_q",
                "read_data_o[40:36] = read_0_q[4:0]",
            ),
            Fault("last column not written", "if (write_i) memory_2", "if (1'b0) memory_2"),
        ],
    ),
    (
        "accumulator",
        &[
            Fault(
                "sign of a group",
                "(group_a_wide << 1) - group_b_wide",
                "(group_a_wide << 1) + group_b_wide",
            ),
            Fault(
                "group counted once too few",
                "in_phase_wide   = (group_a_wide << 1)",
                "in_phase_wide   = group_a_wide",
            ),
            Fault("weight shifted a place too few", "(group_b_sample << 1)", "group_b_sample"),
            Fault(
                "a sum of the pixel before",
                "offset_q     <= offset_wide",
                "if (valid_q) offset_q <= offset_wide",
            ),
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
                "read_first_q <= drain_address_q == {(ADDRESS_BITS+1){1'b0}}",
                "read_first_q <= drain_address_q == {{ADDRESS_BITS{1'b0}}, 1'b1}",
            ),
            Fault(
                "drain does not wait",
                "drain_busy_q && advance_i && !drain_end",
                "drain_busy_q && !drain_end",
            ),
            Fault(
                "drain survives a reset",
                "      drain_busy_q <= 1'b0;\n      read_valid_q",
                "      read_valid_q",
            ),
        ],
    ),
    (
        "angle",
        &[
            Fault("complement of a negative x forgotten", "x_raw ^ {BITS{x_i[X_BITS-1]}}", "x_raw"),
            Fault(
                "ones do not follow a complement",
                "{wait_y_q[BITS-2:0], wait_y_negative_q}",
                "{wait_y_q[BITS-2:0], 1'b0}",
            ),
            Fault(
                "a weak vector is not shifted to the top",
                "wait_top   = wait_x_q[BITS-1] | wait_y_q[BITS-1]",
                "wait_top   = wait_x_q[BITS-1] | wait_y_q[BITS-1] | wait_y_q[BITS-2]",
            ),
            Fault("shifts end a place early", "wait_shift_q == 4'd15", "wait_shift_q == 4'd14"),
            Fault(
                "next vector starts while the result waits",
                "leave = done && (!result_valid_q || ready_i)",
                "leave = done",
            ),
            Fault("vector taken without room", "ready_o = !wait_valid_q || start", "ready_o = 1'b1"),
            Fault("one iteration too few", "count_q == 5'd20", "count_q == 5'd19"),
            Fault("x follows an iteration too few", "count_q <= 5'd9)", "count_q <= 5'd8)"),
            Fault("carry of the rounding dropped", "x_q + grown + carry", "x_q + grown"),
            Fault("sign forgotten in |y|", "^ {(TURN_Y_BITS-1){sign}}", ""),
            Fault("lowest bit of y not repeated", "{magnitude, magnitude[0]} -", "{magnitude, 1'b0} -"),
            Fault("three times y is two and a half", "+ {2'd0, magnitude} +", "+ {3'd0, magnitude[23:1]} +"),
            Fault(
                "direction of the fold forgotten",
                "wait_x_negative_q ^ wait_y_negative_q : direction",
                "1'b0 : direction",
            ),
            Fault("directions do not add up", "direction = direction_q ^ sign", "direction = sign"),
            Fault("one angle of the table off by 1", "21'd36130", "21'd36131"),
            Fault(
                "angle added the wrong way",
                "else if (!direction && !done)",
                "else if (direction && !done)",
            ),
            Fault("fold's angle the wrong way", "direction ? 23'd", "!direction ? 23'd"),
            Fault(
                "half turn forgotten",
                "[ANGLE_BITS-1:ANGLE_BITS-1] + sector",
                "[ANGLE_BITS-1:ANGLE_BITS-1]",
            ),
            Fault("phase without a vector", "zero_q ? {PHASE_BITS{1'b0}} : turned_phase", "turned_phase"),
            Fault(
                "shift of the next vector",
                "result_shift_q  <= shift_q",
                "result_shift_q  <= wait_shift_q",
            ),
            Fault("result withdrawn", "(result_valid_q && !ready_i)", "1'b0"),
            Fault(
                "vector that waits survives a reset",
                "if (!rst_ni) wait_valid_q <= 1'b0;\n    else wait_valid_q",
                "wait_valid_q",
            ),
            Fault(
                "turn survives a reset",
                "if (!rst_ni) turning_q <= 1'b0;\n    else turning_q",
                "turning_q",
            ),
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
            Fault("no vector is usable", "result_usable = !result_zero", "result_usable = 1'b1"),
            Fault("code beyond full scale wraps", " | {12{above_range}}", ""),
            Fault("free clock counted as stalled", "s_axis_tvalid && !s_axis_tready", "!s_axis_tready"),
            Fault("pipeline does not wait", "advance = !result_valid || result_ready", "advance = 1'b1"),
            Fault("another flag counted as saturated", "(m_axis_tdata[81])", "(m_axis_tdata[80])"),
            Fault("flags a clock early", ".CLOCKS(2)\n  ) u_result_delay", ".CLOCKS(1)\n  ) u_result_delay"),
            Fault("sums that wait are lost", "sums_taken = !sums_valid || angle_ready", "sums_taken = 1'b1"),
        ],
    ),
];

/// Faults of the unrolled angle unit.
const FAST_FAULTS: &[Faults] = &[
    // Where a result comes with every clock, a reset always meets some of them.
    ("delay", &[Fault("delay survives a reset", "if (!rst_ni) valid_q <= {CLOCKS{1'b0}};", "")]),
    (
        "normaliser",
        &[
            Fault("ones do not follow a complement", "{x_0[6:0], {8{x_negative_0}}}", "{x_0[6:0], 8'd0}"),
            Fault("one coordinate not shifted", "y_next_2 = empty_2 ? y_shifted_2 : y_1", "y_next_2 = y_1"),
            Fault(
                "top of one coordinate not looked at",
                "~|(x_2[BITS-1:13] | y_2[BITS-1:13])",
                "~|x_2[BITS-1:13]",
            ),
            Fault("shift not counted", "shift_2 | {2'd0, empty_3, 1'd0}", "shift_2"),
            Fault(
                "sign of the pixel behind",
                "x_negative_1 <= x_negative_0",
                "x_negative_1 <= x_i[X_BITS-1]",
            ),
            Fault(
                "zero vector has a phase",
                "zero_o       = !x_4[BITS-1] && !y_4[BITS-1]",
                "zero_o       = 1'b0",
            ),
            Fault("normaliser survives a reset", "if (!rst_ni) valid_0 <= 1'b0;\n    else if", "if"),
        ],
    ),
    (
        "cordic",
        &[
            Fault("the complement's one forgotten", "{1'b0, y_kept, y_negative_i}", "{1'b0, y_kept, 1'b0}"),
            Fault("ones below x's complement forgotten", "{x_kept, {7{x_negative_i}}}", "{x_kept, 7'd0}"),
            Fault("y tripled without its one", " + {23'd0, y_negative_i}", ""),
            Fault("x without its one", "triple_0 + {23'd0, directions_0[1]}", "triple_0"),
            Fault("sign forgotten in |y|", "y_3[23:0] ^ {24{sign_4}}", "y_3[23:0]"),
            Fault(
                "carry of the rounding dropped",
                "{{1'd0, x_3[24:2]}, x_3[1]}",
                "{{1'd0, x_3[24:2]}, 1'b0}",
            ),
            Fault("triple is double", "triple_next_4 = {2'd0, magnitude_4} +", "triple_next_4 ="),
            Fault(
                "direction does not add up",
                "{directions_3, directions_3[0] ^ sign_4}",
                "{directions_3, sign_4}",
            ),
            Fault("an iteration does not hold", "if (advance_i) begin\n      x_4 <=", "begin\n      x_4 <="),
            Fault("an iteration survives a reset", "if (!rst_ni) valid_4 <= 1'b0;\n    else if", "if"),
        ],
    ),
    (
        "phase",
        &[
            Fault("one sum of a table off by 1", "19'd180090", "19'd180091"),
            Fault(
                "two directions of a table exchanged",
                "case (directions_i[11:8])",
                "case ({directions_i[11:10], directions_i[8], directions_i[9]})",
            ),
            Fault("row of the pixel behind", "row_1_1 <= row_1_0", "row_1_1 <= 19'd270348"),
            Fault("smallest table left out", "row_3_0 + {4'd0, row_4_0}", "row_3_0"),
            Fault(
                "half turn forgotten",
                "{beside_3[META_BITS+1:META_BITS+1], {2'd0, sum_3}}",
                "{3'd0, sum_3}",
            ),
            Fault("phase without a vector", "beside_3[META_BITS] ? {PHASE_BITS{1'b0}} : ", ""),
            Fault("sum does not hold", "if (advance_i) begin\n      sum_2", "begin\n      sum_2"),
            Fault("sum survives a reset", "if (!rst_ni) valid_q <= 5'd0;\n    else if", "if"),
        ],
    ),
    ("angle", &[Fault("pipeline does not wait", "advance = !valid_o || ready_i", "advance = 1'b1")]),
];

/// Faults of the ring of the folded angle unit: five stages, four rounds.
const FOLDED_FAULTS: &[Faults] = &[(
    "cordic",
    &[
        Fault(
            "vector taken into a place that is not free",
            "ready_o = advance_i && !back",
            "ready_o = advance_i",
        ),
        Fault("one round too few", "LAST_ROUND = 2'd3", "LAST_ROUND = 2'd2"),
        Fault("rounds not counted", "back ? round_4 + 2'd1", "back ? round_4"),
        Fault("round of a new vector not 0", ": 2'd0;\n      x_0", ": 2'd1;\n      x_0"),
        Fault("direction of the fold forgotten", "x_negative_i ^ y_negative_i}", "1'b0}"),
        Fault(
            "last direction forgotten",
            "directions_next_4[0] ^ y_next_4[Y_BITS-1]}",
            "directions_next_4[0]}",
        ),
        Fault("lowest bit of y not repeated", "{magnitude_2, magnitude_2[0]}", "{magnitude_2, 1'b0}"),
        Fault(
            "what travels along of another vector",
            "meta_0       <= back ? meta_4 : meta_i",
            "meta_0       <= meta_i",
        ),
        Fault("ring survives a reset", "if (!rst_ni) valid_2 <= 1'b0;\n    else if", "if"),
    ],
)];

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

/// The first mismatch is enough: the second one ends the run, and a run whose mismatches name no clock is not run again for its waveform.
fn to_the_first_mismatch(artifacts: &mut [Artifact]) {
    for artifact in artifacts.iter_mut().filter(|artifact| artifact.path.starts_with("tb/")) {
        let (name, before, after) = match artifact.path.ends_with(".cpp") {
            true => ("tb/harness.cpp", "kLimit = 10;", "kLimit = 1;"),
            false => ("tb/testbench.v", "LIMIT    = 10;", "LIMIT    = 1;"),
        };
        assert_eq!(artifact.text.matches(before).count(), usize::from(artifact.path == name), "{before}");
        artifact.text = artifact.text.replace(before, after).replace(" clock=%", " at=%");
    }
}

/// The mixtures of traffic of so many seeds. Some faults need one clock of a stop at one place, and so more seeds than one.
fn mixtures(seeds: u32) -> Vec<Traffic> {
    (1..=seeds).flat_map(Traffic::profiles).collect()
}

/// Runs the simulation under one mixture of traffic after the other, until something is found: what, and under which.
fn first_finding(
    pipeline: &Pipeline,
    golden: &Golden,
    simulator: Simulator,
    traffics: &[Traffic],
    fault: &dyn Fn(&mut Vec<Artifact>),
) -> Option<(Traffic, String)> {
    let folder = tempfile::tempdir().unwrap();
    let source = Source { pipeline, spec: "small" };
    let simulation = Simulation::build(source, golden, simulator, folder.path(), &|artifacts| {
        fault(artifacts);
        to_the_first_mismatch(artifacts);
    })
    .unwrap();
    traffics.iter().find_map(|&traffic| {
        let outcome = simulation.run(traffic).unwrap();
        assert_eq!(outcome.mismatches > 0, !outcome.findings.is_empty());
        outcome.findings.first().map(|finding| (traffic, finding.to_string()))
    })
}

/// The pipelines into which faults are seeded, and their faults.
fn subjects() -> [(Pipeline, &'static [Faults]); 4] {
    let folded = small("vuris", |specification| {
        specification.cordic.throughput = Throughput::CyclesPerPixel(4);
    });
    [
        (small("vuris", |_| {}), PRESET_FAULTS),
        (small("vuris-fast", |_| {}), FAST_FAULTS),
        (folded, FOLDED_FAULTS),
        (four_frame(), FOUR_FRAME_FAULTS),
    ]
}

fn every_fault_is_seen_by(simulator: Simulator) {
    let mut seen = 0;
    for (pipeline, table) in subjects() {
        let golden = Golden::new(&pipeline, &everything(&pipeline, 1));
        for &(noun, faults) in table {
            let source = Source { pipeline: &pipeline, spec: "small" };
            for fault in faults {
                fault.seed(&pipeline.prefix(), noun, &mut rtl_artifacts(&source));
            }
        }
        let faults: Vec<(&str, &Fault)> =
            table.iter().flat_map(|&(noun, faults)| faults.iter().map(move |fault| (noun, fault))).collect();
        let findings = two_at_a_time(&faults, |&(noun, fault)| {
            first_finding(&pipeline, &golden, simulator, &mixtures(10), &|artifacts| {
                fault.seed(&pipeline.prefix(), noun, artifacts);
            })
        });
        // Where no fault is, nothing is found under any traffic under which one was.
        let mut traffics: Vec<Traffic> = findings.iter().flatten().map(|(traffic, _)| *traffic).collect();
        traffics.sort_by_key(|traffic| (traffic.seed, traffic.pause_percent, traffic.stop_percent));
        traffics.dedup();
        println!("found under {} mixtures of traffic", traffics.len());
        let halves: Vec<&[Traffic]> = traffics.chunks(traffics.len().div_ceil(2).max(1)).collect();
        let clean =
            two_at_a_time(&halves, |half| first_finding(&pipeline, &golden, simulator, half, &|_| {}));
        assert!(clean.iter().all(Option::is_none), "without a fault: {clean:?}");
        let mut missed = Vec::new();
        for (&(noun, Fault(name, ..)), finding) in faults.iter().zip(findings) {
            println!("{noun}: {name}: {}", finding.as_ref().map_or("NOT SEEN", |(_, finding)| finding));
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
    let faulty = |noun: &str| {
        subjects().iter().any(|(_, table)| table.iter().any(|&(of, faults)| of == noun && !faults.is_empty()))
    };
    for (pipeline, _) in subjects() {
        for noun in modules(&pipeline).into_iter().map(|(noun, _)| noun).chain(["pipeline"]) {
            assert!(faulty(noun), "{noun}");
        }
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
    let first_sums = first_beat + 432 + 3;
    let second_commit = first_sums - 1 + 432 + 64;
    let sums = second_commit + 3 + row * width + column;
    // Input 1; 12 bits take shifts by 8, 4, 2, 1; iterations 0 to 18; the last direction 1; five tables 5. Then distance 2,
    // output 1.
    let angle = sums + 1 + 4 + 19 + 1 + 5;
    let (distance, output) = (angle + 2, angle + 2 + 1);

    // -5 is half a turn away from 5. Half the range: 299792458 m/s / (2 * 30 MHz) / 2 = 249827.05 * 10 um.
    let half_turn = "expected 100000000000000000 (131072), actual 000000000000000000 (0)";
    let half_range = "expected 0111100111111100011 (249827), actual 0000000000000000000 (0)";
    let five = "expected 1111111111011 (-5), actual 0000000000101 (5)";
    let expected = [
        ("accumulator, in_phase", sums, five),
        ("angle, phase", angle, half_turn),
        ("results, distance", distance, half_range),
        ("output, phase", output, half_turn),
        ("output, distance", output, half_range),
    ]
    .map(|(stage, clock, values)| {
        format!("stage {stage}: result set 1 (a flash, set 1), pixel row 2 column 5, clock cycle {clock}: {values}")
    });

    let pipeline = small("vuris-four-frame", |specification| {
        specification.cordic.throughput = Throughput::CyclesPerPixel(1);
    });
    let raw = RawSets::new(pipeline.geometry(), frames, codes).unwrap();
    let golden = Golden::new(&pipeline, &Scenario { segments: vec![Segment::of_sets("a flash", &raw)] });
    let source = Source { pipeline: &pipeline, spec: "small" };
    let fault = Fault("sign of a weight", "-in_phase_sample", "in_phase_sample");
    for simulator in Simulator::ALL {
        let folder = tempfile::tempdir().unwrap();
        let traffic = Traffic { seed: 1, pause_percent: 0, stop_percent: 0 };
        let outcome = simulate(&source, &golden, simulator, traffic, folder.path(), &|artifacts| {
            fault.seed(&pipeline.prefix(), "accumulator", artifacts);
        })
        .unwrap();
        let told: Vec<String> = outcome.findings.iter().map(ToString::to_string).collect();
        assert_eq!(told, expected, "{}", simulator.name());
        assert_eq!(outcome.mismatches, expected.len() as u64);

        let (from, to, signals) = waveform(&outcome.waveform.unwrap());
        println!("{}: waveform of clocks {from} to {to}, {signals} signals", simulator.name());
        assert!(from < sums as u64 - 100 && to > output as u64 + 100, "{from} to {to}");
        assert!(signals > 500, "{signals} signals");
    }
}
