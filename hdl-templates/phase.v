[[ banner ]]
// The phase, from the directions of all iterations: a table of sums of angles for every few of them, added from the
// smallest up, and the sector from which the angle is counted. Half a code is in the first table, so cutting the guard
// bits off rounds. Where there is no vector the phase is 0. The result is a fraction of a turn: its overflow is its wrap.
//
//   iterations | largest sum in turns / 2^[[ angle_bits ]]
[%- for group in groups %]
//   [[ group.title ]]
[%- endfor %]
`default_nettype none
module [[ prefix ]]_phase #(
  parameter DIRECTIONS = [[ directions ]],  // directions: the fold's, and one an iteration
  parameter PHASE_BITS = [[ phase_bits ]],  // phase, in turns / 2^[[ phase_bits ]]
  parameter META_BITS  = [[ meta_bits ]]   // what travels along
) (
  input  wire                  clk_i,         // clock
  input  wire                  rst_ni,        // synchronous reset, active low
  input  wire                  advance_i,     // the pipeline moves
  input  wire                  valid_i,       // the inputs are a pixel's
  input  wire [DIRECTIONS-1:0] directions_i,  // the fold's first, the last iteration's lowest; 1 is backwards
  input  wire                  side_i,        // [% if quarters %]y[% else %]x[% endif %] was negative
  input  wire                  zero_i,        // there is no vector
  input  wire [META_BITS-1:0]  meta_i,        // travels along
  output wire                  valid_o,       // the outputs are a pixel's
  output wire [PHASE_BITS-1:0] phase_o,       // phase
  output wire                  zero_o,        // there is no vector
  output wire [META_BITS-1:0]  meta_o         // meta_i, [[ clocks ]] moves later
);

  // Beside the sum: sector, zero and what travels along.
  reg [[ valid_range ]]           valid_q;
  reg [META_BITS+[[ sector_bits ]]:0] beside_0;
[%- for clock in later_clocks %]
  reg [META_BITS+[[ sector_bits ]]:0] beside_[[ clock.number ]];
[%- endfor %]

  always @(posedge clk_i) begin
    if (!rst_ni) valid_q <= [[ clocks ]]'d0;
    else if (advance_i) valid_q <= {valid_q[[ self::slice(clocks - 2, 0) ]], valid_i};
  end

  always @(posedge clk_i) begin
    if (advance_i) begin
      beside_0 <= {[% if quarters %]side_i, directions_i[DIRECTIONS-1][% else %]side_i[% endif %], zero_i, meta_i};
[%- for clock in later_clocks %]
      beside_[[ clock.number ]] <= beside_[[ clock.before ]];
[%- endfor %]
    end
  end

  // First clock: the tables.
[%- for group in groups %]
  reg [[ group.range ]] row_[[ group.number ]]_0;
[%- endfor %]

  always @(posedge clk_i) begin
    if (advance_i) begin
[%- for group in groups %]
      case (directions_i[[ self::slice(group.high, group.low) ]])
[%- for row in group.rows %]
        [[ row ]]
[%- endfor %]
      endcase
[%- endfor %]
    end
  end
[%- for clock in sums %]

  // The sum of the last [[ clock.added ]] tables.
  reg [[ clock.range ]] sum_[[ clock.number ]];
[%- for waiting in clock.waiting %]
  reg [[ waiting.range ]] row_[[ waiting.number ]]_[[ clock.number ]];
[%- endfor %]
  always @(posedge clk_i) begin
    if (advance_i) begin
      sum_[[ clock.number ]] <= [[ clock.row ]] + [[ clock.sum ]];
[%- for waiting in clock.waiting %]
      row_[[ waiting.number ]]_[[ clock.number ]] <= row_[[ waiting.number ]]_[[ clock.before ]];
[%- endfor %]
    end
  end
[%- endfor %]

  // Last clock: the sector and the largest table.
  wire [[ angle_range ]] base  = {beside_[[ clocks - 2 ]][META_BITS+[[ sector_bits ]]:META_BITS+1], [[ base ]]};
  wire [[ angle_range ]] angle = row_0_[[ clocks - 2 ]] + base;
  wire unused_bits = &{1'b0, angle[[ self::slice(guard_bits - 1, 0) ]], beside_[[ clocks - 1 ]][META_BITS+[[ sector_bits ]]:META_BITS+1]};

  reg [PHASE_BITS-1:0] phase_q;

  always @(posedge clk_i) begin
    if (advance_i) phase_q <= beside_[[ clocks - 2 ]][META_BITS] ? {PHASE_BITS{1'b0}} : angle[[ self::slice(angle_bits - 1, guard_bits) ]];
  end

  assign valid_o = valid_q[[ self::bit(clocks - 1) ]];
  assign phase_o = phase_q;
  assign zero_o  = beside_[[ clocks - 1 ]][META_BITS];
  assign meta_o  = beside_[[ clocks - 1 ]][META_BITS-1:0];

endmodule
`default_nettype wire
