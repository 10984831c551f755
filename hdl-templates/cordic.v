[[ banner ]]
// CORDIC in vectoring mode, unrolled: the angle of a vector in the first octant, and its length times [[ gain ]].
// Iteration 0 (45 degrees) is not needed after the octant fold. It does not undo the fold, the shift or the gain.
//
//   iteration | angle in turns / 2^[[ angle_fraction_bits ]] | degrees
[%- for row in stages %]
//   [[ row.iteration ]] | [[ row.step ]] | [[ row.degrees ]]
[%- endfor %]
`default_nettype none
module [[ prefix ]]_cordic #(
  parameter X_BITS     = [[ x_bits ]],  // x, unsigned: 2 integer bits, [[ fraction_bits ]] fraction bits
  parameter ANGLE_BITS = [[ angle_bits ]],  // angle, signed, in turns / 2^[[ angle_fraction_bits ]]
  parameter META_BITS  = [[ meta_bits ]]   // what travels along
) (
  input  wire                  clk_i,      // clock
  input  wire                  rst_ni,     // synchronous reset, active low
  input  wire                  advance_i,  // the pipeline moves
  input  wire                  valid_i,    // the inputs are a pixel's
  input  wire [X_BITS-1:0]     major_i,    // larger coordinate, 1.0 to 2.0
  input  wire [X_BITS-1:0]     minor_i,    // smaller coordinate, 0 to major_i
  input  wire [META_BITS-1:0]  meta_i,     // travels along
  output wire                  valid_o,    // the outputs are a pixel's
  output wire [X_BITS-1:0]     x_o,        // length times gain
  output wire [ANGLE_BITS-1:0] angle_o,    // angle within the octant, signed
  output wire [META_BITS-1:0]  meta_o      // meta_i, [[ iterations ]] moves later
);

  wire                  valid_0 = valid_i;
  wire [X_BITS-1:0]     x_0     = major_i;
  wire signed [X_BITS:0] y_0    = {1'b0, minor_i};
  wire [ANGLE_BITS-1:0] angle_0 = {ANGLE_BITS{1'b0}};
  wire [META_BITS-1:0]  meta_0  = meta_i;
[%- for stage in stages %]

  wire                  valid_[[ stage.iteration ]];
  wire [X_BITS-1:0]     x_[[ stage.iteration ]];
  wire signed [X_BITS:0] [[ stage.y ]];
  wire [ANGLE_BITS-1:0] angle_[[ stage.iteration ]];
  wire [META_BITS-1:0]  meta_[[ stage.iteration ]];

  [[ prefix ]]_cordic_stage #(
    .PLACES([[ stage.iteration ]]),
    .STEP  ([[ stage.step ]])
  ) u_iteration_[[ stage.iteration ]] (
    .clk_i    (clk_i),
    .rst_ni   (rst_ni),
    .advance_i(advance_i),
    .valid_i  (valid_[[ stage.before ]]),
    .x_i      (x_[[ stage.before ]]),
    .y_i      (y_[[ stage.before ]]),
    .angle_i  (angle_[[ stage.before ]]),
    .meta_i   (meta_[[ stage.before ]]),
    .valid_o  (valid_[[ stage.iteration ]]),
    .x_o      (x_[[ stage.iteration ]]),
    .y_o      ([[ stage.y ]]),
    .angle_o  (angle_[[ stage.iteration ]]),
    .meta_o   (meta_[[ stage.iteration ]])
  );
[%- endfor %]

  assign valid_o = valid_[[ iterations ]];
  assign x_o     = x_[[ iterations ]];
  assign angle_o = angle_[[ iterations ]];
  assign meta_o  = meta_[[ iterations ]];

endmodule
`default_nettype wire
