[[ banner ]]
// Folds the vector into the octant 0 <= y <= x and shifts it left until the larger coordinate's top bit is set, so that
// a weak pixel's phase is as exact as its bits allow. A vector of zeros stays zero and is marked.
//
//   x  | y  | octant {swapped, y negative, x negative} | major : minor
//   -3 | 1  | 001                                      | 3 : 1
//   1  | -3 | 110                                      | 3 : 1
//   0  | 0  | 000, zero                                | 0 : 0
`default_nettype none
module [[ prefix ]]_normaliser #(
  parameter X_BITS      = [[ x_bits ]],  // x, signed
  parameter Y_BITS      = [[ y_bits ]],  // y, signed
  parameter BITS        = [[ bits ]],  // the larger magnitude
  parameter VECTOR_BITS = [[ vector_bits ]],  // a normalised coordinate: one or two integer bits, [[ fraction_bits ]] fraction bits
  parameter SHIFT_BITS  = [[ shift_bits ]],  // the shift count
  parameter META_BITS   = [[ meta_bits ]]   // what travels along
) (
  input  wire                     clk_i,      // clock
  input  wire                     rst_ni,     // synchronous reset, active low
  input  wire                     advance_i,  // the pipeline moves
  input  wire                     valid_i,    // the inputs are a pixel's
  input  wire signed [X_BITS-1:0] x_i,        // x of the vector
  input  wire signed [Y_BITS-1:0] y_i,        // y of the vector
  input  wire [META_BITS-1:0]     meta_i,     // travels along
  output wire                     valid_o,    // the outputs are a pixel's
  output wire [VECTOR_BITS-1:0]   major_o,    // larger coordinate, 1.0 to 2.0
  output wire [VECTOR_BITS-1:0]   minor_o,    // smaller coordinate
  output wire [SHIFT_BITS-1:0]    shift_o,    // places shifted
  output wire [2:0]               octant_o,   // {swapped, y was negative, x was negative}
  output wire                     zero_o,     // there is no vector
  output wire [META_BITS-1:0]     meta_o      // meta_i, [[ clocks ]] moves later
);

  // First clock: magnitudes.
  reg                 magnitude_valid_q;
  reg [BITS-1:0]      x_magnitude_q;
  reg [BITS-1:0]      y_magnitude_q;
  reg                 x_negative_q;
  reg                 y_negative_q;
  reg [META_BITS-1:0] magnitude_meta_q;

  wire [X_BITS-2:0] x_magnitude = (x_i[X_BITS-2:0] ^ {(X_BITS-1){x_i[X_BITS-1]}}) + {{(X_BITS-2){1'b0}}, x_i[X_BITS-1]};
  wire [Y_BITS-2:0] y_magnitude = (y_i[Y_BITS-2:0] ^ {(Y_BITS-1){y_i[Y_BITS-1]}}) + {{(Y_BITS-2){1'b0}}, y_i[Y_BITS-1]};

  // Second clock: the larger one first.
  reg                   fold_valid_q;
  reg [BITS-1:0]        fold_major_q;
  reg [BITS-1:0]        fold_minor_q;
  reg [META_BITS+3:0]   fold_meta_q;
  wire                  swapped = y_magnitude_q > x_magnitude_q;
  wire [BITS-1:0]       larger  = swapped ? y_magnitude_q : x_magnitude_q;
  wire                  zero    = larger == {BITS{1'b0}};

  always @(posedge clk_i) begin
    if (!rst_ni) begin
      magnitude_valid_q <= 1'b0;
      fold_valid_q      <= 1'b0;
    end else if (advance_i) begin
      magnitude_valid_q <= valid_i;
      fold_valid_q      <= magnitude_valid_q;
    end
  end

  always @(posedge clk_i) begin
    if (advance_i) begin
      x_magnitude_q    <= [[ x_magnitude ]];
      y_magnitude_q    <= [[ y_magnitude ]];
      x_negative_q     <= x_i[X_BITS-1];
      y_negative_q     <= y_i[Y_BITS-1];
      magnitude_meta_q <= meta_i;
      fold_major_q     <= larger;
      fold_minor_q     <= swapped ? x_magnitude_q : y_magnitude_q;
      fold_meta_q      <= {zero, swapped, y_negative_q, x_negative_q, magnitude_meta_q};
    end
  end

  // Then one clock a shift.
  wire                  valid_0 = fold_valid_q;
  wire [BITS-1:0]       major_0 = fold_major_q;
  wire [BITS-1:0]       minor_0 = fold_minor_q;
  wire [SHIFT_BITS-1:0] shift_0 = {SHIFT_BITS{1'b0}};
  wire [META_BITS+3:0]  meta_0  = fold_meta_q;
[%- for stage in stages %]

  wire                  valid_[[ stage.number ]];
  wire [BITS-1:0]       major_[[ stage.number ]];
  wire [BITS-1:0]       minor_[[ stage.number ]];
  wire [SHIFT_BITS-1:0] shift_[[ stage.number ]];
  wire [META_BITS+3:0]  meta_[[ stage.number ]];

  [[ prefix ]]_shift_stage #(
    .PLACES   ([[ stage.places ]]),
    .SHIFT_BIT([[ stage.shift_bit ]]),
    .META_BITS(META_BITS + 4)
  ) u_shift_by_[[ stage.places ]] (
    .clk_i    (clk_i),
    .rst_ni   (rst_ni),
    .advance_i(advance_i),
    .valid_i  (valid_[[ stage.before ]]),
    .major_i  (major_[[ stage.before ]]),
    .minor_i  (minor_[[ stage.before ]]),
    .shift_i  (shift_[[ stage.before ]]),
    .meta_i   (meta_[[ stage.before ]]),
    .valid_o  (valid_[[ stage.number ]]),
    .major_o  (major_[[ stage.number ]]),
    .minor_o  (minor_[[ stage.number ]]),
    .shift_o  (shift_[[ stage.number ]]),
    .meta_o   (meta_[[ stage.number ]])
  );
[%- endfor %]
[% if drop_bits == 0 %]
  // The CORDIC's word holds every bit.
  assign valid_o  = valid_[[ last ]];
  assign major_o  = [[ major_padded ]];
  assign minor_o  = [[ minor_padded ]];
  assign shift_o  = shift_[[ last ]];
  assign {zero_o, octant_o, meta_o} = meta_[[ last ]];
[%- else %]
  // Last clock: [[ drop_bits ]] bits are rounded off, halves up. A coordinate may round up to 2.0.
  localparam DROP_BITS = [[ drop_bits ]];

  reg                   round_valid_q;
  reg [VECTOR_BITS-1:0] round_major_q;
  reg [VECTOR_BITS-1:0] round_minor_q;
  reg [SHIFT_BITS-1:0]  round_shift_q;
  reg [META_BITS+3:0]   round_meta_q;

  wire [VECTOR_BITS-1:0] major_kept  = {1'b0, major_[[ last ]][BITS-1:DROP_BITS]};
  wire [VECTOR_BITS-1:0] minor_kept  = {1'b0, minor_[[ last ]][BITS-1:DROP_BITS]};
  wire [VECTOR_BITS-1:0] major_carry = {{(VECTOR_BITS-1){1'b0}}, major_[[ last ]][DROP_BITS-1]};
  wire [VECTOR_BITS-1:0] minor_carry = {{(VECTOR_BITS-1){1'b0}}, minor_[[ last ]][DROP_BITS-1]};
[%- if drop_bits > 1 %]
  wire                   unused_bits = &{1'b0, major_[[ last ]][DROP_BITS-2:0], minor_[[ last ]][DROP_BITS-2:0]};
[%- endif %]

  always @(posedge clk_i) begin
    if (!rst_ni) round_valid_q <= 1'b0;
    else if (advance_i) round_valid_q <= valid_[[ last ]];
  end

  always @(posedge clk_i) begin
    if (advance_i) begin
      round_major_q <= major_kept + major_carry;
      round_minor_q <= minor_kept + minor_carry;
      round_shift_q <= shift_[[ last ]];
      round_meta_q  <= meta_[[ last ]];
    end
  end

  assign valid_o  = round_valid_q;
  assign major_o  = round_major_q;
  assign minor_o  = round_minor_q;
  assign shift_o  = round_shift_q;
  assign {zero_o, octant_o, meta_o} = round_meta_q;
[%- endif %]

endmodule
`default_nettype wire
