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
  localparam ANNOUNCEMENTS = [[ bench.announcements ]];
  localparam ACCESSES = [[ bench.accesses ]];
  localparam PIXELS   = [[ bench.pixels ]];
  localparam WIDTH    = [[ bench.width ]];
  localparam SILENCE  = [[ bench.silence ]];  // longest pause inside a frame, clocks
  localparam STAGES   = [[ bench.stage_count ]];
  localparam LIMIT    = 10;  // mismatches that are printed
  localparam PATIENCE = 20000 + 8 * PIXELS + 4 * SILENCE;  // clocks without any result that end the run

  reg clk   = 1'b0;
  reg rst_n = 1'b0;
  always #5 clk = !clk;

  reg  [[ "[" ]][[ bench.stimulus_bits - 1 ]]:0] stimulus [0:STIMULUS-1];
  reg  [31:0] epoch_end [0:2*EPOCHS-1];  // results and announcements due
  reg  [31:0] rests [0:3*RESTS-1];  // results due, sets done, sets discarded
  reg  [[ "[" ]][[ bench.announcement_bits - 1 ]]:0] announcements [0:[[ bench.announcement_lines - 1 ]]];  // {first of a set, phase step, its phase}
[%- if bench.registers %]
  reg  [31:0] accesses [0:[[ 3 * bench.access_lines - 1 ]]];  // {write, okay, counter, strobes, address}, written, read (or the factor then)
[%- endif %]
[%- for vector in bench.vectors %]
  reg  [[ "[" ]][[ vector.bits - 1 ]]:0] expected_[[ vector.name ]] [0:RECORDS-1];
[%- endfor %]

  reg         s_axis_tvalid = 1'b0;
  wire        s_axis_tready;
  reg  [[ "[" ]][[ bench.sample_bus - 1 ]]:0] s_axis_tdata = 0;
  reg         s_axis_tlast = 1'b0;
  reg  [[ "[" ]][[ bench.user_bits - 1 ]]:0]  s_axis_tuser = [[ bench.user_bits ]]'d0;
  wire        m_axis_tvalid;
  reg         sink_ready = 1'b0;
  reg         shy = 1'b0;  // the sink is ready for nothing but what is offered
  wire        m_axis_tready = sink_ready && (!shy || m_axis_tvalid === 1'b1);
  wire [[ "[" ]][[ bench.result_bits - 1 ]]:0] m_axis_tdata;
  wire        m_axis_tlast;
  wire        m_axis_tuser;
  wire [31:0] sets_done;
  wire [31:0] sets_discarded;
  wire [31:0] stall_clocks;
  wire        next_frame_strobe;
  wire [[ "[" ]][[ bench.announcement_bits - 1 ]]:0] next_frame;
[%- if bench.registers %]
  reg         s_axil_awvalid = 0;
  wire        s_axil_awready;
  reg  [7:0]  s_axil_awaddr = 0;
  reg         s_axil_wvalid = 0;
  wire        s_axil_wready;
  reg  [31:0] s_axil_wdata = 0;
  reg  [3:0]  s_axil_wstrb = 0;
  wire        s_axil_bvalid;
  reg         s_axil_bready = 0;
  wire [1:0]  s_axil_bresp;
  reg         s_axil_arvalid = 0;
  wire        s_axil_arready;
  reg  [7:0]  s_axil_araddr = 0;
  wire        s_axil_rvalid;
  reg         s_axil_rready = 0;
  wire [31:0] s_axil_rdata;
  wire [1:0]  s_axil_rresp;
  wire [31:0] frequency_factor;
[%- endif %]

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
    .stall_clocks_o  (stall_clocks),
[%- if bench.registers %]
    .s_axil_awvalid  (s_axil_awvalid),
    .s_axil_awready  (s_axil_awready),
    .s_axil_awaddr   (s_axil_awaddr),
    .s_axil_wvalid   (s_axil_wvalid),
    .s_axil_wready   (s_axil_wready),
    .s_axil_wdata    (s_axil_wdata),
    .s_axil_wstrb    (s_axil_wstrb),
    .s_axil_bvalid   (s_axil_bvalid),
    .s_axil_bready   (s_axil_bready),
    .s_axil_bresp    (s_axil_bresp),
    .s_axil_arvalid  (s_axil_arvalid),
    .s_axil_arready  (s_axil_arready),
    .s_axil_araddr   (s_axil_araddr),
    .s_axil_rvalid   (s_axil_rvalid),
    .s_axil_rready   (s_axil_rready),
    .s_axil_rdata    (s_axil_rdata),
    .s_axil_rresp    (s_axil_rresp),
    .frequency_factor_o(frequency_factor),
