[[ banner ]]
// One iteration a clock: [[ clocks ]] clocks a vector. While one is turned, the next is shifted left, a place a clock, until its
// larger coordinate's top bit is set, so that a weak pixel's phase is as exact as its bits allow. Where there is no vector
// the phase is 0. Iteration i turns (x, sqrt([[ metric ]]) y) by atan(sqrt([[ metric ]]) / 2^i).
//
// A negative coordinate is complemented bit by bit; the one that a complement lacks comes as ones from the right. y is
// doubled at every iteration, so that all of them take x as it is; it stands for its integer and a half: the bitwise
// complement is its negative, |y| an exclusive or, its top bit its sign. After iteration [[ x_iterations ]] x no longer changes.
//
//   count        | iteration | angle
//   0            | 0         | set to the angle of all iterations backwards
//   1 to [[ iterations ]]      | count     | twice the angle of iteration count is added if it went forwards
//   [[ done_count ]]           | -         | the result is taken, the next vector starts
`default_nettype none
module [[ prefix ]]_angle #(
  parameter X_BITS      = [[ x_bits ]],  // x, signed
  parameter Y_BITS      = [[ y_bits ]],  // y, signed
  parameter BITS        = [[ bits ]],  // a magnitude
  parameter TURN_X_BITS = [[ turn_x_bits ]],  // x while it is turned, unsigned, [[ fraction_bits ]] fraction bits
  parameter TURN_Y_BITS = [[ turn_y_bits ]],  // y times 2^iteration, signed, [[ fraction_bits ]] fraction bits
  parameter ANGLE_BITS  = [[ angle_bits ]],  // angle, in turns / 2^[[ angle_bits ]]
  parameter PHASE_BITS  = [[ phase_bits ]],  // phase, in turns / 2^[[ phase_bits ]]
  parameter LENGTH_BITS = [[ length_bits ]],  // length times gain, of the normalised vector
  parameter SHIFT_BITS  = [[ shift_bits ]],  // places by which the vector was shifted
  parameter META_BITS   = [[ meta_bits ]]   // what travels along
) (
  input  wire                     clk_i,     // clock
  input  wire                     rst_ni,    // synchronous reset, active low
  input  wire                     valid_i,   // a vector is offered
  output wire                     ready_o,   // it is taken
  input  wire signed [X_BITS-1:0] x_i,       // x of the vector
  input  wire signed [Y_BITS-1:0] y_i,       // y of the vector
  input  wire [META_BITS-1:0]     meta_i,    // travels along
  output wire                     valid_o,   // a phase is offered
  input  wire                     ready_i,   // it is taken
  output wire [PHASE_BITS-1:0]    phase_o,   // phase
  output wire                     zero_o,    // there is no vector
  output wire [LENGTH_BITS-1:0]   length_o,  // [% if with_length %]length times gain[% else %]0: the length is not asked for[% endif %]
  output wire [SHIFT_BITS-1:0]    shift_o,   // [% if with_length %]places by which the vector was shifted[% else %]0[% endif %]
  output wire [META_BITS-1:0]     meta_o     // meta_i of the same vector
);

  // The vector that waits for its turn, and is normalised meanwhile.
  reg                 wait_valid_q;
  reg [BITS-1:0]      wait_x_q;
  reg [BITS-1:0]      wait_y_q;
  reg                 wait_x_negative_q;
  reg                 wait_y_negative_q;
  reg [META_BITS-1:0] wait_meta_q;
[%- if normalise %]
  reg [SHIFT_BITS-1:0] wait_shift_q;
  wire wait_top   = wait_x_q[BITS-1] | wait_y_q[BITS-1];
  wire wait_ready = wait_top | wait_shift_q == [[ most_shifts ]];
  wire wait_zero  = !wait_top;
[%- else %]
  wire wait_ready = 1'b1;
  wire wait_zero  = wait_x_q == {BITS{1'b0}} && wait_y_q == {BITS{1'b0}} && !wait_x_negative_q && !wait_y_negative_q;
[%- endif %]

  // The vector that is turned.
  reg                    turning_q;
  reg [[ count_range ]]              count_q;
  reg [TURN_X_BITS-1:0]  x_q;
  reg [TURN_Y_BITS-1:0]  y_q;
  reg                    direction_q;
  reg [ANGLE_BITS-1:0]   angle_q;
  reg                    side_q;
  reg                    zero_q;
  reg [META_BITS-1:0]    meta_q;
[%- if with_length && normalise %]
  reg [SHIFT_BITS-1:0]   shift_q;
[%- endif %]

  // The result that is offered.
  reg                    result_valid_q;
  reg [PHASE_BITS-1:0]   result_phase_q;
  reg                    result_zero_q;
  reg [META_BITS-1:0]    result_meta_q;
[%- if with_length %]
  reg [LENGTH_BITS-1:0]  result_length_q;
  reg [SHIFT_BITS-1:0]   result_shift_q;
[%- endif %]

  wire done  = turning_q && count_q == [[ done_literal ]];
  wire leave = done && (!result_valid_q || ready_i);
  wire start = wait_valid_q && wait_ready && (!turning_q || leave);

  assign ready_o = !wait_valid_q || start;

  wire [BITS-1:0] x_raw = [[ x_raw ]];
  wire [BITS-1:0] y_raw = [[ y_raw ]];

  always @(posedge clk_i) begin
    if (!rst_ni) wait_valid_q <= 1'b0;
    else wait_valid_q <= valid_i || !ready_o;
  end

  always @(posedge clk_i) begin
    if (ready_o) begin
      wait_x_negative_q <= x_i[X_BITS-1];
      wait_y_negative_q <= y_i[Y_BITS-1];
      wait_meta_q       <= meta_i;
    end
[%- if normalise %]
    if (ready_o) wait_shift_q <= {SHIFT_BITS{1'b0}};
    else if (!wait_ready) wait_shift_q <= wait_shift_q + [[ one_shift ]];
    if (ready_o || !wait_ready) begin
      wait_x_q <= ready_o ? x_raw ^ {BITS{x_i[X_BITS-1]}} : [[ x_shifted ]];
      wait_y_q <= ready_o ? y_raw ^ {BITS{y_i[Y_BITS-1]}} : [[ y_shifted ]];
    end
[%- else %]
    if (ready_o) begin
      wait_x_q <= x_raw ^ {BITS{x_i[X_BITS-1]}};
      wait_y_q <= y_raw ^ {BITS{y_i[Y_BITS-1]}};
    end
[%- endif %]
  end

  // An iteration. x grows by a part of |y|, shifted two places further each time; half a unit more is kept for rounding.
  wire                   sign      = y_q[TURN_Y_BITS-1];
  wire [TURN_Y_BITS-2:0] magnitude = y_q[TURN_Y_BITS-2:0] ^ {(TURN_Y_BITS-1){sign}};
  wire                   direction = direction_q ^ sign;
  wire [[ part_range ]]  part      = [[ part ]];
  wire [[ doubled_range ]] doubled = {part, 2'd0};
  wire [[ doubled_range ]] shifted = doubled >> {count_q[[ self::slice(x_count_high, 0) ]], 1'b0};
  wire [TURN_X_BITS-1:0] grown     = [[ grown ]];
[%- if nearest %]
  wire [TURN_X_BITS-1:0] carry     = {{(TURN_X_BITS-1){1'b0}}, shifted[0]};
[%- endif %]
[%- if unused_shifted != "" %]
  wire                   unused_shifted = &{1'b0, [[ unused_shifted ]]};
[%- endif %]

  wire [TURN_X_BITS-1:0] x_load = [[ x_load ]];
  wire [TURN_Y_BITS-1:0] y_load = [[ y_load ]];
[%- if unused_load != "" %]
  wire                   unused_load = &{1'b0, [[ unused_load ]]};
[%- endif %]

  // Twice the angle of iteration 1, 2, ...
  reg [[ row_range ]] row;
  always @(*) begin
    case (count_q[[ self::slice(row_high, 0) ]])
[%- for row in rows %]
      [[ row ]]
[%- endfor %]
    endcase
  end

  always @(posedge clk_i) begin
    if (!rst_ni) turning_q <= 1'b0;
    else turning_q <= start || (turning_q && !leave);
  end

  always @(posedge clk_i) begin
    if (start) count_q <= [[ zero_count ]];
    else if (!done) count_q <= count_q + [[ one_count ]];

    if (start || count_q <= [[ x_count ]]) x_q <= start ? x_load : x_q + grown[% if nearest %] + carry[% endif %];
    y_q         <= start ? y_load : {magnitude, magnitude[0]} - [[ x_wide ]];
    direction_q <= start ? wait_x_negative_q ^ wait_y_negative_q : direction;

[%- if fold_row != "" %]
    if (count_q == [[ zero_count ]]) angle_q <= direction ? [[ fold_row ]] : [[ first_row ]];
[%- else %]
    if (count_q == [[ zero_count ]]) angle_q <= [[ first_row ]];
[%- endif %]
    else if (!direction && !done) angle_q <= angle_q + [[ row_wide ]];

    if (start) begin
      side_q <= [% if quarters %]wait_y_negative_q[% else %]wait_x_negative_q[% endif %];
      zero_q <= wait_zero;
      meta_q <= wait_meta_q;
[%- if with_length && normalise %]
      shift_q <= wait_shift_q;
[%- endif %]
    end
  end
[%- if quarters %]

  // The fold's direction is the lower bit of the quarter.
  reg fold_q;
  always @(posedge clk_i) begin
    if (start) fold_q <= wait_x_negative_q ^ wait_y_negative_q;
  end
  wire [1:0] sector = {side_q, fold_q};
[%- else %]
  wire sector = side_q;
[%- endif %]
  wire [[ sector_range ]] turned_sector = angle_q[ANGLE_BITS-1:ANGLE_BITS-[[ sector_bits ]]] + sector;
  wire [PHASE_BITS-1:0] turned_phase = {turned_sector, angle_q[ANGLE_BITS-[[ sector_bits ]]-1:[[ guard_bits ]]]};
  wire unused_angle = &{1'b0, angle_q[[ self::slice(guard_bits - 1, 0) ]]};

  always @(posedge clk_i) begin
    if (!rst_ni) result_valid_q <= 1'b0;
    else result_valid_q <= leave || (result_valid_q && !ready_i);
  end

  always @(posedge clk_i) begin
    if (leave) begin
      result_phase_q <= zero_q ? {PHASE_BITS{1'b0}} : turned_phase;
      result_zero_q  <= zero_q;
      result_meta_q  <= meta_q;
[%- if with_length %]
      result_length_q <= x_q;
      result_shift_q  <= [% if normalise %]shift_q[% else %]{SHIFT_BITS{1'b0}}[% endif %];
[%- endif %]
    end
  end

  assign valid_o  = result_valid_q;
  assign phase_o  = result_phase_q;
  assign zero_o   = result_zero_q;
  assign meta_o   = result_meta_q;
[%- if with_length %]
  assign length_o = result_length_q;
  assign shift_o  = result_shift_q;
[%- else %]
  assign length_o = {LENGTH_BITS{1'b0}};
  assign shift_o  = {SHIFT_BITS{1'b0}};
[%- endif %]

endmodule
`default_nettype wire
