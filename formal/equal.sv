// Two units with a valid/ready stream in and out give the same results in the same order: a miter that does not care when they do.
// Both are offered every word; each takes it in its time, and the next is offered when both have.
`default_nettype none
module properties (
  input  wire                  clk,
  input  wire                  reset,
  input  wire                  offer,
  input  wire [`WORD_BITS-1:0] word,
  output wire                  watched
);
  reg started = 1'b0;
  always @(posedge clk) started <= 1'b1;
  wire rst_n = started && !reset;

  // The word that is under way; one at a time, so that the slower unit sets the pace.
  reg                  busy = 1'b0;
  reg [`WORD_BITS-1:0] under_way;
  reg                  one_took = 1'b0, other_took = 1'b0, one_gave = 1'b0, other_gave = 1'b0;
  reg [`RESULT_BITS-1:0] one_result, other_result;

  wire one_ready, other_ready, one_valid, other_valid;
  wire [`RESULT_BITS-1:0] one_data, other_data;
  `ONE one (.clk_i(clk), .rst_ni(rst_n), .valid_i(busy && !one_took), .ready_o(one_ready), .data_i(under_way),
            .valid_o(one_valid), .ready_i(!one_gave), .data_o(one_data));
  `OTHER other (.clk_i(clk), .rst_ni(rst_n), .valid_i(busy && !other_took), .ready_o(other_ready), .data_i(under_way),
                .valid_o(other_valid), .ready_i(!other_gave), .data_o(other_data));

  wire both = one_gave && other_gave;
  always @(posedge clk) begin
    if (!rst_n || both) begin
      busy       <= 1'b0;
      one_took   <= 1'b0;
      other_took <= 1'b0;
      one_gave   <= 1'b0;
      other_gave <= 1'b0;
    end else begin
      if (!busy && offer) busy <= 1'b1;
      if (busy && one_ready) one_took <= 1'b1;
      if (busy && other_ready) other_took <= 1'b1;
      if (one_valid && !one_gave) one_gave <= 1'b1;
      if (other_valid && !other_gave) other_gave <= 1'b1;
    end
    if (!busy) under_way <= word;
    if (one_valid && !one_gave) one_result <= one_data;
    if (other_valid && !other_gave) other_result <= other_data;
  end

  wire [1:0] bad = {
    rst_n && (one_valid && !one_took || other_valid && !other_took),  // 1 no result without a word
    rst_n && both && one_result != other_result                      // 0 both give the same
  };
  reg [1:0] results = 2'd0;
  always @(posedge clk) if (rst_n && both) results <= results + 2'd1;
  wire [0:0] seen = {
    results == 2'd3                                                   // 0 three results of both
  };
  assign watched = `WATCH;
endmodule
`default_nettype wire