[%- endif %]
    .next_frame_strobe_o(next_frame_strobe),
    .next_frame_first_o (next_frame[ [[- bench.announcement_bits - 1 -]] ]),
    .next_frame_step_o  (next_frame[ [[- bench.phase_step_bits ]] +: [[ bench.step_bits -]] ]),
    .next_frame_phase_o (next_frame[ [[- bench.phase_step_bits - 1 ]]:0])
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
    noise_seed = seed + 104729;
    $readmemh("vectors/stimulus.hex", stimulus);
    $readmemh("vectors/epochs.hex", epoch_end);
    $readmemh("vectors/rests.hex", rests);
    $readmemh("vectors/announcements.hex", announcements);
[%- if bench.registers %]
    $readmemh("vectors/accesses.hex", accesses);
    register_seed = seed + 7919;  // the stream's traffic stays what it is without accesses
[%- endif %]
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
  integer noise_seed;  // a source of its own, so that it leaves the pauses and stops as they are
  integer drained    = 0;  // sums taken since reset
  integer needless   = 0;  // clocks for which a sample has been held without need
  integer first_taken = -1;  // samples taken since the last start of set, if there was one
  integer stalls     = 0;  // clocks since reset in which a beat was not taken
  integer wait_for   = 4;  // clocks of reset or silence left
  integer run        = 0;  // length of the present pause
  integer burst      = 0;  // clocks that are left of the present stop or go
  integer record [0:STAGES-1];  // next record of each stage
  integer announcement = 0;  // next of the announcements
  integer due    = 0;  // accesses that have begun
  integer issue  = 0;  // next access that is offered to the core
  integer answer = 0;  // next access whose answer is awaited
  integer saturated_pixels = 0;  // taken since reset
  integer set_number       = 0;  // of the last pixel taken since reset
  integer pixel;
  integer stage;
  reg  [[ "[" ]][[ bench.announcement_bits - 1 ]]:0] announced = [[ bench.first_announcement ]];  // what is to be told at present
[%- if bench.registers %]
  integer register_seed;
  integer a_wait  = 0;  // clocks before the address is offered
  integer w_wait  = 0;  // clocks before the data are offered
  reg         issuing = 1'b0;  // an access is being offered
  reg         aw_open = 1'b0;
  reg         w_open  = 1'b0;
  reg         ar_open = 1'b0;
  reg         b_held  = 1'b0;
  reg         r_held  = 1'b0;
  reg  [1:0]  b_was   = 2'd0;
  reg  [33:0] r_was   = 34'd0;
  reg  [31:0] head;
  reg  [31:0] wanted_data;
  reg  [31:0] counted [0:15];  // what the counter was when the address was taken
  reg  [31:0] factor = [[ bench.frequency_factor ]];
[%- endif %]
  reg        resetting = 1'b1;
  reg        finished  = 1'b0;
  reg        resting   = 1'b0;
  reg        exact     = 1'b0;  // the next beat comes without a random pause
  reg        stopped   = 1'b0;
  reg [[ "[" ]][[ bench.stimulus_bits - 1 ]]:0] next;
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

[%- if bench.registers %]

  // An answer of the core to access number `answer`.
  task automatic answered(input reg is_write, input reg [1:0] response, input reg [31:0] data);
    begin
      idle = 0;
      head = accesses[3*answer];
      if (answer >= issue || head[17] !== is_write) begin
        mismatches = mismatches + 1;
        if (mismatches <= LIMIT) $display("REGISTER access=%0d clock=%0d: an answer that is not due", answer, clocks);
      end else begin
        wanted_data = head[15:12] != 0 ? counted[answer % 16] : accesses[3*answer+2];
        if (response !== (head[16] ? 2'b00 : 2'b10) || (!is_write && data !== wanted_data)) begin
          mismatches = mismatches + 1;
          if (mismatches <= LIMIT)
            $display("REGISTER access=%0d write=%0d address=%0h clock=%0d expected=%0h okay=%0d actual=%0h response=%b",
                     answer, is_write, head[7:0], clocks, wanted_data, head[16], data, response);
        end
        compared = compared + (is_write ? 1 : 2);
        answer   = answer + 1;
      end
    end
  endtask
