[[ banner ]]
// Combines a pixel's phase with that of the set before, which was taken at the other modulation frequency, to a phase over
// the longer unambiguous range c/(2 f0) = [[ range_m ]] m: frequencies M f0 and N f0 with M = [[ m ]], N = [[ n ]].
// From the phases P1 at M f0 and P2 at N f0, in turns / 2^PHASE_BITS:
//   difference D = N P1 - M P2; its residual R = D modulo 2^PHASE_BITS, signed; ambiguity number E = (D - R) / 2^PHASE_BITS
//   unwrapped phase U = N P1 + (N K1 << PHASE_BITS) - round(share x R / 2^[[ share_bits ]]), modulo [[ codes_a_turn ]],
// with N K1 from a table of E, and share = [[ share ]] the weight of the second range in the mean of both. Where the set before is
// no partner, either phase is not usable, or |R| exceeds RESIDUAL_LIMIT, there is no unwrapped phase: 0, and usable_o is 0.
//
//   P1 | P2 | E | R | U
[%- for row in rows %]
//   [[ row ]]
[%- endfor %]
`default_nettype none
module [[ prefix ]]_unwrapping #(
  parameter PHASE_BITS      = [[ phase_bits ]],  // phase, in turns / 2^[[ phase_bits ]]
  parameter UNWRAPPED_BITS  = [[ unwrapped_bits ]],  // unwrapped phase, in turns of f0 / [[ codes_a_turn ]]
  parameter ADDRESS_BITS    = [[ address_bits ]],  // a pixel's number
  parameter PIXELS          = [[ pixels ]],  // pixels a frame
  parameter RESIDUAL_LIMIT  = [[ residual_limit ]]  // largest magnitude of a trusted residual
) (
  input  wire                      clk_i,      // clock
  input  wire                      advance_i,  // the pipeline moves
  input  wire                      valid_i,    // the inputs are a pixel's
  input  wire                      first_i,    // the frame's first
  input  wire [PHASE_BITS-1:0]     phase_i,    // its phase
  input  wire                      usable_i,   // there is one
  input  wire                      second_i,   // at N f0, not M f0
  input  wire                      partner_i,  // the set before was at the other frequency, and nothing was lost between
  output wire [UNWRAPPED_BITS-1:0] phase_o,    // the unwrapped phase, four moves later
  output wire                      usable_o    // there is one
);

  localparam DIFFERENCE_BITS = [[ difference_bits ]];  // signed
  localparam SUM_BITS        = UNWRAPPED_BITS + 2;  // the unwrapped phase before its wrap, signed

  // First move: the kept phase is read. Second: this one is written in its place.
  reg  [ADDRESS_BITS-1:0] next_q;
  wire [ADDRESS_BITS-1:0] address = first_i ? {ADDRESS_BITS{1'b0}} : next_q;
  reg                     valid_q;
  reg  [ADDRESS_BITS-1:0] address_q;
  reg  [PHASE_BITS-1:0]   phase_q;
  reg                     usable_q;
  reg                     second_q;
  reg                     partner_q;
  reg  [PHASE_BITS:0]     memory [0:PIXELS-1];  // {usable, phase} of the set before
  reg  [PHASE_BITS:0]     kept_q;
  wire [PHASE_BITS-1:0]   kept_phase  = kept_q[PHASE_BITS-1:0];
  wire                    kept_usable = kept_q[PHASE_BITS];

  // The form that synthesis infers as block RAM; a word is never read in the clock that writes it.
  always @(posedge clk_i) begin
    if (valid_q && advance_i) memory[address_q] <= {usable_q, phase_q};
    if (valid_i && advance_i) kept_q <= memory[address];
  end

  always @(posedge clk_i) begin
    if (advance_i) begin
      valid_q   <= valid_i;
      if (valid_i) next_q <= address + 1'b1;
      address_q <= address;
      phase_q   <= phase_i;
      usable_q  <= usable_i;
      second_q  <= second_i;
      partner_q <= partner_i;
    end
  end

  // Second move: the difference of the phases, each times the other's frequency.
  wire [PHASE_BITS-1:0]             phase_1      = second_q ? kept_phase : phase_q;
  wire [PHASE_BITS-1:0]             phase_2      = second_q ? phase_q : kept_phase;
  wire signed [DIFFERENCE_BITS-1:0] scaled_1     = {{(DIFFERENCE_BITS-PHASE_BITS){1'b0}}, phase_1} * [[ n_literal ]];
  wire signed [DIFFERENCE_BITS-1:0] scaled_2     = {{(DIFFERENCE_BITS-PHASE_BITS){1'b0}}, phase_2} * [[ m_literal ]];
  reg signed [DIFFERENCE_BITS-1:0]  difference_q;
  reg signed [DIFFERENCE_BITS-1:0]  scaled_q;
  reg                               both_usable_q;

  always @(posedge clk_i) begin
    if (advance_i) begin
      difference_q  <= scaled_1 - scaled_2;
      scaled_q      <= scaled_1;
      both_usable_q <= partner_q && usable_q && kept_usable;
    end
  end

  // Third move: ambiguity number, rounded to nearest, and residual.
  wire signed [PHASE_BITS-1:0]                residual  = difference_q[PHASE_BITS-1:0];
  wire [DIFFERENCE_BITS-PHASE_BITS-1:0]       ambiguity = difference_q[DIFFERENCE_BITS-1:PHASE_BITS]
                                                          + {{(DIFFERENCE_BITS-PHASE_BITS-1){1'b0}}, residual[PHASE_BITS-1]};
  wire [PHASE_BITS-1:0]                       magnitude = residual[PHASE_BITS-1] ? ~residual + 1'b1 : residual;
  wire signed [PHASE_BITS+[[ share_bits ]]:0] wide      = {{[[ share_bits + 1 ]]{residual[PHASE_BITS-1]}}, residual};
  wire signed [PHASE_BITS+[[ share_bits ]]:0] product   = wide * [[ share_literal ]];
  reg  [UNWRAPPED_BITS-PHASE_BITS-1:0]        whole_turns_d;
  reg signed [SUM_BITS-1:0]                   whole_q;
  reg signed [PHASE_BITS+[[ share_bits ]]:0]  product_q;
  reg                                         trusted_q;

  always @(*) begin
    case (ambiguity)
[%- for entry in turns %]
      [[ entry.label ]]: whole_turns_d = [[ entry.value ]];
[%- endfor %]
      default: whole_turns_d = [[ default_turns ]];
    endcase
  end

  always @(posedge clk_i) begin
    if (advance_i) begin
      whole_q   <= {2'd0, whole_turns_d, {PHASE_BITS{1'b0}}} + {{(SUM_BITS-DIFFERENCE_BITS){1'b0}}, scaled_q};
      product_q <= product;
      trusted_q <= both_usable_q && magnitude <= RESIDUAL_LIMIT[PHASE_BITS-1:0];
    end
  end

  // Fourth move: the mean, brought back into a turn of f0.
  wire signed [PHASE_BITS:0] correction = product_q[PHASE_BITS+[[ share_bits ]]:[[ share_bits ]]]
                                          + {{PHASE_BITS{1'b0}}, product_q[ [[- share_bits - 1 -]] ]};
  wire signed [SUM_BITS-1:0] mean       = whole_q - {{(SUM_BITS-PHASE_BITS-1){correction[PHASE_BITS]}}, correction};
  wire                       below      = mean[SUM_BITS-1];
  wire                       above      = !below && mean >= [[ turn_literal ]];
  wire signed [SUM_BITS-1:0] wrapped    = below ? mean + [[ turn_literal ]] : above ? mean - [[ turn_literal ]] : mean;
  reg  [UNWRAPPED_BITS-1:0]  unwrapped_q;
  reg                        unwrapped_usable_q;

  wire unused_bits = &{1'b0, product_q[ [[- share_bits - 2 -]]:0], wrapped[SUM_BITS-1:UNWRAPPED_BITS]};

  assign phase_o  = unwrapped_q;
  assign usable_o = unwrapped_usable_q;

  always @(posedge clk_i) begin
    if (advance_i) begin
      unwrapped_q        <= trusted_q ? wrapped[UNWRAPPED_BITS-1:0] : {UNWRAPPED_BITS{1'b0}};
      unwrapped_usable_q <= trusted_q;
    end
  end

endmodule
`default_nettype wire
