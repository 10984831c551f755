// Properties of the stream register: the rules of AXI4-Stream, and that it loses, repeats and reorders nothing.
// One watched bit at a time: a property's bit must never be 1, a cover's bit must be reachable.
`default_nettype none
module properties (
  input  wire       clk,
  input  wire       reset,
  input  wire       valid_i,
  input  wire [1:0] data_i,
  input  wire       ready_i,
  output wire       watched
);
  localparam WIDTH = 2;

  reg started = 1'b0;
  always @(posedge clk) started <= 1'b1;
  wire rst_n = started && !reset;

  wire ready_o, valid_o;
  wire [WIDTH-1:0] data_o;
  `STREAM_REGISTER #(.WIDTH(WIDTH)) dut (
    .clk_i(clk), .rst_ni(rst_n), .valid_i(valid_i), .ready_o(ready_o), .data_i(data_i),
    .valid_o(valid_o), .ready_i(ready_i), .data_o(data_o)
  );

  // The words that are inside, oldest first, as an observer counts them. Nothing is assumed about the near side: it may
  // take an offer back.
  reg [1:0]       count = 2'd0;
  reg [WIDTH-1:0] oldest, newest;
  wire taken = valid_i && ready_o;
  wire given = valid_o && ready_i;
  always @(posedge clk) begin
    if (!rst_n) count <= 2'd0;
    else count <= count + taken - given;
    if (given) oldest <= count == 2'd2 ? newest : data_i;
    else if (count == 2'd0) oldest <= data_i;
    if (taken) newest <= data_i;
  end

  // The clock before.
  reg             waited = 1'b0;
  reg [WIDTH-1:0] offered;
  always @(posedge clk) begin
    waited  <= rst_n && valid_o && !ready_i;
    offered <= data_o;
  end

  // A word can be taken and one be given in each of the last eight clocks: full throughput.
  reg [2:0] streak = 3'd0;
  always @(posedge clk) streak <= taken && given ? streak + 3'd1 : 3'd0;

  wire [5:0] bad = {
    rst_n && !ready_o && count != 2'd2,               // 5 room is offered while there is any
    rst_n && valid_o && data_o != oldest,             // 4 nothing lost, repeated or reordered
    rst_n && valid_o != (count != 2'd0),              // 3 as many out as in
    count == 2'd3,                                    // 2 never more than two words inside
    rst_n && waited && data_o != offered,             // 1 stable while it waits
    rst_n && waited && !valid_o                       // 0 offered until taken
  };
  wire [2:0] seen = {
    streak == 3'd7,                                   // 2 full throughput
    rst_n && waited && count == 2'd2 && given,        // 1 a full register is emptied
    rst_n && waited                                   // 0 an offer waits
  };
  assign watched = `WATCH;
endmodule
`default_nettype wire
