[[ banner ]]
[%- if in_phase_factor == 1 %]
// Registers the sums as a vector: scheme [[ scheme ]] needs no factor.
[%- else %]
// Multiplies the sums by two integers whose ratio [[ quadrature_factor ]]/[[ in_phase_factor ]] stands for sqrt(3):
// [[ quadrature_factor ]]^2 - 3 x [[ in_phase_factor ]]^2 = 1, so it is too large by less than 1/(6 x [[ in_phase_factor ]]^2) = [[ factor_error ]] of itself,
// and turns no vector by more than half of that in radians. The products are exact.
[%- endif %]
//
//   in-phase | quadrature | x | y
[%- for row in rows %]
//   [[ row ]]
[%- endfor %]
`default_nettype none
module [[ prefix ]]_scaling #(
  parameter IN_PHASE_BITS   = [[ in_phase_bits ]],  // in-phase sum, signed
  parameter QUADRATURE_BITS = [[ quadrature_bits ]],  // quadrature sum, signed
  parameter X_BITS          = [[ x_bits ]],  // x, signed
  parameter Y_BITS          = [[ y_bits ]],  // y, signed
  parameter META_BITS       = [[ meta_bits ]]   // what travels along
) (
  input  wire                              clk_i,         // clock
  input  wire                              rst_ni,        // synchronous reset, active low
  input  wire                              advance_i,     // the pipeline moves
  input  wire                              valid_i,       // the inputs are a pixel's
  input  wire signed [IN_PHASE_BITS-1:0]   in_phase_i,    // in-phase sum
  input  wire signed [QUADRATURE_BITS-1:0] quadrature_i,  // quadrature sum
  input  wire        [META_BITS-1:0]       meta_i,        // travels along
  output wire                              valid_o,       // the outputs are a pixel's
  output wire signed [X_BITS-1:0]          x_o,           // x of the vector
  output wire signed [Y_BITS-1:0]          y_o,           // y of the vector
  output wire        [META_BITS-1:0]       meta_o         // meta_i, one move later
);

  reg                     valid_q;
  reg signed [X_BITS-1:0] x_q;
  reg signed [Y_BITS-1:0] y_q;
  reg [META_BITS-1:0]     meta_q;

[%- if in_phase_factor == 1 %]
  wire signed [X_BITS-1:0] x_d = in_phase_i;
  wire signed [Y_BITS-1:0] y_d = quadrature_i;
[%- else %]
  wire signed [X_BITS-1:0] in_phase   = {{(X_BITS-IN_PHASE_BITS){in_phase_i[IN_PHASE_BITS-1]}}, in_phase_i};
  wire signed [Y_BITS-1:0] quadrature = {{(Y_BITS-QUADRATURE_BITS){quadrature_i[QUADRATURE_BITS-1]}}, quadrature_i};
  wire signed [X_BITS-1:0] x_d        = in_phase * [[ x_bits ]]'sd[[ in_phase_factor ]];
  wire signed [Y_BITS-1:0] y_d        = quadrature * [[ y_bits ]]'sd[[ quadrature_factor ]];
[%- endif %]

  assign valid_o = valid_q;
  assign x_o     = x_q;
  assign y_o     = y_q;
  assign meta_o  = meta_q;

  always @(posedge clk_i) begin
    if (!rst_ni) valid_q <= 1'b0;
    else if (advance_i) valid_q <= valid_i;
  end

  always @(posedge clk_i) begin
    if (advance_i) begin
      x_q    <= x_d;
      y_q    <= y_d;
      meta_q <= meta_i;
    end
  end

endmodule
`default_nettype wire
