[[ bench.banner ]]
// Drives vectors/x.hex and vectors/y.hex through [[ bench.top ]] with pauses on the input and stops on the output, and compares
// every result, in order, with the golden vectors; an offered result must not change before it is taken.
//
//   +seed=N +pause=PERCENT +stop=PERCENT   traffic (default 1, 25, 25)
//   last line: PASS or FAIL, with the values compared, the clocks, and the mismatches
`timescale 1ns/1ps
`default_nettype none
module angle_bench;

  localparam VECTORS     = [[ bench.vectors ]];
  localparam X_BITS      = [[ bench.x_bits ]];
  localparam Y_BITS      = [[ bench.y_bits ]];
  localparam PHASE_BITS  = [[ bench.phase_bits ]];
  localparam LENGTH_BITS = [[ bench.length_bits ]];
  localparam SHIFT_BITS  = [[ bench.shift_bits ]];
  localparam META_BITS   = [[ bench.meta_bits ]];
  localparam RESULT_BITS = PHASE_BITS + 1 + LENGTH_BITS + SHIFT_BITS + META_BITS;
  localparam [31:0] PATIENCE = [[ bench.patience ]];

  reg clk = 1'b0;
  reg rst_n = 1'b0;
  always #5 clk = !clk;

  reg [X_BITS-1:0]      x_golden      [0:VECTORS-1];
  reg [Y_BITS-1:0]      y_golden      [0:VECTORS-1];
  reg [PHASE_BITS-1:0]  phase_golden  [0:VECTORS-1];
  reg                   zero_golden   [0:VECTORS-1];
  reg [LENGTH_BITS-1:0] length_golden [0:VECTORS-1];
  reg [SHIFT_BITS-1:0]  shift_golden  [0:VECTORS-1];

  reg  [31:0] seed;
  reg  [31:0] pause_percent;
  reg  [31:0] stop_percent;
  reg  [31:0] random_in;
  reg  [31:0] random_out;
  integer     sent;
  integer     received;
  integer     clocks;
  integer     waited;
  integer     mismatches;
  reg         offered;
  reg         taking;
  reg         held;
  reg  [RESULT_BITS-1:0] held_result;

  function automatic [31:0] next_random;
    input [31:0] state;
    reg   [31:0] bits;
    begin
      bits = state ^ (state << 13);
      bits = bits ^ (bits >> 17);
      next_random = bits ^ (bits << 5);
    end
  endfunction

  wire ready;
  wire valid;
  wire [PHASE_BITS-1:0]  phase;
  wire                   zero;
  wire [LENGTH_BITS-1:0] length;
  wire [SHIFT_BITS-1:0]  shift;
  wire [META_BITS-1:0]   number;
  wire [RESULT_BITS-1:0] result   = {phase, zero, length, shift, number};
  wire [31:0]            sent_now = sent;
  wire [31:0]            due      = received;
  wire [RESULT_BITS-1:0] expected = {phase_golden[received], zero_golden[received], length_golden[received],
                                     shift_golden[received], due[META_BITS-1:0]};

  [[ bench.top ]] #(
    .META_BITS(META_BITS)
  ) dut (
    .clk_i   (clk),
    .rst_ni  (rst_n),
    .valid_i (offered),
    .ready_o (ready),
    .x_i     (x_golden[sent]),
    .y_i     (y_golden[sent]),
    .meta_i  (sent_now[META_BITS-1:0]),
    .valid_o (valid),
    .ready_i (taking),
    .phase_o (phase),
    .zero_o  (zero),
    .length_o(length),
    .shift_o (shift),
    .meta_o  (number)
  );

  initial begin
    $readmemh("vectors/x.hex", x_golden);
    $readmemh("vectors/y.hex", y_golden);
    $readmemh("vectors/phase.hex", phase_golden);
    $readmemh("vectors/zero.hex", zero_golden);
    $readmemh("vectors/length.hex", length_golden);
    $readmemh("vectors/shift.hex", shift_golden);
    if (!$value$plusargs("seed=%d", seed)) seed = 1;
    if (!$value$plusargs("pause=%d", pause_percent)) pause_percent = 25;
    if (!$value$plusargs("stop=%d", stop_percent)) stop_percent = 25;
    random_in   = seed * 32'd2654435761 + 32'd1;
    random_out  = seed * 32'd2246822519 + 32'd3;
    sent        = 0;
    received    = 0;
    clocks      = 0;
    waited      = 0;
    mismatches  = 0;
    offered     = 1'b0;
    taking      = 1'b0;
    held        = 1'b0;
    held_result = {RESULT_BITS{1'b0}};
  end

  always @(posedge clk) begin
    clocks <= clocks + 1;
    rst_n  <= clocks >= 4;
    if (rst_n) begin
      random_in  <= next_random(random_in);
      random_out <= next_random(random_out);

      // An offer stands until it is taken.
      if (!offered || ready) begin
        offered <= sent + (offered ? 1 : 0) < VECTORS && random_in[30:8] % 100 >= pause_percent;
      end
      if (offered && ready) sent <= sent + 1;
      taking <= random_out[30:8] % 100 >= stop_percent;

      held        <= valid && !taking;
      held_result <= result;
      if (held && (!valid || result !== held_result)) begin
        mismatches <= mismatches + 1;
        $display("MISMATCH an offered result did not wait: %h became %h in clock %0d", held_result, result, clocks);
      end

      waited <= waited + 1;
      if (valid && taking) begin
        waited <= 0;
        if (result !== expected) begin
          mismatches <= mismatches + 1;
          if (mismatches < 10) begin
            $display("MISMATCH vector %0d (%h, %h) in clock %0d: phase %h zero %b length %h shift %h number %h",
                     received, x_golden[received], y_golden[received], clocks, phase, zero, length, shift, number,
                     ", expected %h %b %h %h %h", phase_golden[received], zero_golden[received],
                     length_golden[received], shift_golden[received], due[META_BITS-1:0]);
          end
        end
        received <= received + 1;
        if (received + 1 == VECTORS) begin
          if (mismatches == 0 && result === expected) begin
            $display("PASS values=%0d clocks=%0d mismatches=0", VECTORS, clocks);
            $finish;
          end else begin
            // A stop, so that `vvp -N` and its like end with an exit code that is not 0.
            $display("FAIL values=%0d clocks=%0d mismatches=%0d", VECTORS, clocks, mismatches + (result !== expected ? 1 : 0));
            $stop;
          end
        end
      end
      if (waited > PATIENCE) begin
        $display("FAIL values=%0d clocks=%0d mismatches=%0d: nothing comes any more", received, clocks, mismatches + 1);
        $stop;
      end
    end
  end

endmodule
`default_nettype wire