[%- endif %]

  // The checks, with what the core shows before this clock's edge.
  always @(posedge clk) begin
    clocks = clocks + 1;
    idle   = idle + 1;
[%- if bench.registers %]

    // The registers: answers, then what is taken in this clock, while the counters still are what they were before it.
    if (!rst_n) factor = [[ bench.frequency_factor ]];
    else begin
      if (s_axil_bvalid && !b_held && answer < issue) factor = accesses[3*answer+2];
      if (frequency_factor !== factor) begin
        mismatches = mismatches + 1;
        if (mismatches <= LIMIT)
          $display("REGISTER frequency_factor clock=%0d expected=%0h actual=%0h", clocks, factor, frequency_factor);
      end
      if ((b_held && (s_axil_bvalid !== 1'b1 || s_axil_bresp !== b_was))
          || (r_held && (s_axil_rvalid !== 1'b1 || {s_axil_rresp, s_axil_rdata} !== r_was))) begin
        mismatches = mismatches + 1;
        if (mismatches <= LIMIT) $display("UNSTABLE clock=%0d: a register's answer changed while it waited", clocks);
      end
      if (s_axil_bvalid !== 1'b0 && s_axil_bready) answered(1'b1, s_axil_bresp, 32'd0);
      if (s_axil_rvalid !== 1'b0 && s_axil_rready) answered(1'b0, s_axil_rresp, s_axil_rdata);
    end
    b_held = rst_n && s_axil_bvalid === 1'b1 && !s_axil_bready;
    b_was  = s_axil_bresp;
    r_held = rst_n && s_axil_rvalid === 1'b1 && !s_axil_rready;
    r_was  = {s_axil_rresp, s_axil_rdata};
    if (issuing) begin
      if (s_axil_awvalid && s_axil_awready) begin
        s_axil_awvalid <= 1'b0;
        s_axil_awaddr  <= $random(register_seed);
        aw_open         = 1'b0;
      end
      if (s_axil_wvalid && s_axil_wready) begin
        s_axil_wvalid <= 1'b0;
        s_axil_wdata  <= $random(register_seed);
        s_axil_wstrb  <= $random(register_seed);
        w_open         = 1'b0;
      end
      if (s_axil_arvalid && s_axil_arready) begin
        s_axil_arvalid <= 1'b0;
        s_axil_araddr  <= $random(register_seed);
        ar_open         = 1'b0;
        head            = accesses[3*issue];
        case (head[15:12])
          4'd1: counted[issue % 16] = sets_done;
          4'd2: counted[issue % 16] = sets_discarded;
          4'd3: counted[issue % 16] = stalls;
          4'd4: counted[issue % 16] = saturated_pixels;
          4'd5: counted[issue % 16] = set_number;
          default: ;
        endcase
      end
      if (!aw_open && !w_open && !ar_open) begin
        issuing = 1'b0;
        issue   = issue + 1;
        idle    = 0;
      end
    end
    // Reads may follow reads, and writes writes, before they are answered.
    if (rst_n && !issuing && issue < due && issue < answer + 8
        && (issue == answer || accesses[3*issue][17] == accesses[3*issue-3][17])) begin
      issuing = 1'b1;
      head    = accesses[3*issue];
      aw_open = head[17];
      w_open  = head[17];
      ar_open = !head[17];
      a_wait  = $unsigned($random(register_seed)) % 2 ? $unsigned($random(register_seed)) % 6 : 0;
      w_wait  = $unsigned($random(register_seed)) % 2 ? $unsigned($random(register_seed)) % 6 : 0;
    end else if (issuing) begin
      head = accesses[3*issue];
      if (a_wait > 0) a_wait = a_wait - 1;
      else begin
        if (aw_open && !s_axil_awvalid) begin
          s_axil_awvalid <= 1'b1;
          s_axil_awaddr  <= head[7:0];
        end
        if (ar_open && !s_axil_arvalid) begin
          s_axil_arvalid <= 1'b1;
          s_axil_araddr  <= head[7:0];
        end
      end
      if (w_wait > 0) w_wait = w_wait - 1;
      else if (w_open && !s_axil_wvalid) begin
        s_axil_wvalid <= 1'b1;
        s_axil_wdata  <= accesses[3*issue+1];
        s_axil_wstrb  <= head[11:8];
      end
    end
    // Every other answer is waited for, not made ready for: a core that waits for readiness waits for ever.
    s_axil_bready <= $unsigned($random(register_seed)) % 100 >= stop && (answer % 2 == 0 || s_axil_bvalid === 1'b1);
    s_axil_rready <= $unsigned($random(register_seed)) % 100 >= stop && (answer % 2 == 0 || s_axil_rvalid === 1'b1);
[%- endif %]

    // What the modulation hardware is told.
    if (!rst_n) announced = [[ bench.first_announcement ]];
    else begin
      if (next_frame_strobe !== 1'b0) begin
        idle = 0;
        if (announcement >= epoch_end[2*epoch+1]) begin
          mismatches = mismatches + 1;
          if (mismatches <= LIMIT) $display("SEQUENCER announcement=%0d clock=%0d: it is not due", announcement, clocks);
        end else begin
          announced    = announcements[announcement];
          announcement = announcement + 1;
          compared     = compared + 1;
        end
      end
      if (next_frame !== announced) begin
        mismatches = mismatches + 1;
        if (mismatches <= LIMIT)
          $display("SEQUENCER announcement=%0d clock=%0d {first, step, phase} expected=%b actual=%b",
                   announcement - 1, clocks, announced, next_frame);
      end
    end
    if (dumping && clocks == dump_from) $dumpon;
    if (dumping && clocks == dump_to) $dumpoff;

    if (held_valid && rst_n && (!m_axis_tvalid || {m_axis_tuser, m_axis_tlast, m_axis_tdata} !== held)) begin
      mismatches = mismatches + 1;
      if (mismatches <= LIMIT) $display("UNSTABLE clock=%0d: the result changed while it waited", clocks);
    end
    held_valid = m_axis_tvalid === 1'b1 && !m_axis_tready && rst_n;
    held       = {m_axis_tuser, m_axis_tlast, m_axis_tdata};
    if (s_axis_tvalid && s_axis_tready) idle = 0;
    if (!rst_n) begin
      stalls           = 0;
      saturated_pixels = 0;
      set_number       = 0;
    end else if (s_axis_tvalid && !s_axis_tready) stalls = stalls + 1;

    // A set's first frame may follow the drain of the set before: a sample of a pixel whose sums have been taken need not wait.
    // Two samples before it may be on their way; they must be the same frame's.
    // The last two sums may wait in registers after their drain, while the next set is complete already.
    if (rst_n && s_axis_tvalid && !s_axis_tready && drained % PIXELS + 2 < PIXELS && first_taken >= 2
        && first_taken < drained % PIXELS) needless = needless + 1;
    else needless = 0;
    if (needless == 4) begin
      mismatches = mismatches + 1;
      if (mismatches <= LIMIT) $display("HELD clock=%0d: a sample whose pixel has drained waits", clocks);
    end
    if (!rst_n) begin
      drained     = 0;
      first_taken = -1;
    end else if (s_axis_tvalid && s_axis_tready) begin
      if (s_axis_tuser[1:0] == 2'b11) first_taken = 1;
      else if (first_taken >= 0) first_taken = first_taken + 1;
    end
    if (rst_n && (dut.sums_valid && dut.sums_taken) === 1'b1) drained = drained + 1;
    if (rst_n && ([[ bench.refused ]]) !== 1'b0) begin
      mismatches = mismatches + 1;
      if (mismatches <= LIMIT) $display("REFUSED clock=%0d: an empty register holds up what comes before it", clocks);
    end

    if (rst_n) begin
[%- for stage in bench.stages %]
      if (([[ stage.strobe ]]) !== 1'b0) begin  // [[ stage.name ]]
        idle = 0;
        if (record[ [[- stage.number -]] ] >= epoch_end[2*epoch]) surplus([[ stage.number ]]);
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
          if ((m_axis_tdata & [[ bench.padding ]]) !== [[ bench.result_bits ]]'d0)
            report("output.padding", record[ [[- stage.number -]] ], 64'd0, 64'd1);
          compared = compared + 2;
          saturated_pixels = saturated_pixels + expected_saturated[record[ [[- stage.number -]] ]];
          if (pixel == 0) set_number = set_number + 1;
[%- endif %]
        end
        record[ [[- stage.number -]] ] = record[ [[- stage.number -]] ] + 1;
      end
[%- endfor %]
    end

    if (resting && answer == due && idle > SILENCE + 64 && record[STAGES-1] >= rests[3*rest]) begin
      resting = 1'b0;
      if (sets_done !== rests[3*rest+1] || sets_discarded !== rests[3*rest+2] || stall_clocks !== stalls) begin
        mismatches = mismatches + 1;
        $display("COUNTERS sets_done=%0d expected=%0d sets_discarded=%0d expected=%0d stall_clocks=%0d expected=%0d clock=%0d",
                 sets_done, rests[3*rest+1], sets_discarded, rests[3*rest+2], stall_clocks, stalls, clocks);
      end
      compared = compared + 3;
      rest     = rest + 1;
    end

    if (!finished && ((word == STIMULUS && wait_for == 0 && !resting && answer == due) ||
        idle > PATIENCE || mismatches > LIMIT)) begin
      finished = 1'b1;
      for (stage = 0; stage < STAGES; stage = stage + 1) begin
        if (record[stage] < RECORDS) begin
          mismatches = mismatches + 1;
          $display("MISSING stage=%0d record=%0d of %0d clock=%0d", stage, record[stage], RECORDS, clocks);
        end
      end
      if (announcement != ANNOUNCEMENTS) begin
        mismatches = mismatches + 1;
        $display("SEQUENCER announcement=%0d of %0d clock=%0d: it is missing", announcement, ANNOUNCEMENTS, clocks);
      end
      if (answer != due) begin
        mismatches = mismatches + 1;
        $display("REGISTER access=%0d of %0d clock=%0d: no answer", answer, ACCESSES, clocks);
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

    // What is not valid is anything.
    if (!s_axis_tvalid || s_axis_tready) begin
      s_axis_tdata <= $random(noise_seed);
      s_axis_tlast <= $random(noise_seed);
      s_axis_tuser <= $random(noise_seed);
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
          wait_for  = 1 + $unsigned($random(seed)) % 4;
          resetting = 1'b1;
          rst_n    <= 1'b0;
          for (stage = 0; stage < STAGES; stage = stage + 1) begin
            if (record[stage] > epoch_end[2*epoch]) surplus(stage);
            record[stage] = epoch_end[2*epoch];
          end
          if (announcement > epoch_end[2*epoch+1]) begin
            mismatches = mismatches + 1;
            $display("SEQUENCER announcement=%0d clock=%0d: it is not due", announcement, clocks);
          end
          announcement = epoch_end[2*epoch+1];
          epoch        = epoch + 1;
          issue        = due;
          answer       = due;
[%- if bench.registers %]
          issuing         = 1'b0;
          s_axil_awvalid <= 1'b0;
          s_axil_wvalid  <= 1'b0;
          s_axil_arvalid <= 1'b0;
[%- endif %]
        end else if (next[19:16] == 4'hc) begin  // the next access to a register begins
          word = word + 1;
          due  = due + 1;
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
          s_axis_tuser  <= [% if bench.user_bits == 3 %]{next[20], next[17:16]}[% else %]next[17:16][% endif %];
        end
      end
    end
    // Stops come in bursts, so that a drain can fall behind by a whole line.
    if (burst == 0) begin
      stopped = $unsigned($random(seed)) % 100 < stop;
      burst   = 1 + $unsigned($random(seed)) % 8;
      // Once in a while one is so long that every register behind it fills up.
      if (stopped && $unsigned($random(seed)) % 96 == 0) burst = 256;
    end
    burst          = burst - 1;
    sink_ready    <= !stopped;
    // While everything comes out, a core that waits for the sink waits for ever.
    shy           <= resting || word == STIMULUS;
  end

endmodule
`default_nettype wire
