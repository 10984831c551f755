[[ banner ]]
// Folds the vector into the first quadrant and shifts it left until the larger coordinate's top bit is set, so that a weak
// pixel's phase is as exact as its bits allow. A negative coordinate is complemented bit by bit; the one that a complement
// lacks comes as ones from the right. A vector of zeros stays zero.
//
//   x  | y | x magnitude | y magnitude, of [[ bits ]] bits
//   1  | 0 | 100...      | 000...
//   -1 | 0 | 111...      | 000... (one place further: ones without end are the next power of two)
//   -3 | 1 | 101...      | 010...
`default_nettype none
module [[ prefix ]]_normaliser #(
  parameter X_BITS     = [[ x_bits ]],  // x, signed
  parameter Y_BITS     = [[ y_bits ]],  // y, signed
  parameter BITS       = [[ bits ]],  // a magnitude
  parameter SHIFT_BITS = [[ shift_bits ]],  // the shift count
  parameter META_BITS  = [[ meta_bits ]]   // what travels along
) (
  input  wire                     clk_i,         // clock
  input  wire                     rst_ni,        // synchronous reset, active low
  input  wire                     advance_i,     // the pipeline moves
  input  wire                     valid_i,       // the inputs are a pixel's
  input  wire signed [X_BITS-1:0] x_i,           // x of the vector
  input  wire signed [Y_BITS-1:0] y_i,           // y of the vector
  input  wire [META_BITS-1:0]     meta_i,        // travels along
  output wire                     valid_o,       // the outputs are a pixel's
  output wire [BITS-1:0]          x_o,           // magnitude of x, shifted
  output wire [BITS-1:0]          y_o,           // magnitude of y, shifted
  output wire                     x_negative_o,  // x was negative
  output wire                     y_negative_o,  // y was negative
  output wire [SHIFT_BITS-1:0]    shift_o,       // places shifted
  output wire                     zero_o,        // there is no vector
  output wire [META_BITS-1:0]     meta_o         // meta_i, [[ clocks ]] moves later
);

  // First clock: the input as it comes[% if levels.is_empty() %], and whether it is zero[% else %], and whether the first shift is due[% endif %].
  wire [BITS-1:0] x_raw = [[ x_raw ]];
  wire [BITS-1:0] y_raw = [[ y_raw ]];
[%- if !levels.is_empty() %]
  wire [[ first_range ]] x_top = x_raw[BITS-1:[[ first_top ]]] ^ {[[ first_bits ]]{x_i[X_BITS-1]}};
  wire [[ first_range ]] y_top = y_raw[BITS-1:[[ first_top ]]] ^ {[[ first_bits ]]{y_i[Y_BITS-1]}};
[%- endif %]

  reg                 valid_0;
  reg [BITS-1:0]      x_raw_q;
  reg [BITS-1:0]      y_raw_q;
  reg                 x_negative_0;
  reg                 y_negative_0;
  reg                 [[ first_flag ]];
  reg [META_BITS-1:0] meta_0;

  wire [BITS-1:0]       x_0     = x_raw_q ^ {BITS{x_negative_0}};
  wire [BITS-1:0]       y_0     = y_raw_q ^ {BITS{y_negative_0}};
  wire [SHIFT_BITS-1:0] shift_0 = {SHIFT_BITS{1'b0}};

  always @(posedge clk_i) begin
    if (!rst_ni) valid_0 <= 1'b0;
    else if (advance_i) valid_0 <= valid_i;
  end

  always @(posedge clk_i) begin
    if (advance_i) begin
      x_raw_q      <= x_raw;
      y_raw_q      <= y_raw;
      x_negative_0 <= x_i[X_BITS-1];
      y_negative_0 <= y_i[Y_BITS-1];
      [[ first_flag ]]        <= [[ first_flag_value ]];
      meta_0       <= meta_i;
    end
  end
[%- for level in levels %]

  // [[ level.places ]] places, where the top bits of both are empty.
[%- if !level.first %]
  wire empty_[[ level.number ]] = ~|(x_[[ level.before ]][BITS-1:[[ level.top_low ]]] | y_[[ level.before ]][BITS-1:[[ level.top_low ]]]);
[%- endif %]
[%- if level.whole %]
  wire [BITS-1:0] x_shifted_[[ level.number ]] = {BITS{x_negative_[[ level.before ]]}};
  wire [BITS-1:0] y_shifted_[[ level.number ]] = {BITS{y_negative_[[ level.before ]]}};
[%- else %]
  wire [BITS-1:0] x_shifted_[[ level.number ]] = {x_[[ level.before ]][[ self::slice(level.kept_high, 0) ]], {[[ level.places ]]{x_negative_[[ level.before ]]}}};
  wire [BITS-1:0] y_shifted_[[ level.number ]] = {y_[[ level.before ]][[ self::slice(level.kept_high, 0) ]], {[[ level.places ]]{y_negative_[[ level.before ]]}}};
[%- endif %]
  wire [BITS-1:0] x_next_[[ level.number ]] = empty_[[ level.number ]] ? x_shifted_[[ level.number ]] : x_[[ level.before ]];
  wire [BITS-1:0] y_next_[[ level.number ]] = empty_[[ level.number ]] ? y_shifted_[[ level.number ]] : y_[[ level.before ]];
  wire [SHIFT_BITS-1:0] shift_next_[[ level.number ]] = shift_[[ level.before ]] | {[[ level.shift_bit ]]};
[%- if level.registered %]

  reg                  valid_[[ level.number ]];
  reg [BITS-1:0]       x_[[ level.number ]];
  reg [BITS-1:0]       y_[[ level.number ]];
  reg                  x_negative_[[ level.number ]];
  reg                  y_negative_[[ level.number ]];
  reg [SHIFT_BITS-1:0] shift_[[ level.number ]];
  reg [META_BITS-1:0]  meta_[[ level.number ]];

  always @(posedge clk_i) begin
    if (!rst_ni) valid_[[ level.number ]] <= 1'b0;
    else if (advance_i) valid_[[ level.number ]] <= valid_[[ level.before ]];
  end

  always @(posedge clk_i) begin
    if (advance_i) begin
      x_[[ level.number ]]          <= x_next_[[ level.number ]];
      y_[[ level.number ]]          <= y_next_[[ level.number ]];
      x_negative_[[ level.number ]] <= x_negative_[[ level.before ]];
      y_negative_[[ level.number ]] <= y_negative_[[ level.before ]];
      shift_[[ level.number ]]      <= shift_next_[[ level.number ]];
      meta_[[ level.number ]]       <= meta_[[ level.before ]];
    end
  end
[%- else %]

  wire                  valid_[[ level.number ]]      = valid_[[ level.before ]];
  wire [BITS-1:0]       x_[[ level.number ]]          = x_next_[[ level.number ]];
  wire [BITS-1:0]       y_[[ level.number ]]          = y_next_[[ level.number ]];
  wire                  x_negative_[[ level.number ]] = x_negative_[[ level.before ]];
  wire                  y_negative_[[ level.number ]] = y_negative_[[ level.before ]];
  wire [SHIFT_BITS-1:0] shift_[[ level.number ]]      = shift_next_[[ level.number ]];
  wire [META_BITS-1:0]  meta_[[ level.number ]]       = meta_[[ level.before ]];
[%- endif %]
[%- endfor %]

  assign valid_o      = valid_[[ last ]];
  assign x_o          = x_[[ last ]];
  assign y_o          = y_[[ last ]];
  assign x_negative_o = x_negative_[[ last ]];
  assign y_negative_o = y_negative_[[ last ]];
  assign shift_o      = shift_[[ last ]];
  assign meta_o       = meta_[[ last ]];
[%- if levels.is_empty() %]
  assign zero_o       = zero_0;
[%- else %]
  assign zero_o       = !x_[[ last ]][BITS-1] && !y_[[ last ]][BITS-1];
[%- endif %]

endmodule
`default_nettype wire
