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
  input  wire [1:0]  s_axis_tuser,     // raw stream
  output wire        m_axis_tvalid,    // result stream
  input  wire        m_axis_tready,    // result stream
  output wire [[ "[" ]][[ bench.result_bits - 1 ]]:0] m_axis_tdata,     // result stream
  output wire        m_axis_tlast,     // result stream
  output wire        m_axis_tuser,     // result stream
  output wire [31:0] sets_done_o,      // counter
  output wire [31:0] sets_discarded_o, // counter
  output wire [31:0] stall_clocks_o,   // counter
  output wire [[ "[" ]][[ bench.stage_count - 1 ]]:0] strobe_o,         // a pixel passes the stage
  output wire        padding_o,        // a bit between the result's fields is not 0
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
    .stall_clocks_o  (stall_clocks_o)
  );

  assign padding_o = |(m_axis_tdata & [[ bench.padding ]]);
[% for stage in bench.stages %]
  // [[ stage.name ]]
  assign strobe_o[ [[- stage.number -]] ] = [[ stage.strobe ]];
[%- for channel in stage.channels %]
  assign values_o[ [[- channel.low ]] +: 64] = {[[ channel.spare_bits ]]'d0, [[ channel.probe ]]};
[%- endfor %]
[% endfor %]
endmodule
`default_nettype wire
