[[ banner ]]
// Distance = phase x unambiguous range ([[ range_m ]] m at [[ frequency_hz ]] Hz), in units of [[ unit_m ]] m, rounded to nearest.
// It wraps with the phase. The factor is [[ multiplier ]] / 2^[[ factor_shift ]].
//
//   phase | distance
[%- for row in rows %]
//   [[ row ]]
[%- endfor %]
`default_nettype none
module [[ prefix ]]_distance #(
  parameter PHASE_BITS    = [[ phase_bits ]],  // phase, in turns / [% if power %]2^[[ phase_bits ]][% else %][[ turn ]][% endif %]
  parameter FACTOR_SHIFT  = [[ factor_shift ]],  // fraction bits of the factor
  parameter DISTANCE_BITS = [[ distance_bits ]]   // distance, unsigned
) (
  input  wire                     clk_i,      // clock
  input  wire                     advance_i,  // the pipeline moves
  input  wire [PHASE_BITS-1:0]    phase_i,    // phase
  output wire [DISTANCE_BITS-1:0] distance_o  // distance, two moves later
);

  localparam PRODUCT_BITS = DISTANCE_BITS + FACTOR_SHIFT;

  reg [PRODUCT_BITS-1:0]  product_q;
  reg [DISTANCE_BITS-1:0] distance_q;
[%- if factor_shift > 1 %]

  wire unused_bits = &{1'b0, product_q[FACTOR_SHIFT-2:0]};
[%- endif %]

  assign distance_o = distance_q;

  always @(posedge clk_i) begin
    if (advance_i) begin
      product_q  <= [[ product ]];
      distance_q <= product_q[PRODUCT_BITS-1:FACTOR_SHIFT] + {{(DISTANCE_BITS-1){1'b0}}, product_q[FACTOR_SHIFT-1]};
    end
  end

endmodule
`default_nettype wire
