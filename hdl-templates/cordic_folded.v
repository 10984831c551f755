[[ banner ]]
// CORDIC in vectoring mode, folded: a ring of [[ stage_count ]] stages through which every vector goes [[ rounds ]] times. It notes the direction
// of every iteration[% if with_length %], and leaves the length times [[ gain ]] in x[% endif %]. Iteration i turns (x, sqrt([[ metric ]]) y) by atan(sqrt([[ metric ]]) / 2^i).
//
// y is doubled at every iteration, so that all of them take x as it is; it stands for its integer and a half: the bitwise
// complement is its negative, |y| an exclusive or, its top bit its sign. After iteration [[ x_iterations ]] x no longer changes.
//
//   round | iterations
[%- for row in round_rows %]
//   [[ row ]]
[%- endfor %]
`default_nettype none
module [[ prefix ]]_cordic #(
  parameter BITS       = [[ bits ]],  // a magnitude
  parameter DIRECTIONS = [[ directions ]],  // directions: the fold's, and one an iteration
  parameter X_BITS     = [[ x_bits ]],  // x, unsigned, [[ fraction_bits ]] fraction bits
  parameter Y_BITS     = [[ y_bits ]],  // y times 2^iteration, signed, [[ fraction_bits ]] fraction bits
  parameter ROUND_BITS = [[ round_bits ]],  // the round
  parameter META_BITS  = [[ meta_bits ]]   // what travels along
) (
  input  wire                  clk_i,         // clock
  input  wire                  rst_ni,        // synchronous reset, active low
  input  wire                  advance_i,     // what leaves the ring is taken
  input  wire                  valid_i,       // the inputs are a pixel's
  output wire                  ready_o,       // they are taken
  input  wire [BITS-1:0]       x_i,           // magnitude of x, normalised
  input  wire [BITS-1:0]       y_i,           // magnitude of y, normalised
  input  wire                  x_negative_i,  // x was negative
  input  wire                  y_negative_i,  // y was negative
  input  wire [META_BITS-1:0]  meta_i,        // travels along
  output wire                  valid_o,       // the outputs are a pixel's
  output wire [DIRECTIONS-1:0] directions_o,  // the fold's first, the last iteration's lowest; 1 is backwards
  output wire [X_BITS-1:0]     x_o,           // length times gain
  output wire [META_BITS-1:0]  meta_o         // meta_i of the same vector
);

  localparam [ROUND_BITS-1:0] LAST_ROUND = [[ last_round ]];

  // As it is loaded: x, and half of y, so that iteration 0 doubles it like all others.
  wire [X_BITS-1:0] x_load = [[ x_load ]];
  wire [Y_BITS-1:0] y_load = [[ y_load ]];
[%- if unused_load != "" %]
  wire unused_bits = &{1'b0, [[ unused_load ]]};
[%- endif %]

  // What is back from the last stage, unless it leaves.
  wire leaves = round_[[ last_stage ]] == LAST_ROUND;
  wire back   = valid_[[ last_stage ]] && !leaves;
  assign ready_o = advance_i && !back;

  reg                  leave_valid_q;
  reg [DIRECTIONS-1:0] leave_directions_q;
  reg [X_BITS-1:0]     leave_x_q;
  reg [META_BITS-1:0]  leave_meta_q;
  assign valid_o      = leave_valid_q;
  assign directions_o = leave_directions_q;
  assign x_o          = leave_x_q;
  assign meta_o       = leave_meta_q;

  always @(posedge clk_i) begin
    if (!rst_ni) leave_valid_q <= 1'b0;
    else if (advance_i) leave_valid_q <= valid_[[ last_stage ]] && leaves;
  end

  always @(posedge clk_i) begin
    if (advance_i) begin
      leave_directions_q <= {directions_next_[[ last_stage ]], directions_next_[[ last_stage ]][0] ^ y_next_[[ last_stage ]][Y_BITS-1]};
      leave_x_q          <= x_next_[[ last_stage ]];
      leave_meta_q       <= meta_[[ last_stage ]];
    end
  end
[%- for stage in stages %]

  // Stage [[ stage.number ]]: iterations [[ stage.iterations ]].
  reg                  valid_[[ stage.number ]];
  reg [ROUND_BITS-1:0] round_[[ stage.number ]];
  reg [X_BITS-1:0]     x_[[ stage.number ]];
  reg [Y_BITS-1:0]     y_[[ stage.number ]];
  // All directions so far; the fold's is there twice.
  reg [DIRECTIONS-2:0] directions_[[ stage.number ]];
  reg [META_BITS-1:0]  meta_[[ stage.number ]];

  always @(posedge clk_i) begin
    if (!rst_ni) valid_[[ stage.number ]] <= 1'b0;
    else if (advance_i) valid_[[ stage.number ]] <= [% if stage.number == 0 %]back || valid_i[% else %]valid_[[ stage.before ]][% endif %];
  end

  always @(posedge clk_i) begin
    if (advance_i) begin
[%- if stage.number == 0 %]
      round_0      <= back ? round_[[ last_stage ]] + [[ one_round ]] : [[ no_round ]];
      x_0          <= back ? x_next_[[ last_stage ]] : x_load;
      y_0          <= back ? y_next_[[ last_stage ]] : y_load;
      directions_0 <= back ? directions_next_[[ last_stage ]] : {[% if directions > 2 %][[ directions - 2 ]]'d0, [% endif %]x_negative_i ^ y_negative_i};
      meta_0       <= back ? meta_[[ last_stage ]] : meta_i;
[%- else %]
      round_[[ stage.number ]]      <= round_[[ stage.before ]];
      x_[[ stage.number ]]          <= x_next_[[ stage.before ]];
      y_[[ stage.number ]]          <= y_next_[[ stage.before ]];
      directions_[[ stage.number ]] <= directions_next_[[ stage.before ]];
      meta_[[ stage.number ]]       <= meta_[[ stage.before ]];
[%- endif %]
    end
  end

  wire                  sign_[[ stage.number ]]      = y_[[ stage.number ]][Y_BITS-1];
  wire [Y_BITS-2:0]     magnitude_[[ stage.number ]] = y_[[ stage.number ]][Y_BITS-2:0] ^ {(Y_BITS-1){sign_[[ stage.number ]]}};
  wire [Y_BITS-1:0]     y_next_[[ stage.number ]]    = {magnitude_[[ stage.number ]], magnitude_[[ stage.number ]][0]} - [[ stage.x_wide ]];
  wire [DIRECTIONS-2:0] directions_next_[[ stage.number ]] = {directions_[[ stage.number ]][DIRECTIONS-3:0], directions_[[ stage.number ]][0] ^ sign_[[ stage.number ]]};
  wire                  unused_direction_[[ stage.number ]] = directions_[[ stage.number ]][DIRECTIONS-2];
[%- if stage.follows %]
  wire [[ stage.part_range ]] part_[[ stage.number ]] = [[ stage.part ]];
[%- if stage.unused_part != "" %]
  wire unused_part_[[ stage.number ]] = &{1'b0, [[ stage.unused_part ]]};
[%- endif %]
[%- if stage.shifts.len() == 1 %]
  wire [X_BITS:0] grown_[[ stage.number ]] = [[ stage.only_shift ]];
[%- else %]
  reg [X_BITS:0] grown_[[ stage.number ]];
  always @(*) begin
    case (round_[[ stage.number ]])
[%- for shift in stage.shifts %]
      [[ shift ]]
[%- endfor %]
    endcase
  end
[%- endif %]
  wire [X_BITS-1:0] x_next_[[ stage.number ]] = x_[[ stage.number ]] + grown_[[ stage.number ]][X_BITS:1][% if nearest %] + {{(X_BITS-1){1'b0}}, grown_[[ stage.number ]][0]}[% endif %];
[%- if !nearest %]
  wire unused_half_[[ stage.number ]] = grown_[[ stage.number ]][0];
[%- endif %]
[%- else %]
  wire [X_BITS-1:0] x_next_[[ stage.number ]] = x_[[ stage.number ]];
[%- endif %]
[%- endfor %]

endmodule
`default_nettype wire
