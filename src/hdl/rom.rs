//! Tables of constants as Verilog: in look-up tables, or for a block RAM to hold.

use super::text::range;

/// A table of `bits`-bit words, and the register that it ends in: `name` with `_q`.
pub(super) struct Rom<'a> {
    pub name: &'a str,
    /// What the table holds, for its comment.
    pub what: &'a str,
    /// The wire that chooses the word.
    pub index: &'a str,
    /// Bits of a word.
    pub bits: u32,
    /// The words as bit patterns; their number is a power of two.
    pub words: &'a [u64],
}

impl Rom<'_> {
    /// One constant a bit, chosen from by the index: no tool takes that for a memory. One move.
    pub(super) fn logic(&self) -> String {
        let Self { name, what, index, bits, words } = self;
        let upper = name.to_uppercase();
        let mut lines = vec![format!("  // {what}: bit by bit, the last word's first.")];
        for bit in 0..*bits {
            let digits: String = words
                .rchunks(4)
                .map(|chunk| {
                    let nibble =
                        (0..).zip(chunk).map(|(place, word)| (word >> bit & 1) << place).sum::<u64>();
                    format!("{nibble:x}")
                })
                .collect();
            let count = words.len();
            lines.push(format!("  localparam [{}:0] {upper}_{bit:<2} = {count}'h{digits};", count - 1,));
        }
        let choices: Vec<String> = (0..*bits).rev().map(|bit| format!("{upper}_{bit}[{index}]")).collect();
        lines.push(format!("  reg {} {name}_q;\n", range(*bits)));
        lines.push("  always @(posedge clk_i) begin".to_owned());
        lines.push("    if (advance_i) begin".to_owned());
        lines.push(format!("      {name}_q <= {{"));
        lines.extend(choices.chunks(4).enumerate().map(|(chunk, choices)| {
            let last = (chunk + 1) * 4 >= *bits as usize;
            format!("        {}{}", choices.join(", "), if last { "" } else { "," })
        }));
        lines.push("      };\n    end\n  end\n".to_owned());
        lines.join("\n")
    }

    /// A clocked case, which tools take for a memory that is read synchronously, and another register, because a memory's
    /// output is late in its clock. Two moves.
    pub(super) fn memory(&self) -> String {
        let Self { name, what, index, bits, words } = self;
        let index_bits = words.len().trailing_zeros();
        let mut lines = vec![
            format!("  // {what}: a block RAM's contents."),
            format!("  reg {} {name}_read_q;", range(*bits)),
            format!("  reg {} {name}_q;\n", range(*bits)),
            "  always @(posedge clk_i) begin".to_owned(),
            "    if (advance_i) begin".to_owned(),
            format!("      {name}_q <= {name}_read_q;"),
            format!("      case ({index})"),
        ];
        lines.extend((0..).zip(*words).map(|(place, word): (usize, _)| {
            // Every index has its word; the last one stands for what a simulator calls unknown, too.
            let label = if place + 1 == words.len() {
                "default".to_owned()
            } else {
                format!("{index_bits}'d{place}")
            };
            format!("        {label}: {name}_read_q <= {bits}'h{word:x};")
        }));
        lines.push("      endcase\n    end\n  end\n".to_owned());
        lines.join("\n")
    }
}
