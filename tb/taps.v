[[ bench.banner ]]
// Stages, a strobe bit each, values 64 bits each:
[%- for stage in bench.stages %]
//   [[ stage.number ]] [[ stage.name ]]:[% for channel in stage.channels %] [[ channel.vector ]][% endfor %]
[%- endfor %]
`default_nettype none
module bench_taps (
  input  wire        clk_i,            // clock
  input  wire        rst_ni,           // synchronous reset, active low
  input  wire        s_axis_tvalid,    // raw stream
  output wire        s_axis_tready,    // raw stream
  input  wire [[ "[" ]][[ bench.sample_bus - 1 ]]:0] s_axis_tdata,     // raw stream
  input  wire        s_axis_tlast,     // raw stream
  input  wire [[ "[" ]][[ bench.user_bits - 1 ]]:0]  s_axis_tuser,     // raw stream
  output wire        m_axis_tvalid,    // result stream
  input  wire        m_axis_tready,    // result stream
  output wire [[ "[" ]][[ bench.result_bits - 1 ]]:0] m_axis_tdata,     // result stream
  output wire        m_axis_tlast,     // result stream
  output wire        m_axis_tuser,     // result stream
  output wire [31:0] sets_done_o,      // counter
  output wire [31:0] sets_discarded_o, // counter
  output wire [31:0] stall_clocks_o,   // counter
[%- if bench.registers %]
  input  wire        s_axil_awvalid,   // registers
  output wire        s_axil_awready,   // registers
  input  wire [7:0]  s_axil_awaddr,    // registers
  input  wire        s_axil_wvalid,    // registers
  output wire        s_axil_wready,    // registers
  input  wire [31:0] s_axil_wdata,     // registers
  input  wire [3:0]  s_axil_wstrb,     // registers
  output wire        s_axil_bvalid,    // registers
  input  wire        s_axil_bready,    // registers
  output wire [1:0]  s_axil_bresp,     // registers
  input  wire        s_axil_arvalid,   // registers
  output wire        s_axil_arready,   // registers
  input  wire [7:0]  s_axil_araddr,    // registers
  output wire        s_axil_rvalid,    // registers
  input  wire        s_axil_rready,    // registers
  output wire [31:0] s_axil_rdata,     // registers
  output wire [1:0]  s_axil_rresp,     // registers
  output wire [31:0] frequency_factor_o,  // to the modulation hardware
[%- endif %]
  output wire        next_frame_strobe_o, // to the modulation hardware: what follows is new
  output wire [[ "[" ]][[ bench.announcement_bits - 1 ]]:0] next_frame_o,       // {first of a set, phase step, its phase}
  output wire [[ "[" ]][[ bench.stage_count - 1 ]]:0] strobe_o,         // a pixel passes the stage
  output wire        padding_o,        // a bit between the result's fields is not 0
  output wire        refused_o,        // an empty register does not take what comes before it
  output wire [[ "[" ]][[ bench.channel_bits - 1 ]]:0] values_o          // what it carries
);

  [[ bench.top ]] dut (
    .clk_i           (clk_i),
    .rst_ni          (rst_ni),
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
    .sets_done_o     (sets_done_o),
    .sets_discarded_o(sets_discarded_o),
    .stall_clocks_o  (stall_clocks_o),
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
    .frequency_factor_o(frequency_factor_o),
[%- endif %]
    .next_frame_strobe_o(next_frame_strobe_o),
    .next_frame_first_o (next_frame_o[ [[- bench.announcement_bits - 1 -]] ]),
    .next_frame_step_o  (next_frame_o[ [[- bench.phase_step_bits ]] +: [[ bench.step_bits -]] ]),
    .next_frame_phase_o (next_frame_o[ [[- bench.phase_step_bits - 1 ]]:0])
  );

  assign padding_o = |(m_axis_tdata & [[ bench.padding ]]);
  assign refused_o = [[ bench.refused ]];
[% for stage in bench.stages %]
  // [[ stage.name ]]
  assign strobe_o[ [[- stage.number -]] ] = [[ stage.strobe ]];
[%- for channel in stage.channels %]
  assign values_o[ [[- channel.low ]] +: 64] = {[[ channel.spare_bits ]]'d0, [[ channel.probe ]]};
[%- endfor %]
[% endfor %]
endmodule
`default_nettype wire
