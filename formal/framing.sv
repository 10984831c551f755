// Properties of the framing: a set that is drained consists of its own frames' pixels, all of them, each in its place, and no
// sum is touched before it has drained. The observer counts beats by itself and looks only at ports.
`default_nettype none
module properties (
  input  wire       clk,
  input  wire       reset,
  input  wire       valid_i,
  input  wire       sample_i,
  input  wire       start_of_frame_i,
  input  wire       start_of_set_i,
  input  wire       end_of_line_i,
  input  wire       drain_moves,
  output wire       watched
);
  localparam WIDTH = 3, HEIGHT = 2, STEPS = 3, SILENCE = 5;
  localparam PIXELS = WIDTH * HEIGHT, BEATS = STEPS * `REPEATS * PIXELS;

  reg started = 1'b0;
  always @(posedge clk) started <= 1'b1;
  wire rst_n = started && !reset;

  wire ready_o, drain_start_o, take_o, sample_o, first_frame_o, frame_o, lost_o, next_first_o;
  wire [2:0] address_o;
  wire [1:0] place_o, next_place_o;
  wire [31:0] sets_done_o, sets_discarded_o;

  // The drain, as the accumulator does it: it moves when it likes to, and goes idle after its last pixel.
  reg       busy = 1'b0;
  reg [3:0] drained;
  always @(posedge clk) begin
    if (!rst_n) busy <= 1'b0;
    else if (drain_start_o) busy <= 1'b1;
    else if (drained == PIXELS && drain_moves) busy <= 1'b0;
    if (drain_start_o) drained <= 4'd0;
    else if (busy && drain_moves && drained != PIXELS) drained <= drained + 4'd1;
  end

  `FRAMING #(
    .SAMPLE_BITS(1), .COLUMN_BITS(2), .ROW_BITS(1), .ADDRESS_BITS(3), .PLACE_BITS(2), .SILENCE_BITS(3),
    .LAST_COLUMN(WIDTH - 1), .LAST_ROW(HEIGHT - 1),
`ifdef REPEAT_PARAMETERS
    .REPEAT_BITS(2), .LAST_REPEAT(`REPEATS - 1),
`endif
    .LAST_PLACE(STEPS - 1), .LAST_SILENCE(SILENCE)
  ) dut (
    .clk_i(clk), .rst_ni(rst_n), .valid_i(valid_i), .ready_o(ready_o), .sample_i(sample_i),
    .start_of_frame_i(start_of_frame_i), .start_of_set_i(start_of_set_i), .end_of_line_i(end_of_line_i),
    .drain_busy_i(busy), .drain_address_i(drained), .drain_start_o(drain_start_o),
    .take_o(take_o), .sample_o(sample_o), .address_o(address_o), .place_o(place_o), .first_frame_o(first_frame_o),
    .frame_o(frame_o), .lost_o(lost_o), .next_place_o(next_place_o), .next_first_o(next_first_o),
    .sets_done_o(sets_done_o), .sets_discarded_o(sets_discarded_o)
  );

  // The observer: beats of the open set that have come, and whether it is whole so far.
  reg [5:0] beats = 6'd0;
  reg       whole = 1'b0;   // since its start, every beat was in its place
  reg       between = 1'b0; // a set was drained, and no beat has come since
  wire accepted = rst_n && valid_i && ready_o;
  wire start    = start_of_frame_i && start_of_set_i;
  wire [5:0] number = start ? 6'd0 : beats;
  wire [5:0] pixel  = number % PIXELS;
  wire in_place = start_of_frame_i == (pixel == 0) && start_of_set_i == (number == 0)
                  && end_of_line_i == (pixel % WIDTH == WIDTH - 1);
  wire belongs  = (start || whole) && number < BEATS && in_place;
  // What stands open, or a core that waits for a start, is spoiled by any beat that does not belong.
  wire spoiled   = accepted && !belongs && (start || whole || between);
  wire abandoned = accepted && start && whole && beats != 0 && beats != BEATS;
  always @(posedge clk) begin
    if (!rst_n) begin
      whole   <= 1'b0;
      between <= 1'b0;
      beats   <= 6'd0;
    end else if (drain_start_o) begin
      whole   <= 1'b0;
      between <= 1'b1;
      beats   <= 6'd0;
    end else if (accepted) begin
      whole   <= belongs;
      between <= 1'b0;
      beats   <= belongs ? number + 6'd1 : 6'd0;
    end
  end

  // Clocks of silence after the last pixel.
  reg [3:0] quiet = 4'd0;
  always @(posedge clk) quiet <= !rst_n || valid_i ? 4'd0 : quiet == 4'd15 ? quiet : quiet + 4'd1;

  reg [31:0] done = 32'd0, discarded = 32'd0;
  always @(posedge clk) begin
    done      <= rst_n ? done + drain_start_o : 32'd0;
    discarded <= rst_n ? discarded + spoiled + abandoned : 32'd0;
  end

  // What the frame after this one must be.
  wire [5:0] after = number / PIXELS + 1;
  wire [15:0] bad = {
    rst_n && valid_i && !ready_o && !drain_start_o && !(start || (whole && beats != BEATS)), // 15 what is outside a set waits for no drain
    rst_n && frame_o && (next_first_o != (after == STEPS * `REPEATS)
                         || next_place_o != (next_first_o ? 0 : after / `REPEATS)), // 14 the frame that must come next is told
    rst_n && frame_o != (accepted && belongs && pixel == 0),                     // 13 the first pixel of a frame is marked
    rst_n && lost_o != spoiled,                                                  // 12 a set that is lost is told
    rst_n && take_o && !(accepted && belongs),                                   // 11 only what is in place is taken
    accepted && belongs && !take_o,                                              // 10 all that is in place is taken
    rst_n && take_o && (address_o != pixel[2:0] || place_o != number / (PIXELS * `REPEATS)), //  9 each to its pixel and step
    rst_n && take_o && first_frame_o != (number < PIXELS),                                //  8 the first frame replaces
    rst_n && take_o && sample_o != sample_i,                                              //  7 the sample passes as it is
    rst_n && drain_start_o && !(whole && beats == BEATS),                        //  6 only whole sets drain
    rst_n && drain_start_o && !(valid_i && start_of_frame_i) && quiet < SILENCE, //  5 a pause within a frame ends no set
    rst_n && whole && beats == BEATS && quiet > SILENCE,                         //  4 a silence ends the set
    rst_n && take_o && busy && !(first_frame_o && address_o < drained),          //  3 no sum is replaced before it has drained
    rst_n && drain_start_o && busy,                                              //  2 no drain starts in another
    rst_n && sets_discarded_o != discarded,                                      //  1 discarded sets are counted
    rst_n && sets_done_o != done                                                 //  0 complete sets are counted
  };
  wire [6:0] seen = {
    rst_n && drain_start_o && valid_i && start,                                  // 6 the next set ends a set
    rst_n && drain_start_o && !valid_i,                                          // 5 silence ends a set
    rst_n && take_o && busy && done == 1,                                        // 4 a set begins while one drains
    rst_n && valid_i && !ready_o && busy && !drain_start_o,                      // 3 a set waits for the drain
    spoiled && beats == BEATS - 1,                                               // 2 the last pixel spoils a set
    abandoned,                                                                   // 1 a set is abandoned
    rst_n && done == 1 && discarded == 1 && drain_start_o                        // 0 a set after one that was discarded
  };
  assign watched = `WATCH;
endmodule
`default_nettype wire
