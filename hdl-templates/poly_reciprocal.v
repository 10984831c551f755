[[ banner ]]
// The reciprocal of a number m from 1.0 to 2.0: a factor from a table of [[ entries ]], times m with the bits below the table's
// index complemented. With m = c + d, c the middle of the index' interval, the complement is c - d, and the factor nearly
// 1/c^2: m (c - d) / c^2 = 1 - d^2/c^2. Relative error [[ error ]] at most. The result is 1 - 2^-[[ scale_bits ]] of
// the reciprocal, so that no ratio reaches 1.0; the arctangent's table knows.
//
//   major_i | reciprocal_o / 2^[[ result_bits ]]
[%- for row in rows %]
//   [[ row ]]
[%- endfor %]
`default_nettype none
module [[ prefix ]]_poly_reciprocal #(
  parameter COORDINATE_BITS = [[ coordinate_bits ]],  // m, one integer bit
  parameter INDEX_BITS      = [[ index_bits ]],  // bits of m below its leading one that choose the factor
  parameter FACTOR_BITS     = [[ factor_bits ]],  // a factor, below 1
  parameter RESULT_BITS     = [[ result_bits ]]   // the reciprocal, below 1
) (
  input  wire                       clk_i,        // clock
  input  wire                       advance_i,    // the pipeline moves
  input  wire [COORDINATE_BITS-1:0] major_i,      // m
  output wire [RESULT_BITS-1:0]     reciprocal_o  // its reciprocal, rounded down, [[ clocks ]] moves later
);

  localparam LOW_BITS     = COORDINATE_BITS - 1 - INDEX_BITS;
  localparam PRODUCT_BITS = COORDINATE_BITS + FACTOR_BITS;

  wire [INDEX_BITS-1:0] index = major_i[COORDINATE_BITS-2:LOW_BITS];

[[ factor_table ]]
[%- if memory %]
  reg [COORDINATE_BITS-1:0] mirrored_read_q;
[%- endif %]
  reg [COORDINATE_BITS-1:0] mirrored_q;

  always @(posedge clk_i) begin
    if (advance_i) begin
[%- if memory %]
      mirrored_q      <= mirrored_read_q;
      mirrored_read_q <= {major_i[COORDINATE_BITS-1:LOW_BITS], ~major_i[LOW_BITS-1:0]};
[%- else %]
      mirrored_q <= {major_i[COORDINATE_BITS-1:LOW_BITS], ~major_i[LOW_BITS-1:0]};
[%- endif %]
    end
  end

  wire [PRODUCT_BITS-1:0] product;

  [[ prefix ]]_poly_multiplier #(
    .A_BITS(COORDINATE_BITS),
    .B_BITS(FACTOR_BITS)
  ) u_multiplier (
    .clk_i    (clk_i),
    .advance_i(advance_i),
    .a_i      (mirrored_q),
    .b_i      (factor_q),
    .product_o(product)
  );

  // The product is below 1.0.
  assign reciprocal_o = product[PRODUCT_BITS-2:PRODUCT_BITS-1-RESULT_BITS];
  wire unused_bits = &{1'b0, product[PRODUCT_BITS-1], product[PRODUCT_BITS-2-RESULT_BITS:0]};

endmodule
`default_nettype wire
