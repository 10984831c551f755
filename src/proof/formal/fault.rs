//! Designs in which a property must fail, or the proof would prove nothing.

use crate::artifact::Artifact;
use crate::problem::{Problem, Result};

/// A fault that is seeded into the generated Verilog.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fault {
    /// What goes wrong.
    pub name: &'static str,
    /// The proof that must see it.
    pub proof: &'static str,
    /// The module's noun, or the whole name of a module that is not the camera's.
    pub noun: &'static str,
    /// The right text, there once.
    pub text: &'static str,
    /// What replaces it.
    pub instead: &'static str,
}

const fn fault(
    proof: &'static str,
    noun: &'static str,
    name: &'static str,
    text: &'static str,
    instead: &'static str,
) -> Fault {
    Fault { name, proof, noun, text, instead }
}

/// All of them.
pub const FAULTS: &[Fault] = &[
    fault("stream", "stream_register", "spare word lost", "spare_valid_q ? spare_q : data_i", "data_i"),
    fault("stream", "stream_register", "taken without room", "ready_o = !spare_valid_q", "ready_o = 1'b1"),
    fault("stream", "stream_register", "offered word changes", "if (!valid_q || ready_i) data_q", "data_q"),
    fault(
        "stream",
        "stream_register",
        "offer taken back",
        "if (!valid_q || ready_i) begin",
        "if (1'b1) begin",
    ),
    fault(
        "stream",
        "stream_register",
        "half the throughput",
        "ready_o = !spare_valid_q",
        "ready_o = !valid_q",
    ),
    fault("framing", "framing", "broken set goes on", "else if (fault) state_q <= LOST;", ""),
    fault("framing", "framing", "end of line not looked at", "&& end_of_line_i == last_column;", ";"),
    fault("framing", "framing", "start of set not looked at", "&& start_of_set_i == start", ""),
    fault(
        "framing",
        "framing",
        "silence a clock short",
        "LAST_SILENCE[SILENCE_BITS-1:0]",
        "LAST_SILENCE[SILENCE_BITS-1:0] - 1'b1",
    ),
    fault(
        "framing",
        "framing",
        "silence a clock long",
        "LAST_SILENCE[SILENCE_BITS-1:0]",
        "LAST_SILENCE[SILENCE_BITS-1:0] + 1'b1",
    ),
    fault(
        "framing",
        "framing",
        "one line too few",
        "LAST_ROW[ROW_BITS-1:0]",
        "LAST_ROW[ROW_BITS-1:0] - 1'b1",
    ),
    fault(
        "framing",
        "framing",
        "one step too few",
        "LAST_PLACE[PLACE_BITS-1:0]",
        "LAST_PLACE[PLACE_BITS-1:0] - 1'b1",
    ),
    fault("framing", "framing", "broken set not counted", " + {31'd0, fault}", ""),
    fault("framing", "framing", "abandoned set not counted", " + {31'd0, abandoned}", ""),
    fault("framing", "framing", "second frame overtakes the drain", "behind = first_frame && ", "behind = "),
    fault(
        "framing",
        "framing",
        "frame overtakes the drain by a pixel",
        "drain_address_i > {",
        "drain_address_i >= {",
    ),
    fault(
        "framing",
        "framing",
        "frame not held while sums drain",
        " || (in_set && drain_busy_i && !behind)",
        "",
    ),
    fault(
        "framing",
        "framing",
        "what is outside a set waits for the drain",
        "(in_set && drain_busy_i && !behind)",
        "(drain_busy_i && !behind)",
    ),
    fault("framing", "framing", "counter survives a reset", "      sets_discarded_q <= 32'd0;\n", ""),
    fault(
        "sums-1",
        "accumulator",
        "sums of the last set",
        "term_first_q      <= first_frame_i",
        "term_first_q      <= 1'b0",
    ),
    fault(
        "sums-1",
        "accumulator",
        "sums of a set that broke off",
        "    term_first_q      <= first_frame_i;\n",
        "    begin : broken\n      reg stale;\n      if (!rst_ni || drain_start_i) stale <= 1'b0;\n      \
         else if (take_i && !first_frame_i) stale <= 1'b1;\n      term_first_q <= first_frame_i && !stale;\n    end\n",
    ),
    fault(
        "sums-1",
        "accumulator",
        "saturation not sticky",
        "(saturated_before && !term_first_q) || saturated_term_q",
        "saturated_term_q",
    ),
    fault(
        "sums-1",
        "accumulator",
        "a sum a bit short",
        "? {GROUP_A_BITS{1'b0}} : group_a_before) + group_a_term_q",
        "? {GROUP_A_BITS{1'b0}} : group_a_before & {1'b0, {(GROUP_A_BITS-1){1'b1}}}) + group_a_term_q",
    ),
    fault(
        "sums-1",
        "accumulator",
        "one pixel too few drains",
        "PIXELS[ADDRESS_BITS:0]",
        "PIXELS[ADDRESS_BITS:0] + 1'b1",
    ),
    fault(
        "sums-1",
        "accumulator",
        "frame starts a pixel late",
        "read_first_q <= drain_address_q == {(ADDRESS_BITS+1){1'b0}}",
        "read_first_q <= drain_address_q == {{ADDRESS_BITS{1'b0}}, 1'b1}",
    ),
    fault("sums-1", "sum_memory", "sums that wait are read over", "if (read_i) read_0_q", "read_0_q"),
    fault(
        "sums-1",
        "sum_memory",
        "lowest bit not stored",
        "memory_0[write_address_i] <= write_data_i[17:0];",
        "memory_0[write_address_i] <= {write_data_i[17:1], 1'b0};",
    ),
    // "Offered word changes" is seen by `stream`, in clock 3; from the ports of the whole core it takes more than five minutes to find.
    fault(
        "pipeline",
        "pipeline",
        "free clock counted as stalled",
        "s_axis_tvalid && !s_axis_tready",
        "!s_axis_tready",
    ),
    fault("folded", "other_cordic", "a direction is lost", "directions_2[0] ^ sign_2}", "directions_2[0]}"),
    fault(
        "iterative",
        "other_angle",
        "a direction is lost",
        "direction = direction_q ^ sign",
        "direction = direction_q",
    ),
    fault("folded", "other_cordic", "a vector overwrites one in the ring", "advance_i && !back", "advance_i"),
    fault(
        "iterative",
        "other_angle",
        "a vector waits for a turn only once",
        "wait_valid_q <= valid_i || !ready_o;",
        "wait_valid_q <= valid_i;",
    ),
    fault("pipeline", "pipeline", "a bit between the fields", "5'd0,", "5'd1,"),
];

impl Fault {
    /// Seeds it into the files of the core with `prefix`.
    pub(super) fn seed(&self, prefix: &str, files: &mut [Artifact]) -> Result<()> {
        let path = format!("rtl/{prefix}_{}.v", self.noun);
        let path =
            if files.iter().any(|file| file.path == path) { path } else { format!("rtl/{}.v", self.noun) };
        let file =
            files.iter_mut().find(|file| file.path == path && file.text.matches(self.text).count() == 1);
        let file = file.ok_or_else(|| {
            Problem::at(&path, format_args!("does not hold {:?} once", self.text))
                .expected(format_args!("the place of the fault `{}`", self.name))
                .remedy("adapt src/proof/formal/fault.rs to the templates")
        })?;
        file.text = file.text.replace(self.text, self.instead);
        Ok(())
    }
}
