[[ banner ]]
// One word a pixel, one write and one read a clock, the read word registered: the form that synthesis infers as block
// RAM. It does not define what a read returns while the same word is written: here that can only be a read in a set's
// first frame, which nobody looks at. It is cut into columns as wide as block RAMs can be, so that few of their bits lie idle.
//
//   write 5 <= a  | read 5 (next clock or later) | read_data_o = a
//   read_i = 0    |                              | read_data_o stays
//   after power-up| read 5                       | undefined until 5 is written
`default_nettype none
module [[ prefix ]]_sum_memory #(
  parameter WORD_BITS    = [[ word_bits ]],  // what is kept of a pixel
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
[%- for column in columns %]

  // Bits [[ column.high ]] to [[ column.low ]].
  reg [[ column.range ]] memory_[[ column.number ]] [0:WORDS-1];
  reg [[ column.range ]] read_[[ column.number ]]_q;

  assign read_data_o[[ self::slice(column.high, column.low) ]] = read_[[ column.number ]]_q;

  always @(posedge clk_i) begin
    if (write_i) memory_[[ column.number ]][write_address_i] <= write_data_i[[ self::slice(column.high, column.low) ]];
    if (read_i) read_[[ column.number ]]_q <= memory_[[ column.number ]][read_address_i];
  end
[%- endfor %]

endmodule
`default_nettype wire
