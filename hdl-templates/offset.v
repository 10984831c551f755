[[ banner ]]
// The weighted mean of the frames: offset sum / [[ divisor ]], in DN / 2^[[ fraction_bits ]], rounded to nearest.
// The factor is [[ multiplier ]] / 2^[[ factor_shift ]].
//
//   sum | offset
[%- for row in rows %]
//   [[ row ]]
[%- endfor %]
`default_nettype none
module [[ prefix ]]_offset #(
  parameter SUM_BITS     = [[ sum_bits ]],  // offset sum, unsigned
  parameter FACTOR_SHIFT = [[ factor_shift ]],  // fraction bits of the factor
  parameter OFFSET_BITS  = [[ offset_bits ]]   // offset, unsigned
) (
  input  wire                   clk_i,      // clock
  input  wire                   advance_i,  // the pipeline moves
  input  wire [SUM_BITS-1:0]    sum_i,      // offset sum
  output wire [OFFSET_BITS-1:0] offset_o    // offset, two moves later
);

  localparam PRODUCT_BITS = OFFSET_BITS + FACTOR_SHIFT;

  reg [PRODUCT_BITS-1:0] product_q;
  reg [OFFSET_BITS-1:0]  offset_q;
[%- if factor_shift > 1 %]

  wire unused_bits = &{1'b0, product_q[FACTOR_SHIFT-2:0]};
[%- endif %]

  assign offset_o = offset_q;

  always @(posedge clk_i) begin
    if (advance_i) begin
      product_q <= [[ product ]];
      offset_q  <= product_q[PRODUCT_BITS-1:FACTOR_SHIFT] + {{(OFFSET_BITS-1){1'b0}}, product_q[FACTOR_SHIFT-1]};
    end
  end

endmodule
`default_nettype wire
