[[ banner ]]
// Carries a word and its valid bit through a number of pipeline registers.
// It does not look at the word.
//
//   CLOCKS = 2 | clock | data_i | data_o
//              |   0   |   a    |   -
//              |   1   |   b    |   -
//              |   2   |   c    |   a
`default_nettype none
module [[ prefix ]]_delay #(
  parameter WIDTH  = 8,  // bits of a word
  parameter CLOCKS = 2   // registers, 1 or more
) (
  input  wire             clk_i,      // clock
  input  wire             rst_ni,     // synchronous reset, active low
  input  wire             advance_i,  // the pipeline moves
  input  wire             valid_i,    // data_i is a pixel's
  input  wire [WIDTH-1:0] data_i,     // the word
  output wire             valid_o,    // data_o is a pixel's
  output wire [WIDTH-1:0] data_o      // the word, CLOCKS moves later
);

  reg [CLOCKS-1:0]       valid_q;
  reg [CLOCKS*WIDTH-1:0] data_q;

  assign valid_o = valid_q[CLOCKS-1];
  assign data_o  = data_q[CLOCKS*WIDTH-1:(CLOCKS-1)*WIDTH];

  integer stage;
  always @(posedge clk_i) begin
    if (advance_i) begin
      valid_q[0]        <= valid_i;
      data_q[WIDTH-1:0] <= data_i;
      for (stage = 1; stage < CLOCKS; stage = stage + 1) begin
        valid_q[stage]                <= valid_q[stage-1];
        data_q[stage*WIDTH +: WIDTH] <= data_q[(stage-1)*WIDTH +: WIDTH];
      end
    end
    if (!rst_ni) valid_q <= {CLOCKS{1'b0}};
  end

endmodule
`default_nettype wire
