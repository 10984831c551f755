[[ banner ]]
// Knows the order of the phase steps: gives the step of the frame that arrives, and tells the modulation hardware which step the
// next raw frame must have. It tells when a frame begins, which is when the next one may be exposed, and when a set is lost.
// It does not know how far the modulation hardware is: what it has told stands until it tells the next.
//
//   place | step | phase (turns / 2^[[ phase_bits ]])   (scheme [[ scheme ]])
[%- for row in places %]
//   [[ row ]]
[%- endfor %]
//
//   framing                | told
//   after a reset          | first frame of a set, without a strobe
//   a frame begins         | the frame after it; after a set's last frame, the first of the next set
//   the set is discarded   | first frame of a set
`default_nettype none
module [[ prefix ]]_sequencer #(
  parameter STEP_BITS  = [[ step_bits ]],  // a phase step's number, and its place within the set
  parameter PHASE_BITS = [[ phase_bits ]]   // its phase, a fraction of a turn
) (
  input  wire                  clk_i,          // clock
  input  wire                  rst_ni,         // synchronous reset, active low
  input  wire                  frame_i,        // the first pixel of a frame is taken
  input  wire                  lost_i,         // the set is discarded
  input  wire [STEP_BITS-1:0]  place_i,        // place of the phase step of the pixel that is taken
  input  wire [STEP_BITS-1:0]  next_place_i,   // place of the next frame's phase step
  input  wire                  next_first_i,   // the next frame is a set's first
  output wire [STEP_BITS-1:0]  step_o,         // phase step of the pixel that is taken
  output wire                  next_strobe_o,  // for a clock: what follows is new
  output wire                  next_first_o,   // the next frame is a set's first
  output wire [STEP_BITS-1:0]  next_step_o,    // its phase step
  output wire [PHASE_BITS-1:0] next_phase_o    // its phase step, turns / 2^PHASE_BITS
);

  function automatic [STEP_BITS-1:0] step_at(input reg [STEP_BITS-1:0] place);
[%- if ascending %]
    step_at = place;
[%- else %]
    case (place)
[%- for row in order %]
      [[ row.label ]]: step_at = [[ row.value ]];
[%- endfor %]
    endcase
[%- endif %]
  endfunction

  function automatic [PHASE_BITS-1:0] phase_of(input reg [STEP_BITS-1:0] step);
    case (step)
[%- for row in phases %]
      [[ row.label ]]: phase_of = [[ row.value ]];
[%- endfor %]
    endcase
  endfunction

  reg                  next_strobe_q;
  reg                  next_first_q;
  reg [STEP_BITS-1:0]  next_step_q;
  reg [PHASE_BITS-1:0] next_phase_q;

  wire [STEP_BITS-1:0] step = step_at(lost_i ? {STEP_BITS{1'b0}} : next_place_i);

  assign step_o        = step_at(place_i);
  assign next_strobe_o = next_strobe_q;
  assign next_first_o  = next_first_q;
  assign next_step_o   = next_step_q;
  assign next_phase_o  = next_phase_q;

  always @(posedge clk_i) begin
    if (!rst_ni) begin
      next_strobe_q <= 1'b0;
      next_first_q  <= 1'b1;
      next_step_q   <= [[ first_step ]];
      next_phase_q  <= [[ first_phase ]];
    end else begin
      next_strobe_q <= frame_i || lost_i;
      if (frame_i || lost_i) begin
        next_first_q <= lost_i || next_first_i;
        next_step_q  <= step;
        next_phase_q <= phase_of(step);
      end
    end
  end

endmodule
`default_nettype wire
