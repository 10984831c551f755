[[ banner ]]
// Shifts both coordinates left by PLACES where the larger one's top PLACES bits are zero, and notes that it did.
// Stages of falling powers of two together bring the larger one's top bit to the top.
//
//   BITS = 4, PLACES = 2 | major_i | minor_i | major_o | minor_o | shift
//                        |   0011  |   0001  |   1100  |   0100  |   1
//                        |   0100  |   0011  |   0100  |   0011  |   0
//                        |   0000  |   0000  |   0000  |   0000  |   1
`default_nettype none
module [[ prefix ]]_shift_stage #(
  parameter BITS       = [[ bits ]],  // a coordinate's magnitude
  parameter PLACES     = 1,  // places to shift
  parameter SHIFT_BITS = [[ shift_bits ]],  // number of stages
  parameter SHIFT_BIT  = 0,  // this stage's bit in the shift count
  parameter META_BITS  = [[ meta_bits ]]   // what travels along
) (
  input  wire                  clk_i,      // clock
  input  wire                  rst_ni,     // synchronous reset, active low
  input  wire                  advance_i,  // the pipeline moves
  input  wire                  valid_i,    // the inputs are a pixel's
  input  wire [BITS-1:0]       major_i,    // larger coordinate
  input  wire [BITS-1:0]       minor_i,    // smaller coordinate
  input  wire [SHIFT_BITS-1:0] shift_i,    // places shifted so far
  input  wire [META_BITS-1:0]  meta_i,     // travels along
  output wire                  valid_o,    // the outputs are a pixel's
  output wire [BITS-1:0]       major_o,    // larger coordinate, shifted
  output wire [BITS-1:0]       minor_o,    // smaller coordinate, shifted
  output wire [SHIFT_BITS-1:0] shift_o,    // places shifted with this stage
  output wire [META_BITS-1:0]  meta_o      // meta_i, one move later
);

  localparam [SHIFT_BITS-1:0] THIS_STAGE = 1 << SHIFT_BIT;

  reg                  valid_q;
  reg [BITS-1:0]       major_q;
  reg [BITS-1:0]       minor_q;
  reg [SHIFT_BITS-1:0] shift_q;
  reg [META_BITS-1:0]  meta_q;

  wire fits = major_i[BITS-1:BITS-PLACES] == {PLACES{1'b0}};

  assign valid_o = valid_q;
  assign major_o = major_q;
  assign minor_o = minor_q;
  assign shift_o = shift_q;
  assign meta_o  = meta_q;

  always @(posedge clk_i) begin
    if (!rst_ni) valid_q <= 1'b0;
    else if (advance_i) valid_q <= valid_i;
  end

  always @(posedge clk_i) begin
    if (advance_i) begin
      major_q <= fits ? major_i << PLACES : major_i;
      minor_q <= fits ? minor_i << PLACES : minor_i;
      shift_q <= fits ? shift_i | THIS_STAGE : shift_i;
      meta_q  <= meta_i;
    end
  end

endmodule
`default_nettype wire
