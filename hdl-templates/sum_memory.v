[[ banner ]]
// One word a pixel, one write and one read a clock, the read word registered: the form that synthesis infers as block
// RAM. It does not define what a read returns while the same word is written: here that can only be a read in a set's
// first frame, which nobody looks at.
//
//   write 5 <= a  | read 5 (next clock or later) | read_data_o = a
//   read_i = 0    |                              | read_data_o stays
//   after power-up| read 5                       | undefined until 5 is written
`default_nettype none
module [[ prefix ]]_sum_memory #(
  parameter WORD_BITS    = [[ word_bits ]],  // a pixel's sums and flag
  parameter ADDRESS_BITS = [[ address_bits ]],  // a pixel's number
  parameter WORDS        = [[ words ]]  // pixels
) (
  input  wire                    clk_i,            // clock
  input  wire                    write_i,          // write write_data_i
  input  wire [ADDRESS_BITS-1:0] write_address_i,  // there
  input  wire [WORD_BITS-1:0]    write_data_i,     // the word
  input  wire                    read_i,           // read
  input  wire [ADDRESS_BITS-1:0] read_address_i,   // there
  output wire [WORD_BITS-1:0]    read_data_o       // the word, one clock later
);

  reg [WORD_BITS-1:0] memory [0:WORDS-1];
  reg [WORD_BITS-1:0] read_data_q;

  assign read_data_o = read_data_q;

  always @(posedge clk_i) begin
    if (write_i) memory[write_address_i] <= write_data_i;
    if (read_i) read_data_q <= memory[read_address_i];
  end

endmodule
`default_nettype wire
