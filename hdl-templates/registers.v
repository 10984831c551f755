[[ banner ]]
// AXI4-Lite slave: what the core is, what it has counted, and what a processor may set. 32 bits a register, so that a count is read
// whole, as it is in the clock in which the address is taken. Reads and writes do not wait for each other, an address and its
// data come in any order, and every output is a register. The two lowest address bits do not matter; there is no protection.
//
//   address | access | register
[%- for row in rows %]
//   [[ row ]]
[%- endfor %]
//   else    |        | SLVERR; so is a write to what is only read
`default_nettype none
module [[ prefix ]]_registers #(
  parameter ADDRESS_BITS = [[ address_bits ]]  // a byte address
) (
  input  wire                    clk_i,                  // clock
  input  wire                    rst_ni,                 // synchronous reset, active low
  input  wire                    awvalid_i,              // a write's address is offered
  output wire                    awready_o,              // it is taken
  input  wire [ADDRESS_BITS-1:0] awaddr_i,               // the address
  input  wire                    wvalid_i,               // a write's data are offered
  output wire                    wready_o,               // they are taken
  input  wire [31:0]             wdata_i,                // the data
  input  wire [3:0]              wstrb_i,                // which bytes of them are written
  output wire                    bvalid_o,               // a write's answer is offered
  input  wire                    bready_i,               // it is taken
  output wire [1:0]              bresp_o,                // OKAY or SLVERR
  input  wire                    arvalid_i,              // a read's address is offered
  output wire                    arready_o,              // it is taken
  input  wire [ADDRESS_BITS-1:0] araddr_i,               // the address
  output wire                    rvalid_o,               // a read's answer is offered
  input  wire                    rready_i,               // it is taken
  output wire [31:0]             rdata_o,                // the data
  output wire [1:0]              rresp_o,                // OKAY or SLVERR
[%- for setting in settings %]
  // [[ setting.meaning ]]
  output wire [31:0]             [[ setting.name ]]_o,
[%- endfor %]
  input  wire [31:0]             sets_done_i,            // complete sets since reset
  input  wire [31:0]             sets_discarded_i,       // discarded sets since reset
  input  wire [31:0]             stall_clocks_i,         // clocks since reset in which a raw sample waited
  input  wire                    delivered_i,            // a result is taken
  input  wire                    delivered_first_i,      // it is a frame's first
  input  wire                    delivered_saturated_i   // it is saturated
);

  localparam       WORD_BITS = [[ word_bits ]];  // of a register's number
  localparam [1:0] OKAY   = 2'b00;
  localparam [1:0] SLVERR = 2'b10;

  // What is counted here.
  reg [31:0] saturated_pixels_q;
  reg [31:0] set_number_q;
[% for setting in settings %]
  reg [31:0] [[ setting.name ]]_q;
  assign [[ setting.name ]]_o = [[ setting.name ]]_q;
[%- endfor %]

  // A write: its address and its data wait for each other, and both for the last answer.
  reg                    aw_valid_q;
  reg [ADDRESS_BITS-3:0] aw_word_q;
  reg                    w_valid_q;
  reg [31:0]             w_data_q;
  reg [3:0]              w_strobes_q;
  reg                    b_valid_q;
  reg [1:0]              b_response_q;

  wire write = aw_valid_q && w_valid_q && (!b_valid_q || bready_i);
[%- for setting in settings %]
  wire write_[[ setting.name ]] = aw_word_q == [[ setting.label ]];
[%- endfor %]
  wire write_okay = [% for setting in settings %][% if !loop.first %] || [% endif %]write_[[ setting.name ]][% endfor %];

  assign awready_o = !aw_valid_q;
  assign wready_o  = !w_valid_q;
  assign bvalid_o  = b_valid_q;
  assign bresp_o   = b_response_q;

  // A read: the next address is taken when the last answer has been.
  reg        r_valid_q;
  reg [31:0] r_data_q;
  reg [1:0]  r_response_q;

  assign arready_o = !r_valid_q;
  assign rvalid_o  = r_valid_q;
  assign rdata_o   = r_data_q;
  assign rresp_o   = r_response_q;

  // What is constant is a few functions of the address; kept apart from the counts it takes half the logic.
  wire [WORD_BITS-1:0] read_word  = araddr_i[WORD_BITS+1:2];
  wire                 read_block = araddr_i[ADDRESS_BITS-1:WORD_BITS+2] == {(ADDRESS_BITS-2-WORD_BITS){1'b0}};
  reg                  read_known_d;
  reg [31:0]           read_constant_d;
  reg [31:0]           read_variable_d;

  always @(*) begin
    case (read_word)
[%- for register in constants %]
      [[ register.label ]]: read_constant_d = [[ register.value ]];  // [[ register.name ]]
[%- endfor %]
      default: read_constant_d = 32'd0;
    endcase
    case (read_word)
[%- for register in variables %]
      [[ register.label ]]: read_variable_d = [[ register.value ]];  // [[ register.name ]]
[%- endfor %]
      default: read_variable_d = 32'd0;
    endcase
    case (read_word)
[%- for label in missing %]
      [[ label ]]: read_known_d = 1'b0;
[%- endfor %]
      default: read_known_d = 1'b1;
    endcase
  end

  wire        read_okay = read_block && read_known_d;
  wire [31:0] read_data = read_block ? read_constant_d | read_variable_d : 32'd0;

  // A register is a whole word.
  wire [3:0] unused_address = {awaddr_i[1:0], araddr_i[1:0]};

  always @(posedge clk_i) begin
    if (!rst_ni) begin
      aw_valid_q         <= 1'b0;
      w_valid_q          <= 1'b0;
      b_valid_q          <= 1'b0;
      r_valid_q          <= 1'b0;
      saturated_pixels_q <= 32'd0;
      set_number_q       <= 32'd0;
    end else begin
      if (write) aw_valid_q <= 1'b0;
      else if (awvalid_i) aw_valid_q <= 1'b1;
      if (write) w_valid_q <= 1'b0;
      else if (wvalid_i) w_valid_q <= 1'b1;
      if (write) b_valid_q <= 1'b1;
      else if (bready_i) b_valid_q <= 1'b0;
      if (!r_valid_q) r_valid_q <= arvalid_i;
      else if (rready_i) r_valid_q <= 1'b0;
      saturated_pixels_q <= saturated_pixels_q + {31'd0, delivered_i && delivered_saturated_i};
      set_number_q       <= set_number_q + {31'd0, delivered_i && delivered_first_i};
    end
  end

  always @(posedge clk_i) begin
    if (!aw_valid_q) aw_word_q <= awaddr_i[ADDRESS_BITS-1:2];
    if (!w_valid_q) begin
      w_data_q    <= wdata_i;
      w_strobes_q <= wstrb_i;
    end
    if (write) b_response_q <= write_okay ? OKAY : SLVERR;
    if (!r_valid_q) begin
      r_data_q     <= read_data;
      r_response_q <= read_okay ? OKAY : SLVERR;
    end
  end
[% for setting in settings %]
  always @(posedge clk_i) begin
    if (!rst_ni) begin
      [[ setting.name ]]_q <= [[ setting.reset ]];
    end else if (write && write_[[ setting.name ]]) begin
      if (w_strobes_q[0]) [[ setting.name ]]_q[7:0] <= w_data_q[7:0];
      if (w_strobes_q[1]) [[ setting.name ]]_q[15:8] <= w_data_q[15:8];
      if (w_strobes_q[2]) [[ setting.name ]]_q[23:16] <= w_data_q[23:16];
      if (w_strobes_q[3]) [[ setting.name ]]_q[31:24] <= w_data_q[31:24];
    end
  end
[%- endfor %]

endmodule
`default_nettype wire
