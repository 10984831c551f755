[[ banner ]]
// The arctangent of a ratio: a line in each of [[ segments ]] segments[% if curved %], bent by a curve that neighbouring segments share[% endif %].
//   angle = base[segment] + slope[segment] * d / 2^[[ slope_shift ]][% if curved %] + curve[segment's top bits][|d|'s top bits][% endif %]
// with d the offset from the segment's middle. It is rounded to the phase's resolution, half a code up; where it is to be
// complemented later, half a code down, so that the negative angle is rounded to nearest too: a code less.
//
//   ratio_i / 2^[[ ratio_bits ]] | backwards_i | angle_o
[%- for row in rows %]
//   [[ row ]]
[%- endfor %]
`default_nettype none
module [[ prefix ]]_poly_arctangent #(
  parameter RATIO_BITS   = [[ ratio_bits ]],  // a ratio below 1
  parameter SEGMENT_BITS = [[ segment_bits ]],  // its bits that choose the segment
  parameter SLOPE_BITS   = [[ slope_bits ]],  // a slope
  parameter SLOPE_SHIFT  = [[ slope_shift ]],  // fraction bits of slope times offset
  parameter GUARD_BITS   = [[ guard_bits ]],  // bits of the angle below the phase's resolution
  parameter ANGLE_BITS   = [[ angle_bits ]]   // the angle, signed, in turns / 2^[[ phase_bits ]]
) (
  input  wire                  clk_i,        // clock
  input  wire                  advance_i,    // the pipeline moves
  input  wire [RATIO_BITS-1:0] ratio_i,      // the ratio
  input  wire                  backwards_i,  // the angle will be complemented
  output wire [ANGLE_BITS-1:0] angle_o       // the arctangent, [[ clocks ]] moves later
);

  localparam OFFSET_BITS  = RATIO_BITS - SEGMENT_BITS;
  localparam WORD_BITS    = ANGLE_BITS + GUARD_BITS;
  localparam PRODUCT_BITS = SLOPE_BITS + 1 + OFFSET_BITS;
  localparam SUM_BITS     = PRODUCT_BITS - SLOPE_SHIFT;

  wire [SEGMENT_BITS-1:0] segment = ratio_i[RATIO_BITS-1:OFFSET_BITS];
[%- if curved %]
  wire [[ curve_range ]] size = ratio_i[[ size_range ]] ^ {[[ curve_offset_bits ]]{!ratio_i[OFFSET_BITS-1]}};
  wire [[ bend_range ]] bend = {ratio_i[[ group_range ]], size};
[%- else %]
  wire [SEGMENT_BITS:0] line = {backwards_i, segment};
[%- endif %]

[[ tables ]]
  // The offset: of a segment's words, the middle is 0.
  reg [OFFSET_BITS-1:0] offset_q;
[%- if curved %]
  reg                   backwards_q;
[%- else %]
  reg [OFFSET_BITS-1:0] offset_read_q;
[%- endif %]

  always @(posedge clk_i) begin
    if (advance_i) begin
[%- if curved %]
      offset_q    <= {!ratio_i[OFFSET_BITS-1], ratio_i[OFFSET_BITS-2:0]};
      backwards_q <= backwards_i;
[%- else %]
      offset_q      <= offset_read_q;
      offset_read_q <= {!ratio_i[OFFSET_BITS-1], ratio_i[OFFSET_BITS-2:0]};
[%- endif %]
    end
  end

  wire [PRODUCT_BITS-1:0] product;

  [[ prefix ]]_poly_multiplier #(
    .A_BITS(SLOPE_BITS + 1),
    .B_BITS(OFFSET_BITS),
    .SIGNED(1)
  ) u_multiplier (
    .clk_i    (clk_i),
    .advance_i(advance_i),
    .a_i      ({1'b0, slope}),
    .b_i      (offset_q),
    .product_o(product)
  );

  // Meanwhile: [% if curved %]the curve, and above it a whole code unless the angle is complemented: the bases have half a code less.[% else %]the base has both roundings.[% endif %]
  reg [WORD_BITS-1:0] start_q;
  reg [WORD_BITS-1:0] start_2_q;
  reg [WORD_BITS-1:0] start_3_q;
  reg [WORD_BITS-1:0] sum_q;

  always @(posedge clk_i) begin
    if (advance_i) begin
[%- if curved %]
      start_q   <= base + {{(WORD_BITS-GUARD_BITS-1){1'b0}}, !backwards_q, curve_q};
[%- else %]
      start_q   <= base;
[%- endif %]
      start_2_q <= start_q;
      start_3_q <= start_2_q;
      sum_q     <= start_3_q + {{(WORD_BITS-SUM_BITS){product[PRODUCT_BITS-1]}}, product[PRODUCT_BITS-1:SLOPE_SHIFT]};
    end
  end

  assign angle_o = sum_q[WORD_BITS-1:GUARD_BITS];
  wire unused_bits = &{1'b0, product[SLOPE_SHIFT-1:0], sum_q[GUARD_BITS-1:0]};

endmodule
`default_nettype wire
