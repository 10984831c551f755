[[ banner ]]
// CORDIC in vectoring mode, unrolled: notes the direction of every iteration[% if with_length %], and leaves the length times [[ gain ]] in x[% endif %].
// Iteration i turns (x, sqrt([[ metric ]]) y) by atan(sqrt([[ metric ]]) / 2^i); directions, not angles, go on.
//
// y stands for its integer and a half: the bitwise complement is its negative, so |y| is an exclusive or, and its top bit is
// its sign. Only the bits that matter are kept: y loses its top bit an iteration[% if !with_length %], x its lowest while it still changes[% endif %].
// After iteration [[ x_iterations ]] x no longer changes.
//
//   iteration | x bits . fraction | y bits . fraction
[%- for row in words %]
//   [[ row ]]
[%- endfor %]
`default_nettype none
module [[ prefix ]]_cordic #(
  parameter BITS       = [[ bits ]],  // a magnitude
  parameter DIRECTIONS = [[ directions ]],  // directions: the fold's, and one an iteration
  parameter X_BITS     = [[ x_bits ]],  // x after the last iteration, unsigned, [[ x_fraction_bits ]] fraction bits
  parameter META_BITS  = [[ meta_bits ]]   // what travels along
) (
  input  wire                  clk_i,         // clock
  input  wire                  rst_ni,        // synchronous reset, active low
  input  wire                  advance_i,     // the pipeline moves
  input  wire                  valid_i,       // the inputs are a pixel's
  input  wire [BITS-1:0]       x_i,           // magnitude of x, normalised
  input  wire [BITS-1:0]       y_i,           // magnitude of y, normalised
  input  wire                  x_negative_i,  // x was negative
  input  wire                  y_negative_i,  // y was negative
  input  wire [META_BITS-1:0]  meta_i,        // travels along
  output wire                  valid_o,       // the outputs are a pixel's
  output wire [DIRECTIONS-1:0] directions_o,  // the fold's first, the last iteration's lowest; 1 is backwards
  output wire [X_BITS-1:0]     x_o,           // [% if with_length %]length times gain[% else %]0: the length is not asked for[% endif %]
  output wire [META_BITS-1:0]  meta_o         // meta_i, [[ clocks ]] moves later
);

[%- if drop_bits > 0 %]

  // [[ drop_bits ]] bits of the magnitudes are below the CORDIC's word.
  wire [[ kept_range ]] x_kept = x_i[BITS-1:[[ drop_bits ]]];
  wire [[ kept_range ]] y_kept = y_i[BITS-1:[[ drop_bits ]]];
  wire unused_bits = &{1'b0, x_i[[ self::slice(drop_bits - 1, 0) ]], y_i[[ self::slice(drop_bits - 1, 0) ]]};
[%- else %]

  wire [[ kept_range ]] x_kept = x_i;
  wire [[ kept_range ]] y_kept = y_i;
[%- endif %]

  // Iteration 0: y - x, with the complements' ones as carries and below the last bit.
  wire [[ difference_range ]] difference = {1'b0, y_kept, y_negative_i} - {1'b0, x_kept, 1'b1};
  wire unused_half = difference[0];
  wire fold = x_negative_i ^ y_negative_i;
[%- for step in moves %]
[% if step.kind == "fold" %]
  wire [[ step.x_range ]] x_next_0 = {[[ step.sum ]][% if pad_bits > 0 %], {[[ pad_bits ]]{y_negative_i}}[% endif %]};
  wire [[ step.y_range ]] y_next_0 = {difference[[ difference_top ]][% if pad_bits > 0 %], {[[ pad_bits ]]{!x_negative_i}}[% endif %]};
  wire [0:0] directions_next_0 = fold;
  wire [META_BITS-1:0] meta_in_0 = meta_i;
  wire valid_in_0 = valid_i;
[%- elif step.kind == "fold triple" %]
  // 3 y first, then x + 3 y.
  wire [[ step.x_range ]] x_next_0 = [[ step.wide_x ]];
  wire [[ step.triple_range ]] wide_y_0 = [[ step.wide_y ]];
  wire [[ step.triple_range ]] triple_next_0 = wide_y_0 + [[ step.double_y ]] + [[ step.y_carry ]];
  wire [[ step.y_range ]] y_next_0 = {difference[[ difference_top ]][% if pad_bits > 0 %], {[[ pad_bits ]]{!x_negative_i}}[% endif %]};
  wire [1:0] directions_next_0 = {x_negative_i, fold};
  wire [META_BITS-1:0] meta_in_0 = meta_i;
  wire valid_in_0 = valid_i;
[%- elif step.kind == "fold sum" %]
  wire [[ step.x_range ]] x_next_[[ step.number ]] = [[ step.sum ]];
  wire [[ step.y_range ]] y_next_[[ step.number ]] = y_[[ step.before ]];
  wire [0:0] directions_next_[[ step.number ]] = directions_[[ step.before ]][0];
[%- elif step.kind == "turn" %]
  // Iteration [[ step.iteration ]].
  wire sign_[[ step.number ]] = y_[[ step.before ]][[ self::bit(step.y_top) ]];
  wire [[ step.magnitude_range ]] magnitude_[[ step.number ]] = y_[[ step.before ]][[ self::slice(step.magnitude_top, 0) ]] ^ {[[ step.magnitude_bits ]]{sign_[[ step.number ]]}};
[%- if step.nearest %]
  wire [[ step.difference_range ]] difference_[[ step.number ]] = {[[ step.magnitude ]], 1'b0} - {[[ step.x_part ]], x_[[ step.before ]][[ self::bit(step.x_half) ]]};
  wire unused_half_[[ step.number ]] = difference_[[ step.number ]][0];
  wire [[ step.y_range ]] y_next_[[ step.number ]] = difference_[[ step.number ]][[ self::slice(step.difference_top, 1) ]];
[%- else %]
  wire [[ step.y_range ]] y_next_[[ step.number ]] = [[ step.magnitude ]] - [[ step.x_part ]];
[%- endif %]
[%- if step.unused_x != "" %]
  wire unused_x_[[ step.number ]] = &{1'b0, [[ step.unused_x ]]};
[%- endif %]
[%- if step.triple_bits > 0 %]
  wire [[ step.triple_range ]] triple_next_[[ step.number ]] = [[ step.single ]] + [[ step.double ]];
[%- endif %]
[%- if step.has_x %]
  wire [[ step.x_range ]] x_next_[[ step.number ]] = [[ step.x_next ]];
[%- endif %]
  wire [[ step.directions_range ]] directions_next_[[ step.number ]] = {directions_[[ step.before ]], directions_[[ step.before ]][0] ^ sign_[[ step.number ]]};
[%- elif step.kind == "sum" %]
  wire [[ step.x_range ]] x_next_[[ step.number ]] = [[ step.x_next ]];
  wire [[ step.y_range ]] y_next_[[ step.number ]] = y_[[ step.before ]];
  wire [[ step.directions_range ]] directions_next_[[ step.number ]] = directions_[[ step.before ]];
[%- if step.unused_x != "" %]
  wire unused_x_[[ step.number ]] = &{1'b0, [[ step.unused_x ]]};
[%- endif %]
[%- else %]
  // The last direction.
  wire unused_y_[[ step.number ]] = &{1'b0, y_[[ step.before ]][[ self::slice(step.magnitude_top, 0) ]]};
  wire [[ step.directions_range ]] directions_next_[[ step.number ]] = {directions_[[ step.before ]], directions_[[ step.before ]][0] ^ y_[[ step.before ]][[ self::bit(step.y_top) ]]};
[%- if step.has_x %]
  wire [[ step.x_range ]] x_next_[[ step.number ]] = x_[[ step.before ]];
[%- endif %]
[%- endif %]
[%- if step.number > 0 %]
  wire [META_BITS-1:0] meta_in_[[ step.number ]] = meta_[[ step.before ]];
  wire valid_in_[[ step.number ]] = valid_[[ step.before ]];
[%- endif %]
[%- if step.registered %]
  reg valid_[[ step.number ]];
[%- if step.has_x %]
  reg [[ step.x_range ]] x_[[ step.number ]];
[%- endif %]
[%- if step.has_y %]
  reg [[ step.y_range ]] y_[[ step.number ]];
[%- endif %]
[%- if step.triple_bits > 0 %]
  reg [[ step.triple_range ]] triple_[[ step.number ]];
[%- endif %]
  reg [[ step.directions_range ]] directions_[[ step.number ]];
  reg [META_BITS-1:0] meta_[[ step.number ]];
  always @(posedge clk_i) begin
    if (!rst_ni) valid_[[ step.number ]] <= 1'b0;
    else if (advance_i) valid_[[ step.number ]] <= valid_in_[[ step.number ]];
  end
  always @(posedge clk_i) begin
    if (advance_i) begin
[%- if step.has_x %]
      x_[[ step.number ]] <= x_next_[[ step.number ]];
[%- endif %]
[%- if step.has_y %]
      y_[[ step.number ]] <= y_next_[[ step.number ]];
[%- endif %]
[%- if step.triple_bits > 0 %]
      triple_[[ step.number ]] <= triple_next_[[ step.number ]];
[%- endif %]
      directions_[[ step.number ]] <= directions_next_[[ step.number ]];
      meta_[[ step.number ]] <= meta_in_[[ step.number ]];
    end
  end
[%- else %]
  wire valid_[[ step.number ]] = valid_in_[[ step.number ]];
[%- if step.has_x %]
  wire [[ step.x_range ]] x_[[ step.number ]] = x_next_[[ step.number ]];
[%- endif %]
[%- if step.has_y %]
  wire [[ step.y_range ]] y_[[ step.number ]] = y_next_[[ step.number ]];
[%- endif %]
[%- if step.triple_bits > 0 %]
  wire [[ step.triple_range ]] triple_[[ step.number ]] = triple_next_[[ step.number ]];
[%- endif %]
  wire [[ step.directions_range ]] directions_[[ step.number ]] = directions_next_[[ step.number ]];
  wire [META_BITS-1:0] meta_[[ step.number ]] = meta_in_[[ step.number ]];
[%- endif %]
[%- endfor %]

  assign valid_o      = valid_[[ last ]];
  assign directions_o = directions_[[ last ]];
  assign x_o          = [% if with_length %]x_[[ last ]][% else %]{X_BITS{1'b0}}[% endif %];
  assign meta_o       = meta_[[ last ]];

endmodule
`default_nettype wire
