[[ banner ]]
// A vector [% if clocks_a_vector == 1 %]a clock[% else %]every [[ clocks_a_vector ]] clocks[% endif %], its phase [[ latency ]] clocks later. The phase is a fraction of a turn, 0 where there is no vector.
[%- if folded %]
// The CORDIC's ring takes a vector when one of its places is free; before that the normaliser waits.
[%- endif %]
`default_nettype none
module [[ prefix ]]_angle #(
  parameter X_BITS      = [[ x_bits ]],  // x, signed
  parameter Y_BITS      = [[ y_bits ]],  // y, signed
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

  wire advance = !valid_o || ready_i;
  wire normal_valid;
[%- if folded %]
  wire turn_ready;
  wire normal_advance = !normal_valid || turn_ready;
[%- else %]
  wire normal_advance = advance;
[%- endif %]
  assign ready_o = normal_advance;

  wire [[ bits_range ]] normal_x;
  wire [[ bits_range ]] normal_y;
  wire normal_x_negative;
  wire normal_y_negative;
  wire [[ shift_range ]] normal_shift;
  wire normal_zero;
  wire [META_BITS-1:0] normal_meta;

  [[ prefix ]]_normaliser #(
    .META_BITS(META_BITS)
  ) u_normaliser (
    .clk_i       (clk_i),
    .rst_ni      (rst_ni),
    .advance_i   (normal_advance),
    .valid_i     (valid_i),
    .x_i         (x_i),
    .y_i         (y_i),
    .meta_i      (meta_i),
    .valid_o     (normal_valid),
    .x_o         (normal_x),
    .y_o         (normal_y),
    .x_negative_o(normal_x_negative),
    .y_negative_o(normal_y_negative),
    .shift_o     (normal_shift),
    .zero_o      (normal_zero),
    .meta_o      (normal_meta)
  );

  wire turned_valid;
  wire [[ directions_range ]] turned_directions;
  wire [[ length_range ]] turned_length;
  wire turned_side;
  wire turned_zero;
[%- if with_length %]
  wire [[ shift_range ]] turned_shift;
[%- endif %]
  wire [META_BITS-1:0] turned_meta;

  [[ prefix ]]_cordic #(
    .META_BITS(META_BITS + 2[% if with_length %] + SHIFT_BITS[% endif %])
  ) u_cordic (
    .clk_i       (clk_i),
    .rst_ni      (rst_ni),
    .advance_i   (advance),
    .valid_i     (normal_valid),
[%- if folded %]
    .ready_o     (turn_ready),
[%- endif %]
    .x_i         (normal_x),
    .y_i         (normal_y),
    .x_negative_i(normal_x_negative),
    .y_negative_i(normal_y_negative),
    .meta_i      ({[% if with_length %]normal_shift, [% endif %][% if quarters %]normal_y_negative[% else %]normal_x_negative[% endif %], normal_zero, normal_meta}),
    .valid_o     (turned_valid),
    .directions_o(turned_directions),
    .x_o         (turned_length),
    .meta_o      ({[% if with_length %]turned_shift, [% endif %]turned_side, turned_zero, turned_meta})
  );
[%- if !with_length %]
  wire unused_bits = &{1'b0, normal_shift, turned_length};
[%- endif %]

  [[ prefix ]]_phase #(
    .META_BITS([% if with_length %]LENGTH_BITS + SHIFT_BITS + [% endif %]META_BITS)
  ) u_phase (
    .clk_i       (clk_i),
    .rst_ni      (rst_ni),
    .advance_i   (advance),
    .valid_i     (turned_valid),
    .directions_i(turned_directions),
    .side_i      (turned_side),
    .zero_i      (turned_zero),
    .meta_i      ({[% if with_length %]turned_length, turned_shift, [% endif %]turned_meta}),
    .valid_o     (valid_o),
    .phase_o     (phase_o),
    .zero_o      (zero_o),
    .meta_o      ({[% if with_length %]length_o, shift_o, [% endif %]meta_o})
  );
[%- if !with_length %]
  assign length_o = {LENGTH_BITS{1'b0}};
  assign shift_o  = {SHIFT_BITS{1'b0}};
[%- endif %]

endmodule
`default_nettype wire
