[[ banner ]]
// Frees the CORDIC's x from its gain, the scheme's gain and the normaliser's shift: amplitude in DN / 2^[[ fraction_bits ]], rounded
// to nearest. The factor [[ multiplier ]] / 2^[[ factor_shift ]] stands for 2^([[ exponent ]]) / ([[ gain ]] x [[ divisor ]]).
// Where there is no vector the amplitude is 0.
//
//   x          | shift | amplitude
[%- for row in rows %]
//   [[ row ]]
[%- endfor %]
`default_nettype none
module [[ prefix ]]_amplitude #(
  parameter X_BITS         = [[ x_bits ]],  // x, unsigned
  parameter SHIFT_BITS     = [[ shift_bits ]],  // the normaliser's shift
  parameter FACTOR_BITS    = [[ factor_bits ]],  // the factor
  parameter AMPLITUDE_BITS = [[ amplitude_bits ]]   // amplitude, unsigned
) (
  input  wire                      clk_i,       // clock
  input  wire                      advance_i,   // the pipeline moves
  input  wire [X_BITS-1:0]         x_i,         // length times gain, normalised
  input  wire [SHIFT_BITS-1:0]     shift_i,     // places by which the vector was shifted left
  input  wire                      zero_i,      // there is no vector
  output wire [AMPLITUDE_BITS-1:0] amplitude_o  // amplitude, two moves later
);

  localparam PRODUCT_BITS = X_BITS + FACTOR_BITS;

  reg [PRODUCT_BITS-1:0]   product_q;
  reg [[ places_range ]]              places_q;
  reg                      zero_q;
  reg [AMPLITUDE_BITS-1:0] amplitude_q;

  // One bit more than the result stays: half a code, for rounding.
  wire [PRODUCT_BITS-1:0]   shifted = product_q >> places_q;
  wire [AMPLITUDE_BITS-1:0] rounded = shifted[AMPLITUDE_BITS:1] + {{(AMPLITUDE_BITS-1){1'b0}}, shifted[0]};
[%- if spare_bits %]
  wire                      unused_bits = &{1'b0, shifted[PRODUCT_BITS-1:AMPLITUDE_BITS+1]};
[%- endif %]

  assign amplitude_o = amplitude_q;

  always @(posedge clk_i) begin
    if (advance_i) begin
      product_q   <= [[ product ]];
      places_q    <= [[ places ]];
      zero_q      <= zero_i;
      amplitude_q <= zero_q ? {AMPLITUDE_BITS{1'b0}} : rounded;
    end
  end

endmodule
`default_nettype wire
