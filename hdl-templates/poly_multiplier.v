[[ banner ]]
// Multiplies two numbers in three clocks: operands, product and result each have a register, which synthesis can move into
// an FPGA's multiplier. [% if primitive %]It is an ECP5's MULT18X18D, whose registers its synthesis does not fill by itself.[% else %]There is no reset, so that nothing keeps them out of it.[% endif %]
//
//   clock | a_i | b_i | product_o
//     0   |  3  |  5  |     -
//     1   |  2  |  2  |     -
//     2   |  0  |  0  |     -
//     3   |  0  |  0  |    15
//     4   |  0  |  0  |     4
`default_nettype none
module [[ prefix ]]_poly_multiplier #(
  parameter A_BITS = 18,  // a[% if primitive %], up to 18[% endif %]
  parameter B_BITS = 18,  // b[% if primitive %], up to 18[% endif %]
  parameter SIGNED = 0    // both are two's complement (1) or unsigned (0)
) (
  input  wire                     clk_i,      // clock
  input  wire                     advance_i,  // the pipeline moves
  input  wire [A_BITS-1:0]        a_i,        // one operand
  input  wire [B_BITS-1:0]        b_i,        // the other
  output wire [A_BITS+B_BITS-1:0] product_o   // their product, three moves later
);
[% if primitive %]
  wire        is_signed = SIGNED != 0;
  wire [17:0] a = {{(18-A_BITS){is_signed & a_i[A_BITS-1]}}, a_i};
  wire [17:0] b = {{(18-B_BITS){is_signed & b_i[B_BITS-1]}}, b_i};
  wire [35:0] p;

  assign product_o = p[A_BITS+B_BITS-1:0];

  MULT18X18D #(
    .REG_INPUTA_CLK  ("CLK0"),
    .REG_INPUTA_CE   ("CE0"),
    .REG_INPUTB_CLK  ("CLK0"),
    .REG_INPUTB_CE   ("CE0"),
    .REG_PIPELINE_CLK("CLK0"),
    .REG_PIPELINE_CE ("CE0"),
    .REG_OUTPUT_CLK  ("CLK0"),
    .REG_OUTPUT_CE   ("CE0"),
    .CLK0_DIV        ("ENABLED"),
    .CLK1_DIV        ("ENABLED"),
    .CLK2_DIV        ("ENABLED"),
    .CLK3_DIV        ("ENABLED"),
    .GSR             ("DISABLED"),
    .SOURCEB_MODE    ("B_SHIFT"),
    .RESETMODE       ("SYNC"),
    .MULT_BYPASS     ("DISABLED"),
    .HIGHSPEED_CLK   ("NONE")
  ) u_dsp (
    .CLK0   (clk_i),
    .CLK1   (1'b0),
    .CLK2   (1'b0),
    .CLK3   (1'b0),
    .CE0    (advance_i),
    .CE1    (1'b1),
    .CE2    (1'b1),
    .CE3    (1'b1),
    .RST0   (1'b0),
    .RST1   (1'b0),
    .RST2   (1'b0),
    .RST3   (1'b0),
    .SIGNEDA(is_signed),
    .SIGNEDB(is_signed),
    .SOURCEA(1'b0),
    .SOURCEB(1'b0),
[%- for bit in 0..18 %]
    .A[[ bit ]](a[[ "[" ]][[ bit ]]]),
    .B[[ bit ]](b[[ "[" ]][[ bit ]]]),
[%- endfor %]
[%- for bit in 0..36 %]
    .P[[ bit ]](p[[ "[" ]][[ bit ]]])[% if bit < 35 %],[% endif %]
[%- endfor %]
  );
[% else %]
  reg [A_BITS-1:0]        a_q;
  reg [B_BITS-1:0]        b_q;
  reg [A_BITS+B_BITS-1:0] product_q;
  reg [A_BITS+B_BITS-1:0] result_q;

  wire [A_BITS+B_BITS-1:0] product;

  assign product_o = result_q;

  if (SIGNED != 0) begin : g_signed
    assign product = $signed(a_q) * $signed(b_q);
  end else begin : g_unsigned
    assign product = a_q * b_q;
  end

  always @(posedge clk_i) begin
    if (advance_i) begin
      a_q       <= a_i;
      b_q       <= b_i;
      product_q <= product;
      result_q  <= product_q;
    end
  end
[% endif %]
endmodule
`default_nettype wire
