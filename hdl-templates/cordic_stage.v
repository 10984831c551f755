[[ banner ]]
// One CORDIC iteration in vectoring mode: turns the vector by atan(2^-PLACES) towards the x axis and adds up the angle.
// A shifted operand is rounded to nearest: the bit below the cut is the adder's carry-in. Adding or subtracting is one
// adder: operand xor sign, sign into the carry.
//
//   y_i  | x_o           | y_o           | angle_o
//   >= 0 | x + y/2^PLACES | y - x/2^PLACES | angle + STEP
//   < 0  | x - y/2^PLACES | y + x/2^PLACES | angle - STEP
`default_nettype none
module [[ prefix ]]_cordic_stage #(
  parameter X_BITS     = [[ x_bits ]],  // x, unsigned: 2 integer bits, [[ fraction_bits ]] fraction bits
  parameter ANGLE_BITS = [[ angle_bits ]],  // angle, signed, in turns / 2^[[ angle_fraction_bits ]]
  parameter META_BITS  = [[ meta_bits ]],  // what travels along
  parameter PLACES     = 1,  // this iteration
  parameter [ANGLE_BITS-1:0] STEP = {ANGLE_BITS{1'b0}}  // its angle
) (
  input  wire                         clk_i,      // clock
  input  wire                         rst_ni,     // synchronous reset, active low
  input  wire                         advance_i,  // the pipeline moves
  input  wire                         valid_i,    // the inputs are a pixel's
  input  wire        [X_BITS-1:0]     x_i,        // x, always positive
  input  wire signed [X_BITS:0]       y_i,        // y
  input  wire        [ANGLE_BITS-1:0] angle_i,    // angle so far
  input  wire        [META_BITS-1:0]  meta_i,     // travels along
  output wire                         valid_o,    // the outputs are a pixel's
  output wire        [X_BITS-1:0]     x_o,        // x after this iteration
  output wire signed [X_BITS:0]       y_o,        // y after this iteration
  output wire        [ANGLE_BITS-1:0] angle_o,    // angle with this iteration
  output wire        [META_BITS-1:0]  meta_o      // meta_i, one move later
);

  reg                     valid_q;
  reg [X_BITS-1:0]        x_q;
  reg signed [X_BITS:0]   y_q;
  reg [ANGLE_BITS-1:0]    angle_q;
  reg [META_BITS-1:0]     meta_q;

  wire negative = y_i[X_BITS];

  wire signed [X_BITS-1:0] y_shifted = $signed(y_i[X_BITS:1]) >>> (PLACES - 1);
  wire        [X_BITS:0]   x_shifted = {1'b0, x_i} >> PLACES;
  wire                     y_carry   = y_i[PLACES-1] ^ negative;
  wire                     x_carry   = x_i[PLACES-1] ^ !negative;

  assign valid_o = valid_q;
  assign x_o     = x_q;
  assign y_o     = y_q;
  assign angle_o = angle_q;
  assign meta_o  = meta_q;

  always @(posedge clk_i) begin
    if (!rst_ni) valid_q <= 1'b0;
    else if (advance_i) valid_q <= valid_i;
  end

  always @(posedge clk_i) begin
    if (advance_i) begin
      x_q     <= x_i + (y_shifted ^ {X_BITS{negative}}) + {{(X_BITS-1){1'b0}}, y_carry};
      y_q     <= y_i + (x_shifted ^ {(X_BITS+1){!negative}}) + {{X_BITS{1'b0}}, x_carry};
      angle_q <= angle_i + (STEP ^ {ANGLE_BITS{negative}}) + {{(ANGLE_BITS-1){1'b0}}, negative};
      meta_q  <= meta_i;
    end
  end

endmodule
`default_nettype wire
