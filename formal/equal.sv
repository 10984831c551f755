// Two units with a valid/ready stream in and out give the same result for the same word, whatever the words before and after
// it are: a miter that does not care when a result comes. Results are compared whole while nothing pauses and nothing
// stops; with pauses and stops of any kind, their lowest bit is, a bit of the word that no arithmetic touches.
`default_nettype none
module properties (
  input  wire                  clk,
  input  wire                  reset,
  input  wire [`WORD_BITS-1:0] any_word,
  input  wire                  any_place,
  input  wire                  one_offer,
  input  wire [`WORD_BITS-1:0] one_word,
  input  wire                  one_take,
  input  wire                  other_offer,
  input  wire [`WORD_BITS-1:0] other_word,
  input  wire                  other_take,
  output wire                  watched
);
  reg started = 1'b0;
  always @(posedge clk) started <= 1'b1;
  wire rst_n = started && !reset;

  // One word is watched, at one place of the sequence; all others are whatever they like, of either unit.
  reg [`WORD_BITS-1:0] word;
  reg                  place;
  always @(posedge clk) if (!started) begin
    word  <= any_word;
    place <= any_place;
  end

  wire one_ready, other_ready, one_valid, other_valid;
  wire [`RESULT_BITS-1:0] one_data, other_data;
  reg [2:0] one_in = 3'd0, one_out = 3'd0, other_in = 3'd0, other_out = 3'd0;
  one_unit one (
    .clk_i(clk), .rst_ni(rst_n), .valid_i(one_offer), .ready_o(one_ready), .data_i(one_in == place ? word : one_word),
    .valid_o(one_valid), .ready_i(one_take), .data_o(one_data)
  );
  other_unit other (
    .clk_i(clk), .rst_ni(rst_n), .valid_i(other_offer), .ready_o(other_ready), .data_i(other_in == place ? word : other_word),
    .valid_o(other_valid), .ready_i(other_take), .data_o(other_data)
  );

  reg                    one_gave = 1'b0, other_gave = 1'b0;
  reg [`RESULT_BITS-1:0] one_result, other_result;
  wire one_due   = one_valid && one_take && one_out == place;
  wire other_due = other_valid && other_take && other_out == place;
  always @(posedge clk) begin
    // Counts stay where they are once the watched word is past, so that no other takes its place.
    one_in    <= !rst_n ? 3'd0 : one_offer && one_ready && one_in != 3'd7 ? one_in + 3'd1 : one_in;
    one_out   <= !rst_n ? 3'd0 : one_valid && one_take && one_out != 3'd7 ? one_out + 3'd1 : one_out;
    other_in  <= !rst_n ? 3'd0 : other_offer && other_ready && other_in != 3'd7 ? other_in + 3'd1 : other_in;
    other_out <= !rst_n ? 3'd0 : other_valid && other_take && other_out != 3'd7 ? other_out + 3'd1 : other_out;
    one_gave   <= rst_n && (one_gave || one_due);
    other_gave <= rst_n && (other_gave || other_due);
    if (one_due) one_result <= one_data;
    if (other_due) other_result <= other_data;
  end

  // Since the reset, every clock had an offer and a taker.
  reg calm = 1'b1;
  always @(posedge clk) calm <= calm && rst_n == started && one_offer && one_take && other_offer && other_take;

  wire [3:0] bad = {
    rst_n && one_gave && other_gave && one_result[0] != other_result[0],  // 3 both give the same bit, whatever pauses and stops
    rst_n && other_valid && other_in != 3'd7 && other_out >= other_in,  // 2 the other gives no more than it took
    rst_n && one_valid && one_in != 3'd7 && one_out >= one_in,          // 1 one gives no more than it took
    rst_n && calm && one_gave && other_gave && one_result != other_result  // 0 both give the same
  };
  wire [1:0] seen = {
    rst_n && calm && one_gave && other_gave && place,  // 1 a second word is compared
    rst_n && calm && one_gave && other_gave && one_result != 0               // 0 a result that is not 0 is compared
  };
  assign watched = `WATCH;
endmodule
`default_nettype wire
