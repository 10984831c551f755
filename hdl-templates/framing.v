[[ banner ]]
// Finds the place of every beat of the raw stream: its pixel, the place of its phase step within the set, and whether its set can
// be trusted.
// A set is complete when all its frames have arrived, each with every line of the right length, and the stream then
// either starts another frame or stays silent for longer than LAST_SILENCE clocks. Anything else discards the set, counts it, and waits
// for the next start of set. It does not touch the samples.
//
//   in the middle of a set    | start of set               | the unfinished set is discarded, the new one begins
//   all pixels have arrived   | a pixel that starts nothing | the last frame was too long: discarded
//   between two sets          | a frame that starts no set | a set without its first frame: discarded
`default_nettype none
module [[ prefix ]]_framing #(
  parameter SAMPLE_BITS    = [[ sample_bits ]],  // a raw code
  parameter COLUMN_BITS    = [[ column_bits ]],  // a column's number
  parameter ROW_BITS       = [[ row_bits ]],  // a row's number
  parameter ADDRESS_BITS   = [[ address_bits ]],  // a pixel's number
  parameter PLACE_BITS     = [[ step_bits ]],  // a phase step's place within the set
  parameter SILENCE_BITS   = [[ silence_bits ]],  // the silence that ends a frame
  parameter LAST_COLUMN    = [[ last_column ]],  // width - 1
  parameter LAST_ROW       = [[ last_row ]],  // height - 1
[%- if last_repeat > 0 %]
  parameter REPEAT_BITS    = [[ repeat_bits ]],  // a raw frame's number within its phase step
  parameter LAST_REPEAT    = [[ last_repeat ]],  // raw frames a phase step - 1
[%- endif %]
  parameter LAST_PLACE     = [[ last_step ]],  // phase steps a set - 1
  parameter LAST_SILENCE   = [[ last_silence ]]   // clocks of the longest pause inside a frame
) (
  input  wire                    clk_i,             // clock
  input  wire                    rst_ni,            // synchronous reset, active low
  input  wire                    valid_i,           // a beat is offered
  output wire                    ready_o,           // it is taken
  input  wire [SAMPLE_BITS-1:0]  sample_i,          // its raw code, DN
  input  wire                    start_of_frame_i,  // first pixel of a frame
  input  wire                    start_of_set_i,    // first pixel of a set's first frame
  input  wire                    end_of_line_i,     // last pixel of a line
[%- if unwrapping %]
  input  wire                    second_i,          // with the start of a set: it is of the second modulation frequency
[%- endif %]
  input  wire                    drain_busy_i,      // the last complete set still drains
  input  wire [ADDRESS_BITS:0]   drain_address_i,   // the pixel that drains next
  output wire                    drain_start_o,     // a set is complete: drain it
[%- if unwrapping %]
  output wire                    second_o,          // it was of the second frequency
  output wire                    partner_o,         // the one before was of the other, and none was discarded between
[%- endif %]
  output wire                    take_o,            // the outputs below belong to a set's pixel
  output wire [SAMPLE_BITS-1:0]  sample_o,          // raw code, DN
  output wire [ADDRESS_BITS-1:0] address_o,         // pixel number within the frame
  output wire [PLACE_BITS-1:0]   place_o,           // place of its phase step within the set
  output wire                    frame_o,           // it is the first of a frame
  output wire                    lost_o,            // the set is discarded: the next one must start anew
  output wire [PLACE_BITS-1:0]   next_place_o,      // place of the next frame's phase step
  output wire                    next_first_o,      // the next frame is a set's first
  output wire                    first_frame_o,     // the set's first frame: replace, do not add
  output wire [31:0]             sets_done_o,       // complete sets since reset
  output wire [31:0]             sets_discarded_o   // discarded sets since reset
);

  localparam [1:0] LOST    = 2'd0;  // waiting for a start of set, whatever else arrives
  localparam [1:0] IDLE    = 2'd1;  // between sets: only a start of set may follow
  localparam [1:0] ACTIVE  = 2'd2;  // within a set
  localparam [1:0] CLOSING = 2'd3;  // all pixels have arrived: the next beat must start a frame

  reg [1:0]              state_q;
  reg [COLUMN_BITS-1:0]  column_q;
  reg [ROW_BITS-1:0]     row_q;
  reg [ADDRESS_BITS-1:0] address_q;
[%- if last_repeat > 0 %]
  reg [REPEAT_BITS-1:0]  repeat_q;
[%- endif %]
  reg [PLACE_BITS-1:0]   place_q;
  reg [SILENCE_BITS-1:0] silence_q;
  reg [31:0]             sets_done_q;
  reg [31:0]             sets_discarded_q;

  // A start of set counts from zero, wherever the counters stand.
  wire                    start   = start_of_set_i && start_of_frame_i;
  wire [COLUMN_BITS-1:0]  column  = start ? {COLUMN_BITS{1'b0}} : column_q;
  wire [ROW_BITS-1:0]     row     = start ? {ROW_BITS{1'b0}} : row_q;
  wire [ADDRESS_BITS-1:0] address = start ? {ADDRESS_BITS{1'b0}} : address_q;
[%- if last_repeat > 0 %]
  wire [REPEAT_BITS-1:0]  repetition = start ? {REPEAT_BITS{1'b0}} : repeat_q;
[%- endif %]
  wire [PLACE_BITS-1:0]   place   = start ? {PLACE_BITS{1'b0}} : place_q;

  wire last_column   = column == LAST_COLUMN[COLUMN_BITS-1:0];
  wire last_of_frame = last_column && row == LAST_ROW[ROW_BITS-1:0];
[%- if last_repeat > 0 %]
  wire last_repeat   = repetition == LAST_REPEAT[REPEAT_BITS-1:0];
  wire first_frame   = place == {PLACE_BITS{1'b0}} && repetition == {REPEAT_BITS{1'b0}};
[%- else %]
  wire last_repeat   = 1'b1;
  wire first_frame   = place == {PLACE_BITS{1'b0}};
[%- endif %]
  wire last_place    = place == LAST_PLACE[PLACE_BITS-1:0];
  wire last_of_set   = last_of_frame && last_repeat && last_place;

  // Of the frame that follows this one.
  wire [PLACE_BITS-1:0] next_place = !last_repeat ? place : last_place ? {PLACE_BITS{1'b0}} : place + 1'b1;

  // The frame that follows a complete set commits it and is held for that clock; so does silence.
  wire closing         = state_q == CLOSING;
  wire commit_by_frame = closing && valid_i && start_of_frame_i;
  wire commit_by_pause = closing && !valid_i && silence_q == LAST_SILENCE[SILENCE_BITS-1:0];
  wire commit          = commit_by_frame || commit_by_pause;

  // A set's first frame replaces sums that may still be draining: it stays behind the drain. Later frames need the
  // memory's read port, which the drain has given back by then.
  wire in_set = start || state_q == ACTIVE;
  wire behind = first_frame && drain_address_i > {1'b0, address};
  wire hold   = commit_by_frame || (in_set && drain_busy_i && !behind);
  wire accept = valid_i && !hold;

  wire in_place = start_of_frame_i == (column == {COLUMN_BITS{1'b0}} && row == {ROW_BITS{1'b0}})
                  && start_of_set_i == start
                  && end_of_line_i == last_column;
  wire take      = accept && in_set && in_place;
  wire fault     = accept && !take && (start || state_q != LOST);
  wire abandoned = accept && start && state_q == ACTIVE;
[%- if unwrapping %]

  // Frequency of the present set, of the last complete one, and whether nothing has been discarded since.
  reg second_q;
  reg before_q;
  reg unbroken_q;

  assign second_o  = second_q;
  assign partner_o = unbroken_q && before_q != second_q;

  always @(posedge clk_i) begin
    if (!rst_ni) unbroken_q <= 1'b0;
    else if (commit) unbroken_q <= 1'b1;
    else if (fault || abandoned) unbroken_q <= 1'b0;
  end

  always @(posedge clk_i) begin
    if (accept && start) second_q <= second_i;
    if (commit) before_q <= second_q;
  end
[%- endif %]

  assign ready_o          = !hold;
  assign drain_start_o    = commit;
  assign take_o           = take;
  assign sample_o         = sample_i;
  assign address_o        = address;
  assign place_o          = place;
  assign frame_o          = take && start_of_frame_i;
  assign lost_o           = fault;
  assign next_place_o     = next_place;
  assign next_first_o     = last_repeat && last_place;
  assign first_frame_o    = first_frame;
  assign sets_done_o      = sets_done_q;
  assign sets_discarded_o = sets_discarded_q;

  always @(posedge clk_i) begin
    if (!rst_ni) begin
      state_q          <= LOST;
      silence_q        <= {SILENCE_BITS{1'b0}};
      sets_done_q      <= 32'd0;
      sets_discarded_q <= 32'd0;
    end else begin
      if (commit) state_q <= IDLE;
      else if (take) state_q <= last_of_set ? CLOSING : ACTIVE;
      else if (fault) state_q <= LOST;
      silence_q        <= closing && !valid_i ? silence_q + 1'b1 : {SILENCE_BITS{1'b0}};
      sets_done_q      <= sets_done_q + {31'd0, commit};
      sets_discarded_q <= sets_discarded_q + {31'd0, fault} + {31'd0, abandoned};
    end
  end

  always @(posedge clk_i) begin
    if (take) begin
      column_q  <= last_column ? {COLUMN_BITS{1'b0}} : column + 1'b1;
      address_q <= last_of_frame ? {ADDRESS_BITS{1'b0}} : address + 1'b1;
      row_q     <= last_of_frame ? {ROW_BITS{1'b0}} : last_column ? row + 1'b1 : row;
[%- if last_repeat > 0 %]
      repeat_q  <= !last_of_frame ? repetition : last_repeat ? {REPEAT_BITS{1'b0}} : repetition + 1'b1;
[%- endif %]
      place_q   <= last_of_frame ? next_place : place;
    end
  end

endmodule
`default_nettype wire
