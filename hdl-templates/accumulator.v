[[ banner ]]
// Adds every sample, times its step's weights, to [[ kept ]] while frames
// arrive, and drains in-phase, quadrature and offset sum of a complete set. It keeps no raw frame, and one memory serves
// both: a set's first frame replaces sums that have just been drained, so that nothing is ever cleared and no second buffer
// is needed.
//
//   step | [[ heading ]]   (weights of scheme [[ scheme ]])
[%- for step in steps %]
//   [[ step.title ]]
[%- endfor %]
`default_nettype none
module [[ prefix ]]_accumulator #(
  parameter SAMPLE_BITS     = [[ sample_bits ]],  // a raw code
  parameter IN_PHASE_BITS   = [[ in_phase_bits ]],  // in-phase sum, signed
  parameter QUADRATURE_BITS = [[ quadrature_bits ]],  // quadrature sum, signed
  parameter OFFSET_BITS     = [[ offset_bits ]],  // offset sum, unsigned
[%- for sum in own_sums %]
  parameter [[ sum.bits_name ]]    = [[ sum.bits ]],  // a sum that is kept, unsigned
[%- endfor %]
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

  localparam WORD_BITS = 1[% for sum in sums %] + [[ sum.bits_name ]][% endfor %];
[% if multiplied %]
  // A clock before all others: the step's weights are looked up.
  reg                    take_q;
  reg [SAMPLE_BITS-1:0]  sample_q;
  reg [ADDRESS_BITS-1:0] address_q;
  reg                    first_frame_q;
[%- for sum in sums %]
  reg signed [[ sum.weight_range ]] [[ sum.name ]]_weight_q;
[%- endfor %]

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
[%- for term in step.terms %]
        [[ term.name ]]_weight_q <= [[ term.literal ]];
[%- endfor %]
      end
[%- endfor %]
    endcase
  end

  // The sample times its weights; a product's sign is that of the weight, and its top bit no more than that.
[%- for sum in sums %]
  wire signed [[ sum.product_range ]] [[ sum.name ]]_sample = {[[ sum.sample_zeros ]], sample_q};
  wire signed [[ sum.product_range ]] [[ sum.name ]]_weight = {{[[ sum.weight_signs ]]{[[ sum.name ]]_weight_q[[ self::bit(sum.weight_top) ]]}}, [[ sum.name ]]_weight_q};
  wire signed [[ sum.product_range ]] [[ sum.name ]]_product = [[ sum.name ]]_sample * [[ sum.name ]]_weight;
  wire [[ sum.range ]] [[ sum.name ]]_term_d = [[ sum.name ]]_product[[ self::slice(sum.top, 0) ]];
  wire unused_[[ sum.name ]] = [[ sum.name ]]_product[[ self::bit(sum.bits) ]];
[%- endfor %]
[%- else %]
  // The sample times its weights, as shifts and adds.
[%- for sum in sums %]
  wire [[ sum.range ]] [[ sum.name ]]_sample = [[ sum.sample ]];
  reg  [[ sum.range ]] [[ sum.name ]]_term_d;
[%- endfor %]

  always @(*) begin
    case (step_i)
[%- for step in steps %]
      [[ step.label ]]: begin
[%- for term in step.terms %]
        [[ term.name ]]_term_d = [[ term.text ]];
[%- endfor %]
      end
[%- endfor %]
    endcase
  end
[%- endif %]

  // First clock: the term is formed while the memory is read. Second: it is added. Third: the sum is written.
  reg                              term_valid_q;
  reg                              term_first_q;
  reg        [ADDRESS_BITS-1:0]    term_address_q;
[%- for sum in sums %]
  reg        [[ sum.range ]] [[ sum.name ]]_term_q;
[%- endfor %]
  reg                              saturated_term_q;
  reg                              sum_valid_q;
  reg        [ADDRESS_BITS-1:0]    sum_address_q;
  reg        [WORD_BITS-1:0]       sum_q;

  // First clock of the drain: a pixel's word is read. Second: its sums are formed. From then on they wait for the pipeline
  // to move.
  reg                    drain_busy_q;
  reg [ADDRESS_BITS:0]   drain_address_q;
  reg [COLUMN_BITS-1:0]  drain_column_q;
  reg                    read_valid_q;
  reg                    read_first_q;
  reg                    read_last_q;
  reg                    valid_q;
  reg                    first_q;
  reg                    last_q;
  reg                    saturated_q;
  reg signed [IN_PHASE_BITS-1:0]   in_phase_q;
  reg signed [QUADRATURE_BITS-1:0] quadrature_q;
  reg        [OFFSET_BITS-1:0]     offset_q;

  wire drain_end  = drain_address_q == PIXELS[ADDRESS_BITS:0];
  wire drain_read = drain_busy_q && advance_i && !drain_end;
  wire drain_last = drain_column_q == LAST_COLUMN[COLUMN_BITS-1:0];

  wire [WORD_BITS-1:0] word;
[%- for sum in sums %]
  wire [[ sum.range ]] [[ sum.name ]]_before = word[[ "[" ]][[ sum.low ]] +: [[ sum.bits_name ]]];
[%- endfor %]
  wire saturated_before = word[WORD_BITS-1];

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
  assign in_phase_o      = in_phase_q;
  assign quadrature_o    = quadrature_q;
  assign offset_o        = offset_q;
  assign saturated_o     = saturated_q;

  always @(posedge clk_i) begin
    if (!rst_ni) begin
      term_valid_q <= 1'b0;
      sum_valid_q  <= 1'b0;
      drain_busy_q <= 1'b0;
      read_valid_q <= 1'b0;
      valid_q      <= 1'b0;
    end else begin
      term_valid_q <= take_[[ at ]];
      sum_valid_q  <= term_valid_q;
      if (drain_start_i) drain_busy_q <= 1'b1;
      else if (drain_end && advance_i) drain_busy_q <= 1'b0;
      if (advance_i) begin
        read_valid_q <= drain_read;
        valid_q      <= read_valid_q;
      end
    end
  end
[%- if !plain %]

  // The sums of a pixel, from what was kept.
[%- for sum in sums %]
  wire signed [[ mixed_range ]] [[ sum.name ]]_wide = [[ sum.mixed ]];
[%- endfor %]
  wire signed [[ mixed_range ]] in_phase_wide   = [[ in_phase_mix ]];
  wire signed [[ mixed_range ]] quadrature_wide = [[ quadrature_mix ]];
  wire signed [[ mixed_range ]] offset_wide     = [[ offset_mix ]];
  wire unused_wide = &{1'b0, in_phase_wide[[ self::slice(mixed_top, in_phase_bits) ]], quadrature_wide[[ self::slice(mixed_top, quadrature_bits) ]], offset_wide[[ self::slice(mixed_top, offset_bits) ]]};
[%- endif %]

  always @(posedge clk_i) begin
    term_first_q      <= first_frame_[[ at ]];
    term_address_q    <= address_[[ at ]];
[%- for sum in sums %]
    [[ sum.name ]]_term_q <= [[ sum.name ]]_term_d;
[%- endfor %]
    saturated_term_q  <= sample_[[ at ]] >= SATURATION[SAMPLE_BITS-1:0];

    sum_address_q <= term_address_q;
    sum_q         <= {
      (saturated_before && !term_first_q) || saturated_term_q,
[%- for sum in sums_from_top %]
      (term_first_q ? [[ sum.zero ]] : [[ sum.name ]]_before) + [[ sum.name ]]_term_q[% if !sum.lowest %],[% endif %]
[%- endfor %]
    };

    if (drain_start_i) begin
      drain_address_q <= {(ADDRESS_BITS+1){1'b0}};
      drain_column_q  <= {COLUMN_BITS{1'b0}};
    end else if (drain_read) begin
      drain_address_q <= drain_address_q + 1'b1;
      drain_column_q  <= drain_last ? {COLUMN_BITS{1'b0}} : drain_column_q + 1'b1;
    end
    if (drain_read) begin
      read_first_q <= drain_address_q == {(ADDRESS_BITS+1){1'b0}};
      read_last_q  <= drain_last;
    end
    if (advance_i) begin
      first_q      <= read_first_q;
      last_q       <= read_last_q;
      saturated_q  <= saturated_before;
[%- if plain %]
      in_phase_q   <= in_phase_before;
      quadrature_q <= quadrature_before;
      offset_q     <= offset_before;
[%- else %]
      in_phase_q   <= in_phase_wide[IN_PHASE_BITS-1:0];
      quadrature_q <= quadrature_wide[QUADRATURE_BITS-1:0];
      offset_q     <= offset_wide[OFFSET_BITS-1:0];
[%- endif %]
    end
  end

endmodule
`default_nettype wire
