[[ bench.banner ]]
// Drives the core with vectors/stimulus.hex, with random pauses on the input and random stops on the output, and compares
// every stage with vectors/*.hex. Plain Verilog-2005: run it from the folder that holds vectors/, in any simulator, with
// rtl/*.v and this file.
//   +seed=N        seed of pauses and stops (1)
//   +pause=P       percent of clocks without input (25)
//   +stop=P        percent of clocks without output (25)
//   +dump=FILE     waveform, from clock +dump_from=C to +dump_to=C
// The last line is `PASS values=… clocks=…` or `FAIL mismatches=…`.
`default_nettype none
module testbench;

  localparam RECORDS  = [[ bench.records ]];
  localparam STIMULUS = [[ bench.stimulus ]];
  localparam EPOCHS   = [[ bench.epochs ]];
  localparam RESTS    = [[ bench.rests ]];
  localparam PIXELS   = [[ bench.pixels ]];
  localparam WIDTH    = [[ bench.width ]];
  localparam SILENCE  = [[ bench.silence ]];  // longest pause inside a frame, clocks
  localparam STAGES   = [[ bench.stage_count ]];
  localparam LIMIT    = 10;  // mismatches that are printed
  localparam PATIENCE = 20000 + 8 * PIXELS + 4 * SILENCE;  // clocks without any result that end the run

  reg clk   = 1'b0;
  reg rst_n = 1'b0;
  always #5 clk = !clk;

  reg  [19:0] stimulus [0:STIMULUS-1];
  reg  [31:0] epoch_end [0:EPOCHS-1];
  reg  [31:0] rests [0:3*RESTS-1];  // results due, sets done, sets discarded
[%- for vector in bench.vectors %]
  reg  [[ "[" ]][[ vector.bits - 1 ]]:0] expected_[[ vector.name ]] [0:RECORDS-1];
[%- endfor %]

  reg         s_axis_tvalid = 1'b0;
  wire        s_axis_tready;
  reg  [[ "[" ]][[ bench.sample_bus - 1 ]]:0] s_axis_tdata = 0;
  reg         s_axis_tlast = 1'b0;
  reg  [1:0]  s_axis_tuser = 2'd0;
  wire        m_axis_tvalid;
  reg         m_axis_tready = 1'b0;
  wire [[ "[" ]][[ bench.result_bits - 1 ]]:0] m_axis_tdata;
  wire        m_axis_tlast;
  wire        m_axis_tuser;
  wire [31:0] sets_done;
  wire [31:0] sets_discarded;
  wire [31:0] stall_clocks;

  [[ bench.top ]] dut (
    .clk_i           (clk),
    .rst_ni          (rst_n),
    .s_axis_tvalid   (s_axis_tvalid),
    .s_axis_tready   (s_axis_tready),
    .s_axis_tdata    (s_axis_tdata),
    .s_axis_tlast    (s_axis_tlast),
    .s_axis_tuser    (s_axis_tuser),
    .m_axis_tvalid   (m_axis_tvalid),
    .m_axis_tready   (m_axis_tready),
    .m_axis_tdata    (m_axis_tdata),
    .m_axis_tlast    (m_axis_tlast),
    .m_axis_tuser    (m_axis_tuser),
    .sets_done_o     (sets_done),
    .sets_discarded_o(sets_discarded),
    .stall_clocks_o  (stall_clocks)
  );

  integer seed;
  integer pause;
  integer stop;
  integer dump_from;
  integer dump_to;
  reg [8*256-1:0] dump;
  reg             dumping = 1'b0;

  initial begin
    if (!$value$plusargs("seed=%d", seed)) seed = 1;
    if (!$value$plusargs("pause=%d", pause)) pause = 25;
    if (!$value$plusargs("stop=%d", stop)) stop = 25;
    if (!$value$plusargs("dump_from=%d", dump_from)) dump_from = 0;
    if (!$value$plusargs("dump_to=%d", dump_to)) dump_to = 2147483647;
    if ($value$plusargs("dump=%s", dump)) dumping = 1'b1;
    $readmemh("vectors/stimulus.hex", stimulus);
    $readmemh("vectors/epochs.hex", epoch_end);
    $readmemh("vectors/rests.hex", rests);
[%- for vector in bench.vectors %]
    $readmemh("vectors/[[ vector.name ]].hex", expected_[[ vector.name ]]);
[%- endfor %]
    if (dumping) begin
      $dumpfile(dump);
      $dumpvars(0, testbench.dut);
      $dumpoff;
    end
  end

  integer clocks     = 0;
  integer idle       = 0;  // clocks since anything happened
  integer compared   = 0;
  integer mismatches = 0;
  integer word       = 0;  // next line of the stimulus
  integer epoch      = 0;
  integer rest       = 0;
  integer stalls     = 0;  // clocks since reset in which a beat was not taken
  integer wait_for   = 4;  // clocks of reset or silence left
  integer run        = 0;  // length of the present pause
  integer burst      = 0;  // clocks that are left of the present stop or go
  integer record [0:STAGES-1];  // next record of each stage
  integer pixel;
  integer stage;
  reg        resetting = 1'b1;
  reg        finished  = 1'b0;
  reg        resting   = 1'b0;
  reg        exact     = 1'b0;  // the next beat comes without a random pause
  reg        stopped   = 1'b0;
  reg [19:0] next;
  reg        held_valid = 1'b0;
  reg [[ "[" ]][[ bench.result_bits + 1 ]]:0] held = 0;

  initial for (stage = 0; stage < STAGES; stage = stage + 1) record[stage] = 0;

  task automatic surplus(input integer at);
    begin
      mismatches = mismatches + 1;
      if (mismatches <= LIMIT) $display("SURPLUS stage=%0d record=%0d clock=%0d", at, record[at], clocks);
    end
  endtask

  task automatic report(input reg [8*32-1:0] name, input integer number, input reg [63:0] wanted,
                        input reg [63:0] found);
    begin
      mismatches = mismatches + 1;
      if (mismatches <= LIMIT) begin
        $display("MISMATCH channel=%0s record=%0d set=%0d pixel=%0d clock=%0d expected=%0h actual=%0h (binary %b, %b)",
                 name, number, number / PIXELS, number % PIXELS, clocks, wanted, found, wanted, found);
      end
    end
  endtask

  // The checks, with what the core shows before this clock's edge.
  always @(posedge clk) begin
    clocks = clocks + 1;
    idle   = idle + 1;
    if (dumping && clocks == dump_from) $dumpon;
    if (dumping && clocks == dump_to) $dumpoff;

    if (held_valid && rst_n && (!m_axis_tvalid || {m_axis_tuser, m_axis_tlast, m_axis_tdata} !== held)) begin
      mismatches = mismatches + 1;
      if (mismatches <= LIMIT) $display("UNSTABLE clock=%0d: the result changed while it waited", clocks);
    end
    held_valid = m_axis_tvalid === 1'b1 && !m_axis_tready && rst_n;
    held       = {m_axis_tuser, m_axis_tlast, m_axis_tdata};
    if (s_axis_tvalid && s_axis_tready) idle = 0;
    if (!rst_n) stalls = 0;
    else if (s_axis_tvalid && !s_axis_tready) stalls = stalls + 1;

    if (rst_n) begin
[%- for stage in bench.stages %]
      if (([[ stage.strobe ]]) !== 1'b0) begin  // [[ stage.name ]]
        idle = 0;
        if (record[ [[- stage.number -]] ] >= epoch_end[epoch]) surplus([[ stage.number ]]);
        else begin
[%- for channel in stage.channels %]
          if ([[ channel.probe ]] !== expected_[[ channel.vector ]][record[ [[- stage.number -]] ]])
            report("[[ channel.name ]]", record[ [[- stage.number -]] ], {[[ channel.spare_bits ]]'d0, expected_[[ channel.vector ]][record[ [[- stage.number -]] ]]},
                   {[[ channel.spare_bits ]]'d0, [[ channel.probe ]]});
[%- endfor %]
          compared = compared + [[ stage.channels.len() ]];
[%- if loop.last %]
          pixel = record[ [[- stage.number -]] ] % PIXELS;
          if (m_axis_tuser !== (pixel == 0)) report("output.first", record[ [[- stage.number -]] ], pixel == 0, m_axis_tuser);
          if (m_axis_tlast !== (pixel % WIDTH == WIDTH - 1))
            report("output.last", record[ [[- stage.number -]] ], pixel % WIDTH == WIDTH - 1, m_axis_tlast);
          compared = compared + 2;
[%- endif %]
        end
        record[ [[- stage.number -]] ] = record[ [[- stage.number -]] ] + 1;
      end
[%- endfor %]
    end

    if (resting && idle > SILENCE + 64 && record[STAGES-1] >= rests[3*rest]) begin
      resting = 1'b0;
      if (sets_done !== rests[3*rest+1] || sets_discarded !== rests[3*rest+2] || stall_clocks !== stalls) begin
        mismatches = mismatches + 1;
        $display("COUNTERS sets_done=%0d expected=%0d sets_discarded=%0d expected=%0d stall_clocks=%0d expected=%0d clock=%0d",
                 sets_done, rests[3*rest+1], sets_discarded, rests[3*rest+2], stall_clocks, stalls, clocks);
      end
      compared = compared + 3;
      rest     = rest + 1;
    end

    if (!finished && ((word == STIMULUS && wait_for == 0 && !resting) || idle > PATIENCE || mismatches > LIMIT)) begin
      finished = 1'b1;
      for (stage = 0; stage < STAGES; stage = stage + 1) begin
        if (record[stage] < RECORDS) begin
          mismatches = mismatches + 1;
          $display("MISSING stage=%0d record=%0d of %0d clock=%0d", stage, record[stage], RECORDS, clocks);
        end
      end
      if (word != STIMULUS) begin
        mismatches = mismatches + 1;
        $display("STUCK stimulus=%0d of %0d clock=%0d: the input was not taken", word, STIMULUS, clocks);
      end
      if (mismatches == 0) begin
        $display("PASS values=%0d clocks=%0d", compared, clocks);
        $finish;
      end else begin
        // A stop, so that `vvp -N` and its like end with an exit code that is not 0.
        $display("FAIL mismatches=%0d clocks=%0d", mismatches, clocks);
        $stop;
      end
    end

    // The source, after the checks. A beat stays offered until it is taken; an operation begins when the beat before it has been.
    if (wait_for > 0) begin
      wait_for = wait_for - 1;
      if (wait_for == 0 && resetting) begin
        rst_n     <= 1'b1;
        resetting  = 1'b0;
      end
    end else if (!resting && (!s_axis_tvalid || s_axis_tready)) begin
      s_axis_tvalid <= 1'b0;
      if (word < STIMULUS) begin
        next = stimulus[word];
        if (next[19:16] == 4'h9) begin  // a pause of exactly so many clocks
          word     = word + 1;
          wait_for = next[15:0] - 1;
          exact    = 1'b1;
        end else if (next[19:16] == 4'ha) begin  // reset: what is still under way is lost
          word      = word + 1;
          wait_for  = 4;
          resetting = 1'b1;
          rst_n    <= 1'b0;
          for (stage = 0; stage < STAGES; stage = stage + 1) begin
            if (record[stage] > epoch_end[epoch]) surplus(stage);
            record[stage] = epoch_end[epoch];
          end
          epoch = epoch + 1;
        end else if (next[19:16] == 4'hb) begin  // rest: everything comes out
          word    = word + 1;
          resting = 1'b1;
        end else if (!exact && run < 12 && $unsigned($random(seed)) % 100 < pause) begin
          run = run + 1;
        end else begin
          run            = 0;
          exact          = 1'b0;
          word           = word + 1;
          s_axis_tvalid <= 1'b1;
          s_axis_tdata  <= next[15:0];
          s_axis_tlast  <= next[18];
          s_axis_tuser  <= next[17:16];
        end
      end
    end
    // Stops come in bursts, so that a drain can fall behind by a whole line.
    if (burst == 0) begin
      stopped = $unsigned($random(seed)) % 100 < stop;
      burst   = 1 + $unsigned($random(seed)) % 8;
    end
    burst          = burst - 1;
    m_axis_tready <= !stopped;
  end

endmodule
`default_nettype wire
