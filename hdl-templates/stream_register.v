[[ banner ]]
// A register between two valid/ready streams that breaks every combinational path between them, at full throughput:
// a spare register takes the word that is on its way when the far side stops.
// It does not reorder, drop or repeat words.
//
//   far side ready   | main | spare | ready_o
//   always           | word | empty | 1
//   stops            | word | word  | 0
//   resumes          | word | empty | 1
`default_nettype none
module [[ prefix ]]_stream_register #(
  parameter WIDTH = 8  // bits of a word
) (
  input  wire             clk_i,    // clock
  input  wire             rst_ni,   // synchronous reset, active low
  input  wire             valid_i,  // near side offers a word
  output wire             ready_o,  // it is taken
  input  wire [WIDTH-1:0] data_i,   // the word
  output wire             valid_o,  // a word is offered to the far side
  input  wire             ready_i,  // it is taken
  output wire [WIDTH-1:0] data_o    // the word
);

  reg             valid_q;
  reg             spare_valid_q;
  reg [WIDTH-1:0] data_q;
  reg [WIDTH-1:0] spare_q;

  assign ready_o = !spare_valid_q;
  assign valid_o = valid_q;
  assign data_o  = data_q;

  always @(posedge clk_i) begin
    if (!rst_ni) begin
      valid_q       <= 1'b0;
      spare_valid_q <= 1'b0;
    end else if (!valid_q || ready_i) begin
      valid_q       <= valid_i || spare_valid_q;
      spare_valid_q <= 1'b0;
    end else if (valid_i) begin
      spare_valid_q <= 1'b1;
    end
  end

  always @(posedge clk_i) begin
    if (!valid_q || ready_i) data_q <= spare_valid_q ? spare_q : data_i;
    if (!spare_valid_q) spare_q <= data_i;
  end

endmodule
`default_nettype wire
