[[ banner ]]
// Rounds the octant's angle to the phase word and undoes the octant fold. Where there is no vector the phase is 0.
// The result is a fraction of a turn: its overflow is the phase's wrap.
//
//   octant {swapped, y negative, x negative} | phase
//   000                                      | angle
//   001                                      | 1/2 turn - angle
//   110                                      | 3/4 turn + angle
`default_nettype none
module [[ prefix ]]_phase #(
  parameter ANGLE_BITS = [[ angle_bits ]],  // angle, signed
  parameter GUARD_BITS = [[ guard_bits ]],  // bits of it below the phase's resolution
  parameter PHASE_BITS = [[ phase_bits ]]   // phase, in turns / 2^[[ phase_bits ]]
) (
  input  wire                  clk_i,      // clock
  input  wire                  advance_i,  // the pipeline moves
  input  wire [ANGLE_BITS-1:0] angle_i,    // angle within the octant, signed
  input  wire [2:0]            octant_i,   // {swapped, y was negative, x was negative}
  input  wire                  zero_i,     // there is no vector
  output wire [PHASE_BITS-1:0] phase_o     // phase, two moves later
);

  reg [PHASE_BITS-1:0] rounded_q;
  reg [2:0]            octant_q;
  reg                  zero_q;
  reg [PHASE_BITS-1:0] phase_q;

  wire [PHASE_BITS-1:0] kept  = {angle_i[ANGLE_BITS-1], angle_i[ANGLE_BITS-1:GUARD_BITS]};
  wire [PHASE_BITS-1:0] carry = {{(PHASE_BITS-1){1'b0}}, angle_i[GUARD_BITS-1]};
[%- if guard_bits > 1 %]
  wire                  unused_bits = &{1'b0, angle_i[GUARD_BITS-2:0]};
[%- endif %]

  wire                  swapped   = octant_q[2];
  wire                  backwards = ^octant_q;
  wire [1:0]            quarters  = {swapped ? octant_q[1] : octant_q[0], swapped};
  wire [PHASE_BITS-1:0] base      = {quarters, {(PHASE_BITS-2){1'b0}}};
  wire [PHASE_BITS-1:0] turned    = base + (rounded_q ^ {PHASE_BITS{backwards}}) + {{(PHASE_BITS-1){1'b0}}, backwards};

  assign phase_o = phase_q;

  always @(posedge clk_i) begin
    if (advance_i) begin
      rounded_q <= kept + carry;
      octant_q  <= octant_i;
      zero_q    <= zero_i;
      phase_q   <= zero_q ? {PHASE_BITS{1'b0}} : turned;
    end
  end

endmodule
`default_nettype wire
