// Properties of the whole core at its ports: the rules of AXI4-Stream on the results, no bit between the fields, and
// the counter of stalled clocks.
`default_nettype none
module properties (
  input  wire                   clk,
  input  wire                   reset,
  input  wire                   s_axis_tvalid,
  input  wire [`SAMPLE_BUS-1:0] s_axis_tdata,
  input  wire                   s_axis_tlast,
  input  wire [1:0]             s_axis_tuser,
  input  wire                   m_axis_tready,
  output wire                   watched
);
  reg started = 1'b0;
  always @(posedge clk) started <= 1'b1;
  wire rst_n = started && !reset;

  wire s_axis_tready, m_axis_tvalid, m_axis_tlast, m_axis_tuser;
  wire [`RESULT_BITS-1:0] m_axis_tdata;
  wire [31:0] sets_done_o, sets_discarded_o, stall_clocks_o;
  `PIPELINE dut (
    .clk_i(clk), .rst_ni(rst_n),
    .s_axis_tvalid(s_axis_tvalid), .s_axis_tready(s_axis_tready), .s_axis_tdata(s_axis_tdata),
    .s_axis_tlast(s_axis_tlast), .s_axis_tuser(s_axis_tuser),
    .m_axis_tvalid(m_axis_tvalid), .m_axis_tready(m_axis_tready), .m_axis_tdata(m_axis_tdata),
    .m_axis_tlast(m_axis_tlast), .m_axis_tuser(m_axis_tuser),
    .sets_done_o(sets_done_o), .sets_discarded_o(sets_discarded_o), .stall_clocks_o(stall_clocks_o)
  );

  // The clock before.
  reg                      waited = 1'b0;
  reg [`RESULT_BITS+1:0]   offered;
  reg [31:0]               stalls = 32'd0;
  wire [`RESULT_BITS+1:0]  offer = {m_axis_tuser, m_axis_tlast, m_axis_tdata};
  always @(posedge clk) begin
    waited  <= rst_n && m_axis_tvalid && !m_axis_tready;
    offered <= offer;
    stalls  <= rst_n ? stalls + (s_axis_tvalid && !s_axis_tready) : 32'd0;
  end

  wire [3:0] bad = {
    rst_n && stall_clocks_o != stalls,                              // 3 stalled clocks are counted
    rst_n && m_axis_tvalid && |(m_axis_tdata & `PADDING),           // 2 the bits between the fields are 0
    rst_n && waited && offer != offered,                            // 1 a result is stable while it waits
    rst_n && waited && !m_axis_tvalid                               // 0 a result is offered until taken
  };
  wire [0:0] seen = {
    rst_n && stall_clocks_o == 3  // 0 the input stalls
  };
  assign watched = `WATCH;
endmodule
`default_nettype wire
