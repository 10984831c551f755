// Properties of the sums: for one pixel, each in its own proof, what drains is the exact sum of weight times sample over all frames of
// its set, computed here in words that cannot overflow; so no sum overflows, none is stale, and none is read before it is
// written. Takes follow the framing's contract (proved of the framing): pixels come in order, four a frame, with any pauses,
// and while sums drain only in the first frame and behind the drain. A set may break off anywhere, even when all of it has come: the
// next take is then the first of a new set, in the same clock or later, and a drain that runs goes on.
`default_nettype none
module properties (
  input  wire                    clk,
  input  wire                    reset,
  input  wire                    take,
  input  wire [`SAMPLE_BITS-1:0] sample,
  input  wire [1:0]              address,
  input  wire                    end_set,
  input  wire                    abort,
  input  wire                    advance,
  output wire                    watched
);
  localparam PIXELS = 4, FRAMES = `STEPS * `REPEATS, WIDE = `WIDE_BITS, FRAME_BITS = `FRAME_BITS;

  reg started = 1'b0;
  always @(posedge clk) started <= 1'b1;
  wire rst_n = started && !reset;

  // One pixel is watched.
  wire [1:0] pixel = 2'd`PIXEL;

  // The frame that the stream is in, and the pixels that it has had; where the set breaks off, from the beginning.
  reg [FRAME_BITS-1:0] frame_q = {FRAME_BITS{1'b0}};
  reg [2:0] next_q = 3'd0;
  reg       full = 1'b0;  // a set is complete and waits for its drain
  wire [FRAME_BITS-1:0] frame = abort ? {FRAME_BITS{1'b0}} : frame_q;
  wire [2:0] next = abort ? 3'd0 : next_q;
  wire      first_frame = frame == 0;
  wire      drain_busy;
  wire [2:0] drain_address;
  wire allowed = (abort || !full) && (!drain_busy || first_frame && drain_address > next);
  wire taken   = rst_n && take && allowed;
  wire starts  = rst_n && full && end_set && !abort && !drain_busy;
  always @(posedge clk) begin
    if (!rst_n) begin
      frame_q <= {FRAME_BITS{1'b0}};
      next_q  <= 3'd0;
      full    <= 1'b0;
    end else begin
      next_q  <= !taken ? next : next == PIXELS - 1 ? 3'd0 : next + 3'd1;
      frame_q <= frame;
      if (starts || abort) full <= 1'b0;
      if (taken && next == PIXELS - 1) begin
        frame_q <= frame == FRAMES - 1 ? {FRAME_BITS{1'b0}} : frame + 1'b1;
        full    <= frame == FRAMES - 1;
      end
    end
  end

  // Whether a set has broken off past its first frame, and whether sums of a later one are due: for the covers.
  reg broken = 1'b0, mended = 1'b0;
  always @(posedge clk) begin
    broken <= rst_n && (broken || (abort && frame_q != 0));
    mended <= rst_n && (mended || (starts && broken));
  end

  wire valid_o, first_o, last_o, saturated_o;
  wire signed [`IN_PHASE_BITS-1:0] in_phase_o;
  wire signed [`QUADRATURE_BITS-1:0] quadrature_o;
  wire [`OFFSET_BITS-1:0] offset_o;
  wire [`STEP_BITS-1:0] step = frame / `REPEATS;

  `ACCUMULATOR #(
    .SAMPLE_BITS(`SAMPLE_BITS), .IN_PHASE_BITS(`IN_PHASE_BITS), .QUADRATURE_BITS(`QUADRATURE_BITS),
    .OFFSET_BITS(`OFFSET_BITS),`KEPT_PARAMETERS .ADDRESS_BITS(2), .COLUMN_BITS(1), .STEP_BITS(`STEP_BITS), .PIXELS(PIXELS),
    .LAST_COLUMN(1), .SATURATION((1 << `SAMPLE_BITS) - 1)
  ) dut (
    .clk_i(clk), .rst_ni(rst_n), .take_i(taken), .sample_i(sample), .address_i(next[1:0]), .step_i(step),
    .first_frame_i(first_frame), .drain_start_i(starts), .drain_busy_o(drain_busy), .drain_address_o(drain_address),
    .advance_i(advance), .valid_o(valid_o), .first_o(first_o), .last_o(last_o), .in_phase_o(in_phase_o),
    .quadrature_o(quadrature_o), .offset_o(offset_o), .saturated_o(saturated_o)
  );

  // The observer's own sums of the watched pixel, and those that are to come out: of the set that drains, and, where the last of the
  // set before still wait at the outputs, of that one first.
  reg signed [WIDE-1:0] in_phase, quadrature, offset, in_phase_due, quadrature_due, offset_due;
  reg signed [WIDE-1:0] in_phase_next, quadrature_next, offset_next;
  reg saturated, saturated_due, saturated_next;
  reg [1:0] owed = 2'd0;  // sums of the watched pixel
  reg [3:0] left = 4'd0;  // sums of all pixels
  reg signed [WIDE-1:0] in_phase_term, quadrature_term, offset_term;
  wire signed [WIDE-1:0] code = {{(WIDE-`SAMPLE_BITS){1'b0}}, sample};
  always @(*) begin
    case (step)
`WEIGHTS
    endcase
  end
  // The pixel at the outputs, counted by what has come out.
  reg [1:0] out = 2'd0;
  always @(posedge clk) begin
    if (!rst_n) out <= 2'd0;
    else if (valid_o && advance) out <= out + 2'd1;
  end
  wire due   = rst_n && valid_o && out == pixel;
  wire given = due && advance;

  wire mine = taken && next[1:0] == pixel;
  always @(posedge clk) begin
    if (mine) begin
      in_phase   <= (first_frame ? 0 : in_phase) + in_phase_term;
      quadrature <= (first_frame ? 0 : quadrature) + quadrature_term;
      offset     <= (first_frame ? 0 : offset) + offset_term;
      saturated  <= (first_frame ? 1'b0 : saturated) || &sample;
    end
    if (starts) begin
      in_phase_next   <= in_phase;
      quadrature_next <= quadrature;
      offset_next     <= offset;
      saturated_next  <= saturated;
    end
    // What is due moves up when nothing is owed any more, or the last that was owed comes out.
    if (owed == 2'd0 || (given && owed == 2'd1) || (given && owed == 2'd2)) begin
      if (starts && (owed == 2'd0 || (given && owed == 2'd1))) begin
        in_phase_due   <= in_phase;
        quadrature_due <= quadrature;
        offset_due     <= offset;
        saturated_due  <= saturated;
      end else begin
        in_phase_due   <= in_phase_next;
        quadrature_due <= quadrature_next;
        offset_due     <= offset_next;
        saturated_due  <= saturated_next;
      end
    end
    owed <= !rst_n ? 2'd0 : owed + {1'b0, starts} - {1'b0, given};
    left <= !rst_n ? 4'd0 : left + (starts ? 4'd4 : 4'd0) - (valid_o && advance ? 4'd1 : 4'd0);
  end

  wire [6:0] bad = {
    rst_n && valid_o && left == 0,                                                       // 6 as many out as pixels
    rst_n && valid_o && last_o != out[0],                                                // 5 a line's last is marked
    rst_n && valid_o && first_o != (out == 0),                                           // 4 a frame's first is marked
    due && saturated_o != saturated_due,                                                 // 3 saturation is sticky
    due && $signed({{(WIDE-`OFFSET_BITS){1'b0}}, offset_o}) != offset_due,               // 2 offset sum
    due && $signed(quadrature_o) != quadrature_due,                                      // 1 quadrature sum
    due && $signed(in_phase_o) != in_phase_due                                           // 0 in-phase sum
  };
  wire [6:0] seen = {
    due && mended,                                                                       // 6 sums of a set after one that broke off
    taken && broken,                                                                     // 5 a take after a set that broke off
    rst_n && abort && drain_busy && next_q != 0,                                         // 4 a set that breaks off while sums drain
    due && offset_due == `OFFSET_MAX,                                                    // 3 the largest offset
    due && in_phase_due == `IN_PHASE_MIN,                                                // 2 the least in-phase sum
    due && taken,                                                                        // 1 a take while sums drain
    due && quadrature_due == `QUADRATURE_MAX                                             // 0 the largest quadrature sum
  };
  assign watched = `WATCH;
endmodule
`default_nettype wire
