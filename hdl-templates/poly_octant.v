[[ banner ]]
// Folds a vector into the octant 0 <= minor <= major and shifts both coordinates left until the top bit of the major one is
// set. A vector of zeros leaves it clear.
//
// Nothing is negated. A coordinate v is held as 2 v, and -v as the complement 2 v - 1, and what a shift brings in from the
// right is the lowest bit, the sign: ones below a complement, so that it falls short by one unit of the last place however
// far it is shifted, and -2^([[ word_bits ]]-1) is no exception.
//
//   WORD_BITS = 4: x, y | octant {swapped, y negative, x negative} | major_o : minor_o
//     3,  1 | 000 | 110.0 : 010.0
//     1, -3 | 110 | 101.1 : 010.0, of 2 * 3 : 2 * 1 before the shift
//     0, -1 | 110 | 111.1 : 000.0
`default_nettype none
module [[ prefix ]]_poly_octant #(
  parameter X_BITS          = [[ x_bits ]],  // x, signed
  parameter Y_BITS          = [[ y_bits ]],  // y, signed
  parameter WORD_BITS       = [[ word_bits ]],  // the wider of the two
  parameter COORDINATE_BITS = [[ coordinate_bits ]]   // a normalised coordinate, one integer bit
) (
  input  wire                       clk_i,      // clock
  input  wire                       advance_i,  // the pipeline moves
  input  wire [X_BITS-1:0]          x_i,        // x of the vector
  input  wire [Y_BITS-1:0]          y_i,        // y of the vector
  output wire [COORDINATE_BITS-1:0] major_o,    // larger coordinate, 1.0 to 2.0
  output wire [COORDINATE_BITS-1:0] minor_o,    // smaller coordinate
  output wire [2:0]                 octant_o    // {swapped, y was negative, x was negative}, [[ shifts ]] moves earlier
);

  wire [WORD_BITS-1:0] x = [[ x ]];
  wire [WORD_BITS-1:0] y = [[ y ]];

  // First clock: which is larger? |x| - |y| has the sign of x + y or x - y, or the opposite one. -1 - y stands for -y: that
  // is wrong only where both are equal, and those have the same angle swapped or not.
  reg [WORD_BITS-1:0] x_q;
  reg [WORD_BITS-1:0] y_q;
  reg                 swapped_q;
  wire                same_sign = x[WORD_BITS-1] == y[WORD_BITS-1];
  wire [WORD_BITS:0]  sum       = {x[WORD_BITS-1], x} + ({y[WORD_BITS-1], y} ^ {(WORD_BITS+1){same_sign}});
  wire                unused_sum = &{1'b0, sum[WORD_BITS-1:0]};

  // Second clock: the larger one first, complemented where it is negative.
  reg [WORD_BITS-1:0] major_0;
  reg [WORD_BITS-1:0] minor_0;
  reg [2:0]           octant_q;
  wire                major_negative = swapped_q ? y_q[WORD_BITS-1] : x_q[WORD_BITS-1];
  wire                minor_negative = swapped_q ? x_q[WORD_BITS-1] : y_q[WORD_BITS-1];
  wire [WORD_BITS-2:0] major_bits    = swapped_q ? y_q[WORD_BITS-2:0] : x_q[WORD_BITS-2:0];
  wire [WORD_BITS-2:0] minor_bits    = swapped_q ? x_q[WORD_BITS-2:0] : y_q[WORD_BITS-2:0];

  always @(posedge clk_i) begin
    if (advance_i) begin
      x_q       <= x;
      y_q       <= y;
      swapped_q <= sum[WORD_BITS] ^ x[WORD_BITS-1];
      major_0   <= {major_bits ^ {(WORD_BITS-1){major_negative}}, major_negative};
      minor_0   <= {minor_bits ^ {(WORD_BITS-1){minor_negative}}, minor_negative};
      octant_q  <= {swapped_q, y_q[WORD_BITS-1], x_q[WORD_BITS-1]};
    end
  end

  // Then one clock a shift.
[%- for stage in stages %]
  reg [WORD_BITS-1:0] major_[[ stage.number ]];
  reg [WORD_BITS-1:0] minor_[[ stage.number ]];
  wire                fits_[[ stage.number ]] = major_[[ stage.before ]][WORD_BITS-1:WORD_BITS-[[ stage.places ]]] == [[ stage.places ]]'d0;

  always @(posedge clk_i) begin
    if (advance_i) begin
      major_[[ stage.number ]] <= fits_[[ stage.number ]] ? {major_[[ stage.before ]][WORD_BITS-[[ stage.places ]]-1:0], {[[ stage.places ]]{major_[[ stage.before ]][0]}}} : major_[[ stage.before ]];
      minor_[[ stage.number ]] <= fits_[[ stage.number ]] ? {minor_[[ stage.before ]][WORD_BITS-[[ stage.places ]]-1:0], {[[ stage.places ]]{minor_[[ stage.before ]][0]}}} : minor_[[ stage.before ]];
    end
  end
[% endfor %]
  assign major_o  = [[ major ]];
  assign minor_o  = [[ minor ]];
  assign octant_o = octant_q;
[%- if drop_bits > 0 %]

  wire unused_bits = &{1'b0, major_[[ shifts ]][[ dropped ]], minor_[[ shifts ]][[ dropped ]]};
[%- endif %]

endmodule
`default_nettype wire
