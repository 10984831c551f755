[[ banner ]]
// Adds every sample, times its step's weights, to its pixel's in-phase, quadrature and offset sums while frames
// arrive, and drains the sums of a complete set. It keeps no raw frame, and one memory serves both: a set's first frame
// replaces sums that have just been drained, so that nothing is ever cleared and no second buffer is needed.
//
//   step | in-phase | quadrature | offset   (weights of scheme [[ scheme ]])
[%- for step in steps %]
//   [[ step.number ]]    | [[ step.in_phase ]]       | [[ step.quadrature ]]         | [[ step.offset ]]
[%- endfor %]
`default_nettype none
module [[ prefix ]]_accumulator #(
  parameter SAMPLE_BITS     = [[ sample_bits ]],  // a raw code
  parameter IN_PHASE_BITS   = [[ in_phase_bits ]],  // in-phase sum, signed
  parameter QUADRATURE_BITS = [[ quadrature_bits ]],  // quadrature sum, signed
  parameter OFFSET_BITS     = [[ offset_bits ]],  // offset sum, unsigned
  parameter ADDRESS_BITS    = [[ address_bits ]],  // a pixel's number
  parameter COLUMN_BITS     = [[ column_bits ]],  // a column's number
  parameter STEP_BITS       = [[ step_bits ]],  // a phase step's number
  parameter PIXELS          = [[ pixels ]],  // pixels a frame
  parameter LAST_COLUMN     = [[ last_column ]],  // width - 1
  parameter SATURATION      = [[ saturation ]]  // least code that counts as saturated
) (
  input  wire                              clk_i,            // clock
  input  wire                              rst_ni,           // synchronous reset, active low
  input  wire                              take_i,           // a pixel of a set is there
  input  wire        [SAMPLE_BITS-1:0]     sample_i,         // its raw code, DN
  input  wire        [ADDRESS_BITS-1:0]    address_i,        // its number within the frame
  input  wire        [STEP_BITS-1:0]       step_i,           // its phase step
  input  wire                              first_frame_i,    // replace, do not add
  input  wire                              drain_start_i,    // a set is complete
  output wire                              drain_busy_o,     // its sums still drain
  output wire        [ADDRESS_BITS:0]      drain_address_o,  // the pixel that drains next
  input  wire                              advance_i,        // the pipeline behind moves
  output wire                              valid_o,          // the outputs below are a pixel's
  output wire                              first_o,          // the frame's first
  output wire                              last_o,           // its line's last
  output wire signed [IN_PHASE_BITS-1:0]   in_phase_o,       // sum of in-phase weight x code
  output wire signed [QUADRATURE_BITS-1:0] quadrature_o,     // sum of quadrature weight x code
  output wire        [OFFSET_BITS-1:0]     offset_o,         // sum of offset weight x code
  output wire                              saturated_o       // a sample of any frame was saturated
);

  localparam WORD_BITS = 1 + OFFSET_BITS + QUADRATURE_BITS + IN_PHASE_BITS;

[%- if multiplied %]

  // A clock before all others: the step's weights are looked up.
  reg                    take_q;
  reg [SAMPLE_BITS-1:0]  sample_q;
  reg [ADDRESS_BITS-1:0] address_q;
  reg                    first_frame_q;
  reg signed [[ "[" ]][[ in_phase_weight_bits - 1 ]]:0] in_phase_weight_q;
  reg signed [[ "[" ]][[ quadrature_weight_bits - 1 ]]:0] quadrature_weight_q;
[%- if offset_multiplied %]
  reg signed [[ "[" ]][[ offset_weight_bits - 1 ]]:0] offset_weight_q;
[%- endif %]

  always @(posedge clk_i) begin
    if (!rst_ni) take_q <= 1'b0;
    else take_q <= take_i;
  end

  always @(posedge clk_i) begin
    sample_q      <= sample_i;
    address_q     <= address_i;
    first_frame_q <= first_frame_i;
    case (step_i)
[%- for step in steps %]
      [[ step.label ]]: begin
        in_phase_weight_q   <= [[ step.in_phase_literal ]];
        quadrature_weight_q <= [[ step.quadrature_literal ]];
[%- if offset_multiplied %]
        offset_weight_q     <= [[ step.offset_literal ]];
[%- endif %]
      end
[%- endfor %]
    endcase
  end

  // The sample times its weights.
  wire signed [IN_PHASE_BITS-1:0]   sample_in_phase   = {{(IN_PHASE_BITS-SAMPLE_BITS){1'b0}}, sample_q};
  wire signed [QUADRATURE_BITS-1:0] sample_quadrature = {{(QUADRATURE_BITS-SAMPLE_BITS){1'b0}}, sample_q};
  wire signed [IN_PHASE_BITS-1:0]   in_phase_weight   = {{(IN_PHASE_BITS-[[ in_phase_weight_bits ]]){in_phase_weight_q[ [[- in_phase_weight_bits - 1 -]] ]}}, in_phase_weight_q};
  wire signed [QUADRATURE_BITS-1:0] quadrature_weight = {{(QUADRATURE_BITS-[[ quadrature_weight_bits ]]){quadrature_weight_q[ [[- quadrature_weight_bits - 1 -]] ]}}, quadrature_weight_q};
  wire signed [IN_PHASE_BITS-1:0]   in_phase_term_d   = sample_in_phase * in_phase_weight;
  wire signed [QUADRATURE_BITS-1:0] quadrature_term_d = sample_quadrature * quadrature_weight;
[%- if offset_multiplied %]
  wire signed [OFFSET_BITS:0]       sample_offset     = {{(OFFSET_BITS+1-SAMPLE_BITS){1'b0}}, sample_q};
  wire signed [OFFSET_BITS:0]       offset_weight     = {{(OFFSET_BITS+1-[[ offset_weight_bits ]]){offset_weight_q[ [[- offset_weight_bits - 1 -]] ]}}, offset_weight_q};
  wire signed [OFFSET_BITS:0]       offset_product    = sample_offset * offset_weight;
  wire        [OFFSET_BITS-1:0]     offset_term_d     = offset_product[OFFSET_BITS-1:0];
  wire                              unused_sign       = &{1'b0, offset_product[OFFSET_BITS]};
[%- else %]
  wire        [OFFSET_BITS-1:0]     offset_term_d     = {{(OFFSET_BITS-SAMPLE_BITS){1'b0}}, sample_q};
[%- endif %]
[%- else %]

  // The sample times its weights, as shifts and adds.
  wire signed [IN_PHASE_BITS-1:0]   sample_in_phase   = {{(IN_PHASE_BITS-SAMPLE_BITS){1'b0}}, sample_i};
  wire signed [QUADRATURE_BITS-1:0] sample_quadrature = {{(QUADRATURE_BITS-SAMPLE_BITS){1'b0}}, sample_i};
  wire        [OFFSET_BITS-1:0]     sample_offset     = {{(OFFSET_BITS-SAMPLE_BITS){1'b0}}, sample_i};

  reg signed [IN_PHASE_BITS-1:0]   in_phase_term_d;
  reg signed [QUADRATURE_BITS-1:0] quadrature_term_d;
  reg        [OFFSET_BITS-1:0]     offset_term_d;

  always @(*) begin
    case (step_i)
[%- for step in steps %]
      [[ step.label ]]: begin
        in_phase_term_d   = [[ step.in_phase_term ]];
        quadrature_term_d = [[ step.quadrature_term ]];
        offset_term_d     = [[ step.offset_term ]];
      end
[%- endfor %]
    endcase
  end
[%- endif %]

  // First clock: the term is formed while the memory is read. Second: it is added. Third: the sum is written.
  reg                              term_valid_q;
  reg                              term_first_q;
  reg        [ADDRESS_BITS-1:0]    term_address_q;
  reg signed [IN_PHASE_BITS-1:0]   in_phase_term_q;
  reg signed [QUADRATURE_BITS-1:0] quadrature_term_q;
  reg        [OFFSET_BITS-1:0]     offset_term_q;
  reg                              saturated_term_q;
  reg                              sum_valid_q;
  reg        [ADDRESS_BITS-1:0]    sum_address_q;
  reg        [WORD_BITS-1:0]       sum_q;

  // First clock of the drain: a pixel's sums are read. From the second on they wait for the pipeline to move.
  reg                    drain_busy_q;
  reg [ADDRESS_BITS:0]   drain_address_q;
  reg [COLUMN_BITS-1:0]  drain_column_q;
  reg                    valid_q;
  reg                    first_q;
  reg                    last_q;

  wire drain_end  = drain_address_q == PIXELS[ADDRESS_BITS:0];
  wire drain_read = drain_busy_q && advance_i && !drain_end;
  wire drain_last = drain_column_q == LAST_COLUMN[COLUMN_BITS-1:0];

  wire [WORD_BITS-1:0]              word;
  wire signed [IN_PHASE_BITS-1:0]   in_phase_before   = word[0 +: IN_PHASE_BITS];
  wire signed [QUADRATURE_BITS-1:0] quadrature_before = word[IN_PHASE_BITS +: QUADRATURE_BITS];
  wire        [OFFSET_BITS-1:0]     offset_before     = word[IN_PHASE_BITS+QUADRATURE_BITS +: OFFSET_BITS];
  wire                              saturated_before  = word[WORD_BITS-1];

  [[ prefix ]]_sum_memory u_sum_memory (
    .clk_i          (clk_i),
    .write_i        (sum_valid_q),
    .write_address_i(sum_address_q),
    .write_data_i   (sum_q),
    .read_i         (drain_busy_q ? drain_read : take_[[ at ]]),
    .read_address_i (drain_busy_q ? drain_address_q[ADDRESS_BITS-1:0] : address_[[ at ]]),
    .read_data_o    (word)
  );

  assign drain_busy_o    = drain_busy_q;
  assign drain_address_o = drain_address_q;
  assign valid_o         = valid_q;
  assign first_o         = first_q;
  assign last_o          = last_q;
  assign in_phase_o      = in_phase_before;
  assign quadrature_o    = quadrature_before;
  assign offset_o        = offset_before;
  assign saturated_o     = saturated_before;

  always @(posedge clk_i) begin
    if (!rst_ni) begin
      term_valid_q <= 1'b0;
      sum_valid_q  <= 1'b0;
      drain_busy_q <= 1'b0;
      valid_q      <= 1'b0;
    end else begin
      term_valid_q <= take_[[ at ]];
      sum_valid_q  <= term_valid_q;
      if (drain_start_i) drain_busy_q <= 1'b1;
      else if (drain_end && advance_i) drain_busy_q <= 1'b0;
      if (advance_i) valid_q <= drain_read;
    end
  end

  always @(posedge clk_i) begin
    term_first_q      <= first_frame_[[ at ]];
    term_address_q    <= address_[[ at ]];
    in_phase_term_q   <= in_phase_term_d;
    quadrature_term_q <= quadrature_term_d;
    offset_term_q     <= offset_term_d;
    saturated_term_q  <= sample_[[ at ]] >= SATURATION[SAMPLE_BITS-1:0];

    sum_address_q <= term_address_q;
    sum_q         <= {
      (saturated_before && !term_first_q) || saturated_term_q,
      (term_first_q ? {OFFSET_BITS{1'b0}} : offset_before) + offset_term_q,
      (term_first_q ? {QUADRATURE_BITS{1'b0}} : quadrature_before) + quadrature_term_q,
      (term_first_q ? {IN_PHASE_BITS{1'b0}} : in_phase_before) + in_phase_term_q
    };

    if (drain_start_i) begin
      drain_address_q <= {(ADDRESS_BITS+1){1'b0}};
      drain_column_q  <= {COLUMN_BITS{1'b0}};
    end else if (drain_read) begin
      drain_address_q <= drain_address_q + 1'b1;
      drain_column_q  <= drain_last ? {COLUMN_BITS{1'b0}} : drain_column_q + 1'b1;
    end
    if (drain_read) begin
      first_q <= drain_address_q == {(ADDRESS_BITS+1){1'b0}};
      last_q  <= drain_last;
    end
  end

endmodule
`default_nettype wire
